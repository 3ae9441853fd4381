//! Swimmers against boundary-integral values.

use motile::Swimmer;
use motile::active_interface::{ActiveDroplet, Observables};
use motile::ib_core::{Every, Handle, Hydrodynamics, Integrator, Scene, StepSize};

use crate::validation::{Reference, ReferenceFile, StudyError};

/// All observables of a droplet at the present state of its scene.
///
/// # Errors
/// What an evaluation can fail with.
pub fn look<H: Hydrodynamics, I: Integrator>(
    scene: &mut Scene<H, I>,
    droplet: Handle<ActiveDroplet>,
) -> Result<Observables, StudyError> {
    Ok(scene.observe(droplet)?)
}

/// Relative errors of a steady swimmer.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SteadyErrors {
    /// Speed.
    pub speed: f64,
    /// Aspect ratio from the area moments.
    pub aspect_ratio: f64,
    /// Stresslet along the motion.
    pub stresslet: f64,
    /// Squirmer parameter in the frame of the droplet.
    pub beta: f64,
    /// Active fraction.
    pub active_fraction: f64,
    /// Largest concentration.
    pub concentration_max: f64,
    /// Relative change of the area.
    pub area_change: f64,
    /// Steps taken.
    pub steps: usize,
    /// Time step at the end.
    pub dt: f64,
}

impl SteadyErrors {
    /// The six errors that the reference table has, in its order.
    #[must_use]
    pub fn list(&self) -> [f64; 6] {
        [self.speed, self.aspect_ratio, self.stresslet, self.beta, self.active_fraction, self.concentration_max]
    }
}

/// The swimmer of the reference table: box 6, viscosity 100, A = 2 |activity|.
#[must_use]
pub fn reference_swimmer(base: &Swimmer, activity: f64, h: f64) -> Swimmer {
    Swimmer {
        activity,
        excluded_volume: 2.0 * activity.abs(),
        viscosity: 100.0,
        lengths: [6.0, 6.0],
        spacing: h,
        ..base.clone()
    }
}

/// Runs a swimmer on a grid from the polarised start to `time` and compares with the steady state of
/// `steady_swimmer_box6.csv`.
///
/// # Errors
/// An activity that is not in the table, and what a run can fail with.
pub fn steady(swimmer: &Swimmer, time: f64) -> Result<SteadyErrors, StudyError> {
    let (scene, droplet) = swimmer.build_on_grid()?;
    compare(scene, droplet, swimmer, time)
}

/// As [`steady`] without a grid; a droplet of viscosity 100 in surroundings of viscosity 10 is compared with
/// `steady_swimmer_contrast_box6.csv`.
///
/// # Errors
/// An activity that is not in the tables, and what a run can fail with.
pub fn steady_without_grid(swimmer: &Swimmer, time: f64) -> Result<SteadyErrors, StudyError> {
    let (scene, droplet) = swimmer.build_without_grid()?;
    compare(scene, droplet, swimmer, time)
}

fn compare<H: Hydrodynamics>(
    mut scene: Scene<H>,
    droplet: Handle<ActiveDroplet>,
    swimmer: &Swimmer,
    time: f64,
) -> Result<SteadyErrors, StudyError> {
    let file = match swimmer.viscosity_inside {
        None => ReferenceFile::SteadySwimmers,
        Some(_) => ReferenceFile::SteadySwimmerContrast,
    };
    let reference = Reference::read(file)?.select("zeta_dmu", &format!("{:.1}", swimmer.activity));
    scene.run(time).go()?;
    let seen = look(&mut scene, droplet)?;
    let relative = |value: f64, name: &str| -> Result<f64, StudyError> {
        let exact = reference.value(name)?;
        Ok((value - exact) / exact.abs())
    };
    let dt = match scene.step_size() {
        StepSize::Fixed(dt) => dt,
        StepSize::OfLimit(fraction) => scene.system().step_limit().map_or(f64::NAN, |(limit, _)| fraction * limit.dt),
        StepSize::Adaptive { .. } => f64::NAN,
    };
    let c0 = swimmer.mean_concentration;
    Ok(SteadyErrors {
        speed: relative(seen.speed(), "speed")?,
        aspect_ratio: relative(seen.aspect_ratio_moments, "AR_mom")?,
        stresslet: relative(seen.moments.stresslet()[0][0], "Sxx_f")?,
        beta: relative(seen.squirmer.beta().unwrap_or(f64::NAN), "beta_co")?,
        active_fraction: relative(seen.active_region.map_or(f64::NAN, |region| region.fraction), "active_frac")?,
        concentration_max: relative(seen.concentration_range.map_or(f64::NAN, |[max, _]| max / c0), "cmax")?,
        area_change: seen.area / scene.body(droplet)?.initial_area() - 1.0,
        steps: scene.steps(),
        dt,
    })
}

/// Largest relative error of the speed over the times of `swimmer_transient_box6_activity_1.csv`, with the time at
/// which it occurs.
///
/// # Errors
/// What a run can fail with.
pub fn transient(base: &Swimmer, h: f64) -> Result<(f64, f64), StudyError> {
    let (scene, droplet) = reference_swimmer(base, -1.0, h).build_on_grid()?;
    compare_transient(scene, droplet)
}

/// As [`transient`], without a grid.
///
/// # Errors
/// What a run can fail with.
pub fn transient_without_grid(base: &Swimmer) -> Result<(f64, f64), StudyError> {
    let (scene, droplet) = reference_swimmer(base, -1.0, base.spacing).build_without_grid()?;
    compare_transient(scene, droplet)
}

fn compare_transient<H: Hydrodynamics>(
    mut scene: Scene<H>,
    droplet: Handle<ActiveDroplet>,
) -> Result<(f64, f64), StudyError> {
    let reference = Reference::read(ReferenceFile::Transient)?;
    let (times, speeds) = (reference.column("t")?, reference.column("speed")?);
    let mut worst = (0.0_f64, 0.0);
    for (&time, speed) in times.iter().zip(speeds) {
        if time > 0.0 {
            scene.run(time).go()?;
        }
        let error = look(&mut scene, droplet)?.speed() / speed - 1.0;
        if error.abs() > worst.0.abs() {
            worst = (error, time);
        }
    }
    Ok(worst)
}

/// What became of a swimmer in a long run.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct LongRun {
    /// Speed at the end.
    pub speed: f64,
    /// Relative spread (maximum over minimum, less one) of the speed over the second half.
    pub speed_spread: f64,
    /// Largest relative change of the area.
    pub area_change: f64,
    /// Largest relative change of the particle number.
    pub particle_change: f64,
    /// Relative change of the perimeter from the middle to the end.
    pub perimeter_creep: f64,
    /// Mean turning rate over the second half (radians per time).
    pub turning_rate: f64,
    /// Heading at the end (radians).
    pub heading: f64,
}

/// Runs a swimmer to `time` and watches it.
///
/// # Errors
/// What a run can fail with.
pub fn long_run(swimmer: &Swimmer, time: f64) -> Result<LongRun, StudyError> {
    let (mut scene, droplet) = swimmer.build_on_grid()?;
    let mut records: Vec<(f64, Observables)> = Vec::new();
    let mut watch = |system: &mut motile::ib_core::System<motile::PeriodicBox>| -> Result<(), StudyError> {
        records.push((system.time(), system.observe(droplet)?));
        Ok(())
    };
    scene.run(time).observe(Every::StepAfter(0.5), &mut watch).go()?;
    let late: Vec<_> = records.iter().filter(|(t, _)| *t >= 0.5 * time).collect();
    let (Some((t0, first)), Some((t1, last)), Some((_, start))) = (late.first(), late.last(), records.first()) else {
        return Err(StudyError::Reference("a run without records".to_owned()));
    };
    let speeds = late.iter().map(|(_, seen)| seen.speed());
    let (max, min) = speeds.fold((0.0_f64, f64::INFINITY), |(max, min), v| (max.max(v), min.min(v)));
    let largest = |value: fn(&Observables) -> f64| {
        records.iter().map(|(_, seen)| (value(seen) / value(start) - 1.0).abs()).fold(0.0, f64::max)
    };
    // Headings are compared within half a turn.
    let turned = (last.heading() - first.heading() + 0.5 * std::f64::consts::TAU).rem_euclid(std::f64::consts::TAU)
        - 0.5 * std::f64::consts::TAU;
    Ok(LongRun {
        speed: last.speed(),
        speed_spread: max / min - 1.0,
        area_change: largest(|seen| seen.area),
        particle_change: largest(|seen| seen.particle_number),
        perimeter_creep: last.perimeter / first.perimeter - 1.0,
        turning_rate: turned / (t1 - t0),
        heading: last.heading(),
    })
}

//! Swimmers against boundary-integral values.

use std::f64::consts::{PI, TAU};

use motile::active_interface::observables::{Observables, net_flux};
use motile::base::Region;
use motile::scene::{Every, Hydrodynamics, Scene, System, gap::wall_gap};
use motile::setup::{AnyFlow, Built, Method, Setup};
use motile::stokes_grid::flux;

use crate::validation::channel::solver;
use crate::validation::fixed_shapes::couple;
use crate::validation::{Reference, ReferenceFile, StudyError};

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
    /// Flux, in a channel.
    pub flux: Option<f64>,
    /// Gap to the walls, in a channel.
    pub gap: Option<f64>,
    /// Relative change of the area.
    pub area_change: f64,
    /// Relative change of the particle number.
    pub particle_change: f64,
    /// Steps taken.
    pub steps: usize,
}

impl SteadyErrors {
    /// The six errors that the table of boxes has, in its order.
    #[must_use]
    pub fn list(&self) -> [f64; 6] {
        [self.speed, self.aspect_ratio, self.stresslet, self.beta, self.active_fraction, self.concentration_max]
    }
}

/// Runs a scene of one swimmer from the polarised start to `time` and compares with its steady state: in a box of 6 x 6
/// of `steady_swimmer_box6.csv` or, for a droplet of viscosity 100 in a fluid of viscosity 10,
/// `steady_swimmer_contrast_box6.csv`; in a channel (period 12, A = 10, zero mean pressure gradient) of
/// `channel_steady_swimmer.csv`.
///
/// # Errors
/// An activity or a width that is not in the tables, and what a run can fail with.
pub fn steady(setup: &Setup, time: f64) -> Result<SteadyErrors, StudyError> {
    let droplet = &setup.droplets[0];
    let (table, stresslet) = match setup.region {
        Region::Channel { width, .. } => {
            let table = Reference::read(ReferenceFile::ChannelSwimmers)?.select("conv", "p0");
            (table.select("w", &width.to_string()), "Sxx")
        }
        _ if droplet.viscosity.is_some() => (Reference::read(ReferenceFile::SteadySwimmerContrast)?, "Sxx_f"),
        _ => (Reference::read(ReferenceFile::SteadySwimmers)?, "Sxx_f"),
    };
    let table = table.select("zeta_dmu", &format!("{:.1}", droplet.activity()));
    let c0 = droplet.particles.map_or(f64::NAN, |particles| particles.concentration);
    let relative = |value: f64, name: &str| -> Result<f64, StudyError> {
        let exact = table.value(name)?;
        Ok((value - exact) / exact.abs())
    };

    let Built { mut scene, droplets, .. } = setup.build()?;
    let particles: f64 = scene.body(droplets[0])?.particle_numbers().iter().sum();
    scene.run(time).go()?;
    let seen = scene.observe(droplets[0])?;
    let (mut flux, mut gap) = (None, None);
    if let Region::Channel { width, .. } = setup.region {
        flux = Some(relative(flux_through(setup, &mut scene, seen.centroid.x)?, "flux")?);
        let markers = scene.body(droplets[0])?.markers();
        gap = Some(relative(wall_gap(markers, [-0.5 * width, 0.5 * width]), "min_gap")?);
    }
    Ok(SteadyErrors {
        speed: relative(seen.speed(), "speed")?,
        aspect_ratio: relative(seen.aspect_ratio_moments, "AR_mom")?,
        stresslet: relative(seen.moments.stresslet()[0][0], stresslet)?,
        beta: relative(seen.squirmer.beta().unwrap_or(f64::NAN), "beta_co")?,
        active_fraction: relative(seen.active_region.map_or(f64::NAN, |region| region.fraction), "active_frac")?,
        concentration_max: relative(seen.concentration_range.map_or(f64::NAN, |[max, _]| max / c0), "cmax")?,
        flux,
        gap,
        area_change: seen.area / scene.body(droplets[0])?.initial_area() - 1.0,
        particle_change: seen.particle_number / particles - 1.0,
        steps: scene.steps(),
    })
}

/// The flux through a channel in the present state (area per time): on a grid the sum over its faces, else that half a
/// period away from a droplet at `x`.
fn flux_through(setup: &Setup, scene: &mut Scene<AnyFlow>, x: f64) -> Result<f64, StudyError> {
    match (setup.method, setup.region) {
        (Method::Grid(grid), Region::Channel { length, width, drive }) => {
            let solver = solver([length, width], grid.spacing, drive, setup.viscosity)?;
            let mut flow = couple(solver, &grid.kernel, grid.corrected);
            flow.velocities(&mut scene.system().markers().clone())?;
            Ok(flux(flow.velocity_field()))
        }
        _ => Ok(net_flux(scene.system_mut(), x + 0.5 * setup.region.lengths()[0])?),
    }
}

/// Largest relative error of the speed of a swimmer of activity -1 over the times of
/// `swimmer_transient_box6_activity_1.csv`, with the time at which it occurs.
///
/// # Errors
/// Those of a run.
pub fn transient(setup: &Setup) -> Result<(f64, f64), StudyError> {
    let reference = Reference::read(ReferenceFile::Transient)?;
    let (times, expected) = (reference.column("t")?, reference.column("speed")?);
    let mut worst = (0.0_f64, 0.0);
    for ((found, expected), time) in speeds(setup, &times)?.iter().zip(expected).zip(times) {
        let error = found / expected - 1.0;
        if error.abs() > worst.0.abs() {
            worst = (error, time);
        }
    }
    Ok(worst)
}

/// Speeds of the first droplet of a scene at increasing times.
///
/// # Errors
/// Those of a run.
pub fn speeds(setup: &Setup, times: &[f64]) -> Result<Vec<f64>, StudyError> {
    let Built { mut scene, droplets, .. } = setup.build()?;
    let speed = |&time: &f64| {
        scene.run(time).go()?;
        Ok(scene.observe(droplets[0])?.speed())
    };
    times.iter().map(speed).collect()
}

/// Fate of a swimmer in a long run.
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
    /// Headings at the middle and at the end (radians).
    pub headings: [f64; 2],
    /// The time between those.
    pub half: f64,
    /// How often the centroid crossed an edge of the box.
    pub crossings: u32,
}

impl LongRun {
    /// Mean turning rate over the second half (radians per time).
    #[must_use]
    pub fn turning_rate(&self) -> f64 {
        let [first, last] = self.headings;
        // Headings are compared within half a turn.
        ((last - first + PI).rem_euclid(TAU) - PI) / self.half
    }

    /// Rate (1/time) at which the angle to the x axis grows over the second half.
    #[must_use]
    pub fn divergence(&self) -> f64 {
        let [first, last] = self.headings;
        (last / first).ln() / self.half
    }
}

/// Runs a scene of one swimmer to `time` and watches it.
///
/// # Errors
/// Those of a run.
pub fn long_run(setup: &Setup, time: f64) -> Result<LongRun, StudyError> {
    let Built { mut scene, droplets, .. } = setup.build()?;
    let mut records: Vec<(f64, Observables)> = Vec::new();
    let mut watch = |system: &mut System<AnyFlow>| -> Result<(), StudyError> {
        records.push((system.time(), system.observe(droplets[0])?));
        Ok(())
    };
    scene.run(time).observe(Every::StepAfter(0.5), &mut watch).go()?;
    let late = &records[records.partition_point(|(t, _)| *t < 0.5 * time)..];
    let ([(t0, first), ..], [.., (t1, last)], Some((_, start))) = (late, late, records.first()) else {
        return Err(StudyError::Reference("a run without records".to_owned()));
    };
    let speeds = late.iter().map(|(_, seen)| seen.speed());
    let (max, min) = speeds.fold((0.0_f64, f64::INFINITY), |(max, min), v| (max.max(v), min.min(v)));
    let largest = |value: fn(&Observables) -> f64| {
        records.iter().map(|(_, seen)| (value(seen) / value(start) - 1.0).abs()).fold(0.0, f64::max)
    };
    let lengths = setup.region.lengths();
    let cell = |seen: &Observables| [0, 1].map(|i| (seen.centroid[i] / lengths[i] + 0.5).floor());
    let moves = records.windows(2).map(|pair| {
        let (a, b) = (cell(&pair[0].1), cell(&pair[1].1));
        u32::from(a[0] != b[0]) + u32::from(a[1] != b[1])
    });
    Ok(LongRun {
        speed: last.speed(),
        speed_spread: max / min - 1.0,
        area_change: largest(|seen| seen.area),
        particle_change: largest(|seen| seen.particle_number),
        perimeter_creep: last.perimeter / first.perimeter - 1.0,
        headings: [first, last].map(|seen| seen.heading().unwrap_or(f64::NAN)),
        half: t1 - t0,
        crossings: moves.sum(),
    })
}

//! Swimmers against boundary-integral values.

use motile::active_interface::observables::net_flux;
use motile::base::Region;
use motile::scene::{Hydrodynamics, Scene, gap::wall_gap};
use motile::setup::{AnyFlow, Built, Method, Setup};
use motile::stokes_grid::flux;

use crate::validation::fixed_shapes::couple;
use crate::validation::scene::channel_solver;
use crate::validation::{Reference, StudyError};

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
            let table = Reference::read("channel_steady_swimmer")?.select("conv", "p0");
            (table.select("w", &width.to_string()), "Sxx")
        }
        _ if droplet.viscosity.is_some() => (Reference::read("steady_swimmer_contrast_box6")?, "Sxx_f"),
        _ => (Reference::read("steady_swimmer_box6")?, "Sxx_f"),
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
            let solver = channel_solver([length, width], grid.spacing, drive, setup.viscosity)?;
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
    let reference = Reference::read("swimmer_transient_box6_activity_1")?;
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

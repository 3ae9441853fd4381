//! How many iterations a viscosity that varies takes.

use std::f64::consts::TAU;

use motile::active_interface::Curve;
use motile::base::Region;
use motile::base::Vec2;
use motile::scene::{Hydrodynamics, MarkerKind, Markers, Scene, StepSize};
use motile::setup::{DropletSetup, GridMethod, Method, Particles, Setup};

use super::smeared;
use crate::validation::StudyError;
use crate::validation::scene::flow;

/// Iterations of solves of a viscosity that varies.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Iterations {
    /// Mean over the solves.
    pub mean: f64,
    /// Most of a solve.
    pub most: usize,
    /// Largest true residual, relative to the forces.
    pub residual: f64,
}

/// The iterations of one solve from nothing: a circle of radius 1 with the tension 10 + 3 cos + 2 cos 2 + cos 3,
/// `ratio` times as viscous as the exterior fluid, its viscosity smeared over Peskin's function.
///
/// # Errors
/// A spacing that does not divide the region; no convergence.
pub fn cold_iterations(region: Region, h: f64, ratio: f64, tolerance: f64) -> Result<Iterations, StudyError> {
    let mut markers = Markers::new();
    let count = (2.0 * TAU / h).round() as usize;
    markers.push_group(count, MarkerKind::Interface { viscosity_inside: Some(ratio) });
    markers.positions_mut().copy_from_slice(&Curve::circle(1.0)?.translated(Vec2::new(0.013, 0.017)).markers(count)?);
    for k in 0..count {
        let next = (k + 1) % count;
        let t = TAU * (k as f64 + 0.5) / count as f64;
        let tension = 10.0 + 3.0 * t.cos() + 2.0 * (2.0 * t).cos() + (3.0 * t).cos();
        let pull = tension * (markers.positions()[next] - markers.positions()[k]).normalize();
        markers.forces_mut()[k] += pull;
        markers.forces_mut()[next] -= pull;
    }
    let report = smeared(region, h, tolerance)?.velocities(&mut markers)?;
    Ok(Iterations { mean: report.iterations as f64, most: report.iterations, residual: report.residual })
}

/// The iterations of each solve of a swimmer, (10 `ratio`, 10), activity -4, A = 10, 6 x 6 box, over `steps` steps of
/// `dt` once it has swum to t = 1.
///
/// # Errors
/// Those of a run.
pub fn iterations_in_a_run(
    h: f64,
    ratio: f64,
    tolerance: f64,
    dt: f64,
    steps: usize,
) -> Result<Iterations, StudyError> {
    let mut droplet = DropletSetup { viscosity: Some(10.0 * ratio), ..DropletSetup::thesis() };
    droplet.particles = droplet.particles.map(|particles| Particles { activity: -4.0, ..particles });
    let method = Method::Grid(GridMethod { spacing: h, ..GridMethod::thesis() });
    let setup = Setup { viscosity: 10.0, method, ..Setup::thesis() };
    let mut scene = Scene::new(flow(setup.region, method, setup.viscosity, tolerance)?);
    let _ = scene.add(setup.droplet(&droplet)?);
    scene.run(1.0).step_size(StepSize::Fixed(dt)).go()?;
    let (mut residual, mut most) = (0.0_f64, 0);
    let before = scene.system().hydrodynamics().work();
    for _ in 0..steps {
        scene.step(dt)?;
        scene.system_mut().evaluate()?;
        let report = scene.system().report();
        (residual, most) = (residual.max(report.residual), most.max(report.iterations));
    }
    let after = scene.system().hydrodynamics().work();
    let mean = (after.iterations - before.iterations) as f64 / (after.evaluations - before.evaluations) as f64;
    Ok(Iterations { mean, most, residual })
}

//! Runs a scene and measures what changed.

use std::any::Any;
use std::time::Instant;

use motile::active_interface::{ActiveDroplet, polygon_area};
use motile::ib_core::{Hydrodynamics, Integrator, RungeKuttaChebyshev, Scene, StepSize, System};
use motile::{AnyFlow, Method, Swimmer};

use crate::{CaseError, Ending, Look, Outcome, Way};

/// The largest relative changes of the droplets of a scene since their starts.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct Drift {
    /// Of the area.
    pub area: f64,
    /// Of the number of particles.
    pub particles: f64,
}

fn droplets<H: Hydrodynamics>(system: &System<H>) -> impl Iterator<Item = &ActiveDroplet> {
    system.bodies().filter_map(|body| (body as &dyn Any).downcast_ref())
}

/// How much area and particles of the droplets of `system` have changed, the droplet that changed most; `numbers` are the particles at the
/// start.
pub fn drift<H: Hydrodynamics>(system: &System<H>, numbers: &[f64]) -> Drift {
    let larger = |a: f64, b: f64| if b.is_nan() || b.abs() > a.abs() { b } else { a };
    droplets(system).zip(numbers).fold(Drift::default(), |drift, (droplet, number)| {
        let area = polygon_area(droplet.markers()).unwrap_or(f64::NAN) / droplet.initial_area() - 1.0;
        let total: f64 = droplet.particle_numbers().iter().sum();
        let particles = if *number > 0.0 { total / number - 1.0 } else { 0.0 };
        Drift { area: larger(drift.area, area), particles: larger(drift.particles, particles) }
    })
}

/// Most steps of a run: a case that needs more has gone wrong.
const MOST: usize = 2_000_000;

/// Runs a scene to time `until`.
pub(crate) fn run<I: Integrator>(mut scene: Scene<AnyFlow, I>, until: f64, step: StepSize, look: Look<'_>) -> Outcome {
    measured(&mut scene, look, |scene| scene.run(until).step_size(step).most_steps(MOST).go())
}

/// Runs a scene as `body` does, which leaves it in the last state.
pub(crate) fn measured<I: Integrator>(
    scene: &mut Scene<AnyFlow, I>,
    look: Look<'_>,
    body: impl FnOnce(&mut Scene<AnyFlow, I>) -> Result<(), motile::ib_core::SceneError>,
) -> Outcome {
    let numbers: Vec<f64> = droplets(scene.system()).map(|droplet| droplet.particle_numbers().iter().sum()).collect();
    let start = Instant::now();
    let outcome = body(scene);
    let seconds = start.elapsed().as_secs_f64();
    look(scene.system_mut());
    let report = scene.step_report();
    Outcome {
        ending: Ending::from(&outcome),
        explanation: outcome.err().map(|error| error.explanation()),
        time: scene.time(),
        steps: scene.steps(),
        taken_back: report.rejections + report.failures,
        evaluations: scene.system().hydrodynamics().work().evaluations,
        drift: drift(scene.system(), &numbers),
        seconds,
    }
}

/// Half of what is stable.
pub(crate) const AUTO: StepSize = StepSize::OfLimit(0.5);

/// The steps of the adaptive runs.
pub(crate) const ADAPTIVE: StepSize = StepSize::Adaptive { tolerance: 1e-5 };

/// The swimmer by one of the ways.
pub(crate) fn swimmer(way: Way, base: &Swimmer) -> Swimmer {
    match way {
        Way::Grid | Way::Chebyshev => Swimmer { method: Method::ImmersedBoundary, ..base.clone() },
        Way::Integral => {
            Swimmer { method: Method::BoundaryIntegral, nodes: 64, concentration_cells: 256, ..base.clone() }
        }
        Way::Thesis => {
            let Swimmer { method, contrast, kernel, corrected, motion, flux, area_constraint, .. } = Swimmer::thesis();
            Swimmer { method, contrast, kernel, corrected, motion, flux, area_constraint, ..base.clone() }
        }
    }
}

/// Runs a scene by one of the ways.
pub(crate) fn run_way(way: Way, scene: Scene<AnyFlow>, until: f64, look: Look<'_>) -> Result<Outcome, CaseError> {
    Ok(match way {
        Way::Chebyshev => run(scene.advanced_by(RungeKuttaChebyshev::new()), until, ADAPTIVE, look),
        _ => run(scene, until, AUTO, look),
    })
}

//! Runs a scene and measures what changed.

use std::f64::consts::PI;
use std::time::Instant;

use motile::active_interface::{ActiveDroplet, Flux, Motion, polygon_area};
use motile::base::Vec2;
use motile::scene::gap::Repulsion;
use motile::scene::{Hydrodynamics, Scene, StepSize, System, integrator::RungeKuttaChebyshev};
use motile::setup::{AnyFlow, GridMethod, IntegralMethod, Method, Particles, Setup};

use crate::hard_cases::{CaseError, Ending, Look, Outcome, Way};

/// The largest relative changes of the droplets of a scene since their starts.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub(crate) struct Drift {
    /// Of the area.
    pub(crate) area: f64,
    /// Of the number of particles.
    pub(crate) particles: f64,
}

fn droplets<H: Hydrodynamics>(system: &System<H>) -> impl Iterator<Item = &ActiveDroplet> {
    system.bodies().map(|(_, droplet)| droplet)
}

/// The area that a droplet keeps (length squared): that of the polygon of its markers on a grid, and without one that
/// of the smooth curve through them, from which the polygon's differs by `pi/6 L^2/N^2`, more for longer curves.
fn area(droplet: &ActiveDroplet, on_grid: bool) -> f64 {
    let markers = droplet.markers();
    let count = markers.len();
    if on_grid {
        return polygon_area(markers).unwrap_or(f64::NAN);
    }
    // Half the integral of x cross dx, the derivative that of the interpolating trigonometric polynomial.
    let unit = PI / count as f64;
    let weight = |j: usize| {
        let angle = unit * j as f64;
        let size = if count.is_multiple_of(2) { angle.tan().recip() } else { angle.sin().recip() };
        if j.is_multiple_of(2) { size } else { -size }
    };
    let weights: Vec<f64> = (1..count).map(weight).collect();
    let share = |k: usize| {
        let along: Vec2 = weights.iter().zip(1..).map(|(w, j)| *w * markers[(k + count - j) % count]).sum();
        markers[k].perp_dot(along)
    };
    0.5 * unit * (0..count).map(share).sum::<f64>()
}

/// Areas and particle numbers of the droplets of `system`.
fn contents<H: Hydrodynamics>(system: &System<H>) -> Vec<[f64; 2]> {
    let on_grid = system.hydrodynamics().fluid_view().spacing.is_some();
    droplets(system).map(|droplet| [area(droplet, on_grid), droplet.particle_numbers().iter().sum()]).collect()
}

/// How much area and particles of the droplets of `system` have changed, the droplet that changed most, since they were
/// `start`.
fn drift<H: Hydrodynamics>(system: &System<H>, start: &[[f64; 2]]) -> Drift {
    let larger = |a: f64, b: f64| if b.is_nan() || b.abs() > a.abs() { b } else { a };
    contents(system).iter().zip(start).fold(Drift::default(), |drift, (now, start)| {
        let particles = if start[1] > 0.0 { now[1] / start[1] - 1.0 } else { 0.0 };
        Drift { area: larger(drift.area, now[0] / start[0] - 1.0), particles: larger(drift.particles, particles) }
    })
}

/// Most steps of a run: a case that needs more has gone wrong.
const MOST: usize = 2_000_000;

/// Runs a scene to time `until`.
pub(crate) fn run(mut scene: Scene<AnyFlow>, until: f64, step: StepSize, look: Look<'_>) -> Outcome {
    measured(&mut scene, look, |scene| scene.run(until).step_size(step).most_steps(MOST).go())
}

/// Runs a scene as `body` does, which leaves it in the last state.
pub(crate) fn measured(
    scene: &mut Scene<AnyFlow>,
    look: Look<'_>,
    body: impl FnOnce(&mut Scene<AnyFlow>) -> Result<(), motile::scene::SceneError>,
) -> Outcome {
    let start = contents(scene.system());
    let clock = Instant::now();
    let outcome = body(scene);
    let seconds = clock.elapsed().as_secs_f64();
    look(scene.system_mut());
    let report = scene.step_report();
    Outcome {
        ending: Ending::from(&outcome),
        explanation: outcome.err().map(|error| error.explanation()),
        time: scene.time(),
        steps: scene.steps(),
        rejected: report.rejections + report.failures,
        drift: drift(scene.system(), &start),
        seconds,
    }
}

/// Repulsion that holds films open in the cases that are held apart; a range of 0.2 R0 is two spacings or nodes.
pub(crate) fn held(range: f64) -> Repulsion {
    Repulsion::new(1000.0, range).expect("a repulsion")
}

/// Half of what is stable.
pub(crate) const AUTO: StepSize = StepSize::OfLimit(0.5);

/// The steps of the adaptive runs.
pub(crate) const ADAPTIVE: StepSize = StepSize::Adaptive { tolerance: 1e-5 };

/// A scene that is described on a grid by one of the ways.
pub(crate) fn by(way: Way, base: &Setup) -> Setup {
    let mut setup = base.clone();
    match (way, &mut setup.method) {
        (Way::Integral, method) => *method = Method::Integral(IntegralMethod { nodes: 64, elements: 256 }),
        (Way::Thesis, method) => {
            let (spacing, marker_spacing) = match *method {
                Method::Grid(grid) => (grid.spacing, grid.marker_spacing),
                other => (other.spacing().unwrap_or(GridMethod::default().spacing), None),
            };
            *method = Method::Grid(GridMethod { spacing, marker_spacing, ..GridMethod::thesis() });
            for droplet in &mut setup.droplets {
                droplet.motion = Motion::WithFluid;
                droplet.area_constraint = true;
                droplet.particles = droplet.particles.map(|particles| Particles { flux: Flux::Upwind, ..particles });
            }
        }
        _ => {}
    }
    setup
}

/// Runs a scene by one of the ways.
pub(crate) fn run_way(way: Way, scene: Scene<AnyFlow>, until: f64, look: Look<'_>) -> Result<Outcome, CaseError> {
    Ok(match way {
        Way::Chebyshev => run(scene.advanced_by(RungeKuttaChebyshev::new()), until, ADAPTIVE, look),
        _ => run(scene, until, AUTO, look),
    })
}

//! Growth rates in unbounded fluid.

use std::f64::consts::TAU;

use motile::Swimmer;
use motile::boundary_integral::{BoundaryIntegral, Region, Settings};
use motile::ib_core::{Scene, StepSize};

use crate::validation::StudyError;
use crate::validation::growth::{Mode, amplitude, perturbed};

/// Amplitude: what is of second order cancels between both signs, and third orders are the square of this.
const EPSILON: f64 = 1e-5;
/// How long it is watched (time), and in how many steps.
const DURATION: f64 = 0.1;
const STEPS: f64 = 100.0;

/// The rate (1/time) at which a mode grows on a round droplet with `cells` cells in unbounded fluid.
///
/// # Errors
/// What a run can fail with.
pub fn growth_rate(swimmer: &Swimmer, mode: Mode, cells: usize) -> Result<f64, StudyError> {
    // A perturbed droplet is made for a grid, with two markers a spacing.
    let swimmer = Swimmer { spacing: 2.0 * TAU * swimmer.radius / cells as f64, ..swimmer.clone() };
    let mut amplitudes = [0.0; 2];
    for epsilon in [EPSILON, -EPSILON] {
        let settings = Settings { nodes: swimmer.nodes, tolerance: 1e-11, ..Settings::default() };
        let mut scene = Scene::new(BoundaryIntegral::new(Region::Plane, swimmer.viscosity, settings)?);
        let droplet = scene.add(perturbed(&swimmer, mode, epsilon)?);
        amplitudes[0] += epsilon.signum() * amplitude(scene.body(droplet)?, mode)?;
        scene.run(DURATION).step_size(StepSize::Fixed(DURATION / STEPS)).go()?;
        amplitudes[1] += epsilon.signum() * amplitude(scene.body(droplet)?, mode)?;
    }
    Ok((amplitudes[1] / amplitudes[0]).ln() / DURATION)
}

/// The same for infinitely many cells, from `cells` and twice as many: the error of the cells is of second order.
///
/// # Errors
/// What a run can fail with.
pub fn growth_rate_limit(swimmer: &Swimmer, mode: Mode, cells: usize) -> Result<f64, StudyError> {
    let coarse = growth_rate(swimmer, mode, cells)?;
    Ok((4.0 * growth_rate(swimmer, mode, 2 * cells)? - coarse) / 3.0)
}

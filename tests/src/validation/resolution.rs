//! The threshold of swimming, and what the marker spacing has to resolve.

use motile::scene::StepSize;
use motile::setup::{Built, DropletSetup, GridMethod, Method, Particles, Setup, Start};

use crate::validation::StudyError;
use crate::validation::scene::on_grid;
use crate::validation::swimmers::speeds;

/// Fate of a uniform droplet with a small perturbation.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Perturbed {
    /// When it was looked at last.
    pub time: f64,
    /// Largest speed before half of that time.
    pub largest_early_speed: f64,
    /// Speed then.
    pub speed: f64,
    /// True if it swims: faster at the end than at any time in the first half, and not merely by round-off.
    pub swims: bool,
}

/// Runs a droplet of viscosity 100 in a 6 x 6 box from a perturbation of 5 per cent to `time`. Linear theory puts the
/// threshold of activity at -0.4 (Cowley (2.20)).
///
/// # Errors
/// Those of a run.
pub fn perturbed(activity: f64, h: f64, time: f64) -> Result<Perturbed, StudyError> {
    let start = Start::Perturbed { amplitude: 0.05, seed: 1 };
    let particles = Some(Particles { activity, start, ..Particles::default() });
    let setup = Setup { droplets: vec![DropletSetup { particles, ..DropletSetup::default() }], ..on_grid(h) };
    let looks: Vec<f64> = (0..=20).map(|part| time * f64::from(part) / 40.0).chain([time]).collect();
    let speeds = speeds(&setup, &looks)?;
    let largest_early_speed = speeds[..=20].iter().fold(0.0_f64, |most, speed| most.max(*speed));
    let speed = speeds[21];
    Ok(Perturbed { time, largest_early_speed, speed, swims: speed > largest_early_speed && speed > 1e-3 })
}

/// Speed of a low-viscosity swimmer with a sharp edge of the concentration, and whether the droplet warns of it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct MarkerSpacing {
    /// Speed at t = 3.
    pub speed: f64,
    /// Element Peclet number then.
    pub peclet: f64,
    /// True if the droplet warned of it.
    pub warned: bool,
}

/// Viscosity 10, activity -2, A = 10, h = 0.1, markers `ds` apart, to t = 3.
///
/// # Errors
/// Those of a run.
pub fn marker_spacing(ds: f64) -> Result<MarkerSpacing, StudyError> {
    let grid = GridMethod { marker_spacing: Some(ds), ..GridMethod::of_spacing(0.1) };
    let setup = Setup { viscosity: 10.0, method: Method::Grid(grid), ..Setup::default() };
    let Built { mut scene, droplets, .. } = setup.build()?;
    scene.run(3.0).step_size(StepSize::OfLimit(0.25)).go()?;
    let speed = scene.observe(droplets[0])?.speed();
    let droplet = scene.body(droplets[0])?;
    let warned = droplet.element_peclet() > 0.35;
    Ok(MarkerSpacing { speed, peclet: droplet.element_peclet(), warned })
}

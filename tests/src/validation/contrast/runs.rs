//! How a droplet of another viscosity loses or gains its polarisation.

use motile::Swimmer;
use motile::boundary_integral::{BoundaryIntegral, Region, Settings};
use motile::ib_core::{Hydrodynamics, Peskin4, Scene, SmearedContrast, StepSize};
use motile::stokes_grid::{Grid, PeriodicStokes};

use crate::validation::StudyError;
use crate::validation::growth::{Mode, amplitude, perturbed};
use crate::validation::swimmers::look;

/// Amplitude: second-order effects are the square of this.
const EPSILON: f64 = 1e-3;
/// How long it is watched (time).
const DURATION: f64 = 1.0;

/// How the flow is computed.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Way {
    /// Without a grid, which is exact.
    WithoutGrid,
    /// On the grid with a double layer.
    Sharp,
    /// On the grid with a smeared viscosity, the thesis' way.
    Smeared,
}

/// The rate (1/time) at which the first mode of the concentration of a round droplet of `swimmer` grows in its box: of
/// the difference of two runs with opposite perturbations.
///
/// # Errors
/// What a run can fail with.
pub fn growth(swimmer: &Swimmer, way: Way) -> Result<f64, StudyError> {
    let mut ends = [0.0; 2];
    let mut starts = [0.0; 2];
    for ((start, end), epsilon) in starts.iter_mut().zip(&mut ends).zip([EPSILON, -EPSILON]) {
        let (base, before) = match way {
            Way::WithoutGrid => {
                let [lx, ly] = swimmer.lengths;
                let region = Region::Box { lengths: [lx, ly] };
                let flow = BoundaryIntegral::new(region, swimmer.viscosity, Settings::default())?;
                run(&mut Scene::new(flow), swimmer, epsilon)?
            }
            Way::Sharp => run(&mut swimmer.scene()?, swimmer, epsilon)?,
            Way::Smeared => {
                let [nx, ny] = swimmer.lengths.map(|length| (length / swimmer.spacing).round() as usize);
                let solver = PeriodicStokes::new(Grid::periodic(nx, ny, swimmer.spacing)?, swimmer.viscosity)?;
                let flow = SmearedContrast::with_tolerance(solver, Peskin4, 1e-8)?;
                run(&mut Scene::new(flow), swimmer, epsilon)?
            }
        };
        (*start, *end) = (base, before);
    }
    Ok(((ends[0] - ends[1]) / (starts[0] - starts[1])).ln() / DURATION)
}

fn run<H: Hydrodynamics>(scene: &mut Scene<H>, swimmer: &Swimmer, epsilon: f64) -> Result<(f64, f64), StudyError> {
    let mode = Mode::Concentration(1);
    let droplet = scene.add(perturbed(swimmer, mode, epsilon)?);
    let start = amplitude(scene.body(droplet)?, mode)?;
    scene.run(DURATION).step_size(StepSize::Fixed(DURATION / 20.0)).go()?;
    Ok((start, amplitude(scene.body(droplet)?, mode)?))
}

/// Speeds of a swimmer at given times, by the method that it names.
///
/// # Errors
/// What a run can fail with.
pub fn decaying_speeds(swimmer: &Swimmer, times: &[f64]) -> Result<Vec<f64>, StudyError> {
    let (mut scene, droplet) = swimmer.build()?;
    let mut speeds = Vec::new();
    for &time in times {
        scene.run(time).go()?;
        speeds.push(look(&mut scene, droplet)?.speed());
    }
    Ok(speeds)
}

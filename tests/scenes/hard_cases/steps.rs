//! Time steps that are far too large.

use motile::scene::{Scene, StepSize};
use motile::setup::{AnyFlow, GridMethod, Method, Setup};

use crate::hard_cases::drive::{by, measured, run};
use crate::hard_cases::{CaseError, Ending, Look, Outcome, Recipe, Trial, Way, expand};

/// A scene and its longest stable step.
fn scene(way: Way) -> Result<(Scene<AnyFlow>, f64), CaseError> {
    let setup = Setup { method: Method::Grid(GridMethod::of_spacing(0.1)), ..Setup::default() };
    let scene = by(way, &setup).build()?.scene;
    let limit = scene.step_limit().map_or(1.0, |(limit, ..)| limit);
    Ok((scene, limit))
}

/// A run with steps of that many times the stable one: refused before it starts.
fn refused(times: f64, way: Way, look: Look<'_>) -> Result<Outcome, CaseError> {
    let (scene, limit) = scene(way)?;
    Ok(run(scene, 1000.0 * limit, StepSize::Fixed(times * limit), look))
}

/// Steps taken by hand, where nothing refuses them.
fn forced(times: f64, way: Way, look: Look<'_>) -> Result<Outcome, CaseError> {
    let (mut scene, limit) = scene(way)?;
    Ok(measured(&mut scene, look, |scene| (0..200).try_for_each(|_| scene.step(times * limit))))
}

/// Whatever goes wrong first.
const BROKEN: &[Ending] =
    &[Ending::SelfCrossing, Ending::Crossing, Ending::NotConserved, Ending::NonFinite, Ending::NotConverged];

pub(crate) fn trials() -> Vec<Trial> {
    let ways: &[Way] = &[Way::Grid, Way::Integral, Way::Thesis];
    let recipe = |name, expected, run| Recipe::new(14, name, ways, run).ending_in(expected);
    expand(&[
        recipe("a time step 10 times too large", &[Ending::StepTooLarge], |way, _, look| refused(10.0, way, look)),
        recipe("a time step 1000 times too large", &[Ending::StepTooLarge], |way, _, look| refused(1000.0, way, look)),
        recipe("10 times too large, taken by hand", BROKEN, |way, _, look| forced(10.0, way, look)),
        recipe("1000 times too large, taken by hand", BROKEN, |way, _, look| forced(1000.0, way, look)),
    ])
}

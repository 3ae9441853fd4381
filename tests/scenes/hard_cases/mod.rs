//! Scenes that are hard to compute: what is hard about each, and what must come of it.
//!
//! [`cases`] lists them. Each is a number of runs, by the methods that apply, in a quick version for tests and a longer
//! one for the table of the documents ([`crate::suite`]). A run must finish with its area and particles, or end in the
//! error that is right for it; nothing else counts.

mod drive;
mod droplets;
mod ending;
mod pairs;
mod shapes;
mod steps;
mod units;
mod walls;
mod weight;

pub(crate) use drive::Drift;
pub(crate) use ending::{CaseError, Ending};
pub(crate) use weight::Weight;

use std::fmt;

use motile::scene::System;
use motile::setup::AnyFlow;

/// How long runs are.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Extent {
    /// Seconds at most, for tests.
    Quick,
    /// Long enough to show creep and late failures, for the table.
    Long,
}

impl Extent {
    /// One of two values.
    pub(crate) fn pick<T>(self, quick: T, long: T) -> T {
        match self {
            Self::Quick => quick,
            Self::Long => long,
        }
    }
}

/// How a run is computed.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Way {
    /// On a grid, by the accurate method.
    Grid,
    /// Without a grid.
    Integral,
    /// On a grid, by the method of Cowley, with steps of half the stability limit.
    Thesis,
    /// On a grid, by the Runge-Kutta-Chebyshev method with adaptive steps.
    Chebyshev,
}

impl fmt::Display for Way {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.pad(match self {
            Self::Grid => "immersed boundary",
            Self::Integral => "boundary integral",
            Self::Thesis => "thesis",
            Self::Chebyshev => "RKC, adaptive",
        })
    }
}

/// Result of a run.
#[derive(Debug)]
pub(crate) struct Outcome {
    /// How it ended.
    pub(crate) ending: Ending,
    /// The error in full, if there was one.
    pub(crate) explanation: Option<String>,
    /// Time reached.
    pub(crate) time: f64,
    /// Steps.
    pub(crate) steps: usize,
    /// Steps rejected and retried.
    pub(crate) rejected: usize,
    /// Changes.
    pub(crate) drift: Drift,
    /// Wall clock time (seconds).
    pub(crate) seconds: f64,
}

/// Looks at the last state of a run.
pub(crate) type Look<'a> = &'a mut dyn FnMut(&mut System<AnyFlow>);

/// One run of a case.
pub(crate) struct Trial {
    /// Number of the case.
    pub(crate) number: usize,
    /// Difficulty.
    pub(crate) name: &'static str,
    /// How it is computed.
    pub(crate) way: Way,
    /// Endings that are right; `Finished` asks for area and particles too.
    pub(crate) expected: &'static [Ending],
    /// Largest relative change of the area of a run that finishes.
    pub(crate) area: f64,
    run: fn(Way, Extent, Look<'_>) -> Result<Outcome, CaseError>,
}

impl fmt::Debug for Trial {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "case {} ({}), {}", self.number, self.name, self.way)
    }
}

/// Largest relative change of the number of particles.
pub(crate) const PARTICLES: f64 = 1e-9;

impl Trial {
    /// Runs it; `look` sees the last state.
    ///
    /// # Errors
    /// A scene that could not be made, unless that is what is right for it.
    pub(crate) fn run(&self, extent: Extent, look: Look<'_>) -> Result<Outcome, CaseError> {
        (self.run)(self.way, extent, look)
    }

    /// Fault of an outcome, if there is one.
    pub(crate) fn complaint(&self, outcome: &Outcome) -> Option<String> {
        if !self.expected.contains(&outcome.ending) {
            let why = outcome.explanation.as_deref().unwrap_or_default();
            return Some(format!("{self:?} ended as {:?}, not as one of {:?}: {why}", outcome.ending, self.expected));
        }
        let Drift { area, particles, .. } = outcome.drift;
        if outcome.ending == Ending::Finished && !(area.abs() <= self.area && particles.abs() <= PARTICLES) {
            return Some(format!("{self:?} changed its area by {area:e} and its particles by {particles:e}"));
        }
        None
    }
}

/// All runs of all cases, in their order.
pub(crate) fn cases() -> Vec<Trial> {
    let mut all = droplets::trials();
    all.extend(shapes::trials());
    all.extend(pairs::trials());
    all.extend(walls::trials());
    all.extend(steps::trials());
    all.extend(units::trials());
    all.sort_by_key(|trial| trial.number);
    all
}

/// Maker of [`Trial`]s of one case.
pub(crate) struct Recipe {
    number: usize,
    name: &'static str,
    ways: &'static [Way],
    expected: &'static [Ending],
    area: f64,
    run: fn(Way, Extent, Look<'_>) -> Result<Outcome, CaseError>,
}

/// Largest relative change of the area unless a case says otherwise.
const AREA: f64 = 1e-3;

impl Recipe {
    /// Runs that finish, with their area to [`AREA`].
    pub(crate) fn new(
        number: usize,
        name: &'static str,
        ways: &'static [Way],
        run: fn(Way, Extent, Look<'_>) -> Result<Outcome, CaseError>,
    ) -> Self {
        Self { number, name, ways, expected: &[Ending::Finished], area: AREA, run }
    }

    /// The same, other endings being right.
    pub(crate) fn ending_in(self, expected: &'static [Ending]) -> Self {
        Self { expected, ..self }
    }

    /// Trial with another bound on the area.
    pub(crate) fn area_within(self, area: f64) -> Self {
        Self { area, ..self }
    }
}

pub(crate) fn expand(recipes: &[Recipe]) -> Vec<Trial> {
    let trial = |recipe: &Recipe, way: Way| {
        let &Recipe { number, name, expected, area, run, .. } = recipe;
        Trial { number, name, way, expected, area, run }
    };
    recipes.iter().flat_map(|recipe| recipe.ways.iter().map(move |&way| trial(recipe, way))).collect()
}

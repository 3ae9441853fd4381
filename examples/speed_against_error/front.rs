//! Which settings are worth their cost.

use support::Summary;

use crate::lists::series;
use crate::settings::Settings;
use crate::studies::Study;

/// What came out.
#[derive(Debug, Clone)]
pub(crate) struct Point {
    pub(crate) study: Study,
    pub(crate) settings: Settings,
    pub(crate) summary: Summary,
}

impl Point {
    /// Size of the error.
    pub(crate) fn error(&self) -> f64 {
        self.summary.number("error").abs()
    }

    /// Transforms per unit of simulated time.
    pub(crate) fn pairs(&self) -> f64 {
        self.summary.number("pairs_per_time")
    }
}

/// The points of the front: nothing is both cheaper and more accurate. Cheapest first.
pub(crate) fn front(points: &[Point]) -> Vec<&Point> {
    let mut sorted: Vec<&Point> = points.iter().collect();
    sorted.sort_by(|a, b| a.pairs().total_cmp(&b.pairs()));
    let mut least = f64::INFINITY;
    sorted.retain(|point| {
        let better = point.error() < least;
        least = least.min(point.error());
        better
    });
    sorted
}

/// The cheapest point whose error is at most `target`, as is that of all refinements of it that were tried: an error may also be
/// small by chance.
pub(crate) fn cheapest<'a>(points: &[&'a Point], target: f64) -> Option<&'a Point> {
    let holds = |point: &&&Point| {
        let own = series(&point.settings);
        points
            .iter()
            .filter(|other| series(&other.settings) == own && other.pairs() >= point.pairs())
            .all(|other| other.error() <= target)
    };
    points.iter().filter(holds).min_by(|a, b| a.pairs().total_cmp(&b.pairs())).copied()
}

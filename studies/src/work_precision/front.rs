//! Which settings are worth their cost.

use motile_cli::run::Summary;

use crate::work_precision::lists::series;
use crate::work_precision::settings::{Flow, Settings};
use crate::work_precision::studies::Study;

/// Results.
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

/// The cheapest point whose error is at most `target`, as is that of all refinements of it that were tried: an error
/// may also be small by chance.
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

/// Cost of an error.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Expense {
    /// Transforms per unit of simulated time.
    pub(crate) pairs: f64,
    /// Spacing and order in it, if nothing so accurate was run.
    pub(crate) extrapolated: Option<(f64, f64)>,
}

/// How many times finer a grid than the finest is still extrapolated to.
const FURTHEST: f64 = 16.0;

/// The least cost for an error of `target`, by [`cheapest`], or, where no grid was fine enough, extrapolated from the
/// finest grid of a series in which the error falls and the next one about twice as coarse: powers of the spacing for
/// both error and cost.
pub(crate) fn expense(points: &[&Point], target: f64) -> Option<Expense> {
    if let Some(point) = cheapest(points, target) {
        return Some(Expense { pairs: point.pairs(), extrapolated: None });
    }
    let further = |point: &&Point| -> Option<Expense> {
        let Flow::Grid { h, .. } = point.settings.flow else { return None };
        let spacing = |other: &Point| match other.settings.flow {
            Flow::Grid { h, .. } => h,
            Flow::Integrals { .. } => f64::NAN,
        };
        let own = series(&point.settings);
        let coarser = points
            .iter()
            .filter(|other| series(&other.settings) == own && spacing(other) > 1.6 * h)
            .min_by(|a, b| spacing(a).total_cmp(&spacing(b)))?;
        let finer = points.iter().any(|other| series(&other.settings) == own && spacing(other) < h);
        let ratio = (spacing(coarser) / h).ln();
        let order = (coarser.error() / point.error()).ln() / ratio;
        let growth = (point.pairs() / coarser.pairs()).ln() / ratio;
        let factor = (point.error() / target).powf(1.0 / order);
        let falls = !finer && point.error() > target && order > 0.3 && growth > 0.0 && factor < FURTHEST;
        falls.then(|| Expense { pairs: point.pairs() * factor.powf(growth), extrapolated: Some((h / factor, order)) })
    };
    points.iter().filter_map(further).min_by(|a, b| a.pairs.total_cmp(&b.pairs))
}

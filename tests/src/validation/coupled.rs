//! Convergence of the coupled problem in space and time, against the exact solution of a round swimmer.

use motile::setup::{GridMethod, IntegralMethod, LayersMethod, Method};

use super::StudyError;
use super::round_swimmer::{DEFAULT, Measured};

/// Time to which the swimmer sharpens from a tenth to about a half of its sharpest state.
pub const TIME: f64 = 4.0;

/// Methods at several resolutions and steps, coarse ones first, each half of the one before.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Refinement {
    /// The name of the method.
    pub method: &'static str,
    /// True for finer elements or grids, false for shorter steps.
    pub in_space: bool,
    /// Resolutions and steps.
    pub levels: [(Method, f64); 3],
}

/// One row: what was refined, its errors, and the orders since the row before.
#[derive(Debug, Clone, PartialEq)]
pub struct Row {
    /// Resolution in words.
    pub resolution: String,
    /// Step (time).
    pub dt: f64,
    /// Errors of the first modes of the concentration over the first of them, and of the displacement.
    pub errors: [f64; 2],
    /// Orders of both: in space of the errors, in time of the changes with the step, to which errors in space do not
    /// belong. So the first row has none in space, and the first two have none in time.
    pub orders: Option<[f64; 2]>,
}

const fn integral(elements: usize) -> Method {
    Method::Integral(IntegralMethod { nodes: 48, elements })
}

fn layers(elements: usize) -> Method {
    Method::Layers(LayersMethod { nodes: 48, elements, ..LayersMethod::of_spacing(0.2) })
}

fn grid(spacing: f64) -> Method {
    Method::Grid(GridMethod::of_spacing(spacing))
}

fn thesis(spacing: f64) -> Method {
    Method::Grid(GridMethod { spacing, ..GridMethod::thesis() })
}

/// All refinements of the table.
#[must_use]
pub fn refinements() -> Vec<Refinement> {
    let in_space = |method, levels: [Method; 3], dt: f64| Refinement {
        method,
        in_space: true,
        levels: levels.map(|level| (level, dt)),
    };
    let in_time = |method, level: Method| Refinement {
        method,
        in_space: false,
        levels: [0.1, 0.05, 0.025].map(|dt| (level, dt)),
    };
    vec![
        in_space("boundary integrals", [48, 96, 192].map(integral), 0.005),
        in_space("layers", [48, 96, 192].map(layers), 0.005),
        in_space("grid, corrected", [0.2, 0.1, 0.05].map(grid), 0.0125),
        in_space("Cowley's scheme", [0.2, 0.1, 0.05].map(thesis), 0.0125),
        in_time("boundary integrals", integral(384)),
        in_time("layers", layers(384)),
        in_time("grid, corrected", grid(0.1)),
    ]
}

/// Returns the resolution of a method in words.
#[must_use]
pub fn resolution(method: &Method) -> String {
    match method {
        Method::Grid(grid) => format!("h = {}", grid.spacing),
        Method::Integral(IntegralMethod { elements, .. }) | Method::Layers(LayersMethod { elements, .. }) => {
            format!("{elements} elements")
        }
        _ => String::new(),
    }
}

impl Refinement {
    /// Runs all levels.
    ///
    /// # Errors
    /// Those of a run.
    pub fn rows(&self) -> Result<Vec<Row>, StudyError> {
        let exact = DEFAULT.exact(TIME);
        let found: Result<Vec<Measured>, StudyError> =
            self.levels.iter().map(|&(method, dt)| DEFAULT.unbounded(method, TIME, dt)).collect();
        let found = found?;
        let order = |before: [f64; 2], after: [f64; 2]| [0, 1].map(|k| (before[k] / after[k]).log2());
        let error = |k: usize| found[k].distance(&exact, &exact);
        let change = |k: usize| found[k].distance(&found[k - 1], &exact);
        let orders = |k: usize| match (self.in_space, k) {
            (_, 0) | (false, 1) => None,
            (true, _) => Some(order(error(k - 1), error(k))),
            (false, _) => Some(order(change(k - 1), change(k))),
        };
        let row = |(k, &(method, dt)): (usize, &(Method, f64))| Row {
            resolution: resolution(&method),
            dt,
            errors: error(k),
            orders: orders(k),
        };
        Ok(self.levels.iter().enumerate().map(row).collect())
    }
}

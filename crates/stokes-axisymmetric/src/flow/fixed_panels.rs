//! Quadrature along a meridian that keeps its shape, for targets far away from its panels.

use std::{f64::consts::PI, ops::Range};

use motile_base::internal::gauss_legendre;

use super::waves::{Point, Waves};

/// Gauss-Legendre points of a panel.
pub(super) const POINTS: usize = 16;
/// Length of the longest panels, in spacings of the nodes.
pub(super) const LONGEST: f64 = 6.0;
/// Minimum distance of a target from panels that are not made for it, over their length.
const APART: f64 = 0.7;

/// Returns the points and weights of the Gauss-Legendre rule on (0, 1).
pub(super) fn gauss(count: usize) -> Vec<(f64, f64)> {
    gauss_legendre(count).into_iter().map(|(x, weight)| (0.5 * (1.0 + x), 0.5 * weight)).collect()
}

/// A point of the panels of a surface that keeps its shape.
#[derive(Debug, Clone)]
pub(super) struct Fixed {
    pub(super) weight: f64,
    pub(super) point: Point,
    pub(super) waves: Waves,
}

/// Panels of a surface that keeps its shape, as a wall does, for targets far away from them: their points serve all
/// targets.
#[derive(Debug, Clone, Default)]
pub(super) struct FixedPanels {
    /// Number of panels, of equal length in the parameter.
    pub(super) count: usize,
    pub(super) points: Vec<Fixed>,
}

impl FixedPanels {
    /// Returns the panels of the longest kind, and points on them.
    pub(super) fn new(nodes: usize, at: impl Fn(&Waves) -> Point) -> Self {
        let count = (nodes as f64 / LONGEST).ceil() as usize;
        let length = PI / count as f64;
        let gauss = gauss(POINTS);
        let panels = (0..count).flat_map(|panel| gauss.iter().map(move |(u, weight)| (panel as f64 + u, weight)));
        let point = |(place, weight): (f64, &f64)| {
            let mut waves = Waves::new(nodes + 1);
            waves.fill(length * place);
            Fixed { weight: length * weight, point: at(&waves), waves }
        };
        Self { count, points: panels.map(point).collect() }
    }

    /// Returns the panels that are too close to a foot: others are at least a part [`APART`] of their length away.
    pub(super) fn near(&self, foot: f64) -> Range<usize> {
        let place = foot / PI * self.count as f64;
        let [first, last] = [place - APART, place + APART].map(|end| end.max(0.0) as usize);
        first.min(self.count)..(last + 1).min(self.count)
    }
}

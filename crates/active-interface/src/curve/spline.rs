//! Smooth curves through points, closed or periodic.

use motile_base::Vec2;

use crate::{InterfaceError, tridiagonal::CyclicTridiagonal};

/// Cubic spline, twice continuously differentiable, through the points of a polygon that is closed or advances in each
/// period, with the length along the polygon as parameter.
#[derive(Debug, Clone)]
pub(crate) struct PeriodicSpline {
    /// The points of a period and the next image of the first.
    points: Vec<Vec2>,
    /// Second derivatives at the points.
    bends: Vec<Vec2>,
    /// Parameter at the points, and the whole length at the end.
    knots: Vec<f64>,
}

impl PeriodicSpline {
    /// Creates the spline through at least three points, no two successive ones the same, advancing by `advance` in a
    /// period (length; zero for a closed one).
    pub(crate) fn new(given: &[Vec2], advance: Vec2) -> Result<Self, InterfaceError> {
        let m = given.len();
        let mut points = given.to_vec();
        points.extend(given.first().map(|first| first + advance));
        let chords: Vec<f64> = points.windows(2).map(|pair| (pair[1] - pair[0]).length()).collect();
        if let Some(index) = chords.iter().position(|&chord| chord == 0.0) {
            return Err(InterfaceError::coincident_points(index));
        }
        let before = |k: usize| (k + m - 1) % m;
        let lower: Vec<f64> = (0..m).map(|k| chords[before(k)] / 6.0).collect();
        let upper: Vec<f64> = chords.iter().map(|chord| chord / 6.0).collect();
        let diagonal: Vec<f64> = (0..m).map(|k| (chords[before(k)] + chords[k]) / 3.0).collect();
        let mut plan = CyclicTridiagonal::new(m);
        let mut bends = vec![Vec2::ZERO; m];
        for axis in 0..2 {
            let slope = |k: usize| (points[k + 1][axis] - points[k][axis]) / chords[k];
            let mut x: Vec<f64> = (0..m).map(|k| slope(k) - slope(before(k))).collect();
            plan.solve(&lower, &diagonal, &upper, &mut x);
            for (bend, x) in bends.iter_mut().zip(x) {
                bend[axis] = x;
            }
        }
        let mut knots = vec![0.0; m + 1];
        for k in 0..m {
            knots[k + 1] = knots[k] + chords[k];
        }
        Ok(Self { points, bends, knots })
    }

    /// Returns the position and its derivative by the parameter on piece k, at the fraction x of the piece.
    pub(crate) fn piece(&self, k: usize, x: f64) -> (Vec2, Vec2) {
        let m = self.bends.len();
        let h = self.knots[k + 1] - self.knots[k];
        let (p, q) = (self.points[k], self.points[k + 1]);
        let (a, b) = (self.bends[k] * (h * h / 6.0), self.bends[(k + 1) % m] * (h * h / 6.0));
        let y = 1.0 - x;
        let position = p * y + q * x + a * (y * y * y - y) + b * (x * x * x - x);
        let derivative = (q - p - a * (3.0 * y * y - 1.0) + b * (3.0 * x * x - 1.0)) / h;
        (position, derivative)
    }

    /// Returns the length of the chord of piece k (length).
    pub(crate) fn chord(&self, k: usize) -> f64 {
        self.knots[k + 1] - self.knots[k]
    }

    /// Returns the piece at the fraction `t` in [0, 1] of the parameter.
    pub(crate) fn piece_at(&self, t: f64) -> usize {
        let m = self.bends.len();
        self.knots[1..m].partition_point(|&knot| knot <= t * self.knots[m])
    }

    /// Returns the point at the fraction `t` in [0, 1] of the parameter.
    pub(crate) fn point(&self, t: f64) -> Vec2 {
        let (u, k) = (t * self.knots[self.bends.len()], self.piece_at(t));
        self.piece(k, (u - self.knots[k]) / (self.knots[k + 1] - self.knots[k])).0
    }

    /// Returns the signed area: three-point Gauss quadrature, exact for the pieces' polynomials.
    pub(crate) fn area(&self) -> f64 {
        let origin = self.points[0];
        let offset = 0.5 * 0.6f64.sqrt();
        let nodes = [(0.5 - offset, 5.0 / 18.0), (0.5, 4.0 / 9.0), (0.5 + offset, 5.0 / 18.0)];
        let mut sum = 0.0;
        for k in 0..self.bends.len() {
            let h = self.knots[k + 1] - self.knots[k];
            for (x, weight) in nodes {
                let (position, derivative) = self.piece(k, x);
                sum += 0.5 * weight * h * (position - origin).perp_dot(derivative);
            }
        }
        sum
    }
}

#[cfg(test)]
mod tests;

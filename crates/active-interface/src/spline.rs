//! Smooth closed curves through points.

use ib_core::Vec2;

use crate::polygon::{cross, edges};
use crate::{CyclicTridiagonal, InterfaceError};

/// The twice continuously differentiable cubic spline through the points of a closed polygon, in the length of the
/// polygon as parameter.
#[derive(Debug, Clone)]
pub(crate) struct PeriodicSpline {
    points: Vec<Vec2>,
    /// Second derivatives at the points.
    bends: Vec<Vec2>,
    /// Parameter at the points, and the whole length at the end.
    knots: Vec<f64>,
}

impl PeriodicSpline {
    /// Through at least three points, no two successive ones the same.
    pub(crate) fn new(points: &[Vec2]) -> Result<Self, InterfaceError> {
        let m = points.len();
        let chords: Vec<f64> = edges(points).map(|(a, b)| (b - a).norm()).collect();
        if let Some(index) = chords.iter().position(|&chord| chord == 0.0) {
            return Err(InterfaceError::CoincidentPoints { index });
        }
        let before = |k: usize| (k + m - 1) % m;
        let lower: Vec<f64> = (0..m).map(|k| chords[before(k)] / 6.0).collect();
        let upper: Vec<f64> = chords.iter().map(|chord| chord / 6.0).collect();
        let diagonal: Vec<f64> = (0..m).map(|k| (chords[before(k)] + chords[k]) / 3.0).collect();
        let mut plan = CyclicTridiagonal::new(m)?;
        let mut bends = vec![Vec2::zeros(); m];
        for axis in 0..2 {
            let slope = |k: usize| (points[(k + 1) % m][axis] - points[k][axis]) / chords[k];
            let mut x: Vec<f64> = (0..m).map(|k| slope(k) - slope(before(k))).collect();
            plan.solve(&lower, &diagonal, &upper, &mut x)?;
            for (bend, x) in bends.iter_mut().zip(x) {
                bend[axis] = x;
            }
        }
        let mut knots = vec![0.0; m + 1];
        for k in 0..m {
            knots[k + 1] = knots[k] + chords[k];
        }
        Ok(Self { points: points.to_vec(), bends, knots })
    }

    /// Position and its derivative by the parameter on piece k, at the fraction x of the piece.
    fn piece(&self, k: usize, x: f64) -> (Vec2, Vec2) {
        let m = self.points.len();
        let h = self.knots[k + 1] - self.knots[k];
        let (p, q) = (self.points[k], self.points[(k + 1) % m]);
        let (a, b) = (self.bends[k] * (h * h / 6.0), self.bends[(k + 1) % m] * (h * h / 6.0));
        let y = 1.0 - x;
        let position = p * y + q * x + a * (y * y * y - y) + b * (x * x * x - x);
        let derivative = (q - p - a * (3.0 * y * y - 1.0) + b * (3.0 * x * x - 1.0)) / h;
        (position, derivative)
    }

    /// The point at the fraction `t` in [0, 1] of the parameter.
    pub(crate) fn point(&self, t: f64) -> Vec2 {
        let m = self.points.len();
        let u = t * self.knots[m];
        let k = self.knots[1..m].partition_point(|&knot| knot <= u);
        self.piece(k, (u - self.knots[k]) / (self.knots[k + 1] - self.knots[k])).0
    }

    /// Signed area: three-point Gauss quadrature, exact for the pieces' polynomials.
    pub(crate) fn area(&self) -> f64 {
        let origin = self.points[0];
        let offset = 0.5 * 0.6f64.sqrt();
        let nodes = [(0.5 - offset, 5.0 / 18.0), (0.5, 4.0 / 9.0), (0.5 + offset, 5.0 / 18.0)];
        let mut sum = 0.0;
        for k in 0..self.points.len() {
            let h = self.knots[k + 1] - self.knots[k];
            for (x, weight) in nodes {
                let (position, derivative) = self.piece(k, x);
                sum += 0.5 * weight * h * cross(position - origin, derivative);
            }
        }
        sum
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::{PI, TAU};

    /// Errors of area and of the points between for a circle through n points.
    fn errors(n: usize) -> (f64, f64) {
        let points: Vec<Vec2> = (0..n)
            .map(|k| {
                let (s, c) = (TAU * k as f64 / n as f64).sin_cos();
                Vec2::new(3.0 + c, s)
            })
            .collect();
        let spline = PeriodicSpline::new(&points).unwrap();
        let off = (0..1000)
            .map(|i| ((spline.point(f64::from(i) / 1000.0) - Vec2::new(3.0, 0.0)).norm() - 1.0).abs())
            .fold(0.0, f64::max);
        ((spline.area() - PI).abs(), off)
    }

    #[test]
    fn fourth_order_on_a_circle() {
        let (coarse, fine) = (errors(20), errors(40));
        assert!((coarse.0 / fine.0).log2() > 3.8, "{coarse:?} {fine:?}");
        assert!((coarse.1 / fine.1).log2() > 3.8, "{coarse:?} {fine:?}");
        assert!(fine.1 < 1e-5);
    }

    #[test]
    fn goes_through_its_points_and_refuses_doubles() {
        let mut points: Vec<Vec2> =
            [[0.0, 0.0], [2.0, 0.1], [2.2, 1.5], [0.4, 1.1]].iter().map(|&[x, y]| Vec2::new(x, y)).collect();
        let spline = PeriodicSpline::new(&points).unwrap();
        for (point, knot) in points.iter().zip(&spline.knots) {
            assert!((spline.point(knot / spline.knots[4]) - point).norm() < 1e-14);
        }
        assert!((spline.point(1.0) - points[0]).norm() < 1e-14);
        points[2] = points[1];
        assert!(matches!(PeriodicSpline::new(&points), Err(InterfaceError::CoincidentPoints { index: 1 })));
    }
}

//! A point close to a curve: the fine node nearest to it, and its preimage under the complex parametrisation.

use std::f64::consts::TAU;

use motile_base::internal::spectrum::largest_wave;
use num_complex::Complex64;

use crate::{curve::Curve, transforms::REFINEMENT};

/// Newton iterations for a preimage: each doubles the digits, so that about five are enough from the nearest fine node;
/// after six times as many the iteration has strayed.
const MOST_ITERATIONS: usize = 30;
/// Largest step of the last iteration: the next one is about a hundred times its square, below round-off.
const LAST_STEP: f64 = 1e-9;
/// Largest distance of a preimage from the nearest node in the parameter, beyond one spacing, over the distance of the
/// point. The map of parameter to position is conformal, so the two are equal up to its distortion. Three times as far
/// is another preimage than the one that the kernels peak at, as curves with large last modes have them.
const FARTHEST: f64 = 3.0;
/// Distance in fine spacings within which a point may be on one side of the curve and on the other side of the polygon
/// through the fine nodes. A side of length s deviates by kappa s^2/8, 0.2 s at the largest curvature kappa = 1.6/s.
const ON_POLYGON: f64 = 0.2;
/// Distance in spacings below which a point counts as that far on the left of the curve: half of the digits, so that
/// quotients of distance and parameter keep the other half.
const LEAST_DISTANCE: f64 = 1e-9;
/// Largest distance of a fine node from the nearest of the nodes, in spacings of these. It is half a spacing along the
/// curve, and half as much again where fine nodes are farther apart than their neighbouring nodes.
const NEAR_NODE: f64 = 0.75;

/// Complex parameter of a point close to a curve.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Preimage {
    /// exp(i alpha_0).
    pub(super) unit: Complex64,
    /// On the left of the curve.
    pub(crate) inside: bool,
}

/// A point close to a curve.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Place {
    /// The point (length), of an open curve the image that is nearest to it; moved by round-off where it is on the
    /// curve.
    pub(crate) point: Complex64,
    /// Number of the fine node nearest to it.
    pub(crate) nearest: usize,
    /// `None` if plain weights have to do: the point is far enough for them to be exact, or no preimage is found.
    pub(crate) preimage: Option<Preimage>,
}

impl Place {
    /// Finds the place of `point` (length, relative to the centre of a curve whose fine nodes are ready); farther than
    /// `reach` fine spacings plain weights are exact. `squares` is working memory.
    pub(crate) fn find(curve: &Curve, point: Complex64, reach: f64, squares: &mut Vec<f64>) -> Self {
        squares.resize(curve.len(), 0.0);
        let least = curve.squares_from(point, squares);
        let (nearest, square) = nearest_fine(curve, point, least, squares);
        let node = curve.fine.position[nearest];
        let mut point = node - curve.wrap(node - point);
        let weight = TAU / curve.fine.position.len() as f64;
        let tangent = curve.fine.tangent[nearest];
        if square >= reach * reach * weight * weight * tangent.norm_sqr() {
            return Self { point, nearest, preimage: None };
        }
        let unit = Complex64::cis(weight * nearest as f64);
        let found = refine(curve, point, unit * (Complex64::new(0.0, 1.0) * ((point - node) / tangent)).exp());
        let found = found.filter(|found| is_plausible(curve, point, (nearest, square), unit, found));
        let preimage = if let Some(found) = found
            && (found.unit.norm_sqr().sqrt() - 1.0).abs() < LEAST_DISTANCE * weight
        {
            // On the curve to round-off: the kernels are taken just inside.
            point += Complex64::new(0.0, LEAST_DISTANCE) * tangent * weight;
            let unit = found.unit / found.unit.norm_sqr().sqrt() * (1.0 - LEAST_DISTANCE * weight);
            refine(curve, point, unit)
        } else {
            found
        };
        Self { point, nearest, preimage }
    }

    /// Returns true for a point known to lie on the left of the curve.
    pub(crate) fn is_left(&self) -> Option<bool> {
        self.preimage.map(|preimage| preimage.inside)
    }
}

/// Returns the fine node nearest to a point and the square of its distance, from the distances of the nodes, whose
/// minimum is known. It is next to a node that is at most so much farther than the nearest one, on the same arm of the
/// curve or another one.
fn nearest_fine(curve: &Curve, point: Complex64, least: f64, squares: &[f64]) -> (usize, f64) {
    let fine = &curve.fine.position;
    let bound = (least.sqrt() + NEAR_NODE * curve.spacing()).powi(2);
    let (mut nearest, mut square) = (0, f64::INFINITY);
    for (node, _) in squares.iter().enumerate().filter(|(_, square)| **square <= bound) {
        for step in 0..=REFINEMENT {
            let j = (REFINEMENT * node + fine.len() + step - REFINEMENT / 2) % fine.len();
            let found = curve.wrap(fine[j] - point).norm_sqr();
            if found < square {
                (nearest, square) = (j, found);
            }
        }
    }
    (nearest, square)
}

/// Returns true for the preimage that the kernels peak at, by its distance from the nearest node and by its side.
fn is_plausible(
    curve: &Curve,
    point: Complex64,
    (nearest, square): (usize, f64),
    unit: Complex64,
    found: &Preimage,
) -> bool {
    let (weight, tangent) = (TAU / curve.fine.position.len() as f64, curve.fine.tangent[nearest]);
    let farthest = weight + FARTHEST * (square / tangent.norm_sqr()).sqrt();
    if (found.unit - unit).norm_sqr() > farthest * farthest {
        return false;
    }
    let left = (tangent.conj() * (point - curve.fine.position[nearest])).im > 0.0;
    let on_polygon = ON_POLYGON * ON_POLYGON * weight * weight * tangent.norm_sqr();
    left == found.inside || curve.is_open() || square < on_polygon || found.inside == curve.polygon_contains(point)
}

/// Returns the preimage of a point under the parametrisation of a curve by Newton's method, from a first guess of exp(i
/// alpha).
fn refine(curve: &Curve, point: Complex64, start: Complex64) -> Option<Preimage> {
    let mut unit = start;
    for _ in 0..MOST_ITERATIONS {
        let (value, derivative) = evaluate(curve, unit);
        let step = curve.wrap(value - point) / derivative;
        let square = step.norm_sqr();
        if square > 4.0 || square.is_nan() {
            return None;
        }
        unit *= (-Complex64::new(0.0, 1.0) * step).exp();
        if square < LAST_STEP * LAST_STEP {
            return Some(Preimage { unit, inside: unit.norm_sqr() < 1.0 });
        }
    }
    None
}

/// Returns the position and its derivative by the parameter alpha at u = exp(i alpha), alpha complex.
fn evaluate(curve: &Curve, unit: Complex64) -> (Complex64, Complex64) {
    let shape = &curve.shape;
    let len = shape.len();
    let largest = largest_wave(len);
    let inverse = unit.inv();
    let (mut up, mut up_slope) = (Complex64::default(), Complex64::default());
    let (mut down, mut down_slope) = (Complex64::default(), Complex64::default());
    for m in (1..=largest).rev() {
        up = (up + shape[m]) * unit;
        up_slope = (up_slope + shape[m] * m as f64) * unit;
        down = (down + shape[len - m]) * inverse;
        down_slope = (down_slope + shape[len - m] * m as f64) * inverse;
    }
    let i = Complex64::new(0.0, 1.0);
    let (mut value, mut slope) = (shape[0] + up + down, i * (up_slope - down_slope));
    if curve.is_open() {
        value += curve.period * (-i * unit.ln() / TAU - 0.5);
        slope += curve.period / TAU;
    }
    (value, slope)
}

//! Quadrature weights for points close to a curve, exact to the resolution of the curve at any distance.
//!
//! Near a point t the kernels ln|z - t| and 1/(z - t)^k on a curve z(alpha) peak between the nodes. The complex
//! parameter alpha_0 with z(alpha_0) = t locates the peak: with u = exp(i alpha) and u_0 = exp(i alpha_0),
//! `f/(z - t)^k = h/(u - u_0)^k` with a smooth h, whose Fourier series is integrated term by term (singularity swap,
//! af Klinteberg and Barnett, BIT 61, 2021). For equally spaced nodes the result is the trapezoidal rule with a factor
//! at each node, in closed form. An open curve has the kernels of a row of images, `ln|2 sin(k d/2)|` and the sums of
//! 1/d^k, which are periodic in alpha and singular at one alpha_0 as well.

use std::f64::consts::TAU;

use motile_base::spectrum::largest_wave;
use num_complex::Complex64;

use crate::{
    curve::Curve,
    greens::{GreensFunction, Kernels, half_turns, row_of_turns, row_weighted, weighted},
    transforms::{REFINEMENT, Transforms},
};

/// Newton iterations for a preimage: each doubles the digits, so that from the nearest fine node some five are enough;
/// after six times as many the iteration has strayed.
const MOST_ITERATIONS: usize = 30;
/// Largest distance of a preimage from the nearest node in the parameter, beyond one spacing, over that of the point.
/// The map of parameter to position is conformal, so the two are equal up to its distortion; three times as far is
/// another preimage than the one that the kernels peak at, as curves with large last modes have them.
const FARTHEST: f64 = 3.0;
/// Distance in fine spacings within which a point may be on one side of the curve and on the other side of the polygon
/// through the fine nodes: a side of length s deviates by kappa s^2/8, 0.2 s at the largest curvature kappa = 1.6/s.
const ON_POLYGON: f64 = 0.2;
/// Distance in spacings below which a point counts as that far on the left of the curve: half of the digits, so that
/// quotients of distance and parameter keep the other half.
const LEAST_DISTANCE: f64 = 1e-9;

/// Distance in spacings beyond which the trapezoidal rule is exact to a tolerance: its error falls like
/// exp(-2 pi distance/spacing).
pub(crate) fn reach(tolerance: f64) -> f64 {
    1.0 - tolerance.ln() / TAU
}

/// Complex parameter of a point close to a curve.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Preimage {
    /// exp(i alpha_0).
    unit: Complex64,
    /// On the left of the curve.
    inside: bool,
}

/// Weights at the fine nodes of a curve for one point.
#[derive(Debug, Clone)]
pub(crate) struct CloseWeights {
    /// u at the fine nodes, and its power of the number of terms + 1.
    units: Vec<Complex64>,
    turns: Vec<Complex64>,
    /// Terms of the Fourier series of h, four below half the number of fine nodes.
    terms: usize,
    series: Vec<Complex64>,
    /// Source minus target at the fine nodes (length).
    distance: Vec<Complex64>,
    /// Values that replace ln|d|, or its counterpart for a row of images.
    log: Vec<f64>,
    /// Values that replace 1/d^k, k = 1, 2, 3, or their counterparts for a row of images.
    powers: [Vec<Complex64>; 3],
    /// The Green's function of the curve.
    greens: GreensFunction,
    /// The fine node nearest to the point.
    nearest: usize,
}

impl CloseWeights {
    pub(crate) fn new(nodes: usize) -> Self {
        let len = REFINEMENT * nodes;
        let terms = len / 2 - 4;
        let unit = |j: usize, power: usize| Complex64::cis(TAU * ((j * power) % len) as f64 / len as f64);
        let zeros = vec![Complex64::default(); len];
        Self {
            units: (0..len).map(|j| unit(j, 1)).collect(),
            turns: (0..len).map(|j| unit(j, terms + 1)).collect(),
            terms,
            series: zeros.clone(),
            distance: zeros.clone(),
            log: vec![0.0; len],
            powers: [zeros.clone(), zeros.clone(), zeros],
            greens: GreensFunction::Free,
            nearest: 0,
        }
    }

    /// Kernels at fine node j.
    pub(crate) fn kernels(&self, j: usize) -> Kernels {
        let c = [0, 1, 2].map(|k| self.powers[k][j]);
        let d = self.distance[j];
        match self.greens {
            GreensFunction::Row { .. } => row_weighted(self.log[j], c, d.im, 1.0),
            _ => weighted(self.log[j] - 0.5, c, d.conj()),
        }
    }

    /// Number of the fine node nearest to the point.
    pub(crate) fn nearest(&self) -> usize {
        self.nearest
    }

    /// Computes the weights for `point` (length, relative to the centre of a curve whose fine nodes are ready) and says
    /// whether it lies on the left. `None` where the side is not known: the point is farther than `reach` fine
    /// spacings, so that plain weights are exact, or no preimage is found and plain weights on the fine nodes have to
    /// do.
    pub(crate) fn find(
        &mut self,
        curve: &Curve,
        transforms: &mut Transforms,
        point: Complex64,
        reach: f64,
    ) -> Option<bool> {
        let mut point = point;
        let (mut nearest, mut least) = (0, f64::INFINITY);
        for (j, z) in curve.fine.position.iter().enumerate() {
            let square = curve.wrap(z - point).norm_sqr();
            if square < least {
                (nearest, least) = (j, square);
            }
        }
        self.nearest = nearest;
        self.greens = curve.greens();
        if curve.is_open() {
            // The image of the point that is nearest to the node.
            point = curve.fine.position[nearest] - curve.wrap(curve.fine.position[nearest] - point);
        }
        let weight = TAU / self.units.len() as f64;
        let tangent = curve.fine.tangent[nearest];
        let spacing = weight * tangent.norm();
        let preimage = if least.sqrt() < reach * spacing {
            let start = Complex64::new(weight * nearest as f64, 0.0) + (point - curve.fine.position[nearest]) / tangent;
            let found = refine(curve, point, (Complex64::new(0.0, 1.0) * start).exp());
            let found = found.filter(|found| self.is_plausible(curve, point, (nearest, least), found));
            if let Some(found) = found
                && (found.unit.norm() - 1.0).abs() < LEAST_DISTANCE * weight
            {
                // On the curve to round-off: the kernels are taken just inside.
                point += Complex64::new(0.0, LEAST_DISTANCE) * tangent * weight;
                let unit = found.unit / found.unit.norm() * (1.0 - LEAST_DISTANCE * weight);
                refine(curve, point, unit)
            } else {
                found
            }
        } else {
            None
        };
        let row = if let GreensFunction::Row { k } = self.greens { Some((k, half_turns(point, k))) } else { None };
        let [first, second, third] = &mut self.powers;
        for (j, z) in curve.fine.position.iter().enumerate() {
            let d = z - point;
            self.distance[j] = d;
            (self.log[j], [first[j], second[j], third[j]]) = if let Some((k, turns)) = row {
                row_of_turns(d, k, curve.fine.half_turns[j], turns)
            } else {
                let inverse = d.inv();
                let square = inverse * inverse;
                (0.5 * d.norm_sqr().ln(), [inverse, square, inverse * square])
            };
        }
        let preimage = preimage?;
        self.swap(curve, transforms, preimage);
        Some(preimage.inside)
    }

    /// True for the preimage that the kernels peak at, by its distance from the nearest node and by its side.
    fn is_plausible(&self, curve: &Curve, point: Complex64, nearest: (usize, f64), found: &Preimage) -> bool {
        let (nearest, square) = nearest;
        let (weight, tangent) = (TAU / self.units.len() as f64, curve.fine.tangent[nearest]);
        let farthest = weight + FARTHEST * (square / tangent.norm_sqr()).sqrt();
        if (found.unit - self.units[nearest]).norm_sqr() > farthest * farthest {
            return false;
        }
        let left = (tangent.conj() * (point - curve.fine.position[nearest])).im > 0.0;
        let on_polygon = ON_POLYGON * ON_POLYGON * weight * weight * tangent.norm_sqr();
        left == found.inside || curve.is_open() || square < on_polygon || found.inside == curve.polygon_contains(point)
    }

    /// Turns plain weights into those of the singularity swap for a pole at the preimage.
    fn swap(&mut self, curve: &Curve, transforms: &mut Transforms, preimage: Preimage) {
        let n = self.terms as f64;
        let unit = preimage.unit;
        // Ratio of the two units that is below one, by its value at u = 1.
        let ratio = if preimage.inside { unit } else { unit.inv() };
        let turned = ratio.powi(self.terms as i32 + 1);
        let polar = if preimage.inside { unit } else { unit.conj().inv() };
        let len = self.units.len();
        self.series.fill(Complex64::default());
        let mut power = Complex64::new(len as f64, 0.0);
        for term in 1..=self.terms {
            power *= polar;
            self.series[term] = power / term as f64;
        }
        transforms.fine.forward(&mut self.series);
        for j in 0..len {
            let (p, tail) = if preimage.inside {
                (ratio * self.units[j].conj(), turned * self.turns[j].conj())
            } else {
                (ratio * self.units[j], turned * self.turns[j])
            };
            let gap = 1.0 - p;
            if gap.norm() * n < 0.3 {
                // The closest node: distance and gap from the same difference of parameters, so that their quotient
                // keeps its digits however small they are.
                let turn = Complex64::new(0.0, if preimage.inside { 1.0 } else { -1.0 });
                let parameter = p.ln() / turn;
                let gap = -growth(turn * parameter);
                let d = difference(curve, self.units[j], parameter);
                self.distance[j] = d;
                // In a row d becomes 2 sin(k d/2)/k, and its odd powers get the factor of the cotangent.
                let (scale, sine, cosine) = if let GreensFunction::Row { k } = self.greens {
                    let half = 0.5 * k * d;
                    (k, half.sin() / (0.5 * k), half.cos())
                } else {
                    (1.0, d, Complex64::new(1.0, 0.0))
                };
                self.log[j] = (sine / gap * scale).norm().ln() - self.series[j].re;
                let [first, second, third] = direct_factors(p, self.terms);
                let ratio = gap / sine;
                self.powers[0][j] = ratio * cosine * first;
                self.powers[1][j] = ratio * ratio * second;
                self.powers[2][j] = ratio * ratio * ratio * cosine * third;
                continue;
            }
            self.log[j] -= 0.5 * gap.norm_sqr().ln() + self.series[j].re;
            let (a, b) = (0.5 * (n + 2.0) * (n + 3.0), (n + 1.0) * (n + 3.0));
            let factors = [
                1.0 - tail,
                1.0 - tail * (n + 2.0 - p * (n + 1.0)),
                1.0 - tail * (a - p * b + p * p * (0.5 * (n + 1.0) * (n + 2.0))),
            ];
            for (power, factor) in self.powers.iter_mut().zip(factors) {
                power[j] *= factor;
            }
        }
    }
}

/// Sums `sum over n <= terms of binomial(n + k - 1, k - 1) p^n` for k = 1, 2, 3 term by term: close to p = 1 the closed
/// form loses its digits.
fn direct_factors(p: Complex64, terms: usize) -> [Complex64; 3] {
    let mut sums = [Complex64::default(); 3];
    for n in (0..=terms).rev() {
        let n = n as f64;
        for (sum, weight) in sums.iter_mut().zip([1.0, n + 1.0, 0.5 * (n + 1.0) * (n + 2.0)]) {
            *sum = *sum * p + weight;
        }
    }
    sums
}

/// exp(x) - 1.
fn growth(x: Complex64) -> Complex64 {
    let half = 0.5 * x;
    2.0 * half.exp() * half.sinh()
}

/// Position at a node minus the position at a parameter larger by `offset`, without cancellation.
fn difference(curve: &Curve, unit: Complex64, offset: Complex64) -> Complex64 {
    let shape = &curve.shape;
    let len = shape.len();
    let mut sum = -curve.period * offset / TAU;
    let mut power = Complex64::new(1.0, 0.0);
    for m in 1..=largest_wave(len) {
        power *= unit;
        let phase = Complex64::new(0.0, m as f64) * offset;
        sum -= shape[m] * power * growth(phase) + shape[len - m] * power.conj() * growth(-phase);
    }
    sum
}

/// Preimage of a point under the parametrisation of a curve by Newton's method, from a first guess of exp(i alpha).
fn refine(curve: &Curve, point: Complex64, start: Complex64) -> Option<Preimage> {
    let mut unit = start;
    let scale: f64 = curve.shape.iter().map(|c| c.norm()).fold(curve.period.norm(), f64::max);
    for _ in 0..MOST_ITERATIONS {
        let (value, derivative) = evaluate(curve, unit);
        let step = curve.wrap(value - point) / derivative;
        if !step.is_finite() || step.norm() > 2.0 {
            return None;
        }
        unit *= (-Complex64::new(0.0, 1.0) * step).exp();
        if (step * derivative).norm() < 1e-14 * scale || step.norm() < 1e-15 {
            return Some(Preimage { unit, inside: unit.norm_sqr() < 1.0 });
        }
    }
    None
}

/// Position and its derivative by the parameter alpha at u = exp(i alpha), alpha complex.
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

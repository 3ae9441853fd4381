//! Quadrature weights for points close to a curve, exact to the resolution of the curve at any distance.
//!
//! Near a point t the kernels ln|z - t| and 1/(z - t)^k on a curve z(alpha) peak between the nodes. The complex
//! parameter alpha_0 with z(alpha_0) = t locates the peak. With u = exp(i alpha) and u_0 = exp(i alpha_0), `f/(z -
//! t)^k = h/(u - u_0)^k` with a smooth h, whose Fourier series is integrated term by term (singularity swap, af
//! Klinteberg and Barnett, BIT 61, 2021). For equally spaced nodes the result is the trapezoidal rule with a factor at
//! each node, in closed form. The logarithm is split, `ln|z - t| = ln|(z - t)/(1 - u_0/u)| + ln|1 - u_0/u|`: the first
//! part is smooth, and the second a series of which the modes of a density take as many terms as there are of them
//! ([`CloseWeights::modal`]). An open curve has the kernels of a row of images, `ln|2 sin(k d/2)|` and the sums of
//! 1/d^k, which are periodic in alpha and singular at one alpha_0 as well.

use std::f64::consts::TAU;

use motile_base::internal::spectrum::largest_wave;
use num_complex::Complex64;

mod kernels;
mod place;

use motile_base::internal::widely;

use crate::{
    curve::Curve,
    greens::{GreensFunction, Vectors},
    transforms::REFINEMENT,
};
pub(crate) use kernels::KernelArrays;
use kernels::Pole;
pub(crate) use place::Place;
use place::Preimage;

/// Product of |1 - p| and the number of terms below which the factors are summed term by term: there the closed form
/// loses its digits. It is a tenth of the distance of fine nodes, so that there is one such node at most.
const CLOSEST: f64 = 0.3;

/// Returns the distance in spacings beyond which the trapezoidal rule is exact to a tolerance: its error falls like
/// exp(-2 pi distance/spacing).
pub(crate) fn reach(tolerance: f64) -> f64 {
    1.0 - tolerance.ln() / TAU
}

/// Kernels at the fine nodes of a curve for one point, ln|d| and 1/d^k replaced by values whose sums are exact, and
/// the plain kernels at the nodes.
#[derive(Debug, Clone)]
pub(crate) struct CloseWeights {
    /// u at the fine nodes, and its power of the number of terms + 1.
    units: Vectors,
    turns: Vectors,
    /// Terms of the Fourier series of h, four below half the number of fine nodes.
    terms: usize,
    pub(crate) fine: KernelArrays,
    nodes: KernelArrays,
    /// u_0 or its mirror image at the unit circle, whichever is inside of it; zero without a swap.
    pub(crate) polar: Complex64,
    /// Squared distances of the nodes from the last place (length squared).
    squares: Vec<f64>,
}

impl CloseWeights {
    pub(crate) fn new(nodes: usize) -> Self {
        let len = REFINEMENT * nodes;
        let terms = len / 2 - 4;
        let powers = |power: usize| {
            let mut out = Vectors::default();
            let unit = |j: usize| Complex64::cis(TAU * ((j * power) % len) as f64 / len as f64);
            out.fill(&(0..len).map(unit).collect::<Vec<_>>());
            out
        };
        let [fine, nodes] = Default::default();
        let squares = Vec::new();
        Self { units: powers(1), turns: powers(terms + 1), terms, fine, nodes, polar: Complex64::default(), squares }
    }

    /// Finds the place of a point ([`Place::find`]).
    pub(crate) fn place(&mut self, curve: &Curve, point: Complex64, reach: f64) -> Place {
        Place::find(curve, point, reach, &mut self.squares)
    }

    /// Returns the kernels at the fine nodes and at the nodes.
    pub(crate) fn arrays(&self) -> [&KernelArrays; 2] {
        [&self.fine, &self.nodes]
    }

    /// Computes the first ORDER kernels for a place: 1 for the velocity of forces, 2 for their stress and the velocity
    /// of dipoles, 3 for the stress of dipoles.
    pub(crate) fn fill<const ORDER: usize>(&mut self, curve: &Curve, place: &Place) {
        let Self { fine, nodes, units, turns, .. } = self;
        fine.place(curve, place.point);
        let pole = place.preimage.map(|preimage| pole(preimage, self.terms));
        self.polar =
            pole.map_or_else(Complex64::default, |pole| if pole.side > 0.0 { pole.ratio } else { pole.ratio.conj() });
        widely(
            #[inline(always)]
            || {
                if let Some(pole) = &pole {
                    nodes.pick(fine, REFINEMENT, None);
                    nodes.invert::<ORDER>();
                    fine.swap::<ORDER>(units, turns, pole);
                } else {
                    fine.invert::<ORDER>();
                    nodes.pick(fine, REFINEMENT, Some(ORDER));
                }
            },
        );
        if let (Some(pole), Some(preimage)) = (pole, place.preimage) {
            self.mend(curve, &pole, preimage);
        }
    }

    /// Returns the sum over a density per parameter with these Fourier coefficients of the part of the logarithm that
    /// the values at fine nodes leave out: `-INT ln|1 - p| f dalpha`.
    pub(crate) fn modal(polar: Complex64, density: &[Complex64]) -> Complex64 {
        let (mut power, mut sum) = (Complex64::new(1.0, 0.0), Complex64::default());
        if polar == Complex64::default() {
            return sum;
        }
        for m in 1..=largest_wave(density.len()) {
            power *= polar;
            sum += (power * density[m] + power.conj() * density[density.len() - m]) / m as f64;
        }
        0.5 * TAU * sum
    }

    /// Adds the transpose of [`CloseWeights::modal`] for a force: to coefficients of the flow at the nodes.
    pub(crate) fn add_modal_transpose(polar: Complex64, force: Complex64, flow: &mut [Complex64]) {
        let (mut power, len) = (force * 0.5 * flow.len() as f64, flow.len());
        if polar == Complex64::default() {
            return;
        }
        let mut mirrored = power;
        for m in 1..=largest_wave(len) {
            power *= polar;
            mirrored *= polar.conj();
            flow[m] += power / m as f64;
            flow[len - m] += mirrored / m as f64;
        }
    }

    /// Replaces the kernels of a fine node so close to the preimage that differences lose their digits.
    fn mend(&mut self, curve: &Curve, pole: &Pole, preimage: Preimage) {
        let len = self.units.x.len() / 2;
        let angle = preimage.unit.arg().rem_euclid(TAU) / TAU;
        let j = (angle * len as f64).round() as usize % len;
        let unit = Complex64::new(self.units.x[j], self.units.y[j]);
        let p = pole.ratio * if preimage.inside { unit.conj() } else { unit };
        if (1.0 - p).norm_sqr() * pole.terms * pole.terms >= CLOSEST * CLOSEST {
            return;
        }
        // Distance and gap from the same difference of parameters, so that their quotient keeps its digits however
        // small they are.
        let turn = Complex64::new(0.0, pole.side);
        let parameter = p.ln() / turn;
        let gap = -growth(turn * parameter);
        let d = difference(curve, unit, parameter);
        // In a row d becomes 2 sin(k d/2)/k, and its odd powers get the factor of the cotangent.
        let (scale, sine, cosine) = if let GreensFunction::Row { k } = curve.greens() {
            let half = 0.5 * k * d;
            (k, half.sin() / (0.5 * k), half.cos())
        } else {
            (1.0, d, Complex64::new(1.0, 0.0))
        };
        let KernelArrays { dy, log, c, .. } = &mut self.fine;
        dy[j] = d.im;
        log[j] = 0.5 * (sine / gap * scale).norm_sqr().ln();
        let [first, second, third] = direct_factors(p, self.terms);
        let ratio = gap / sine;
        let powers = [ratio * cosine * first, ratio * ratio * second, ratio * ratio * ratio * cosine * third];
        for (array, power) in c.iter_mut().zip(powers) {
            (array.x[j], array.y[j]) = (power.re, power.im);
        }
    }
}

/// Returns the factors of the swap for a preimage.
fn pole(preimage: Preimage, terms: usize) -> Pole {
    // Ratio of the two units that is below one, by its value at u = 1.
    let ratio = if preimage.inside { preimage.unit } else { preimage.unit.inv() };
    let side = if preimage.inside { 1.0 } else { -1.0 };
    Pole { ratio, turned: ratio.powi(terms as i32 + 1), side, terms: terms as f64 }
}

/// Returns the sums `sum over n <= terms of binomial(n + k - 1, k - 1) p^n` for k = 1, 2, 3 term by term: close to p =
/// 1 the closed form loses its digits.
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

/// Returns the position at a node minus the position at a parameter larger by `offset`, without cancellation.
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

#[cfg(test)]
mod tests;

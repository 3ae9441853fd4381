//! Split of the Green's function into a smooth part with a bounded spectrum and a part that ends at a distance.
//!
//! With the prolate function psi of parameter c, the cut-off r_c and `chi(x) = psi(x/c)/psi(0)` the smooth part is
//!
//! ```text
//! G_M^(k) = 4 pi/k^2 (I - k k/k^2) phi(k r_c),    phi(x) = (1 + alpha x^2) chi(x)  up to x = c, 0 beyond
//! ```
//!
//! The transform of phi vanishes beyond r_c except for psi(1), and alpha = -chi''(0)/2 makes its second moment vanish,
//! so that G - G_M does so too. In space `G_M = b I + g r r`, with lengths in r_c and `x = k r`
//!
//! ```text
//! b = 1/2 - ln r_c + 2 INT phi(k)/k [J_0(x) - J_1(x)/x - J_0(k)/2] dk,    g = 2 INT phi(k) k J_2(x)/x^2 dk
//! ```
//!
//! and its stress acts on a dipole D, symmetric, as `2 a D r + 2 g' r (r D r) + a r tr D` with `g' = dg/(r dr)` and
//! `a = -2 g - r^2 g'`.

use std::f64::consts::PI;

use motile_base::internal::gauss_legendre;

use super::{
    polynomial::{powers, value},
    prolate::Prolate,
};

/// Nodes of the quadrature over k, which resolve J_0(k r) phi up to the largest c.
const QUADRATURE: usize = 56;
/// Nodes of the integral of a Bessel function over a quarter of a turn: as many are exact for arguments up to the
/// largest c.
const TURN: usize = 22;
/// Fraction of the tolerance that polynomials may be off by.
const POLYNOMIALS: f64 = 0.05;
/// Fraction of the tolerance that the split of a single layer may be off by, so that double layers, whose kernel falls
/// off faster and leaves a larger part beyond the cut-off, are off by less than the tolerance (measured).
const MARGIN: f64 = 0.05;
/// Least tolerance: below, round-off is larger than what is left out.
const LEAST: f64 = 1e-14;

/// The split for a tolerance, in units of the cut-off.
#[derive(Debug, Clone)]
pub(super) struct Split {
    /// c, the largest wave number times the cut-off.
    pub(super) c: f64,
    /// phi as powers of 2 (x/c)^2 - 1.
    phi: Vec<f64>,
    /// b + ln r_c, g, a and g' as powers of t = 2 (r/r_c)^2 - 1: t^2k and t^(2k + 1) of two of them together.
    pub(super) stokeslet: Vec<[f64; 4]>,
    pub(super) stress: Vec<[f64; 4]>,
    /// b + ln r_c at the distance 0.
    pub(super) own: f64,
}

impl Split {
    pub(super) fn new(tolerance: f64) -> Self {
        let spectrum = Spectrum::new(tolerance);
        let Spectrum { tolerance, c, .. } = spectrum;
        let (phi, integral) = (|x: f64| spectrum.phi(x), |term: &dyn Fn(f64) -> f64| spectrum.integral(term));
        let even = |t: f64| {
            let r = radius(t);
            0.5 + 2.0 * integral(&|k| (bessel::<0>(k * r) - bessel::<1>(k * r) - 0.5 * bessel::<0>(k)) / k)
        };
        let radial = |t: f64| 2.0 * integral(&|k| k * bessel::<2>(k * radius(t)));
        let slope = |t: f64| -2.0 * integral(&|k| k * k * k * bessel::<3>(k * radius(t)));
        let mixed = |t: f64| -2.0 * radial(t) - 0.5 * (1.0 + t) * slope(t);
        let accuracy = POLYNOMIALS * tolerance;
        let [b, g, a, s] =
            [powers(accuracy, even), powers(accuracy, radial), powers(accuracy, mixed), powers(accuracy, slope)];
        let own = value(&b, -1.0);
        let spectrum = |t: f64| phi(c * radius(t));
        Self { c, phi: powers(1e-2 * accuracy, spectrum), stokeslet: pairs(&b, &g), stress: pairs(&a, &s), own }
    }

    /// phi(x) for x up to c.
    pub(super) fn phi(&self, x: f64) -> f64 {
        value(&self.phi, 2.0 * (x / self.c).powi(2) - 1.0)
    }
}

/// phi by its prolate function, and a quadrature of integrals with it over k.
struct Spectrum {
    /// Relative error that the split of a single layer may make.
    tolerance: f64,
    c: f64,
    prolate: Prolate,
    alpha: f64,
    /// Nodes, and phi there times their weight.
    nodes: Vec<[f64; 2]>,
}

impl Spectrum {
    fn new(tolerance: f64) -> Self {
        let tolerance = (MARGIN * tolerance).max(LEAST);
        // Measured: what the single layer of random nodes leaves out, relative to the largest velocity, is
        // 2.7e-3 exp(-.934 (c - 8)).
        let c = 8.0 + (2.7e-3 / tolerance).ln() / 0.934;
        let prolate = Prolate::new(c);
        let alpha = 0.5 * prolate.bend / (c * c);
        let mut spectrum = Self { tolerance, c, prolate, alpha, nodes: Vec::new() };
        let nodes = gauss_legendre(QUADRATURE).into_iter().map(|(x, weight)| {
            let k = 0.5 * c * (1.0 + x);
            [k, 0.5 * c * weight * spectrum.phi(k)]
        });
        spectrum.nodes = nodes.collect();
        spectrum
    }

    fn phi(&self, x: f64) -> f64 {
        (1.0 + self.alpha * x * x) * self.prolate.at(x / self.c)
    }

    fn integral(&self, term: &dyn Fn(f64) -> f64) -> f64 {
        self.nodes.iter().map(|[k, phi]| phi * term(*k)).sum()
    }
}

/// b + ln r_c, then g and its first and second derivative by the square of the distance, as powers of t, for samples
/// of the flow of a split of that tolerance.
pub(super) fn derivatives(tolerance: f64) -> [Vec<f64>; 4] {
    let spectrum = Spectrum::new(tolerance);
    let integral = |term: &dyn Fn(f64) -> f64| spectrum.integral(term);
    let accuracy = POLYNOMIALS * spectrum.tolerance;
    [
        powers(accuracy, |t| {
            let r = radius(t);
            0.5 + 2.0 * integral(&|k| (bessel::<0>(k * r) - bessel::<1>(k * r) - 0.5 * bessel::<0>(k)) / k)
        }),
        powers(accuracy, |t| 2.0 * integral(&|k| k * bessel::<2>(k * radius(t)))),
        powers(accuracy, |t| -integral(&|k| k.powi(3) * bessel::<3>(k * radius(t)))),
        powers(accuracy, |t| 0.5 * integral(&|k| k.powi(5) * bessel::<4>(k * radius(t)))),
    ]
}

/// Returns the distance in units of the cut-off at t.
fn radius(t: f64) -> f64 {
    (0.5 * (1.0 + t)).max(0.0).sqrt()
}

/// Returns the even and odd powers of two polynomials together.
fn pairs(one: &[f64], other: &[f64]) -> Vec<[f64; 4]> {
    let at = |powers: &[f64], k: usize| powers.get(k).copied().unwrap_or(0.0);
    let len = one.len().max(other.len()).div_ceil(2);
    (0..len).map(|k| [at(one, 2 * k), at(one, 2 * k + 1), at(other, 2 * k), at(other, 2 * k + 1)]).collect()
}

/// Returns `J_N(x)/x^N`, by the trapezoidal rule for Poisson's integral `1/((2N - 1)!! pi) INT cos(x sin t) cos^2N t
/// dt`.
fn bessel<const N: i32>(x: f64) -> f64 {
    let odd: f64 = (1..=N).map(|n| f64::from(2 * n - 1)).product();
    let angle = |i: usize| 0.5 * PI * (i as f64 + 0.5) / TURN as f64;
    let sum: f64 = (0..TURN).map(angle).map(|t| (x * t.sin()).cos() * t.cos().powi(2 * N)).sum();
    sum / (odd * TURN as f64)
}

#[cfg(test)]
mod tests;

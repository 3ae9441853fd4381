//! Split of the Stokeslet in space into a smooth part with a bounded spectrum and a part that ends at the cut-off.
//!
//! With the prolate function psi of parameter c and `chi(x) = psi(x/c)/psi(0)`, the spectrum is multiplied by
//! `phi(x) = (1 + alpha x^2) chi(x)` up to x = c. Its second derivative at 0 vanishes, so that B(r) = r beyond the
//! cut-off. In units of the cut-off, with spherical Bessel functions of `x = k r`,
//!
//! ```text
//! G_M = b I + g r r,   b = 4/pi INT phi (j_0 - j_1/x) dk,   g = 4/pi INT phi k^2 j_2/x^2 dk
//! T_M = -m (S r + tr(S) r/2) + s r (r S r),   s = 4/pi INT phi k^4 j_3/x^3 dk,   m = -3 g + r^2 s
//! ```
//!
//! for a double layer `S = n u + u n` and r from the source to the target.

use std::f64::consts::PI;

use motile_base::internal::gauss_legendre;
use stokes_boundary_integrals::internal::prolate::{Prolate, powers};

/// Largest wave numbers times the cut-off, and what is left out over the largest velocity (measured).
pub(super) const LEVELS: [(f64, f64); 4] = [(35.0, 1e-13), (26.0, 1e-7), (18.0, 1e-4), (11.0, 2e-2)];
/// Nodes of the quadrature over k, and of the one for Bessel functions.
const QUADRATURE: usize = 64;
const TURN: usize = 40;
/// Relative accuracy of polynomials.
const POLYNOMIALS: f64 = 1e-15;

/// The split in units of the cut-off.
#[derive(Debug, Clone)]
pub(super) struct Split {
    c: f64,
    prolate: Prolate,
    alpha: f64,
    /// b, g and s as powers of 2 r^2 - 1.
    pub(super) smooth: [Vec<f64>; 3],
}

impl Split {
    /// Creates the split for a largest wave number times the cut-off.
    pub(super) fn new(c: f64) -> Self {
        let prolate = Prolate::new(c);
        let alpha = 0.5 * prolate.bend / (c * c);
        let mut split = Self { c, prolate, alpha, smooth: [Vec::new(), Vec::new(), Vec::new()] };
        let nodes = gauss_legendre(QUADRATURE).into_iter().map(|(x, weight)| {
            let k = 0.5 * c * (1.0 + x);
            [k, 0.5 * c * weight * split.phi(k) * 4.0 / PI]
        });
        let nodes: Vec<[f64; 2]> = nodes.collect();
        let turn = gauss_legendre(TURN);
        let integral = |term: &dyn Fn(f64, f64) -> f64| {
            powers(POLYNOMIALS, |t| {
                let r = (0.5 * (1.0 + t)).max(0.0).sqrt();
                nodes.iter().map(|[k, phi]| phi * term(*k, k * r)).sum()
            })
        };
        split.smooth = [
            integral(&|_, x| bessel::<0>(&turn, x) - bessel::<1>(&turn, x)),
            integral(&|k, x| k * k * bessel::<2>(&turn, x)),
            integral(&|k, x| k.powi(4) * bessel::<3>(&turn, x)),
        ];
        // Polynomials of one length are summed together.
        let len = split.smooth.iter().map(Vec::len).max().unwrap_or(0);
        split.smooth.iter_mut().for_each(|powers| powers.resize(len, 0.0));
        split
    }

    /// Returns phi at a wave number times the cut-off; zero beyond the largest.
    pub(super) fn phi(&self, x: f64) -> f64 {
        if x > self.c { 0.0 } else { (1.0 + self.alpha * x * x) * self.prolate.at(x / self.c) }
    }

    /// Returns the largest wave number times the cut-off.
    pub(super) fn most(&self) -> f64 {
        self.c
    }
}

/// Returns `j_N(x)/x^N = 1/(2^(N + 1) N!) INT cos(x s) (1 - s^2)^N ds`.
fn bessel<const N: i32>(turn: &[(f64, f64)], x: f64) -> f64 {
    let sum: f64 = turn.iter().map(|(s, weight)| weight * (x * s).cos() * (1.0 - s * s).powi(N)).sum();
    sum / (1..=N).map(|n| 2.0 * f64::from(n)).product::<f64>() / 2.0
}

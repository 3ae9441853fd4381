//! The weights of kernels of polynomials.

use super::lanes::Lanes;
use crate::kernel::{BSPLINE_4, Pieces};

/// Source of the polynomials of a kernel: a table that is read, or constants.
pub(super) trait Polynomials: Copy {
    /// Returns the coefficients of the kernel's weights.
    fn pieces(&self) -> &Pieces;
}

impl Polynomials for &Pieces {
    #[inline(always)]
    fn pieces(&self) -> &Pieces {
        self
    }
}

/// The polynomials of the default kernel as constants, which saves reading them for every marker.
#[derive(Debug, Clone, Copy)]
pub(super) struct BSpline4Pieces;

impl Polynomials for BSpline4Pieces {
    #[inline(always)]
    fn pieces(&self) -> &Pieces {
        const { &BSPLINE_4 }
    }
}

/// Returns the weights of `pieces` at the fraction `t` of a coordinate, in the normal and the tangential role.
#[inline(always)]
pub(super) fn weights<L: Lanes>(l: L, pieces: &impl Polynomials, t: f64) -> [L::Four; 2] {
    let t = l.splat(t);
    let Pieces { normal, tangential, .. } = pieces.pieces();
    let [c0, c1, c2, c3] = *normal;
    let square = l.mul(t, t);
    // Not by Horner's rule: what can be done side by side is done sooner.
    let low = l.mul_add(t, l.load(c1), l.load(c0));
    let high = l.mul_add(t, l.load(c3), l.load(c2));
    let normal = l.mul_add(square, high, low);
    let [c0, c1, c2] = *tangential;
    let tangential = l.mul_add(square, l.load(c2), l.mul_add(t, l.load(c1), l.load(c0)));
    [normal, tangential]
}

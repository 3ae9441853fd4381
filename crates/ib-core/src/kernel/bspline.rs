//! Composite B-splines.

use super::pieces::{BSPLINE_3, BSPLINE_4};
use super::{Kernel, MAX_SUPPORT, Pieces, Role};

/// Cardinal B-spline of order N in the normal role and N - 1 in the tangential one (degree one less). Interpolation of
/// a discretely divergence-free field with it is divergence free in the continuum (Gruninger and Griffith, "Composite
/// B-spline regularized delta functions for the immersed boundary method", J. Comput. Phys. 546, 114472 (2025);
/// docs/explanation/grid.md). `BSpline<4>`, cubic along a velocity component and quadratic across it, is the default
/// kernel.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub struct BSpline<const N: usize>;

impl<const N: usize> BSpline<N> {
    // Orders this crate provides; checked when the type is used.
    const CHECK: () = assert!(N >= 3 && N <= MAX_SUPPORT, "orders 3 to 6");

    fn order(role: Role) -> usize {
        let () = Self::CHECK;
        match role {
            Role::Normal => N,
            Role::Tangential => N - 1,
        }
    }
}

/// Values of the B-splines of order `order` that are not zero at a point `t` in [0, 1) past a knot, by the recursion
/// of de Boor and Cox.
fn bspline_values(order: usize, t: f64, weights: &mut [f64; MAX_SUPPORT]) {
    // With the order known to the compiler the loops unroll.
    match order {
        2 => values_of_order::<2>(t, weights),
        3 => values_of_order::<3>(t, weights),
        4 => values_of_order::<4>(t, weights),
        5 => values_of_order::<5>(t, weights),
        _ => values_of_order::<MAX_SUPPORT>(t, weights),
    }
}

#[inline]
fn values_of_order<const ORDER: usize>(t: f64, weights: &mut [f64; MAX_SUPPORT]) {
    weights[0] = 1.0;
    for degree in 1..ORDER {
        let scale = 1.0 / degree as f64;
        let mut left = 0.0;
        for (i, weight) in weights.iter_mut().enumerate().take(degree) {
            let term = *weight * scale;
            *weight = left + (1.0 + i as f64 - t) * term;
            left = (degree as f64 - 1.0 - i as f64 + t) * term;
        }
        weights[degree] = left;
    }
}

impl<const N: usize> Kernel for BSpline<N> {
    fn name(&self) -> &'static str {
        ["bspline3", "bspline4", "bspline5", "bspline6"][N - 3]
    }

    fn support(&self, role: Role) -> usize {
        Self::order(role)
    }

    #[inline]
    fn weights(&self, role: Role, r: f64, weights: &mut [f64; MAX_SUPPORT]) -> i64 {
        let order = Self::order(role);
        // A spline of even order has its knots on the lattice, one of odd order half way between.
        let shifted = r + 0.5 * (order % 2) as f64;
        let floor = shifted.floor();
        bspline_values(order, shifted - floor, weights);
        floor as i64 - (order as i64 - 1) / 2
    }

    fn pieces(&self) -> Option<&'static Pieces> {
        match N {
            3 => Some(&BSPLINE_3),
            4 => Some(&BSPLINE_4),
            _ => None,
        }
    }

    fn value(&self, role: Role, r: f64) -> f64 {
        let order = Self::order(role);
        let half = 0.5 * order as f64;
        if r.abs() >= half {
            return 0.0;
        }
        let s = half - r.abs();
        let mut weights = [0.0; MAX_SUPPORT];
        let piece = s.floor();
        bspline_values(order, s - piece, &mut weights);
        weights[order - 1 - piece as usize]
    }

    /// Returns `(sin(theta/2) / (theta/2))^order`.
    fn transform(&self, role: Role, theta: f64) -> f64 {
        let half = 0.5 * theta;
        let sinc = if half.abs() < 1e-4 { 1.0 - half * half / 6.0 } else { half.sin() / half };
        sinc.powi(Self::order(role) as i32)
    }
}

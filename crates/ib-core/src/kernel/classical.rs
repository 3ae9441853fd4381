//! Peskin's and Roma's functions.

use super::{Kernel, MAX_SUPPORT, Role, tabulate};

/// Peskin's 4-point function, Cowley (2.36); the same in both roles.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
#[doc(alias("delta function", "regularised delta function", "regularized delta function", "Dirac delta"))]
pub struct Peskin4;

impl Kernel for Peskin4 {
    fn name(&self) -> &'static str {
        "peskin4"
    }

    fn support(&self, _role: Role) -> usize {
        4
    }

    fn weights(&self, _role: Role, r: f64, weights: &mut [f64; MAX_SUPPORT]) -> i64 {
        // The arguments of the roots at the four points are all 1 + 4 t (1 - t).
        let floor = r.floor();
        let t = r - floor;
        let root = (1.0 + 4.0 * t * (1.0 - t)).sqrt();
        weights[0] = 0.125 * (3.0 - 2.0 * t - root);
        weights[1] = 0.125 * (3.0 - 2.0 * t + root);
        weights[2] = 0.125 * (1.0 + 2.0 * t + root);
        weights[3] = 0.125 * (1.0 + 2.0 * t - root);
        floor as i64 - 1
    }

    fn value(&self, _role: Role, r: f64) -> f64 {
        let r = r.abs();
        if r < 1.0 {
            (3.0 - 2.0 * r + (1.0 + 4.0 * r * (1.0 - r)).sqrt()) / 8.0
        } else if r < 2.0 {
            (5.0 - 2.0 * r - (4.0 * r * (3.0 - r) - 7.0).max(0.0).sqrt()) / 8.0
        } else {
            0.0
        }
    }
}

/// The 3-point function of Roma, Peskin and Berger (J. Comput. Phys. 153, 1999); the same in both roles.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub struct Roma3;

impl Kernel for Roma3 {
    fn name(&self) -> &'static str {
        "roma3"
    }

    fn support(&self, _role: Role) -> usize {
        3
    }

    fn weights(&self, role: Role, r: f64, weights: &mut [f64; MAX_SUPPORT]) -> i64 {
        tabulate(3, r, weights, |x| self.value(role, x))
    }

    fn value(&self, _role: Role, r: f64) -> f64 {
        let r = r.abs();
        if r < 0.5 {
            (1.0 + (1.0 - 3.0 * r * r).sqrt()) / 3.0
        } else if r < 1.5 {
            let s = 1.0 - r;
            (5.0 - 3.0 * r - (1.0 - 3.0 * s * s).max(0.0).sqrt()) / 6.0
        } else {
            0.0
        }
    }
}

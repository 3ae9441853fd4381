//! The Gaussian-like function of Bao, Kaye and Peskin.

use super::{Kernel, MAX_SUPPORT, Role};

/// The Gaussian-like 6-point function of Bao, Kaye and Peskin (J. Comput. Phys. 316, 2016), three times continuously
/// differentiable; the same in both roles.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub struct Gaussian6;

impl Gaussian6 {
    /// Returns the second moment K = 59/60 - sqrt(29)/20, the value that makes the third derivative continuous.
    pub(super) fn second_moment() -> f64 {
        59.0 / 60.0 - 29.0_f64.sqrt() / 20.0
    }

    /// phi at -3 + r, -2 + r, ..., 2 + r for r in [0, 1). The even-odd condition, three moment conditions and the sum
    /// of squares leave a quadratic equation for the outermost value.
    fn branches(r: f64) -> [f64; 6] {
        let k = Self::second_moment();
        let (r2, r3) = (r * r, r * r * r);
        let alpha = 28.0;
        let beta = 9.0 / 4.0 - 1.5 * (k + r2) + (22.0 / 3.0 - 7.0 * k) * r - 7.0 / 3.0 * r3;
        let gamma = 0.25
            * (0.5 * (161.0 / 36.0 - 59.0 / 6.0 * k + 5.0 * k * k) * r2
                + (5.0 * k - 109.0 / 24.0) / 3.0 * r2 * r2
                + 5.0 / 18.0 * r3 * r3);
        let outer = (-beta + (1.5 - k).signum() * (beta * beta - 4.0 * alpha * gamma).sqrt()) / (2.0 * alpha);
        [
            outer,
            -3.0 * outer - 1.0 / 16.0 + (k + r2) / 8.0 + (3.0 * k - 1.0) * r / 12.0 + r3 / 12.0,
            2.0 * outer + 0.25 + (4.0 - 3.0 * k) * r / 6.0 - r3 / 6.0,
            2.0 * outer + 5.0 / 8.0 - (k + r2) / 4.0,
            -3.0 * outer + 0.25 - (4.0 - 3.0 * k) * r / 6.0 + r3 / 6.0,
            outer - 1.0 / 16.0 + (k + r2) / 8.0 - (3.0 * k - 1.0) * r / 12.0 - r3 / 12.0,
        ]
    }
}

impl Kernel for Gaussian6 {
    fn name(&self) -> &'static str {
        "gaussian6"
    }

    fn support(&self, _role: Role) -> usize {
        6
    }

    fn weights(&self, _role: Role, r: f64, weights: &mut [f64; MAX_SUPPORT]) -> i64 {
        let floor = r.floor();
        // The point 'floor - 2 + i' lies at distance 'floor - 2 + i - r' = -3 + i + (1 - fraction); phi is even, so the
        // branches run backwards with the fraction itself.
        let branches = Self::branches(r - floor);
        for (weight, value) in weights.iter_mut().zip(branches.iter().rev()) {
            *weight = *value;
        }
        floor as i64 - 2
    }

    fn value(&self, _role: Role, r: f64) -> f64 {
        let r = r.abs();
        if r >= 3.0 {
            return 0.0;
        }
        let cell = r.floor();
        Self::branches(r - cell)[cell as usize + 3]
    }
}

//! Orthonormal associated Legendre functions with their derivatives, and the Gauss-Legendre rule.

use std::f64::consts::{FRAC_1_SQRT_2, PI, SQRT_2};

/// Returns the place of the pair (l, m) with m >= 0 in the tables of [`Legendre`].
#[inline(always)]
pub(crate) const fn pair(l: usize, m: usize) -> usize {
    l * (l + 1) / 2 + m
}

/// The factors of `cos(m phi)` and `sin(m phi)` in the harmonics at one colatitude, by [`pair`].
#[derive(Debug, Clone, Default)]
pub(crate) struct Legendre {
    /// sqrt(2) P_lm, and P_l0.
    pub(crate) value: Vec<f64>,
    /// Their derivatives by theta.
    pub(crate) theta: Vec<f64>,
    /// m/sin(theta) times them, also at the poles.
    pub(crate) phi: Vec<f64>,
}

impl Legendre {
    /// Computes all functions up to the degree at theta.
    pub(crate) fn new(degree: usize, theta: f64) -> Self {
        let mut table = Self::default();
        table.update(degree, theta);
        table
    }

    /// Computes all functions up to the degree at theta, by recurrences in l, in the same memory.
    pub(crate) fn update(&mut self, degree: usize, theta: f64) {
        let (s, x) = theta.sin_cos();
        for list in [&mut self.value, &mut self.theta, &mut self.phi] {
            list.clear();
            list.resize(pair(degree, degree) + 1, 0.0);
        }
        let value = &mut self.value;
        value[0] = (0.25 / PI).sqrt();
        for m in 0..=degree {
            let k = m as f64;
            if m > 0 {
                let factor = if m == 1 { SQRT_2 } else { 1.0 };
                value[pair(m, m)] = factor * ((2.0 * k + 1.0) / (2.0 * k)).sqrt() * s * value[pair(m - 1, m - 1)];
            }
            if m < degree {
                value[pair(m + 1, m)] = (2.0 * k + 3.0).sqrt() * x * value[pair(m, m)];
            }
            for l in m + 2..=degree {
                let n = l as f64;
                let a = ((4.0 * n * n - 1.0) / (n * n - k * k)).sqrt();
                let b = (((n - 1.0) * (n - 1.0) - k * k) / (4.0 * (n - 1.0) * (n - 1.0) - 1.0)).sqrt();
                value[pair(l, m)] = a * (x * value[pair(l - 1, m)] - b * value[pair(l - 2, m)]);
            }
        }
        for l in 1..=degree {
            self.differentiate(l);
        }
    }

    /// Fills in the derivatives of degree l.
    fn differentiate(&mut self, l: usize) {
        let n = l as f64;
        // Neighbours of order m + 1 and m - 1 are worth as much as P_lm itself; only order 0 has no factor sqrt(2).
        let plain = |table: &[f64], l: usize, m: usize| {
            let own = table[pair(l, m)];
            if m == 0 { own } else { FRAC_1_SQRT_2 * own }
        };
        for m in 0..=l {
            let k = m as f64;
            let factor = if m == 0 { 1.0 } else { SQRT_2 };
            let up = if m < l { ((n - k) * (n + k + 1.0)).sqrt() * plain(&self.value, l, m + 1) } else { 0.0 };
            if m == 0 {
                self.theta[pair(l, 0)] = -up;
                continue;
            }
            let down = ((n + k) * (n - k + 1.0)).sqrt() * plain(&self.value, l, m - 1);
            self.theta[pair(l, m)] = 0.5 * factor * (down - up);
            let right = ((n + k) * (n + k - 1.0)).sqrt() * plain(&self.value, l - 1, m - 1);
            let left =
                if m + 1 < l { ((n - k) * (n - k - 1.0)).sqrt() * plain(&self.value, l - 1, m + 1) } else { 0.0 };
            let scale = 0.5 * ((2.0 * n + 1.0) / (2.0 * n - 1.0)).sqrt();
            self.phi[pair(l, m)] = factor * scale * (left + right);
        }
    }
}

/// Returns the points and weights of the Gauss-Legendre rule on (-1, 1), from 1 down to -1: exact for polynomials of
/// degree `2 count - 1`.
///
/// ```
/// let integral: f64 = sphere_harmonics::gauss_legendre(4).iter().map(|(x, weight)| weight * x.powi(6)).sum();
/// assert!((integral - 2.0 / 7.0).abs() < 1e-15);
/// ```
#[must_use]
pub fn gauss_legendre(count: usize) -> Vec<(f64, f64)> {
    let n = count as f64;
    // Legendre's polynomial and its derivative by the angle, whose zeros are well separated.
    let polynomial = |angle: f64| {
        let (s, x) = angle.sin_cos();
        let (mut before, mut value) = (1.0, x);
        for k in 2..=count {
            let k = k as f64;
            (before, value) = (value, ((2.0 * k - 1.0) * x * value - (k - 1.0) * before) / k);
        }
        (value, n * (x * value - before) / s)
    };
    let half = |i: usize| {
        let mut angle = PI * (i as f64 + 0.75) / (n + 0.5);
        for _ in 0..5 {
            let (value, slope) = polynomial(angle);
            angle -= value / slope;
        }
        let slope = polynomial(angle).1;
        (angle.cos(), 2.0 / (slope * slope))
    };
    let mut rule: Vec<(f64, f64)> = (0..count.div_ceil(2)).map(half).collect();
    if count % 2 == 1 {
        rule[count / 2].0 = 0.0;
    }
    let mirrored: Vec<(f64, f64)> = rule[..count / 2].iter().rev().map(|&(x, weight)| (-x, weight)).collect();
    rule.extend(mirrored);
    rule
}

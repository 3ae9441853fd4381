//! The smooth difference between the Stokeslet of a periodic box and that of free space.

use std::f64::consts::{PI, TAU};

use num_complex::Complex64;

use crate::{
    lattice_kernel::LatticePair,
    pair_kernel::{FreePair, PairKernel},
    planes::Planes,
    transform::Transform,
};

/// Largest even power of the expansion that is kept.
pub(crate) const MOST_TERMS: usize = 120;
/// Powers from this one on come from lattice sums, which converge fast there; the ones below from a circle.
const FIRST_LATTICE_SUM: usize = 16;
/// Points on the circle.
const CIRCLE: usize = 64;

/// Coefficients of the smooth part `w_R` of the periodic Stokeslet, which is the periodic one minus the free one. With d
/// the complex distance of target from source and F the force, both in complex form, L the shorter period, V the area:
///
/// ```text
/// w_R = F [ c + (pi/2V)|d|^2 + Re sum s_n (d/L)^n ]
///     + conj F [ -(pi/4V) d^2 + sum t_m conj(d/L)^m - (d/L) sum (n/2) s_n conj(d/L)^(n-1) ]
/// ```
///
/// with even n >= 2 and m >= 0. It converges for |d| < L.
#[derive(Debug, Clone)]
pub(crate) struct Lattice {
    /// The shorter period (length).
    pub(crate) unit: f64,
    /// Area of the box (length squared).
    pub(crate) area: f64,
    /// c.
    pub(crate) constant: f64,
    /// s_n at index n/2.
    pub(crate) s: Vec<f64>,
    /// t_m at index m/2.
    pub(crate) t: Vec<f64>,
}

impl Lattice {
    pub(crate) fn new(periods: [f64; 2]) -> Self {
        let unit = periods[0].min(periods[1]);
        let area = periods[0] * periods[1];
        let radius = 0.5;
        let circle: Vec<Complex64> =
            (0..CIRCLE).map(|j| Complex64::from_polar(radius * unit, TAU * j as f64 / CIRCLE as f64)).collect();
        let mut targets = Planes::default();
        let mut origin = Planes::default();
        let k = TAU / unit;
        let transposed = periods[1] < periods[0];
        targets.fill(&circle, Some(k), transposed);
        origin.fill(&[Complex64::default(); CIRCLE], Some(k), transposed);
        let periodic = LatticePair::new(periods, [0.0; 2], radius * unit, 1e-18);
        let free = FreePair { offset: [0.0; 2] };
        let (target, source) = (targets.window(0, CIRCLE), origin.window(0, CIRCLE));
        let (mut even, mut odd) = (Vec::with_capacity(CIRCLE), Vec::with_capacity(CIRCLE));
        for i in 0..CIRCLE {
            let (p, f) = (periodic.stokeslet(&target, &source, i), free.stokeslet(&target, &source, i));
            let log = 0.5 * (f.q / p.q).ln();
            let (xx, xy, yy) = (log + p.xx - f.xx, p.xy - f.xy, log + p.yy - f.yy);
            even.push(Complex64::new(0.5 * (xx + yy), 0.0));
            odd.push(Complex64::new(0.5 * (xx - yy), xy));
        }
        let mut transform = Transform::new(CIRCLE);
        transform.forward(&mut even);
        transform.forward(&mut odd);

        let half = MOST_TERMS / 2;
        let (mut s, mut t) = (vec![0.0; half + 1], vec![0.0; half + 1]);
        for (i, s) in s.iter_mut().enumerate().skip(1) {
            let n = 2 * i;
            *s = if n < FIRST_LATTICE_SUM {
                2.0 * even[n].re / f64::powi(radius, n as i32)
            } else {
                lattice_sum(periods, unit, n, false) / n as f64
            };
        }
        for (i, t) in t.iter_mut().enumerate() {
            let m = 2 * i;
            *t = if m + 2 < FIRST_LATTICE_SUM {
                let coefficient = odd[(CIRCLE - m) % CIRCLE].re / f64::powi(radius, m as i32);
                coefficient + (i + 1) as f64 * s[i + 1] * radius * radius
            } else {
                0.5 * lattice_sum(periods, unit, m + 1, true)
            };
        }
        let constant = even[0].re - PI / (2.0 * area) * (radius * unit).powi(2);
        Self { unit, area, constant, s, t }
    }

    /// The power at which the expansion can stop for a relative error `tolerance` at distances up to `reach`; `None`
    /// where it would take too many terms.
    pub(crate) fn degree(&self, reach: f64, tolerance: f64) -> Option<usize> {
        let ratio = reach / self.unit;
        if ratio >= 0.8 {
            return None;
        }
        let degree = (tolerance.ln() / ratio.ln()).ceil() as usize;
        let degree = (degree + degree % 2).max(4);
        (degree <= MOST_TERMS).then_some(degree)
    }
}

/// Sum over all lattice points w but the origin of `w^-n`, or of `conj(w) w^-n`, in units of the shorter period.
fn lattice_sum(periods: [f64; 2], unit: f64, n: usize, conjugate: bool) -> f64 {
    const RINGS: i32 = 24;
    let mut sum = 0.0;
    for i in -RINGS..=RINGS {
        for j in -RINGS..=RINGS {
            if (i, j) != (0, 0) {
                let w = Complex64::new(f64::from(i) * periods[0], f64::from(j) * periods[1]) / unit;
                let term = w.powi(-(n as i32));
                sum += if conjugate { (w.conj() * term).re } else { term.re };
            }
        }
    }
    sum
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn coefficients_of_the_square_lattice() {
        // Values for a square box of side 6 (design notes of the method, section B5).
        let lattice = Lattice::new([6.0, 6.0]);
        let scaled = |value: f64, n: i32| value / 6f64.powi(n);
        assert!((lattice.constant + 0.018_773_456_683_454_6).abs() < 1e-14);
        assert!((scaled(lattice.s[2], 4) - 6.078_726_856_006_77e-4).abs() < 1e-16);
        assert!((scaled(lattice.s[4], 8) - 3.167_221_73e-7).abs() < 1e-15);
        assert!((scaled(lattice.s[6], 12) - 1.507_901_88e-10).abs() < 1e-18);
        assert!((scaled(lattice.t[1], 2) - 0.034_828_539_366_201_4).abs() < 1e-14);
        assert!((scaled(lattice.t[3], 6) - 4.839_158_345_16e-5).abs() < 1e-15);
        assert!((scaled(lattice.t[5], 10) - 3.209_009_65e-8).abs() < 1e-15);
        assert!(lattice.s[1].abs() < 1e-13 && lattice.s[3].abs() < 1e-12 && lattice.t[0].abs() < 1e-14);
    }

    #[test]
    fn circle_and_lattice_sums_agree() {
        for periods in [[6.0, 6.0], [8.0, 5.0], [4.0, 10.0]] {
            let lattice = Lattice::new(periods);
            for n in [8, 10, 12, 14] {
                // What the rings of the sum leave out, and the round-off of the circle.
                let bound = 10.0 * 24f64.powi(2 - n as i32) + 1e-15 * 2f64.powi(n as i32);
                let sum = lattice_sum(periods, lattice.unit, n, false) / n as f64;
                assert!((lattice.s[n / 2] - sum).abs() < bound, "{periods:?} {n}");
                let sum = 0.5 * lattice_sum(periods, lattice.unit, n - 1, true);
                assert!((lattice.t[n / 2 - 1] - sum).abs() < bound, "{periods:?} {n}");
            }
        }
    }

    #[test]
    fn swapping_the_periods_swaps_the_axes() {
        // Rows along y instead of x: the sum over rows takes another path to the same numbers.
        let (wide, tall) = (Lattice::new([7.0, 4.0]), Lattice::new([4.0, 7.0]));
        assert!((wide.constant - tall.constant).abs() < 1e-13);
        assert!((wide.t[0] + tall.t[0]).abs() < 1e-13);
        for i in 1..5 {
            let sign = if i % 2 == 0 { 1.0 } else { -1.0 };
            assert!((wide.s[i] - sign * tall.s[i]).abs() < 1e-11, "{i}");
            assert!((wide.t[i] + sign * tall.t[i]).abs() < 1e-11, "{i}");
        }
    }
}

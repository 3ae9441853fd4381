//! Straight walls along which fluid slips.

use num_complex::Complex64;

use super::determinants;

/// Two walls at y = h and -h with slip lengths: `u + b du/dn = 0` and `v = 0` with the normal n outwards.
///
/// A linear flow vanishes not at the walls but at the `ends` a = h + b behind the upper one and -(h + b) behind the
/// lower one. The flow of a unit pressure gradient is half of `h^2 - y^2 + 2 A + 2 B y`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Slipping {
    /// Slip lengths of the upper and the lower wall (length).
    pub(crate) lengths: [f64; 2],
    half: f64,
    /// Distances of the ends from the middle, upper and lower (length).
    pub(crate) ends: [f64; 2],
    /// 2 A (length squared) and 2 B (length).
    pub(crate) profile: [f64; 2],
}

impl Slipping {
    /// Returns the walls of a channel of this half width (length) with slip lengths of the lower and the upper wall
    /// (length); `None` without slip.
    pub(crate) fn new(half: f64, [lower, upper]: [f64; 2]) -> Option<Self> {
        if [lower, upper] == [0.0; 2] {
            return None;
        }
        let ends = [half + upper, half + lower];
        let slope = half * (upper - lower) / (ends[0] + ends[1]);
        // upper half - slope ends[0], without the cancellation of large slip lengths.
        let constant = half * (half * (upper + lower) + 2.0 * upper * lower) / (ends[0] + ends[1]);
        Some(Self { lengths: [upper, lower], half, ends, profile: [2.0 * constant, 2.0 * slope] })
    }

    /// Returns the part 1, y of the flow `a0 + a1 y - |y - y0|` of a force at y0 between the walls, for forces of the
    /// sums 1, y0.
    pub(crate) fn between(&self, [s0, s1]: [f64; 2]) -> [f64; 2] {
        let [a, b] = self.ends;
        let sum = a + b;
        [(2.0 * a * b * s0 + (a - b) * s1) / sum, ((a - b) * s0 - 2.0 * s1) / sum]
    }

    /// Returns what slip adds to the sum of `(h^2 - y^2) F_x`, for the sums of F_x and y F_x: 2 l eta times the flux.
    pub(crate) fn moment(&self, [s0, s1]: [f64; 2]) -> f64 {
        self.profile[0] * s0 + self.profile[1] * s1
    }

    /// Returns the flux of the flow `h^2 - y^2 + 2 A + 2 B y` (length cubed).
    pub(crate) fn flux(&self) -> f64 {
        let h = self.half;
        2.0 * h * (2.0 / 3.0 * h * h + self.profile[0])
    }

    /// Subtracts the flow of a pressure gradient with that flux from the coefficients of 1, y and h^2 - y^2.
    pub(crate) fn take_flux(&self, flux: f64, mean: &mut [f64; 3]) {
        let amount = flux / self.flux();
        mean[0] -= self.profile[0] * amount;
        mean[1] -= self.profile[1] * amount;
        mean[2] -= amount;
    }

    /// Returns the coefficients a, b, c, d of the streamfunction of a wave number k (1/length),
    /// `a cosh(ky) - b (h cosh(ky) - y sinh(ky)) + c sinh(ky) - d (h sinh(ky) - y cosh(ky))`, scaled by `exp(kh)`. Its
    /// even and odd parts are P at the wall; the even and odd parts of slope plus slip length times curvature are Q.
    pub(crate) fn solve(&self, k: f64, [pe, po]: [Complex64; 2], [qe, qo]: [Complex64; 2]) -> [Complex64; 4] {
        let [upper, lower] = self.lengths;
        let kh = k * self.half;
        let decay = (-2.0 * kh).exp();
        let (sinh, cosh) = (0.5 * -(-2.0 * kh).exp_m1(), 0.5 * (1.0 + decay));
        let [even, odd] = determinants(kh);
        let (mean, unlike) = (0.5 * (upper + lower), 0.5 * (upper - lower));
        let square = k * k;
        let right_even = (qe - (pe * mean + po * unlike) * square) * cosh - pe * (k * sinh);
        let right_odd = (qo - (po * mean + pe * unlike) * square) * sinh - po * (k * cosh);
        let (on_even, on_odd) = (even + 2.0 * mean * k * cosh * cosh, odd + 2.0 * mean * k * sinh * sinh);
        let across = 2.0 * unlike * k * sinh * cosh;
        let (b, d) = if unlike == 0.0 {
            (right_even / on_even, right_odd / on_odd)
        } else {
            // on_even on_odd - across^2, a sum of positive terms.
            let determinant = even * odd
                + 2.0 * mean * k * (even * sinh * sinh + odd * cosh * cosh)
                + 4.0 * upper * lower * (k * sinh * cosh).powi(2);
            (
                (right_even * on_odd - right_odd * across) / determinant,
                (right_odd * on_even - right_even * across) / determinant,
            )
        };
        let tail = self.half * decay;
        [(pe + b * tail) / cosh, b, (po - d * tail) / sinh, d]
    }
}

//! Velocity, gradient and pressure of the walls' correction at points.

use num_complex::Complex64;

use super::{LANES, Lanes, WallModes, WallPoints};
use crate::greens::Flow;

impl WallModes {
    /// Returns the flow of the correction at point i.
    pub(crate) fn flow(&self, points: &WallPoints, i: usize) -> Flow {
        let y = points.y[i];
        let mut velocity = Complex64::new(self.mean_velocity(y), self.rise);
        // du/dx = -dv/dy, du/dy and dv/dx.
        let (mut ux, mut uy, mut vx) = (0.0, self.mean[1] - 2.0 * self.mean[2] * y, 0.0);
        let mut pressure = 0.0;
        for (side, sign) in [(0, 1.0), (1, -1.0)] {
            let mut powers = points.sides[side][i];
            let s = powers.distance;
            let mut k: Lanes = std::array::from_fn(|lane| self.k * (lane + 1) as f64);
            // Sums over modes of k R + B, k R and k B, and of the latter two times k.
            let [mut sum, mut plain, mut linear_re, mut linear_im] = [[0.0; LANES]; 4];
            let [mut k_plain_re, mut k_plain_im, mut k_linear_re, mut k_linear_im] = [[0.0; LANES]; 4];
            for c in self.coefficients(side, s) {
                for lane in 0..LANES {
                    let (re, im) = (powers.re[lane], powers.im[lane]);
                    let r =
                        [re * c.plain[0][lane] - im * c.plain[1][lane], re * c.plain[1][lane] + im * c.plain[0][lane]];
                    let b = [
                        re * c.linear[0][lane] - im * c.linear[1][lane],
                        re * c.linear[1][lane] + im * c.linear[0][lane],
                    ];
                    sum[lane] += re * c.sum[0][lane] - im * c.sum[1][lane];
                    plain[lane] += r[1];
                    linear_re[lane] += b[0];
                    linear_im[lane] += b[1];
                    k_plain_re[lane] += k[lane] * r[0];
                    k_plain_im[lane] += k[lane] * r[1];
                    k_linear_re[lane] += k[lane] * b[0];
                    k_linear_im[lane] += k[lane] * b[1];
                    k[lane] += self.k * LANES as f64;
                }
                powers.advance();
            }
            let total = |lanes: Lanes| lanes.iter().sum::<f64>();
            let (linear_re, linear_im) = (total(linear_re), total(linear_im));
            let (k_linear_re, k_linear_im) = (s * total(k_linear_re), s * total(k_linear_im));
            velocity += Complex64::new(sign * (total(sum) - s * linear_re), total(plain) - s * linear_im);
            ux -= sign * (total(k_plain_im) + linear_im - k_linear_im);
            uy += total(k_plain_re) + 2.0 * linear_re - k_linear_re;
            vx += total(k_plain_re) - k_linear_re;
            pressure += 2.0 * sign * linear_im;
        }
        let (spin, strain) = (Complex64::new(0.0, 0.5 * (vx - uy)), Complex64::new(ux, 0.5 * (vx + uy)));
        Flow { velocity, spin, strain, pressure }
    }
}

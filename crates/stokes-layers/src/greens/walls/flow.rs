//! Velocity, gradient and pressure of the walls' correction at points.

use num_complex::Complex64;

use super::{LANES, WallModes, WallPoints};
use crate::greens::Flow;

impl WallModes {
    /// Velocity, gradient and pressure of the correction at point i.
    pub(crate) fn flow(&self, points: &WallPoints, i: usize) -> Flow {
        let y = points.y[i];
        let mut velocity = Complex64::new(self.mean_velocity(y), 0.0);
        // du/dx = -dv/dy, du/dy and dv/dx.
        let (mut ux, mut uy, mut vx) = (0.0, self.mean[1] - 2.0 * self.mean[2] * y, 0.0);
        let mut pressure = 0.0;
        for (side, sign) in [(0, 1.0), (1, -1.0)] {
            let mut powers = points.sides[side][i];
            let s = powers.distance;
            for (chunk, c) in self.coefficients[side].iter().enumerate() {
                for lane in 0..LANES {
                    let k = self.k * (chunk * LANES + lane + 1) as f64;
                    let e = Complex64::new(powers.re[lane], powers.im[lane]);
                    let plain = e * Complex64::new(c.plain[0][lane], c.plain[1][lane]);
                    let linear = e * Complex64::new(c.linear[0][lane], c.linear[1][lane]);
                    let bend = linear / k;
                    // psi, its slope and its second derivative in y, times k, 1 and 1.
                    let psi = plain - linear * s;
                    let slope = (plain + bend - linear * s) * sign;
                    let second = (plain + 2.0 * bend - linear * s) * k;
                    velocity += Complex64::new(slope.re, psi.im);
                    ux -= k * slope.im;
                    uy += second.re;
                    vx += k * psi.re;
                    pressure += 2.0 * sign * linear.im;
                }
                powers.advance();
            }
        }
        let (spin, strain) = (Complex64::new(0.0, 0.5 * (vx - uy)), Complex64::new(ux, 0.5 * (vx + uy)));
        Flow { velocity, spin, strain, pressure }
    }
}

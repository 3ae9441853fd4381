//! Velocity, gradient and pressure of the walls' correction at points.

use num_complex::Complex64;

use super::{
    wall_points::{LANES, WallPoints},
    walls::WallModes,
};

/// Flow of the correction at a point, per 4 pi viscosity.
#[derive(Debug, Clone, Copy, Default)]
pub(crate) struct WallFlow {
    pub(crate) velocity: [f64; 2],
    pub(crate) gradient: [[f64; 2]; 2],
    pub(crate) pressure: f64,
}

impl WallModes {
    /// Velocity, gradient and pressure of the correction at point i.
    pub(crate) fn flow(&self, points: &WallPoints, i: usize) -> WallFlow {
        let y = points.y[i];
        let mut flow = WallFlow::default();
        flow.velocity[0] = self.mean_velocity(y);
        flow.gradient[0][1] = self.mean[1] - 2.0 * self.mean[2] * y;
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
                    flow.velocity[0] += slope.re;
                    flow.velocity[1] += psi.im;
                    flow.gradient[0][0] -= k * slope.im;
                    flow.gradient[1][1] += k * slope.im;
                    flow.gradient[0][1] += second.re;
                    flow.gradient[1][0] += k * psi.re;
                    flow.pressure += 2.0 * sign * linear.im;
                }
                powers.advance();
            }
        }
        flow
    }
}

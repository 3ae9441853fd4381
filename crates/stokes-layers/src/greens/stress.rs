//! The stress of the Green's function of a periodic box or of a row of images, for many sources at a time.

use std::f64::consts::TAU;

use crate::{Vec2, geometry::Images};

/// Sources done at a time.
const LANES: usize = 8;

type Lanes = [f64; LANES];

/// The stress `T_abc` at a source of the Green's function `lap G - grad p = -4 pi delta` with its pole at a target, as
/// a function of source minus target.
///
/// Images in rows along x of period l are summed in closed form. With k = 2 pi/l and the harmonic
/// `A = 1/2 ln(2 cosh ky - 2 cos kx)`:
///
/// ```text
/// T_xxx = -4 A_x - 2 y A_xy,  T_xxy = -2 A_y + 2 y A_xx,  T_xyy = 2 y A_xy,  T_yyy = -2 A_y - 2 y A_xx
/// ```
///
/// A doubly periodic box sums rows, whose distance from the first makes them fall off like `exp(-k |y|)`, and adds
/// `2 k y/L_y` to T_xxy and T_yyy, which makes the mean velocity zero. Rows run along the shorter period.
#[derive(Debug, Clone)]
pub(crate) struct StressKernel {
    k: f64,
    /// Period across the rows (length), infinite in a channel.
    across: f64,
    rows: usize,
    decay: f64,
    transposed: bool,
}

/// Sources by functions of their coordinates, as in [`StressKernel::coordinates`].
#[derive(Debug, Clone, Default)]
pub(crate) struct Sources {
    count: usize,
    lanes: Vec<[Lanes; 5]>,
}

impl StressKernel {
    /// For a box, or a channel without its walls; rows as many as bring the rest below `tolerance`.
    pub(crate) fn new(images: &Images, tolerance: f64) -> Self {
        let [x, y] = images.periods.map(|period| period.unwrap_or(f64::INFINITY));
        let transposed = y < x;
        let (along, across) = if transposed { (y, x) } else { (x, y) };
        let k = TAU / along;
        // Sources and targets are less than one and a half half-periods apart across the rows.
        let rows = (((-tolerance.ln() / k + 0.75 * across) / across).ceil() as usize).max(2) - 1;
        let rows = if across.is_finite() { rows } else { 0 };
        Self { k, across, rows, decay: (-k * across).exp(), transposed }
    }

    /// Takes over source positions relative to their centre.
    pub(crate) fn load(&self, positions: &[Vec2], sources: &mut Sources) {
        sources.count = positions.len();
        sources.lanes.clear();
        for chunk in positions.chunks(LANES) {
            let mut lanes = [[0.0; LANES]; 5];
            for (lane, position) in chunk.iter().enumerate() {
                for (array, value) in lanes.iter_mut().zip(self.coordinates(*position)) {
                    array[lane] = value;
                }
            }
            sources.lanes.push(lanes);
        }
    }

    /// The coordinate y across the rows, sine and cosine of k x/2 along them, exp(k y/2) and exp(-k y/2).
    fn coordinates(&self, position: Vec2) -> [f64; 5] {
        let (along, across) = if self.transposed { (position.y, position.x) } else { (position.x, position.y) };
        let (sin, cos) = (0.5 * self.k * along).sin_cos();
        let up = (0.5 * self.k * across).exp();
        [across, sin, cos, up, 1.0 / up]
    }

    /// Calls `take` with the number of each source from `first` on and the stress (xxx, xxy, xyy, yyy) between it and a
    /// target relative to the centre of the sources; a source at the target gives no numbers.
    pub(crate) fn stresses(
        &self,
        target: Vec2,
        sources: &Sources,
        first: usize,
        mut take: impl FnMut(usize, [f64; 4]),
    ) {
        let target = self.coordinates(target);
        for (chunk, lanes) in sources.lanes.iter().enumerate().skip(first / LANES) {
            let stresses = self.lanes(&target, lanes);
            let start = chunk * LANES;
            for source in first.max(start)..sources.count.min(start + LANES) {
                take(source, stresses.map(|component| component[source - start]));
            }
        }
    }

    #[inline(always)]
    fn lanes(&self, target: &[f64; 5], sources: &[Lanes; 5]) -> [Lanes; 4] {
        let k = self.k;
        let [t_y, t_sin, t_cos, t_up, t_down] = *target;
        let [s_y, s_sin, s_cos, s_up, s_down] = sources;
        let [mut dy, mut sin, mut cos, mut up, mut down] = [[0.0; LANES]; 5];
        // A_x, A_y, y A_xx and y A_xy, y the distance from each row.
        let [mut ax, mut ay, mut bend_xx, mut bend_xy] = [[0.0; LANES]; 4];
        for i in 0..LANES {
            let s = s_sin[i] * t_cos - s_cos[i] * t_sin;
            let c = s_cos[i] * t_cos + s_sin[i] * t_sin;
            let (u, d) = (s_up[i] * t_down, s_down[i] * t_up);
            let (sh, ch) = (0.5 * (u - d), 0.5 * (u + d));
            let (s2, sh2) = (s * s, sh * sh);
            let factor = k / (2.0 * (s2 + sh2));
            let (sc, shch) = (s * c, sh * ch);
            let square = factor * factor;
            dy[i] = s_y[i] - t_y;
            (sin[i], cos[i], up[i], down[i]) = (2.0 * sc, 1.0 - 2.0 * s2, u * u, d * d);
            (ax[i], ay[i]) = (factor * sc, factor * shch);
            bend_xx[i] = dy[i] * (square * (sh2 - s2 - 2.0 * s2 * sh2));
            bend_xy[i] = dy[i] * (-2.0 * square * sc * shch);
        }
        for m in 1..=self.rows {
            let shrink = self.decay.powi(m as i32);
            let height = self.across * m as f64;
            for (power, side) in [(&down, 1.0), (&up, -1.0)] {
                for i in 0..LANES {
                    let b = power[i] * shrink;
                    let y = dy[i] + side * height;
                    let inverse = 1.0 / (1.0 - 2.0 * b * cos[i] + b * b);
                    let factor = k * b * inverse;
                    let square = k * factor * inverse;
                    ax[i] += factor * sin[i];
                    ay[i] += side * factor * (cos[i] - b);
                    bend_xx[i] += y * (square * (cos[i] * (1.0 + b * b) - 2.0 * b));
                    bend_xy[i] += y * (-side * square * sin[i] * (1.0 - b * b));
                }
            }
        }
        let mut stress = [[0.0; LANES]; 4];
        let [xxx, xxy, xyy, yyy] = &mut stress;
        for i in 0..LANES {
            // No such mean in a channel, whose period across is infinite.
            let mean = 2.0 * k * dy[i] / self.across;
            xxx[i] = -4.0 * ax[i] - 2.0 * bend_xy[i];
            xxy[i] = mean - 2.0 * ay[i] + 2.0 * bend_xx[i];
            xyy[i] = 2.0 * bend_xy[i];
            yyy[i] = mean - 2.0 * ay[i] - 2.0 * bend_xx[i];
        }
        if self.transposed {
            stress.reverse();
        }
        stress
    }
}

#[cfg(test)]
mod tests;

//! The stress of the Green's function of a periodic box or of a row of images.

use std::f64::consts::TAU;

use crate::{Vec2, region::Images};

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
    /// Period across the rows (length), none in a channel.
    across: Option<f64>,
    rows: usize,
    decay: f64,
    transposed: bool,
    work: Work,
}

/// Sums over rows for one target and many sources.
#[derive(Debug, Clone, Default)]
struct Work {
    dy: Vec<f64>,
    sin: Vec<f64>,
    cos: Vec<f64>,
    up: Vec<f64>,
    down: Vec<f64>,
    ax: Vec<f64>,
    ay: Vec<f64>,
    axx: Vec<f64>,
    axy: Vec<f64>,
    /// y A_xx and y A_xy, y the distance from each row.
    bent: [Vec<f64>; 2],
}

/// Sources with the functions of their coordinates that the rows need.
#[derive(Debug, Clone, Default)]
pub(crate) struct Sources {
    across: Vec<f64>,
    sin: Vec<f64>,
    cos: Vec<f64>,
    up: Vec<f64>,
    down: Vec<f64>,
}

/// A target in the frame of the sources.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Target {
    across: f64,
    sin: f64,
    cos: f64,
    up: f64,
    down: f64,
}

/// Stress between one target and one source.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Stress {
    pub(crate) xxx: f64,
    pub(crate) xxy: f64,
    pub(crate) xyy: f64,
    pub(crate) yyy: f64,
}

impl StressKernel {
    /// For a box, or a channel without its walls; rows as many as bring the rest below `tolerance`.
    pub(crate) fn new(images: &Images, tolerance: f64) -> Self {
        let [x, y] = images.periods.map(|period| period.unwrap_or(f64::INFINITY));
        let transposed = y < x;
        let (along, across) = if transposed { (y, x) } else { (x, y) };
        let k = TAU / along;
        let across = across.is_finite().then_some(across);
        // Sources and targets are less than one and a half half-periods apart across the rows.
        let rows = across.map_or(0, |across| {
            let reach = 0.75 * across;
            (((-tolerance.ln() / k + reach) / across).ceil() as usize).max(2) - 1
        });
        let decay = across.map_or(0.0, |across| (-k * across).exp());
        Self { k, across, rows, decay, transposed, work: Work::default() }
    }

    /// Takes over source positions relative to their centre.
    pub(crate) fn load(&self, positions: impl Iterator<Item = Vec2>, sources: &mut Sources) {
        let Sources { across, sin, cos, up, down } = sources;
        for array in [&mut *across, sin, cos, up, down] {
            array.clear();
        }
        for position in positions {
            let target = self.target(position);
            sources.across.push(target.across);
            sources.sin.push(target.sin);
            sources.cos.push(target.cos);
            sources.up.push(target.up);
            sources.down.push(target.down);
        }
    }

    /// A target at a position relative to the centre of the sources.
    pub(crate) fn target(&self, position: Vec2) -> Target {
        let (along, across) = if self.transposed { (position.y, position.x) } else { (position.x, position.y) };
        let (sin, cos) = (0.5 * self.k * along).sin_cos();
        let up = (0.5 * self.k * across).exp();
        Target { across, sin, cos, up, down: 1.0 / up }
    }

    /// Sums the rows for `target` and the sources from `first` on; a source at the target gives no numbers.
    pub(crate) fn sum(&mut self, target: &Target, sources: &Sources, first: usize) {
        let n = sources.across.len() - first;
        self.work.resize(n);
        let Work { dy, sin, cos, up, down, ax, ay, axx, axy, bent: [bend_xx, bend_xy] } = &mut self.work;
        // Slices of one known length let the compiler use vector registers.
        let (dy, sin, cos, up, down) = (&mut dy[..n], &mut sin[..n], &mut cos[..n], &mut up[..n], &mut down[..n]);
        let (ax, ay, axx, axy) = (&mut ax[..n], &mut ay[..n], &mut axx[..n], &mut axy[..n]);
        let (bend_xx, bend_xy) = (&mut bend_xx[..n], &mut bend_xy[..n]);
        let (s_y, s_sin, s_cos) =
            (&sources.across[first..][..n], &sources.sin[first..][..n], &sources.cos[first..][..n]);
        let (s_up, s_down) = (&sources.up[first..][..n], &sources.down[first..][..n]);
        let k = self.k;
        let t = *target;
        for i in 0..n {
            let s = s_sin[i] * t.cos - s_cos[i] * t.sin;
            let c = s_cos[i] * t.cos + s_sin[i] * t.sin;
            let (u, d) = (s_up[i] * t.down, s_down[i] * t.up);
            let (sh, ch) = (0.5 * (u - d), 0.5 * (u + d));
            let (s2, sh2) = (s * s, sh * sh);
            let factor = k / (2.0 * (s2 + sh2));
            let (sc, shch) = (s * c, sh * ch);
            let square = factor * factor;
            dy[i] = s_y[i] - t.across;
            sin[i] = 2.0 * sc;
            cos[i] = 1.0 - 2.0 * s2;
            up[i] = u * u;
            down[i] = d * d;
            ax[i] = factor * sc;
            ay[i] = factor * shch;
            axx[i] = square * (sh2 - s2 - 2.0 * s2 * sh2);
            axy[i] = -2.0 * square * sc * shch;
            bend_xx[i] = dy[i] * axx[i];
            bend_xy[i] = dy[i] * axy[i];
        }
        let Some(across) = self.across else { return };
        for m in 1..=self.rows {
            let shrink = self.decay.powi(m as i32);
            let height = across * m as f64;
            for (power, side) in [(&*down, 1.0), (&*up, -1.0)] {
                for i in 0..n {
                    let b = power[i] * shrink;
                    let y = dy[i] + side * height;
                    let inverse = 1.0 / (1.0 - 2.0 * b * cos[i] + b * b);
                    let factor = k * b * inverse;
                    let square = k * factor * inverse;
                    let (xx, xy) =
                        (square * (cos[i] * (1.0 + b * b) - 2.0 * b), -side * square * sin[i] * (1.0 - b * b));
                    ax[i] += factor * sin[i];
                    ay[i] += side * factor * (cos[i] - b);
                    axx[i] += xx;
                    axy[i] += xy;
                    bend_xx[i] += y * xx;
                    bend_xy[i] += y * xy;
                }
            }
        }
    }

    /// The stress of the last sums at source `first + i`.
    #[inline(always)]
    pub(crate) fn stress(&self, i: usize) -> Stress {
        let w = &self.work;
        let mean = self.across.map_or(0.0, |across| 2.0 * self.k * w.dy[i] / across);
        let (ax, ay, bend_xx, bend_xy) = (w.ax[i], w.ay[i], w.bent[0][i], w.bent[1][i]);
        let [a, b, c, d] = [
            -4.0 * ax - 2.0 * bend_xy,
            mean - 2.0 * ay + 2.0 * bend_xx,
            2.0 * bend_xy,
            mean - 2.0 * ay - 2.0 * bend_xx,
        ];
        if self.transposed {
            Stress { xxx: d, xxy: c, xyy: b, yyy: a }
        } else {
            Stress { xxx: a, xxy: b, xyy: c, yyy: d }
        }
    }
}

impl Work {
    fn resize(&mut self, n: usize) {
        let Self { dy, sin, cos, up, down, ax, ay, axx, axy, bent: [bend_xx, bend_xy] } = self;
        for array in [dy, sin, cos, up, down, ax, ay, axx, axy, bend_xx, bend_xy] {
            array.resize(n, 0.0);
        }
    }
}

#[cfg(test)]
mod tests;

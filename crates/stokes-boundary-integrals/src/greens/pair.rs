//! Stokeslet and stress between two nodes: in free space, for a row of images and for all images of a periodic box.

use super::{nodes::Window, point::ln};

/// Parts of a Stokeslet `G = -1/2 ln(q) I + [[xx, xy], [xy, yy]]`.
pub(crate) struct Stokeslet {
    pub(crate) q: f64,
    pub(crate) xx: f64,
    pub(crate) xy: f64,
    pub(crate) yy: f64,
}

/// A Green's function of the Stokes equations, `lap G - grad p = -4 pi delta`, and its stress, between node i of two
/// windows.
pub(crate) trait PairKernel {
    /// Returns the Stokeslet of pair i.
    fn stokeslet(&self, target: &Window<'_>, source: &Window<'_>, i: usize) -> Stokeslet;

    /// Returns the stress (xxx, xxy, xyy, yyy) as a function of source minus target.
    fn stress(&self, target: &Window<'_>, source: &Window<'_>, i: usize) -> [f64; 4];

    /// Returns the velocities at the target and at the source: the stress acting on dipoles (xx, s, yy) at the source
    /// and at the target.
    #[inline(always)]
    fn act(&self, t: &Window<'_>, s: &Window<'_>, i: usize, source: [f64; 3], target: [f64; 3]) -> [[f64; 2]; 2] {
        let [xxx, xxy, xyy, yyy] = self.stress(t, s, i);
        let act = |[xx, s, yy]: [f64; 3]| [xxx * xx + xxy * s + xyy * yy, xxy * xx + xyy * s + yyy * yy];
        // The stress is odd in the distance.
        [act(source), act(target).map(|u| -u)]
    }

    /// Returns the diagonal (xx, xy, yy) of `G + ln|alpha difference|` on a curve with derivative (tx, ty) by the
    /// parameter.
    fn diagonal(&self, tx: f64, ty: f64) -> [f64; 3];
}

/// Free space: `G = -ln r I + xx/r^2`, `T = -4 xxx/r^4`.
#[derive(Debug, Clone, Copy)]
pub(crate) struct FreePair {
    /// Centre of the source minus centre of the target (length).
    pub(crate) offset: [f64; 2],
}

impl PairKernel for FreePair {
    #[inline(always)]
    fn stokeslet(&self, t: &Window<'_>, s: &Window<'_>, i: usize) -> Stokeslet {
        let (dx, dy) = (s.x[i] - t.x[i] + self.offset[0], s.y[i] - t.y[i] + self.offset[1]);
        let q = dx * dx + dy * dy;
        let inverse = 1.0 / q;
        Stokeslet { q, xx: dx * dx * inverse, xy: dx * dy * inverse, yy: dy * dy * inverse }
    }

    #[inline(always)]
    fn stress(&self, t: &Window<'_>, s: &Window<'_>, i: usize) -> [f64; 4] {
        let (dx, dy) = (s.x[i] - t.x[i] + self.offset[0], s.y[i] - t.y[i] + self.offset[1]);
        let inverse = 1.0 / (dx * dx + dy * dy);
        let xx = -4.0 * dx * dx * inverse * inverse;
        let yy = -4.0 * dy * dy * inverse * inverse;
        [xx * dx, xx * dy, yy * dx, yy * dy]
    }

    #[inline(always)]
    fn act(&self, t: &Window<'_>, s: &Window<'_>, i: usize, source: [f64; 3], target: [f64; 3]) -> [[f64; 2]; 2] {
        let (dx, dy) = (s.x[i] - t.x[i] + self.offset[0], s.y[i] - t.y[i] + self.offset[1]);
        let (xx, xy, yy) = (dx * dx, dx * dy, dy * dy);
        let inverse = 1.0 / (xx + yy);
        let factor = -4.0 * inverse * inverse;
        let a = factor * (xx * source[0] + xy * source[1] + yy * source[2]);
        let b = factor * (xx * target[0] + xy * target[1] + yy * target[2]);
        [[a * dx, a * dy], [-b * dx, -b * dy]]
    }

    fn diagonal(&self, tx: f64, ty: f64) -> [f64; 3] {
        let square = tx * tx + ty * ty;
        let log = -0.5 * ln(square);
        [log + tx * tx / square, tx * ty / square, log + ty * ty / square]
    }
}

/// A row of images along x, unbounded in y: with `A = 1/2 ln(2 cosh k dy - 2 cos k dx)` and k = 2 pi/period,
///
/// ```text
/// G_xx = 1 - A - dy A_y,   G_xy = dy A_x,   G_yy = -A + dy A_y
/// ```
///
/// (Pozrikidis, Boundary Integral and Singularity Methods, 1992). Circular and hyperbolic functions of differences are
/// products of the functions of the nodes and of the offset of the curves, so that a pair needs no separate evaluation.
#[derive(Debug, Clone, Copy)]
pub(crate) struct RowPair {
    /// 2 pi / period (1/length).
    k: f64,
    sin: f64,
    cos: f64,
    up: f64,
    down: f64,
    dy: f64,
}

/// Circular and hyperbolic functions of the difference of two nodes.
struct RowTerms {
    /// sin and cos of k dx/2.
    s: f64,
    c: f64,
    /// sinh and cosh of k dy/2.
    sh: f64,
    ch: f64,
    /// dy (length).
    dy: f64,
}

impl RowPair {
    /// Returns the kernel for a source whose centre lies `[along, across]` (length) from the centre of the target.
    pub(crate) fn new(k: f64, [along, across]: [f64; 2]) -> Self {
        let (sin, cos) = (0.5 * k * along).sin_cos();
        let up = (0.5 * k * across).exp();
        Self { k, sin, cos, up, down: 1.0 / up, dy: across }
    }

    #[inline(always)]
    fn terms(&self, t: &Window<'_>, s: &Window<'_>, i: usize) -> RowTerms {
        let sin = s.sin[i] * t.cos[i] - s.cos[i] * t.sin[i];
        let cos = s.cos[i] * t.cos[i] + s.sin[i] * t.sin[i];
        let (up, down) = (s.up[i] * t.down[i] * self.up, s.down[i] * t.up[i] * self.down);
        RowTerms {
            s: sin * self.cos + cos * self.sin,
            c: cos * self.cos - sin * self.sin,
            sh: 0.5 * (up - down),
            ch: 0.5 * (up + down),
            dy: s.y[i] - t.y[i] + self.dy,
        }
    }
}

impl PairKernel for RowPair {
    #[inline(always)]
    fn stokeslet(&self, t: &Window<'_>, s: &Window<'_>, i: usize) -> Stokeslet {
        let RowTerms { s, c, sh, ch, dy } = self.terms(t, s, i);
        let q = 2.0 * (s * s + sh * sh);
        let factor = self.k * dy / q;
        let (ax, ay) = (s * c * factor, sh * ch * factor);
        Stokeslet { q: 2.0 * q, xx: 1.0 - ay, xy: ax, yy: ay }
    }

    #[inline(always)]
    fn stress(&self, t: &Window<'_>, s: &Window<'_>, i: usize) -> [f64; 4] {
        let RowTerms { s, c, sh, ch, dy } = self.terms(t, s, i);
        let k = self.k;
        let (s2, sh2) = (s * s, sh * sh);
        let factor = k / (2.0 * (s2 + sh2));
        let (sc, shch) = (s * c, sh * ch);
        let (ax, ay) = (factor * sc, factor * shch);
        let square = 2.0 * dy * factor * factor;
        let axx = square * (sh2 - s2 - 2.0 * s2 * sh2);
        let axy = -2.0 * square * sc * shch;
        [-4.0 * ax - axy, axx - 2.0 * ay, axy, -2.0 * ay - axx]
    }

    fn diagonal(&self, tx: f64, ty: f64) -> [f64; 3] {
        let square = tx * tx + ty * ty;
        let log = -0.5 * ln(self.k * self.k * square);
        [log + tx * tx / square, tx * ty / square, log + ty * ty / square]
    }
}

/// All images of a periodic box as rows along x: the row of the nodes themselves and the neighbouring rows, whose
/// functions fall off like `exp(-k |y|)`. In a box that is `SHEARED`, the rows are displaced along x.
#[derive(Debug, Clone, Copy)]
pub(crate) struct LatticePair<const SHEARED: bool> {
    row: RowPair,
    /// Period across the rows (length).
    across: f64,
    rows: usize,
    decay: f64,
    /// Cosine and sine of the phase by which the next row above is displaced.
    turn: [f64; 2],
}

impl<const SHEARED: bool> LatticePair<SHEARED> {
    /// Returns the kernel for a source whose centre lies `offset` (length) from the centre of the target, with as many
    /// rows of images as bring the rest below `tolerance`. Each is displaced by `tilt` along x (length) from the one
    /// below.
    pub(crate) fn new([lx, ly]: [f64; 2], tilt: f64, offset: [f64; 2], tolerance: f64) -> Self {
        let k = std::f64::consts::TAU / lx;
        let rows = (1.0 - tolerance.ln() / (k * ly)).ceil() as usize;
        let (sin, cos) = (k * tilt).sin_cos();
        Self { row: RowPair::new(k, offset), across: ly, rows, decay: (-k * ly).exp(), turn: [cos, sin] }
    }

    /// Calls `take` for each row after the first one, with b = exp(-k |y|), cosine and sine of k x, the distance y and
    /// the sign of its side.
    #[inline(always)]
    fn beside(&self, terms: &RowTerms, mut take: impl FnMut(f64, [f64; 2], f64, f64)) {
        let (up, down) = (terms.ch + terms.sh, terms.ch - terms.sh);
        let (sin, cos) = (2.0 * terms.s * terms.c, 1.0 - 2.0 * terms.s * terms.s);
        let (mut shrink, [mut c, mut s]) = (1.0, [1.0, 0.0]);
        for m in 1..=self.rows {
            shrink *= self.decay;
            let height = self.across * m as f64;
            if !SHEARED {
                take(down * down * shrink, [cos, sin], terms.dy + height, 1.0);
                take(up * up * shrink, [cos, sin], terms.dy - height, -1.0);
                continue;
            }
            [c, s] = [c * self.turn[0] - s * self.turn[1], s * self.turn[0] + c * self.turn[1]];
            take(down * down * shrink, [cos * c - sin * s, sin * c + cos * s], terms.dy + height, 1.0);
            take(up * up * shrink, [cos * c + sin * s, sin * c - cos * s], terms.dy - height, -1.0);
        }
    }

    /// Returns the term of xx that makes the mean velocity in the box zero.
    fn mean(&self, dy: f64) -> f64 {
        self.row.k * (dy * dy / self.across + self.across / 6.0) - 1.0
    }
}

impl<const SHEARED: bool> PairKernel for LatticePair<SHEARED> {
    #[inline(always)]
    fn stokeslet(&self, t: &Window<'_>, s: &Window<'_>, i: usize) -> Stokeslet {
        let k = self.row.k;
        let terms = self.row.terms(t, s, i);
        let Stokeslet { mut q, mut xx, mut xy, mut yy } = self.row.stokeslet(t, s, i);
        self.beside(&terms, |b, [cos, sin], y, side| {
            let e = 1.0 - 2.0 * b * cos + b * b;
            let factor = k * y * b / e;
            let bend = side * factor * (cos - b);
            q *= e;
            xx -= bend;
            yy += bend;
            xy += factor * sin;
        });
        Stokeslet { q, xx: xx + self.mean(terms.dy), xy, yy }
    }

    #[inline(always)]
    fn stress(&self, t: &Window<'_>, s: &Window<'_>, i: usize) -> [f64; 4] {
        let k = self.row.k;
        let terms = self.row.terms(t, s, i);
        let [mut xxx, mut xxy, mut xyy, mut yyy] = self.row.stress(t, s, i);
        self.beside(&terms, |b, [cos, sin], y, side| {
            let inverse = 1.0 / (1.0 - 2.0 * b * cos + b * b);
            let factor = k * b * inverse;
            let square = 2.0 * y * k * factor * inverse;
            let (ax, ay) = (factor * sin, side * factor * (cos - b));
            let axx = square * (cos * (1.0 + b * b) - 2.0 * b);
            let axy = -side * square * sin * (1.0 - b * b);
            xxx -= 4.0 * ax + axy;
            xxy += axx - 2.0 * ay;
            xyy += axy;
            yyy -= 2.0 * ay + axx;
        });
        let mean = 2.0 * k * terms.dy / self.across;
        [xxx, xxy + mean, xyy, yyy + mean]
    }

    fn diagonal(&self, tx: f64, ty: f64) -> [f64; 3] {
        let [mut xx, mut xy, mut yy] = self.row.diagonal(tx, ty);
        let terms = RowTerms { s: 0.0, c: 1.0, sh: 0.0, ch: 1.0, dy: 0.0 };
        self.beside(&terms, |b, [cos, sin], y, side| {
            let (log, bend) = if SHEARED {
                let e = 1.0 - 2.0 * b * cos + b * b;
                let factor = self.row.k * y * b / e;
                xy += factor * sin;
                (0.5 * e.ln(), side * factor * (cos - b))
            } else {
                ((1.0 - b).ln(), side * self.row.k * y * b / (1.0 - b))
            };
            xx -= log + bend;
            yy -= log - bend;
        });
        [xx + self.mean(0.0), xy, yy]
    }
}

/// A Green's function that is summed over the nodes of two curves.
#[derive(Debug, Clone, Copy)]
pub(crate) enum AnyPair {
    Free(FreePair),
    Row(RowPair),
    Lattice(LatticePair<false>),
    Sheared(LatticePair<true>),
}

#[cfg(test)]
mod tests;

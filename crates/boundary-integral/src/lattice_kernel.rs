//! Stokeslet and stress of a doubly periodic box by rows of images.

use crate::{
    logarithm::ln,
    pair_kernel::{PairKernel, Row, RowTerms, Stokeslet},
    planes::Window,
};

/// A doubly periodic box with zero mean velocity: the row of images through the source in closed form, which carries
/// the singularity, and `rows` rows on each side, which fall off like exp(-k |y|). Points are at most half a period
/// away across the rows.
#[derive(Debug, Clone, Copy)]
pub(crate) struct LatticePair {
    row: Row,
    /// Period across the rows (length).
    across: f64,
    rows: usize,
    /// exp(-k across), the decay from row to row.
    decay: f64,
    /// Rows along y: the components change places.
    transposed: bool,
}

/// Sums over all rows, the singular one included.
struct Sums {
    q: f64,
    ax: f64,
    ay: f64,
    y_ax: f64,
    y_ay: f64,
    y_axx: f64,
    y_axy: f64,
}

impl LatticePair {
    /// Rows along the shorter period of a box, as many as bring the rest below `tolerance`.
    pub(crate) fn new(periods: [f64; 2], tolerance: f64) -> Self {
        let transposed = periods[1] < periods[0];
        let [along, across] = if transposed { [periods[1], periods[0]] } else { periods };
        let k = std::f64::consts::TAU / along;
        // Points are at most half a period away across the rows.
        let rows = ((-tolerance.ln() / k + 0.5 * along) / across - 0.5).ceil().max(1.0) as usize;
        Self { row: Row::new(k, [0.0; 2], transposed), across, rows, decay: (-k * across).exp(), transposed }
    }

    #[inline(always)]
    fn sums<const STRESS: bool>(&self, terms: &RowTerms) -> Sums {
        let RowTerms { s, c, up, down, dy } = *terms;
        let k = self.row.k;
        let (sh, ch) = (0.5 * (up - down), 0.5 * (up + down));
        let (s2, sh2) = (s * s, sh * sh);
        let q = 2.0 * (s2 + sh2);
        let factor = k / q;
        let (ax, ay) = (factor * s * c, factor * sh * ch);
        let mut sums = Sums { q: 2.0 * q, ax, ay, y_ax: dy * ax, y_ay: dy * ay, y_axx: 0.0, y_axy: 0.0 };
        if STRESS {
            let square = dy * factor * factor;
            sums.y_axx = square * (sh2 - s2 - 2.0 * s2 * sh2);
            sums.y_axy = -2.0 * square * s * c * sh * ch;
        }
        let (sin, cos) = (2.0 * s * c, 1.0 - 2.0 * s2);
        let (mut up, mut down) = (up * up, down * down);
        let mut height = 0.0;
        for _ in 0..self.rows {
            up *= self.decay;
            down *= self.decay;
            height += self.across;
            for (b, y, side) in [(down, dy + height, 1.0), (up, dy - height, -1.0)] {
                let e = 1.0 - 2.0 * b * cos + b * b;
                let factor = k * b / e;
                let (ax, ay) = (factor * sin, side * factor * (cos - b));
                sums.q *= e;
                sums.ax += ax;
                sums.ay += ay;
                sums.y_ax += y * ax;
                sums.y_ay += y * ay;
                if STRESS {
                    let square = y * k * factor / e;
                    sums.y_axx += square * (cos * (1.0 + b * b) - 2.0 * b);
                    sums.y_axy -= side * square * sin * (1.0 - b * b);
                }
            }
        }
        sums
    }

    /// The mean flow along the rows that makes the mean velocity zero.
    #[inline(always)]
    fn mean(&self, dy: f64) -> f64 {
        self.row.k * (dy * dy / self.across + self.across / 6.0)
    }
}

impl PairKernel for LatticePair {
    #[inline(always)]
    fn stokeslet(&self, t: &Window<'_>, s: &Window<'_>, i: usize) -> Stokeslet {
        let terms = self.row.terms(t, s, i);
        let sums = self.sums::<false>(&terms);
        let (along, across) = (self.mean(terms.dy) - sums.y_ay, sums.y_ay);
        let (xx, yy) = if self.transposed { (across, along) } else { (along, across) };
        Stokeslet { q: sums.q, xx, xy: sums.y_ax, yy }
    }

    #[inline(always)]
    fn stress(&self, t: &Window<'_>, s: &Window<'_>, i: usize) -> [f64; 4] {
        let terms = self.row.terms(t, s, i);
        let sums = self.sums::<true>(&terms);
        let mean = 2.0 * self.row.k * terms.dy / self.across;
        let [a, b, c, d] = [
            -4.0 * sums.ax - 2.0 * sums.y_axy,
            mean - 2.0 * sums.ay + 2.0 * sums.y_axx,
            2.0 * sums.y_axy,
            mean - 2.0 * sums.ay - 2.0 * sums.y_axx,
        ];
        if self.transposed { [d, c, b, a] } else { [a, b, c, d] }
    }

    fn diagonal(&self, tx: f64, ty: f64) -> [f64; 3] {
        let k = self.row.k;
        let (along, across) = if self.transposed { (ty, tx) } else { (tx, ty) };
        let square = along * along + across * across;
        let mut log = -0.5 * ln(k * k * square);
        let mut bend = across * across / square;
        for m in 1..=self.rows {
            let b = self.decay.powi(m as i32);
            log -= 2.0 * (1.0 - b).ln();
            bend += 2.0 * m as f64 * self.across * k * b / (1.0 - b);
        }
        let (along, across) = (log - bend + self.mean(0.0), log + bend);
        let (xx, yy) = if self.transposed { (across, along) } else { (along, across) };
        [xx, tx * ty / square, yy]
    }
}

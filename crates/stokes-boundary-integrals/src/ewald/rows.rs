//! Shares of the rows of cells and of the rows of the grid that lie in them.

use std::ops::Range;

use motile_base::{ComplexTransform, InputError, internal::widely};
use num_complex::Complex64;

use super::{cells::Cells, window::Window};

/// Rows that are gathered from the columns at a time: eight complex numbers are two cache lines of each column.
const BATCH: usize = 8;

/// Rows of the grid from the first on that entries of some rows of cells are spread to, and as many beyond as a window
/// reaches over, which the next share has too.
#[derive(Debug, Clone)]
pub(super) struct Rows {
    /// Rows of cells.
    pub(super) cells: Range<usize>,
    /// The first row of the grid, and the number of rows up to the next share.
    pub(super) first: usize,
    pub(super) own: usize,
    /// Grid points along the box, of which rows have as many more as a window reaches over.
    size: [usize; 2],
    reach: usize,
    values: Vec<Complex64>,
    transform: ComplexTransform,
    /// Smooth flow at the entries of the rows of cells.
    pub(super) flow: [Vec<f64>; 2],
}

/// Runs a body with the points of a window as a constant.
macro_rules! with_points {
    ($points:expr, $name:ident => $body:expr) => {
        match $points {
            6 => with_points!(@ 6, $name, $body),
            8 => with_points!(@ 8, $name, $body),
            10 => with_points!(@ 10, $name, $body),
            12 => with_points!(@ 12, $name, $body),
            14 => with_points!(@ 14, $name, $body),
            16 => with_points!(@ 16, $name, $body),
            _ => with_points!(@ super::window::MOST, $name, $body),
        }
    };
    (@ $points:expr, $name:ident, $body:expr) => {{
        const $name: usize = $points;
        $body
    }};
}

impl Rows {
    /// Returns the shares of the rows of cells of a box with grid points along x and y; each has no fewer rows of the
    /// grid than a window has points.
    pub(super) fn divide(cells: usize, size: [usize; 2], points: usize) -> Result<Vec<Self>, InputError> {
        let row_of = |cell: usize| (cell as f64 / cells as f64 * size[1] as f64) as usize;
        let fits = |count: &usize| cells / count * size[1] / cells > points;
        let count = (2..=crate::shares::MOST.min(cells)).rev().find(fits).unwrap_or(1);
        let transform = ComplexTransform::new(size[0])?;
        let share = |index: usize| {
            let range = index * cells / count..(index + 1) * cells / count;
            let first = row_of(range.start);
            let end = if range.end == cells { size[1] } else { row_of(range.end) };
            let own = end - first;
            let values = vec![Complex64::ZERO; (own + points) * (size[0] + points)];
            let transform = transform.clone();
            Self { cells: range, first, own, size, reach: points, values, transform, flow: Default::default() }
        };
        Ok((0..count).map(share).collect())
    }

    fn stride(&self) -> usize {
        self.size[0] + self.reach
    }

    /// Returns the range of the entries of its rows of cells.
    pub(super) fn entries(&self, cells: &Cells) -> Range<usize> {
        cells.row(self.cells.start).start..cells.row(self.cells.end - 1).end
    }

    /// Sets the flow at the entries of its rows of cells to zero.
    pub(super) fn begin(&mut self, cells: &Cells) {
        let entries = self.entries(cells);
        for flow in &mut self.flow {
            flow.clear();
            flow.resize(entries.len(), 0.0);
        }
    }

    /// Returns the grid point at or before an entry and the parts of a distance that it lies behind it, along x and y.
    #[inline(always)]
    fn place(&self, parts: [f64; 2]) -> ([usize; 2], [f64; 2]) {
        let [x, y] = [parts[0] * self.size[0] as f64, parts[1] * self.size[1] as f64];
        // Round-off may put an entry at the end of a share into the row before.
        let (i, j) = (x as usize, (y as usize).max(self.first));
        ([i, j - self.first], [x - i as f64, y - j as f64])
    }

    /// Spreads what the entries carry, as complex numbers by their number.
    pub(super) fn spread(&mut self, cells: &Cells, window: &Window, carried: impl Fn(usize) -> [f64; 2]) {
        self.values.fill(Complex64::ZERO);
        with_points!(self.reach, P => widely(#[inline(always)] || self.spread_by::<P>(cells, window, carried)));
        // The columns beyond the box.
        let (length, stride) = (self.size[0], self.stride());
        for row in self.values.chunks_exact_mut(stride) {
            let (inside, beyond) = row.split_at_mut(length);
            inside.iter_mut().zip(beyond).for_each(|(value, beyond)| *value += *beyond);
        }
    }

    #[inline(always)]
    fn spread_by<const P: usize>(&mut self, cells: &Cells, window: &Window, carried: impl Fn(usize) -> [f64; 2]) {
        let stride = self.stride();
        for row in self.cells.clone() {
            for entry in cells.row(row) {
                let ([i, j], [u, v]) = self.place(cells.parts[entry]);
                let (along, across) = (window.values::<P>(u), window.values::<P>(v));
                let [re, im] = carried(entry);
                let along = along.map(|weight| Complex64::new(re * weight, im * weight));
                let rows = self.values[j * stride..(j + P) * stride].chunks_exact_mut(stride);
                for (row, weight) in rows.zip(across) {
                    for (value, along) in row[i..i + P].iter_mut().zip(&along) {
                        value.re += along.re * weight;
                        value.im += along.im * weight;
                    }
                }
            }
        }
    }

    /// Adds the smooth flow at the entries, interpolated from the grid.
    pub(super) fn interpolate(&mut self, cells: &Cells, window: &Window) {
        with_points!(self.reach, P => widely(#[inline(always)] || self.interpolate_by::<P>(cells, window)));
    }

    #[inline(always)]
    fn interpolate_by<const P: usize>(&mut self, cells: &Cells, window: &Window) {
        let (stride, first) = (self.stride(), self.entries(cells).start);
        for row in self.cells.clone() {
            for entry in cells.row(row) {
                let ([i, j], [u, v]) = self.place(cells.parts[entry]);
                let (along, across) = (window.values::<P>(u), window.values::<P>(v));
                let mut sums = [Complex64::ZERO; P];
                let rows = self.values[j * stride..(j + P) * stride].chunks_exact(stride);
                for (row, weight) in rows.zip(across) {
                    for (sum, value) in sums.iter_mut().zip(&row[i..i + P]) {
                        sum.re += value.re * weight;
                        sum.im += value.im * weight;
                    }
                }
                let mut total = Complex64::ZERO;
                for (sum, weight) in sums.iter().zip(along) {
                    total += sum * weight;
                }
                self.flow[0][entry - first] += total.re;
                self.flow[1][entry - first] += total.im;
            }
        }
    }

    /// Transforms the rows up to the next share along x.
    pub(super) fn transform(&mut self) {
        let (length, stride, own) = (self.size[0], self.stride(), self.own);
        for row in self.values.chunks_exact_mut(stride).take(own) {
            // Rows have the length of the plan, so that the call cannot fail.
            let _ = self.transform.forward(&mut row[..length]);
        }
    }

    /// Returns a value of row `row` of this share.
    #[inline(always)]
    pub(super) fn value(&self, row: usize, column: usize) -> Complex64 {
        self.values[row * self.stride() + column]
    }

    /// Transforms its rows back, which `take` writes some at a time: from the first one's number on, at this distance
    /// from each other, into memory that is zero.
    #[inline(always)]
    pub(super) fn transform_back(&mut self, take: impl Fn(usize, usize, &mut [Complex64])) {
        let (length, stride, own, points) = (self.size[0], self.stride(), self.own, self.reach);
        for (batch, rows) in self.values[..own * stride].chunks_mut(BATCH * stride).enumerate() {
            rows.fill(Complex64::ZERO);
            take(self.first + batch * BATCH, stride, rows);
            for row in rows.chunks_exact_mut(stride) {
                let _ = self.transform.inverse(&mut row[..length]);
                let (inside, beyond) = row.split_at_mut(length);
                beyond.copy_from_slice(&inside[..points]);
            }
        }
    }
}

/// Adds the rows that shares have beyond their own to the rows of the next share.
pub(super) fn fold(shares: &mut [Rows]) {
    each_seam(shares, |value, beyond| *value += *beyond);
}

/// Copies the first rows of each share to those that the share before has beyond its own.
pub(super) fn unfold(shares: &mut [Rows]) {
    each_seam(shares, |value, beyond| *beyond = *value);
}

/// Calls `take` with the values of each share that the one before has too, and with the values of that one.
fn each_seam(shares: &mut [Rows], take: impl Fn(&mut Complex64, &mut Complex64)) {
    let count = shares.len();
    for index in 0..count {
        let len = shares[index].reach * shares[index].stride();
        let start = shares[index].own * shares[index].stride();
        let next = (index + 1) % count;
        if next == index {
            let (inside, beyond) = shares[0].values.split_at_mut(start);
            inside[..len].iter_mut().zip(beyond).for_each(|(value, beyond)| take(value, beyond));
        } else {
            let (low, high) = shares.split_at_mut(index.max(next));
            let (before, after) =
                if next > index { (&mut low[index], &mut high[0]) } else { (&mut high[0], &mut low[next]) };
            let values = after.values[..len].iter_mut().zip(&mut before.values[start..]);
            values.for_each(|(value, beyond)| take(value, beyond));
        }
    }
}

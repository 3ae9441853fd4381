//! Sums over sources within the cut-off: the Green's function less its smooth part.

use std::ops::Range;

use motile_base::internal::widely;

use crate::{greens::ln, shares};

use super::{cells::Cells, split::Split};

/// Sources in one pass of a loop: two vector registers of AVX, so that eight sums of powers run at a time.
const LANES: usize = 8;
/// Distance from a cell, in units of the cut-off and beyond it, of the places that fill the last pass: their powers
/// stay finite.
const AWAY: f64 = 3.0;

type Lanes = [f64; LANES];

/// Strengths of the sources: forces, or the products xx, s, yy of dipoles.
#[derive(Debug, Clone, Copy)]
pub(super) enum Carried<'a> {
    Forces([&'a [f64]; 2]),
    Dipoles([&'a [f64]; 3]),
}

/// The sources around a cell.
#[derive(Debug, Clone, Default)]
struct Candidates {
    x: Vec<f64>,
    y: Vec<f64>,
    carried: [Vec<f64>; 3],
}

impl Candidates {
    fn take(&mut self, sources: &Cells, carried: Carried<'_>, [column, row]: [usize; 2], away: f64) {
        let Self { x, y, carried: own } = self;
        [&mut *x, y].into_iter().chain(own.iter_mut()).for_each(Vec::clear);
        for range in sources.around(column, row) {
            x.extend_from_slice(&sources.x[range.clone()]);
            y.extend_from_slice(&sources.y[range.clone()]);
            match carried {
                Carried::Forces(arrays) => {
                    own.iter_mut().zip(arrays).for_each(|(own, array)| own.extend_from_slice(&array[range.clone()]));
                }
                Carried::Dipoles(arrays) => {
                    own.iter_mut().zip(arrays).for_each(|(own, array)| own.extend_from_slice(&array[range.clone()]));
                }
            }
        }
        let len = x.len().next_multiple_of(LANES);
        x.resize(len, away);
        y.resize(len, away);
        own.iter_mut().for_each(|array| array.resize(len, 0.0));
    }
}

/// The near part at the entries in some rows of cells.
#[derive(Debug, Clone, Default)]
pub(super) struct Near {
    pub(super) rows: Range<usize>,
    candidates: Candidates,
    /// Flow at the entries from the first one in the rows on.
    pub(super) flow: [Vec<f64>; 2],
}

impl Near {
    /// Divides the rows of cells into shares of about as many entries.
    pub(super) fn divide(all: &mut Vec<Self>, cells: &Cells) {
        all.resize_with(shares::MOST, Self::default);
        let mut row = 0;
        let (rows, start) = (cells.counts()[1], cells.row(0).start);
        let entries = cells.row(rows - 1).end - start;
        for (index, share) in all.iter_mut().enumerate() {
            let (first, end) = (row, start + (index + 1) * entries / shares::MOST);
            while row < rows && cells.row(row).start < end {
                row += 1;
            }
            share.rows = first..row;
        }
    }

    /// Sums the near part of the flow of what the entries carry, times a factor: for dipoles it is in units of the
    /// cut-off.
    pub(super) fn sum(&mut self, split: &Split, cells: &Cells, carried: Carried<'_>, factor: f64) {
        let Self { rows, candidates, flow } = self;
        let Some(last) = rows.clone().next_back() else { return };
        let entries = cells.row(rows.start).start..cells.row(last).end;
        flow.iter_mut().for_each(|flow| flow.resize(entries.len(), 0.0));
        for (row, column) in rows.clone().flat_map(|row| (0..cells.counts()[0]).map(move |column| (row, column))) {
            let cell = cells.cell(column, row);
            if cell.is_empty() {
                continue;
            }
            let away = cells.x[cell.start].max(cells.y[cell.start]) + AWAY;
            candidates.take(cells, carried, [column, row], away);
            let Candidates { x, y, carried: [a, b, c] } = &*candidates;
            for entry in cell {
                let place = [cells.x[entry], cells.y[entry]];
                let [u, v] = widely(
                    #[inline(always)]
                    || match carried {
                        Carried::Forces(_) => forces(split, place, [x, y, a, b]),
                        Carried::Dipoles(_) => dipoles(split, place, [x, y, a, b, c]),
                    },
                );
                flow[0][entry - entries.start] = u * factor;
                flow[1][entry - entries.start] = v * factor;
            }
        }
    }
}

/// Returns the values of two polynomials from their powers of t in pairs.
#[inline(always)]
fn values(powers: &[[f64; 4]], t: &Lanes) -> [Lanes; 2] {
    let mut square = [0.0; LANES];
    let [mut a, mut b, mut c, mut d] = [[0.0; LANES]; 4];
    for lane in 0..LANES {
        square[lane] = t[lane] * t[lane];
    }
    for [even, odd, other_even, other_odd] in powers.iter().rev() {
        for lane in 0..LANES {
            a[lane] = a[lane] * square[lane] + even;
            b[lane] = b[lane] * square[lane] + odd;
            c[lane] = c[lane] * square[lane] + other_even;
            d[lane] = d[lane] * square[lane] + other_odd;
        }
    }
    for lane in 0..LANES {
        a[lane] += t[lane] * b[lane];
        c[lane] += t[lane] * d[lane];
    }
    [a, c]
}

/// Returns the distances from the target in units of the cut-off, their squares, and these doubled less 1.
#[inline(always)]
fn distances([x, y]: [f64; 2], xs: &Lanes, ys: &Lanes) -> [Lanes; 4] {
    let [mut dx, mut dy, mut square, mut t] = [[0.0; LANES]; 4];
    for lane in 0..LANES {
        dx[lane] = x - xs[lane];
        dy[lane] = y - ys[lane];
        square[lane] = dx[lane] * dx[lane] + dy[lane] * dy[lane];
        t[lane] = 2.0 * square[lane] - 1.0;
    }
    [dx, dy, square, t]
}

/// Returns the flow of forces, `(-1/2 ln s - b) F + (1/s - g) r (r.F)` with the square s of the distance r.
#[inline(always)]
fn forces(split: &Split, place: [f64; 2], arrays: [&[f64]; 4]) -> [f64; 2] {
    let [(xs, _), (ys, _), (fx, _), (fy, _)] = arrays.map(<[f64]>::as_chunks::<LANES>);
    let [mut u, mut v] = [[0.0; LANES]; 2];
    for (((xs, ys), fx), fy) in xs.iter().zip(ys).zip(fx).zip(fy) {
        let [dx, dy, square, t] = distances(place, xs, ys);
        let [b, g] = values(&split.stokeslet, &t);
        for lane in 0..LANES {
            let s = square[lane];
            // The target itself is at no distance.
            let inside = s < 1.0 && s > 0.0;
            let some = if inside { s } else { 1.0 };
            let even = -0.5 * ln(some) - b[lane];
            let along = (1.0 / some - g[lane]) * (dx[lane] * fx[lane] + dy[lane] * fy[lane]);
            u[lane] += if inside { even * fx[lane] + along * dx[lane] } else { 0.0 };
            v[lane] += if inside { even * fy[lane] + along * dy[lane] } else { 0.0 };
        }
    }
    [u.iter().sum(), v.iter().sum()]
}

/// Returns the flow of dipoles, `2 a D r + (4/s^2 + 2 g') r (r D r) + a r tr D`.
#[inline(always)]
fn dipoles(split: &Split, place: [f64; 2], arrays: [&[f64]; 5]) -> [f64; 2] {
    let [(xs, _), (ys, _), (xx, _), (mixed, _), (yy, _)] = arrays.map(<[f64]>::as_chunks::<LANES>);
    let [mut u, mut v] = [[0.0; LANES]; 2];
    for ((((xs, ys), xx), mixed), yy) in xs.iter().zip(ys).zip(xx).zip(mixed).zip(yy) {
        let [dx, dy, square, t] = distances(place, xs, ys);
        let [a, slope] = values(&split.stress, &t);
        for lane in 0..LANES {
            let (s, x, y) = (square[lane], dx[lane], dy[lane]);
            let inside = s < 1.0 && s > 0.0;
            let inverse = 1.0 / if inside { s } else { 1.0 };
            let [px, py] = [xx[lane] * x + 0.5 * mixed[lane] * y, 0.5 * mixed[lane] * x + yy[lane] * y];
            let along =
                (4.0 * inverse * inverse + 2.0 * slope[lane]) * (px * x + py * y) + a[lane] * (xx[lane] + yy[lane]);
            let twice = 2.0 * a[lane];
            u[lane] += if inside { along * x + twice * px } else { 0.0 };
            v[lane] += if inside { along * y + twice * py } else { 0.0 };
        }
    }
    [u.iter().sum(), v.iter().sum()]
}

//! The transfer of many markers with a kernel of polynomials, most of them away from the edges of the grid.

use super::general::GeneralTransfer;
use super::lanes::{Lanes, LanesTask, dispatch};
use super::locations::{Edge, Location};
use super::order::{BLOCK, Band, Markers};
use super::weights::{BSpline4Pieces, Polynomials, weights};
use crate::{
    Kernel,
    kernel::{BSPLINE_4, Pieces},
};
use motile_base::Vec2;
use stokes_grid::StaggeredField;

/// The weights of the window of a marker as numbers, each for both components: of the rows, of the columns, and of the
/// columns of a second window at the other end of the same rows.
#[derive(Debug, Clone, Copy)]
struct Window {
    rows: [[f64; 4]; 2],
    columns: [[f64; 4]; 2],
    beyond: [[f64; 4]; 2],
    /// True if there is a second window.
    wraps: bool,
}

/// Returns the weights of the stencil of a marker.
#[inline(always)]
fn window<L: Lanes>(l: L, pieces: &impl Polynomials, location: &Location) -> Window {
    let [x_columns, y_columns] = weights(l, pieces, location.fractions[0]);
    let [y_rows, x_rows] = weights(l, pieces, location.fractions[1]);
    Window {
        rows: [l.store(x_rows), l.store(y_rows)],
        columns: [l.store(x_columns), l.store(y_columns)],
        beyond: [[0.0; 4]; 2],
        wraps: false,
    }
}

/// The weights of the windows of a marker at an edge of the grid from the weights of its stencil. At a wall the x
/// component is odd, the y component even.
#[inline(never)]
fn at_edge(edge: Edge, window: &mut Window) {
    let [u, v] = window.rows;
    if edge.below {
        window.rows = [[u[1] - u[0], u[2], 0.0, 0.0], [v[1], v[2] + v[0], v[3], 0.0]];
    } else if edge.above {
        window.rows = [[0.0, u[0], u[1] - u[2], 0.0], [0.0, v[0], v[1] + v[3], v[2]]];
    }
    if edge.wrapped > 0 {
        window.wraps = true;
        for (columns, beyond) in window.columns.iter_mut().zip(&mut window.beyond) {
            let [a, b, c, d] = *columns;
            (*columns, *beyond) = match edge.wrapped {
                1 => ([0.0, 0.0, 0.0, a], [b, c, d, 0.0]),
                2 => ([0.0, 0.0, a, b], [c, d, 0.0, 0.0]),
                _ => ([0.0, a, b, c], [d, 0.0, 0.0, 0.0]),
            };
        }
    }
}

/// Spreading of forces to both components, of all rows or the rows of a band.
#[derive(Debug)]
pub(super) struct Spreading<'a, K, P> {
    pub(super) general: GeneralTransfer<'a, K>,
    pub(super) pieces: P,
    pub(super) scale: f64,
    pub(super) markers: Markers<'a>,
    pub(super) band: Band<'a>,
}

impl<K: Kernel, P: Polynomials> LanesTask for Spreading<'_, K, P> {
    #[inline(always)]
    fn run<L: Lanes>(self, l: L) {
        let Self { general, pieces, scale, markers, band } = self;
        let Markers { locations, forces, stride, irregular } = markers;
        let Band { first_row, fx, fy } = band;
        // Known to be four or more, the first four of a row need no check.
        let nx = general.grid.nx().max(4);
        let offset = first_row * nx;
        // Windows that begin before this are within the band.
        let end = fx.len().saturating_sub(2 * nx + 3).min(fy.len().saturating_sub(3 * nx + 3));
        for (locations, forces) in locations.chunks(BLOCK).zip(forces.chunks(BLOCK)) {
            let count = locations.len().min(forces.len());
            let (locations, forces) = (&locations[..count], &forces[..count]);
            for first in 0..stride.min(count) {
                let mut next = first;
                while next < count {
                    let (location, force) = (&locations[next], &forces[next]);
                    next += stride;
                    let force = [scale * force.x, scale * force.y];
                    // What begins below the band is far beyond its end when the subtraction wraps.
                    let base = (location.base as usize).wrapping_sub(offset);
                    if location.kind == Location::REGULAR && base < end {
                        let [normal, tangential] = weights(l, &pieces, location.fractions[0]);
                        let [y_rows, x_rows] = weights(l, &pieces, location.fractions[1]);
                        let (x_columns, y_columns) =
                            (l.mul(l.splat(force[0]), normal), l.mul(l.splat(force[1]), tangential));
                        add_rows::<L, 3>(l, &mut fx[base..], nx, x_columns, l.store(x_rows));
                        add_rows::<L, 4>(l, &mut fy[base..], nx, y_columns, l.store(y_rows));
                    } else if location.base != Location::IRREGULAR {
                        let mut window = window(l, &pieces, location);
                        at_edge(location.edge(), &mut window);
                        let force = force.map(|force| l.splat(force));
                        add_window(l, &window, force, base, nx, [&mut *fx, &mut *fy]);
                    } else if let Some(place) = irregular.get(location.kind as usize) {
                        general.add(*place, force, first_row, fx, fy);
                    }
                }
            }
        }
    }
}

/// Adds the rows of a window or two that are there.
#[inline(always)]
fn add_window<L: Lanes>(l: L, window: &Window, force: [L::Four; 2], base: usize, nx: usize, fields: [&mut [f64]; 2]) {
    for ((k, field), force) in fields.into_iter().enumerate().zip(force) {
        // From the last four columns to the first.
        for (base, columns) in [(base, window.columns[k]), (base.wrapping_add(4).wrapping_sub(nx), window.beyond[k])] {
            let columns = l.mul(force, l.load(columns));
            for (r, weight) in window.rows[k][..3 + k].iter().enumerate() {
                let row = field.get_mut(base.wrapping_add(r * nx)..).unwrap_or_default();
                add_row(l, row, columns, *weight);
            }
            if !window.wraps {
                break;
            }
        }
    }
}

/// Adds `weight columns` to the first four numbers of a row.
#[inline(always)]
fn add_row<L: Lanes>(l: L, row: &mut [f64], columns: L::Four, weight: f64) {
    if let Some(cells) = row.first_chunk_mut::<4>() {
        *cells = l.store(l.mul_add(l.splat(weight), columns, l.load(*cells)));
    }
}

/// Adds `rows[r] columns` to the first four numbers of the first N rows of a window, of which the last may end there.
#[inline(always)]
fn add_rows<L: Lanes, const N: usize>(l: L, window: &mut [f64], nx: usize, columns: L::Four, rows: [f64; 4]) {
    // A chunk iterator zipped with another one would divide to find its length.
    let mut rest = window;
    for weight in &rows[..N - 1] {
        let (row, below) = rest.split_at_mut(nx);
        add_row(l, row, columns, *weight);
        rest = below;
    }
    add_row(l, rest, columns, rows[N - 1]);
}

/// Interpolation of both components.
#[derive(Debug)]
pub(super) struct Interpolation<'a, K, P> {
    pub(super) general: GeneralTransfer<'a, K>,
    pub(super) pieces: P,
    /// Those of the markers to interpolate at.
    pub(super) locations: &'a [Location],
    pub(super) irregular: &'a [[f64; 2]],
    pub(super) u: &'a [f64],
    pub(super) v: &'a [f64],
    pub(super) velocities: &'a mut [Vec2],
}

impl<K: Kernel, P: Polynomials> LanesTask for Interpolation<'_, K, P> {
    #[inline(always)]
    fn run<L: Lanes>(self, l: L) {
        let Self { general, pieces, locations, irregular, u, v, velocities } = self;
        let nx = general.grid.nx();
        // Both fields from each row of a window on, all of one length: one check for all of them.
        let length = u.len().saturating_sub(2 * nx).min(v.len().saturating_sub(3 * nx));
        let [u0, u1, u2] = [from(u, 0, length), from(u, nx, length), from(u, 2 * nx, length)];
        let [v0, v1, v2] = [from(v, 0, length), from(v, nx, length), from(v, 2 * nx, length)];
        let v3 = from(v, 3 * nx, length);
        let rows = [u0, u1, u2, v0, v1, v2, v3];
        for (location, out) in locations.iter().zip(velocities) {
            let base = location.base as usize;
            if location.kind == Location::REGULAR && base + 4 <= length {
                let [x_columns, y_columns] = weights(l, &pieces, location.fractions[0]);
                let [y_rows, x_rows] = weights(l, &pieces, location.fractions[1]);
                let (x_rows, y_rows) = (l.store(x_rows), l.store(y_rows));
                let x = l.mul(l.splat(x_rows[0]), cells(l, u0, base));
                let x = l.mul_add(l.splat(x_rows[1]), cells(l, u1, base), x);
                let x = l.mul_add(l.splat(x_rows[2]), cells(l, u2, base), x);
                let y = l.mul(l.splat(y_rows[0]), cells(l, v0, base));
                let y = l.mul_add(l.splat(y_rows[1]), cells(l, v1, base), y);
                let y = l.mul_add(l.splat(y_rows[2]), cells(l, v2, base), y);
                let y = l.mul_add(l.splat(y_rows[3]), cells(l, v3, base), y);
                *out = l.sums(l.mul(x, x_columns), l.mul(y, y_columns)).into();
            } else if location.base != Location::IRREGULAR {
                let mut window = window(l, &pieces, location);
                at_edge(location.edge(), &mut window);
                *out = gather(l, &rows, base, &window.rows, &window.columns);
                if window.wraps {
                    // From the last four columns to the first.
                    *out += gather(l, &rows, (base + 4).wrapping_sub(nx), &window.rows, &window.beyond);
                }
            } else if let Some(place) = irregular.get(location.kind as usize) {
                *out = general.gather(*place, u, v).into();
            }
        }
    }
}

/// Returns the velocity from three rows of the x component and four of the y component.
#[inline(always)]
fn gather<L: Lanes>(l: L, fields: &[&[f64]; 7], base: usize, rows: &[[f64; 4]; 2], columns: &[[f64; 4]; 2]) -> Vec2 {
    let mut totals = [l.splat(0.0); 2];
    for (k, field) in fields.iter().enumerate() {
        let (component, row) = if k < 3 { (0, k) } else { (1, k - 3) };
        totals[component] = l.mul_add(l.splat(rows[component][row]), cells(l, field, base), totals[component]);
    }
    let [x, y] = totals;
    l.sums(l.mul(x, l.load(columns[0])), l.mul(y, l.load(columns[1]))).into()
}

/// Returns `length` numbers of a field that begin at `start`, or nearer to its beginning if there are not enough.
#[inline(always)]
fn from(field: &[f64], start: usize, length: usize) -> &[f64] {
    &field[start.min(field.len() - length)..][..length]
}

/// Returns the four numbers from `base` on.
#[inline(always)]
fn cells<L: Lanes>(l: L, field: &[f64], base: usize) -> L::Four {
    field[base..base + 4].first_chunk().map_or(l.splat(0.0), |cells| l.load(*cells))
}

/// Returns the polynomials of a kernel unless it is the default one, which are constants. If a kernel has none, all
/// locations are irregular, and those need none.
fn other_pieces<K: Kernel>(kernel: &K) -> Option<&'static Pieces> {
    kernel.pieces().filter(|pieces| **pieces != BSPLINE_4)
}

/// Spreads forces with the polynomials of the kernel, or marker by marker if it has none.
pub(super) fn spread<K: Kernel>(general: GeneralTransfer<'_, K>, scale: f64, markers: Markers<'_>, band: Band<'_>) {
    match other_pieces(general.kernel) {
        Some(pieces) => dispatch(Spreading { general, pieces, scale, markers, band }),
        None => dispatch(Spreading { general, pieces: BSpline4Pieces, scale, markers, band }),
    }
}

/// Interpolates velocities with the polynomials of the kernel, or marker by marker if it has none.
pub(super) fn interpolate<K: Kernel>(
    general: GeneralTransfer<'_, K>,
    locations: &[Location],
    irregular: &[[f64; 2]],
    velocity: &StaggeredField,
    velocities: &mut [Vec2],
) {
    let (u, v) = (velocity.x(), velocity.y());
    match other_pieces(general.kernel) {
        Some(pieces) => dispatch(Interpolation { general, pieces, locations, irregular, u, v, velocities }),
        None => {
            let pieces = BSpline4Pieces;
            dispatch(Interpolation { general, pieces, locations, irregular, u, v, velocities });
        }
    }
}

#[cfg(test)]
mod tests;

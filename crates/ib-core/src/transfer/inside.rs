//! The transfer of many markers with a kernel of polynomials, most of them away from the edges of the grid.

use super::anywhere::Anywhere;
use super::lanes::{Lanes, LanesTask};
use crate::{Kernel, Pieces, Vec2};

/// The smallest number above which doubles have no fraction, times one and a half to leave room for negative ones.
const WHOLE: f64 = 6_755_399_441_055_744.0;

/// The whole part of `x` and the rest in [0, 1], without the library call that `floor` is on machines of old. Below 2^31
/// in size; at a whole number the rest may be one instead of zero, where continuous weights agree.
#[inline(always)]
fn split(x: f64) -> (i32, f64) {
    let shifted = (x - 0.5) + WHOLE;
    (shifted.to_bits() as u32 as i32, x - (shifted - WHOLE))
}

/// The whole part of a coordinate and the weights of `pieces` there, in the normal and the tangential role.
#[inline(always)]
pub(super) fn weights<L: Lanes>(l: L, pieces: &Pieces, r: f64) -> (i32, [L::Four; 2]) {
    let (whole, t) = split(r + pieces.shift);
    let t = l.splat(t);
    let [c0, c1, c2, c3] = pieces.normal;
    let square = l.mul(t, t);
    // Not by Horner's rule: what can be done side by side is done sooner.
    let low = l.add(l.load(c0), l.mul(t, l.load(c1)));
    let high = l.add(l.load(c2), l.mul(t, l.load(c3)));
    let normal = l.add(low, l.mul(square, high));
    let [c0, c1, c2] = pieces.tangential;
    let tangential = l.add(l.add(l.load(c0), l.mul(t, l.load(c1))), l.mul(square, l.load(c2)));
    (whole, [normal, tangential])
}

/// A stencil within the stored rows and columns: where it begins, and its weights by row for both components.
struct Stencil {
    base: usize,
    rows: [[f64; 4]; 2],
}

/// The stencil of a marker, with the rows beyond a wall folded back; nothing for the few that reach across the ends of
/// the box.
#[inline(always)]
fn stencil<K: Kernel>(anywhere: &Anywhere<'_, K>, wholes: [i32; 2], rows: [[f64; 4]; 2]) -> Option<Stencil> {
    let [columns, count] = anywhere.cells();
    // What is negative becomes large.
    let [i, j] = wholes.map(|whole| (whole - 1) as u32 as usize);
    if i >= columns.saturating_sub(3) {
        None
    } else if j < count.saturating_sub(3) {
        Some(Stencil { base: j * columns + i, rows })
    } else {
        let (row, rows) = folded(wholes[1] - 1, count, anywhere.has_walls(), rows)?;
        Some(Stencil { base: row * columns + i, rows })
    }
}

/// The first row and the weights of a stencil that begins one row below the bottom, or ends one row above the top, of a
/// channel: the x component is odd about a wall, the y component even.
#[inline(never)]
fn folded(row: i32, count: usize, walls: bool, [u, v]: [[f64; 4]; 2]) -> Option<(usize, [[f64; 4]; 2])> {
    if !walls || count < 4 {
        None
    } else if row == -1 {
        Some((0, [[u[1] - u[0], u[2], 0.0, 0.0], [v[1], v[2] + v[0], v[3], 0.0]]))
    } else if row == count as i32 - 2 {
        Some((count - 3, [[0.0, u[0], u[1] - u[2], 0.0], [0.0, v[0], v[1] + v[3], v[2]]]))
    } else if row == count as i32 - 3 {
        Some((count - 3, [u, v]))
    } else {
        None
    }
}

/// Spreading of forces to both components, of all rows or those of a band.
#[derive(Debug)]
pub(super) struct Spreading<'a, K, M> {
    pub(super) anywhere: Anywhere<'a, K>,
    pub(super) pieces: &'static Pieces,
    pub(super) scale: f64,
    /// Places and forces of the markers, in the order in which they are added.
    pub(super) markers: M,
    /// The first row that `fx` and `fy` have.
    pub(super) first_row: usize,
    pub(super) fx: &'a mut [f64],
    pub(super) fy: &'a mut [f64],
}

impl<'a, K: Kernel, M: Iterator<Item = (&'a [f64; 2], &'a Vec2)>> LanesTask for Spreading<'_, K, M> {
    #[inline(always)]
    fn run<L: Lanes>(self, l: L) {
        let Self { anywhere, pieces, scale, markers, first_row, fx, fy } = self;
        // Known to be four or more, the first four of a row need no check.
        let nx = anywhere.cells()[0].max(4);
        let (offset, end) = (first_row * nx, fx.len().min(fy.len()));
        for (place, force) in markers {
            let force = [scale * force.x, scale * force.y];
            let (column, [normal_x, tangential_x]) = weights(l, pieces, place[0]);
            let (row, [normal_y, tangential_y]) = weights(l, pieces, place[1]);
            let columns = [l.mul(l.splat(force[0]), normal_x), l.mul(l.splat(force[1]), tangential_x)];
            let rows = [l.store(tangential_y), l.store(normal_y)];
            let stencil = stencil(&anywhere, [column, row], rows);
            if let Some(Stencil { base, rows }) = stencil {
                // What begins below the band is far beyond its end when the subtraction wraps.
                let base = base.wrapping_sub(offset);
                if base < end && base + 3 * nx < fy.len() {
                    add_rows::<L, 3>(l, &mut fx[base..], nx, columns[0], rows[0]);
                    add_rows::<L, 4>(l, &mut fy[base..], nx, columns[1], rows[1]);
                } else {
                    for (r, weight) in rows[0][..3].iter().enumerate() {
                        let start = base.wrapping_add(r * nx);
                        add_row(l, fx.get_mut(start..).unwrap_or_default(), columns[0], *weight);
                    }
                    for (r, weight) in rows[1].iter().enumerate() {
                        let start = base.wrapping_add(r * nx);
                        add_row(l, fy.get_mut(start..).unwrap_or_default(), columns[1], *weight);
                    }
                }
            } else {
                anywhere.add(*place, force, first_row, fx, fy);
            }
        }
    }
}

/// Adds `weight columns` to the first four numbers of a row.
#[inline(always)]
fn add_row<L: Lanes>(l: L, row: &mut [f64], columns: L::Four, weight: f64) {
    if let Some(cells) = row.first_chunk_mut::<4>() {
        *cells = l.store(l.add(l.load(*cells), l.mul(l.splat(weight), columns)));
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
pub(super) struct Interpolation<'a, K> {
    pub(super) anywhere: Anywhere<'a, K>,
    pub(super) pieces: &'static Pieces,
    pub(super) places: &'a [[f64; 2]],
    pub(super) u: &'a [f64],
    pub(super) v: &'a [f64],
    pub(super) velocities: &'a mut [Vec2],
}

impl<K: Kernel> LanesTask for Interpolation<'_, K> {
    #[inline(always)]
    fn run<L: Lanes>(self, l: L) {
        let Self { anywhere, pieces, places, u, v, velocities } = self;
        let nx = anywhere.cells()[0].max(4);
        for (place, out) in places.iter().zip(velocities) {
            let (column, [normal_x, tangential_x]) = weights(l, pieces, place[0]);
            let (row, [normal_y, tangential_y]) = weights(l, pieces, place[1]);
            let rows = [l.store(tangential_y), l.store(normal_y)];
            let Some(Stencil { base, rows }) = stencil(&anywhere, [column, row], rows) else {
                *out = anywhere.gather(*place, u, v).into();
                continue;
            };
            let x = gather_rows::<L, 3>(l, &u[base..], nx, rows[0]);
            let y = gather_rows::<L, 4>(l, &v[base..], nx, rows[1]);
            *out = Vec2::new(sum(l.store(l.mul(x, normal_x))), sum(l.store(l.mul(y, tangential_x))));
        }
    }
}

/// `total + weight row[..4]`.
#[inline(always)]
fn gather_row<L: Lanes>(l: L, total: L::Four, row: &[f64], weight: f64) -> L::Four {
    row.first_chunk::<4>().map_or(total, |cells| l.add(total, l.mul(l.splat(weight), l.load(*cells))))
}

/// `sum over r < N of rows[r] window[r][..4]`, of a window whose last row may end there.
#[inline(always)]
fn gather_rows<L: Lanes, const N: usize>(l: L, window: &[f64], nx: usize, rows: [f64; 4]) -> L::Four {
    let mut total = l.splat(0.0);
    let mut rest = window;
    for weight in &rows[..N - 1] {
        let (row, below) = rest.split_at(nx);
        total = gather_row(l, total, row, *weight);
        rest = below;
    }
    gather_row(l, total, rest, rows[N - 1])
}

#[inline(always)]
fn sum([a, b, c, d]: [f64; 4]) -> f64 {
    (a + c) + (b + d)
}

#[cfg(test)]
mod tests {
    use stokes_grid::Grid;

    use super::*;
    use crate::CubicQuadratic;
    use crate::transfer::lanes::{Portable, dispatch};

    /// On a machine without wide instructions both are the same.
    #[test]
    fn all_instructions_give_the_same_bits() {
        let grid = Grid::channel(20, 16, 0.1).unwrap();
        let kernel = CubicQuadratic::default();
        let anywhere = Anywhere::new(&kernel, &grid);
        let pieces = kernel.pieces().unwrap();
        let places: Vec<[f64; 2]> =
            (0..500).map(|k| f64::from(k) * 0.731).map(|k| [k % 20.0, (k * 0.39) % 16.0]).collect();
        let forces: Vec<Vec2> = places.iter().map(|[x, y]| Vec2::new(x.sin(), (y * 1.7).cos())).collect();
        let cells = 20 * 17;
        let both = |wide: bool| {
            let (mut fx, mut fy) = (vec![0.0; cells - 20], vec![0.0; cells]);
            let markers = places.iter().zip(&forces);
            let (fx_mut, fy_mut) = (&mut fx[..], &mut fy[..]);
            let task = Spreading { anywhere, pieces, scale: 3.0, markers, first_row: 0, fx: fx_mut, fy: fy_mut };
            if wide {
                dispatch(task);
            } else {
                task.run(Portable);
            }
            let mut velocities = vec![Vec2::zeros(); places.len()];
            let task = Interpolation { anywhere, pieces, places: &places, u: &fx, v: &fy, velocities: &mut velocities };
            if wide {
                dispatch(task);
            } else {
                task.run(Portable);
            }
            (fx, fy, velocities)
        };
        let (wide, plain) = (both(true), both(false));
        assert!(plain.0.iter().any(|value| *value != 0.0));
        assert_eq!(wide, plain);
    }
}

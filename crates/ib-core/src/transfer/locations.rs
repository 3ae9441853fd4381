//! Places of markers on the grid, found once for all passes over them.

use stokes_grid::Grid;

use super::lanes::{Lanes, LanesTask, dispatch};
use crate::kernel::Pieces;
use motile_base::Vec2;

/// The smallest number above which doubles have no fraction, times one and a half to leave room for negative ones.
const WHOLE: f64 = 6_755_399_441_055_744.0;

/// Returns the whole part of `x` and the rest in [0, 1], without the library call that `floor` is on machines of old.
/// Below 2^50 in size, else some number; at a whole number the rest may be one instead of zero, where continuous
/// weights agree.
#[inline(always)]
pub(super) fn split(x: f64) -> (i64, f64) {
    let shifted = (x - 0.5) + WHOLE;
    (whole(shifted), x - (shifted - WHOLE))
}

/// Returns the whole number that was added to [`WHOLE`].
#[inline(always)]
fn whole(shifted: f64) -> i64 {
    shifted.to_bits().wrapping_sub(WHOLE.to_bits()) as i64
}

/// The place of a marker: what spreading and interpolation need of it.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub(super) struct Location {
    /// The fractions of both coordinates of which weights are polynomials.
    pub(super) fractions: [f64; 2],
    /// The index of the first grid point of its window of four by four, or [`Location::IRREGULAR`].
    pub(super) base: u32,
    /// An [`Edge`] as a number; where it is irregular the index of the place.
    pub(super) kind: u32,
}

/// Difference of the stencil of a marker from its window.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Edge {
    /// It begins one row below the window, beyond the lower wall.
    pub(super) below: bool,
    /// It ends one row above the window, beyond the upper wall.
    pub(super) above: bool,
    /// The window ends the rows, and that many columns of the stencil (one to three) are in it; the others begin the
    /// rows. Zero if the stencil does not wrap around.
    pub(super) wrapped: usize,
}

impl Location {
    /// The stencil is not within a window or two.
    pub(super) const IRREGULAR: u32 = u32::MAX;
    /// The stencil is the window.
    pub(super) const REGULAR: u32 = 0;
    /// No marker.
    pub(super) const NONE: Self = Self { fractions: [0.0; 2], base: Self::IRREGULAR, kind: u32::MAX };

    /// Returns the treatment of a stencil at an edge of the grid.
    pub(super) fn edge(&self) -> Edge {
        Edge { below: self.kind & 1 != 0, above: self.kind & 2 != 0, wrapped: (self.kind >> 2) as usize }
    }
}

impl From<Edge> for u32 {
    fn from(edge: Edge) -> Self {
        Self::from(edge.below) | Self::from(edge.above) << 1 | (edge.wrapped as Self) << 2
    }
}

/// The markers of a scene on a grid.
#[derive(Debug, Clone)]
pub(super) struct Locations {
    /// In the order of the markers.
    pub(super) all: Vec<Location>,
    /// The places, in units of h from the origin of the grid and wrapped where the box is periodic, of the markers
    /// whose stencils wrap around the box or reach far beyond a wall, or of all where the kernel is not made of
    /// polynomials.
    pub(super) irregular: Vec<[f64; 2]>,
    grid: Grid,
}

impl Locations {
    pub(super) fn new(grid: Grid) -> Self {
        Self { all: Vec::new(), irregular: Vec::new(), grid }
    }

    /// Returns the row of a marker, to within two.
    #[cfg(feature = "rayon")]
    pub(super) fn row(&self, location: &Location) -> i64 {
        if location.base == Location::IRREGULAR {
            // What is not finite lands somewhere.
            self.irregular.get(location.kind as usize).map_or(0, |place| place[1] as i64)
        } else {
            i64::from(location.base) / self.grid.nx() as i64 + 1
        }
    }

    /// Takes the `positions` (length) of markers over, for a kernel of polynomials or any other.
    pub(super) fn find(&mut self, pieces: Option<&Pieces>, positions: &[Vec2]) {
        self.irregular.clear();
        self.all.resize(positions.len(), Location::default());
        let mut locations = std::mem::take(&mut self.all);
        if let Some(pieces) = pieces {
            dispatch(Search { shift: pieces.shift, positions, locations: &mut locations, on: self });
        } else {
            for (position, location) in positions.iter().zip(&mut locations) {
                let place = self.place(position);
                self.put_irregular(place, location);
            }
        }
        self.all = locations;
    }

    /// Returns the place of a position, wrapped where the box is periodic.
    fn place(&self, position: &Vec2) -> [f64; 2] {
        let scale = 1.0 / self.grid.spacing();
        let [x, y] = [scale * (position.x - self.grid.origin()[0]), scale * (position.y - self.grid.origin()[1])];
        // Wrapping before the weights keeps the column arithmetic exact for droplets that have travelled far.
        let wrapped = |r: f64, period: f64| if (0.0..period).contains(&r) { r } else { r.rem_euclid(period) };
        [wrapped(x, self.grid.nx() as f64), if self.grid.has_walls() { y } else { wrapped(y, self.grid.ny() as f64) }]
    }

    fn put_irregular(&mut self, place: [f64; 2], location: &mut Location) {
        *location = Location { kind: self.irregular.len() as u32, ..Location::NONE };
        self.irregular.push(place);
    }

    /// Returns the rows and columns at which a window may begin.
    fn windows(&self) -> [usize; 2] {
        // Between walls the y component has a row more than there are cells.
        [self.grid.nx().saturating_sub(3), self.grid.ny().saturating_sub(if self.grid.has_walls() { 2 } else { 3 })]
    }

    /// The location of any marker.
    #[inline(never)]
    fn find_one(&mut self, shift: f64, position: &Vec2, location: &mut Location) {
        let place = self.place(position);
        if let Some(found) = self.near_edge(shift, place) {
            *location = found;
        } else {
            self.put_irregular(place, location);
        }
    }

    /// Returns the location of a place whose stencil is a window except for one row beyond a wall and columns that wrap
    /// around.
    fn near_edge(&self, shift: f64, place: [f64; 2]) -> Option<Location> {
        let [(i, tx), (j, ty)] = place.map(|r| split(r + shift));
        let [first_column, first_row] = [i, j].map(|whole| whole.saturating_sub(1));
        let [columns, rows] = self.windows().map(|count| count as i64);
        if columns < 1 || rows < 2 {
            return None;
        }
        let (row, below, above) = match first_row {
            row if (0..rows).contains(&row) => (row, false, false),
            -1 if self.grid.has_walls() => (0, true, false),
            row if self.grid.has_walls() && row == rows => (rows - 1, false, true),
            _ => return None,
        };
        let nx = self.grid.nx() as i64;
        // Wrapped, a place is in the box or at its end.
        let column = if first_column < 0 { first_column.saturating_add(nx) } else { first_column };
        let (column, wrapped) = match column {
            column if (0..columns).contains(&column) => (column, 0),
            column if (columns..nx).contains(&column) => (columns - 1, (nx - column) as usize),
            _ => return None,
        };
        let base = u32::try_from(row * nx + column).ok().filter(|base| *base != Location::IRREGULAR)?;
        Some(Location { fractions: [tx, ty], base, kind: Edge { below, above, wrapped }.into() })
    }
}

/// The search for locations with the instructions of the machine.
struct Search<'a> {
    shift: f64,
    positions: &'a [Vec2],
    locations: &'a mut [Location],
    on: &'a mut Locations,
}

impl LanesTask for Search<'_> {
    #[inline(always)]
    fn run<L: Lanes>(self, l: L) {
        let Self { shift, positions, locations, on } = self;
        let [columns, rows] = on.windows().map(|count| count as u64);
        let nx = on.grid.nx() as u64;
        let [x0, y0] = on.grid.origin();
        let minus_origin = l.load([-x0, -y0, -x0, -y0]);
        let [scale, shift4, minus_half] = [1.0 / on.grid.spacing(), shift, -0.5].map(|value| l.splat(value));
        let [big, minus_big, minus_one] = [WHOLE, -WHOLE, -1.0].map(|value| l.splat(value));
        let (pairs, last) = positions.as_chunks::<2>();
        let (location_pairs, last_locations) = locations.as_chunks_mut::<2>();
        for (positions, locations) in pairs.iter().zip(location_pairs) {
            let [first, second] = positions;
            let places = l.mul(scale, l.add(l.load([first.x, first.y, second.x, second.y]), minus_origin));
            let places = l.add(places, shift4);
            let shifted = l.add(l.add(places, minus_half), big);
            let fractions = l.store(l.add(places, l.mul(minus_one, l.add(shifted, minus_big))));
            let [i0, j0, i1, j1] = l.store(shifted).map(|shifted| whole(shifted).wrapping_sub(1) as u64);
            let [x0, y0, x1, y1] = fractions;
            let [first, second] = locations;
            for (location, position, i, j, fractions) in
                [(first, &positions[0], i0, j0, [x0, y0]), (second, &positions[1], i1, j1, [x1, y1])]
            {
                // What is negative has become large.
                if i < columns && j < rows && j * nx + i < u64::from(Location::IRREGULAR) {
                    // One by one: a location that is put together first would be read back before it is in memory.
                    location.fractions = fractions;
                    location.base = (j * nx + i) as u32;
                    location.kind = Location::REGULAR;
                } else {
                    on.find_one(shift, position, location);
                }
            }
        }
        for (position, location) in last.iter().zip(last_locations) {
            on.find_one(shift, position, location);
        }
    }
}

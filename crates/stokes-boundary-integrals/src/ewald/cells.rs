//! Points of a box sorted into cells of half the cut-off, with the images beyond its sides.

use motile_base::internal::widely;

use super::lattice::Lattice;
use crate::shares;

/// Cells across the cut-off.
const ACROSS: usize = 2;
/// Fewest cells along a side, so that a point has one image beyond it at most.
pub(super) const FEWEST: usize = 2 * ACROSS;

/// Points in the cells of a box and of two rows of cells around it, which hold images.
#[derive(Debug, Clone, Default)]
pub(super) struct Cells {
    /// Cells along the sides, without those around the box.
    counts: [usize; 2],
    /// First entry of each cell, row after row.
    starts: Vec<usize>,
    /// Cell of each point, and the parts of the periods where it lies.
    homes: Vec<([u32; 2], [f64; 2])>,
    /// Number of the point of each entry.
    pub(super) points: Vec<u32>,
    /// Positions of the entries in units of the cut-off.
    pub(super) x: Vec<f64>,
    pub(super) y: Vec<f64>,
    /// Parts of the periods of the entries, below 1 in the box itself.
    pub(super) parts: Vec<[f64; 2]>,
}

impl Cells {
    /// Sorts points (length), with images in the cells around the box where `images` is true.
    pub(super) fn sort(
        &mut self,
        lattice: &Lattice,
        cutoff: f64,
        images: bool,
        points: impl Iterator<Item = [f64; 2]>,
    ) {
        let [lx, ly] = lattice.lengths;
        let counts = [lx / lattice.stretch(), ly].map(|length| ACROSS as f64 * length / cutoff);
        let counts = counts.map(|count| (count.floor() as usize).max(FEWEST));
        self.counts = counts;
        self.homes.clear();
        self.homes.extend(points.map(|point| ([0; 2], point)));
        let len = shares::length(self.homes.len());
        shares::each_of(self.homes.len(), self.homes.chunks_mut(len), |homes| {
            widely(
                #[inline(always)]
                || {
                    for (cell, place) in &mut **homes {
                        *place = lattice.parts(place[0], place[1]);
                        for axis in 0..2 {
                            cell[axis] = ((place[axis] * counts[axis] as f64) as u32).min(counts[axis] as u32 - 1);
                        }
                    }
                },
            );
        });
        let Self { starts, homes, points, x, y, parts, .. } = self;
        let width = counts[0] + 2 * ACROSS;
        starts.clear();
        starts.resize(width * (counts[1] + 2 * ACROSS) + 1, 0);
        let places = |cell: [u32; 2]| Places { cell, counts, images };
        for (cell, _) in &*homes {
            places(*cell).each(|[i, j], _| starts[j * width + i] += 1);
        }
        let mut end = 0;
        for start in starts.iter_mut() {
            end += *start;
            *start = end;
        }
        points.resize(end, 0);
        x.resize(end, 0.0);
        y.resize(end, 0.0);
        parts.resize(end, [0.0; 2]);
        let [lx, ly] = lattice.lengths.map(|length| length / cutoff);
        // From the last point on, so that those of a cell are in order and each start ends as the first entry.
        for (number, (cell, part)) in homes.iter().enumerate().rev() {
            places(*cell).each(|[i, j], [across, up]| {
                let start = &mut starts[j * width + i];
                *start -= 1;
                let height = (part[1] + up) * ly;
                points[*start] = number as u32;
                x[*start] = (part[0] + across) * lx + lattice.slope * height;
                y[*start] = height;
                parts[*start] = *part;
            });
        }
    }

    /// Returns the cells along the sides.
    pub(super) fn counts(&self) -> [usize; 2] {
        self.counts
    }

    fn start(&self, column: usize, row: usize) -> usize {
        self.starts[row * (self.counts[0] + 2 * ACROSS) + column]
    }

    /// Returns the entries of a cell of the box.
    pub(super) fn cell(&self, column: usize, row: usize) -> std::ops::Range<usize> {
        let (column, row) = (column + ACROSS, row + ACROSS);
        self.start(column, row)..self.start(column + 1, row)
    }

    /// Returns the entries of the cells of the box in one row.
    pub(super) fn row(&self, row: usize) -> std::ops::Range<usize> {
        let row = row + ACROSS;
        self.start(ACROSS, row)..self.start(ACROSS + self.counts[0], row)
    }

    /// Returns the entries within the cut-off from any place in a cell, and others. These are the entries of five rows
    /// of five cells.
    pub(super) fn around(&self, column: usize, row: usize) -> impl Iterator<Item = std::ops::Range<usize>> + '_ {
        let rows = row..=row + 2 * ACROSS;
        rows.map(move |row| self.start(column, row)..self.start(column + 2 * ACROSS + 1, row))
    }
}

/// The cell of a point and the cells of its images.
struct Places {
    cell: [u32; 2],
    counts: [usize; 2],
    images: bool,
}

impl Places {
    /// Calls `take` with each cell, counted from the corner of those around the box, and the periods that the image is
    /// displaced by.
    #[inline(always)]
    fn each(&self, mut take: impl FnMut([usize; 2], [f64; 2])) {
        let along = |axis: usize| {
            let (cell, count) = (self.cell[axis] as usize, self.counts[axis]);
            let image = if !self.images {
                None
            } else if cell < ACROSS {
                Some((cell + ACROSS + count, 1.0))
            } else if cell + ACROSS >= count {
                Some((cell + ACROSS - count, -1.0))
            } else {
                None
            };
            [Some((cell + ACROSS, 0.0)), image]
        };
        for (j, up) in along(1).into_iter().flatten() {
            for (i, across) in along(0).into_iter().flatten() {
                take([i, j], [across, up]);
            }
        }
    }
}

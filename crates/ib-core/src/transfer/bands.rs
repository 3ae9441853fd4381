//! Spreading and interpolation on several threads.

use rayon::prelude::*;
use stokes_grid::StaggeredField;

use super::general::GeneralTransfer;
use super::locations::{Location, Locations};
use super::order::{BLOCK, Band, Markers, spreading_order, stride};
use super::polynomial::{interpolate as interpolate_some, spread as spread_some};
use crate::{Kernel, kernel::MAX_SUPPORT};
use motile_base::Vec2;

/// Markers from which several threads pay.
const LEAST_MARKERS: usize = 30_000;

/// Bands of rows, and pieces of the list of markers, whatever the number of threads.
const BANDS: usize = 16;

/// Fewest rows of a band: many more than the kernels reach, so that few markers reach into two, and what is folded back
/// at a wall stays in the band at the wall.
const LEAST_ROWS: usize = 40;

/// Rows that no kernel reaches beyond, and two by which the row of a marker may be off.
const REACH: i64 = MAX_SUPPORT as i64 / 2 + 2;

/// Markers that one share interpolates.
const SHARE: usize = 1024;

/// Which markers reach which bands of rows of the grid.
///
/// Each band adds the forces of its markers in the order of the markers. So every value on the grid is the same sum in
/// the same order as on one thread.
#[derive(Debug, Clone, Default)]
pub(super) struct Bands {
    /// Rows of a band; the last one has more. Zero if one thread does it all.
    rows: usize,
    /// By piece of the list of markers and band: the markers, in order.
    lists: Vec<Vec<u32>>,
}

impl Bands {
    /// Returns true if [`Bands::find`] found enough work for several threads.
    pub(super) fn are_used(&self) -> bool {
        self.rows > 0
    }

    /// Sorts the markers into bands, if there are enough of them.
    pub(super) fn find<K: Kernel>(&mut self, general: GeneralTransfer<'_, K>, locations: &Locations) {
        let (rows, all) = (general.grid.ny(), &locations.all);
        let pays = all.len() >= LEAST_MARKERS && rows >= 2 * LEAST_ROWS && rayon::current_num_threads() > 1;
        self.rows = if pays { (rows / BANDS).max(LEAST_ROWS) } else { 0 };
        if !pays {
            return;
        }
        let (band_rows, bands) = (self.rows, rows / self.rows);
        let walls = general.grid.has_walls();
        self.lists.resize_with(BANDS * BANDS, Vec::new);
        // Of whole blocks, so that markers are visited in the order of one thread.
        let stride = stride(general.kernel);
        let piece = all.len().div_ceil(BANDS).next_multiple_of(BLOCK);
        let pieces = all.par_chunks(piece).zip(self.lists.par_chunks_mut(BANDS));
        pieces.enumerate().for_each(|(index, (piece_locations, lists))| {
            lists.iter_mut().for_each(Vec::clear);
            for k in spreading_order(piece_locations.len(), stride) {
                let (marker, row) = ((index * piece + k) as u32, locations.row(&piece_locations[k]));
                let (first, last) = (row.saturating_sub(REACH), row.saturating_add(REACH));
                // Beyond a wall a stencil is folded back by less than a band.
                let band = |row: i64| {
                    let rows = rows as i64;
                    let row = if walls { row.clamp(0, rows - 1) } else { row.rem_euclid(rows) };
                    (row as usize / band_rows).min(bands - 1)
                };
                let (first, last) = (band(first), band(last));
                lists[first].push(marker);
                if last != first {
                    lists[last].push(marker);
                }
            }
        });
    }

    /// Spreads, band by band.
    pub(super) fn spread<K: Kernel>(
        &self,
        general: GeneralTransfer<'_, K>,
        locations: &Locations,
        forces: &[Vec2],
        scale: f64,
        components: [&mut [f64]; 2],
    ) {
        let bands = general.grid.ny() / self.rows;
        let work = |band: usize, [fx, fy]: [&mut [f64]; 2]| {
            let (mut near, mut pushing) = ([Location::NONE; BLOCK], [Vec2::ZERO; BLOCK]);
            for lists in self.lists.chunks_exact(BANDS) {
                for some in lists[band].chunks(BLOCK) {
                    for (k, marker) in some.iter().enumerate() {
                        (near[k], pushing[k]) = (locations.all[*marker as usize], forces[*marker as usize]);
                    }
                    let (near, pushing) = (&near[..some.len()], &pushing[..some.len()]);
                    // The list is in the order in which they are added.
                    let markers =
                        Markers { locations: near, forces: pushing, stride: 1, irregular: &locations.irregular };
                    let band = Band { first_row: band * self.rows, fx: &mut *fx, fy: &mut *fy };
                    spread_some(general, scale, markers, band);
                }
            }
        };
        divide(0, bands, self.rows * general.grid.nx(), components, &work);
    }
}

/// Does `work` for each of the bands from `first` to before `end`, whose rows begin at `components` and of which all
/// but the last have `size` values, by halves that any thread may take.
fn divide(
    first: usize,
    end: usize,
    size: usize,
    components: [&mut [f64]; 2],
    work: &(impl Fn(usize, [&mut [f64]; 2]) + Sync),
) {
    if end - first == 1 {
        work(first, components);
        return;
    }
    let middle = first.midpoint(end);
    let [(fx, fx_above), (fy, fy_above)] = components.map(|values| values.split_at_mut((middle - first) * size));
    rayon::join(
        || divide(first, middle, size, [fx, fy], work),
        || divide(middle, end, size, [fx_above, fy_above], work),
    );
}

/// Interpolates, marker by marker.
pub(super) fn interpolate<K: Kernel>(
    general: GeneralTransfer<'_, K>,
    locations: &[Location],
    irregular: &[[f64; 2]],
    velocity: &StaggeredField,
    velocities: &mut [Vec2],
) {
    locations
        .par_chunks(SHARE)
        .zip(velocities.par_chunks_mut(SHARE))
        .for_each(|(locations, velocities)| interpolate_some(general, locations, irregular, velocity, velocities));
}

#[cfg(test)]
mod tests;

//! Lists of markers and bands of rows, and the order in which markers are spread.

use motile_base::Vec2;

use super::locations::Location;
use crate::Kernel;

/// Markers that are spread in another order than the caller's.
pub(super) const BLOCK: usize = 64;

/// Distance between one marker of a block and the next.
///
/// Sums for one marker must be in memory before those that overlap with them are read again, and markers next to each
/// other in the list mostly overlap.
const STRIDE: usize = 8;

/// Returns the distance between markers that are added one after another.
pub(super) fn stride<K: Kernel>(kernel: &K) -> usize {
    // Other kernels take so long that it does not matter.
    if kernel.pieces().is_some() { STRIDE } else { 1 }
}

/// Returns the order in which `count` markers are spread: block by block, in each of them those at a distance of
/// `stride` from the first, then those next to them, and so on.
#[cfg(feature = "rayon")]
pub(super) fn spreading_order(count: usize, stride: usize) -> impl Iterator<Item = usize> {
    (0..count).step_by(BLOCK).flat_map(move |start| {
        let end = count.min(start + BLOCK);
        (start..end.min(start + stride)).flat_map(move |first| (first..end).step_by(stride))
    })
}

/// Markers to be spread.
#[derive(Debug)]
pub(super) struct Markers<'a> {
    pub(super) locations: &'a [Location],
    pub(super) forces: &'a [Vec2],
    /// Distance within a block from one marker to that which is added next.
    pub(super) stride: usize,
    pub(super) irregular: &'a [[f64; 2]],
}

/// Some rows of both components.
#[derive(Debug)]
pub(super) struct Band<'a> {
    pub(super) first_row: usize,
    pub(super) fx: &'a mut [f64],
    pub(super) fy: &'a mut [f64],
}

#[cfg(all(test, feature = "rayon"))]
mod tests;

//! The order in which markers are spread.

/// Markers that are spread in an order of their own.
pub(super) const BLOCK: usize = 64;

/// Distance between one marker of a block and the next.
///
/// What is added for one marker must be in memory before what overlaps with it is read again, and markers next to each
/// other in the list mostly overlap.
pub(super) const STRIDE: usize = 8;

/// The order in which `count` markers are spread: block by block, in each of them those at a distance of `stride` from
/// the first, then those next to them, and so on.
#[cfg(feature = "rayon")]
pub(super) fn spreading_order(count: usize, stride: usize) -> impl Iterator<Item = usize> {
    (0..count).step_by(BLOCK).flat_map(move |start| {
        let end = count.min(start + BLOCK);
        (start..end.min(start + stride)).flat_map(move |first| (first..end).step_by(stride))
    })
}

#[cfg(all(test, feature = "rayon"))]
mod tests;

//! The order in which markers are spread.

/// Markers that are visited in an order of their own.
pub(super) const BLOCK: usize = 64;

/// Distance between one marker of a block and the next.
///
/// What is added for one marker must be in memory before what overlaps with it is read again, and markers next to each
/// other in the list mostly overlap.
pub(super) const STRIDE: usize = 8;

/// The order in which `count` markers are spread: block by block, in each of them those at a distance of `stride` from
/// the first, then those next to them, and so on.
#[cfg(feature = "rayon")]
pub(super) fn visits(count: usize, stride: usize) -> impl Iterator<Item = usize> {
    (0..count).step_by(BLOCK).flat_map(move |start| {
        let end = count.min(start + BLOCK);
        (start..end.min(start + stride)).flat_map(move |first| (first..end).step_by(stride))
    })
}

#[cfg(all(test, feature = "rayon"))]
mod tests {
    use super::*;

    #[test]
    fn every_marker_is_visited_once() {
        for count in [0, 1, 7, 8, 9, 63, 64, 65, 130, 1000] {
            let mut order: Vec<usize> = visits(count, STRIDE).collect();
            order.sort_unstable();
            assert!(order.into_iter().eq(0..count), "{count}");
        }
        assert!(visits(65, STRIDE).take(10).eq([0, 8, 16, 24, 32, 40, 48, 56, 1, 9]));
        assert!(visits(130, 1).eq(0..130));
    }
}

//! Work on the entries of lists, on several threads.

/// Markers from which the halves of a list pay for a thread each.
pub(crate) const MANY: usize = 6000;
/// Pieces of work on so many markers, for any number of threads.
pub(crate) const PIECES: usize = 16;

/// Returns the number of pieces in which work on so many markers is done where each has a separate result.
pub(crate) fn pieces(markers: usize) -> usize {
    if markers < MANY { 1 } else { PIECES }
}

/// Does the work of each entry, the first of which has the number `first`, and which stand for so many markers; no
/// entry sees another one. With the feature `rayon` on all threads.
pub(crate) fn each<T: Send>(first: usize, list: &mut [T], markers: usize, work: &(impl Fn(usize, &mut T) + Sync)) {
    #[cfg(feature = "rayon")]
    if list.len() > 1 && markers >= MANY {
        let (below, above) = list.split_at_mut(list.len() / 2);
        let second = first + below.len();
        let half = markers / 2;
        rayon::join(|| each(first, below, half, work), || each(second, above, half, work));
        return;
    }
    #[cfg(not(feature = "rayon"))]
    let _ = markers;
    (first..).zip(list).for_each(|(index, entry)| work(index, entry));
}

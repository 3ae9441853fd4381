//! Pieces of work that any thread may take.

/// Most pieces, whatever the number of threads, so that results do not depend on it: two for each of eight threads.
pub(super) const MOST: usize = 16;

/// Does the work of each share, which no other one sees; on all threads with the feature `rayon`.
#[cfg(feature = "rayon")]
pub(super) fn each<T: Send>(shares: &mut [T], work: impl Fn(&mut T) + Sync + Send) {
    use rayon::prelude::*;
    if rayon::current_num_threads() > 1 {
        shares.par_iter_mut().for_each(work);
    } else {
        shares.iter_mut().for_each(work);
    }
}

/// Does the work of each share, which no other one sees; on all threads with the feature `rayon`.
#[cfg(not(feature = "rayon"))]
pub(super) fn each<T>(shares: &mut [T], work: impl Fn(&mut T)) {
    shares.iter_mut().for_each(work);
}

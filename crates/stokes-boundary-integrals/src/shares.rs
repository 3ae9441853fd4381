//! Pieces of work that any thread may take.

use std::array;

/// Most pieces, whatever the number of threads, so that results do not depend on it: two for each of eight threads.
pub const MOST: usize = 16;

/// Does the work of each share, which no other one sees; on all threads with the feature `rayon`.
#[cfg(feature = "rayon")]
pub fn each<T: Send>(shares: &mut [T], work: impl Fn(&mut T) + Sync + Send) {
    use rayon::prelude::*;
    if shares.len() > 1 && rayon::current_num_threads() > 1 {
        shares.par_iter_mut().for_each(work);
    } else {
        shares.iter_mut().for_each(work);
    }
}

/// Does the work of each share, which no other one sees; on all threads with the feature `rayon`.
#[cfg(not(feature = "rayon"))]
pub fn each<T>(shares: &mut [T], work: impl Fn(&mut T)) {
    shares.iter_mut().for_each(work);
}

/// Fewest entries of a piece: fewer take less time than to hand them over.
const FEWEST: usize = 256;

/// Returns the length of the pieces of so many entries, at most [`MOST`] of them, which are the same for any number of
/// threads.
pub(crate) fn length(entries: usize) -> usize {
    entries.div_ceil(MOST).max(FEWEST)
}

/// Entries from which on pieces are handed over.
const MANY: usize = 1000;

/// Returns the number of the curves in a piece, of so many with so many nodes in all: of few nodes all are one piece.
pub(crate) fn curves(curves: usize, nodes: usize) -> usize {
    if nodes < MANY { curves.max(1) } else { curves.div_ceil(MOST).max(1) }
}

/// Does the work of each of at most [`MOST`] pieces of so many entries, as [`each`] does, few entries on this thread.
pub(crate) fn each_of<T: Send>(entries: usize, pieces: impl Iterator<Item = T>, work: impl Fn(&mut T) + Sync + Send) {
    if entries < MANY {
        return pieces.for_each(|mut piece| work(&mut piece));
    }
    let mut pieces = pieces.fuse();
    let mut all: [Option<T>; MOST] = array::from_fn(|_| pieces.next());
    let used = all.iter().take_while(|piece| piece.is_some()).count();
    each(&mut all[..used], |piece| {
        if let Some(piece) = piece {
            work(piece);
        }
    });
}

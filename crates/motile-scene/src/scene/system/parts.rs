//! Work on all bodies, each with its range of flat lists, on several threads.

use std::ops::Range;

#[cfg(feature = "rayon")]
use crate::threads::MANY;
use crate::{Body, BodyError};

/// Some bodies, one after the other, and their parts of flat lists.
pub(super) struct Parts<'a, T> {
    /// Number of the first body, and its first entry of a list.
    first: usize,
    start: usize,
    /// Number of entries of all bodies, about.
    entries: usize,
    bodies: &'a mut [Box<dyn Body>],
    /// Entries that are written; none where all lists are only read.
    values: &'a mut [T],
}

impl<'a, T: Send> Parts<'a, T> {
    /// Creates all bodies, with so many entries of the lists, of which `values` are written.
    pub(super) fn of(bodies: &'a mut [Box<dyn Body>], entries: usize, values: &'a mut [T]) -> Self {
        Self { first: 0, start: 0, entries, bodies, values }
    }

    /// Calls `work` with the number of each body, the body, its range of a list, and its range of the values that are
    /// written. Numbers of entries are `len` of the number and the body. Gives the first body that fails, and its
    /// error: on one thread those after it are left alone.
    pub(super) fn each(
        self,
        len: &(impl Fn(usize, &dyn Body) -> usize + Sync),
        work: &(impl Fn(usize, &mut dyn Body, Range<usize>, &mut [T]) -> Result<(), BodyError> + Sync),
    ) -> Option<(usize, BodyError)> {
        let Self { first, start, entries, bodies, mut values } = self;
        #[cfg(not(feature = "rayon"))]
        let _ = entries;
        #[cfg(feature = "rayon")]
        if bodies.len() > 1 && entries >= MANY {
            let entries = entries / 2;
            let (below, above) = bodies.split_at_mut(bodies.len() / 2);
            let count = below.iter().enumerate().map(|(k, body)| len(first + k, body.as_ref())).sum::<usize>();
            let (written, written_above) = values.split_at_mut(count.min(values.len()));
            let second = first + below.len();
            let lower = Self { first, start, entries, bodies: below, values: written };
            let upper = Self { first: second, start: start + count, entries, bodies: above, values: written_above };
            let (failed, failed_above) = rayon::join(|| lower.each(len, work), || upper.each(len, work));
            return failed.or(failed_above);
        }
        let mut start = start;
        for (index, body) in (first..).zip(bodies) {
            let count = len(index, body.as_ref());
            let part = values.split_off_mut(..count.min(values.len())).unwrap_or_default();
            if let Err(source) = work(index, body.as_mut(), start..start + count, part) {
                return Some((index, source));
            }
            start += count;
        }
        None
    }
}

/// Returns the number of markers of a body.
pub(super) fn markers(_: usize, body: &dyn Body) -> usize {
    body.marker_count()
}

/// Returns the number of entries of the state of a body.
pub(super) fn states(_: usize, body: &dyn Body) -> usize {
    body.state_len()
}

#[cfg(test)]
mod tests;

//! What can go wrong in a transform.

/// An error of this crate, with the offending values and the remedy.
#[derive(Debug, Clone, Copy, PartialEq, Eq, thiserror::Error)]
#[non_exhaustive]
pub enum FourierError {
    /// A slice of another length than planned for.
    #[error("{name} has {found} values, the transform was planned for {expected}: make a plan for that length")]
    WrongLength {
        /// The slice.
        name: &'static str,
        /// Values planned for.
        expected: usize,
        /// Values given.
        found: usize,
    },
}

/// An error if a slice has not the length planned for.
pub(crate) fn same_length(name: &'static str, found: usize, expected: usize) -> Result<(), FourierError> {
    if found == expected { Ok(()) } else { Err(FourierError::WrongLength { name, expected, found }) }
}

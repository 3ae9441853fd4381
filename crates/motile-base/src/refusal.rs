//! Refusals of what cannot be used.

/// Something that cannot be used, and the remedy.
///
/// ```
/// use motile_base::{Refusal, internal::Refuse};
///
/// let (what, remedy) = ("the grid is too small", "Use at least 4 cells in each direction");
/// let text = "the grid is too small: 3 x 8 cells. Use at least 4 cells in each direction";
/// assert_eq!(Refusal::refused(what, "3 x 8 cells", remedy).to_string(), text);
/// let text = "the walls are missing. Add them";
/// assert_eq!(Refusal::refused("the walls are missing", "", "Add them").to_string(), text);
/// ```
#[derive(Clone, PartialEq, Eq, thiserror::Error)]
#[error("{what}{}{value}. {remedy}", if value.is_empty() { "" } else { ": " })]
pub struct Refusal {
    /// Sentence that says what is wrong.
    pub what: String,
    /// The offending value and the reason, empty if the sentence has them.
    pub value: String,
    /// Sentence that says what to do.
    pub remedy: String,
}

crate::debug_as_explanation!(Refusal);

/// Errors that a [`Refusal`] is one of.
pub trait Refuse: From<Refusal> {
    /// Creates an error that says what is wrong, the offending value, and what to do.
    #[must_use]
    fn refused(what: impl Into<String>, value: impl Into<String>, remedy: impl Into<String>) -> Self {
        Refusal { what: what.into(), value: value.into(), remedy: remedy.into() }.into()
    }
}

impl<E: From<Refusal>> Refuse for E {}

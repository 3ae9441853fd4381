//! Errors of files and outlines.

use std::path::PathBuf;

use motile_base::{
    InputError, Vec2,
    internal::{place, told},
};

/// An outline that cannot be read or used; its message says what to do.
#[derive(Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum OutlineError {
    /// A file that cannot be opened.
    #[error(
        "the file {} cannot be read: {problem}. Check the path, which is relative to the scene file", path.display()
    )]
    Unreadable {
        /// The file.
        path: PathBuf,
        /// The reason.
        problem: String,
    },
    /// Contents that are not an outline in a known format.
    #[error("{place} cannot be read: {problem}. {remedy}")]
    Format {
        /// The place in the file, such as `line 3`.
        place: String,
        /// The problem there.
        problem: String,
        /// The remedy.
        remedy: &'static str,
    },
    /// A file with several outlines, none of which was chosen.
    #[error(
        "the file has {count} outlines{}. Choose one by `name`, or by `index`, counted from 0",
        if names.is_empty() { String::new() } else { format!(" ({names})") }
    )]
    Several {
        /// Number of outlines.
        count: usize,
        /// Names of the first ones.
        names: String,
    },
    /// A choice of an outline that the file does not have.
    #[error(
        "the file has no outline {wanted}. It has {count}{}",
        if names.is_empty() { String::new() } else { format!(": {names}") }
    )]
    Missing {
        /// The choice.
        wanted: String,
        /// Number of outlines.
        count: usize,
        /// Names of the first ones.
        names: String,
    },
    /// Too few points.
    #[error("the outline has {found} different points. Give at least {least}")]
    TooFewPoints {
        /// Number of points.
        found: usize,
        /// Least number.
        least: usize,
    },
    /// A point that is not finite, or too large or too small to compute with.
    #[error("point {number} of the outline, {at}, is not a finite number below 1e50. Correct it, or remove it")]
    NotFinite {
        /// Number of the point, from 0.
        number: usize,
        /// Its coordinates.
        at: String,
    },
    /// An outline that encloses no area.
    #[error(
        "the outline encloses no area: its points lie on a line or go back on themselves. Give them in order around it"
    )]
    NoArea,
    /// An outline that crosses itself.
    #[error("the outline crosses or touches itself near {at}, at its points {first} and {second}. {remedy}")]
    Crossing {
        /// The place.
        at: String,
        /// Number of the first point of one side.
        first: usize,
        /// Number of the first point of the other side.
        second: usize,
        /// The remedy.
        remedy: &'static str,
    },
    /// A distance of smoothing that is too small for any smooth curve.
    #[error(
        "a smooth curve cannot stay within {wanted} of this outline. Use at least {least} for `smooth`, or leave it out"
    )]
    TooClose {
        /// The distance.
        wanted: String,
        /// Distance that a curve keeps.
        least: String,
    },
    /// A line in place of a closed outline, or a closed outline in place of a line.
    #[error("{what}. {remedy}")]
    Kind {
        /// The problem.
        what: &'static str,
        /// The remedy.
        remedy: &'static str,
    },
    /// A number that cannot be used.
    #[error(transparent)]
    Input(#[from] InputError),
}

motile_base::debug_as_explanation!(OutlineError);

/// Most characters of a file that a message quotes.
const QUOTED: usize = 40;

/// Returns the start of a text that a message quotes.
pub(crate) fn quoted(text: &str) -> String {
    text.chars().filter(|c| !c.is_control()).take(QUOTED).collect()
}

impl OutlineError {
    /// Returns the error for contents that cannot be read.
    pub(crate) fn format(place: impl Into<String>, problem: impl Into<String>, remedy: &'static str) -> Self {
        Self::Format { place: place.into(), problem: problem.into(), remedy }
    }

    /// Returns the error for an outline whose sides cross.
    pub(crate) fn crossing(at: Vec2, [first, second]: [usize; 2], remedy: &'static str) -> Self {
        Self::Crossing { at: place(at.x, at.y), first, second, remedy }
    }

    /// Returns the error for a point that is not finite.
    pub(crate) fn not_finite(number: usize, at: Vec2) -> Self {
        Self::NotFinite { number, at: format!("({}, {})", told(at.x), told(at.y)) }
    }
}

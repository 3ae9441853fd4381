//! What can go wrong in drawing and writing.

use std::{io, path::PathBuf};

use motile::{active_interface::InterfaceError, elastic_solids::SolidError, ib_core::SceneError};

/// Why something cannot be drawn or written. Each says what it was given, and what to do.
#[derive(thiserror::Error)]
#[non_exhaustive]
pub enum Error {
    /// A file or directory that cannot be written.
    #[error("writing {}: {source}", path.display())]
    Write {
        /// Where.
        path: PathBuf,
        /// Why not.
        source: io::Error,
    },
    /// An image, panel or number of cells that is too small or too large.
    #[error("{what} of {given} cannot be drawn: give {least} to {most}")]
    Size {
        /// What is to have the size.
        what: &'static str,
        /// The size.
        given: f64,
        /// The least that there may be.
        least: f64,
        /// The most.
        most: f64,
    },
    /// A rectangle that is empty, not finite, or much longer than wide.
    #[error(
        "the rectangle of size {size:?} at {corner:?} cannot be drawn: give finite sizes above 0, of ratio below 20"
    )]
    Rectangle {
        /// Lower left corner (length).
        corner: [f64; 2],
        /// Width and height (length).
        size: [f64; 2],
    },
    /// A domain without end: it has no rectangle that could be drawn.
    #[error("a domain without end cannot be drawn: give a raster of the part that is to be seen")]
    Unbounded,
    /// Values that are not as many as their points, cells or columns.
    #[error("{given} {what} where there must be {expected}")]
    Count {
        /// What they are.
        what: String,
        /// How many there are.
        given: usize,
        /// How many there must be.
        expected: usize,
    },
    /// Streamlines so dense that they would fill the picture, or a distance that is none.
    #[error(
        "streamlines cannot be {spacing} apart in a rectangle of {size:?}: give a distance of at least a thousandth of \
         it"
    )]
    Streamlines {
        /// Their distance (length).
        spacing: f64,
        /// Width and height of the rectangle (length).
        size: [f64; 2],
    },
    /// A name that a file cannot hold: empty, given twice, or with characters that would need to be escaped.
    #[error("{name:?} cannot be the name of {what}: give another one, of letters, digits, '_', '-' and spaces")]
    Name {
        /// The name.
        name: String,
        /// What is to have it.
        what: &'static str,
    },
    /// A column that a table does not have.
    #[error("there is no column {name:?} among {known:?}")]
    Column {
        /// The name.
        name: String,
        /// The columns that there are.
        known: Vec<String>,
    },
    /// Nothing to be drawn or written.
    #[error("{0} cannot be written: add at least one")]
    Empty(&'static str),
    /// A flow that cannot be computed, or a droplet that the scene does not have.
    #[error(transparent)]
    Scene(#[from] SceneError),
    /// A droplet that cannot be measured.
    #[error(transparent)]
    Interface(#[from] InterfaceError),
    /// A state that an observer cannot measure.
    #[error("the state cannot be measured: {0}")]
    Observer(#[source] Box<dyn std::error::Error + Send + Sync>),
    /// A solid that cannot be measured.
    #[error(transparent)]
    Solid(#[from] SolidError),
}

motile::ib_core::input::debug_as_explanation!(Error);

impl Error {
    /// Turns the error of writing to `path` into one that names the place.
    pub(crate) fn writing<E: Into<io::Error>>(path: impl Into<PathBuf>) -> impl FnOnce(E) -> Self {
        |source| Self::Write { path: path.into(), source: source.into() }
    }

    /// Refuses a size outside of `least..=most`, and one that is not a number.
    pub(crate) fn check_size(what: &'static str, given: f64, least: f64, most: f64) -> Result<(), Self> {
        if (least..=most).contains(&given) { Ok(()) } else { Err(Self::Size { what, given, least, most }) }
    }

    /// Refuses a number of values other than `expected`.
    pub(crate) fn check_count(what: &str, given: usize, expected: usize) -> Result<(), Self> {
        if given == expected { Ok(()) } else { Err(Self::Count { what: what.to_string(), given, expected }) }
    }
}

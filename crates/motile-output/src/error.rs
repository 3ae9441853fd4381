//! Errors of drawing and writing.

use std::{
    io,
    path::{Path, PathBuf},
};

use motile::active_interface::InterfaceError;
use motile::analysis::AnalysisError;
use motile::elastic_solids::SolidError;
use motile::scene::SceneError;

/// Error of drawing or writing, with the offending value and the remedy.
#[derive(thiserror::Error)]
#[non_exhaustive]
pub enum OutputError {
    /// File or directory that cannot be written.
    #[error("writing {}: {source}", path.display())]
    Write {
        /// Path of the file or directory.
        path: PathBuf,
        /// Error of the system.
        source: io::Error,
    },
    /// Picture whose name does not end in that of a format that can be written.
    #[error("{} cannot be written: give a name that ends in .{}", path.display(), formats.join(" or ."))]
    Format {
        /// Path of the file.
        path: PathBuf,
        /// Endings of the formats.
        formats: &'static [&'static str],
    },
    /// Image, panel or number of cells that is too small or too large.
    #[error("{what} of {given} cannot be drawn: give {least:?} to {most:?}")]
    Size {
        /// Object that is to have the size.
        what: &'static str,
        /// Size that was given.
        given: f64,
        /// Smallest size.
        least: f64,
        /// Largest size.
        most: f64,
    },
    /// Rectangle that is empty, not finite, or much longer than wide.
    #[error(
        "the rectangle of size {size:?} at {corner:?} cannot be drawn: give finite sizes above 0, of ratio below 20"
    )]
    Rectangle {
        /// Lower left corner (length).
        corner: [f64; 2],
        /// Width and height (length).
        size: [f64; 2],
    },
    /// Range of colours that is empty or not finite.
    #[error("colours cannot range from {low} to {high}: give finite ends, the lower one first")]
    Range {
        /// Lower end.
        low: f64,
        /// Upper end.
        high: f64,
    },
    /// Unbounded domain, which has no rectangle of its own to draw.
    #[error("an unbounded domain cannot be drawn: give a raster of the part that is to be seen")]
    Unbounded,
    /// Number of values other than that of their points, cells or columns.
    #[error("{given} {what} where there must be {expected}")]
    Count {
        /// Name of the values.
        what: String,
        /// Number of values given.
        given: usize,
        /// Number of values needed.
        expected: usize,
    },
    /// Distance of streamlines that is not positive, or so small that lines would fill the picture.
    #[error(
        "streamlines cannot be {spacing} apart in a rectangle of {size:?}: give a distance of at least a thousandth of \
         it"
    )]
    Streamlines {
        /// Distance of the streamlines (length).
        spacing: f64,
        /// Width and height of the rectangle (length).
        size: [f64; 2],
    },
    /// Name that a file cannot hold: empty, given twice, or with characters that would need to be escaped.
    #[error("{name:?} cannot be the name of {what}: give another one, of letters, digits, '_', '-' and spaces")]
    Name {
        /// Name that was given.
        name: String,
        /// Object that is to have the name.
        what: &'static str,
    },
    /// Column that a table does not have.
    #[error("there is no column {name:?}: give one of {known:?}")]
    Column {
        /// Name that was given.
        name: String,
        /// Names of the columns.
        known: Vec<String>,
    },
    /// Figure or animation with nothing in it.
    #[error("{0} cannot be written: add at least one")]
    Empty(&'static str),
    /// Flow that cannot be computed, or droplet that the scene does not have.
    #[error(transparent)]
    Scene(#[from] SceneError),
    /// Droplet that cannot be measured.
    #[error(transparent)]
    Interface(#[from] InterfaceError),
    /// A trajectory that cannot be analysed.
    #[error(transparent)]
    Analysis(#[from] AnalysisError),
    /// State that an observer cannot measure.
    #[error("the state cannot be measured: {0}")]
    Observer(#[source] Box<dyn std::error::Error + Send + Sync>),
    /// Solid that cannot be measured.
    #[error(transparent)]
    Solid(#[from] SolidError),
}

motile::base::debug_as_explanation!(OutputError);

impl OutputError {
    /// Conversion of errors of writing to `path` into ones that name the path.
    pub(crate) fn writing<E: Into<io::Error>>(path: impl Into<PathBuf>) -> impl FnOnce(E) -> Self {
        |source| Self::Write { path: path.into(), source: source.into() }
    }

    /// Refuses a name that does not end in one of some formats.
    pub(crate) fn check_format(path: &Path, formats: &'static [&'static str]) -> Result<(), Self> {
        let ending = path.extension().unwrap_or_default();
        let known = formats.iter().any(|format| ending.eq_ignore_ascii_case(format));
        if known { Ok(()) } else { Err(Self::Format { path: path.to_owned(), formats }) }
    }

    /// Refuses sizes outside of `least..=most`, and not a number.
    pub(crate) fn check_size(what: &'static str, given: f64, least: f64, most: f64) -> Result<(), Self> {
        if (least..=most).contains(&given) { Ok(()) } else { Err(Self::Size { what, given, least, most }) }
    }

    /// Refuses numbers of values other than `expected`.
    pub(crate) fn check_count(what: &str, given: usize, expected: usize) -> Result<(), Self> {
        if given == expected { Ok(()) } else { Err(Self::Count { what: what.to_string(), given, expected }) }
    }
}

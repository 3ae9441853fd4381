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
    /// Picture whose name does not end like a format that can be written.
    #[error("{} cannot be written. Use a name that ends in .{}", path.display(), formats.join(" or ."))]
    Format {
        /// Path of the file.
        path: PathBuf,
        /// Endings of the formats.
        formats: &'static [&'static str],
    },
    /// Image, panel or number of cells that is too small or too large.
    #[error("{what} of {given} cannot be drawn. Use a number from {least:?} to {most:?}")]
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
        "the rectangle of size {size:?} at {corner:?} cannot be drawn. Use finite sizes above 0, of ratio below 20"
    )]
    Rectangle {
        /// Lower left corner (length).
        corner: [f64; 2],
        /// Width and height (length).
        size: [f64; 2],
    },
    /// Range of colours that is empty or not finite.
    #[error("colours cannot range from {low} to {high}. Use two finite numbers, the lower one first")]
    Range {
        /// Lower end.
        low: f64,
        /// Upper end.
        high: f64,
    },
    /// Unbounded domain, which has no rectangle to draw by default.
    #[error("an unbounded region cannot be drawn as a whole. Choose the rectangle that you want to see")]
    Unbounded,
    /// Number of values that differs from the number of their points, cells or columns.
    #[error("{given} {what} were given, but {expected} are needed. Use as many as there are")]
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
        "streamlines cannot be {spacing} apart in a rectangle of {size:?}. Use a distance of at least a thousandth of \
         it"
    )]
    Streamlines {
        /// Distance of the streamlines (length).
        spacing: f64,
        /// Width and height of the rectangle (length).
        size: [f64; 2],
    },
    /// Name that a file cannot hold: empty, given twice, or with characters that would need to be escaped.
    #[error("{name:?} cannot be the name of {what}. Use letters, digits, '_', '-' and spaces only")]
    Name {
        /// Name that was given.
        name: String,
        /// Object that is to have the name.
        what: &'static str,
    },
    /// Column that a table does not have.
    #[error("the table has no column {name:?}. Use one of {known:?}")]
    Column {
        /// Name that was given.
        name: String,
        /// Names of the columns.
        known: Vec<String>,
    },
    /// Figure or animation with nothing in it.
    #[error("{0} cannot be written. Add at least one")]
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
    /// Returns the conversion of errors of writing to `path` into ones that name the path.
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

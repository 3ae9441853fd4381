//! Files of outlines, whatever their format.

use std::fs;
use std::path::Path;

use motile_base::Vec2;

use crate::{OutlineError, csv, encoding, geojson, imagej, svg};

/// Most bytes of a file: a device delivers bytes without end.
const MOST_BYTES: u64 = 1 << 28;
/// Most points of a file, more than any method resolves.
pub(crate) const MOST_POINTS: usize = 1_000_000;
/// Most names that a message lists.
const LISTED: usize = 8;

/// Format of a file of outlines. It is found from the contents, not from the name.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[non_exhaustive]
pub enum FileFormat {
    /// Table of points: columns by commas, semicolons, tabs or spaces, with a header or without. Blank lines separate
    /// outlines, and so do the values of a column such as `cell`, `contour` or `frame`. A first line with the number of
    /// points, as in `.vertex` files of IBAMR, is understood.
    Csv,
    /// Vector graphics: paths, polygons, rectangles, circles and ellipses.
    Svg,
    /// Polygons and lines with their properties, or a list of points `[[x, y], ...]`.
    GeoJson,
    /// Region of interest of ImageJ and Fiji (`.roi`).
    ImageJ,
}

/// One outline of a file, as it stands there.
#[derive(Debug, Clone, PartialEq)]
pub struct Contour {
    /// Name in the file; `None` for one without a name.
    pub name: Option<String>,
    /// Its points in order (unit of the file).
    pub points: Vec<Vec2>,
    /// False for what the file says is an open line.
    pub closed: bool,
}

/// The outlines of a file.
#[derive(Debug, Clone, PartialEq)]
pub struct OutlineFile {
    /// Format of the file.
    pub format: FileFormat,
    /// Its outlines, in their order in the file.
    pub contours: Vec<Contour>,
    /// True if y runs downwards in the file, as in pictures.
    y_runs_down: bool,
}

/// Choice of one of the outlines of a file.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
#[non_exhaustive]
pub enum Choice {
    /// The only outline. A file with several outlines is refused.
    #[default]
    Only,
    /// The outline with this number, counted from 0.
    Index(usize),
    /// The outline with this name.
    Name(String),
}

impl OutlineFile {
    /// Reads a file.
    ///
    /// # Errors
    /// Returns [`OutlineError::Unreadable`] for a file that cannot be opened or has more than 256 MB, and the errors of
    /// [`OutlineFile::from_bytes`].
    pub fn read(path: &Path) -> Result<Self, OutlineError> {
        Self::from_bytes(&bytes_of(path)?)
    }

    /// Reads the contents of a file, whose format is found from them.
    ///
    /// # Errors
    /// Returns [`OutlineError::Format`] for contents in no format that is known, with the place and the remedy.
    pub fn from_bytes(bytes: &[u8]) -> Result<Self, OutlineError> {
        let remedy = "Use CSV, SVG, GeoJSON or an ImageJ region of interest (.roi)";
        let blank = |byte: &u8| byte.is_ascii_whitespace() || b"\xef\xbb\xbf".contains(byte);
        if bytes.iter().all(blank) {
            return Err(OutlineError::format("the file", "it is empty", remedy));
        }
        let (format, (contours, y_runs_down)) = if bytes.starts_with(b"Iout") {
            (FileFormat::ImageJ, (vec![imagej::read(bytes)?], true))
        } else {
            let text = encoding::text_of(bytes)?;
            match text.bytes().next() {
                Some(b'<') => (FileFormat::Svg, (svg::read(&text)?, true)),
                Some(b'{' | b'[') => (FileFormat::GeoJson, geojson::read(&text)?),
                _ => (FileFormat::Csv, csv::read(&text)?),
            }
        };
        if contours.is_empty() {
            return Err(OutlineError::format("the file", "it has no outline", remedy));
        }
        let file = Self { format, contours, y_runs_down };
        let count: usize = file.contours.iter().map(|contour| contour.points.len()).sum();
        if count > MOST_POINTS {
            let problem = format!("it has {count} points, more than {MOST_POINTS}");
            return Err(OutlineError::format("the file", problem, "Use fewer points"));
        }
        Ok(file)
    }

    /// Returns true if y runs downwards in this file, as in pictures: in SVG, ImageJ, GeoJSON of QuPath, and
    /// tables of rows and columns.
    #[must_use]
    pub fn y_runs_down(&self) -> bool {
        self.y_runs_down
    }

    /// Returns the outline of that choice.
    ///
    /// # Errors
    /// Returns [`OutlineError::Several`] for a file of several of which none is chosen, [`OutlineError::Missing`] for
    /// a choice that the file does not have. Both list the names.
    pub fn choose(&self, choice: &Choice) -> Result<&Contour, OutlineError> {
        let count = self.contours.len();
        let names = || {
            let named = self.contours.iter().filter_map(|contour| contour.name.as_deref());
            let mut names: Vec<String> = named.map(|name| format!("{:?}", crate::error::quoted(name))).collect();
            if names.len() > LISTED {
                names.truncate(LISTED);
                names.push("...".to_owned());
            }
            names.join(", ")
        };
        let missing = |wanted: String| OutlineError::Missing { wanted, count, names: names() };
        match choice {
            Choice::Only if count == 1 => Ok(&self.contours[0]),
            Choice::Only => {
                let names = names();
                let named = !names.is_empty() || self.format != FileFormat::Csv;
                Err(OutlineError::Several { count, names: if named { names } else { self.between_blank_lines() } })
            }
            Choice::Index(index) => self.contours.get(*index).ok_or_else(|| missing(format!("of the index {index}"))),
            Choice::Name(name) => {
                let mut found = self.contours.iter().filter(|contour| contour.name.as_ref() == Some(name));
                let first = found.next().ok_or_else(|| missing(format!("named {name:?}")))?;
                if found.next().is_some() {
                    let names = format!("two of them named {name:?}");
                    return Err(OutlineError::Several { count, names });
                }
                Ok(first)
            }
        }
    }
}

impl OutlineFile {
    /// Says how many points the outlines of a table have, for a table with a blank line by mistake.
    fn between_blank_lines(&self) -> String {
        let sizes = self.contours.iter().take(LISTED).map(|contour| contour.points.len().to_string());
        let dots = if self.contours.len() > LISTED { ", ..." } else { "" };
        let sizes = sizes.collect::<Vec<_>>().join(", ");
        format!("of {sizes}{dots} points: blank lines separate them, so remove blank lines inside an outline")
    }
}

/// Returns the bytes of a file of at most 256 MB.
///
/// # Errors
/// Returns [`OutlineError::Unreadable`] for a file that is not there, cannot be opened or is larger, and for a
/// directory or device.
#[inline(always)]
pub fn bytes_of(path: &Path) -> Result<Vec<u8>, OutlineError> {
    // So that pages in a browser do not carry readers that they cannot use.
    if cfg!(target_family = "wasm") {
        let problem = "there are no files in a browser. Give points instead".to_owned();
        return Err(OutlineError::Unreadable { path: path.to_owned(), problem });
    }
    read_bounded(path)
}

/// Returns the bytes of a file of bounded size.
fn read_bounded(path: &Path) -> Result<Vec<u8>, OutlineError> {
    let unreadable = |problem: String| OutlineError::Unreadable { path: path.to_owned(), problem };
    let about = fs::metadata(path).map_err(|error| match error.kind() {
        std::io::ErrorKind::NotFound => unreadable("there is no such file".to_owned()),
        _ => unreadable(error.to_string()),
    })?;
    if !about.is_file() {
        return Err(unreadable("this is not a file".to_owned()));
    }
    if about.len() > MOST_BYTES {
        return Err(unreadable(format!("it has {:.1e} bytes, more than {MOST_BYTES:.1e}", about.len() as f64)));
    }
    fs::read(path).map_err(|error| unreadable(error.to_string()))
}

#[cfg(test)]
mod tests;

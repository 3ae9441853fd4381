//! Outlines of shapes from files: tables of points (CSV), SVG paths, GeoJSON polygons and ImageJ regions of interest.
//!
//! Read a file with [`OutlineFile`], choose one of its [`Contour`]s, and make it an outline that runs
//! counter-clockwise without repeated points ([`closed`]). [`smooth`] takes the steps of pixels out of a traced
//! outline.
//!
//! ```
//! use outline_files::{Choice, OutlineFile, closed};
//!
//! let file = OutlineFile::from_bytes(b"x,y\n0,0\n0,2\n3,2\n3,0\n0,0\n")?;
//! let outline = closed(&file.choose(&Choice::Only)?.points)?;
//! // Clockwise in the file, and its last point repeats the first.
//! println!("{} points, area {}", outline.points.len(), outline.area); // 4 points, area 6
//! assert_eq!((outline.points.len(), outline.area, outline.was_clockwise), (4, 6.0, true));
//! # Ok::<(), outline_files::OutlineError>(())
//! ```
//!
//! Reading never panics and never guesses: what is not understood is refused with the place in the file and a remedy.

mod csv;
mod encoding;
mod error;
mod file;
mod geojson;
mod imagej;
mod smooth;
mod svg;
mod tidy;

pub use error::OutlineError;
pub use file::{Choice, Contour, FileFormat, OutlineFile, bytes_of};
pub use smooth::{Smoothed, smooth};
pub use tidy::{Outline, closed, line, touching};

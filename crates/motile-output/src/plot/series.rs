//! Series of points of plots.

use crate::Rgb;

/// Shape of the points of a series.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[non_exhaustive]
pub enum Marker {
    /// Disc.
    Disc,
    /// Empty circle.
    Circle,
    /// Square.
    Square,
    /// Triangle that points up.
    Triangle,
    /// Diamond.
    Diamond,
}

/// Series of points, with its style and its label in the legend.
#[derive(Debug, Clone, PartialEq)]
pub struct Series {
    pub(crate) label: String,
    pub(crate) points: Vec<(f64, f64)>,
    pub(crate) line: bool,
    pub(crate) dashed: bool,
    pub(crate) marker: Option<Marker>,
    pub(crate) colour: Option<Rgb>,
}

impl Series {
    /// Creates series drawn as a line through points `(x, y)`, interrupted where a point is not finite. A series with
    /// an empty label is not in the legend.
    #[must_use]
    pub fn line(label: &str, points: impl IntoIterator<Item = (f64, f64)>) -> Self {
        let points = points.into_iter().collect();
        Self { label: label.to_string(), points, line: true, dashed: false, marker: None, colour: None }
    }

    /// Creates series drawn as markers at points `(x, y)`, without a line.
    #[must_use]
    pub fn points(label: &str, points: impl IntoIterator<Item = (f64, f64)>) -> Self {
        Self { line: false, marker: Some(Marker::Disc), ..Self::line(label, points) }
    }

    /// Returns the series with a dashed line.
    #[must_use]
    pub fn dashed(self) -> Self {
        Self { dashed: true, ..self }
    }

    /// Returns the series with markers at its points.
    #[must_use]
    pub fn marker(self, marker: Marker) -> Self {
        Self { marker: Some(marker), ..self }
    }

    /// Returns the series in a given colour instead of the next of [`crate::plot::SERIES_COLOURS`].
    #[must_use]
    pub fn colour(self, colour: Rgb) -> Self {
        Self { colour: Some(colour), ..self }
    }
}

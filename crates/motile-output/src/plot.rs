//! Plots of series of points: contents and settings.

mod droplet;
mod paint;

use std::{fs, path::Path};

use paint::draw;

pub use crate::colour::SERIES_COLOURS;
pub use crate::drawing::axes::AxisScale;
pub use droplet::{concentration_plot, time_series};

use crate::{OutputError, Rgb};

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
    label: String,
    points: Vec<(f64, f64)>,
    line: bool,
    dashed: bool,
    marker: Option<Marker>,
    colour: Option<Rgb>,
}

impl Series {
    /// Series drawn as a line through points `(x, y)`, interrupted where a point is not finite. A series with an empty
    /// label is not in the legend.
    #[must_use]
    pub fn line(label: &str, points: impl IntoIterator<Item = (f64, f64)>) -> Self {
        let points = points.into_iter().collect();
        Self { label: label.to_string(), points, line: true, dashed: false, marker: None, colour: None }
    }

    /// Series drawn as markers at points `(x, y)`, without a line.
    #[must_use]
    pub fn points(label: &str, points: impl IntoIterator<Item = (f64, f64)>) -> Self {
        Self { line: false, marker: Some(Marker::Disc), ..Self::line(label, points) }
    }

    /// Series with a dashed line.
    #[must_use]
    pub fn dashed(self) -> Self {
        Self { dashed: true, ..self }
    }

    /// Series with markers at its points.
    #[must_use]
    pub fn marker(self, marker: Marker) -> Self {
        Self { marker: Some(marker), ..self }
    }

    /// Series in a given colour instead of the next of [`crate::plot::SERIES_COLOURS`].
    #[must_use]
    pub fn colour(self, colour: Rgb) -> Self {
        Self { colour: Some(colour), ..self }
    }
}

/// Plot: axes, series, reference lines.
///
/// ```
/// use motile_output::plot::{AxisScale, Figure, Marker, Plot, Series};
///
/// let errors = [(0.2, 2.4e-2), (0.1, 6.1e-3), (0.05, 1.5e-3)];
/// let plot = Plot::new("Error of the speed")
///     .x_axis("spacing h (R_{0})", AxisScale::Logarithmic)
///     .y_axis("relative error", AxisScale::Logarithmic)
///     .series(Series::line("ζΔμ = −2", errors).marker(Marker::Disc))
///     .series(Series::line("order 2", [(0.05, 1.5e-3), (0.2, 2.4e-2)]).dashed())
///     .horizontal(1e-2, "1 %");
/// let svg = Figure::new(1).panel(plot).svg()?;
/// assert!(svg.starts_with("<svg") && svg.contains("order 2"));
/// # Ok::<(), motile_output::OutputError>(())
/// ```
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Plot {
    title: String,
    labels: [String; 2],
    scales: [AxisScale; 2],
    x_range: Option<[f64; 2]>,
    equal_units: bool,
    series: Vec<Series>,
    references: Vec<(f64, String)>,
}

impl Plot {
    /// Empty plot with a title.
    #[must_use]
    pub fn new(title: &str) -> Self {
        Self { title: title.to_string(), ..Self::default() }
    }

    /// Sets label and scale of the horizontal axis.
    #[must_use]
    pub fn x_axis(mut self, label: &str, scale: AxisScale) -> Self {
        (self.labels[0], self.scales[0]) = (label.to_string(), scale);
        self
    }

    /// Sets label and scale of the vertical axis.
    #[must_use]
    pub fn y_axis(mut self, label: &str, scale: AxisScale) -> Self {
        (self.labels[1], self.scales[1]) = (label.to_string(), scale);
        self
    }

    /// Sets the ends of the horizontal axis, which otherwise follow from the data.
    #[must_use]
    pub fn x_range(self, low: f64, high: f64) -> Self {
        Self { x_range: Some([low, high]), ..self }
    }

    /// Makes a unit equally long on both axes, which must be linear: for shapes.
    #[must_use]
    pub fn equal_units(self) -> Self {
        Self { equal_units: true, ..self }
    }

    /// Adds a series.
    #[must_use]
    pub fn series(mut self, series: Series) -> Self {
        self.series.push(series);
        self
    }

    /// Adds a dashed horizontal line at a value, with a label.
    #[must_use]
    pub fn horizontal(mut self, value: f64, label: &str) -> Self {
        self.references.push((value, label.to_string()));
        self
    }
}

/// Figure of one or more plots, in rows and columns.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Figure {
    columns: usize,
    panels: Vec<Plot>,
    panel_size: [f64; 2],
}

impl Figure {
    /// Figure without plots so far, in rows of `columns` plots.
    #[must_use]
    pub fn new(columns: usize) -> Self {
        Self { columns: columns.max(1), panels: Vec::new(), panel_size: [540.0, 340.0] }
    }

    /// Adds a plot.
    #[must_use]
    pub fn panel(mut self, plot: Plot) -> Self {
        self.panels.push(plot);
        self
    }

    /// Sets width and height of each panel (pixels of the SVG), 540 x 340 by default.
    #[must_use]
    pub fn panel_size(mut self, width: f64, height: f64) -> Self {
        self.panel_size = [width, height];
        self
    }

    /// Text of an SVG file of the figure.
    ///
    /// # Errors
    /// [`OutputError::Empty`] without panels, [`OutputError::Size`] with panels too small or too large.
    pub fn svg(&self) -> Result<String, OutputError> {
        Ok(draw(self)?.svg())
    }

    /// Writes the figure as `<name>.svg` and, at twice the resolution, `<name>.png` into `directory`, which is created
    /// if needed.
    ///
    /// # Errors
    /// As [`Figure::svg`], and [`OutputError::Write`].
    pub fn write(&self, directory: impl AsRef<Path>, name: &str) -> Result<(), OutputError> {
        let directory = directory.as_ref();
        fs::create_dir_all(directory).map_err(OutputError::writing(directory))?;
        let drawing = draw(self)?;
        ["svg", "png"].iter().try_for_each(|kind| drawing.write(&directory.join(format!("{name}.{kind}")), 2.0))
    }
}

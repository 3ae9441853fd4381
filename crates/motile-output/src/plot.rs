//! Plots of series of points: what is in them.

pub(crate) mod droplet;
mod paint;

use std::{fs, path::Path};

use paint::draw;

use crate::{AxisScale, Error, Rgb};

/// The shape of the points of a series.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Marker {
    /// A disc.
    Disc,
    /// An empty circle.
    Circle,
    /// A square.
    Square,
    /// A triangle that points up.
    Triangle,
    /// A diamond.
    Diamond,
}

/// A series of points with its looks and the label by which the legend names it.
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
    /// A line through points `(x, y)`; a point that is not finite interrupts it. Without a label the legend leaves it
    /// out.
    #[must_use]
    pub fn line(label: &str, points: impl IntoIterator<Item = (f64, f64)>) -> Self {
        let points = points.into_iter().collect();
        Self { label: label.to_string(), points, line: true, dashed: false, marker: None, colour: None }
    }

    /// Points `(x, y)` with markers and no line.
    #[must_use]
    pub fn points(label: &str, points: impl IntoIterator<Item = (f64, f64)>) -> Self {
        Self { line: false, marker: Some(Marker::Disc), ..Self::line(label, points) }
    }

    /// The same with its line dashed.
    #[must_use]
    pub fn dashed(self) -> Self {
        Self { dashed: true, ..self }
    }

    /// The same with markers at its points.
    #[must_use]
    pub fn marker(self, marker: Marker) -> Self {
        Self { marker: Some(marker), ..self }
    }

    /// The same in a given colour instead of the next of [`crate::SERIES_COLOURS`].
    #[must_use]
    pub fn colour(self, colour: Rgb) -> Self {
        Self { colour: Some(colour), ..self }
    }
}

/// A plot: axes, series, reference lines.
///
/// ```
/// use motile_output::{AxisScale, Figure, Marker, Plot, Series};
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
/// # Ok::<(), motile_output::Error>(())
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
    /// An empty plot.
    #[must_use]
    pub fn new(title: &str) -> Self {
        Self { title: title.to_string(), ..Self::default() }
    }

    /// Label and scale of the horizontal axis.
    #[must_use]
    pub fn x_axis(mut self, label: &str, scale: AxisScale) -> Self {
        (self.labels[0], self.scales[0]) = (label.to_string(), scale);
        self
    }

    /// Label and scale of the vertical axis.
    #[must_use]
    pub fn y_axis(mut self, label: &str, scale: AxisScale) -> Self {
        (self.labels[1], self.scales[1]) = (label.to_string(), scale);
        self
    }

    /// Ends of the horizontal axis, which otherwise follow from the data.
    #[must_use]
    pub fn x_range(self, low: f64, high: f64) -> Self {
        Self { x_range: Some([low, high]), ..self }
    }

    /// A unit is as long on the vertical axis as on the horizontal one, as it should be for shapes (both axes linear).
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

    /// Adds a horizontal line at `value`.
    #[must_use]
    pub fn horizontal(mut self, value: f64, label: &str) -> Self {
        self.references.push((value, label.to_string()));
        self
    }
}

/// One or more plots side by side and below each other.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Figure {
    columns: usize,
    panels: Vec<Plot>,
    panel_size: [f64; 2],
}

impl Figure {
    /// A figure whose panels fill rows of `columns`.
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

    /// Width and height of each panel (pixels of the SVG); 540 x 340 if nothing is said.
    #[must_use]
    pub fn panel_size(mut self, width: f64, height: f64) -> Self {
        self.panel_size = [width, height];
        self
    }

    /// The figure as vectors: the text of an SVG file.
    ///
    /// # Errors
    /// [`Error::Empty`] without panels, [`Error::Size`] with panels too small or too large.
    pub fn svg(&self) -> Result<String, Error> {
        Ok(draw(self)?.svg())
    }

    /// Writes the figure as `<name>.svg` and, with two pixels a unit, `<name>.png` into `directory`, which is made if
    /// it is not there.
    ///
    /// # Errors
    /// As [`Figure::svg`], and [`Error::Write`].
    pub fn write(&self, directory: impl AsRef<Path>, name: &str) -> Result<(), Error> {
        let directory = directory.as_ref();
        fs::create_dir_all(directory).map_err(Error::writing(directory))?;
        let drawing = draw(self)?;
        ["svg", "png"].iter().try_for_each(|kind| drawing.write(&directory.join(format!("{name}.{kind}")), 2.0))
    }
}

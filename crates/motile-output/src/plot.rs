//! Plots of series of points: what is in them.

pub(crate) mod droplet;
mod paint;

use std::{fs, path::Path};

use anyhow::{Context, Result, ensure};

use crate::{AxisScale, Canvas, Rgb, Svg, plot::paint::Sheet};

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
    /// A cross.
    Cross,
}

/// A series of points with its looks and the label by which the legend names it.
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

    /// The line `y = y0 (x / x0)^exponent` from `x` = `from` to `to`, dashed and grey: an order of convergence to
    /// compare with.
    #[must_use]
    pub fn power_law(label: &str, exponent: f64, (x0, y0): (f64, f64), [from, to]: [f64; 2]) -> Self {
        let at = |t: f64| from * (to / from).powf(t);
        let points = (0..=40).map(|k| at(f64::from(k) / 40.0)).map(|x| (x, y0 * (x / x0).powf(exponent)));
        Self::line(label, points).dashed().colour(Rgb::GREY)
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

/// A line across a plot at a value of one of its axes.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Reference {
    pub(crate) value: f64,
    pub(crate) vertical: bool,
    pub(crate) label: String,
}

/// A plot: axes, series, reference lines.
///
/// ```
/// use motile_output::{AxisScale, Figure, Marker, Plot, Series};
///
/// # fn main() -> anyhow::Result<()> {
/// let errors = [(0.2, 2.4e-2), (0.1, 6.1e-3), (0.05, 1.5e-3)];
/// let plot = Plot::new("Error of the speed")
///     .x_axis("spacing h (R_{0})", AxisScale::Logarithmic)
///     .y_axis("relative error", AxisScale::Logarithmic)
///     .series(Series::line("ζΔμ = −2", errors).marker(Marker::Disc))
///     .series(Series::power_law("order 2", 2.0, (0.2, 3e-2), [0.05, 0.2]))
///     .horizontal(1e-2, "1 %");
/// let svg = Figure::new(1).panel(plot).svg()?.document();
/// assert!(svg.starts_with("<svg") && svg.contains("order 2"));
/// # Ok(())
/// # }
/// ```
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Plot {
    pub(crate) title: String,
    pub(crate) labels: [String; 2],
    pub(crate) scales: [AxisScale; 2],
    pub(crate) ranges: [Option<[f64; 2]>; 2],
    pub(crate) series: Vec<Series>,
    pub(crate) references: Vec<Reference>,
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
        self.labels[0] = label.to_string();
        self.scales[0] = scale;
        self
    }

    /// Label and scale of the vertical axis.
    #[must_use]
    pub fn y_axis(mut self, label: &str, scale: AxisScale) -> Self {
        self.labels[1] = label.to_string();
        self.scales[1] = scale;
        self
    }

    /// Ends of the horizontal axis, which otherwise follow from the data.
    #[must_use]
    pub fn x_range(mut self, low: f64, high: f64) -> Self {
        self.ranges[0] = Some([low, high]);
        self
    }

    /// Ends of the vertical axis, which otherwise follow from the data.
    #[must_use]
    pub fn y_range(mut self, low: f64, high: f64) -> Self {
        self.ranges[1] = Some([low, high]);
        self
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
        self.references.push(Reference { value, vertical: false, label: label.to_string() });
        self
    }

    /// Adds a vertical line at `value`.
    #[must_use]
    pub fn vertical(mut self, value: f64, label: &str) -> Self {
        self.references.push(Reference { value, vertical: true, label: label.to_string() });
        self
    }
}

/// One or more plots side by side and below each other.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Figure {
    pub(crate) columns: usize,
    pub(crate) panels: Vec<Plot>,
    pub(crate) panel_size: [f64; 2],
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

    /// The figure as vectors.
    ///
    /// # Errors
    /// No panels, or panels too small or too large.
    pub fn svg(&self) -> Result<Svg> {
        let sheet = Sheet::new(self, 1.0)?;
        let [width, height] = sheet.size();
        let mut svg = Svg::new(width, height);
        sheet.paint(&mut svg);
        Ok(svg)
    }

    /// The figure as pixels, two a pixel of the SVG in each direction.
    ///
    /// # Errors
    /// As [`Figure::svg`].
    pub fn canvas(&self) -> Result<Canvas> {
        let sheet = Sheet::new(self, 2.0)?;
        let [width, height] = sheet.size();
        let mut canvas = Canvas::new(width.round() as usize, height.round() as usize)?;
        sheet.paint(&mut canvas);
        Ok(canvas)
    }

    /// Writes the figure as `<name>.svg` and `<name>.png` into `directory`, which is made if it is not there.
    ///
    /// # Errors
    /// As [`Figure::svg`], and files that cannot be written.
    pub fn write(&self, directory: &Path, name: &str) -> Result<()> {
        ensure!(!name.is_empty(), "a figure without a name cannot be written");
        fs::create_dir_all(directory).with_context(|| format!("making {}", directory.display()))?;
        self.svg()?.write(&directory.join(format!("{name}.svg")))?;
        self.canvas()?.write_png(&directory.join(format!("{name}.png")))
    }
}

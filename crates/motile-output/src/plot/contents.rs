//! Contents of plots: axes, series, reference lines.

use crate::drawing::axes::AxisScale;
use crate::plot::series::Series;

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
    pub(crate) title: String,
    pub(crate) labels: [String; 2],
    pub(crate) scales: [AxisScale; 2],
    pub(crate) x_range: Option<[f64; 2]>,
    pub(crate) equal_units: bool,
    pub(crate) series: Vec<Series>,
    pub(crate) references: Vec<(f64, String)>,
}

impl Plot {
    /// Creates an empty plot with a title.
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

//! Plots of series of points.
//!
//! They are drawn here (382 lines) and not by `plotters` 0.3.7, because it adds 12 packages with its `ab_glyph` fonts,
//! or needs freetype and fontconfig, which WebAssembly lacks, and writes subscripts as `c_{0}` and decades as 1000.0.

mod contents;
mod droplet;
mod figure;
mod paint;
mod series;

pub use crate::colour::SERIES_COLOURS;
pub use crate::drawing::axes::AxisScale;
pub use contents::Plot;
pub use droplet::{concentration_plot, time_series};
pub use figure::Figure;
pub use series::{Marker, Series};

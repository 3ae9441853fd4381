//! Plots of series of points.

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

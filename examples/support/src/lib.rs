//! What the examples share: command line, progress bar, figures, animations, files.

mod animation;
mod axes;
mod canvas;
mod colour;
mod colour_bar;
mod font;
mod palette;
mod picture;
mod picture_paint;
mod plot;
mod plot_paint;
mod raster;
mod streamlines;
mod surface;
mod svg;
mod ticks;

pub use animation::Animation;
pub use axes::AxisScale;
pub use canvas::Canvas;
pub use colour::{ColourMap, ColourScale, Limits, Rgb, SERIES_COLOURS};
pub use picture::{Format, Picture};
pub use plot::{Figure, Marker, Plot, Series};
pub use raster::{Raster, ScalarSamples, VectorSamples};
pub use streamlines::streamlines;
pub use surface::{Anchor, Pen, Pixel, Rect, Surface, TextStyle};
pub use svg::Svg;

/// A point or vector in the plane.
pub type Vec2 = nalgebra::Vector2<f64>;

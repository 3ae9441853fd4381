//! Drawings of lines, areas, images and text, painted as pixels or written as vectors. Positions are in pixels from the
//! upper left corner.

pub(crate) mod axes;
mod canvas;
pub(crate) mod font;
pub(crate) mod raster;
mod shapes;
pub(crate) mod svg;
pub(crate) mod ticks;

pub(crate) use canvas::Drawing;
pub(crate) use shapes::{Anchor, Pen, Pixel, Rect, TextStyle};

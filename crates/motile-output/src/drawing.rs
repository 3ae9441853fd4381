//! What figures are drawn on, and what all of them have: lines, areas, text, axes.

pub(crate) mod axes;
pub(crate) mod canvas;
pub(crate) mod font;
pub(crate) mod surface;
pub(crate) mod svg;
pub(crate) mod ticks;

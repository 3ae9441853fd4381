//! Pictures of scenes.

pub(crate) mod contents;
mod look;
mod paint;
mod sides;
pub(crate) mod smooth;
mod solid_shape;

pub use look::{Look, Track};
pub use solid_shape::{SolidColour, SolidShape};

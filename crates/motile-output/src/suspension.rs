//! Tables, pictures and animations of many droplets.

mod picture;
mod plots;
mod tables;

pub use picture::{SuspensionAnimation, SuspensionColour, SuspensionPicture};
pub use plots::suspension_plots;
pub use tables::SuspensionCsv;

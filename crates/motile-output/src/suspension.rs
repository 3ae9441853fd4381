//! Tables, pictures and animations of many droplets.

mod crowd;
mod plots;
mod tables;

pub use crowd::{Crowd, CrowdColour, CrowdFilm};
pub use plots::suspension_plots;
pub use tables::SuspensionCsv;

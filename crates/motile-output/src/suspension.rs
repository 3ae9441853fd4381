//! Tables, pictures and animations of many droplets.

mod crowd;
mod tables;

pub use crowd::{Crowd, CrowdColour, CrowdFilm};
pub use tables::SuspensionCsv;

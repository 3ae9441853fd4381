//! Tables, files and pictures of droplets in three dimensions without symmetry.

pub(crate) mod files;
pub(crate) mod picture;
mod render;
pub(crate) mod snapshot;
pub(crate) mod table;

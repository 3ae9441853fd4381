//! Sampled fields and their streamlines.

pub(crate) mod raster;
pub(crate) mod streamlines;

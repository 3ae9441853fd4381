//! Scenes that are built from descriptions.

mod channel_flux;
#[cfg(feature = "toml")]
mod dimensions;
mod gel_in_layer;
mod living_walls;
mod revolution;
mod solid_gap;
#[cfg(feature = "toml")]
mod units;

//! Scenes that are built from descriptions.

mod body_forces;
mod channel_flux;
mod cortex;
#[cfg(feature = "toml")]
mod dimensions;
mod fibres;
mod friction_and_slip;
mod gel_in_layer;
mod held_bodies;
mod living_walls;
#[cfg(feature = "toml")]
mod outline_files;
mod revolution;
mod solid_gap;
#[cfg(feature = "toml")]
mod units;
mod vesicles;

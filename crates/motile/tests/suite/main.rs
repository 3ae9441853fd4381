//! Scenes that are built from descriptions.

mod body_forces;
mod channel_flux;
mod cortex;
#[cfg(feature = "toml")]
mod dimensions;
mod fibres;
#[cfg(feature = "toml")]
mod files_gone_wrong;
mod films_at_walls;
mod friction_and_slip;
mod gel_in_layer;
mod graded_friction;
mod held_bodies;
mod living_walls;
#[cfg(feature = "toml")]
mod noisy_swimmers;
#[cfg(feature = "toml")]
mod outline_files;
mod revolution;
mod solid_gap;
#[cfg(feature = "toml")]
mod surroundings;
#[cfg(feature = "toml")]
mod units;
mod vesicles;
mod viscous_shells;
mod wall_forces;

//! Particles inside a droplet that diffuse, are carried along and are exchanged with its interface.

mod cells;
mod diffusion;
mod in_droplet;
mod positivity;
mod projection;
mod transport;

pub use in_droplet::{InteriorObservables, ParticlesInDroplet};

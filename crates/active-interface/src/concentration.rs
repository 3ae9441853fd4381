//! Particles along a closed curve: where they start, how flow and diffusion carry them, how none is lost.

mod flux;
mod initial;
mod positivity;
mod transport;

pub use flux::Flux;
pub use initial::{InitialConcentration, SplitMix64};
pub use positivity::Repair;
pub(crate) use positivity::repair_positivity;
pub(crate) use transport::{Transport, cell_peclet};

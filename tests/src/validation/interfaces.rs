//! Scenes of interfaces alone, without a grid.

mod relaxation;
mod several;

pub use relaxation::{IntegralRelaxation, relax};
pub use several::{Several, passing, ten_in_a_box};

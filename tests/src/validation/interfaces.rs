//! Scenes of interfaces alone, without a grid.

mod channel;
mod growth;
mod heading;
mod relaxation;
mod several;

pub use channel::{ChannelErrors, steady_in_channel};
pub use growth::{growth_rate, growth_rate_limit};
pub use heading::{Turning, turning};
pub use relaxation::{IntegralRelaxation, relax};
pub use several::{Several, passing, ten_in_a_box};

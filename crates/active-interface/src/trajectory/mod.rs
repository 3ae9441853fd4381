//! What a droplet does across a channel: lateral amplitude, period, growth, and the regime they make.

mod classify;
mod extrema;
mod linear_mode;
mod quadrature;
mod recorder;
mod regime;
mod regression;
mod samples;
mod separable;
mod swings;
mod tendency;

pub use extrema::{Extremum, extrema};
pub use linear_mode::{LinearMode, fit_linear_mode};
pub use recorder::{TrajectoryRecord, TrajectoryRecorder};
pub use regime::{Doubt, Evidence, Regime, RegimeCriteria, RegimeReport};
pub use regression::Estimate;
pub use samples::Trajectory;

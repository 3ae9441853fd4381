//! Analysis of runs: the regime of one droplet, and order and correlations among many.
//!
//! * [`trajectory`]: a [`trajectory::TrajectoryRecorder`] records a droplet during a run.
//!   [`trajectory::Trajectory::regime`] then says whether the droplet rests, swims straight or oscillates laterally,
//!   and [`trajectory::Trajectory::linear_mode`] fits the growth rate and frequency of a small lateral motion.
//! * [`suspension`]: polar and nematic order, pair correlations, mean square displacements, number fluctuations and
//!   clusters of many droplets.
//!
//! Both work on plain lists of numbers, so you can use them on data of another code or of an experiment.
//!
//! # Example
//!
//! In this example, a droplet oscillates around the centre line of a channel with a period of 5 and a growth rate of
//! 0.02:
//!
//! ```
//! use motile_analysis::{AnalysisError, trajectory::Trajectory};
//!
//! let times: Vec<f64> = (0..400).map(|k| 0.1 * f64::from(k)).collect();
//! let omega = std::f64::consts::TAU / 5.0;
//! let heights = times.iter().map(|t| 0.01 * (0.02 * t).exp() * (omega * t).sin()).collect();
//! let speeds = vec![0.13; times.len()];
//!
//! let mode = Trajectory::new(times, heights, speeds)?.linear_mode()?;
//! println!("growth rate {:.4}", mode.growth_rate.value);
//! assert!((mode.growth_rate.value - 0.02).abs() < 1e-6);
//! # Ok::<(), AnalysisError>(())
//! ```

mod error;
pub mod suspension;
pub mod trajectory;

pub use error::AnalysisError;

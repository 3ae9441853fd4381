//! Steady swimmers, their stability and bifurcations.
mod error;
mod model;
mod modes;
mod newton;
mod parameter;
mod profile;
mod spectrum;
mod state;
mod system;

pub use error::SteadyError;
pub use parameter::Parameter;
pub use profile::Profile;
pub use spectrum::{Eigenmode, Spectrum, Symmetry};
pub use state::{Measured, SteadyState};

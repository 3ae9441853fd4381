//! Active droplets.

mod cyclic;
mod error;
mod excluded_volume;
mod face_value;
mod positivity;
mod tension;
mod transport;

pub use cyclic::{CirculantTridiagonal, CyclicTridiagonal};
pub use error::InterfaceError;
pub use excluded_volume::{ExcludedVolume, NoExcludedVolume, QuadraticExcludedVolume, StepExcludedVolume};
pub use face_value::{Flux, weno5};
pub use positivity::{Repair, repair_positivity};
pub use tension::{ConstantTension, ContractileTension, Tension, TensionWarning};
pub use transport::{Transport, cell_peclet};

//! Active droplets.

mod cyclic;
mod error;
mod excluded_volume;
mod tension;

pub use cyclic::{CirculantTridiagonal, CyclicTridiagonal};
pub use error::InterfaceError;
pub use excluded_volume::{ExcludedVolume, NoExcludedVolume, QuadraticExcludedVolume, StepExcludedVolume};
pub use tension::{ConstantTension, ContractileTension, Tension, TensionWarning};

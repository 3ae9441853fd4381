//! The immersed boundary method.

mod body;
mod error;
mod hydrodynamics;
mod markers;

pub use body::{Body, StepLimit};
pub use error::{BodyError, FlowError, SceneError};
pub use hydrodynamics::{Domain, FlowReport, FlowSample, FlowWork, Hydrodynamics, Medium};
pub use markers::{MarkerGroup, MarkerKind, Markers, Vec2};

//! The immersed boundary method.

mod body;
mod correction;
mod error;
mod hydrodynamics;
mod immersed_boundary;
mod integrator;
mod kernel;
mod markers;
mod mobility;
mod quadrature;
mod run;
mod sampling;
mod scene;
mod system;
mod transfer;
mod wall_gap;

pub use body::{Body, StepLimit};
pub use error::{BodyError, FlowError, SceneError};
pub use hydrodynamics::{Domain, FlowReport, FlowSample, FlowWork, Hydrodynamics, Medium};
pub use immersed_boundary::ImmersedBoundary;
pub use integrator::{Integrator, Midpoint};
pub use kernel::{AnyKernel, CompositeBSpline, CubicQuadratic, Gaussian6, Kernel, MAX_SUPPORT, Peskin4, Role, Roma3};
pub use markers::{MarkerGroup, MarkerKind, Markers, Vec2};
pub use mobility::{Deficit, MobilityDeficit};
pub use run::{Every, Observer, Run, StepSize};
pub use scene::{Handle, Scene};
pub use system::System;
pub use transfer::Transfer;
pub use wall_gap::wall_gap;

//! What most programs need: all that descriptions are written with, and what looks at the scenes that are built.

pub use crate::SetupError;
pub use crate::setup::{
    AnyFlow, Axis, Built, DropletSetup, DropletShape, ExchangeSetup, Exclusion, GelSetup, Grading, GridMethod, Hold,
    IntegralMethod, LayersMethod, Material, MeshKind, Method, Particles, RigidBodySetup, Setup, ShellSetup,
    SolidOutline, SolidSetup, Squeezed, Start, WallSetup,
};
pub use active_interface::{ActiveDroplet, Curve, Flux};
pub use elastic_solids::{BendingMeasure, ChannelShape, RigidBody, Shell, Solid};
pub use ib_core::AnyKernel;
pub use motile_base::{Drive, Region, Vec2};
pub use motile_scene::{
    Every, Handle, Hydrodynamics, Scene, SceneError, StepSize, System, checkpoint::Checkpoint,
    integrator::IntegratorKind,
};

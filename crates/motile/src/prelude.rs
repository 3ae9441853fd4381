//! What most programs need: all that descriptions are written with, and what looks at the scenes that are built.

pub use crate::{
    AnyFlow, Axis, Built, ChannelShape, Contrast, DropletSetup, DropletShape, ExchangeSetup, Exclusion, GelSetup,
    Grading, GridMethod, Hold, IntegralMethod, MarkerMotion, Material, MeshKind, Method, Particles, Region,
    RepulsionSetup, RigidBodySetup, RigidSetup, Setup, SetupError, ShellSetup, SolidOutline, SolidSetup, Squeezed,
    Start, Surface,
};
pub use active_interface::{ActiveDroplet, Curve, Flux};
pub use elastic_solids::{BendingMeasure, RigidBody, Shell, Solid};
pub use ib_core::{AnyKernel, Checkpoint, Every, Handle, Hydrodynamics, Scene, SceneError, StepSize, System, Vec2};
pub use stokes_grid::Drive;

//! Names that most programs need: a description, its methods, the scene that it builds. All others are in
//! [`crate::setup`] and in the crates of the parts.

pub use crate::SetupError;
pub use crate::setup::{
    AnyFlow, Built, DropletSetup, FieldEntry, FieldsSetup, FlowSetup, GradientSetup, GridMethod, GridSolver,
    HarmonicsMethod, IntegralMethod, LayersMethod, Method, NoiseSetup, Particles, Setup,
};
pub use motile_base::{Drive, Region, Vec2};
pub use motile_scene::{Every, Handle, Observer, Scene, SceneError, StepSize, System, Warnings};

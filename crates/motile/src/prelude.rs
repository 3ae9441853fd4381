//! What most programs need.

pub use crate::{
    Built, ChannelShape, DropletSetup, DropletShape, GridMethod, Hold, IntegralMethod, Material, Method, Particles,
    Region, Setup, SolidOutline, SolidSetup, Start,
};
pub use active_interface::{ActiveDroplet, Curve};
pub use elastic_solids::Solid;
pub use ib_core::{Every, Hydrodynamics, Scene, StepSize, Vec2};
pub use stokes_grid::Drive;

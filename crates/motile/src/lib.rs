//! Active droplets swimming in two-dimensional Stokes flow.
//!
//! A droplet is a closed fluid interface that carries active particles. The particles raise its tension; differences of
//! tension drive flow along the interface; the flow gathers the particles. Above a threshold of activity the droplet
//! polarises and swims. motile computes this alone, in periodic boxes and in channels with rigid walls, by the immersed
//! boundary method on a staggered grid with a correction that makes velocities on interfaces second-order accurate, or
//! without a grid by boundary integrals.
//!
//! ```
//! use motile::prelude::*;
//!
//! // viscosity 100, activity -2, a 6 x 6 box; R0 is the unit of length
//! let swimmer = Swimmer { nodes: 48, concentration_cells: 192, ..Swimmer::default() };
//! let (mut scene, droplet) = swimmer.build()?;
//! scene.run(20.0).go()?;
//!
//! let seen = scene.observe(droplet)?;
//! println!("speed {:.3} R0 per time, aspect ratio {:.3}", seen.speed(), seen.aspect_ratio_moments);
//! assert!((seen.speed() - 0.130).abs() < 0.002);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! # Crates
//!
//! | crate | what it is |
//! |---|---|
//! | [`stokes_grid`] | Stokes solvers on staggered grids: periodic boxes, channels with no-slip walls |
//! | [`ib_core`] | the immersed boundary method: kernels, transfer, bodies, scenes, integrators, observers |
//! | [`boundary_integral`] | flow of interfaces alone, without a grid, any viscosity ratio |
//! | [`active_interface`] | the droplet: curve, particles, tension, observables, linear theory, SI units |
//! | [`elastic_solids`] | elastic materials and meshes |
//!
//! Each can be used by itself; this crate re-exports them and adds [`Swimmer`], which sets up a droplet in a box or a
//! channel from a few numbers, with the method of the thesis this work rests on as the preset [`Swimmer::thesis`].
//!
//! # Units
//!
//! The library is free of units: give all quantities in one consistent system. Presets and examples use R0 = 10 um for
//! length and gamma0/10 for tension; [`active_interface::Units`] converts to SI.

mod elastic_channel;
mod method;
mod recommend;
pub mod setup;
mod setup_error;
mod solid_gap;
mod swimmer;
mod swimmer_scenes;

pub use elastic_channel::{BuiltElastic, ElasticChannel, WallMaterial, WallMesh, WallSurface};
pub use method::{ContrastMethod, Method};
pub use recommend::{SceneKind, recommend};
pub use setup_error::SetupError;
pub use solid_gap::{SolidEntered, SolidGap};
pub use swimmer::{InitialState, Swimmer};
pub use swimmer_scenes::{AnyFlow, Built, IntegralBox, IntegralChannel, IntegralPlane, PeriodicBox, RigidChannel};
pub use {active_interface, boundary_integral, elastic_solids, ib_core, stokes_grid};

/// What most programs need.
pub mod prelude {
    pub use crate::{ElasticChannel, InitialState, Method, Swimmer, WallMaterial, WallMesh};
    pub use active_interface::{ActiveDroplet, Convention, Curve, Flux, Motion, observe};
    pub use ib_core::{AnyKernel, Every, Hydrodynamics, ImmersedBoundary, Scene, StepSize, Vec2};
    pub use stokes_grid::{ChannelStokes, Drive, Grid, PeriodicStokes, StokesSolver};
}

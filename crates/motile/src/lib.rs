//! Active droplets swimming in two-dimensional Stokes flow.
//!
//! Use motile to simulate swimming cells as active droplets. A droplet is a closed fluid interface that carries active
//! particles. The particles raise its tension, differences of tension drive flow along the interface, and the flow
//! gathers the particles. If the activity is stronger than a threshold, the droplet polarises and swims. motile
//! computes this in unbounded fluid, in periodic boxes, in channels with rigid walls and between elastic solids, by
//! boundary integrals or by the immersed boundary method on a staggered grid with a correction that makes velocities on
//! interfaces second-order accurate. The model comes from Natasha Cowley, "Effects of mechanical properties of the
//! environment on cell migration", PhD thesis, University of Sheffield.
//!
//! You describe a scene with a [`Setup`](setup::Setup), build it, run it, and measure its bodies:
//!
//! ```
//! use motile::prelude::*;
//!
//! // activity -2 in a 6 x 6 box of viscosity 100; R0 is the unit of length
//! let setup = Setup {
//!     method: Method::Integral(IntegralMethod { nodes: 48, elements: 192 }),
//!     droplets: vec![DropletSetup::active(-2.0)],
//!     ..Setup::default()
//! };
//! let Built { mut scene, droplets, .. } = setup.build()?;
//! scene.run(20.0).go()?;
//! let seen = scene.observe(droplets[0])?;
//! println!("speed {:.3} R0 per time, aspect ratio {:.3}", seen.speed(), seen.aspect_ratio_moments);
//! assert!((seen.speed() - 0.130).abs() < 0.002);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! Droplets in regions of revolution and in three dimensions are described in the same way, see
//! [`Region`](base::Region). To record data during a run, attach an [`Observer`](scene::Observer). Attach
//! [`Warnings`](scene::Warnings) too: they say what is not resolved.
//!
//! # Crates
//!
//! | module | crate | what it is |
//! |---|---|---|
//! | [`stokes_grid`] | `stokes-grid` | Stokes solvers on staggered grids, for periodic boxes and channels |
//! | [`ib_core`] | `ib-core` | the immersed boundary method: kernels, spreading, interpolation, mobility correction |
//! | [`active_interface`] | `active-interface` | the droplet: curve, particles, tension, observables, SI units |
//! | [`elastic_solids`] | `elastic-solids` | elastic solids, their materials and meshes; shells and rigid bodies |
//! | [`boundary_integrals`] | `motile-boundary-integrals` | flows of scenes by boundary integrals |
//! | [`interior`] | `motile-interior` | bodies inside droplets: an active polar gel, diffusing particles |
//! | [`space_droplets`] | `space-droplets` | droplets in three dimensions without symmetry |
//! | [`scene`] | `motile-scene` | bodies and scenes, the trait of flows, gaps, integrators, runs, checkpoints |
//! | [`analysis`] | `motile-analysis` | trajectories and regimes of a droplet, order and correlations of many |
//! | [`outline_files`] | `outline-files` | outlines of shapes from files |
//! | [`base`] | `motile-base` | vectors, regions, Fourier transforms, checks of input |
//!
//! You can use each crate by itself. This crate re-exports them and adds the description of scenes. Steady states and
//! branches are in `motile-steady-states`, files and pictures in `motile-output`.
//!
//! # Units
//!
//! The library is free of units, so use one consistent system for all quantities. Defaults and examples use R0 = 10 um
//! for length and gamma0/10 for tension; [`active_interface::Units`] converts to SI.
//!
//! # Features
//!
//! - `toml`: descriptions are read from and written to TOML.
//! - `rayon`: several threads for large grids and many markers, with bitwise identical results.
//! - `without-symmetry` (on by default): scenes of droplets in three dimensions without symmetry. A program for
//!   browsers is smaller without it, and refuses such scenes.

pub mod prelude;
mod recommend;
pub mod setup;
mod setup_error;

pub use motile_scene::VERSION;
pub use recommend::{Recommendation, SceneKind, cheapest, recommend};
pub use setup_error::SetupError;
pub use {
    active_interface, elastic_solids, ib_core, motile_analysis as analysis, motile_base as base,
    motile_boundary_integrals as boundary_integrals, motile_interior as interior, motile_scene as scene, outline_files,
    space_droplets, stokes_grid,
};

//! Fields inside droplets.
//!
//! * [`DiscMesh`]: a triangular mesh of the inside of a closed curve that follows its markers.
//! * [`gel`]: an active polar gel that fills a droplet ([`GelInDroplet`]) or a box ([`GelInBox`]).
//! * [`particles`]: particles inside a droplet that are exchanged with its interface ([`ParticlesInDroplet`]).
//!
//! A gel is a body of its own beside the droplet that it fills. A contractile one whose director is free at the
//! interface of a droplet of constant tension, to which nothing else happens:
//!
//! ```
//! use active_interface::{ActiveDroplet, Curve};
//! use ib_core::{AnyKernel, ImmersedBoundary, Scene};
//! use interior_fields::{Anchoring, DirectorStart, GelInDroplet, GelMaterial};
//! use stokes_grid::{Grid, PeriodicStokes};
//!
//! let solver = PeriodicStokes::new(Grid::periodic(32, 32, 0.1875)?, 100.0)?;
//! let mut scene = Scene::new(ImmersedBoundary::new(solver, AnyKernel::BSpline4));
//! let droplet = ActiveDroplet::passive(&Curve::circle(1.0)?.markers(64)?, 100.0)?;
//! let host = scene.add(droplet.clone());
//! let material = GelMaterial { frank: 10.0, rotational_viscosity: 100.0, alignment: -0.5, activity: -50.0 };
//! let start = DirectorStart::Uniform { angle: 0.0, noise: 0.1, seed: 1 };
//! let gel = scene.add(GelInDroplet::new(&droplet, host, material, Anchoring::Free, &start, 0.2)?);
//! scene.run(0.5).go()?;
//! let seen = scene.observe(gel)?;
//! println!("energy {:.3}, {} defects", seen.director_energy, seen.defects.len());
//! assert!(seen.polarisation[0] > 0.99 && seen.defects.is_empty());
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! Equations of Cowley are those of Natasha Cowley, "Effects of mechanical properties of the environment on cell
//! migration", PhD thesis, University of Sheffield.

mod error;
mod filling;
pub mod gel;
mod mesh;
pub mod particles;

pub use error::InteriorError;
pub use gel::{Anchoring, Defect, DirectorStart, GelInBox, GelInDroplet, GelMaterial, GelObservables};
pub use mesh::DiscMesh;
pub use particles::{InteriorObservables, ParticlesInDroplet};

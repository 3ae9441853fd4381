//! Stokes flow of fluid interfaces by boundary integrals, without a grid.
//!
//! In a scene of droplets all forces act on curves, and in Stokes flow the velocities on these curves follow from the
//! forces alone. [`BoundaryIntegral`] computes them to spectral accuracy in the plane, a periodic box or a channel
//! ([`motile_base::Region`]), between rigid walls and obstacles of any shape ([`RigidWall`]), for any viscosity inside
//! and outside. It implements [`motile_scene::Hydrodynamics`], so that bodies are the same with any method. Velocity,
//! velocity gradient and pressure are available at any point, at any distance from an interface.
//! [`stokes_boundary_integrals`] has the equations.
//!
//! # Example
//!
//! An ellipse of fluid ten times as viscous as the exterior fluid, with a surface tension of 1, relaxes to a circle:
//! its tip moves inward.
//!
//! ```
//! use motile_boundary_integrals::{BoundaryIntegral, PeriodicCalculus, Settings, TensionPlacement};
//! use motile_base::{Region, Vec2};
//! use motile_scene::{Hydrodynamics, MarkerKind, Markers};
//!
//! # fn main() -> Result<(), Box<dyn std::error::Error>> {
//! let count = 128;
//! let mut markers = Markers::new();
//! markers.push_group(count, MarkerKind::UnevenInterface { viscosity_inside: Some(10.0) });
//! for (k, position) in markers.positions_mut().iter_mut().enumerate() {
//!     let t = std::f64::consts::TAU * k as f64 / count as f64;
//!     *position = Vec2::new(1.3 * t.cos(), t.sin() / 1.3);
//! }
//! let mut calculus = PeriodicCalculus::new(count)?;
//! let tension = vec![1.0; count];
//! let [positions, forces, _] = markers.lists_mut();
//! calculus.tension_forces(positions, &tension, TensionPlacement::Points, forces)?;
//!
//! let mut flow = BoundaryIntegral::new(Region::Plane, 1.0, Settings::default())?;
//! let report = flow.velocities(&mut markers)?;
//! assert!((markers.velocities()[0].x + 0.029_016_190).abs() < 1e-8);
//! assert!(report.iterations < 10);
//! # Ok(())
//! # }
//! ```
//!
//! The cost of an evaluation grows with the square of the number of nodes of an interface and of its close neighbours;
//! each pair of interfaces farther apart costs some microseconds. From some hundred nodes on, thousands where
//! viscosities differ or in the plane, it grows like their number, so that the method suits thousands of droplets;
//! beside curved walls it suits some tens. Feature `rayon`: several threads for many nodes, to the same bits.
//!
//! Equations, sections and figures of Cowley are those of Natasha Cowley, "Effects of mechanical properties of the
//! environment on cell migration", PhD thesis, University of Sheffield.

mod axisymmetric;
mod error;
mod flow;
mod immersed_layers;
mod interface_groups;
mod wall;

pub use axisymmetric::AxisymmetricIntegral;
pub use flow::BoundaryIntegral;
pub use immersed_layers::ImmersedLayers;
pub use stokes_boundary_integrals::{LayerError, PeriodicCalculus, Settings, TensionPlacement};
pub use wall::RigidWall;

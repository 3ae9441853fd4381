//! Computes the Stokes flow of a scene by boundary integrals: droplets, rigid bodies and rigid walls, without a grid.
//!
//! Use this crate if a scene has interfaces, and neither elastic solids nor gels. All forces then act on curves, and
//! the velocities on these curves follow from the forces alone, to spectral accuracy. [`BoundaryIntegral`] is a flow
//! for scenes: it implements [`motile_scene::Hydrodynamics`], so the same bodies run with any method. It covers the
//! plane, periodic boxes and channels ([`motile_base::Region`]), rigid walls and obstacles of any shape
//! ([`RigidWall`]), and any viscosity inside and outside. You can ask for velocity, velocity gradient and pressure at
//! any point, however close to an interface.
//!
//! If a scene also has elastic solids, use [`ImmersedLayers`], which combines boundary integrals with a grid. For the
//! equations, see [`stokes_boundary_integrals`].
//!
//! # Example
//!
//! An ellipse of fluid is ten times as viscous as the exterior fluid, and has a surface tension of 1. It relaxes to a
//! circle, so its tip moves inward:
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
//! # Cost
//!
//! The cost of an evaluation grows with the square of the number of nodes of an interface and its close neighbours.
//! Each pair of interfaces that are farther apart costs a few microseconds. Above a few hundred nodes (a few thousand
//! if viscosities differ, or in the plane) fast sums take over, whose cost grows like the number of nodes. So you can
//! compute thousands of droplets, and tens next to curved walls. With the feature `rayon` several threads work, and
//! results are bitwise identical.
//!
//! Equations, sections and figures of Cowley refer to Natasha Cowley, "Effects of mechanical properties of the
//! environment on cell migration", PhD thesis, University of Sheffield.

mod axisymmetric;
mod error;
mod flow;
mod immersed_layers;
mod interface_groups;
mod point_forces;
mod wall;

pub use axisymmetric::AxisymmetricIntegral;
pub use flow::BoundaryIntegral;
pub use immersed_layers::ImmersedLayers;
pub use stokes_boundary_integrals::{LayerError, PeriodicCalculus, Settings, TensionPlacement};
pub use wall::RigidWall;

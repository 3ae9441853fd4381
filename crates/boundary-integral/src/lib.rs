//! Stokes flow of fluid interfaces by boundary integrals, without a grid.
//!
//! In two-dimensional Stokes flow a scene of droplets has all its forces on curves, so the flow needs to be known on
//! these curves alone. [`BoundaryIntegral`] computes it to spectral accuracy in the plane, a periodic box or a channel
//! ([`Geometry`]), between rigid walls and obstacles of any shape ([`RigidWall`]), for any viscosity inside and
//! outside, and implements [`ib_core::Hydrodynamics`], so that a body does not notice which method moves it. Flow,
//! gradient and pressure are available at any point, at any distance from an interface. The mathematics is in
//! [`stokes_layers`].
//!
//! # Example
//!
//! An ellipse of fluid ten times as viscous as the exterior fluid, with a surface tension of 1, relaxes to a circle:
//! its tip moves inward.
//!
//! ```
//! use boundary_integral::{BoundaryIntegral, PeriodicCalculus, Geometry, Settings, TensionPlacement};
//! use ib_core::{Hydrodynamics, MarkerKind, Markers, Vec2};
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
//! let mut flow = BoundaryIntegral::new(Geometry::Plane, 1.0, Settings::default())?;
//! let report = flow.velocities(&mut markers)?;
//! assert!((markers.velocities()[0].x + 0.029_016_190).abs() < 1e-8);
//! assert!(report.iterations < 10);
//! # Ok(())
//! # }
//! ```
//!
//! The cost of an evaluation grows with the square of the number of nodes of an interface and of its close neighbours,
//! and for pairs farther apart by some microseconds each; it suits some tens of droplets.
//!
//! Equations, sections and figures of Cowley are those of Natasha Cowley, "Effects of mechanical properties of the
//! environment on cell migration", PhD thesis, University of Sheffield.

mod flow;
mod wall;

pub use flow::BoundaryIntegral;
pub use stokes_layers::{Forcing, Geometry, LayerError, PeriodicCalculus, Settings, TensionPlacement};
pub use wall::RigidWall;

/// The forcing of a channel as the solvers on grids have it.
#[must_use]
pub fn forcing(drive: stokes_grid::Drive) -> Forcing {
    use stokes_grid::Drive;
    match drive {
        Drive::ZeroGradient => Forcing::Gradient(0.0),
        Drive::Gradient(gradient) => Forcing::Gradient(gradient),
        Drive::ZeroFlux => Forcing::Flux(0.0),
        Drive::Flux(flux) => Forcing::Flux(flux),
    }
}

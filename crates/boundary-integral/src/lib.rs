//! Stokes flow of fluid interfaces by boundary integrals, without a grid.
//!
//! In two-dimensional Stokes flow a scene of droplets has all its forces on curves, so the flow needs to be known on
//! these curves alone. [`BoundaryIntegral`] computes it to spectral accuracy in [`FreeSpace`], a [`PeriodicBox`] or a
//! [`Channel`], for any viscosity inside and outside, and implements [`ib_core::Hydrodynamics`], so that a body does
//! not notice which method moves it. Flow, gradient and pressure are available at any point, at any distance from an
//! interface.
//!
//! # Example
//!
//! An ellipse of fluid ten times as viscous as its surroundings, with a surface tension of 1, relaxes to a circle: its
//! tip moves inward.
//!
//! ```
//! use boundary_integral::{BoundaryIntegral, FreeSpace, PeriodicCalculus, Settings, TensionPlacement};
//! use ib_core::{Hydrodynamics, MarkerKind, Markers, Vec2};
//!
//! # fn main() -> Result<(), Box<dyn std::error::Error>> {
//! let count = 128;
//! let mut markers = Markers::new();
//! markers.push_group(count, MarkerKind::UnevenInterface { viscosity_inside: Some(10.0) });
//! for (k, position) in markers.positions.iter_mut().enumerate() {
//!     let t = std::f64::consts::TAU * k as f64 / count as f64;
//!     *position = Vec2::new(1.3 * t.cos(), t.sin() / 1.3);
//! }
//! let mut calculus = PeriodicCalculus::new(count)?;
//! let tension = vec![1.0; count];
//! calculus.tension_forces(&markers.positions, &tension, TensionPlacement::Markers, &mut markers.forces)?;
//!
//! let mut flow = BoundaryIntegral::new(FreeSpace, 1.0, Settings::default())?;
//! let report = flow.velocities(&mut markers)?;
//! assert!((markers.velocities[0].x + 0.029_016_190).abs() < 1e-8);
//! assert!(report.iterations < 10);
//! # Ok(())
//! # }
//! ```
//!
//! # Method
//!
//! * Curves are truncated Fourier series on equally spaced values of their parameter ([`PeriodicCalculus`],
//!   [`BandLimit`]).
//! * The logarithm of the single layer is integrated by the weights of Kress (Linear Integral Equations, 2014, section
//!   12.3), the rest by the trapezoidal rule.
//! * Interfaces that are close are summed node by node in free space, or with a row of images in closed form in a
//!   channel. What is left is smooth, the images of a box and interfaces farther away: its Taylor series, found from
//!   values on a circle, is summed by moments. Walls are a Fourier series along the channel, analytic across it.
//! * A viscosity contrast needs the double layer and GMRES; its iterations depend neither on the nodes nor, beyond a
//!   ratio of about ten, on the ratio.
//! * Points and nodes close to an interface use the preimage of the point under the complex parametrisation.
//!
//! The cost of an evaluation grows with the square of the number of nodes of an interface and of its close neighbours,
//! and for pairs farther apart by some microseconds each; it suits some tens of droplets.

mod box_flow;
mod calculus;
mod channel_flow;
mod close;
mod contrast;
mod domain;
mod error;
mod expansion;
mod far;
mod field;
mod gmres;
mod images;
mod interface;
mod lattice_kernel;
mod layers;
mod logarithm;
mod near;
mod pair_kernel;
mod pair_sums;
mod planes;
mod recycled;
mod sampler;
mod series;
mod settings;
mod solver;
mod stress;
mod surroundings;
mod transform;
mod wall_flow;
mod wall_points;
mod walls;

pub use calculus::{BandLimit, PeriodicCalculus, Resample, TensionPlacement};
pub use domain::{Channel, FluidDomain, FreeSpace, PeriodicBox};
pub use error::BoundaryIntegralError;
pub use settings::Settings;
pub use solver::BoundaryIntegral;
pub use stokes_grid::Drive;

//! Layer potentials of two-dimensional Stokes flow: spectrally accurate, at any distance from the curves, in the plane,
//! in periodic boxes and in channels.
//!
//! # Example
//!
//! An ellipse of fluid ten times as viscous as the fluid around it, with a surface tension of 1, relaxes to a circle.
//! The velocity of its tip, and the flow at its centre and close to it:
//!
//! ```
//! use stokes_layers::{FlowSample, Interface, InterfaceFlow, PeriodicCalculus, Geometry, Settings};
//! use stokes_layers::{TensionPlacement, Vec2};
//!
//! # fn main() -> Result<(), stokes_layers::LayerError> {
//! let count = 128;
//! let angle = |k: usize| std::f64::consts::TAU * k as f64 / count as f64;
//! let positions: Vec<Vec2> = (0..count).map(|k| Vec2::new(1.3 * angle(k).cos(), angle(k).sin() / 1.3)).collect();
//! let mut forces = vec![Vec2::ZERO; count];
//! PeriodicCalculus::new(count)?.tension_forces(&positions, &[1.0; 128], TensionPlacement::Points, &mut forces)?;
//!
//! let mut flow = InterfaceFlow::new(Geometry::Plane, 1.0, Settings::default())?;
//! flow.load([Interface::closed(&positions, &forces, [10.0, 1.0])].into_iter())?;
//! let solution = flow.solve()?;
//! let mut velocities = vec![Vec2::ZERO; count];
//! flow.velocities(0, &mut velocities)?;
//! println!("tip velocity {:.9} after {} iterations", velocities[0].x, solution.iterations);
//! assert!((velocities[0].x + 0.029_016_190).abs() < 1e-8);
//!
//! let mut samples = [FlowSample::default(); 2];
//! flow.sample(&[Vec2::ZERO, Vec2::new(1.3 + 1e-6, 0.0)], &mut samples)?;
//! assert!(samples[0].velocity.length() < 1e-12 && samples[0].pressure > samples[1].pressure);
//! assert!((samples[1].velocity - velocities[0]).length() < 1e-6);
//! # Ok(())
//! # }
//! ```
//!
//! # Method
//!
//! With the Green's function G of a region and its stress T, `lap G - grad p = -4 pi delta`, forces F per length on
//! curves and velocities v on them have the flows
//!
//! ```text
//! single layer  1/(4 pi eta) INT G(x, y) F(y) ds(y)        double layer  1/(4 pi) INT v(y) T(x, y) n(y) ds(y)
//! ```
//!
//! and with fluid of another viscosity inside the two together give an integral equation for v ([`InterfaceFlow`]).
//!
//! * Curves are truncated Fourier series on equally spaced values of their parameter, plus a straight line for those
//!   that are open and go on periodically along x. These have the Green's function of a row of images, all else is the
//!   same.
//! * The logarithm of the single layer is integrated by the weights of Kress (Linear Integral Equations, 2014, section
//!   12.3), the rest by the trapezoidal rule.
//! * Curves that are close are summed node by node, in the plane or with a row of images in closed form in a channel.
//!   What is left is smooth, the images of a box and curves farther away: its Taylor series, found from values on a
//!   circle, is summed by moments. Walls are a Fourier series along the channel, analytic across it.
//! * A viscosity contrast needs the double layer and GMRES ([`gmres`]); its iterations depend neither on the nodes nor,
//!   beyond a ratio of about ten, on the ratio.
//! * Points and nodes close to a curve use the preimage of the point under the complex parametrisation.
//!
//! [`SingleLayer`] is the operator alone, for forces that follow from the velocities. Where the single layer comes from
//! elsewhere, such as a grid, [`dense`] has the double layer as a matrix. The cost of
//! a solution grows with the square of the number of nodes of a curve and of its close neighbours, and for pairs
//! farther apart by some microseconds each; it suits some tens of curves.

mod close;
mod curve;
pub mod dense;
mod error;
mod geometry;
pub mod gmres;
mod greens;
mod interface_flow;
mod layer;
mod multipole;
mod settings;
mod single_layer;

pub use curve::{PeriodicCalculus, TensionPlacement};
pub use error::LayerError;
pub use geometry::{Forcing, Geometry};
/// A position, force or velocity.
pub use glam::DVec2 as Vec2;
pub use input_checks::InputError;
pub use interface_flow::{FlowSample, Inside, Interface, InterfaceFlow, RigidMotion, Solution, WarmStart};
pub use settings::Settings;
pub use single_layer::{LayerCurve, Reciprocity, SingleLayer};

//! Computes Stokes flow in two dimensions from forces on curves, by boundary integrals and without a grid.
//!
//! Use this crate if forces act on closed or periodic curves, such as the interfaces of drops, and you want velocities
//! with many correct digits. You give each curve as points with the forces on them. [`InterfaceFlow`] returns the
//! velocity on the curves, and the velocity, its gradient and the pressure at any other point, however close to a
//! curve. The fluid fills the plane, a periodic box or a channel, and may have another viscosity inside each curve.
//!
//! # Example
//!
//! An ellipse of fluid is ten times as viscous as the fluid around it, and has a surface tension of 1. It relaxes to a
//! circle. This program computes the velocity of its tip, and the flow at its centre and close to the tip:
//!
//! ```
//! use motile_base::{FlowSample, Region, Vec2};
//! use stokes_boundary_integrals::{Interface, InterfaceFlow, PeriodicCalculus, Settings, TensionPlacement};
//!
//! # fn main() -> Result<(), stokes_boundary_integrals::LayerError> {
//! let count = 128;
//! let angle = |k: usize| std::f64::consts::TAU * k as f64 / count as f64;
//! let positions: Vec<Vec2> = (0..count).map(|k| Vec2::new(1.3 * angle(k).cos(), angle(k).sin() / 1.3)).collect();
//! let mut forces = vec![Vec2::ZERO; count];
//! PeriodicCalculus::new(count)?.tension_forces(&positions, &[1.0; 128], TensionPlacement::Points, &mut forces)?;
//!
//! let mut flow = InterfaceFlow::new(Region::Plane, 1.0, Settings::default())?;
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
//! G is the Green's function of a region, with `lap G - grad p = -4 pi delta`, and T its stress. Forces F per length on
//! curves, and velocities v on them, have these flows (Pozrikidis, Boundary Integral and Singularity Methods, 1992):
//!
//! ```text
//! single layer  1/(4 pi eta) INT G(x, y) F(y) ds(y)        double layer  1/(4 pi) INT v(y) T(x, y) n(y) ds(y)
//! ```
//!
//! If all fluids have one viscosity, the velocity is a single layer. If the fluid inside a curve has another viscosity,
//! the two layers together give an integral equation for v, which [`InterfaceFlow`] solves.
//!
//! * **Curves** are truncated Fourier series at equally spaced values of their parameter. Open curves continue
//!   periodically along x. They are a straight line plus a periodic curve, and have the Green's function of a row of
//!   images.
//! * **On a curve**, the logarithm of the single layer is integrated with the weights of Kress (Linear Integral
//!   Equations, 2014, section 12.3), and the rest with the trapezoidal rule. Errors fall faster than any power of the
//!   number of nodes.
//! * **Close to a curve**, the quadrature uses the preimage of the point under the complex parametrisation.
//! * **Far away**, the flow of a curve and the flow of the images of a box are smooth. Their Taylor series is computed
//!   from values on a circle, and summed with moments. The walls of a channel carry Fourier series along it.
//! * **Different viscosities** need the double layer and GMRES. The number of iterations depends neither on the number
//!   of nodes nor, above a ratio of about ten, on the ratio.
//!
//! # Cost
//!
//! Without fast sums, the cost of a solution grows with the square of the number of nodes of a curve and its close
//! neighbours. Each pair of curves that are farther apart costs a few microseconds. So in the plane, with open curves
//! and next to curved walls, you can compute tens of curves.
//!
//! Above 250 nodes in a box or channel, and above 4,000 in the plane, the crate uses fast sums for closed curves
//! (Ewald). If viscosities differ, these numbers are larger. The near part of the Green's function is summed over
//! nodes, its smooth part by a grid and Fourier transforms. Results equal the plain sums to the tolerance. Time and
//! memory grow like the number of nodes. With the feature `rayon` several threads work, and results are bitwise
//! identical.
//!
//! If forces follow from velocities, use [`SingleLayer`], the single layer as an operator. The crate
//! `stokes-axisymmetric` computes axisymmetric flows in three dimensions.

mod calculus;
mod close_weights;
mod curve;
mod density;
mod direct;
mod error;
mod ewald;
mod gmres;
mod greens;
mod images;
mod interface_flow;
mod layer;
mod multipole;
mod plan;
mod rigid_motion;
mod sample;
mod settings;
mod shares;
mod single_layer;
mod transforms;

pub use calculus::{PeriodicCalculus, TensionPlacement};
pub use curve::LayerCurve;
pub use error::LayerError;
pub use interface_flow::{Inside, Interface, InterfaceFlow, ObstacleLoad, Solution, WarmStart};
pub use rigid_motion::RigidMotion;
pub use settings::{Settings, Symmetry};
pub use single_layer::SingleLayer;

/// Shared with the other crates of motile. It is not part of the interface and may change at any time.
#[doc(hidden)]
pub mod internal {
    pub use crate::interface_flow::{DenseFactors, MOST_CONTRAST};
    pub use crate::shares::{MOST as MOST_SHARES, each as each_share};
    pub use crate::{calculus::MOST_POINTS, error::finite_vectors};

    /// The iterative solver of the equations.
    pub mod gmres {
        pub use crate::gmres::{Gmres, Outcome};
    }

    /// The function with the most concentrated spectrum, and polynomials for what follows from it.
    pub mod prolate {
        pub use crate::ewald::polynomial::powers;
        pub use crate::ewald::prolate::Prolate;
    }
}

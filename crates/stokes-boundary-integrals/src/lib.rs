//! Layer potentials of two-dimensional Stokes flow, spectrally accurate at any distance from the curves, in the plane,
//! in periodic boxes and in channels.
//!
//! # Example
//!
//! An ellipse of fluid ten times as viscous as the fluid around it, with a surface tension of 1, relaxes to a circle.
//! This computes the velocity of its tip, and the flow at its centre and close to the tip:
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
//! With the Green's function G of a region, `lap G - grad p = -4 pi delta`, and its stress T, forces F per length on
//! curves and velocities v on them have the flows (Pozrikidis, Boundary Integral and Singularity Methods, 1992)
//!
//! ```text
//! single layer  1/(4 pi eta) INT G(x, y) F(y) ds(y)        double layer  1/(4 pi) INT v(y) T(x, y) n(y) ds(y)
//! ```
//!
//! With fluid of another viscosity inside the curves the two together give an integral equation for v
//! ([`InterfaceFlow`]).
//!
//! * Curves are truncated Fourier series on equally spaced values of their parameter. Open curves, which continue
//!   periodically along x, are a straight line more, and have the Green's function of a row of images.
//! * The logarithm of the single layer is integrated by the weights of Kress (Linear Integral Equations, 2014, section
//!   12.3), the rest by the trapezoidal rule.
//! * Curves that are close to each other are summed node by node, in a channel with a row of images in closed form. The
//!   flow of curves farther away and of the images of a box is smooth: its Taylor series, computed from values on a
//!   circle, is summed by moments. Walls are a Fourier series along the channel, analytic across it.
//! * From 250 nodes on in a box or channel, 4,000 in the plane, and more where viscosities differ, closed curves are
//!   summed by a split Green's function: its near part over nodes, its smooth part by a grid and Fourier transforms
//!   (Ewald). These are the same sums to the tolerance, in
//!   time and memory that grow like the number of nodes, and with the feature `rayon` on several threads, to the same
//!   bits.
//! * A viscosity contrast needs the double layer and GMRES; its iterations depend neither on the nodes nor,
//!   beyond a ratio of about ten, on the ratio.
//! * At points and nodes close to a curve the quadrature uses the preimage of the point under the complex
//!   parametrisation.
//!
//! The crate `stokes-axisymmetric` computes axisymmetric flows in three dimensions.
//!
//! [`SingleLayer`] is the single layer as an operator, for forces that follow from the velocities. Without the fast
//! sums the cost of a solution grows with the square of the number of nodes of a curve and of its close neighbours, and
//! each pair of curves farther apart costs some microseconds: in the plane, among open curves and beside curved walls
//! the method suits some tens of curves.

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
pub use interface_flow::{Inside, Interface, InterfaceFlow, Solution, WarmStart};
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
}

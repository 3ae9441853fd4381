//! Steady swimmers, their stability and bifurcations, without waiting for a run.
//!
//! A swimmer's speed takes hundreds of time units to settle and a growth rate of 1e-4 takes thousands to show. Here the
//! equations of the steady state are solved by Newton's method, and the eigenvalues of their derivative say whether it
//! is stable:
//!
//! ```
//! use motile::prelude::*;
//! use steady_states::{SteadyState, Symmetry};
//!
//! let method = Method::Integral(IntegralMethod { nodes: 72, cells: 288 });
//! let region = Region::Channel { length: 12.0, width: 5.0, drive: Drive::ZeroGradient };
//! let setup = Setup { method, region, ..Setup::default() };
//! let swimmer = SteadyState::find(&setup)?;
//! println!("speed {:.6}, residual {:.0e}", swimmer.measured()?.speed, swimmer.residual()); // 0.137445, 1e-9
//! assert!((swimmer.measured()?.speed - 0.137_444_855).abs() < 3e-6);
//!
//! let spectrum = swimmer.spectrum()?;
//! let slowest = spectrum.leading().ok_or("no modes")?; // damped swings across the channel
//! assert_eq!(slowest.symmetry, Symmetry::Antisymmetric);
//! assert!(slowest.value.re < 0.0 && (slowest.value.im - 0.0336).abs() < 2e-4);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! # Equations
//!
//! Those of Cowley (chapter 2), for a droplet in a frame that moves with the velocity V:
//!
//! ```text
//! gamma = gamma0 - zeta_dmu c - Pi(c)                            (2.39)
//! F     = d(gamma tau)/ds, the force on the fluid                (2.5)
//! v     = Stokes flow of F in the region                         stokes_layers::InterfaceFlow
//! dx/dt = v - V  along the normal
//! dc/dt = -d(c V_t)/ds + ... + D d^2c/ds^2                       (2.3)
//! ```
//!
//! The shape is an offset h(a) along the normals of a fixed curve, the concentration a number of particles m(a) per
//! parameter: no gauge is left in the equations, they are smooth, and their eigenvalues are those of the droplet. Both
//! are trigonometric polynomials on the nodes of the description, which crowd where the concentration is steep; errors
//! fall faster than any power of their number, about a thousandfold from 64 to 128. That area and number of particles
//! are conserved and that rigid motions of the region change nothing makes the derivative singular; bordering by these
//! makes it regular, and V comes out with the state. The derivative is by central differences (errors of 1e-9), one
//! evaluation of the flow a difference; a state that is its own mirror image is solved for among such states, and its
//! eigenvalues come sorted by symmetry.
//!
//! [`Continuation`] follows a branch in any [`Parameter`] by pseudo-arclength and finds folds, branch points and Hopf
//! points on the way; [`SteadyState::critical`] and [`Critical::curve`] go to such points and along them in a second
//! parameter; [`LimitCycle`] has the oscillations that come from a Hopf point of a swimmer in a channel. The tables of
//! `docs/steady-states.md` are computed by it.
mod branch;
mod cost;
mod critical;
mod cycle;
mod elimination;
mod error;
mod floquet;
mod model;
mod modes;
mod newton;
mod parameter;
mod profile;
mod spectrum;
mod state;
mod system;

pub use branch::{Branch, BranchEnd, BranchPoint, Continuation, SpecialKind, SpecialPoint};
pub use cost::Cost;
pub use critical::Critical;
pub use cycle::LimitCycle;
pub use error::SteadyError;
pub use floquet::Multipliers;
/// A growth rate and an angular frequency.
pub use num_complex::Complex64;
pub use parameter::Parameter;
pub use profile::Profile;
pub use spectrum::{Eigenmode, ModeShape, Spectrum, Symmetry};
pub use state::{Measured, SteadyState};

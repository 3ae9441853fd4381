//! Steady swimmers and drops in imposed flows, their stability and bifurcations, without a run.
//!
//! In a run, a swimmer's speed takes hundreds of time units to settle, and a growth rate of 1e-4 takes thousands to
//! show. Use this crate to get both at once: it solves the equations of the steady state with Newton's method, and the
//! eigenvalues of their derivative show whether it is stable:
//!
//! ```
//! use motile::prelude::*;
//! use motile_steady_states::{SteadyState, Symmetry};
//!
//! let method = Method::Integral(IntegralMethod { nodes: 72, elements: 288 });
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
//! These are Cowley's equations (chapter 2), for a droplet in a frame that moves with the velocity V:
//!
//! ```text
//! gamma = gamma0 - zeta_dmu c - Pi(c)                            (2.39)
//! F     = d(gamma tau)/ds, the force on the fluid                (2.5)
//! v     = Stokes flow of F in the region                         stokes_boundary_integrals::InterfaceFlow
//! dx/dt = v - V  along the normal
//! dc/dt = -d(c V_t)/ds + ... + D d^2c/ds^2                       (2.3)
//! ```
//!
//! The shape is an offset h(a) along the normals of a fixed curve, and the concentration is a number of particles m(a)
//! per parameter a. The equations therefore have no freedom of parametrisation, are smooth, and their eigenvalues are
//! the eigenvalues of the droplet. Both fields are trigonometric polynomials on the nodes of the description, which
//! crowd where the concentration is steep. Errors fall faster than any power of their number, about a thousandfold from
//! 64 to 128.
//!
//! Area and number of particles are conserved and rigid motions of the region change nothing, so the derivative is
//! singular. Bordered by these conditions it is regular, and V comes out with the state. The derivative is taken by
//! central differences (errors of 1e-9), with one solution of the flow per difference. A state that is its own mirror
//! image is solved for among such states, and its eigenvalues come sorted by symmetry.
//!
//! In an imposed flow (`Setup::flow`), a droplet may have no particles. Its state is then the shape alone, and a drop
//! that tank-treads is as steady as any other. If the flow does not share a shift, a turn or a mirror image, states are
//! looked for among all.
//!
//! Particles that are exchanged with the inside count with those there: a well-mixed inside holds the particles that
//! the interface lacks. A field inside that diffuses and is carried along is the steady field of the same flow, so
//! states are exact, but their growth rates are not known.
//!
//! [`Continuation`] follows a branch in any [`Parameter`] by pseudo-arclength and finds folds, branch points and Hopf
//! points on the way. [`SteadyState::critical`] and [`Critical::curve`] go to such points and along them in a second
//! parameter. [`LimitCycle`] computes the oscillations that begin at a Hopf point of a swimmer in a channel. The tables
//! of `docs/evidence/results/steady-states.md` are computed with this crate.
mod azimuthal;
mod branch;
mod collapse;
mod continuation;
mod critical;
mod crossings;
mod cycle;
mod elimination;
mod error;
mod floquet;
mod flow;
mod growth;
mod guidance;
mod inside;
mod iteration;
mod model;
mod modes;
mod newton;
mod parameter;
mod profile;
mod profile_sensitivity;
mod resistance;
mod response;
mod revolution;
mod sensitivities;
mod settling;
mod spectrum;
mod stability;
mod state;
mod stencil;
mod system;

pub use branch::{Branch, BranchEnd, BranchPoint, SpecialKind, SpecialPoint};
pub use continuation::Continuation;
pub use critical::Critical;
pub use cycle::LimitCycle;
pub use error::SteadyError;
pub use floquet::Multipliers;
pub use guidance::Guidance;
/// Complex number: growth rate and angular frequency, or amplitude and phase.
pub use num_complex::Complex64;
pub use parameter::Parameter;
pub use profile::Profile;
pub use profile_sensitivity::ProfileSensitivity;
pub use sensitivities::{Sensitivities, Sensitivity};
pub use spectrum::{Eigenmode, ModeShape, Spectrum, Symmetry};
pub use stability::Stability;
pub use state::{Cost, Measured, SteadyState};

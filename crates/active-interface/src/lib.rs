//! Active droplets: closed fluid interfaces that carry particles, which raise the interface's tension, are carried
//! along by the flow that the tension drives, and so make the droplet swim.
//!
//! The model is that of Cowley (chapter 2): on the interface of a droplet in Stokes flow lives a concentration c of
//! particles,
//! ```text
//! dc/dt = -d(c V)/ds + D d^2c/ds^2                (2.3)
//! gamma = gamma0 - zeta_dmu c - Pi(c)             (2.39)
//! F     = d(gamma tau)/ds                         (2.5), the force on the fluid
//! ```
//! [`ActiveDroplet`] is that droplet as a body of a scene ([`motile_scene::Body`]). The parts it is made of, each
//! usable by itself, work on plain slices of markers ([`Vec2`](motile_base::Vec2)) and numbers:
//!
//! * **Shapes**: a [`Curve`] makes equidistant markers from a circle, an ellipse, Fourier modes, a function, or points;
//!   crossings; area, moments and perimeter of polygons, exact.
//! * **Particles**: an [`InitialConcentration`] to start from, and the [`Flux`] by which particles are carried
//!   along the interface without losing any.
//! * **Tension**: [`ConstantTension`], [`ContractileTension`] with an [`ExcludedVolume`], or a [`Tension`] of your own.
//! * [`Exchange`] of particles with the inside of a droplet: [`ActiveDroplet::with_pool`].
//! * [`observables`]: [`observables::observe`] for all of them at once, and a function for each; fluxes along a
//!   channel.
//! * [`theory`]: [`theory::LinearTheory`] and [`theory::SquirmerFlow`]. [`Units`] converts to SI.
//!
//! # Conventions
//!
//! Markers run counter-clockwise, normals point outwards. Segment k reaches from marker k to marker k + 1 and holds the
//! particle number n_k; its concentration is n_k over its length. Forces are those of the interface on the fluid.
//! Quantities have the units that you choose; every item names its dimension. Bad input ends in an [`InterfaceError`].
//!
//! # Example
//!
//! The stresslet of a polarised droplet, from the moments of its forces:
//! ```
//! use active_interface::{ContractileTension, Curve, InitialConcentration, InterfaceError, Tension};
//! use active_interface::observables::{Convention, Frame, force_moments};
//! use active_interface::theory::{LinearTheory, RoundDroplet};
//! use motile_base::Vec2;
//!
//! let markers = Curve::circle(1.0)?.markers(250)?;
//! let numbers = InitialConcentration::polarised(100.0, 0.0)?.particle_numbers(&markers)?;
//! let tension = ContractileTension::thesis(10.0, -1.0, 2.0, 100.0)?;
//!
//! // The force at a marker is the difference of gamma tau over its two segments.
//! let m = markers.len();
//! let pull = |k: usize| {
//!     let segment = markers[(k + 1) % m] - markers[k];
//!     segment.normalize() * tension.value(numbers[k] / segment.length())
//! };
//! let forces: Vec<Vec2> = (0..m).map(|k| pull(k) - pull((k + m - 1) % m)).collect();
//!
//! let frame = Frame::new(Vec2::ZERO, 0.0)?;
//! let rest = vec![Vec2::ZERO; m];
//! let moments = force_moments(&markers, &forces, &rest, [100.0, 100.0], Convention::FarField, &frame)?;
//! println!("stresslet {:.2}", moments.stresslet()[0][0]); // -4.84, a puller at the start
//! assert!((moments.stresslet()[0][0] + 4.84).abs() < 0.01);
//!
//! // Linear theory, eq. (2.59): it starts with a speed of about 0.125.
//! let theory = LinearTheory::new(RoundDroplet {
//!     radius: 1.0, viscosity_inside: 100.0, viscosity_outside: 100.0,
//!     tension: 110.0, activity: -1.0, concentration: 100.0, diffusivity: 0.1,
//! })?;
//! assert!((theory.swimming_speed(100.0)? - 0.125).abs() < 1e-12);
//! # Ok::<(), InterfaceError>(())
//! ```
//!
//! Equations, sections and figures of Cowley are those of Natasha Cowley, "Effects of mechanical properties of the
//! environment on cell migration", PhD thesis, University of Sheffield.

mod concentration;
mod curve;
mod droplet;
mod error;
mod exchange;
mod interface;
pub mod observables;
mod tension;
pub mod theory;
mod tridiagonal;
mod units;

pub use concentration::{Flux, InitialConcentration, Repair, SplitMix64};
pub use curve::{
    AreaMoments, Curve, first_crossing, line_through, markers_from_points, polygon_area, polygon_moments,
    polygon_perimeter, wave,
};
pub use droplet::ActiveDroplet;
pub use error::InterfaceError;
pub use exchange::Exchange;
pub use interface::{ActiveInterface, Motion};
pub use tension::{ConstantTension, ContractileTension, ExcludedVolume, Tension};
pub use units::{Quantity, Units};

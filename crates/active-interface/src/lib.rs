//! Active droplets: closed fluid interfaces that carry particles, which raise the interface's tension, are carried
//! along by the flow that the tension drives, and so make the droplet swim.
//!
//! The model is that of the thesis (chapter 2): on the interface of a droplet in Stokes flow lives a concentration c of
//! particles,
//! ```text
//! dc/dt = -d(c V)/ds + D d^2c/ds^2                (2.3)
//! gamma = gamma0 - zeta_dmu c - Pi(c)             (2.39)
//! F     = d(gamma tau)/ds                         (2.5), the force on the fluid
//! ```
//! [`ActiveDroplet`] is that droplet as a body of a scene ([`ib_core::Body`]). The parts it is made of, each usable by
//! itself, work on plain slices of markers ([`Vec2`](ib_core::Vec2)) and numbers:
//!
//! * **Shapes**: [`Curve`] makes equidistant markers from a circle, an ellipse, Fourier modes, a function, or points;
//!   [`CrossingFinder`] tells whether an interface crosses itself; [`polygon_moments`] and its relatives are exact.
//! * **Particles**: [`InitialConcentration`] to start from, [`Transport`] to carry them along the interface without
//!   losing any, [`repair_positivity`], [`cell_peclet`].
//! * **Tension**: [`ConstantTension`], [`ContractileTension`] with an [`ExcludedVolume`], or a [`Tension`] of your own.
//! * **Measurements**: [`observe`] for all [`Observables`] at once, and a function for each.
//! * **Channels**: [`TrajectoryRecorder`] for a run, [`Trajectory::regime`] for what the droplet does across the
//!   channel, [`gap_flow`], [`net_flux`] and [`pressure_drop`] for the flow along it.
//! * **Theory**: [`LinearTheory`] and [`SquirmerFlow`]; [`Units`] to convert to SI.
//!
//! # Conventions
//!
//! Markers run counter-clockwise, normals point outwards. Segment k reaches from marker k to marker k + 1 and holds the
//! particle number n_k; its concentration is n_k over its length. Forces are those of the interface on the fluid.
//! Quantities have the units that you choose; every item names its dimension. Bad input ends in an [`InterfaceError`].
//!
//! # Example
//!
//! How strongly does a polarised droplet push the fluid? Make it, and take the moments of its forces:
//! ```
//! use active_interface::*;
//! use ib_core::Vec2;
//!
//! let markers = Curve::circle(1.0)?.markers(250)?;
//! let numbers = InitialConcentration::polarised(100.0, 0.0)?.particle_numbers(&markers)?;
//! let tension = ContractileTension::thesis(10.0, -1.0, 2.0, 100.0)?;
//!
//! // The force at a marker is the difference of gamma tau over its two segments.
//! let m = markers.len();
//! let pull = |k: usize| {
//!     let segment = markers[(k + 1) % m] - markers[k];
//!     segment.normalize() * tension.value(numbers[k] / segment.norm())
//! };
//! let forces: Vec<Vec2> = (0..m).map(|k| pull(k) - pull((k + m - 1) % m)).collect();
//!
//! let frame = Frame::new(Vec2::zeros(), 0.0)?;
//! let rest = vec![Vec2::zeros(); m];
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

mod channel_flow;
mod crossing;
mod curve;
mod cyclic;
mod droplet;
mod droplet_body;
mod equidistant;
mod error;
mod excluded_volume;
mod face_value;
mod filter;
mod geometry;
mod initial;
mod observables;
mod polygon;
mod positivity;
mod recorder;
mod redistribution;
mod spectral;
mod spline;
mod tension;
mod theory;
mod trajectory;
mod transport;
mod units;

pub use channel_flow::{GapFlow, gap_flow, net_flux, pressure_drop};
pub use crossing::{CrossingFinder, first_crossing};
pub use curve::{Curve, markers_from_points};
pub use cyclic::{CirculantTridiagonal, CyclicTridiagonal};
pub use droplet::{ActiveDroplet, DropletWarning, MINIMUM_MARKERS, Motion, PECLET_LIMIT};
pub use error::InterfaceError;
pub use excluded_volume::{ExcludedVolume, NoExcludedVolume, QuadraticExcludedVolume, StepExcludedVolume};
pub use face_value::{Flux, weno5};
pub use initial::InitialConcentration;
pub use observables::{
    ActiveRegion, ConcentrationProfile, Convention, EllipseFit, ForceMoments, FourierModes, Frame, InterfaceState,
    Observables, SquirmerFit, VelocityFrame, active_curvature, active_region, aspect_ratio_from_moments,
    centroid_velocity, concentration_modes, concentration_profile, fit_ellipse, fitted_curvature, force_moments,
    observe, shape_modes, squirmer_coefficients,
};
pub use polygon::{AreaMoments, polygon_area, polygon_moments, polygon_perimeter};
pub use positivity::{Repair, repair_positivity};
pub use recorder::{Record, TrajectoryRecorder};
pub use tension::{ConstantTension, ContractileTension, Tension, TensionWarning};
pub use theory::{LinearTheory, ModeFlow, RoundDroplet, SquirmerFlow, equivalent_radius};
pub use trajectory::{
    Doubt, Estimate, Evidence, Extremum, LinearMode, LinearPair, Regime, RegimeCriteria, RegimeReport, Trajectory,
    extrema, fit_linear_mode, fit_linear_pair,
};
pub use transport::{Transport, cell_peclet};
pub use units::{Quantity, Units};

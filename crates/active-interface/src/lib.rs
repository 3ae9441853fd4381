//! Active droplets: closed fluid interfaces that swim by the particles on them.
//!
//! The particles raise the tension of the interface. Differences of tension drive a flow, and the flow carries the
//! particles along, so the droplet swims. Use this crate to put such a droplet into a scene, or to measure one. The
//! model is Cowley's (chapter 2). With the concentration c of particles on the interface,
//! ```text
//! dc/dt = -d(c V)/ds + D d^2c/ds^2                (2.3)
//! gamma = gamma0 - zeta_dmu c - Pi(c)             (2.39)
//! F     = d(gamma tau)/ds                         (2.5), the force on the fluid
//! ```
//! [`ActiveDroplet`] is that droplet as a body of a scene ([`motile_scene::Body`]). You can also use its parts by
//! themselves, because they work on plain slices of markers ([`Vec2`]) and numbers:
//!
//! * **Shapes**: a [`Curve`] makes equidistant markers from a circle, an ellipse, Fourier modes, a function, or points.
//!   It finds crossings, and the exact area, moments and perimeter of polygons.
//! * **Particles**: an [`InitialConcentration`] to start from, and the [`Flux`] by which particles are carried
//!   along the interface without losing any.
//! * **Tension**: [`ConstantTension`], [`ContractileTension`] with an [`ExcludedVolume`], or your own [`Tension`].
//! * **Fields** in the laboratory that an interface feels ([`Field`]), and [`Noise`] on its particles.
//! * [`Exchange`] of particles with the inside of a droplet: [`ActiveDroplet::with_well_mixed_interior`].
//! * **Measurements**: [`observables::observe`] returns all [`observables`] at once, and there is a function for each,
//!   also for the fluxes along a channel.
//! * **Theory**: [`theory::LinearTheory`] and [`theory::SquirmerFlow`], to check a result. [`Units`] converts to SI.
//!
//! # Conventions
//!
//! Markers run counter-clockwise, normals point outwards. Element k reaches from marker k to marker k + 1 and holds the
//! particle number n_k; its concentration is n_k over its length. Forces are the forces of the interface on the fluid.
//! Quantities have the units that you choose; every item names its dimension. Bad input returns an [`InterfaceError`].
//!
//! # Example
//!
//! This example puts particles on a circle in a flow that you prescribe. The flow gathers them at a known rate, and
//! diffusion spreads them at a known rate, so you can check both:
//!
//! ```
//! use std::error::Error;
//!
//! use active_interface::{ActiveDroplet, ContractileTension, Curve, ExcludedVolume};
//! use active_interface::{PrescribedFlow, Scene, StepSize, Vec2};
//!
//! /// Returns concentrations at time 1 that start as 1 + wave cos(angle), in a flow of velocity -gathering sin(angle)
//! /// along the circle.
//! fn concentrations(gathering: f64, diffusion: f64, wave: f64) -> Result<Vec<f64>, Box<dyn Error>> {
//!     let markers = Curve::circle(1.0)?.markers(256)?;
//!     let next = |k: usize| markers[(k + 1) % markers.len()];
//!     let start = |from: Vec2, to: Vec2| (1.0 + wave * (from + to).to_angle().cos()) * from.distance(to);
//!     let numbers = (0..markers.len()).map(|k| start(markers[k], next(k))).collect();
//!     let law = ContractileTension::new(1.0, -0.1, ExcludedVolume::None, 1.0)?;
//!
//!     let mut scene = Scene::new(PrescribedFlow::new(move |x: Vec2| gathering * x.y * Vec2::new(x.y, -x.x)));
//!     let droplet = scene.add(ActiveDroplet::new(&markers, numbers, law, diffusion)?);
//!     scene.run(1.0).step_size(StepSize::Fixed(0.005)).go()?;
//!     Ok(scene.body(droplet)?.concentrations().to_vec())
//! }
//!
//! fn main() -> Result<(), Box<dyn Error>> {
//!     // Without diffusion, the concentration where the flow converges grows like exp(0.5 t).
//!     let gathered = concentrations(0.5, 0.0, 0.0)?.into_iter().fold(0.0, f64::max).ln();
//!     // Without flow, the wave decays like exp(-0.2 t).
//!     let waves = concentrations(0.0, 0.2, 0.3)?;
//!     let decayed = (0.5 * (waves[0] - waves[128]) / 0.3).ln();
//!     println!("rates {gathered:.4} and {decayed:.4}, exact 0.5000 and -0.2000");
//!     assert!((gathered - 0.5).abs() < 1e-3 && (decayed + 0.2).abs() < 1e-3);
//!     Ok(())
//! }
//! ```
//!
//! Equations, sections and figures of Cowley refer to Natasha Cowley, "Effects of mechanical properties of the
//! environment on cell migration", PhD thesis, University of Sheffield.

mod concentration;
mod cortex;
mod curve;
mod droplet;
mod error;
mod exchange;
pub mod field;
mod interface;
mod noise;
pub mod observables;
mod tension;
pub mod theory;
mod tridiagonal;
mod units;

pub use concentration::{Flux, InitialConcentration, Repair};
pub use cortex::Cortex;
pub use curve::{
    AreaMoments, Curve, line_distance_from_polygon, line_through, polygon_area, polygon_moments, polygon_perimeter,
    wave,
};
pub use droplet::ActiveDroplet;
pub use error::InterfaceError;
pub use exchange::Exchange;
pub use field::{Field, Fields};
pub use interface::{ActiveInterface, Motion};
pub use motile_base::{FlowSample, InputError, Region, SolveReport, Vec2};
pub use motile_scene::{
    self as scene, Body, Every, FlowError, Handle, Hydrodynamics, MarkerKind, Markers, Observer, PrescribedFlow, Scene,
    SceneError, StepSize, Substrate, System, Warnings,
};
pub use noise::Noise;
pub use tension::{ConstantTension, ContractileTension, ExcludedVolume, Tension};
pub use units::{Quantity, Units};

/// Shared with the other crates of motile. It is not part of the interface and may change at any time.
#[doc(hidden)]
pub mod internal {
    pub use crate::concentration::SplitMix64;
}

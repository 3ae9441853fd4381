//! Bodies in Stokes flow: what all bodies and all methods of computing the flow have in common.
//!
//! Bodies put forces on the fluid at their markers; the fluid moves the markers:
//!
//! ```text
//! bodies --forces--> Hydrodynamics --marker velocities--> bodies (rate of their state) --> Integrator
//! ```
//!
//! [`Hydrodynamics`] is everything between forces and velocities. The crates `ib-core` (with a grid) and
//! `motile-boundary-integrals` (without one) have such flows, and [`Substrate`] is the simplest. A [`Body`] is anything
//! with markers. A [`Scene`] couples bodies, advances them with an [`integrator`], monitors their [gaps](gap), and can
//! be saved to a [`checkpoint`]. To record data during a [`Run`], attach an observer.
//!
//! In this example, a spring draws a point to the origin, on a substrate of friction 2:
//!
//! ```
//! use motile_base::Vec2;
//! use motile_scene::{MarkerBody, Scene, StepSize, Substrate};
//!
//! let mut scene = Scene::new(Substrate::new(2.0)?);
//! let spring = |positions: &[Vec2], forces: &mut [Vec2]| forces[0] = -3.0 * positions[0];
//! let point = scene.add(MarkerBody::new("point", vec![Vec2::X], spring));
//! scene.run(1.0).step_size(StepSize::Adaptive { tolerance: 1e-4 }).go()?;
//! let place = scene.body(point)?.markers()[0];
//! println!("at {:.3}", place.x);
//! assert!((place.x - (-1.5_f64).exp()).abs() < 1e-3);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! With the feature `rayon`, off by default, several threads work on scenes with many markers, and results are bitwise
//! identical.

mod body;
pub mod checkpoint;
mod error;
pub mod gap;
mod hydrodynamics;
pub mod integrator;
mod observables;
pub mod points;
mod saved_state;
mod scene;
pub mod step_report;
mod threads;

/// Version of the program and, after a plus sign, of the numbers that it computes, which is raised whenever the same
/// scene comes to other ones. Results that are kept on disk carry it, so that results of another version are not taken
/// for new ones.
pub const VERSION: &str = concat!(env!("CARGO_PKG_VERSION"), "+4");

pub use body::{
    Body, InteriorBody, MarkerBody, Observe, StepCause, StepInfo, StepLimit, Viscous, Warning, fastest_decay,
};
pub use error::{BodyError, FlowError, SceneError};
pub use gap::Repulsion;
pub use hydrodynamics::{
    BodyFlow, Domain, Enclosed, FlowWork, FluidView, Hydrodynamics, MarkerGroup, MarkerKind, Markers, ObstacleLoad,
    PrescribedFlow, Substrate, WallOutline,
};
pub use observables::{ChannelForces, Deformation, MomentEllipse, Stress, WallStress};
pub use scene::{Every, Handle, Imposed, Observer, Run, Scene, StepSize, System, Warnings};

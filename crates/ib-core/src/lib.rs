//! The immersed boundary method for Stokes flow: bodies made of markers, a fluid between them, and the coupling.
//!
//! Bodies put forces on the fluid at their markers; the fluid moves the markers:
//!
//! ```text
//! bodies --forces--> spread with a kernel --force field--> StokesSolver --velocity field--> interpolate,
//!        correct the mobility of interfaces --marker velocities--> bodies (rate of their state) --> Integrator
//! ```
//!
//! [`Hydrodynamics`] is everything between forces and velocities; [`ImmersedBoundary`] is it by a grid. A [`Body`] is
//! anything with markers; a [`Scene`] couples bodies and advances them; observers look on during a [`Run`].
//!
//! A droplet of constant tension as the simplest body, three numbers a marker in, one number out:
//!
//! ```
//! use ib_core::{CubicQuadratic, Hydrodynamics, ImmersedBoundary, MarkerKind, Markers, Vec2};
//! use stokes_grid::{Grid, PeriodicStokes};
//!
//! let solver = PeriodicStokes::new(Grid::periodic(64, 64, 0.1)?, 1.0)?;
//! let mut flow = ImmersedBoundary::new(solver, CubicQuadratic::default());
//! // 128 markers on an ellipse (equally spaced to some per cent), pulled together by a line tension of one
//! let mut markers = Markers::new();
//! markers.push_group(128, MarkerKind::Interface { viscosity_inside: None });
//! for k in 0..128 {
//!     let angle = std::f64::consts::TAU * k as f64 / 128.0;
//!     markers.positions_mut()[k] = Vec2::new(1.1 * angle.cos(), angle.sin() / 1.1);
//! }
//! for k in 0..128 {
//!     let pull = (markers.positions()[(k + 1) % 128] - markers.positions()[k]).normalize();
//!     markers.forces_mut()[k] += pull;
//!     markers.forces_mut()[(k + 1) % 128] -= pull;
//! }
//! flow.velocities(&mut markers)?;
//! // the tip moves in at about half the excess of curvature
//! assert!(markers.velocities()[0].x < -0.03 && markers.velocities()[0].x > -0.05);
//! println!("tip velocity {:.4}", markers.velocities()[0].x);
//! # Ok::<(), ib_core::FlowError>(())
//! ```
//!
//! Interfaces may have fluid of another viscosity inside, [`MarkerKind::Interface`]: a double layer on the markers
//! takes care of it, at any ratio of viscosities and with errors that do not grow with it. [`SmearedContrast`] has
//! Cowley's way, a viscosity that varies on the grid.
//!
//! Accuracy: velocities on an interface have errors of first order in h without the mobility correction and of second
//! order with it; far from interfaces the method is of second order throughout. Formulas and derivations:
//! docs/method.md in the repository.
//!
//! Equations, sections and figures of Cowley are those of Natasha Cowley, "Effects of mechanical properties of the
//! environment on cell migration", PhD thesis, University of Sheffield.

pub mod body;
pub mod checkpoint;
mod contrast;
mod error;
pub mod gap;
pub mod hydrodynamics;
mod immersed_boundary;
mod immersed_layers;
pub mod integrator;
pub mod kernel;
pub mod mobility;
pub mod scene;
mod transfer;

pub use body::{Body, MarkerBody, Observe};
pub use checkpoint::Checkpoint;
pub use error::{BodyError, FlowError, SceneError};
pub use gap::Repulsion;
pub use hydrodynamics::{Discretisation, Domain, FlowSample, Hydrodynamics, MarkerKind, Markers, Vec2};
pub use immersed_boundary::{ImmersedBoundary, SmearedContrast};
pub use immersed_layers::ImmersedLayers;
pub use input_checks as input;
pub use integrator::{Integrator, Midpoint, RungeKuttaChebyshev};
pub use kernel::{AnyKernel, CubicQuadratic, Kernel};
pub use scene::{Every, Handle, Observer, Run, Scene, StepSize, System, Warning, Warnings};
pub use transfer::Transfer;

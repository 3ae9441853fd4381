//! The immersed boundary method for Stokes flow: from forces at markers to velocities at markers, by a grid.
//!
//! ```text
//! forces --> spread with a kernel --force field--> StokesSolver --velocity field--> interpolate,
//!        correct the mobility of interfaces --> velocities
//! ```
//!
//! [`ImmersedBoundary`] does all of this. It implements [`Hydrodynamics`](motile_scene::Hydrodynamics), the trait of flows
//! for the scenes of [`motile_scene`].
//!
//! A droplet of constant tension as the simplest body, three numbers a marker in, one number out:
//!
//! ```
//! use ib_core::{BSpline, ImmersedBoundary};
//! use motile_base::Vec2;
//! use motile_scene::{Hydrodynamics, MarkerKind, Markers};
//! use stokes_grid::{Grid, PeriodicStokes};
//!
//! let solver = PeriodicStokes::new(Grid::periodic(64, 64, 0.1)?, 1.0)?;
//! let mut flow = ImmersedBoundary::new(solver, BSpline::<4>);
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
//! # Ok::<(), motile_scene::FlowError>(())
//! ```
//!
//! If the fluid inside an interface has another viscosity ([`motile_scene::MarkerKind::Interface`]), use
//! [`SmearedContrast`], Cowley's scheme: a viscosity that varies on the grid. Boundary integrals
//! (`motile-boundary-integrals`) are more accurate there, at any ratio of viscosities.
//!
//! Accuracy: velocities on an interface have errors of first order in h without the mobility correction and of second
//! order with it; far from interfaces the method is of second order throughout. Formulas and derivations:
//! docs/grid.md in the repository.
//!
//! Equations, sections and figures of Cowley are those of Natasha Cowley, "Effects of mechanical properties of the
//! environment on cell migration", PhD thesis, University of Sheffield.

mod immersed_boundary;
mod kernel;
mod mobility;
mod transfer;

pub use immersed_boundary::{ImmersedBoundary, SmearedContrast, WALL_TOLERANCE, grid_domain};
pub use kernel::{AnyKernel, BSpline, Gaussian6, Kernel, MAX_SUPPORT, Peskin4, Pieces, Role, Roma3};
pub use mobility::{Deficit, MobilityDeficit};
pub use transfer::Transfer;

//! The immersed boundary method for Stokes flow: from forces at markers to their velocities.
//!
//! ```text
//! forces --> spread with a kernel --force field--> StokesSolver --velocity field--> interpolate,
//!        correct the mobility of interfaces --> velocities
//! ```
//!
//! [`ImmersedBoundary`] does all of this: you choose a solver and a kernel, and pass the markers. It implements
//! [`Hydrodynamics`], the trait of flows for the scenes of [`motile_scene`], so it works with any body.
//!
//! # Example
//!
//! This example is Peskin's elastic ring. It prints the order of the velocity with and without the mobility correction,
//! and the area that the ring loses while it becomes a circle:
//!
//! ```
//! use std::error::Error;
//! use std::f64::consts::TAU;
//!
//! use ib_core::{BSpline, Grid, ImmersedBoundary, MarkerBody, MarkerKind, PeriodicStokes, Scene, StepSize, Vec2};
//!
//! /// Markers of an ellipse, nearly equally spaced.
//! fn ellipse(count: usize) -> Vec<Vec2> {
//!     let angle = |k: usize| TAU * k as f64 / count as f64;
//!     (0..count).map(|k| Vec2::new(0.6 * angle(k).cos(), 0.5 * angle(k).sin())).collect()
//! }
//!
//! /// Springs between neighbouring markers, whose length at rest is zero.
//! fn springs(positions: &[Vec2], forces: &mut [Vec2]) {
//!     let count = positions.len();
//!     let stiffness = count as f64 / TAU;
//!     for k in 0..count {
//!         let [before, after] = [positions[(k + count - 1) % count], positions[(k + 1) % count]];
//!         forces[k] = stiffness * (before + after - 2.0 * positions[k]);
//!     }
//! }
//!
//! type Flow = ImmersedBoundary<PeriodicStokes, BSpline<4>>;
//!
//! /// A ring in a box of 2 × 2 on n × n cells, its markers half a grid spacing apart.
//! fn scene(n: usize, corrected: bool) -> Result<(Scene<Flow>, usize), Box<dyn Error>> {
//!     let solver = PeriodicStokes::new(Grid::periodic(n, n, 2.0 / n as f64)?, 1.0)?;
//!     let make = if corrected { Flow::new } else { Flow::uncorrected };
//!     Ok((Scene::new(make(solver, BSpline::<4>)), 7 * n / 2))
//! }
//!
//! /// Returns the velocities of 28 markers.
//! fn velocities(n: usize, corrected: bool) -> Result<Vec<Vec2>, Box<dyn Error>> {
//!     let (mut scene, count) = scene(n, corrected)?;
//!     let kind = MarkerKind::Interface { viscosity_inside: None };
//!     scene.add(MarkerBody::new("ring", ellipse(count), springs).with_kind(kind));
//!     let markers = scene.system_mut().evaluate()?;
//!     Ok(markers.velocities().iter().step_by(count / 28).copied().collect())
//! }
//!
//! /// Returns the order of the velocity from three grids, each half as fine as the next.
//! fn order(corrected: bool) -> Result<f64, Box<dyn Error>> {
//!     let [coarse, middle, fine] =
//!         [velocities(64, corrected)?, velocities(128, corrected)?, velocities(256, corrected)?];
//!     let distance =
//!         |a: &[Vec2], b: &[Vec2]| a.iter().zip(b).map(|(a, b)| (*a - *b).length_squared()).sum::<f64>().sqrt();
//!     Ok((distance(&coarse, &middle) / distance(&middle, &fine)).log2())
//! }
//!
//! /// Returns the area that the ring has lost by time 0.5, as a fraction of its area.
//! fn area_loss(n: usize) -> Result<f64, Box<dyn Error>> {
//!     let area =
//!         |ring: &[Vec2]| (0..ring.len()).map(|k| 0.5 * ring[k].perp_dot(ring[(k + 1) % ring.len()])).sum::<f64>();
//!     let (mut scene, count) = scene(n, true)?;
//!     let kind = MarkerKind::Interface { viscosity_inside: None };
//!     let ring = scene.add(MarkerBody::new("ring", ellipse(count), springs).with_kind(kind));
//!     let start = area(scene.body(ring)?.markers());
//!     scene.run(0.5).step_size(StepSize::Adaptive { tolerance: 1e-4 }).go()?;
//!     Ok(1.0 - area(scene.body(ring)?.markers()) / start)
//! }
//!
//! fn main() -> Result<(), Box<dyn Error>> {
//!     let [with, without] = [order(true)?, order(false)?];
//!     println!("order {with:.2} with the correction, {without:.2} without");
//!     let loss = area_loss(64)?;
//!     println!("area lost {loss:.2e}");
//!     assert!(with > 1.8 && without < 1.3);
//!     assert!(loss.abs() < 1e-3);
//!     Ok(())
//! }
//! ```
//!
//! If the fluid inside an interface has another viscosity ([`motile_scene::MarkerKind::Interface`]), use
//! [`SmearedContrast`], Cowley's scheme: a viscosity that varies on the grid. Boundary integrals
//! (`motile-boundary-integrals`) are more accurate there, at any ratio of viscosities.
//!
//! Accuracy: velocities on an interface have errors of first order in h without the mobility correction and of second
//! order with it; far from interfaces the method is of second order throughout. Formulas and derivations:
//! docs/explanation/grid.md in the repository.
//!
//! With the feature `rayon`, off by default, several threads work on many markers and large grids, and results are
//! bitwise identical.
//!
//! Equations, sections and figures of Cowley refer to Natasha Cowley, "Effects of mechanical properties of the
//! environment on cell migration", PhD thesis, University of Sheffield.

mod immersed_boundary;
mod kernel;
mod mobility;
mod transfer;

pub use immersed_boundary::{ImmersedBoundary, SmearedContrast};
pub use kernel::{AnyKernel, BSpline, Gaussian6, Kernel, MAX_SUPPORT, Peskin4, Pieces, Role, Roma3};
pub use mobility::rest_distance;
pub use motile_base::{Drive, FlowSample, InputError, Region, SolveReport, Vec2};
pub use motile_scene::{
    self as scene, Body, Every, FlowError, Handle, Hydrodynamics, MarkerBody, MarkerKind, Markers, Observer,
    PrescribedFlow, Scene, SceneError, StepSize, Substrate, System, Warnings,
};
pub use stokes_grid::{
    CentreField, ChannelStokes, Grid, PeriodicStokes, ProjectionStokes, StaggeredField, StokesError, StokesSolver,
    TwoPhaseStokes,
};
pub use transfer::Transfer;

/// Shared with the other crates of motile. It is not part of the interface and may change at any time.
#[doc(hidden)]
pub mod internal {
    pub use crate::immersed_boundary::{WALL_TOLERANCE, grid_domain};
}

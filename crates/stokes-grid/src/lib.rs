//! Stokes flow on staggered grids: velocities of a viscous fluid for given forces.
//!
//! You choose a grid and a viscosity, fill a field with forces, and a solver returns the velocity, which is exactly
//! free of divergence. The equations are `eta lap(v) - grad p + f = 0`, `div v = 0` in two dimensions, with a viscosity
//! eta and a force density f (force per volume). The fluid fills a box that is periodic in both directions or a channel
//! that is periodic in x and has no-slip walls in y, at rest or sliding, as its [`Grid`] is made. Fields on a grid are
//! a [`StaggeredField`] (velocities, forces), a [`CentreField`] or a [`NodeField`].
//!
//! | solver | region | method | real transforms of a field |
//! |---|---|---|---|
//! | [`PeriodicStokes`] | box | streamfunction | 1 + 1 in two dimensions |
//! | [`ChannelStokes`] | channel | streamfunction | 1 + 1 along x, tridiagonal sweeps along y |
//! | [`ProjectionStokes`] | box | projection | 3 + 3 in two dimensions |
//! | [`ProjectionStokes`] | channel | projection | 2 + 2 along x, 6 sine and cosine transforms (DST, DCT) along y |
//! | [`TwoPhaseStokes`] | both | any viscosity field, conjugate gradients with one of these | one solve per iteration |
//!
//! All but the last are direct: their velocity and pressure satisfy the discrete equations (second-order differences on
//! the marker-and-cell grid) to round-off. They share the trait [`StokesSolver`]: a solver is made once for a grid and
//! run many times without allocating.
//!
//! If in doubt, use a streamfunction solver, because these are the fastest. [`ProjectionStokes`] is the projection
//! solver of Cowley's thesis, and its page compares errors and costs. The sine and cosine transforms behind it,
//! [`SineTransform`], [`NodeSineTransform`] and [`CosineTransform`], can be used on their own.
//!
//! A solve returns the velocity alone, because that is all that moving bodies need. The pressure
//! ([`StokesSolver::pressure`]), [`streamfunction`], [`vorticity`], [`normal_strain_rates`], [`shear_strain_rate`],
//! [`divergence`], [`flux`] and [`wall_shear_stress`] are computed on request.
//!
//! **Mean values.** In a box the velocity has mean zero unless [`PeriodicStokes::set_mean_velocity`] prescribes another
//! one, and a mean force is balanced by a uniform pressure gradient. In a channel [`Drive`]
//! prescribes the mean pressure gradient or the flux.
//! [`SolveReport::mean_pressure_gradient`] has the uniform part of
//! grad p, and [`StokesSolver::pressure`] gives the periodic part of p, with mean zero.
//!
//! **Friction with a substrate.** A thin layer of fluid between two plates, or on a substrate, also loses momentum to
//! them. [`PeriodicStokes::set_friction`] and [`ChannelStokes::set_friction`] add this friction, `-alpha v`, to the
//! equations (Brinkman's equation). It needs no further transforms.
//!
//! # Example
//!
//! This example applies a force whose flow is known in a periodic box, and prints the order of the error:
//!
//! ```
//! use std::f64::consts::TAU;
//!
//! use stokes_grid::{Grid, PeriodicStokes, StaggeredField, StokesError, StokesSolver, Vec2};
//!
//! /// Returns the largest error of the velocity on n × n cells of the unit square.
//! fn error(n: usize) -> Result<f64, StokesError> {
//!     let grid = Grid::periodic(n, n, 1.0 / n as f64)?.with_origin([0.0; 2])?;
//!     // This velocity has no divergence, and its Laplacian is -2 k² times itself.
//!     let exact = |x: Vec2| Vec2::new((TAU * x.x).sin() * (TAU * x.y).cos(), -(TAU * x.x).cos() * (TAU * x.y).sin());
//!     let pressure_gradient = |x: Vec2| TAU * Vec2::new((TAU * x.x).cos(), (TAU * x.y).cos());
//!     let viscosity = 3.0;
//!     let force = |x: Vec2| 2.0 * TAU * TAU * viscosity * exact(x) + pressure_gradient(x);
//!
//!     let mut solver = PeriodicStokes::new(grid, viscosity)?;
//!     let mut velocity = StaggeredField::zeros(grid);
//!     solver.solve(&StaggeredField::from_fn(grid, force), &mut velocity)?;
//!     let exact = StaggeredField::from_fn(grid, exact);
//!     let pairs = velocity.x().iter().zip(exact.x()).chain(velocity.y().iter().zip(exact.y()));
//!     Ok(pairs.map(|(found, exact)| (found - exact).abs()).fold(0.0, f64::max))
//! }
//!
//! fn main() -> Result<(), StokesError> {
//!     let [coarse, fine] = [error(32)?, error(64)?];
//!     let order = (coarse / fine).log2();
//!     println!("error {fine:.2e} on 64 x 64 cells, order {order:.3}");
//!     assert!(fine < 1e-3 && (order - 2.0).abs() < 0.01);
//!     Ok(())
//! }
//! ```
//!
//! # Poiseuille flow
//!
//! In a channel, a pressure gradient G drives a parabola, `v = G (y² - H²/4)/(2 eta)` between walls at y = ±H/2. The
//! projection solver finds it with an error of G h²/(8 eta) everywhere, because the walls lie halfway between two rows
//! of velocities:
//!
//! ```
//! use stokes_grid::{Drive, Grid, ProjectionStokes, StaggeredField, StokesError, StokesSolver, Vec2};
//!
//! fn main() -> Result<(), StokesError> {
//!     let (gradient, viscosity, height, rows) = (-3.0, 2.0, 1.0, 20);
//!     let h = height / f64::from(rows);
//!     let grid = Grid::channel(16, rows as usize, h)?;
//!     let mut solver = ProjectionStokes::new(grid, viscosity)?;
//!     solver.set_drive(Drive::Gradient(gradient))?;
//!     let mut velocity = StaggeredField::zeros(grid);
//!     solver.solve(&StaggeredField::zeros(grid), &mut velocity)?;
//!     let parabola = |x: Vec2| Vec2::new(gradient * (x.y * x.y - 0.25 * height * height) / (2.0 * viscosity), 0.0);
//!     let exact = StaggeredField::from_fn(grid, parabola);
//!     let errors = velocity.x().iter().zip(exact.x()).map(|(found, exact)| (found - exact).abs());
//!     let error = errors.fold(0.0, f64::max);
//!     println!("error {error:.2e}");
//!     assert!((error / (gradient.abs() * h * h / (8.0 * viscosity)) - 1.0).abs() < 1e-9);
//!     Ok(())
//! }
//! ```
//!
//! # Speed and sizes
//!
//! Any numbers of cells work, odd and prime ones included. Those without prime factors other than 2, 3, 5, 7 and 11 are
//! fast, and an even `nx` is a third faster than an odd one. Other prime factors take two to nine times as long. In a
//! channel this concerns `nx` alone, except for [`ProjectionStokes`].
//!
//! With the feature `rayon`, off by default, [`PeriodicStokes`] and [`ProjectionStokes`] use the threads of the current
//! pool in boxes of 800,000 cells or more, with bitwise identical results for any number of them.
//!
//! `cargo bench --bench solvers` compares times with a *pair*, a forward and an inverse real transform of one field of
//! the same size, in the same run. A solve takes about 1.1 pairs with [`PeriodicStokes`] in boxes of 120 to 1024 cells
//! squared. With [`ChannelStokes`], it takes about 2.1 pairs of transforms along x alone. [`ProjectionStokes`] takes
//! 2.2 to 3.1 pairs in a box, and 9 to 13 pairs of transforms along x in a channel.
//!
//! Equations, sections and figures of Cowley refer to Natasha Cowley, "Effects of mechanical properties of the
//! environment on cell migration", PhD thesis, University of Sheffield.

mod channel;
mod error;
mod field;
mod grid;
mod kinematics;
mod periodic;
mod projection;
mod sampling;
mod solver;
mod stencil;
mod transform;
mod two_phase;
mod walls;

pub use channel::ChannelStokes;
pub use error::StokesError;
pub use field::{CentreField, NodeField, StaggeredField};
pub use grid::Grid;
pub use kinematics::{
    divergence, flux, normal_strain_rates, shear_strain_rate, streamfunction, vorticity, wall_shear_stress,
};
pub use motile_base::{
    CosineTransform, Drive, FlowSample, InputError, NodeSineTransform, SineTransform, SolveReport, Vec2,
};
pub use periodic::PeriodicStokes;
pub use projection::{ProjectionStokes, WallTreatment};
pub use sampling::{level_at_walls, sample_flow, sample_pressure};
pub use solver::{StokesSolver, Work};
pub use transform::{RealFft2, Symbol};
pub use two_phase::TwoPhaseStokes;
pub use walls::{Wall, WallMotion};

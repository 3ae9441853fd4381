//! Stokes flow on staggered grids: the velocity of a viscous fluid without inertia for given forces, exactly free of
//! divergence.
//!
//! The equations are `eta lap(v) - grad p + f = 0`, `div v = 0` in two dimensions, with a viscosity eta and a force
//! density f (force per volume). The fluid fills a box that is periodic in both directions or a channel that is
//! periodic in x and has no-slip walls in y, at rest or sliding, as its [`Grid`] is made. Fields on a grid are a
//! [`StaggeredField`] (velocities, forces), a [`CentreField`] or a [`NodeField`].
//!
//! | solver | region | method | real transforms of a field |
//! |---|---|---|---|
//! | [`PeriodicStokes`] | box | streamfunction | 1 + 1 in two dimensions |
//! | [`ChannelStokes`] | channel | streamfunction | 1 + 1 along x, tridiagonal sweeps along y |
//! | [`TwoPhaseStokes`] | both | any viscosity field, conjugate gradients around one of these | a solve an iteration |
//!
//! All but the last are direct: their velocity and pressure satisfy the discrete equations (second-order differences on
//! the marker-and-cell grid) to round-off. They share the trait [`StokesSolver`]: a solver is made once for a grid and
//! run many times without allocating.
//!
//! A solve gives the velocity alone. The pressure ([`StokesSolver::pressure`]), [`streamfunction`], [`vorticity`],
//! [`normal_strain_rates`], [`shear_strain_rate`], [`divergence`], [`flux`] and [`wall_shear_stress`] are computed on
//! request.
//!
//! **Mean values.** In a box the velocity has mean zero unless [`PeriodicStokes::set_mean_velocity`] prescribes another
//! one, and a mean force is balanced by a uniform pressure gradient. In a channel [`Drive`](motile_base::Drive)
//! prescribes the mean pressure gradient or the flux.
//! [`SolveReport::mean_pressure_gradient`](motile_base::SolveReport::mean_pressure_gradient) has the uniform part of
//! grad p, and [`StokesSolver::pressure`] gives the periodic part of p, with mean zero.
//!
//! # Example
//!
//! Two opposite forces along x in a box push fluid against each other; in a channel a pressure gradient of -1 drives
//! Poiseuille flow, whose fastest fluid has the speed `width^2 / (8 eta)`.
//!
//! ```
//! use motile_base::Drive;
//! use stokes_grid::{CentreField, ChannelStokes, Grid, PeriodicStokes, StaggeredField, StokesSolver, divergence};
//!
//! # fn main() -> Result<(), stokes_grid::StokesError> {
//! let grid = Grid::periodic(64, 48, 0.1)?;
//! let mut force = StaggeredField::zeros(grid);
//! let (fx, _) = force.components_mut();
//! fx[24 * 64 + 20] = 100.0;
//! fx[24 * 64 + 44] = -100.0;
//!
//! let mut solver = PeriodicStokes::new(grid, 1.0)?;
//! let mut velocity = StaggeredField::zeros(grid);
//! solver.solve(&force, &mut velocity)?;
//! println!("velocity at the forces: {:.4}", velocity.x()[24 * 64 + 20]);
//! assert_eq!(format!("{:.4}", velocity.x()[24 * 64 + 20]), "0.3131");
//!
//! let mut rate = CentreField::zeros(grid);
//! divergence(&velocity, &mut rate)?;
//! assert!(rate.values().iter().all(|d| d.abs() < 1e-13));
//!
//! let channel = Grid::channel(16, 41, 2.0 / 41.0)?;
//! let mut solver = ChannelStokes::new(channel, 1.0)?;
//! solver.set_drive(Drive::Gradient(-1.0))?;
//! let mut velocity = StaggeredField::zeros(channel);
//! solver.solve(&StaggeredField::zeros(channel), &mut velocity)?;
//! let centre = velocity.x()[20 * 16];
//! println!("speed on the centre line: {centre:.4}");
//! assert!((centre - 0.5).abs() < 0.0004);
//! # Ok(())
//! # }
//! ```
//!
//! # Speed and sizes
//!
//! Any numbers of cells work, odd and prime ones included. Those without prime factors other than 2, 3, 5, 7 and 11 are
//! fast, and an even `nx` is a third faster than an odd one; other prime factors take two to nine times as long. In a
//! channel this concerns `nx` alone.
//!
//! With the feature `rayon`, off by default, [`PeriodicStokes`] uses the threads of the current pool from 800,000 cells
//! on, with bitwise identical results for any number of them.
//!
//! `cargo bench --bench solvers` prints times in units of plain real transforms of the same size in the same run: about
//! 1.1 pairs for [`PeriodicStokes`] from 120 to 1024 cells squared, and about 2.1 times the passes along x alone for
//! [`ChannelStokes`].
//!
//! Equations, sections and figures of Cowley are those of Natasha Cowley, "Effects of mechanical properties of the
//! environment on cell migration", PhD thesis, University of Sheffield.

mod channel;
mod error;
mod field;
mod grid;
mod kinematics;
mod periodic;
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
pub use periodic::PeriodicStokes;
pub use sampling::{sample_flow, sample_pressure};
pub use solver::{StokesSolver, Work};
pub use transform::{RealFft2, Symbol};
pub use two_phase::TwoPhaseStokes;
pub use walls::{Wall, WallMotion};

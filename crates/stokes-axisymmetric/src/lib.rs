//! Computes axisymmetric Stokes flow in three dimensions by boundary integrals, for drops and rigid bodies.
//!
//! Use this crate if your problem has an axis (the x axis) and no swirl, in unbounded fluid, in a tube, or in a closed
//! container. You give each surface as the curve of its meridian with the forces on it. [`AxisymmetricFlow`] returns
//! velocities, pressures and fluxes. Only the meridian carries nodes, so a flow in three dimensions costs about as much
//! as a dense matrix with two unknowns per node.
//!
//! * [`MeridianCalculus`] turns a surface tension into forces.
//! * [`tube`] makes the outline of a tube that narrows or waves.
//! * [`Disturbances`] computes the flow of small disturbances that are not axisymmetric. You can use it to find out
//!   whether an axisymmetric state is stable.
//!
//! # Example
//!
//! A force of 6 pi pulls a rigid sphere of radius 1 through fluid of viscosity 1. By Stokes' law its speed is 1:
//!
//! ```
//! use stokes_axisymmetric::{AxisymmetricFlow, Interface, LayerError, Settings, Vec2};
//!
//! let count = 256;
//! let angle = |k: usize| std::f64::consts::TAU * k as f64 / count as f64;
//! let sphere: Vec<Vec2> = (0..count).map(|k| Vec2::from_angle(angle(k))).collect();
//! // Each ring carries a share of the force that is proportional to its circumference.
//! let total: f64 = (0..count).map(|k| angle(k).sin().abs()).sum();
//! let pull = |k: usize| Vec2::new(6.0 * std::f64::consts::PI * angle(k).sin().abs() / total, 0.0);
//! let forces: Vec<Vec2> = (0..count).map(pull).collect();
//!
//! let mut flow = AxisymmetricFlow::new(1.0, Settings::default())?;
//! flow.load([Interface::rigid(&sphere, &forces, 1.0)].into_iter())?;
//! flow.solve()?;
//! let speed = flow.rigid_velocity(0).unwrap_or(f64::NAN);
//! println!("speed {speed:.5}");
//! assert!((speed - 1.0).abs() < 1e-4);
//! # Ok::<(), LayerError>(())
//! ```
//!
//! With the feature `rayon`, off by default, several threads compute the rows of the matrix, and results are bitwise
//! identical.

mod flow;
mod refusal;

pub use flow::{AxisymmetricFlow, Disturbances, MeridianCalculus, tube};
pub use motile_base::Vec2;
pub use stokes_boundary_integrals::{Inside, Interface, LayerError, Settings, Solution, TensionPlacement};

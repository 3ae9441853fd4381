//! Elastic solids in the plane, for channels with soft walls and any other geometry.
//!
//! A [`Solid`] is a triangle mesh of its reference state and a law for its forces (Cowley chapter 4): springs along the
//! edges, a hyperelastic material, or a law of your own. It is a body of a scene ([`motile_scene::Body`]): its points
//! put the forces on the fluid and move with it.
//!
//! # Example
//!
//! The lower wall of Cowley's constriction, stiffer to the right, held by its lowest row and squeezed by a
//! twentieth:
//! ```
//! use elastic_solids::{ChannelShape, Mesher, Moduli, NeoHookean, Solid, SolidError};
//! use motile_base::Vec2;
//!
//! let mesh = ChannelShape::THESIS.channel(12.0)?.lower_wall(-2.5, &Mesher::new(0.1)?)?;
//! println!("{}", mesh.quality());
//!
//! // Shear and bulk modulus as a function of place: five times as stiff at x = 6 as at -6.
//! let moduli = |s: Vec2| Moduli::of_springs(30.0 * (1.0 + (s.x + 6.0) / 3.0));
//! let wall = Solid::hyperelastic_graded(mesh, |s| Ok(NeoHookean::from(moduli(s)?)))?
//!     .named("lower wall")
//!     .pinned(|s| s.y < -2.49)?
//!     .deformed(|s| Vec2::new(s.x, -2.5 + 0.95 * (s.y + 2.5)))?;
//!
//! println!("energy {:.2}, smallest area ratio {:.2}", wall.elastic_energy()?, wall.smallest_jacobian().0);
//! assert!((wall.smallest_jacobian().0 - 0.95).abs() < 1e-12);
//! # Ok::<(), SolidError>(())
//! ```
//!
//! # Parts
//!
//! Each is usable by itself:
//!
//! * **Shapes**: [`Outline`] from polygons, circles, functions and profiles y(x), with rounded corners; [`Interior`]
//!   for the solid between them; [`Channel`] for two walls with islands between them, and ready ones, the
//!   [`ChannelShape`]s.
//! * **Meshes**: [`Mesher`] for any interior, lattices and Gmsh files in [`mesh`]; [`mesh::TriangleMesh::quality`]
//!   measures how even they are.
//! * **Materials**: [`NeoHookean`] (Cowley's), [`MooneyRivlin`], [`SaintVenantKirchhoff`], or an [`EnergyDensity`] of
//!   your own; [`Moduli`] converts between constants, Cowley's spring constant among them.
//! * **Forces** of a mesh by themselves ([`ElasticForces`]), and the checks that a law of your own must pass
//!   ([`check`]).
//! * **Membranes and rigid bodies**: [`Shell`], a closed membrane that resists stretching and bending; [`RigidBody`],
//!   of any outline, that the fluid carries along.
//! * **Relaxation and activity**: [`Maxwell`] elements beside any law ([`Solid::with_maxwell`]), for viscoelastic
//!   solids; [`ActiveSprings`] that contract at random ([`Solid::with_active_springs`]).
//! * **In the fluid**: [`Solid::pinned`] and [`Solid::tethered`] to hold a solid.
//! * **Measurements**: displacement, stress, energy and drift of a [`Solid`]; [`width_between`] walls.
//!
//! # Conventions
//!
//! Two dimensions: moduli and stresses are forces per length. Triangles are counter-clockwise. Walls repeat themselves
//! in x, their two ends share points. Forces are those of the solid on the fluid. Quantities have the units that you
//! choose; every item names its dimension. Bad input ends in a [`SolidError`].
//!
//! Equations, sections and figures of Cowley are those of Natasha Cowley, "Effects of mechanical properties of the
//! environment on cell migration", PhD thesis, University of Sheffield.

mod active_springs;
mod channel;
pub mod check;
mod damping;
mod error;
mod forces;
mod material;
pub mod mesh;
mod mesher;
mod outline;
mod random;
mod relaxation;
mod rigid_body;
mod shell;
mod skin;
mod solid;

pub use active_springs::ActiveSprings;
pub use channel::{Channel, ChannelShape, Walls, Width, width_between};
pub use error::SolidError;
pub use forces::{ElasticForces, Hyperelastic, Springs};
pub use material::{DeformationGradient, EnergyDensity, Mat2, Moduli, MooneyRivlin, NeoHookean, SaintVenantKirchhoff};
pub use mesher::Mesher;
pub use motile_base::BendingMeasure;
pub use outline::{Interior, Outline};
pub use relaxation::Maxwell;
pub use rigid_body::{RigidBody, RigidBodyMotion};
pub use shell::{Shell, ShellStrains};
pub use solid::{Deformation, Solid, Tether};

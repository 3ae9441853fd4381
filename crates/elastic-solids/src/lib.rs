//! Elastic solids in the plane, for channels with soft walls and any other geometry.
//!
//! Use this crate if droplets swim next to something soft. A [`Solid`] is a triangle mesh of its reference state
//! together with a law for its forces (Cowley chapter 4): springs along the edges, a hyperelastic material, or your own
//! law. It is a body of a scene ([`motile_scene::Body`]): its points put the forces on the fluid and move with it.
//!
//! # Example
//!
//! Forces pull the upper edge of a neo-Hookean strip. Its law of forces is written by hand, to show how you add your
//! own. The strip relaxes to the stretch that the stress of the material predicts:
//!
//! ```
//! use elastic_solids::mesh::{TriangleMesh, fitted_strip};
//! use elastic_solids::{DeformationGradient, ElasticForces, EnergyDensity, Hyperelastic, Mat2, Moduli, NeoHookean};
//! use elastic_solids::{Scene, Solid, SolidError, Substrate, Vec2};
//!
//! /// A hyperelastic law together with given forces on the points.
//! #[derive(Debug)]
//! struct Pulled {
//!     elastic: Hyperelastic<NeoHookean>,
//!     pulls: Vec<Vec2>,
//! }
//!
//! impl ElasticForces for Pulled {
//!     fn point_count(&self) -> usize {
//!         self.elastic.point_count()
//!     }
//!
//!     fn add_forces(&self, positions: &[Vec2], forces: &mut [Vec2]) -> Result<(), SolidError> {
//!         forces.iter_mut().zip(&self.pulls).for_each(|(force, pull)| *force += *pull);
//!         self.elastic.add_forces(positions, forces)
//!     }
//!
//!     fn energy(&self, positions: &[Vec2]) -> Result<f64, SolidError> {
//!         let work: f64 = self.pulls.iter().zip(positions).map(|(pull, place)| pull.dot(*place)).sum();
//!         Ok(self.elastic.energy(positions)? - work)
//!     }
//!
//!     fn stress(&self, triangle: usize, gradient: &Mat2) -> Option<Mat2> {
//!         self.elastic.stress(triangle, gradient)
//!     }
//!
//!     fn stiffest(&self) -> Moduli {
//!         self.elastic.stiffest()
//!     }
//! }
//!
//! /// Stress (force per length) that stretches the material by a factor in y alone.
//! fn stress(material: &NeoHookean, stretch: f64) -> Result<f64, SolidError> {
//!     let gradient = DeformationGradient::new(Mat2::from_rows_array(&[1.0, 0.0, 0.0, stretch]))?;
//!     Ok(material.stress(&gradient).to_cols_array()[3])
//! }
//!
//! fn main() -> Result<(), Box<dyn std::error::Error>> {
//!     let material = NeoHookean::new(1.0, 2.0)?;
//!     let mesh: TriangleMesh = fitted_strip(Vec2::ZERO, [1.0, 0.5], 0.1)?;
//!     let top = |point: &Vec2| point.y > 0.49;
//!     let share = 1.0 / mesh.points().iter().filter(|point| top(point)).count() as f64;
//!     // The forces that stretch the strip by a fifth, if its width is kept.
//!     let pull = Vec2::new(0.0, share * stress(&material, 1.2)?);
//!     let pulls = mesh.points().iter().map(|point| if top(point) { pull } else { Vec2::ZERO }).collect();
//!     let law = Pulled { elastic: Hyperelastic::new(&mesh, material), pulls };
//!
//!     let mut scene = Scene::new(Substrate::new(0.02)?);
//!     let strip = scene.add(Solid::with_forces(mesh, law)?.pinned(|point| point.y < 0.01)?);
//!     scene.run(20.0).go()?;
//!
//!     let height = scene.body(strip)?.positions().iter().map(|place| place.y).fold(0.0, f64::max);
//!     println!("stretched by {:.6}", height / 0.5);
//!     assert!((height / 0.5 - 1.2).abs() < 1e-6);
//!     Ok(())
//! }
//! ```
//!
//! # Parts
//!
//! You can use each part by itself:
//!
//! * **Shapes**: [`Outline`] from polygons, circles, functions and profiles y(x), with rounded corners; [`Interior`]
//!   for the solid between them; [`Channel`] for two walls with islands between them, and ready ones, the
//!   [`ChannelShape`]s.
//! * **Meshes**: [`Mesher`] for any interior, lattices and Gmsh files in [`mesh`]; [`mesh::TriangleMesh::quality`]
//!   measures how even they are.
//! * **Materials**: [`NeoHookean`] (Cowley's), [`MooneyRivlin`], [`SaintVenantKirchhoff`], or your own
//!   [`EnergyDensity`]; [`Moduli`] converts between constants, Cowley's spring constant among them.
//! * **Forces** of a mesh by themselves ([`ElasticForces`]), and the checks that your own law must pass ([`check`]).
//! * **Membranes and rigid bodies**: [`Shell`], a closed membrane that resists stretching and bending; [`RigidBody`],
//!   of any outline, that the fluid carries along.
//! * **Fibres**: [`Fibre`], an open or closed line that resists stretching and bending, with free or held ends,
//!   [`Target`] points, and travelling waves of curvature ([`FibreWave`]).
//! * **Relaxation and activity**: [`Maxwell`] elements in parallel with any law ([`Solid::with_maxwell`]), for
//!   viscoelastic solids; [`ActiveSprings`] that contract at random ([`Solid::with_active_springs`]).
//! * **In the fluid**: [`Solid::pinned`] and [`Solid::tethered`] hold a solid in place.
//! * **Measurements**: displacement, stress, energy and drift of a [`Solid`]; [`width_between`] walls.
//!
//! # Conventions
//!
//! Everything is two-dimensional, so moduli and stresses are forces per length. Triangles are counter-clockwise. Walls
//! repeat themselves in x, and their two ends share points. Forces are the forces of the solid on the fluid. Quantities
//! have the units that you choose; every item names its dimension. Bad input returns a [`SolidError`].
//!
//! Equations, sections and figures of Cowley refer to Natasha Cowley, "Effects of mechanical properties of the
//! environment on cell migration", PhD thesis, University of Sheffield.

mod active_springs;
mod channel;
pub mod check;
mod damping;
mod error;
mod fibre;
mod forces;
mod material;
pub mod mesh;
mod mesher;
mod outline;
mod random;
mod relaxation;
mod rigid_body;
mod shell;
mod solid;
mod surface_elasticity;

pub use active_springs::ActiveSprings;
pub use channel::{Channel, ChannelShape, Walls, Width, width_between};
pub use error::SolidError;
pub use fibre::{Fibre, FibreEnd, FibreFiles, FibreState, FibreWave, Target};
pub use forces::{ElasticForces, Hyperelastic, Springs};
pub use material::{DeformationGradient, EnergyDensity, Mat2, Moduli, MooneyRivlin, NeoHookean, SaintVenantKirchhoff};
pub use mesher::Mesher;
pub use motile_base::{BendingMeasure, FlowSample, InputError, Region, SolveReport, Vec2};
pub use motile_scene::{
    self as scene, Body, Every, FlowError, Handle, Hydrodynamics, MarkerBody, MarkerKind, Markers, Observer,
    PrescribedFlow, Scene, SceneError, StepSize, Substrate, System, Warnings,
};
pub use outline::{Interior, Outline};
pub use relaxation::Maxwell;
pub use rigid_body::{RigidBody, RigidBodyMotion};
pub use shell::{Shell, ShellStrains};
pub use solid::{Deformation, Solid, Tether};

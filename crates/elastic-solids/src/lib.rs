//! Elastic solids in the plane, for channels with soft walls and any other geometry.
//!
//! A solid is a triangle mesh of its reference state and a law for its forces (thesis chapter 4): springs along the
//! edges or a hyperelastic material. Every [`Solid`] is a body of a scene ([`ib_core::Body`]): its points put the forces on
//! the fluid and move with it. The parts, each usable by itself:
//!
//! * **Shapes**: [`Outline`] from polygons, circles, functions and profiles y(x), with fillets; [`Region`] for what
//!   lies between them; [`Channel`] for two walls, and ready ones: [`StraightChannel`], [`Constriction`] (thesis figure
//!   4.18), [`Valve`], [`Ratchet`], [`SinusoidalChannel`], [`BranchingChannel`].
//! * **Meshes**: [`Mesher`] for any region, [`equilateral_strip`] and its relatives for lattices, [`GmshMesh`] for
//!   files; [`TriangleMesh::quality`] says how even they are.
//! * **Materials**: [`NeoHookean`] (the thesis'), [`SaintVenantKirchhoff`], [`MooneyRivlin`], or an [`EnergyDensity`]
//!   of your own; [`Moduli`] converts between constants, the thesis' spring constant among them. Moduli may depend on
//!   the place.
//! * **In the fluid**: [`Solid::pinned`] and [`Solid::tethered`] to hold a solid, [`Solid::surface_corrected`] for a
//!   surface that the flow knows to a few hundredths of a grid spacing instead of a third.
//! * **Measurements**: displacement, stress, energy and drift of a [`Solid`]; [`width_between`] walls; [`SurfaceGap`]
//!   for distances from interfaces; [`measured_moduli`] of a mesh.
//!
//! # Conventions
//!
//! Two dimensions: moduli and stresses are forces per length. Triangles are counter-clockwise. Walls repeat themselves
//! in x, their two ends share points. Forces are those of the solid on the fluid. Quantities have the units that you
//! choose; every item names its dimension. Bad input ends in a [`SolidError`].
//!
//! # Example
//!
//! The thesis' constriction with soft walls, squeezed together by a twentieth:
//! ```
//! use elastic_solids::*;
//! use ib_core::Vec2;
//!
//! let walls = Constriction::thesis().channel()?.walls(-2.5, 2.5, &Mesher::new(0.1)?)?;
//! let moduli = Moduli::from_thesis_spring_constant(1e4)?;
//! let squeezed = |s: Vec2| Vec2::new(s.x, 0.95 * s.y);
//! let lower = Solid::springs(walls.lower, moduli.shear())?.deformed(squeezed)?;
//! let upper = Solid::hyperelastic(walls.upper, NeoHookean::from(moduli)).deformed(squeezed)?;
//!
//! println!("{}", lower.mesh().quality());
//! let width = width_between(&lower, &upper)?;
//! println!("width {:.2} to {:.2}", width.minimum, width.maximum); // 0.95 to 1.90
//! println!("energies {:.2} and {:.2}", lower.elastic_energy()?, upper.elastic_energy()?); // about the same
//! assert!((width.minimum - 0.95).abs() < 1e-12 && (width.maximum - 1.9).abs() < 1e-12);
//! assert!((lower.elastic_energy()? / upper.elastic_energy()? - 1.0).abs() < 0.03);
//! # Ok::<(), SolidError>(())
//! ```

mod boundary;
mod channel;
mod channel_shapes;
mod channel_width;
mod checks;
mod deformation;
mod energy;
mod error;
mod forces;
mod gmsh;
mod hyperelastic;
mod lattice;
mod measured;
mod mesh;
mod mesher;
mod moduli;
mod mooney_rivlin;
mod neo_hookean;
mod observables;
mod outline;
mod point_set;
mod quality;
mod region;
mod relaxation;
mod rounded_kink;
mod saint_venant_kirchhoff;
mod seeds;
mod segments;
mod solid;
mod solid_body;
mod springs;
mod surface_correction;
mod surface_gap;
mod topology;
mod triangulation;

pub use channel::{Channel, ChannelWalls};
pub use channel_shapes::{BranchingChannel, Constriction, Ratchet, SinusoidalChannel, StraightChannel, Valve};
pub use channel_width::{ChannelWidth, channel_width, width_between};
pub use checks::{ForceBalance, force_balance, patch_residual, stress_error};
pub use deformation::{DeformationGradient, Mat2};
pub use energy::EnergyDensity;
pub use error::SolidError;
pub use forces::ElasticForces;
pub use gmsh::{GmshMesh, PhysicalGroup};
pub use hyperelastic::Hyperelastic;
pub use lattice::{equilateral_block, equilateral_strip, fitted_strip};
pub use measured::{InnerPoints, MeasuredModuli, measured_moduli};
pub use mesh::{BoundaryLoop, Edge, TriangleMesh};
pub use mesher::Mesher;
pub use moduli::Moduli;
pub use mooney_rivlin::MooneyRivlin;
pub use neo_hookean::NeoHookean;
pub use observables::LargestDisplacement;
pub use outline::Outline;
pub use quality::MeshQuality;
pub use region::Region;
pub use saint_venant_kirchhoff::SaintVenantKirchhoff;
pub use solid::{Solid, Tether};
pub use springs::Springs;
pub use surface_gap::SurfaceGap;

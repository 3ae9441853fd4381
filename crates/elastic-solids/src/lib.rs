//! Elastic solids in the plane, for channels with soft walls and any other geometry.
//!
//! A material is an [`EnergyDensity`]: the strain energy W per reference area as a function of the deformation gradient
//! A (thesis section 4.2), and its derivative, the stress P = dW/dA. Ready are [`NeoHookean`] (the thesis' material),
//! [`SaintVenantKirchhoff`] and [`MooneyRivlin`]; [`Moduli`] converts between the constants.
//!
//! # Conventions
//!
//! Two dimensions: moduli and stresses are forces per length. Quantities have the units that you choose; every item names its
//! dimension. Bad input ends in a [`SolidError`].
//!
//! # Example
//!
//! The thesis' wall with a spring constant of 1e4, sheared by a tenth:
//! ```
//! use elastic_solids::*;
//!
//! let moduli = Moduli::from_thesis_spring_constant(1e4)?;
//! let material = NeoHookean::from(moduli);
//! let sheared = DeformationGradient::new(Mat2::new(1.0, 0.1, 0.0, 1.0))?;
//!
//! let stress = material.cauchy_stress(&sheared);
//! println!("shear stress {:.3}", stress.m12); // 9.375: the shear modulus is 93.75
//! assert!((stress.m12 - 9.375).abs() < 1e-10);
//! # Ok::<(), SolidError>(())
//! ```

mod channel;
mod channel_shapes;
mod channel_width;
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
mod quality;
mod region;
mod relaxation;
mod saint_venant_kirchhoff;
mod segments;
mod solid;
mod solid_body;
mod springs;
mod topology;
mod triangulation;

pub use channel::{Channel, ChannelWalls};
pub use channel_shapes::{BranchingChannel, Constriction, Ratchet, SinusoidalChannel, StraightChannel, Valve};
pub use channel_width::{ChannelWidth, channel_width, width_between};
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
pub use solid::{ElasticSolid, Solid, SpringLattice, Tether};
pub use springs::Springs;

//! An active polar gel: its director, stresses, defects.
//!
//! The director p, |p| = 1, has the Frank energy in the approximation of one constant, the molecular field h, and
//! dynamics and stress of Cowley (1.5), (1.7) without relaxation of stress (tau = 0):
//!
//! ```text
//! F       = K/2 INT |grad p|^2,   h = -dF/dp
//! Dp_i/Dt = h_i/gamma1 - nu1 u_ij p_j       (corotational; the part normal to p)
//! sigma   = 2 eta u - zeta_b (p p - 1/2) + nu1/2 (p h + h p) + 1/2 (p h - h p) - K grad p . grad p
//! ```
//!
//! u is the rate of strain, nu1 < 0 for rods, zeta_b < 0 for a contractile gel; the last terms are the antisymmetric
//! and the Ericksen stress.

mod anchoring;
mod defect;
mod director;
mod elements;
mod in_box;
mod in_droplet;
mod material;
mod stabiliser;
mod start;

pub use anchoring::Anchoring;
pub use defect::Defect;
pub use in_box::GelInBox;
pub use in_droplet::{GelInDroplet, GelObservables};
pub use material::GelMaterial;
pub use start::DirectorStart;

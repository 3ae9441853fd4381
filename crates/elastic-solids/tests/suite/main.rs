//! Solids against exact deformations and rates; sizes, limits, no allocation.

mod manufactured;
mod mesh_quality;
mod relaxation;
mod sizes;
mod stokes_flow;

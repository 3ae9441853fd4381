//! Green's functions of the Stokes equations: point forces, their stresses, rows and lattices of images, walls.
//!
//! They are normalised to `lap G - grad p = -4 pi delta`, so that a force F in a fluid of viscosity eta moves it with
//! `G F/(4 pi eta)`.

mod nodes;
mod pair;
mod point;
pub(crate) mod walls;

pub(crate) use nodes::{Nodes, Vectors, Window};
pub(crate) use pair::{AnyPair, FreePair, LatticePair, PairKernel, RowPair, Stokeslet};
pub(crate) use point::{Flow, GreensFunction, Kernels, free, half_turns, ln};

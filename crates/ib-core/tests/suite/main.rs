//! Spreading, interpolation and bodies on a grid.

mod bodies;
mod friction;
mod sliding_walls;
mod transfer;

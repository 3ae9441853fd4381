//! Spreading, interpolation and bodies on a grid.

mod bodies;
mod sliding_walls;
mod transfer;

//! The program `motile`, and what it shares with the examples of the repository.
//!
//! To run a scene file and record all of its bodies, use `motile run scene.toml`. For many runs use `motile sweep`, and
//! for steady states `motile steady`. To see what a scene would do, use `motile check`, and to write a first one,
//! `motile new`. If you write your own program, you will rarely need this package: build a scene with `motile`, and
//! attach observers of `motile-output`.
//!
//! * [`command_line`]: the frame of a program, with errors in one sentence.
//! * [`keys`]: entries of scenes by their keys, as in `--set droplets.0.particles.activity=-4`.
//! * [`run`]: runs with all their records.
//! * [`sweep`]: parameter sweeps from a plan in TOML.
//! * [`steady`]: steady states and branches of them.

pub mod command_line;
pub mod keys;
pub mod run;
pub mod steady;
pub mod sweep;

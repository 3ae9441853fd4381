//! The program `motile`, and what it shares with the examples of the repository.
//!
//! `motile run scene.toml` runs a scene file and records all of its bodies; `motile sweep` makes many runs, `motile
//! steady` finds steady states, `motile check` says what a scene would do, and `motile new` writes one to begin with.
//! If you write a program of your own, you will rarely need this package: build a scene with `motile`, and attach
//! observers of `motile-output`.
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

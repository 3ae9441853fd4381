//! The command line of motile: whole runs with all their records, and parameter sweeps.
//!
//! This package is a program, `motile-sweep`, together with what that program shares with the examples of the
//! repository: flags, runs that write tables, pictures and checkpoints, and progress bars. If you write a program of
//! your own, you will rarely need it: build a scene with `motile`, and attach observers of `motile-output`.
//!
//! * [`run`]: runs with all their records.
//! * [`sweep`]: parameter sweeps from a plan in TOML.

pub mod run;
pub mod sweep;

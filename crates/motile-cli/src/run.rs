//! Runs with all their records: trajectory, pictures, checkpoints, warnings, a summary of the results.
//!
//! | for | there are |
//! |---|---|
//! | any scene, with tables of all its bodies | [`SceneRun`] |
//! | droplets in three dimensions without symmetry | [`SpaceRun`] |
//! | any scene, with observers of your own | [`Job`] |
//! | results | [`Summary`] (`summary.json` and a table), [`write_results`] of many |
//! | settings, as flags of a command line | [`OutputFlags`], [`CheckpointFlags`] |
//!
//! [`command`] is the command line that results name as their origin; [`explained`] puts an error and its causes in one
//! line.

mod flags;
mod job;
mod places;
mod scene_run;
mod space_run;
mod steady;
mod summary;
mod words;

pub use flags::{CheckpointFlags, LookFlags, OutputFlags};
pub use job::{Decided, Job, Taken, Watch};
pub use scene_run::{SceneRun, View};
pub use space_run::SpaceRun;
pub use steady::Steadiness;
pub(crate) use summary::{ORIGIN_KEY, VERSION_KEY};
pub use summary::{Summary, make_directory, write_results};
pub use words::{command, explained, say};

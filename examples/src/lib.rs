//! The command line that the examples share: groups of flags, the run with all that watches it, and its results.
//!
//! | for | there are |
//! |---|---|
//! | flags | [`run`] around [`SceneFlags`] with [`BoxFlags`], [`ChannelFlags`], [`AnyRegionFlags`] or [`ElasticFlags`] |
//! | results | [`Summary`] (`summary.json` and a table) |
//! | runs | [`Job`] of any scene, [`WatchedRun`] of one with a droplet |
//! | constrictions | [`Passage`] |
//!
//! Equations, sections and figures of Cowley are those of Natasha Cowley, "Effects of mechanical properties of the
//! environment on cell migration", PhD thesis, University of Sheffield.

mod checkpoint_flags;
mod command_line;
mod flags;
mod gel_flags;
mod job;
mod kept_warnings;
mod method_flags;
mod parse;
mod passage;
mod region_flags;
mod steady;
mod summary;
mod turning;
mod wall_flags;
mod watched_run;

pub use checkpoint_flags::CheckpointFlags;
pub use command_line::{explained, run, say};
pub use flags::{AlongFlags, BoxFlags, ChannelFlags, DropletFlags, OutputFlags, RegionFlags, SceneFlags};
pub use gel_flags::GelFlags;
pub use job::{Job, Taken, Watch};
pub use method_flags::{MethodFlags, Preset, settle_contrast};
pub use parse::{activity, not_negative, pair, positive};
pub use passage::{Decided, Passage, Verdict};
pub use region_flags::{AnyRegionFlags, RegionKind};
pub use steady::Steadiness;
pub use summary::{Summary, make_directory};
pub use turning::turning_rate;
pub use wall_flags::{ElasticFlags, Material};
pub use watched_run::WatchedRun;

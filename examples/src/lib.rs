//! The command line that the examples share: groups of flags, the run with all that watches it, and its results.
//!
//! | for | there are |
//! |---|---|
//! | flags | [`run`] around groups such as [`DropletFlags`], [`MethodFlags`], [`BoxFlags`], [`ChannelFlags`], [`OutputFlags`] |
//! | results | [`Summary`] (`summary.json` and a table) |
//! | runs with a droplet | [`WatchedRun`] |
//! | constrictions | [`Passage`] |

mod checkpoint_flags;
mod command_line;
mod droplet_summary;
mod flags;
mod method_flags;
mod parse;
mod passage;
mod steady;
mod summary;
mod wall_flags;
mod watched_run;

pub use checkpoint_flags::CheckpointFlags;
pub use command_line::{run, say};
pub use droplet_summary::{RunCost, droplet_summary, put_solids};
pub use flags::{BoxFlags, ChannelFlags, Drive, DropletFlags, Initial, OutputFlags};
pub use method_flags::{Contrast, FlowMethod, MethodFlags, Preset, settle_contrast};
pub use parse::{TimeStep, activity, count, finite, kernel, not_negative, pair, positive, seed};
pub use passage::{Decided, Passage, Verdict};
pub use steady::Steadiness;
pub use summary::{Summary, make_directory};
pub use wall_flags::{ElasticFlags, Material, Mesh, SurfaceRule};
pub use watched_run::{WatchedRun, caption, check_run};

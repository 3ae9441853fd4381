//! The command line that the examples share.
//!
//! | for | there are |
//! |---|---|
//! | flags | [`run`]; [`SceneFlags`] with [`BoxFlags`], [`ChannelFlags`], [`AnyRegionFlags`], [`ElasticFlags`] |
//! | runs and their results | [`motile_cli::run`], [`SceneFlags::watch`] |
//! | elastic walls | [`swim_between_walls`] with [`RelaxationFlags`], [`TwitchingFlags`] |
//! | constrictions | [`Passage`] |
//!
//! Equations, sections and figures of Cowley are those of Natasha Cowley, "Effects of mechanical properties of the
//! environment on cell migration", PhD thesis, University of Sheffield.

mod elastic_walls;
mod flags;
mod gel_flags;
mod method_flags;
mod parse;
mod passage;
mod region_flags;
mod track;
mod wall_flags;

pub use elastic_walls::{RelaxationFlags, TwitchingFlags, swim_between_walls};
pub use flags::{AlongFlags, BoxFlags, ChannelFlags, DropletFlags, RegionFlags, SceneFlags};
pub use gel_flags::GelFlags;
pub use method_flags::{MethodFlags, Preset};
pub use motile_cli::command_line::run;
pub use parse::{distribution, finite, not_negative, pair, positive, scene_file};
pub use passage::{Passage, Verdict};
pub use region_flags::{AnyRegionFlags, RegionKind};
pub use track::{mean_speed, turning_rate};
pub use wall_flags::{ElasticFlags, Material};

#[cfg(test)]
mod tests;

//! Runs with everything that watches them: trajectory, pictures, checkpoints, warnings, and a summary of the results.
//!
//! | for | there are |
//! |---|---|
//! | one droplet and all there is to measure of it | [`WatchedRun`] |
//! | any scene | [`Job`], with observers of your own |
//! | results | [`Summary`] (`summary.json` and a table), [`write_results`] of many |
//! | settings, as flags of a command line | [`OutputFlags`], [`CheckpointFlags`] |
//!
//! Errors tell in one line where they came from ([`explained`]).

mod flags;
mod job;
mod places;
mod steady;
mod summary;
mod watched_run;

use std::io::Write as _;

pub use flags::{CheckpointFlags, OutputFlags};
pub use job::{Decided, Job, Taken, Watch};
pub use steady::Steadiness;
pub use summary::{Summary, make_directory, write_results};
pub use watched_run::{View, WatchedRun};

/// Writes a line to the standard output; where nobody listens any more, as behind `head`, that is no reason to fail.
pub fn say(line: impl std::fmt::Display) {
    let _ = writeln!(std::io::stdout(), "{line}");
}

/// An error and its causes, without those that it tells already, in one line.
#[must_use]
pub fn explained(error: &anyhow::Error) -> String {
    let told = error.chain().map(ToString::to_string).fold(String::new(), |told, cause| match told.as_str() {
        "" => cause,
        _ if told.contains(&cause) => told,
        _ => format!("{told}: {cause}"),
    });
    told.split_whitespace().collect::<Vec<_>>().join(" ")
}

#[cfg(test)]
mod tests;

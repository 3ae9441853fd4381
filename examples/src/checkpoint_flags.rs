//! Checkpoints of a run: where they are saved, and from which one it goes on.

use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicBool, Ordering};

use anyhow::{Context, Result, ensure};
use clap::Args;
use motile::AnyFlow;
use motile::ib_core::{Checkpoint, Midpoint, Run, Scene, SceneError};

use crate::parse::steps;

/// Steps between checkpoints unless something else is said.
const EVERY: usize = 500;

/// A run of a scene that a description made.
type FlowRun<'a> = Run<'a, AnyFlow, Midpoint>;

/// Whether the user has asked the run to stop.
static STOP: AtomicBool = AtomicBool::new(false);

/// Checkpoints.
#[derive(Debug, Clone, Default, PartialEq, Eq, Args)]
pub struct CheckpointFlags {
    /// File to save checkpoints to; Ctrl-C, SIGTERM and SIGHUP then save one and end the run
    #[arg(long, value_name = "FILE")]
    pub checkpoint: Option<PathBuf>,
    /// Steps between checkpoints [default: 500]
    #[arg(long, value_name = "STEPS", value_parser = steps, requires = "checkpoint", allow_hyphen_values = true)]
    pub checkpoint_every: Option<usize>,
    /// Checkpoint to go on from; give the flags of the run that saved it
    #[arg(long, value_name = "FILE")]
    pub resume: Option<PathBuf>,
}

impl CheckpointFlags {
    /// Brings the scene to the state to go on from, if there is one. A checkpoint whose description is another one was
    /// saved with other flags: the run goes on with those that are given now, and says so.
    ///
    /// # Errors
    /// A checkpoint that cannot be read or is of another scene, or one that is not before `end`; a file to save to that
    /// cannot be written.
    pub fn resume(&self, scene: &mut Scene<AnyFlow>, description: &str, end: f64) -> Result<()> {
        self.try_file()?;
        let Some(path) = &self.resume else { return Ok(()) };
        let flag = || format!("--resume {}", path.display());
        let checkpoint = Checkpoint::read(path).with_context(flag)?;
        let time = checkpoint.time();
        ensure!(time < end, "{}: the checkpoint is of t = {time}, give a --time after that", flag());
        scene.resume(&checkpoint).with_context(flag)?;
        if checkpoint.description() != description {
            eprintln!(
                "note: the checkpoint was saved with other settings ({}), the run goes on with those given now",
                checkpoint.description()
            );
        }
        Ok(())
    }

    /// Where checkpoints are saved, and after how many steps each.
    pub(crate) fn saved(&self) -> Option<(&Path, usize)> {
        Some((self.checkpoint.as_deref()?, self.checkpoint_every.unwrap_or(EVERY)))
    }

    /// Makes sure that checkpoints can be saved where they are wanted.
    fn try_file(&self) -> Result<()> {
        let Some(path) = &self.checkpoint else { return Ok(()) };
        let flag = || format!("--checkpoint {}", path.display());
        let special = path.metadata().is_ok_and(|data| !data.is_file());
        ensure!(!special, "{}: there is something that is not a file, give another name", flag());
        let mut trial = path.clone().into_os_string();
        trial.push(".trial");
        std::fs::write(&trial, "trial").and_then(|()| std::fs::remove_file(&trial)).with_context(flag)
    }

    /// The run with checkpoints and Ctrl-C as the flags say; SIGTERM and SIGHUP end it like Ctrl-C.
    ///
    /// # Errors
    /// Ctrl-C that cannot be listened to.
    pub(crate) fn watch<'a>(&'a self, run: FlowRun<'a>, description: &'a str) -> Result<FlowRun<'a>> {
        let Some((path, every)) = self.saved() else { return Ok(run) };
        match ctrlc::set_handler(|| STOP.store(true, Ordering::Relaxed)) {
            // A second run of the same program is listened to already.
            Ok(()) | Err(ctrlc::Error::MultipleHandlers) => {}
            Err(error) => return Err(error).context("Ctrl-C cannot be listened to"),
        }
        Ok(run.save(every, path, description).stop_on(&STOP))
    }

    /// Saves what a run has come to: to the file of the flags where it ended or was stopped, and beside it, with
    /// `.last` added to the name, where it failed, so that the last periodic checkpoint stays.
    ///
    /// # Errors
    /// A file that cannot be written.
    pub fn save(&self, scene: &Scene<AnyFlow>, description: &str, outcome: &Result<(), SceneError>) -> Result<()> {
        let Some(path) = &self.checkpoint else { return Ok(()) };
        let mut path = path.clone().into_os_string();
        if !matches!(outcome, Ok(()) | Err(SceneError::Stopped { .. })) {
            path.push(".last");
        }
        Ok(scene.checkpoint(description).write(Path::new(&path))?)
    }
}

#[cfg(test)]
mod tests;

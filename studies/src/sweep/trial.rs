//! A run of a sweep and its folder.

use std::fs;
use std::path::PathBuf;

use anyhow::{Context, Result, ensure};
use clap::Parser;
use motile::Setup;
use motile::ib_core::{Checkpoint, SceneError};
use motile_examples::{BoxFlags, SceneFlags, Summary, Taken, WatchedRun, explained, make_directory};

/// A run by the values of the entries that are swept.
#[derive(Debug)]
pub(crate) struct Trial {
    /// The values in short, and the name of the folder.
    pub(crate) label: String,
    pub(crate) folder: PathBuf,
    /// Paths of entries of the scene file and their values.
    pub(crate) values: Vec<(String, serde_json::Value)>,
    pub(crate) setup: Setup,
    pub(crate) time: f64,
}

/// How far a run is.
#[derive(Debug)]
pub(crate) enum State {
    Finished(Summary),
    /// Why it broke off.
    Failed(String),
    /// There is a checkpoint of it.
    Cut,
    Left,
}

/// The flags of a run as on the command line of an example.
#[derive(Debug, Parser)]
struct Line {
    #[command(flatten)]
    scene: SceneFlags<BoxFlags>,
}

impl Trial {
    fn checkpoint(&self) -> PathBuf {
        self.folder.join("checkpoint")
    }

    fn failure(&self) -> PathBuf {
        self.folder.join("failure.txt")
    }

    /// What its folder says. Files that cannot be read are none.
    pub(crate) fn state(&self) -> State {
        if let Ok(Some(summary)) = Summary::read(&self.folder.join("summary.json")) {
            State::Finished(summary)
        } else if let Ok(text) = fs::read_to_string(self.failure()) {
            let known = !text.trim().is_empty();
            State::Failed(if known { text.trim().to_owned() } else { "why could not be written down".to_owned() })
        } else if self.checkpoint().exists() {
            State::Cut
        } else {
            State::Left
        }
    }

    /// Makes the run, from its checkpoint on where there is one.
    ///
    /// # Errors
    /// [`Taken`]; what made the run break off, which is kept in the folder; a folder that has another scene.
    pub(crate) fn run(&self) -> Result<Summary> {
        self.keep(Self::watched)
    }

    /// What comes of `make`; what makes it fail is kept in the folder.
    ///
    /// # Errors
    /// Those of `make`.
    pub(crate) fn keep(&self, make: impl FnOnce(&Self) -> Result<Summary>) -> Result<Summary> {
        make_directory(&self.folder)?;
        let outcome = make(self);
        if let Err(error) = &outcome {
            let stopped = matches!(error.downcast_ref(), Some(SceneError::Stopped { .. }));
            if !stopped && !error.is::<Taken>() {
                // What cannot be kept here is told all the same.
                let _ = fs::write(self.failure(), explained(error) + "\n");
            }
        }
        outcome
    }

    fn watched(&self) -> Result<Summary> {
        self.keep_scene()?;
        let (time, folder, checkpoint) = (self.time.to_string(), self.folder.display(), self.checkpoint());
        let (folder, file) = (folder.to_string(), checkpoint.display().to_string());
        let mut words = vec!["sweep", "--quiet", "--no-pictures", "--time", &time, "--out", &folder];
        words.extend(["--checkpoint", &file]);
        // One that is at the end, or broken, is of no use.
        if Checkpoint::read(&checkpoint).is_ok_and(|saved| saved.time() < self.time) {
            words.extend(["--resume", &file]);
        }
        let Line { scene: flags } = Line::try_parse_from(words)?;
        let mut run = WatchedRun::new(self.setup.build()?, &self.setup, &flags, "sweep")?;
        run.go(None)?;
        let summary = run.measured()?;
        run.outcome()?;
        // It may have failed before.
        let _ = fs::remove_file(self.failure());
        Ok(summary)
    }

    /// Writes the scene file, or makes sure that it is there.
    pub(crate) fn keep_scene(&self) -> Result<()> {
        let path = self.folder.join("scene.toml");
        let text = self.setup.to_toml()?;
        if let Ok(found) =
            fs::read_to_string(&path).map_err(anyhow::Error::from).and_then(|text| Ok(Setup::from_toml(&text)?))
        {
            let same = found == self.setup;
            ensure!(same, "{} is of another plan: give another --out, or remove the folder", path.display());
            return Ok(());
        }
        // It appears only when it is complete.
        let partial = path.with_extension("toml.part");
        let written = fs::write(&partial, text).and_then(|()| fs::rename(&partial, &path));
        written.with_context(|| format!("writing {}", path.display()))
    }
}

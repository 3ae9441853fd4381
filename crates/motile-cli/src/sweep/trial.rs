//! Runs of a sweep and their folders.

use std::fs;
use std::path::PathBuf;

use anyhow::{Context, Result, ensure};
use motile::scene::{SceneError, checkpoint::Checkpoint};
use motile::setup::Setup;
use serde_json::Value;

use super::run_pool::made_again;
use crate::run::{CheckpointFlags, OutputFlags, SceneRun, SpaceRun, Summary, Taken, View, explained, make_directory};

/// Entry of a summary with the [`Trial::fingerprint`] of its run.
pub(super) const FINGERPRINT: &str = "fingerprint";

/// Run of a sweep, identified by the values of the swept entries.
#[derive(Debug, Clone)]
pub struct Trial {
    /// Values of the swept entries in short, which is also the name of the folder.
    pub label: String,
    /// Folder of the files of the run.
    pub folder: PathBuf,
    /// Swept entries: their paths in the scene file and their values.
    pub values: Vec<(String, Value)>,
    /// Setup of the scene, with these values.
    pub setup: Setup,
    /// Time at which the run ends.
    pub time: f64,
}

/// State of a run, by the files in its folder.
#[derive(Debug)]
#[non_exhaustive]
pub enum State {
    /// Run to its end, with these results.
    Finished(Summary),
    /// Failed, for this reason.
    Failed(String),
    /// Interrupted, with a checkpoint to continue from.
    Cut,
    /// Not begun, or without anything to continue from.
    Left,
}

impl Trial {
    fn checkpoint(&self) -> PathBuf {
        self.folder.join("checkpoint")
    }

    fn failure(&self) -> PathBuf {
        self.folder.join("failure.txt")
    }

    fn summary(&self) -> PathBuf {
        self.folder.join("summary.json")
    }

    /// Returns the fingerprint of scene, settings, time and version of the program ([`motile::VERSION`]), by which
    /// results of this run are recognised.
    #[must_use]
    pub fn fingerprint(&self) -> String {
        let (scene, step) = (self.setup.fingerprint(), self.setup.step);
        format!("{scene}, steps {step:?}, to {}, motile {}", self.time, motile::VERSION)
    }

    /// Returns the state of the run, by its folder. Files that cannot be read or have another fingerprint do not count.
    pub fn state(&self) -> State {
        if let Some(summary) = self.results() {
            State::Finished(summary)
        } else if let Some(failure) = fs::read_to_string(self.failure()).ok().and_then(|text| self.why(&text)) {
            State::Failed(failure)
        } else if self.useful_checkpoint().is_some() {
            State::Cut
        } else {
            State::Left
        }
    }

    /// Returns the results in the folder, if they are of this run.
    fn results(&self) -> Option<Summary> {
        let summary = Summary::read(&self.summary()).ok().flatten()?;
        let own = summary.values().get(FINGERPRINT).and_then(Value::as_str) == Some(&self.fingerprint());
        own.then_some(summary)
    }

    /// Returns the version of the program that made the results in the folder, if it is another one than this; none is
    /// known of results without one.
    pub(super) fn other_version(&self) -> Option<Option<String>> {
        let summary = Summary::read(&self.summary()).ok().flatten()?;
        let version = summary.version().map(str::to_owned);
        (version.as_deref() != Some(motile::VERSION)).then_some(version)
    }

    /// Removes results of another run, such as of a plan to another time, and of another version of the program, of
    /// which a note is printed.
    ///
    /// # Errors
    /// Returns an error for a file that cannot be removed.
    pub fn discard_others(&self) -> Result<()> {
        let path = self.summary();
        if path.exists() && self.results().is_none() {
            if let Some(version) = self.other_version() {
                eprintln!("{}", made_again(&path, version.as_deref()));
            }
            fs::remove_file(&path).with_context(|| format!("removing {}, of another run", path.display()))?;
        }
        Ok(())
    }

    /// Returns the failure in the text of its file, if it is of this run. A file could be made but not written to if it
    /// is empty.
    fn why(&self, text: &str) -> Option<String> {
        match text.trim().split_once('\n') {
            Some((failure, own)) => (own == self.fingerprint()).then(|| failure.to_owned()),
            None => Some("why could not be written down".to_owned()),
        }
    }

    /// Returns the name of the run in its checkpoints.
    fn name(&self) -> String {
        format!("sweep, {}", self.fingerprint())
    }

    /// Returns the checkpoint to continue from: not one at the end, broken, or of another run.
    fn useful_checkpoint(&self) -> Option<PathBuf> {
        let saved = Checkpoint::read(&self.checkpoint()).ok()?;
        let own = saved.time() < self.time && saved.description().starts_with(&format!("{}:", self.name()));
        own.then(|| self.checkpoint())
    }

    /// Makes the run, from its checkpoint on if there is one, and returns its results.
    ///
    /// # Errors
    /// Returns [`Taken`]; the failure of the run, which is also written to the folder; a folder that has another scene.
    pub fn run(&self) -> Result<Summary> {
        self.keep(Self::recorded)
    }

    /// Returns the results of `make` with the fingerprint added; a failure is written to the folder.
    ///
    /// # Errors
    /// Returns the errors of `make`.
    pub fn keep(&self, make: impl FnOnce(&Self) -> Result<Summary>) -> Result<Summary> {
        make_directory(&self.folder)?;
        let outcome = make(self);
        if let Err(error) = &outcome {
            let stopped = matches!(error.downcast_ref(), Some(SceneError::Stopped { .. }));
            if !stopped && !error.is::<Taken>() {
                // What cannot be kept here is told all the same.
                let _ = fs::write(self.failure(), format!("{}\n{}\n", explained(error), self.fingerprint()));
            }
        }
        outcome.map(|mut summary| {
            summary.put(FINGERPRINT, self.fingerprint(), "scene, settings, time and version");
            summary
        })
    }

    fn recorded(&self) -> Result<Summary> {
        self.keep_scene()?;
        let (checkpoint, resume) = (Some(self.checkpoint()), self.useful_checkpoint());
        let checkpoints = CheckpointFlags { checkpoint, resume, ..CheckpointFlags::default() };
        let out = Some(self.folder.clone());
        let output = OutputFlags { no_pictures: true, quiet: true, out, checkpoints, ..OutputFlags::default() };
        let (view, built) = (View::of(&self.setup), self.setup.build()?);
        let summary = match built.space {
            Some(body) => {
                let mut run = SpaceRun::new(built.scene, body, &self.setup, self.time, &output, &self.name())?;
                run.go()?;
                let summary = run.summary()?;
                run.outcome()?;
                summary
            }
            None => {
                let mut run = SceneRun::new(built, &self.setup, self.time, &output, &self.name(), &view)?;
                run.go(None)?;
                let summary = run.measured()?;
                run.outcome()?;
                summary
            }
        };
        // It may have failed before.
        let _ = fs::remove_file(self.failure());
        Ok(summary)
    }

    /// Returns true if the folder has the scene file of this run.
    ///
    /// # Errors
    /// Returns an error for a folder that has another scene.
    pub fn check_scene(&self) -> Result<bool> {
        let path = self.folder.join("scene.toml");
        let text = fs::read_to_string(&path).map_err(anyhow::Error::from);
        let Ok(found) = text.and_then(|text| Ok(Setup::from_toml(&text)?)) else { return Ok(false) };
        ensure!(
            found == self.setup,
            "{} belongs to another plan. Use another --out, or remove the folder",
            path.display()
        );
        Ok(true)
    }

    /// Writes the scene file if it does not exist.
    ///
    /// # Errors
    /// Returns an error for a folder that has another scene; a file that cannot be written.
    pub fn keep_scene(&self) -> Result<()> {
        if self.check_scene()? {
            return Ok(());
        }
        let (path, text) = (self.folder.join("scene.toml"), self.setup.to_toml()?);
        // It appears only when it is complete.
        let partial = path.with_extension("toml.part");
        let written = fs::write(&partial, text).and_then(|()| fs::rename(&partial, &path));
        written.with_context(|| format!("writing {}", path.display()))
    }
}

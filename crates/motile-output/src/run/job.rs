//! A run from the first check to the last line, whatever watches it.

use std::fs::{File, TryLockError};
use std::path::PathBuf;
use std::time::Instant;

use super::{OutputFlags, Summary, say};
use crate::RunProgress;
use anyhow::{Result, ensure};
use motile::motile_scene::{Every, Observer, Scene, SceneError, StepSize, System};
use motile::setup::{AnyFlow, Setup};

/// Most steps of a run: more would take weeks.
const MOST_STEPS: f64 = 1e9;
/// Name of the record of the wall clock time.
const CLOCK: &str = "seconds of computation";

/// An observer of a run, and when it is called.
pub type Watch<'a> = (Every, &'a mut dyn Observer<AnyFlow>);

/// Ends a run: what it was to find out is known.
#[derive(Debug, Clone, Copy, thiserror::Error)]
#[error("the run has shown what it was to show")]
pub struct Decided;

/// Another run writes to a directory.
#[derive(Debug)]
pub struct Taken(PathBuf);

impl std::fmt::Display for Taken {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "another run writes to {}: give another --out, or wait for its end", self.0.display())
    }
}

impl std::error::Error for Taken {}

/// A run of a scene: its end, its directory, its checkpoints, its progress and how it went.
#[derive(Debug)]
pub struct Job {
    /// Where the results go.
    pub directory: PathBuf,
    /// Time of its end.
    pub end: f64,
    /// Wall clock time that it took, also before the checkpoint that it goes on from (seconds).
    pub seconds: f64,
    /// What its user should know of it.
    pub warnings: Vec<String>,
    output: OutputFlags,
    description: String,
    outcome: Result<(), SceneError>,
    /// The directory, for this run alone as long as it lasts.
    _lock: File,
}

impl Job {
    /// A run to the time `end` of the scene that was made from `setup`, from the checkpoint that is asked for on. Its
    /// results go where `output` says, by default to `out/<name>/`.
    ///
    /// # Errors
    /// Two files that are one; a time step that is not stable or so short that the run would take more than 1e9 steps,
    /// before anything is written; a checkpoint that does not fit; a file or directory that cannot be made, a directory
    /// that another run writes to ([`Taken`]).
    pub fn new(scene: &mut Scene<AnyFlow>, setup: &Setup, end: f64, output: &OutputFlags, name: &str) -> Result<Self> {
        output.check(name, None)?;
        check_run(scene, end, setup.step)?;
        output.write_scene(setup)?;
        // The time step may change on the way.
        let description = format!("{name}: scene {}", setup.fingerprint());
        output.checkpoints.resume(scene, &description, end)?;
        let (directory, output) = (output.directory(name)?, output.clone());
        let lock = File::open(&directory)?;
        if matches!(lock.try_lock(), Err(TryLockError::WouldBlock)) {
            return Err(Taken(directory).into());
        }
        let (seconds, warnings, outcome) = (0.0, Vec::new(), Ok(()));
        Ok(Self { directory, end, seconds, warnings, output, description, outcome, _lock: lock })
    }

    /// Whether pictures are wanted.
    #[must_use]
    pub fn draws(&self) -> bool {
        !self.output.no_pictures
    }

    /// Runs to the end, or until an observer ends it by the error [`Decided`] or it breaks off.
    ///
    /// # Errors
    /// Checkpoints that cannot be written. Why a run broke off is kept for [`Job::finish`].
    pub fn go(&mut self, scene: &mut Scene<AnyFlow>, observers: Vec<Watch<'_>>) -> Result<()> {
        let Self { output, description, .. } = self;
        let mut progress = RunProgress::new(self.end, output.quiet);
        let (started, seconds) = (Instant::now(), |system: &System<AnyFlow>| {
            system.record(CLOCK).and_then(|clock| clock.numbers.first().copied()).unwrap_or_default()
        });
        let earlier = seconds(scene.system());
        let mut clock = |system: &mut System<AnyFlow>| -> Result<()> {
            let numbers = &mut system.record_mut(CLOCK).numbers;
            numbers.clear();
            numbers.push(earlier + started.elapsed().as_secs_f64());
            Ok(())
        };
        let run = scene.run(self.end).observe(Every::Steps(1), &mut progress).observe(Every::Steps(1), &mut clock);
        let run = observers.into_iter().fold(run, |run, (every, observer)| run.observe(every, observer));
        self.outcome = match output.checkpoints.watch(run, description)?.go() {
            Err(SceneError::Observer { source, .. }) if source.is::<Decided>() => Ok(()),
            outcome => outcome,
        };
        progress.finish();
        self.seconds = seconds(scene.system());
        self.warnings =
            progress.warnings().worst().iter().map(|(time, text)| format!("t = {time:.3}: {text}")).collect();
        output.checkpoints.save(scene, description, &self.outcome)
    }

    /// Whether the run was stopped, to be gone on with.
    #[must_use]
    pub fn is_stopped(&self) -> bool {
        matches!(self.outcome, Err(SceneError::Stopped { .. }))
    }

    /// Ends without another word.
    ///
    /// # Errors
    /// What made the run break off.
    pub fn outcome(self) -> Result<(), SceneError> {
        self.outcome
    }

    /// Why the run broke off, if it did.
    #[must_use]
    pub fn failure(&self) -> Option<String> {
        self.outcome.as_ref().err().map(SceneError::explanation)
    }

    /// Writes `summary.json` and prints its table, draws what `pictures` draws, and ends as the run ended.
    ///
    /// # Errors
    /// What made the run break off; files that cannot be written.
    pub fn finish(self, summary: &Summary, pictures: impl FnOnce() -> Result<()>) -> Result<()> {
        summary.write(&self.directory.join("summary.json"))?;
        say(summary.table().trim_end());
        pictures()?;
        say(format_args!("results in {}", self.directory.display()));
        Ok(self.outcome?)
    }
}

/// Refuses a run that could not start with its time step, or could not end in a lifetime.
fn check_run(scene: &Scene<AnyFlow>, end: f64, step: StepSize) -> Result<()> {
    let dt = match step {
        StepSize::Fixed(dt) => dt,
        StepSize::OfLimit(fraction) => scene.step_limit().map_or(end, |(limit, ..)| fraction * limit),
        _ => end,
    };
    ensure!(
        end / dt <= MOST_STEPS,
        "time {end} would take {:.0e} steps of {dt:.1e}: give a higher viscosity, a larger spacing or a shorter time",
        end / dt
    );
    if let StepSize::Fixed(dt) = step { Ok(scene.check_step(dt)?) } else { Ok(()) }
}

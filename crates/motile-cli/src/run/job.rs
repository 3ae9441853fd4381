//! Runs from the check of their settings to the written summary, with any observers.

use std::fs::{File, TryLockError};
use std::path::PathBuf;
use std::time::Instant;

use super::{ORIGIN_KEY, command, flags::OutputFlags, say, summary::Summary};
use anyhow::{Result, ensure};
use motile::base::internal::decimals;
use motile::scene::{Every, Observer, Scene, SceneError, StepSize, System};
use motile::setup::{AnyFlow, DropletShape, Setup, Squeezed};
use motile_output::{Look, RunProgress};

/// Most steps of a run: more would take weeks.
const MOST_STEPS: f64 = 1e9;
/// Rows of tables in a run.
const ROWS: u32 = 1000;
/// Name of the record of the computing time.
const CLOCK: &str = "seconds of computation";

/// Observer of a run, with the times at which it is called.
pub type Watch<'a> = (Every, &'a mut dyn Observer<AnyFlow>);

/// Error by which an observer ends a run early that has shown its result: no failure.
#[derive(Debug, Clone, Copy, thiserror::Error)]
#[error("the run has shown what it was to show")]
pub struct Decided;

/// Error of a run whose directory is in use by another run.
#[derive(Debug)]
pub struct Taken(PathBuf);

impl std::fmt::Display for Taken {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "another run is writing to {}. Use another --out, or wait until that run has ended", self.0.display())
    }
}

impl std::error::Error for Taken {}

/// Run of a scene, with its directory, end, checkpoints, progress and outcome.
#[derive(Debug)]
pub struct Job {
    /// Directory of the results.
    pub directory: PathBuf,
    /// Time at which the run ends.
    pub end: f64,
    /// Computing time (seconds of wall clock), including the time before the checkpoint from which the run continues.
    pub seconds: f64,
    /// Warnings, each with the time at which it was worst.
    pub warnings: Vec<String>,
    output: OutputFlags,
    description: String,
    /// Fraction of the region's area that the droplets of suspensions fill.
    filled: Option<f64>,
    /// Largest distance of a shape that is given by points from their polygon (length).
    off_points: Option<f64>,
    outcome: Result<(), SceneError>,
    /// Lock on the directory, which keeps other runs out.
    _lock: File,
}

impl Job {
    /// Creates a run to the time `end` of the scene that was built from `setup`, from the checkpoint in `output` on if
    /// there is one. Its results go to the directory in `output`, by default to `out/<name>/`.
    ///
    /// # Errors
    /// Before anything is written: two paths of the same file, a time step that is unstable or so short that the run
    /// would take more than 1e9 steps. Then: a checkpoint of another scene, a file or directory that cannot be created,
    /// a directory in use by another run ([`Taken`]).
    pub fn new(scene: &mut Scene<AnyFlow>, setup: &Setup, end: f64, output: &OutputFlags, name: &str) -> Result<Self> {
        output.check(name, None)?;
        check_run(scene, end, setup.step)?;
        output.write_scene(setup)?;
        // The time step may change on the way.
        let description = format!("{name}: scene {}", setup.fingerprint());
        output.checkpoints.resume(scene, &description, end)?;
        scene.system_mut().set_origin(format!("{}; command: {}", setup.origin(), command()));
        let (directory, output) = (output.directory(name)?, output.clone());
        let lock = File::open(&directory)?;
        if matches!(lock.try_lock(), Err(TryLockError::WouldBlock)) {
            return Err(Taken(directory).into());
        }
        let filled = setup.filled()?;
        if let Some(filled) = filled.filter(|_| !output.quiet) {
            say(format_args!("the droplets fill {filled:.4} of the region's area"));
        }
        if !output.quiet {
            squeezed_droplets(setup)?.iter().for_each(say);
        }
        let mut off_points: Option<f64> = None;
        for (key, distance) in setup.distances_from_points()? {
            off_points = Some(off_points.map_or(distance, |most| most.max(distance)));
            if !output.quiet {
                say(format_args!("{key}: the curve through them is up to {distance:.2e} away from their polygon"));
            }
        }
        let (seconds, warnings, outcome) = (0.0, Vec::new(), Ok(()));
        Ok(Self { directory, end, seconds, warnings, output, description, filled, off_points, outcome, _lock: lock })
    }

    /// Returns true if pictures are to be drawn.
    #[must_use]
    pub fn draws(&self) -> bool {
        !self.output.no_pictures
    }

    /// Returns the settings of pictures, with those that were asked for in their place.
    #[must_use]
    pub fn look(&self, look: Look) -> Look {
        self.output.look.apply(look)
    }

    /// Returns the times of the rows of tables: as many over the run as were asked for, else 1000.
    #[must_use]
    pub fn each_row(&self) -> Every {
        self.each(f64::from(self.output.rows.unwrap_or(ROWS)))
    }

    /// So many equal times over the run.
    pub(super) fn each(&self, count: f64) -> Every {
        Every::StepAfter(self.end / count)
    }

    /// Runs to the end, to an observer's error [`Decided`], or to a failure.
    ///
    /// # Errors
    /// Returns an error if a checkpoint cannot be written. The failure of the run itself is returned by
    /// [`Job::finish`].
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
        self.warnings = progress
            .warnings()
            .worst()
            .iter()
            .map(|(time, text)| format!("t = {}: {text}", decimals(3, *time)))
            .collect();
        output.checkpoints.save(scene, description, &self.outcome)
    }

    /// Returns true if the run was stopped by a signal: it can continue from its checkpoint.
    #[must_use]
    pub fn is_stopped(&self) -> bool {
        matches!(self.outcome, Err(SceneError::Stopped { .. }))
    }

    /// Returns the outcome of the run, without any files.
    ///
    /// # Errors
    /// Returns an error for the failure of the run.
    pub fn outcome(self) -> Result<(), SceneError> {
        self.outcome
    }

    /// Returns the explanation of the failure of the run, if it failed.
    #[must_use]
    pub fn failure(&self) -> Option<String> {
        self.outcome.as_ref().err().map(SceneError::explanation)
    }

    /// Adds what the run has cost to a summary: steps and their lengths, evaluations of the flow, computing time; its
    /// warnings, and its failure if it failed.
    pub fn put_cost(&self, summary: &mut Summary, scene: &Scene<AnyFlow>) {
        if let Some(filled) = self.filled {
            summary.put("area_fraction", filled, "of the droplets at the start");
        }
        if let Some(distance) = self.off_points {
            summary.put("distance_from_points", distance, "of curves through points from their polygons (length)");
        }
        summary.put("time", scene.time(), "simulated");
        summary.put("steps", scene.steps(), "");
        summary.put("dt", scene.time() / scene.steps() as f64, "mean time step");
        let report = scene.step_report();
        summary.put("dt_shortest", report.shortest, "");
        summary.put("dt_longest", report.longest, "");
        let limiting = report.most_limiting().map(|limiting| match limiting.body.as_str() {
            "" => limiting.reason.clone(),
            body => format!("{} of {body}", limiting.reason),
        });
        summary.put("dt_set_by", limiting, "for most steps");
        summary.put(
            "step_error",
            report.largest_error,
            "largest estimate of a step's, in parts of the radius and of c0",
        );
        summary.put("steps_rejected", report.rejections, "for their error");
        summary.put("steps_failed", report.failures, "and retried");
        summary.put("stages", scene.integrator_work().stages, "of all steps");
        let work = scene.system().work();
        summary.put("evaluations", work.evaluations, "of the flow");
        summary.put("stokes_solves", work.stokes_solves, "on the grid");
        let mean = work.iterations as f64 / work.evaluations.max(1) as f64;
        summary.put("solver_iterations_mean", mean, "of an evaluation of the flow");
        summary.put("solver_iterations_max", work.most_iterations, "");
        summary.put("seconds", self.seconds, "of computation");
        summary.put("warnings", self.warnings.clone(), "");
        summary.put(ORIGIN_KEY, scene.system().origin(), "of the results");
        let failure = self.failure();
        summary.put("finished", failure.is_none(), "");
        if let Some(failure) = failure {
            summary.put("failure", failure, "");
        }
    }

    /// Writes `summary.json`, prints its table, calls `pictures` to draw, and returns the outcome of the run.
    ///
    /// # Errors
    /// Returns an error for the failure of the run; files that cannot be written.
    pub fn finish(self, summary: &Summary, pictures: impl FnOnce() -> Result<()>) -> Result<()> {
        summary.write(&self.directory.join("summary.json"))?;
        say(summary.table().trim_end());
        pictures()?;
        say(format_args!("results in {}", self.directory.display()));
        Ok(self.outcome?)
    }
}

/// Refuses a run with an unstable time step or more than [`MOST_STEPS`] steps.
fn check_run(scene: &Scene<AnyFlow>, end: f64, step: StepSize) -> Result<()> {
    let dt = match step {
        StepSize::Fixed(dt) => dt,
        StepSize::OfLimit(fraction) => scene.step_limit().map_or(end, |(limit, ..)| fraction * limit),
        _ => end,
    };
    ensure!(
        end / dt <= MOST_STEPS,
        "time {end} would take {:.0e} steps of {dt:.1e}. Use a higher viscosity, a larger spacing or a shorter time",
        end / dt
    );
    if let StepSize::Fixed(dt) = step { Ok(scene.check_step(dt)?) } else { Ok(()) }
}

/// Returns a note for each round droplet of a description that starts squeezed.
fn squeezed_droplets(setup: &Setup) -> Result<Vec<String>> {
    let mut notes = Vec::new();
    for (number, droplet) in setup.droplets.iter().enumerate() {
        let (DropletShape::Round { .. }, DropletShape::Squeezed { half_height, to, .. }) =
            (&droplet.shape, setup.shape(droplet)?)
        else {
            continue;
        };
        let shape = if to == Squeezed::Ellipse { "an ellipse" } else { "a stadium" };
        notes.push(format!(
            "droplets[{number}] starts as {shape} of half height {half_height:.3}, because the walls on both sides \
             leave it no more room"
        ));
    }
    Ok(notes)
}

//! Runs of many steps, watched by observers.

use std::path::Path;
use std::sync::atomic::{AtomicBool, Ordering};

use motile_base::{not_negative, positive, within};

use crate::{Hydrodynamics, Scene, SceneError, StepSize, System, integrator::Dynamics as _};

/// Records data while a scene runs.
///
/// Closures `FnMut(&mut System<H>) -> Result<(), E>` are observers if `E: Into<Box<dyn Error + Send + Sync>>`, for
/// example [`SceneError`], `String` or `Infallible`. Name the type of the argument, because the compiler cannot infer
/// that the closure accepts a borrow of any lifetime.
///
/// ```
/// use motile_base::Vec2;
/// use motile_scene::{Every, MarkerBody, PrescribedFlow, Scene, SceneError, StepSize, System};
///
/// # fn main() -> Result<(), SceneError> {
/// // A marker moves with a flow of speed 2 along x.
/// let mut scene = Scene::new(PrescribedFlow::new(|_| Vec2::new(2.0, 0.0)));
/// let marker = scene.add(MarkerBody::new("marker", vec![Vec2::ZERO], |_, _| {}));
/// let mut seen = Vec::new();
/// let mut watch = |system: &mut System<PrescribedFlow>| {
///     seen.push((system.time(), system.body(marker)?.markers()[0].x));
///     Ok::<(), SceneError>(())
/// };
/// scene.run(1.0).step_size(StepSize::Fixed(0.25)).observe(Every::Steps(1), &mut watch).go()?;
/// assert_eq!(seen.len(), 5);
/// assert!(seen.iter().all(|(time, x)| (x - 2.0 * time).abs() < 1e-12));
/// # Ok(())
/// # }
/// ```
pub trait Observer<H> {
    /// Records the system; runs at the start of a run, when due, and at its end. It may evaluate and sample the flow;
    /// it cannot change the bodies.
    ///
    /// # Errors
    /// Returns whatever goes wrong; the run ends with [`SceneError::Observer`].
    fn observe(&mut self, system: &mut System<H>) -> Result<(), Box<dyn std::error::Error + Send + Sync>>;
}

impl<H, E, F> Observer<H> for F
where
    E: Into<Box<dyn std::error::Error + Send + Sync>>,
    F: FnMut(&mut System<H>) -> Result<(), E>,
{
    fn observe(&mut self, system: &mut System<H>) -> Result<(), Box<dyn std::error::Error + Send + Sync>> {
        self(system).map_err(Into::into)
    }
}

/// Times at which an observer is called.
#[derive(Debug, Clone, Copy, PartialEq)]
#[non_exhaustive]
pub enum Every {
    /// After every n steps (0 counts as 1).
    Steps(usize),
    /// At all multiples of this time, exactly: steps are shortened to end there as they are at the end of a run. At
    /// most ten million of them a run. Multiples are counted from time 0, so that a resumed run continues with them.
    Time(f64),
    /// At the end of the first step that reaches a multiple of this time, counted from time 0; no step is shortened for
    /// it.
    StepAfter(f64),
}

struct Watch<'a, H> {
    every: Every,
    /// Multiples of the interval that have been reached.
    reached: f64,
    observer: &'a mut dyn Observer<H>,
}

/// Most steps of a run, at the length of the first: more would take years.
const MOST_STEPS: f64 = 1e10;
/// Most reports of an observer at exact times.
const MOST_REPORTS: f64 = 1e7;
/// Fraction of an interval that is taken for round-off of the summed steps.
const NEGLIGIBLE: f64 = 1e-9;

impl Every {
    /// How many whole intervals have gone by at `time`.
    fn reached(self, time: f64) -> f64 {
        match self {
            Self::Steps(_) => 0.0,
            Self::Time(interval) | Self::StepAfter(interval) => (time / interval + NEGLIGIBLE).floor(),
        }
    }
}

/// A run being set up; see [`Scene::run`].
pub struct Run<'a, H> {
    scene: &'a mut Scene<H>,
    start: f64,
    until: f64,
    step: StepSize,
    least: Option<f64>,
    most: usize,
    watches: Vec<Watch<'a, H>>,
    saver: Option<Saver<'a>>,
    stop: Option<&'a AtomicBool>,
}

/// When and where checkpoints are saved.
struct Saver<'a> {
    every: usize,
    path: &'a Path,
    description: &'a str,
}

impl<H: std::fmt::Debug> std::fmt::Debug for Run<'_, H> {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("Run").field("until", &self.until).field("step", &self.step).finish_non_exhaustive()
    }
}

/// Adaptive steps take at most this fraction of the stability limit.
const OF_LIMIT: f64 = 0.9;
/// The first adaptive step, as part of the stability limit.
const FIRST: f64 = 0.05;
/// The shortest step unless the run says otherwise, as part of the first limit.
const LEAST: f64 = 1e-6;

impl<H: Hydrodynamics> Scene<H> {
    /// Returns a run up to time `until` (time), to be given a time step and observers.
    ///
    /// A scene without bodies, or whose bodies have no markers, has nothing to resolve. If steps are a fraction of the
    /// stability limit, as by default, it takes a single one to the end or to the next exact report.
    pub fn run(&mut self, until: f64) -> Run<'_, H> {
        Run::new(self, until)
    }
}

impl<'a, H: Hydrodynamics> Run<'a, H> {
    pub(crate) fn new(scene: &'a mut Scene<H>, until: f64) -> Self {
        let (start, step) = (scene.time(), scene.step_size());
        Self { scene, start, until, step, least: None, most: usize::MAX, watches: Vec::new(), saver: None, stop: None }
    }

    /// Sets the time step (default: the scene's, [`Scene::step_size`]).
    #[must_use]
    pub fn step_size(mut self, step: StepSize) -> Self {
        self.step = step;
        self
    }

    /// Sets the shortest step (time) that automatic and adaptive steps may fall to; below it the run ends with
    /// [`SceneError::Stagnation`]. By default, a millionth of the stability limit at the start.
    #[must_use]
    pub fn least_step(mut self, least: f64) -> Self {
        self.least = Some(least);
        self
    }

    /// Sets the number of steps after which the run ends with [`SceneError::TooManySteps`]; by default there is none.
    #[must_use]
    pub fn most_steps(mut self, most: usize) -> Self {
        self.most = most;
        self
    }

    /// Saves a checkpoint with that description to `path` after every `every` steps of the scene (0 counts as 1), and
    /// once more when the run is stopped by a flag ([`Run::stop_on`]) or by its number of steps ([`Run::most_steps`]).
    /// Each takes the place of the last one, which stays until the new one is complete. What is saved has no influence
    /// on the run.
    #[must_use]
    pub fn save(mut self, every: usize, path: &'a Path, description: &'a str) -> Self {
        self.saver = Some(Saver { every: every.max(1), path, description });
        self
    }

    /// Ends the run with [`SceneError::Stopped`] after the step during which `flag` becomes true.
    #[must_use]
    pub fn stop_on(mut self, flag: &'a AtomicBool) -> Self {
        self.stop = Some(flag);
        self
    }

    /// Adds an observer.
    #[must_use]
    pub fn observe(mut self, every: Every, observer: &'a mut dyn Observer<H>) -> Self {
        self.watches.push(Watch { every, reached: 0.0, observer });
        self
    }

    /// Starts the run. After an error, the scene holds the last good state.
    ///
    /// # Errors
    /// Returns an error for a time or time step that makes no sense or is above the stability limit, before any work;
    /// the errors of [`Scene::step`] and of observers.
    pub fn go(mut self) -> Result<(), SceneError> {
        self.check()?;
        self.start = self.scene.time();
        if self.until - self.start > self.negligible() && self.scene.system().is_unmoved() {
            // What the first bound on the step looks at: how fast particles are carried, for one. Later ones look at
            // the step before, also of a run that goes on.
            let mut rate = vec![0.0; self.scene.system().state_len()];
            self.scene.system_mut().present_rate(&mut rate)?;
        }
        self.notify(true)?;
        let least = self.least.unwrap_or_else(|| LEAST * self.limit().map_or(self.until - self.start, |(dt, ..)| dt));
        let mut taken = 0_usize;
        while self.until - self.scene.time() > self.negligible() {
            if taken >= self.most {
                self.save_once_more()?;
                return Err(SceneError::TooManySteps { time: self.scene.time(), most: self.most });
            }
            self.advance(least)?;
            taken += 1;
            self.notify(false)?;
            if self.is_due() {
                self.write_checkpoint()?;
            }
            if self.stop.is_some_and(|flag| flag.load(Ordering::Relaxed)) {
                self.save_once_more()?;
                return Err(SceneError::Stopped { time: self.scene.time() });
            }
        }
        Ok(())
    }

    /// Returns true if a checkpoint is saved after the present number of steps.
    fn is_due(&self) -> bool {
        self.saver.as_ref().is_some_and(|saver| self.scene.steps().is_multiple_of(saver.every))
    }

    /// Saves the state in which a run stops before its end, unless that has just been done.
    fn save_once_more(&self) -> Result<(), SceneError> {
        if self.is_due() { Ok(()) } else { self.write_checkpoint() }
    }

    fn write_checkpoint(&self) -> Result<(), SceneError> {
        let Some(saver) = &self.saver else { return Ok(()) };
        let saved = self.scene.checkpoint(saver.description).write(saver.path);
        saved.map_err(|source| SceneError::Checkpoint { time: self.scene.time(), source: Box::new(source) })
    }

    /// Takes one step, as often as it needs.
    fn advance(&mut self, least: f64) -> Result<(), SceneError> {
        let mut cause = None;
        loop {
            let time = self.scene.time();
            let goal = self.goal();
            let remaining = goal - time;
            let (wanted, reason, body) = self.length(remaining)?;
            // The last two steps share what is left, so that none is tiny.
            let dt = if remaining <= wanted * (1.0 + 1e-9) {
                remaining
            } else if remaining < 2.0 * wanted && !matches!(self.step, StepSize::Fixed(_)) {
                0.5 * remaining
            } else {
                wanted
            };
            if !matches!(self.step, StepSize::Fixed(_)) && (wanted.is_nan() || wanted < least) {
                return Err(SceneError::Stagnation { time, dt: wanted, least, source: cause.map(Box::new) });
            }
            let Some(tolerance) = self.tolerance() else {
                self.scene.step(dt)?;
                self.scene.report.count(dt, dt < wanted, reason, &body);
                return self.arrive(dt, remaining, goal);
            };
            match self.scene.attempt(dt, Some(tolerance)) {
                Ok(error) => {
                    let shortened = dt < wanted;
                    let next = self.scene.control.next;
                    if self.scene.control.judge(dt, error) {
                        // Without a limit of stability all that is left until the next report is wanted.
                        if shortened || (dt == remaining && dt < next) {
                            // Where a step has to end says nothing about the steps that follow.
                            self.scene.control.next = next.max(self.scene.control.next);
                        }
                        let report = &mut self.scene.report;
                        report.count(dt, shortened, reason, &body);
                        report.largest_error = report.largest_error.max(error * tolerance);
                        return self.arrive(dt, remaining, goal);
                    }
                    self.scene.report.rejections += 1;
                    cause = None;
                }
                Err(error @ (SceneError::Flow { .. } | SceneError::Body { .. } | SceneError::Crossing { .. })) => {
                    self.scene.report.failures += 1;
                    self.scene.control.retreat(dt);
                    cause = Some(error);
                }
                Err(error) => return Err(error),
            }
        }
    }

    /// Returns the largest error of a step, where errors are estimated.
    fn tolerance(&self) -> Option<f64> {
        match self.step {
            StepSize::Fixed(_) => None,
            StepSize::OfLimit(_) => self.scene.integrator().error_bound(),
            StepSize::Adaptive { tolerance } => Some(tolerance),
        }
    }

    /// Returns the remainder of a run (time) below which it is round-off of the summed steps.
    fn negligible(&self) -> f64 {
        NEGLIGIBLE * self.until.abs().max(f64::MIN_POSITIVE)
    }

    /// Returns the next time that a step has to end at. It is the time of a report or the end of the run.
    fn goal(&self) -> f64 {
        let due = self.watches.iter().filter_map(|watch| match watch.every {
            Every::Time(interval) => Some((watch.reached + 1.0) * interval),
            Every::Steps(_) | Every::StepAfter(_) => None,
        });
        let next = due.fold(f64::INFINITY, f64::min);
        if next < self.until - self.negligible() { next } else { self.until }
    }

    /// A step of length `dt` that had to take `remaining` ends at `goal`, without round-off.
    fn arrive(&mut self, dt: f64, remaining: f64, goal: f64) -> Result<(), SceneError> {
        if dt == remaining { self.scene.system_mut().set_time(goal) } else { Ok(()) }
    }

    /// Returns the bound on the next step (time), what sets it, and of which body; `None` if there is none.
    fn limit(&self) -> Option<(f64, &'static str, String)> {
        let limit = self.scene.step_limit().filter(|(dt, ..)| !dt.is_infinite());
        limit.map(|(dt, reason, body)| (dt, reason, body.to_owned()))
    }

    /// Returns the length of the next step (time) if it need not end after `remaining`, what sets it, and of which
    /// body.
    fn length(&mut self, remaining: f64) -> Result<(f64, &'static str, String), SceneError> {
        if let StepSize::Fixed(dt) = self.step {
            self.scene.check_step(dt)?;
            return Ok((dt, "the run", String::new()));
        }
        let part = if let StepSize::OfLimit(fraction) = self.step { fraction } else { OF_LIMIT };
        self.check_limit()?;
        let stable = match self.limit() {
            Some((dt, reason, body)) => (part * dt, reason, body),
            None => (remaining, "the end of the run", String::new()),
        };
        if self.tolerance().is_some() && self.scene.system().state_len() > 0 {
            let control = &mut self.scene.control;
            if control.next <= 0.0 {
                control.next = FIRST * stable.0;
            }
            if control.next < stable.0 {
                return Ok((control.next, "accuracy", String::new()));
            }
        }
        Ok(stable)
    }

    fn check(&mut self) -> Result<(), SceneError> {
        if self.until < self.scene.time() {
            return Err(SceneError::ends_before(self.until, self.scene.time()));
        }
        let length = not_negative("the time to the end of the run", self.until - self.scene.time())?;
        not_negative("the shortest step", self.least.unwrap_or_default())?;
        for watch in &self.watches {
            let name = "the interval of an observer";
            if let Every::Time(interval) | Every::StepAfter(interval) = watch.every {
                positive(name, interval)?;
            }
            if let Every::Time(interval) = watch.every {
                within(name, interval, length / MOST_REPORTS, f64::INFINITY)?;
            }
        }
        if self.tolerance().is_some() && self.scene.integrator().error_constant().is_none() {
            let integrator = self.scene.integrator().name();
            return Err(SceneError::no_error_estimate(integrator));
        }
        self.step.check()?;
        let least = length / MOST_STEPS;
        match self.step {
            StepSize::Fixed(dt) => {
                self.scene.check_step(dt)?;
                within("the time step", dt, least, f64::INFINITY)?;
            }
            StepSize::OfLimit(_) | StepSize::Adaptive { .. } => {
                self.check_limit()?;
                if let Some((dt, reason, body)) = self.limit().filter(|(dt, ..)| dt.is_nan() || *dt < least) {
                    return Err(SceneError::step_too_short(dt, least, reason, &body));
                }
            }
        }
        Ok(())
    }

    /// Refuses a step size that is a fraction of the stability limit if nothing that moves has one.
    fn check_limit(&mut self) -> Result<(), SceneError> {
        if !matches!(self.step, StepSize::OfLimit(_)) || self.scene.system().state_len() == 0 {
            return Ok(());
        }
        let unknown = |scene: &Scene<H>| scene.stable_step().is_none_or(|(dt, ..)| dt.is_infinite());
        if unknown(self.scene) {
            // Some limits are those of the flow, which may not be known yet.
            self.scene.system_mut().evaluate()?;
        }
        if unknown(self.scene) {
            return Err(SceneError::no_step_limit(self.scene.time()));
        }
        Ok(())
    }

    fn notify(&mut self, first: bool) -> Result<(), SceneError> {
        let (time, steps) = (self.scene.time(), self.scene.steps());
        let last = self.until - time <= self.negligible();
        for watch in &mut self.watches {
            let reached = watch.every.reached(time);
            let due = match watch.every {
                Every::Steps(n) => steps.is_multiple_of(n.max(1)),
                // An interval too short to be counted is over at any time.
                Every::Time(_) | Every::StepAfter(_) => reached > watch.reached || reached.is_infinite(),
            };
            watch.reached = reached;
            if due || first || last {
                watch
                    .observer
                    .observe(self.scene.system_mut())
                    .map_err(|source| SceneError::Observer { time, source })?;
            }
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests;

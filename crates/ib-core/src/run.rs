//! Runs of many steps, watched by observers.

use crate::{Hydrodynamics, Integrator, Scene, SceneError, System};

/// Looks on while a scene runs. Closures `FnMut(&mut System<H>) -> Result<(), E>` are observers.
pub trait Observer<H> {
    /// Called at the start of a run, when due, and at its end. It may evaluate and sample the flow; it cannot change
    /// the bodies.
    ///
    /// # Errors
    /// Whatever goes wrong; the run ends with [`SceneError::Observer`].
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

/// When an observer is called.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Every {
    /// After every n steps (0 counts as 1).
    Steps(usize),
    /// At the end of the first step that reaches a multiple of this time.
    Time(f64),
}

/// How long the steps of a run are.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum StepSize {
    /// All of this length (time); refused at the start if above the stability limit, and an error during the run if the
    /// limit falls below it.
    Fixed(f64),
    /// This fraction of the stability limit at each step.
    OfLimit(f64),
}

impl Default for StepSize {
    fn default() -> Self {
        Self::OfLimit(0.5)
    }
}

struct Watch<'a, H> {
    every: Every,
    due: f64,
    observer: &'a mut dyn Observer<H>,
}

/// A run being set up; see [`Scene::run`].
pub struct Run<'a, H, I> {
    scene: &'a mut Scene<H, I>,
    until: f64,
    step: StepSize,
    watches: Vec<Watch<'a, H>>,
}

impl<H: std::fmt::Debug, I: std::fmt::Debug> std::fmt::Debug for Run<'_, H, I> {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("Run").field("until", &self.until).field("step", &self.step).finish_non_exhaustive()
    }
}

/// Steps between two checks of the stability limits during a run: the limits change with the state, slowly.
const STEPS_PER_CHECK: usize = 20;

impl<'a, H: Hydrodynamics, I: Integrator> Run<'a, H, I> {
    pub(crate) fn new(scene: &'a mut Scene<H, I>, until: f64) -> Self {
        let step = scene.step_size();
        Self { scene, until, step, watches: Vec::new() }
    }

    /// Sets the time step (default: the scene's, [`Scene::step_size`]).
    #[must_use]
    pub fn step_size(mut self, step: StepSize) -> Self {
        self.step = step;
        self
    }

    /// Adds an observer.
    #[must_use]
    pub fn observe(mut self, every: Every, observer: &'a mut dyn Observer<H>) -> Self {
        self.watches.push(Watch { every, due: 0.0, observer });
        self
    }

    /// Runs. After an error the scene holds the last good state.
    ///
    /// # Errors
    /// A time or time step that makes no sense or is above the stability limit, before any work; those of
    /// [`Scene::step`]; those of observers.
    pub fn go(mut self) -> Result<(), SceneError> {
        self.check()?;
        let start = self.scene.time();
        for watch in &mut self.watches {
            if let Every::Time(interval) = watch.every {
                watch.due = start + interval;
            }
        }
        self.notify(true)?;
        let mut taken = 0_usize;
        // A remainder below this is round-off of the summed steps.
        let negligible = 1e-9 * self.until.abs().max(f64::MIN_POSITIVE);
        while self.until - self.scene.time() > negligible {
            let remaining = self.until - self.scene.time();
            let dt = match self.step {
                StepSize::Fixed(dt) => {
                    if taken > 0 && taken.is_multiple_of(STEPS_PER_CHECK) {
                        self.scene.check_step(dt)?;
                    }
                    dt
                }
                StepSize::OfLimit(fraction) => match self.scene.system().step_limit() {
                    Some((limit, _)) if limit.dt.is_finite() => fraction * limit.dt,
                    _ => remaining,
                },
            };
            // The last two steps share what is left, so that none is tiny.
            let dt = if remaining <= dt * (1.0 + 1e-9) {
                remaining
            } else if remaining < 2.0 * dt && matches!(self.step, StepSize::OfLimit(_)) {
                0.5 * remaining
            } else {
                dt
            };
            self.scene.step(dt)?;
            taken += 1;
            self.notify(false)?;
        }
        Ok(())
    }

    fn check(&self) -> Result<(), SceneError> {
        let time = self.scene.time();
        if !(self.until.is_finite() && self.until >= time) {
            let remedy = "a finite time that is not in the past";
            return Err(SceneError::Time { name: "the end of the run", value: self.until, remedy });
        }
        for watch in &self.watches {
            if let Every::Time(value) = watch.every
                && !(value.is_finite() && value > 0.0)
            {
                let remedy = "a positive finite number";
                return Err(SceneError::Time { name: "the interval of an observer", value, remedy });
            }
        }
        match self.step {
            StepSize::Fixed(dt) => self.scene.check_step(dt),
            StepSize::OfLimit(fraction) if !(fraction > 0.0 && fraction <= 1.0) => {
                let remedy = "a number above 0 and at most 1";
                Err(SceneError::Time { name: "the fraction of the stable step", value: fraction, remedy })
            }
            StepSize::OfLimit(_) => Ok(()),
        }
    }

    fn notify(&mut self, first: bool) -> Result<(), SceneError> {
        let (time, steps) = (self.scene.time(), self.scene.steps());
        let last = self.until - time <= 1e-9 * self.until.abs();
        for watch in &mut self.watches {
            let due = match watch.every {
                Every::Steps(n) => steps.is_multiple_of(n.max(1)),
                Every::Time(interval) => {
                    let due = time >= watch.due - 1e-9 * interval;
                    while due && watch.due <= time + 1e-9 * interval {
                        watch.due += interval;
                    }
                    due
                }
            };
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

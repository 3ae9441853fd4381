//! Scenes: bodies in a fluid, advanced in time.

use std::marker::PhantomData;

use crate::{Body, Hydrodynamics, Integrator, Midpoint, Run, SceneError, StepSize, System};

/// Where a body of type B stands in its scene.
pub struct Handle<B> {
    index: usize,
    body: PhantomData<fn() -> B>,
}

// Derived implementations would ask B to be copied and printed too.
impl<B> Clone for Handle<B> {
    fn clone(&self) -> Self {
        *self
    }
}
impl<B> Copy for Handle<B> {}
impl<B> std::fmt::Debug for Handle<B> {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "Handle({})", self.index)
    }
}

impl<B> Handle<B> {
    /// Number of the body, in the order of addition; also that of its group in [`System::markers`].
    #[must_use]
    pub fn index(&self) -> usize {
        self.index
    }
}

/// Bodies coupled by a fluid, and the integrator that advances them.
#[derive(Debug)]
pub struct Scene<H, I = Midpoint> {
    system: System<H>,
    integrator: I,
    step_size: StepSize,
    saved: Vec<f64>,
    saved_lengths: Vec<usize>,
}

impl<H: Hydrodynamics> Scene<H> {
    /// A scene without bodies, advanced by the midpoint rule.
    #[must_use]
    pub fn new(hydrodynamics: H) -> Self {
        Self::with_integrator(hydrodynamics, Midpoint::default())
    }
}

impl<H: Hydrodynamics, I: Integrator> Scene<H, I> {
    /// A scene without bodies, advanced by `integrator`.
    #[must_use]
    pub fn with_integrator(hydrodynamics: H, integrator: I) -> Self {
        Self {
            system: System::new(hydrodynamics),
            integrator,
            step_size: StepSize::default(),
            saved: Vec::new(),
            saved_lengths: Vec::new(),
        }
    }

    /// Adds a body; the handle gives it back.
    pub fn add<B: Body>(&mut self, body: B) -> Handle<B> {
        Handle { index: self.system.push(Box::new(body)), body: PhantomData }
    }

    /// A body.
    ///
    /// # Panics
    /// A handle of another scene.
    #[must_use]
    pub fn body<B: Body>(&self, handle: Handle<B>) -> &B {
        self.system.body_at(handle.index).downcast_ref().expect("a handle belongs to the scene that gave it")
    }

    /// A body, to be changed between steps.
    ///
    /// # Panics
    /// A handle of another scene.
    pub fn body_mut<B: Body>(&mut self, handle: Handle<B>) -> &mut B {
        self.system.body_at_mut(handle.index).downcast_mut().expect("a handle belongs to the scene that gave it")
    }

    /// The bodies, the fluid and the time.
    #[must_use]
    pub fn system(&self) -> &System<H> {
        &self.system
    }

    /// The same, to evaluate and sample the flow.
    pub fn system_mut(&mut self) -> &mut System<H> {
        &mut self.system
    }

    /// Time since the start (time).
    #[must_use]
    pub fn time(&self) -> f64 {
        self.system.time()
    }

    /// Steps since the start.
    #[must_use]
    pub fn steps(&self) -> usize {
        self.system.steps()
    }

    /// Refuses a time step that makes no sense or is above the estimated stability limit of a body at the present state.
    ///
    /// # Errors
    /// [`SceneError::Time`], [`SceneError::TimeStepTooLarge`].
    pub fn check_step(&self, dt: f64) -> Result<(), SceneError> {
        if !(dt.is_finite() && dt > 0.0) {
            return Err(SceneError::Time { name: "the time step", value: dt, remedy: "a positive finite number" });
        }
        // Bodies estimate for the midpoint rule, whose interval is 2.
        let scale = self.integrator.stability_interval() / 2.0;
        if let Some((limit, body)) = self.system.step_limit()
            && dt > limit.dt * scale
        {
            let body = body.to_owned();
            return Err(SceneError::TimeStepTooLarge { dt, limit: limit.dt * scale, reason: limit.reason, body });
        }
        Ok(())
    }

    /// Advances the scene by one step of `dt` (time). After an error the scene is in the state before the step. Stability limits are
    /// not looked at here but in [`Scene::check_step`], and during a [`Run`].
    ///
    /// # Errors
    /// A time step that is not positive; those of the bodies and of the flow.
    pub fn step(&mut self, dt: f64) -> Result<(), SceneError> {
        if !(dt.is_finite() && dt > 0.0) {
            return Err(SceneError::Time { name: "the time step", value: dt, remedy: "a positive finite number" });
        }
        self.system.write_state(&mut self.saved);
        self.system.write_lengths(&mut self.saved_lengths);
        let system = &mut self.system;
        let integrator = &mut self.integrator;
        let outcome =
            system.begin_step(dt).and_then(|()| integrator.step(system, dt)).and_then(|()| system.end_step(dt));
        if let Err(error) = outcome {
            self.system.restore(&self.saved_lengths, &self.saved)?;
            return Err(error);
        }
        self.system.advance_clock(dt);
        Ok(())
    }

    /// How long the steps of runs are unless they are told otherwise.
    #[must_use]
    pub fn step_size(&self) -> StepSize {
        self.step_size
    }

    /// The same scene with another step size for its runs (default: half the stability limit).
    #[must_use]
    pub fn with_step_size(mut self, step: StepSize) -> Self {
        self.step_size = step;
        self
    }

    /// A run up to time `until`, to be given a time step and observers.
    pub fn run(&mut self, until: f64) -> Run<'_, H, I> {
        Run::new(self, until)
    }
}

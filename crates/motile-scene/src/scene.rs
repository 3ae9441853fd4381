//! Scenes: bodies in a fluid, advanced in time.

mod handle;
mod mirror;
mod run;
mod step_control;
mod system;
mod warnings;

pub use handle::Handle;
pub(crate) use handle::SceneId;
use mirror::Mirror;
pub use run::{Every, Observer, Run};
pub(crate) use step_control::StepControl;
pub use step_control::StepSize;
pub(crate) use system::Findings;
pub(crate) use system::flow_properties;
pub use system::{Imposed, System};
pub use warnings::Warnings;

use std::collections::BTreeMap;

use motile_base::{InputError, Vec2, finite, positive};

use crate::{
    Body, Hydrodynamics, Observe, SceneError,
    body::{StepCause, StepInfo},
    gap::Repulsion,
    integrator::{Dynamics as _, ErrorEstimate, Integrator, IntegratorKind, IntegratorWork},
    saved_state::SavedState,
    step_report::StepReport,
};

/// Bodies coupled by a fluid, and the integrator that advances them.
#[derive(Debug)]
#[doc(alias("simulation", "world"))]
pub struct Scene<H> {
    system: System<H>,
    integrator: Box<dyn Integrator>,
    step_size: StepSize,
    pub(crate) control: StepControl,
    pub(crate) report: StepReport,
    saved: Vec<f64>,
    saved_lengths: Vec<usize>,
    error: ErrorEstimate,
    mirror: Option<Mirror>,
    /// Keys of the description that the scene was built from, and their values.
    pub(crate) entries: BTreeMap<String, String>,
}

impl<H: Hydrodynamics> Scene<H> {
    /// Creates a scene without bodies, advanced by the midpoint rule.
    #[must_use]
    pub fn new(hydrodynamics: H) -> Self {
        Self {
            system: System::new(hydrodynamics),
            integrator: IntegratorKind::Midpoint.into(),
            step_size: StepSize::default(),
            control: StepControl::default(),
            report: StepReport::default(),
            saved: Vec::new(),
            saved_lengths: Vec::new(),
            error: ErrorEstimate::default(),
            mirror: None,
            entries: BTreeMap::new(),
        }
    }

    /// Sets the integrator from the present state on (the midpoint rule otherwise): an [`IntegratorKind`] or your own.
    /// Handles stay valid.
    #[must_use]
    pub fn advanced_by(self, integrator: impl Into<Box<dyn Integrator>>) -> Self {
        Self { integrator: integrator.into(), control: StepControl::default(), ..self }
    }

    /// Sets the description that the scene was built from: keys and their values as text. Checkpoints hold them, and
    /// [`Scene::resume`] refuses a checkpoint in which one of them is different. A scene that you put together by hand
    /// has none, and is compared by its bodies and its fluid alone.
    #[must_use]
    pub fn described_by(self, entries: BTreeMap<String, String>) -> Self {
        Self { entries, ..self }
    }

    /// Adds a short-range repulsion between interfaces, solids and walls (none by default).
    #[must_use]
    pub fn with_repulsion(mut self, repulsion: Repulsion) -> Self {
        self.system.contacts.repulsion = Some(repulsion);
        self
    }

    /// Bounds gaps from below (length). If a step brings an interface closer to another body, to its own image or to a
    /// wall, it returns [`SceneError::Gap`]. Use this on a grid, because a grid resolves gaps of two spacings and more
    /// only; narrower gaps drain as the kernel and not as the fluid has it. By default gaps are measured
    /// ([`System::minimum_gap`], [`System::minimum_wall_gap`]) and only overlaps are errors. Two solids may be closer
    /// than that, because they may touch: then you get a warning ([`System::warnings`]).
    ///
    /// # Errors
    /// Returns an error for a bound that is not finite.
    pub fn with_least_gap(mut self, bound: f64) -> Result<Self, InputError> {
        self.system.contacts.least_gap = Some(finite("the bound on gaps", bound)?);
        Ok(self)
    }

    /// Holds the scene to be its own mirror image in y = 0 from now on. After each step, a body and its mirror image,
    /// which may be itself, are taken to the mean of the two, positions and inner state. An exact solution stays
    /// symmetric, but round-off breaks the symmetry if the symmetric path is unstable. With this you can compute both
    /// paths. Bodies that you add later are held as well.
    ///
    /// # Errors
    /// Returns [`SceneError::NotSymmetric`] for a body without a mirror image, here or in a later step; in steps also
    /// if something else is not a mirror image, such as walls.
    pub fn held_symmetric(mut self) -> Result<Self, SceneError> {
        self.mirror = Some(Mirror::of(&mut self.system)?);
        Ok(self)
    }

    /// Imposes a flow from now on, in place of the one that there was (none at the start): an
    /// [`ImposedFlow`](motile_base::ImposedFlow), or [`Imposed::of_time`]. In a box a shear displaces the periodic
    /// images, so that its strain is part of the state.
    ///
    /// # Errors
    /// Returns [`SceneError::Flow`] for a flow that the method or the region does not have.
    pub fn impose(&mut self, flow: impl Into<Imposed>) -> Result<(), SceneError> {
        self.system.impose(flow.into())
    }

    /// Adds a body, and returns its handle, with which you get the body back.
    pub fn add<B: Body>(&mut self, body: B) -> Handle<B> {
        self.system.push(body)
    }

    /// Returns a body.
    ///
    /// # Errors
    /// Returns [`SceneError::Refused`] for a handle of another scene.
    pub fn body<B: Body>(&self, handle: Handle<B>) -> Result<&B, SceneError> {
        self.system.body(handle)
    }

    /// Returns a body, so that you can change it between steps.
    ///
    /// # Errors
    /// Returns [`SceneError::Refused`] for a handle of another scene.
    pub fn body_mut<B: Body>(&mut self, handle: Handle<B>) -> Result<&mut B, SceneError> {
        self.system.body_mut(handle)
    }

    /// Moves bodies by `by` (length) at once, between steps, for example a droplet and what is inside it. After an
    /// error, the scene is as it was.
    ///
    /// # Errors
    /// Returns an error for a displacement that is not finite; [`SceneError::Refused`]; [`SceneError::Refused`] for a
    /// body that cannot be moved as a whole; a place where it would overlap another body or lie beyond a wall.
    pub fn translate(&mut self, bodies: &[Handle<dyn Body>], by: Vec2) -> Result<(), SceneError> {
        finite("the displacement in x", by.x)?;
        finite("the displacement in y", by.y)?;
        self.system.write_state(&mut self.saved);
        self.system.write_lengths(&mut self.saved_lengths);
        let moved = self.system.translate(bodies, by);
        if moved.is_err() {
            self.system.restore(&self.saved_lengths, &self.saved)?;
        }
        moved
    }

    /// Returns the observables of a body in the present state, such as the observables of a droplet. The flow is
    /// computed if it is not known yet.
    ///
    /// # Errors
    /// Returns [`SceneError::Refused`] for a handle of another scene; the errors of the flow and of the body.
    pub fn observe<B: Observe>(&mut self, handle: Handle<B>) -> Result<B::Observables, SceneError> {
        self.system.observe(handle)
    }

    /// Returns the bodies, the fluid and the time.
    #[must_use]
    pub fn system(&self) -> &System<H> {
        &self.system
    }

    /// Returns the bodies, the fluid and the time, to evaluate and sample the flow.
    pub fn system_mut(&mut self) -> &mut System<H> {
        &mut self.system
    }

    /// Returns the time since the start (time).
    #[must_use]
    pub fn time(&self) -> f64 {
        self.system.time()
    }

    /// Returns the number of steps since the start.
    #[must_use]
    pub fn steps(&self) -> usize {
        self.system.steps()
    }

    /// Refuses a time step that makes no sense or is above the estimated stability limit of a body at the present
    /// state.
    ///
    /// # Errors
    /// Returns [`SceneError::Input`], [`SceneError::TimeStepTooLarge`].
    pub fn check_step(&self, dt: f64) -> Result<(), SceneError> {
        positive("the time step", dt)?;
        if let Some((limit, reason, body)) = self.stable_step()
            && dt > limit
        {
            return Err(SceneError::TimeStepTooLarge { dt, limit, reason, body: body.to_owned() });
        }
        Ok(())
    }

    /// Returns the largest stable step of the scene's integrator at the present state (time), or the time in which a
    /// film would close at its present velocity where that is shorter, what sets it, and of which body.
    #[must_use]
    pub fn step_limit(&self) -> Option<(f64, &'static str, &str)> {
        self.least_limit(|_| true)
    }

    /// Returns the largest stable step (time), its reason and its body; see [`Scene::step_limit`].
    pub(crate) fn stable_step(&self) -> Option<(f64, &'static str, &str)> {
        self.least_limit(|cause| cause != StepCause::Accuracy)
    }

    fn least_limit(&self, counts: impl Fn(StepCause) -> bool) -> Option<(f64, &'static str, &str)> {
        let (interval, stabilised) = (self.integrator.stability_interval(), self.integrator.stabilised());
        let mut least: Option<(f64, &str, &str)> = None;
        self.system.each_limit(&mut |limit, body| {
            let dt = limit.for_interval(interval, stabilised);
            if counts(limit.cause) && least.is_none_or(|(shortest, ..)| dt.total_cmp(&shortest).is_lt()) {
                least = Some((dt, limit.reason, body));
            }
        });
        least
    }

    /// Advances the scene by one step of `dt` (time). After an error, the scene is in the state before the step. This
    /// does not check stability limits: use [`Scene::check_step`] or a [`Run`] for that.
    ///
    /// # Errors
    /// Returns an error for a time step that is not positive; the errors of the bodies and of the flow, also at the
    /// state that the step leads to.
    pub fn step(&mut self, dt: f64) -> Result<(), SceneError> {
        self.attempt(dt, None).map(|_| ())
    }

    /// Takes a step, and estimates its error in units of `tolerance` if one is given. If the error is above it, or
    /// after an error, the scene is in the state before the step.
    pub(crate) fn attempt(&mut self, dt: f64, tolerance: Option<f64>) -> Result<f64, SceneError> {
        positive("the time step", dt)?;
        self.system.write_state(&mut self.saved);
        self.system.write_lengths(&mut self.saved_lengths);
        let outcome = self.advance(dt, tolerance);
        if matches!(outcome, Ok(error) if error <= 1.0) {
            self.system.commit(dt);
            return outcome;
        }
        self.system.restore(&self.saved_lengths, &self.saved)?;
        let known = self.error.return_to(&mut self.system, &self.saved);
        outcome.and_then(|error| known.map(|()| error))
    }

    fn advance(&mut self, dt: f64, tolerance: Option<f64>) -> Result<f64, SceneError> {
        let Self { system, integrator, error, saved, saved_lengths, mirror, .. } = self;
        let estimated = tolerance.zip(integrator.error_constant());
        system.begin_step(StepInfo { dt, stabilised: integrator.stabilised() })?;
        if estimated.is_some() {
            error.begin(system, saved)?;
        }
        integrator.step(system, dt)?;
        if estimated.is_some() {
            error.advanced(system);
        }
        system.end_step(dt)?;
        if let Some(mirror) = mirror {
            mirror.project(system)?;
        }
        system.check_gaps()?;
        // The flow at the end of a step is that at the start of the next.
        system.evaluate()?;
        let Some((tolerance, constant)) = estimated else { return Ok(0.0) };
        // Where the states cannot be compared, the step stays and the next one is judged again.
        Ok(error.end(system, (saved, saved_lengths), dt, constant)?.map_or(1.0, |error| error / tolerance))
    }

    /// Returns the steps of the runs of this scene.
    #[must_use]
    pub fn step_report(&self) -> &StepReport {
        &self.report
    }

    /// Returns the stages and estimates of the integrator since the start.
    #[must_use]
    pub fn integrator_work(&self) -> IntegratorWork {
        self.integrator.work()
    }

    pub(crate) fn load_integrator(&mut self, saved: &SavedState) -> Result<(), SceneError> {
        self.integrator.load(saved)
    }

    /// Returns the integrator.
    #[must_use]
    pub fn integrator(&self) -> &dyn Integrator {
        self.integrator.as_ref()
    }

    /// Returns the length of the steps of runs that are given no other.
    #[must_use]
    pub fn step_size(&self) -> StepSize {
        self.step_size
    }

    /// Sets the step size of runs (adaptive steps with a tolerance of 1e-4 otherwise).
    #[must_use]
    pub fn with_step_size(mut self, step: StepSize) -> Self {
        self.step_size = step;
        self
    }
}

#[cfg(test)]
mod tests;

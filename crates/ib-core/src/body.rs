//! What a body is: markers that put forces on the fluid and move with it.

use std::any::Any;

use crate::{BodyError, Boundary, MarkerKind, Medium, Record, Vec2};

/// What a bound on the time step comes from.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum StepCause {
    /// A mode that decays at the rate `2/dt`: an integrator with a longer interval of stability takes longer steps.
    Decay,
    /// A mode that a stabiliser ([`StepInfo::stabilised`]) has slowed down to what this bound allows, and that decays at the rate
    /// `2/bare` without it.
    Stabilised {
        /// The bound without the stabiliser (time).
        bare: f64,
    },
    /// Something that is carried along, which no integrator here allows longer steps for.
    Transport,
}

/// A bound on the time step.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct StepLimit {
    /// Largest stable step of the explicit midpoint rule (time); infinity where there is none.
    pub dt: f64,
    /// What sets it, as it reads after "set by".
    pub reason: &'static str,
    /// How it depends on the integrator.
    pub cause: StepCause,
}

impl StepLimit {
    /// The bound for a mode that decays at the rate `2/dt`.
    #[must_use]
    pub fn decay(dt: f64, reason: &'static str) -> Self {
        Self { dt, reason, cause: StepCause::Decay }
    }

    /// The bound (time) for an integrator with that interval of stability, with or without the bodies' stabilisers.
    #[must_use]
    pub fn for_interval(&self, interval: f64, stabilised: bool) -> f64 {
        match self.cause {
            StepCause::Decay => 0.5 * interval * self.dt,
            StepCause::Stabilised { bare } if !stabilised => 0.5 * interval * bare,
            StepCause::Stabilised { .. } | StepCause::Transport => self.dt,
        }
    }

    /// The rate of decay without a stabiliser (1/time); 0 for what does not decay.
    #[must_use]
    pub fn decay_rate(&self) -> f64 {
        match self.cause {
            StepCause::Decay => 2.0 / self.dt,
            StepCause::Stabilised { bare } => 2.0 / bare,
            StepCause::Transport => 0.0,
        }
    }
}

/// A step that is about to be taken.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct StepInfo {
    /// Its length (time).
    pub dt: f64,
    /// Whether the body is to slow down its stiff couplings by adding a diffusion to its implicit part and taking it off the explicit
    /// one.
    pub stabilised: bool,
}

/// A body of a scene.
///
/// Its state is a flat list of numbers, which the integrator advances: `d state/dt = rate + L state`, the rate explicit,
/// the linear part L (by default nothing) implicit. The calls of one evaluation come in this order, and a body may keep
/// what it computed in one for the next: [`Body::read_state`], [`Body::write_markers`], [`Body::write_forces`],
/// [`Body::rate`].
pub trait Body: Any + std::fmt::Debug + Send {
    /// A name for messages.
    fn name(&self) -> &str;

    /// What its markers are.
    fn kind(&self) -> MarkerKind;

    /// Number of markers; may change in [`Body::end_step`] only.
    fn marker_count(&self) -> usize;

    /// Writes the marker positions (length).
    fn write_markers(&self, positions: &mut [Vec2]);

    /// Writes the forces on the fluid at the markers (force).
    ///
    /// # Errors
    /// A state in which the forces are not defined.
    fn write_forces(&mut self, medium: &Medium, forces: &mut [Vec2]) -> Result<(), BodyError>;

    /// Number of entries of the state, in units that only the body knows.
    fn state_len(&self) -> usize;

    /// Copies the state to `state`, which has [`Body::state_len`] entries.
    fn write_state(&self, state: &mut [f64]);

    /// Takes a state over.
    ///
    /// # Errors
    /// A state that is not finite or not possible.
    fn read_state(&mut self, state: &[f64]) -> Result<(), BodyError>;

    /// Writes the explicit part of the state's rate of change (unit of the state per time) to `rate`, from the velocities of the
    /// fluid at the markers (length per time).
    fn rate(&mut self, velocities: &[Vec2], rate: &mut [f64]);

    /// Called before the first evaluation of a step.
    ///
    /// # Errors
    /// A state from which no step can start.
    fn begin_step(&mut self, _medium: &Medium, _step: StepInfo) -> Result<(), BodyError> {
        Ok(())
    }

    /// Adds `factor * L(state) state` to `out`, where the implicit operator L may depend on the explicit part of
    /// `state` (the geometry).
    fn add_implicit(&mut self, _state: &[f64], _factor: f64, _out: &mut [f64]) {}

    /// Replaces `state` by the solution y of `y - factor L(state) y = state`.
    fn solve_implicit(&mut self, _factor: f64, _state: &mut [f64]) {}

    /// Called after the last evaluation of a step, when the new state has been read: filters, constraints,
    /// redistribution of markers, checks.
    ///
    /// # Errors
    /// A state that cannot be.
    fn end_step(&mut self, _medium: &Medium, _dt: f64) -> Result<(), BodyError> {
        Ok(())
    }

    /// The largest stable time steps of the explicit midpoint rule at the present state, one for each reason there is.
    fn step_limits(&self, medium: &Medium) -> Vec<StepLimit>;

    /// Adds the body's boundary, to which gaps are measured: by default the polygon of an interface, and nothing of other bodies.
    fn write_boundary(&self, boundary: &mut Boundary) {
        if !matches!(self.kind(), MarkerKind::Points) {
            let mut positions = vec![Vec2::zeros(); self.marker_count()];
            self.write_markers(&mut positions);
            boundary.push_loop(&positions);
        }
    }

    /// Writes the size of each entry of the state to which its errors are compared (the entry's own unit; positive): the radius of a
    /// droplet for positions, say. By default all are one.
    fn write_scales(&self, scales: &mut [f64]) {
        scales.fill(1.0);
    }

    /// Everything from which [`Body::load`] makes the present state again, bit for bit: by default what [`Body::write_state`]
    /// writes. A body whose next step depends on more must save that too.
    fn save(&self) -> Record {
        let mut reals = vec![0.0; self.state_len()];
        self.write_state(&mut reals);
        Record { reals, counts: Vec::new() }
    }

    /// Takes back what [`Body::save`] of a body made in the same way wrote.
    ///
    /// # Errors
    /// A record of another body, or a state that cannot be.
    fn load(&mut self, _medium: &Medium, record: &Record) -> Result<(), BodyError> {
        if record.reals.len() != self.state_len() {
            return Err(BodyError::ForeignRecord { expected: self.state_len(), found: record.reals.len() });
        }
        self.read_state(&record.reals)
    }
}

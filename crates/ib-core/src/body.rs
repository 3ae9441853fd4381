//! What a body is: markers that put forces on the fluid and move with it.

mod guest;
mod marker_body;
mod points;
mod step_limit;

pub use guest::Guest;
pub use marker_body::MarkerBody;
pub use points::{read_points, write_points};
pub use step_limit::{StepCause, StepLimit};

use std::any::Any;

use crate::{
    BodyError, Discretisation, MarkerKind, Vec2, Warning, checkpoint::SavedState, gap::Boundary,
    hydrodynamics::SurfaceCurve, scene::BodyFlow,
};

/// What can be seen of a body beyond its markers: the speed of a droplet, say.
pub trait Observe: Body {
    /// All that is seen of it at one time.
    type Observables;

    /// What is seen of it in its present state, from the flow at its markers in that state.
    ///
    /// # Errors
    /// A state in which it cannot be computed.
    fn observables(&self, discretisation: &Discretisation, flow: &BodyFlow<'_>)
    -> Result<Self::Observables, BodyError>;
}

/// A step that is about to be taken.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct StepInfo {
    /// Its length (time).
    pub dt: f64,
    /// Whether the body is to slow down its stiff couplings by adding a diffusion to its implicit part and taking it
    /// off the explicit one.
    pub stabilised: bool,
}

/// A body of a scene.
///
/// Its state is a flat list of numbers, which the integrator advances: `d state/dt = rate + L state`, the rate
/// explicit, the linear part L (by default nothing) implicit. The calls of one evaluation come in this order, and a
/// body may keep what it computed in one for the next: [`Body::read_state`], [`Body::write_markers`],
/// [`Body::write_forces`], [`Body::rate`].
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
    fn write_forces(&mut self, discretisation: &Discretisation, forces: &mut [Vec2]) -> Result<(), BodyError>;

    /// Number of entries of the state, in units that only the body knows.
    fn state_len(&self) -> usize;

    /// Copies the state to `state`, which has [`Body::state_len`] entries.
    fn write_state(&self, state: &mut [f64]);

    /// Takes a state over.
    ///
    /// # Errors
    /// A state that is not finite or not possible.
    fn read_state(&mut self, state: &[f64]) -> Result<(), BodyError>;

    /// Writes the explicit part of the state's rate of change (unit of the state per time) to `rate`, from the
    /// velocities of the fluid at the markers (length per time).
    fn rate(&mut self, velocities: &[Vec2], rate: &mut [f64]);

    /// Called before the first evaluation of a step.
    ///
    /// # Errors
    /// A state from which no step can start.
    fn begin_step(&mut self, _medium: &Discretisation, _step: StepInfo) -> Result<(), BodyError> {
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
    fn end_step(&mut self, _medium: &Discretisation, _dt: f64) -> Result<(), BodyError> {
        Ok(())
    }

    /// Called when the step that [`Body::end_step`] has ended stays: for what is counted over a run. Steps that are
    /// rejected do not come here.
    fn keep_step(&mut self) {}

    /// Tells `limits` the largest stable time steps of the explicit midpoint rule at the present state, one for each
    /// reason there is.
    fn step_limits(&self, _medium: &Discretisation, _limits: &mut dyn FnMut(StepLimit)) {}

    /// What a user should know of the present state though a run can go on from it, from the flow of the last
    /// evaluation; by default nothing.
    fn warnings(&self, _medium: &Discretisation) -> Vec<Warning> {
        Vec::new()
    }

    /// Adds the body's boundary, to which gaps are measured, given where its markers are (length): by default the
    /// polygon through those of an interface, and nothing of other bodies.
    fn write_boundary(&self, markers: &[Vec2], boundary: &mut Boundary) {
        if self.kind().is_interface() {
            boundary.push_loop(markers);
        }
    }

    /// The curves that markers of a solid trace, as far as they move; by default none. They are asked for once, when
    /// the body joins a scene.
    fn surfaces(&self) -> Vec<SurfaceCurve> {
        Vec::new()
    }

    /// The body as one that fills another body of the scene; by default it does not.
    fn as_guest(&mut self) -> Option<&mut dyn Guest> {
        None
    }

    /// Writes the size of each entry of the state to which its errors are compared (the entry's own unit; positive):
    /// the radius of a droplet for positions, say. By default all are one.
    fn write_scales(&self, scales: &mut [f64]) {
        scales.fill(1.0);
    }

    /// What the body is made of, besides its state: named numbers that stay what they are over a run, such as its
    /// moduli. A checkpoint of a body of other ones is refused. By default the number of markers, which a body leaves
    /// out if it may change.
    fn properties(&self) -> Vec<(String, f64)> {
        vec![("the number of markers".to_owned(), self.marker_count() as f64)]
    }

    /// Everything from which [`Body::load`] makes the present state again, bitwise: by default what
    /// [`Body::write_state`] writes. A body whose next step depends on more must save that too.
    fn save(&self) -> SavedState {
        let mut reals = vec![0.0; self.state_len()];
        self.write_state(&mut reals);
        SavedState { reals, counts: Vec::new() }
    }

    /// Takes back what [`Body::save`] of a body made in the same way wrote.
    ///
    /// # Errors
    /// The state of another body, or a state that cannot be.
    fn load(&mut self, _medium: &Discretisation, saved: &SavedState) -> Result<(), BodyError> {
        self.read_state(saved.reals_of(self.state_len())?)
    }
}

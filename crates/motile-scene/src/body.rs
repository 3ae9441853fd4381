//! Bodies: markers that put forces on the fluid and move with it.

mod marker_body;
mod step_limit;

pub use marker_body::{MarkerBody, fastest_decay};
pub use step_limit::{StepCause, StepLimit};

use std::any::Any;
use std::borrow::Cow;
use std::fmt;

use serde::{Deserialize, Serialize};

use crate::{BodyError, BodyFlow, FluidView, Handle, MarkerKind, gap::SurfaceCurve, saved_state::SavedState};
use motile_base::Vec2;

/// Measures a body beyond its markers, for example the speed of a droplet.
pub trait Observe: Body {
    /// Observables at one time.
    type Observables;

    /// Returns the observables of the present state, from the flow at the markers in that state.
    ///
    /// # Errors
    /// Returns an error for a state in which it cannot be computed.
    fn observables(&self, view: &FluidView, flow: &BodyFlow<'_>) -> Result<Self::Observables, BodyError>;
}

/// A step that is about to be taken.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct StepInfo {
    /// Its length (time).
    pub dt: f64,
    /// True if the body should slow down its stiff couplings, by adding a diffusion to its implicit part and
    /// subtracting it from the explicit one.
    pub stabilised: bool,
}

/// A body of a scene. Implement this trait to put your own kind of body into the fluid.
///
/// Its state is a flat list of numbers, which the integrator advances: `d state/dt = rate + L state`, the rate
/// explicit, the linear part L (by default nothing) implicit. The calls of one evaluation come in this order, so a body
/// may keep what it computed in one for the next: [`Body::read_state`], [`Body::write_markers`],
/// [`Body::write_forces`], [`Body::rate`].
#[doc(alias("cell", "particle"))]
pub trait Body: Any + fmt::Debug + Send {
    /// Returns a name for messages.
    fn name(&self) -> &str;

    /// Returns the kind of the markers.
    fn kind(&self) -> MarkerKind;

    /// Returns the number of markers; may change in [`Body::end_step`] only.
    fn marker_count(&self) -> usize;

    /// Writes the marker positions (length).
    fn write_markers(&self, positions: &mut [Vec2]);

    /// Writes the forces on the fluid at the markers (force).
    ///
    /// # Errors
    /// Returns an error for a state in which the forces are not defined.
    fn write_forces(&mut self, view: &FluidView, forces: &mut [Vec2]) -> Result<(), BodyError>;

    /// Returns the number of entries of the state, in units that only the body knows.
    fn state_len(&self) -> usize;

    /// Copies the state to `state`, which has [`Body::state_len`] entries.
    fn write_state(&self, state: &mut [f64]);

    /// Takes a state over.
    ///
    /// # Errors
    /// Returns an error for a state that is not finite or not possible.
    fn read_state(&mut self, state: &[f64]) -> Result<(), BodyError>;

    /// Writes the explicit part of the state's rate of change (unit of the state per time) to `rate`, from the
    /// velocities of the fluid at the markers (length per time).
    fn rate(&mut self, velocities: &[Vec2], rate: &mut [f64]);

    /// Prepares a step; runs before its first evaluation.
    ///
    /// # Errors
    /// Returns an error for a state from which no step can start.
    fn begin_step(&mut self, _view: &FluidView, _step: StepInfo) -> Result<(), BodyError> {
        Ok(())
    }

    /// Returns true if forces or rates depend on the time of the scene beyond the state. The scene then advances the
    /// time with the states, and sets it by [`Body::set_time`]. By default, they do not.
    fn depends_on_time(&self) -> bool {
        false
    }

    /// Takes over the time of the present state (time). If [`Body::depends_on_time`], the scene calls this when the
    /// body joins, after each [`Body::read_state`] at another time, and when a step has been accepted. Other bodies may
    /// not know the time.
    fn set_time(&mut self, _time: f64) {}

    /// Adds `factor * L(state) state` to `out`, where the implicit operator L may depend on the explicit part of
    /// `state` (the geometry).
    fn add_implicit(&mut self, _state: &[f64], _factor: f64, _out: &mut [f64]) {}

    /// Replaces `state` by the solution y of `y - factor L(state) y = state`.
    fn solve_implicit(&mut self, _factor: f64, _state: &mut [f64]) {}

    /// Completes a step after its last evaluation, when the new state has been read: filters, constraints,
    /// redistribution of markers, checks.
    ///
    /// # Errors
    /// Returns an error for a state that cannot be.
    fn end_step(&mut self, _view: &FluidView, _dt: f64) -> Result<(), BodyError> {
        Ok(())
    }

    /// Records a step that [`Body::end_step`] has ended and that is accepted. Use it for what you count over a run,
    /// because rejected steps do not come here.
    fn keep_step(&mut self) {}

    /// Reports to `limits` the largest stable time steps of the explicit midpoint rule at the present state, one for
    /// each reason.
    fn step_limits(&self, _view: &FluidView, _limits: &mut dyn FnMut(StepLimit)) {}

    /// Returns the doubts about the accuracy of the present state, from the flow of the last evaluation; by default
    /// none.
    fn warnings(&self, _view: &FluidView) -> Vec<Warning> {
        Vec::new()
    }

    /// Returns the body's surface, to which gaps are measured, on which a repulsion acts, and whose curves carry layers
    /// where markers trace all of them. By default this is the closed curve through the markers of one, and nothing of
    /// other bodies. A scene calls it when the body joins, has been changed by hand, or has another number of markers.
    fn surfaces(&self) -> Vec<SurfaceCurve> {
        self.kind().surface(self.marker_count())
    }

    /// Returns the body as one that fills another body of the scene; by default it does not.
    fn as_interior_body(&mut self) -> Option<&mut dyn InteriorBody> {
        None
    }

    /// Returns the body as one whose forces depend on the velocities of its markers; by default they do not.
    fn as_viscous(&mut self) -> Option<&mut dyn Viscous> {
        None
    }

    /// Writes the size of each entry of the state to which its errors are compared (the entry's own unit; positive):
    /// for positions, for example, the radius of a droplet. Zero stands for the extent of the body's markers, their
    /// root mean square distance from their mean (length), which is right for positions in any unit. For a body of one
    /// marker, the scene takes the width of its domain. By default all are zero. A body whose state holds anything else
    /// than positions, such as angles or numbers of particles, has to write its own scales.
    fn write_scales(&self, scales: &mut [f64]) {
        scales.fill(0.0);
    }

    /// Writes the state of the mirror image of the body in y = 0 to `image`, given a state of the body and the number
    /// `markers[k]` among the markers of the image that the image of marker k has; linear in the state. `false` if
    /// there is no such operation, as by default.
    fn mirror(&self, _markers: &[usize], _state: &[f64], _image: &mut [f64]) -> bool {
        false
    }

    /// Moves a state of the body by `by` (length), all else as it is. `false` if there is no such operation, as by
    /// default.
    fn translate(&self, _by: Vec2, _state: &mut [f64]) -> bool {
        false
    }

    /// Returns the parameters of the body: named numbers that stay the same over a run, such as its moduli. A scene
    /// refuses a checkpoint of a body with other parameters. By default the number of markers, which a body leaves out
    /// if it may change.
    fn properties(&self) -> Vec<(String, f64)> {
        vec![("the number of markers".to_owned(), self.marker_count() as f64)]
    }

    /// Returns everything from which [`Body::load`] restores the present state, bitwise. By default this is what
    /// [`Body::write_state`] writes. A body whose next step depends on more must save that too.
    fn save(&self) -> SavedState {
        let mut reals = vec![0.0; self.state_len()];
        self.write_state(&mut reals);
        SavedState { reals, counts: Vec::new() }
    }

    /// Takes back what [`Body::save`] of a body made in the same way wrote.
    ///
    /// # Errors
    /// Returns an error for the state of another body, or a state that cannot be.
    fn load(&mut self, _view: &FluidView, saved: &SavedState) -> Result<(), BodyError> {
        self.read_state(saved.reals_of(self.state_len())?)
    }
}

/// A body whatever its type.
impl<B: Body> From<Handle<B>> for Handle<dyn Body> {
    fn from(handle: Handle<B>) -> Self {
        handle.cast()
    }
}

/// A body that fills another one, its host, up to the host's markers: for example, a gel inside a droplet.
///
/// It is a separate body with a state and with markers, its inner points. It also follows its host, and puts forces on
/// the host's markers. It lies in the fluid inside its host, whatever the viscosity there.
pub trait InteriorBody {
    /// Returns the body that it fills, which was added to the scene before it.
    fn host(&self) -> Handle<dyn Body>;

    /// Takes over the host in a new state, before anything that depends on it is asked: markers, forces; and at the end
    /// of a step, before and after the host's own [`Body::end_step`], then its own.
    fn update_host(&mut self, host: &dyn Body);

    /// Adds its forces on the fluid at the host's markers (force) to the forces of the host, after its own
    /// [`Body::write_forces`].
    fn add_host_forces(&self, forces: &mut [Vec2]);

    /// Takes over the velocities of the fluid at the host's markers (length per time), and the host, which has computed
    /// from them how its markers move, before [`Body::rate`].
    fn host_moved(&mut self, host: &dyn Body, velocities: &[Vec2]);

    /// Adds to the rate of change of the host's state (unit of the state per time) what comes from the interior body,
    /// after its own [`Body::rate`]. What it puts there, its own state loses. By default nothing.
    fn add_host_rate(&self, _rate: &mut [f64]) {}
}

/// A body with forces `-D v` that are linear in the velocities v of its markers, in addition to the forces of
/// [`Body::write_forces`]. Examples are a solid more viscous than the fluid, and an interface with a viscous cortex. D
/// is symmetric and positive semidefinite: no motion gains energy by it.
///
/// The body states it as `D = B^T C^-1 B`. B takes velocities to rates of deformation, `g = C^-1 B v` are the stresses,
/// and C is the diagonal of compliances. A compliance of zero means that the body does not deform at all. Rates times
/// stresses are powers (force times length per time), so that B^T takes stresses to forces.
///
/// Velocities and stresses are solved for together, by preconditioned conjugate gradients for
/// `(C + B M B^T) g = B V(F)`, in which each iteration evaluates the flow V once; M is the change of velocities by
/// forces. Steps are therefore as stable as without these forces, however large D is. All calls are at the state of the
/// last [`Body::write_forces`].
pub trait Viscous {
    /// Returns the number of stresses.
    fn stress_count(&self) -> usize;

    /// Writes the rates of deformation `B v` from the velocities v of the markers (length per time).
    fn write_rates(&mut self, velocities: &[Vec2], rates: &mut [f64]);

    /// Adds the forces `-B^T g` of stresses to the forces on the fluid (force): the exact transpose of
    /// [`Viscous::write_rates`].
    fn add_stress_forces(&mut self, stresses: &[f64], forces: &mut [Vec2]);

    /// Subtracts the rates that are prescribed, so that what is left is zero if the body moves as prescribed:
    /// `C g = B v - prescribed`. By default nothing is prescribed.
    fn subtract_prescribed(&self, _rates: &mut [f64]) {}

    /// Returns true if the body is held by its surroundings, so that its stresses may put a force on the fluid in all.
    /// A flow in the plane refuses such a body, because nothing takes up that force. By default false.
    fn is_held(&self) -> bool {
        false
    }

    /// Writes the compliances: the diagonal C of `C g = B v`, not negative.
    fn write_compliances(&self, compliances: &mut [f64]);

    /// Replaces rates of deformation by stresses that cause about these rates: by a symmetric, positive approximation
    /// of the inverse of `C + B M B^T`. Stresses that it leaves out altogether stay zero.
    fn precondition(&mut self, rates: &mut [f64]);

    /// Returns the stresses that were last found, from which the next solution starts. Returns zeros if there are none.
    fn stresses(&self) -> &[f64];

    /// Takes over the stresses that belong to the velocities of the present state.
    fn set_stresses(&mut self, stresses: &[f64]);
}

/// A doubt about the accuracy of a state from which a run continues: results may be off by more than 1 %.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Warning {
    /// Name of the body that it is about.
    pub body: String,
    /// Cause in a few words, one for all warnings of a kind.
    pub cause: Cow<'static, str>,
    /// Quantity in question over its limit: 1 at the limit, more beyond.
    pub excess: f64,
    /// The value, the limit and the remedy.
    pub message: String,
}

impl fmt::Display for Warning {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}: {}: {}", self.body, self.cause, self.message)
    }
}

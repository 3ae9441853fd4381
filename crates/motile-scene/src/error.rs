//! Errors of scenes, bodies and flows.

use std::sync::Arc;

use motile_base::{
    InputError, Refusal,
    internal::{Refuse, decimals, given, place, told, told_apart},
};

use crate::checkpoint::CheckpointError;

/// The flow could not be computed.
#[derive(Clone, thiserror::Error)]
#[non_exhaustive]
pub enum FlowError {
    /// A number or list that cannot be used.
    #[error(transparent)]
    Input(#[from] InputError),
    /// The solver behind the flow failed. Its crate documents the error inside.
    #[error(transparent)]
    Solver(Arc<dyn std::error::Error + Send + Sync>),
    /// A body with a curve of too few or too many nodes or points.
    #[error("a curve of body {body} has {found} {what}. Use a number from {least} to {most}")]
    Count {
        /// Number of the body, in the order of addition.
        body: usize,
        /// Nodes or points.
        what: &'static str,
        /// How many there are.
        found: usize,
        /// Minimum number.
        least: usize,
        /// Largest number.
        most: usize,
    },
    /// A marker position or force is not a finite number.
    #[error("{what} of marker {marker} of body {body} is ({x}, {y}), so the run has failed. Use a smaller time step")]
    NonFinite {
        /// Position or force.
        what: &'static str,
        /// Number of the body, in the order of addition.
        body: usize,
        /// Number of the marker in the body.
        marker: usize,
        /// x component.
        x: f64,
        /// y component.
        y: f64,
    },
    /// A marker lies beyond a wall.
    #[error(
        "marker {marker} of body {body} at {} is {} beyond the wall, more than {}. \
         Move it, or use a smaller time step or a finer grid",
        place(*x, *y), told_apart([*depth, *allowed])[0], told_apart([*depth, *allowed])[1]
    )]
    BeyondWall {
        /// Number of the body.
        body: usize,
        /// Number of the marker in the body.
        marker: usize,
        /// Its x coordinate.
        x: f64,
        /// Its y coordinate.
        y: f64,
        /// Distance beyond the wall (length).
        depth: f64,
        /// Depth that is allowed (length).
        allowed: f64,
    },
    /// A gap between a wall and a rigid body that the nodes of the body do not resolve.
    #[error(
        "the gap between rigid body {body} and the wall is {}, below {}: its {nodes} nodes do not resolve the flow in \
         so narrow a gap, and the speed may be off by 1 % or more. Use {needed} nodes or \
         more, or keep the body away from the wall",
        told_apart([*gap, *least])[0], told_apart([*gap, *least])[1]
    )]
    NarrowGap {
        /// Number of the body, in the order of addition.
        body: usize,
        /// The gap (length).
        gap: f64,
        /// The narrowest gap that the nodes resolve (length).
        least: f64,
        /// Number of nodes.
        nodes: usize,
        /// Number of nodes that resolve the gap.
        needed: usize,
    },
    /// An iteration did not converge.
    #[error(
        "{what} stopped at a relative residual of {} after {iterations} iterations, above {}. \
         If a gap has become too narrow, or a body is too slender for its nodes, use more nodes, a finer grid or a \
         repulsion of longer range",
        told_apart([*residual, *tolerance])[0], told_apart([*residual, *tolerance])[1]
    )]
    NoConvergence {
        /// The iteration.
        what: &'static str,
        /// Iterations done.
        iterations: usize,
        /// Residual reached.
        residual: f64,
        /// Residual asked for.
        tolerance: f64,
    },
    /// A request that the method cannot fulfil.
    #[error(transparent)]
    Refused(#[from] Refusal),
}

motile_base::debug_as_explanation!(FlowError);

impl FlowError {
    /// Wraps an error of a solver, such as your own grid solver.
    #[must_use]
    pub fn solver(error: impl std::error::Error + Send + Sync + 'static) -> Self {
        Self::Solver(Arc::new(error))
    }

    /// Returns the refusal of a request that a method cannot fulfil: what it is, and what to use instead.
    #[must_use]
    pub fn unsupported(what: &str, remedy: &str) -> Self {
        let what = format!("{what} is not possible here");
        Self::refused(what, "", remedy)
    }

    /// Returns the error with the number of the body in place of the number of its curve.
    #[must_use]
    pub fn of_body(mut self, number: impl Fn(usize) -> usize) -> Self {
        if let Self::Count { body, .. }
        | Self::NonFinite { body, .. }
        | Self::BeyondWall { body, .. }
        | Self::NarrowGap { body, .. } = &mut self
        {
            *body = number(*body);
        }
        self
    }
}

/// A body is in a state that it cannot be in.
#[derive(thiserror::Error)]
#[non_exhaustive]
pub enum BodyError {
    /// A state that is not finite.
    #[error("{what} number {index} is {value}. Use a smaller time step")]
    NonFinite {
        /// The quantity.
        what: &'static str,
        /// Number of the entry.
        index: usize,
        /// Its value.
        value: f64,
    },
    /// An interface crosses itself.
    #[error(
        "the interface crosses itself at {}, between markers {first} and {second}. Use a smaller time \
         step, a weaker activity, or more nodes (with a grid, a finer one)",
        place(*x, *y)
    )]
    SelfCrossing {
        /// x coordinate of the first marker (length).
        x: f64,
        /// y coordinate of the first marker (length).
        y: f64,
        /// A segment by its first marker.
        first: usize,
        /// The other segment.
        second: usize,
    },
    /// A bound on a conserved quantity was exceeded.
    #[error(
        "{what} has changed by {}{} of its value, more than {}. Use a smaller time step or spacing",
        if *change < 0.0 { "-" } else { "" },
        told_apart([change.abs(), *bound])[0],
        told_apart([change.abs(), *bound])[1]
    )]
    NotConserved {
        /// The quantity.
        what: &'static str,
        /// Relative change.
        change: f64,
        /// Relative change that is allowed.
        bound: f64,
    },
    /// A number or list that cannot be used, or a saved state of something else.
    #[error(transparent)]
    Input(#[from] InputError),
    /// An error of the body's own.
    #[error(transparent)]
    Other(Box<dyn std::error::Error + Send + Sync>),
}

motile_base::debug_as_explanation!(BodyError);

/// A scene could not be made or advanced. After an error in a step, the scene holds the state before that step.
///
/// The text carries the direct cause; [`SceneError::explanation`] adds the causes of that cause.
#[derive(thiserror::Error)]
#[non_exhaustive]
pub enum SceneError {
    /// The flow could not be computed.
    #[error("at time {time} the flow could not be computed: {source}", time = told(*time))]
    Flow {
        /// Time at the start of the step.
        time: f64,
        /// Cause.
        source: FlowError,
    },
    /// A body went wrong.
    #[error("at time {time} {body} went wrong: {source}", time = told(*time))]
    Body {
        /// Time at the start of the step.
        time: f64,
        /// The body's name.
        body: String,
        /// Cause.
        source: BodyError,
    },
    /// Bodies that overlap before anything is computed for them.
    #[error(
        "at time {time} {body} overlaps {other} by {} at ({x:.4}, {y:.4}), more than {}. Move the bodies apart",
        told_apart([*depth, *allowed])[0], told_apart([*depth, *allowed])[1],
        time = told(*time)
    )]
    Overlap {
        /// Time of the state.
        time: f64,
        /// The body whose marker or corner is in the other one.
        body: String,
        /// x coordinate of where it is deepest (length).
        x: f64,
        /// y coordinate of where it is deepest (length).
        y: f64,
        /// The body that it is in, or its own image; or the interface that it is in and has crossed.
        other: String,
        /// Depth (length).
        depth: f64,
        /// Depth that is allowed (length).
        allowed: f64,
    },
    /// A body has come into an interface or out of it in a step.
    #[error(
        "at time {time} {body}, which was {before}, has come to lie {now}. Use a smaller time step",
        time = told(*time)
    )]
    Containment {
        /// Time at the start of the step.
        time: f64,
        /// The body.
        body: String,
        /// Its surroundings before the step.
        before: String,
        /// Its surroundings after the step.
        now: String,
    },
    /// An interface and another body, or its own image in a periodic domain, or two solids have come to overlap.
    #[error(
        "at time {time} {body} has crossed {other} by {} at ({x:.4}, {y:.4}), more than {}. Use a \
         repulsion between the interfaces, a smaller time step, or more nodes (with a grid, a finer one)",
        told_apart([*depth, *allowed])[0], told_apart([*depth, *allowed])[1],
        time = told(*time)
    )]
    Crossing {
        /// Time at the start of the step.
        time: f64,
        /// The body whose marker or corner it is.
        body: String,
        /// Its x coordinate (length).
        x: f64,
        /// Its y coordinate (length).
        y: f64,
        /// The body that it is in.
        other: String,
        /// Depth (length).
        depth: f64,
        /// Depth that is allowed (length).
        allowed: f64,
    },
    /// A gap is narrower than the bound that was set.
    #[error(
        "at time {time} the gap between {body} and {other} is {} at ({x:.4}, {y:.4}), below the bound of {}. Use \
         a finer grid, no grid or a repulsion, or a lower bound if the flow in the gap does not matter",
        told_apart([*gap, *bound])[0], told_apart([*gap, *bound])[1],
        time = told(*time)
    )]
    Gap {
        /// Time at the start of the step.
        time: f64,
        /// One side of the gap.
        body: String,
        /// x coordinate of its corner there (length).
        x: f64,
        /// y coordinate of the corner (length).
        y: f64,
        /// Its other side.
        other: String,
        /// The gap (length).
        gap: f64,
        /// The bound (length).
        bound: f64,
    },
    /// A scene that is to be held symmetric ([`crate::Scene::held_symmetric`]) is not.
    #[error(
        "at time {time} the scene cannot be held symmetric, because it is not its own mirror image in y = 0: {body} \
         {problem}",
        time = told(*time)
    )]
    NotSymmetric {
        /// Time of the state.
        time: f64,
        /// The body.
        body: String,
        /// Difference from a mirror image.
        problem: String,
    },
    /// A time step above the stable one.
    #[error(
        "time step {} is above the stable {} set by {reason} of {body}. Use a smaller one",
        told_apart([*dt, *limit])[0], told_apart([*dt, *limit])[1]
    )]
    TimeStepTooLarge {
        /// The step asked for (time).
        dt: f64,
        /// The largest stable one (time).
        limit: f64,
        /// Reason for the limit.
        reason: &'static str,
        /// Name of the body.
        body: String,
    },
    /// Adaptive steps have become shorter than the bound that was set.
    #[error("{}", stagnation(*time, [*dt, *least], source.as_deref()))]
    Stagnation {
        /// Time of the state.
        time: f64,
        /// The step that would be needed (time).
        dt: f64,
        /// The bound (time).
        least: f64,
        /// Error in which the last attempt ended, unless it was only too inaccurate.
        source: Option<Box<SceneError>>,
    },
    /// A run has taken all the steps it was allowed.
    #[error(
        "at time {time} the run has used all {most} steps that it was allowed. Allow more steps or longer ones",
        time = told(*time)
    )]
    TooManySteps {
        /// Time of the state.
        time: f64,
        /// The number allowed.
        most: usize,
    },
    /// The run was stopped on request.
    #[error(
        "stopped at time {time}: the scene holds the last complete step, from which you can continue the run",
        time = told(*time)
    )]
    Stopped {
        /// Time of the state.
        time: f64,
    },
    /// A checkpoint could not be saved.
    #[error("at time {time} no checkpoint could be saved: {source}", time = told(*time))]
    Checkpoint {
        /// Time of the state.
        time: f64,
        /// Cause.
        source: Box<CheckpointError>,
    },
    /// A time, time step or other number that makes no sense, or a saved state of something else.
    #[error(transparent)]
    Input(#[from] InputError),
    /// An observer failed.
    #[error("an observer failed at time {time}: {source}", time = told(*time))]
    Observer {
        /// Time of the state.
        time: f64,
        /// Cause.
        source: Box<dyn std::error::Error + Send + Sync>,
    },
    /// A scene, checkpoint, handle or integrator that cannot be used.
    #[error(transparent)]
    Refused(#[from] Refusal),
}

motile_base::debug_as_explanation!(SceneError);

/// Remedy of a refused checkpoint.
const GO_ON: &str = "start from its state with other values by `Scene::take_over`";

impl SceneError {
    /// Returns the error for neighbouring interfaces that are periodic along x, the lower one and the upper one or an
    /// image of the lower, and give the fluid between them two viscosities (stress times time).
    pub(crate) fn two_viscosities(time: f64, [body, other]: [String; 2], viscosities: [f64; 2]) -> Self {
        let (time, [lower, upper]) = (told(time), told_apart(viscosities));
        let between = format!("the fluid between {body} and {other}, or the image of one,");
        let what = format!("at time {time} {between} would have the viscosities {lower} and {upper}");
        Self::refused(what, "", "Give both the same viscosity inside, or turn one of them over")
    }

    /// Returns the error for a stability limit so short that a run would never end.
    pub(crate) fn step_too_short(dt: f64, least: f64, reason: &str, body: &str) -> Self {
        let [dt, least] = told_apart([dt, least]);
        let what = format!("the time step at the start of the run would be {dt}, set by {reason} of {body}");
        let value = format!("below {least}, the run takes more than 1e10 steps");
        let remedy = format!("Use less activity, tension or stiffness for {body}, or run for less time");
        Self::refused(what, value, remedy)
    }

    /// Returns the error for a step size that is a fraction of the stability limit, where no body states a finite one.
    pub(crate) fn no_step_limit(time: f64) -> Self {
        let what =
            format!("at time {} no body states a limit of the time step, so there is no fraction of it", told(time));
        let remedy = "Use `StepSize::Fixed` or `StepSize::Adaptive`, or let a body state a limit (`Body::step_limits`)";
        Self::refused(what, "", remedy)
    }

    /// Returns the error for adaptive steps with an integrator whose errors cannot be estimated.
    pub(crate) fn no_error_estimate(integrator: &str) -> Self {
        let what = format!("the error of a step of {integrator} cannot be estimated");
        Self::refused(what, "", "Use another step size than `StepSize::Adaptive`")
    }

    /// Returns the error for parts of the motion that an integrator would have to treat implicitly and does not.
    pub(crate) fn implicit_parts(integrator: &str) -> Self {
        let what = format!("the {integrator} integrator cannot handle particles or gels");
        let value = "their diffusion is treated implicitly";
        Self::refused(what, value, "Use the midpoint rule or the Runge-Kutta-Chebyshev method")
    }

    /// Returns the error for a checkpoint that is not of this scene.
    pub(crate) fn foreign_checkpoint(difference: impl Into<String>) -> Self {
        Self::refused("the checkpoint is of another scene", difference, "Resume with the scene that wrote it")
    }

    /// Returns the error for a checkpoint of another domain: the difference in words.
    pub(crate) fn other_domain(difference: String) -> Self {
        let remedy = format!("Resume with the scene that wrote it, or {GO_ON}");
        Self::refused("the checkpoint is of another scene", difference, remedy)
    }

    /// Returns the error for the refusal of bodies of another resolution, from the one of another property.
    pub(crate) fn of_other_resolution(self) -> Self {
        match self {
            Self::Refused(Refusal { value, .. }) => {
                let remedy = "Build the scene with as many markers and points as the checkpoint has";
                Self::refused("the checkpoint has another resolution", value, remedy)
            }
            other => other,
        }
    }

    /// Returns the error for a checkpoint of a scene whose fluid or bodies are made of something else. It names the
    /// body or the scene, its property, and the values of the property in the checkpoint and here.
    pub(crate) fn other_property(of: &str, property: &str, saved: Option<f64>, present: Option<f64>) -> Self {
        let value = format!("for {of}, {property} is {} in it and {} here", shown(saved), shown(present));
        let remedy = format!("Resume with the values it was saved with, or {GO_ON}");
        Self::refused("the checkpoint is of other physics", value, remedy)
    }

    /// Returns the error for a checkpoint of a program that may compute other numbers.
    pub(crate) fn other_version(saved: &str) -> Self {
        let what = format!("the checkpoint is of motile {saved}, and this is motile {}", crate::VERSION);
        let value = "a run of two versions has the numbers of neither";
        Self::refused(what, value, "Resume with the version that wrote it, or start a new run")
    }

    /// Returns the error for a checkpoint of a scene with another description: the key, and its values in the
    /// checkpoint and here, in words.
    pub(crate) fn other_entry(entry: &str) -> Self {
        let remedy = format!("Resume with the values it was saved with, start a new run, or {GO_ON}");
        Self::refused("the checkpoint is of another description", entry, remedy)
    }

    /// Returns the error for the refusal of a checkpoint with the entry of the description that is different.
    pub(crate) fn with_entry(self, entry: &str) -> Self {
        match self {
            Self::Refused(Refusal { what, value, remedy }) => {
                Self::refused(what, format!("{value}, and {entry}"), remedy)
            }
            other => other,
        }
    }

    /// Returns the error for a body that cannot be moved as a whole.
    pub(crate) fn immovable(body: &str) -> Self {
        let remedy = "Move only droplets, rigid bodies, shells and plain markers";
        Self::refused(format!("{body} cannot be moved as a whole"), "", remedy)
    }

    /// Returns the error for a run up to a time before the present one.
    pub(crate) fn ends_before(until: f64, time: f64) -> Self {
        let what = format!("the run is to end at {}, before the scene's time {}", given(until), told(time));
        Self::refused(what, "", "Give the time at which it ends, not the length of the run")
    }

    /// Returns the error for a handle of another scene.
    pub(crate) fn foreign_handle() -> Self {
        let remedy = "Use the handle that this scene returned when the body was added";
        Self::refused("the handle is of a body of another scene", "", remedy)
    }

    /// Returns the error for a request of the flow before it has been computed for the present state.
    pub(crate) fn not_evaluated(body: &str) -> Self {
        let what = format!("the flow at {body} is not known in the present state");
        Self::refused(what, "", "Call `evaluate` first, or `observe`, which does it for you")
    }

    /// Returns the error for a body so close to a rigid wall that nodes of that spacing make nothing of the flow
    /// between them; all but the time are lengths.
    pub(crate) fn coarse_wall(time: f64, body: &str, gap: f64, spacing: f64, resolved: f64) -> Self {
        let [gap, spacing, resolved] = [gap, spacing, resolved].map(|length| decimals(4, length));
        let what = format!("at time {} the gap between {body} and a rigid wall is {gap}", told(time));
        let value = format!("the nodes of the wall are {spacing} apart there, with which the flow comes out wrong");
        Self::refused(what, value, format!("Give the wall a spacing of {resolved}, or keep {body} away from it"))
    }

    /// Returns the error and its causes in one sentence.
    #[must_use]
    pub fn explanation(&self) -> String {
        motile_base::internal::explanation(self)
    }
}

/// Returns the sentence of [`SceneError::Stagnation`]: of an attempt that ended in an error the error, which has the
/// remedy, first.
fn stagnation(time: f64, steps: [f64; 2], source: Option<&SceneError>) -> String {
    let [dt, least] = told_apart(steps);
    match source {
        Some(source) => format!(
            "{source} (steps as short as the minimum of {least} do not avoid it: the next one would be {dt}, at time \
             {})",
            told(time)
        ),
        None => format!(
            "at time {} the time step would have to fall to {dt}, below the minimum of {least}. Use a larger \
             tolerance, or refine the grid and the markers",
            told(time)
        ),
    }
}

/// Returns the text of a property that may be missing.
fn shown(value: Option<f64>) -> String {
    value.map_or_else(|| "not given".to_owned(), |value| value.to_string())
}

/// Returns true if an error is a refusal whose text contains these words.
#[cfg(test)]
pub(crate) fn refused(error: &SceneError, words: &str) -> bool {
    matches!(error, SceneError::Refused { .. }) && error.to_string().contains(words)
}

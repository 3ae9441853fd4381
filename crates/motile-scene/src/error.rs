//! Errors of scenes, bodies and flows.

use std::sync::Arc;

use motile_base::{InputError, told, told_apart};

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
    #[error("a curve of body {body} has {found} {what}: give it {least} to {most}")]
    Count {
        /// Number of the body, in the order of addition.
        body: usize,
        /// Nodes or points.
        what: &'static str,
        /// How many there are.
        found: usize,
        /// Least number.
        least: usize,
        /// Largest number.
        most: usize,
    },
    /// A marker position or force is not a finite number.
    #[error("{what} of marker {marker} of body {body} is ({x}, {y}): the run has gone wrong, use a smaller time step")]
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
        "marker {marker} of body {body} at ({x:.4}, {y:.4}) is {} beyond the wall, more than {}: \
         move it, or use a smaller time step or a finer grid",
        told_apart([*depth, *allowed])[0], told_apart([*depth, *allowed])[1]
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
         so narrow a gap, and its speed would be off by more than 1 %. Use {needed} nodes or more, or keep the body \
         away from the wall",
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
        "{what} stopped at a relative residual of {} after {iterations} iterations, above {}: \
         where a film between different viscosities has become too thin, use more nodes, a finer grid or a repulsion \
         over a wider range",
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
    /// The method cannot do what the scene asks.
    #[error("{what} is not possible here: {remedy}")]
    Unsupported {
        /// Request.
        what: &'static str,
        /// Alternative.
        remedy: &'static str,
    },
}

motile_base::debug_as_explanation!(FlowError);

impl FlowError {
    /// Wraps an error of a solver, such as a grid solver of your own.
    #[must_use]
    pub fn solver(error: impl std::error::Error + Send + Sync + 'static) -> Self {
        Self::Solver(Arc::new(error))
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
    #[error("{what} number {index} is {value}: use a smaller time step")]
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
        "the interface crosses itself at ({x:.4}, {y:.4}), between markers {first} and {second}: use a smaller time \
         step or activity, or a finer grid"
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
        "{what} has changed by {}{} of its value, more than {}: use a smaller time step or spacing",
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

/// A scene could not be made or advanced. After an error in a step the scene holds the state before that step.
///
/// The text carries the direct cause; [`SceneError::explanation`] tells those of that as well.
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
        "at time {time} {body} overlaps {other} by {} at ({x:.4}, {y:.4}), more than {}: move the bodies apart",
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
    /// Neighbouring interfaces that are periodic along x and give the fluid between them two viscosities.
    #[error(
        "at time {time} the fluid between {body} and {other}, or the image of one, would have the viscosities {} and \
         {}: give both their insides there the same one, or turn one of them",
        told_apart(*viscosities)[0], told_apart(*viscosities)[1],
        time = told(*time)
    )]
    TwoViscosities {
        /// Time of the state.
        time: f64,
        /// The lower interface.
        body: String,
        /// The upper one, or an image of the lower one.
        other: String,
        /// The viscosities (stress times time).
        viscosities: [f64; 2],
    },
    /// A body has come into an interface or out of it in a step.
    #[error(
        "at time {time} {body}, which was {before}, has come to lie {now}: use a smaller time step",
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
        "at time {time} {body} has crossed {other} by {} at ({x:.4}, {y:.4}), more than {}: use a \
         smaller time step, a finer grid or a repulsion between the interfaces",
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
        "at time {time} the gap between {body} and {other} is {} at ({x:.4}, {y:.4}), below the bound of {}: use \
         a finer grid, no grid or a repulsion, or a lower bound if the film between them does not matter",
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
        "at time {time} the scene is not its own mirror image in y = 0, as it is to be held: {body} {problem}",
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
        "time step {} is above the stable {} set by {reason} of {body}: use a smaller one",
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
    /// A stability limit so short that a run would never end.
    #[error(
        "the time step at the start of the run would be {}, set by {reason} of {body}, below {}, with \
         which it takes 1e10 steps: give {body} less activity, tension or stiffness, or run for less time",
        told_apart([*dt, *least])[0], told_apart([*dt, *least])[1]
    )]
    StepTooShort {
        /// The step that is stable (time).
        dt: f64,
        /// The shortest that the run takes (time).
        least: f64,
        /// Reason for the limit.
        reason: &'static str,
        /// Name of the body.
        body: String,
    },
    /// A step size that is a part of the stability limit, where no body states a finite one.
    #[error(
        "at time {time} no body states a bound on the time step that a run could take a part of: give the run \
         `StepSize::Fixed` or `StepSize::Adaptive`, or have a body state one (`Body::step_limits`)",
        time = told(*time)
    )]
    NoStepLimit {
        /// Time of the state.
        time: f64,
    },
    /// Adaptive steps with an integrator whose errors cannot be estimated.
    #[error("the error of a step of {integrator} cannot be estimated: use another step size than `StepSize::Adaptive`")]
    NoErrorEstimate {
        /// The integrator's name.
        integrator: &'static str,
    },
    /// Parts of the motion that an integrator would have to treat implicitly and does not.
    #[error(
        "{integrator} does not step what bodies have implicit, such as the diffusion of particles: use the midpoint \
         rule or the Runge-Kutta-Chebyshev method"
    )]
    ImplicitParts {
        /// The integrator's name.
        integrator: &'static str,
    },
    /// Adaptive steps have become shorter than the bound that was set.
    #[error(
        "at time {time} the time step would have to fall to {}, below the least of {}: take a larger \
         tolerance, or refine the grid and the markers{}",
        told_apart([*dt, *least])[0], told_apart([*dt, *least])[1],
        source.as_ref().map_or_else(String::new, |source| format!("; the last attempt ended because {source}")),
        time = told(*time)
    )]
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
        "at time {time} all {most} steps that the run was allowed are taken: allow more of them or longer ones",
        time = told(*time)
    )]
    TooManySteps {
        /// Time of the state.
        time: f64,
        /// The number allowed.
        most: usize,
    },
    /// The run was told to stop.
    #[error(
        "stopped at time {time}: the state is that of the last complete step, from which the run can go on",
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
    /// A checkpoint that is not of this scene.
    #[error("the checkpoint is of another scene: {problem}")]
    ForeignCheckpoint {
        /// Difference.
        problem: String,
    },
    /// A body that cannot be moved as a whole.
    #[error("{body} cannot be moved as a whole: only droplets, rigid bodies, shells and plain markers can")]
    Immovable {
        /// Name of the body.
        body: String,
    },
    /// A handle of another scene.
    #[error("the handle is of a body of another scene: use the one that this scene gave when the body was added")]
    ForeignHandle,
    /// The flow of the present state is asked for before it has been computed.
    #[error("the flow at {body} is not known in the present state: call `evaluate` first, or `observe`, which does")]
    NotEvaluated {
        /// The body's name.
        body: String,
    },
    /// A checkpoint of a scene whose fluid or bodies are made of something else.
    #[error(
        "the checkpoint is of other physics: for {of}, {property} is {} in it and {} here; resume with what it was \
         saved with",
        shown(*saved),
        shown(*present)
    )]
    OtherProperty {
        /// The body, or the scene.
        of: String,
        /// Name of the property.
        property: String,
        /// Its value in the checkpoint, if it has one there.
        saved: Option<f64>,
        /// Its value in the present scene.
        present: Option<f64>,
    },
    /// An observer failed.
    #[error("an observer failed at time {time}: {source}", time = told(*time))]
    Observer {
        /// Time of the state.
        time: f64,
        /// Cause.
        source: Box<dyn std::error::Error + Send + Sync>,
    },
}

motile_base::debug_as_explanation!(SceneError);

fn shown(value: Option<f64>) -> String {
    value.map_or_else(|| "not given".to_owned(), |value| value.to_string())
}

impl SceneError {
    /// The error and its causes in one sentence.
    #[must_use]
    pub fn explanation(&self) -> String {
        motile_base::explanation(self)
    }
}

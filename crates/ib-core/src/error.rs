//! What can go wrong in a scene.

use stokes_grid::StokesError;

/// The flow could not be computed.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum FlowError {
    /// The grid solver refused.
    #[error(transparent)]
    Stokes(#[from] StokesError),
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
        "marker {marker} of body {body} at ({x}, {y}) is {depth} beyond the wall, more than {allowed}: \
         use a smaller time step or a finer grid"
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
        /// How far beyond (length).
        depth: f64,
        /// What is allowed (length).
        allowed: f64,
    },
    /// An iteration did not converge.
    #[error("{what} stopped at a relative residual of {residual:e} after {iterations} iterations, above {tolerance:e}")]
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
    /// A parameter out of its range.
    #[error("{name} is {value}: {remedy}")]
    Parameter {
        /// The parameter.
        name: &'static str,
        /// Its value.
        value: f64,
        /// What to give instead.
        remedy: &'static str,
    },
    /// The method cannot do what the scene asks.
    #[error("{what} is not possible here: {remedy}")]
    Unsupported {
        /// What was asked for.
        what: &'static str,
        /// What to do instead.
        remedy: &'static str,
    },
    /// Slices of different length.
    #[error("{name} has {found} entries where {expected} are needed")]
    WrongLength {
        /// The slice.
        name: &'static str,
        /// Entries needed.
        expected: usize,
        /// Entries given.
        found: usize,
    },
}

/// A body is in a state that it cannot be in.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum BodyError {
    /// A state that is not finite.
    #[error("{what} number {index} is {value}: use a smaller time step")]
    NonFinite {
        /// The quantity.
        what: &'static str,
        /// Which one.
        index: usize,
        /// Its value.
        value: f64,
    },
    /// An interface crosses itself.
    #[error("the interface crosses itself between markers {first} and {second}: use a smaller time step or activity")]
    SelfCrossing {
        /// A segment by its first marker.
        first: usize,
        /// The other segment.
        second: usize,
    },
    /// A bound on a conserved quantity was exceeded.
    #[error("{what} has changed by {change:e} of its value, more than {bound:e}: use a smaller time step or spacing")]
    NotConserved {
        /// The quantity.
        what: &'static str,
        /// Relative change.
        change: f64,
        /// What is allowed.
        bound: f64,
    },
    /// An error of the body's own.
    #[error(transparent)]
    Other(Box<dyn std::error::Error + Send + Sync>),
}

/// A scene could not be made or advanced. After an error in a step the scene holds the state before that step.
#[derive(Debug, thiserror::Error)]
#[non_exhaustive]
pub enum SceneError {
    /// The flow could not be computed.
    #[error("at time {time}: {source}")]
    Flow {
        /// Time at the start of the step.
        time: f64,
        /// Why.
        source: FlowError,
    },
    /// A body went wrong.
    #[error("at time {time}, {body}: {source}")]
    Body {
        /// Time at the start of the step.
        time: f64,
        /// The body's name.
        body: String,
        /// Why.
        source: BodyError,
    },
    /// A time step above the stable one.
    #[error("time step {dt} is above the stable {limit:.3e} set by {reason} of {body}: use a smaller one")]
    TimeStepTooLarge {
        /// The step asked for (time).
        dt: f64,
        /// The largest stable one (time).
        limit: f64,
        /// What limits it.
        reason: &'static str,
        /// Which body.
        body: String,
    },
    /// A time or time step that makes no sense.
    #[error("{name} is {value}: give {remedy}")]
    Time {
        /// The quantity.
        name: &'static str,
        /// Its value.
        value: f64,
        /// What to give.
        remedy: &'static str,
    },
    /// An observer failed.
    #[error("an observer failed at time {time}: {source}")]
    Observer {
        /// When.
        time: f64,
        /// Why.
        source: Box<dyn std::error::Error + Send + Sync>,
    },
}

//! Errors of droplets.

use active_interface::InterfaceError;
use motile_base::{InputError, Refusal, internal::Refuse};
use motile_scene::SceneError;
use sphere_harmonics::HarmonicsError;

/// A droplet cannot be made, evaluated or advanced. The message says what to do.
#[derive(Clone, thiserror::Error)]
#[non_exhaustive]
pub enum SpaceError {
    /// A number or list that cannot be used.
    #[error(transparent)]
    Input(#[from] InputError),
    /// A degree that cannot be used.
    #[error(transparent)]
    Harmonics(#[from] HarmonicsError),
    /// A request that cannot be met.
    #[error(transparent)]
    Refused(#[from] Refusal),
    /// An error of the integrator, in words.
    #[error("{0}")]
    Integrator(String),
    /// A shape that does not enclose a volume, or that the degree cannot resolve.
    #[error(
        "at time {time} the surface {problem}. Use a higher degree than {degree}, a smaller time step, or a smoother \
         shape"
    )]
    Shape {
        /// Time of the state.
        time: f64,
        /// Degree of the harmonics.
        degree: usize,
        /// The problem in words.
        problem: &'static str,
    },
    /// A droplet crosses a wall.
    #[error("at time {time} droplet {droplet} crosses {wall}. {remedy}")]
    Wall {
        /// Time of the state.
        time: f64,
        /// Number of the droplet.
        droplet: usize,
        /// The wall and what is known of the distance, in words.
        wall: String,
        /// The remedy.
        remedy: &'static str,
    },
    /// Two droplets overlap.
    #[error(
        "at time {time} droplets {first} and {second} overlap. Move them apart, or use a repulsion or shorter steps"
    )]
    Overlap {
        /// Time of the state.
        time: f64,
        /// Number of one droplet.
        first: usize,
        /// Number of the other.
        second: usize,
    },
    /// The velocities for two viscosities were not found.
    #[error(
        "the flow for the viscosities {inside} inside and {outside} outside was not found: the residual is \
         {residual:.1e} after {iterations} iterations. Use a ratio closer to 1 or a higher degree"
    )]
    NotConverged {
        /// Viscosity inside.
        inside: f64,
        /// Viscosity outside.
        outside: f64,
        /// Residual over right-hand side.
        residual: f64,
        /// Products.
        iterations: usize,
    },
    /// Newton's method did not find a steady state.
    #[error(
        "no steady state was found: the residual is {residual:.1e} after {iterations} iterations. Start closer to the \
         steady state, for example from the end of a longer run, or use a higher degree"
    )]
    NoSteadyState {
        /// Largest rate of change, in units of the state per time.
        residual: f64,
        /// Iterations.
        iterations: usize,
    },
    /// Adaptive steps became too short.
    #[error(
        "at time {time} the time step would have to fall to {step:.1e}. Use a larger tolerance, a higher degree or a \
         weaker activity"
    )]
    Stagnation {
        /// Time of the state.
        time: f64,
        /// The step.
        step: f64,
    },
}

motile_base::debug_as_explanation!(SpaceError);

impl From<InterfaceError> for SpaceError {
    fn from(error: InterfaceError) -> Self {
        Self::refused(error.to_string(), "", "Change this value of the tension law")
    }
}

impl From<SpaceError> for SceneError {
    fn from(error: SpaceError) -> Self {
        match error {
            SpaceError::Input(error) => error.into(),
            SpaceError::Refused(refusal) => refusal.into(),
            other => {
                let text = other.to_string();
                let (what, remedy) = text.split_once(". ").unwrap_or((&text, "Use a smaller time step"));
                Self::refused(what, "", remedy)
            }
        }
    }
}

impl From<SceneError> for SpaceError {
    fn from(error: SceneError) -> Self {
        match error {
            SceneError::Input(error) => error.into(),
            SceneError::Refused(refusal) => refusal.into(),
            other => Self::Integrator(other.to_string()),
        }
    }
}

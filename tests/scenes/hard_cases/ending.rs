//! How runs end.

use motile::SetupError;
use motile::active_interface::InterfaceError;
use motile::base::InputError;
use motile::elastic_solids::SolidError;
use motile::scene::{BodyError, FlowError, SceneError};

/// A case that could not be made.
#[derive(Debug, thiserror::Error)]
#[error(transparent)]
pub(crate) enum CaseError {
    /// The droplet's scene.
    Setup(#[from] SetupError),
    /// The droplet.
    Interface(#[from] InterfaceError),
    /// The solid.
    Solid(#[from] SolidError),
    /// The flow.
    Flow(#[from] FlowError),
    /// The grid.
    Stokes(#[from] motile::stokes_grid::StokesError),
    /// A body's state.
    Body(#[from] BodyError),
    /// The scene.
    Scene(#[from] SceneError),
}

/// How a run ended.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Ending {
    /// At the time it was to run to.
    Finished,
    /// Refused, the time step being above the stable one.
    StepTooLarge,
    /// Steps became too short.
    Stagnated,
    /// More steps than allowed.
    TooManySteps,
    /// Particles collapsed to a point.
    Collapsed,
    /// An interface crossed itself.
    SelfCrossing,
    /// An interface crossed another one, its image or a solid.
    Crossing,
    /// A marker went beyond a wall.
    BeyondWall,
    /// Area or particles changed too much.
    NotConserved,
    /// An inverted triangle.
    Inverted,
    /// The surface of a solid touched itself.
    SelfContact,
    /// Values that are not finite.
    NonFinite,
    /// An iteration did not converge.
    NotConverged,
    /// At its time, but elsewhere than the same run in other units.
    Differs,
    /// Something else.
    Other,
}

impl From<&Result<(), SceneError>> for Ending {
    fn from(outcome: &Result<(), SceneError>) -> Self {
        match outcome {
            Ok(()) => Self::Finished,
            Err(error) => Self::of(error),
        }
    }
}

impl Ending {
    /// Which ending an error is.
    pub(crate) fn of(error: &SceneError) -> Self {
        match error {
            SceneError::TimeStepTooLarge { .. } => Self::StepTooLarge,
            SceneError::Stagnation { .. } => Self::Stagnated,
            SceneError::TooManySteps { .. } => Self::TooManySteps,
            SceneError::Crossing { .. } => Self::Crossing,
            SceneError::Body { source, .. } => Self::of_body(source),
            SceneError::Flow { source, .. } => match source {
                FlowError::BeyondWall { .. } => Self::BeyondWall,
                FlowError::NonFinite { .. } => Self::NonFinite,
                FlowError::NoConvergence { .. } => Self::NotConverged,
                _ => Self::Other,
            },
            _ => Self::Other,
        }
    }

    fn of_body(error: &BodyError) -> Self {
        match error {
            BodyError::NonFinite { .. } => Self::NonFinite,
            BodyError::SelfCrossing { .. } => Self::SelfCrossing,
            BodyError::NotConserved { .. } => Self::NotConserved,
            BodyError::Other(source) => match source.downcast_ref::<SolidError>() {
                Some(SolidError::Inverted { .. }) => Self::Inverted,
                Some(SolidError::SelfContact { .. }) => Self::SelfContact,
                _ => match source.downcast_ref::<InterfaceError>() {
                    Some(InterfaceError::Collapse { .. }) => Self::Collapsed,
                    Some(InterfaceError::SelfCrossing { .. }) => Self::SelfCrossing,
                    Some(InterfaceError::Input(InputError::EntryNotFinite { .. } | InputError::NotFinite { .. })) => {
                        Self::NonFinite
                    }
                    _ => Self::Other,
                },
            },
            _ => Self::Other,
        }
    }
}

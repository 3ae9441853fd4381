//! Errors as the page shows them.

use std::fmt;

use motile::SetupError;
use motile::scene::SceneError;
use motile_output::OutputError;
use motile_steady_states::SteadyError;
use serde::Serialize;

/// Error with the key, the value and the remedy where they are known.
#[derive(Debug, Clone, PartialEq, Eq, Serialize)]
pub struct Refusal {
    /// Whole message.
    pub message: String,
    /// Key of the value in the description.
    pub key: Option<String>,
    /// The value.
    pub value: Option<String>,
    /// Remedy.
    pub remedy: Option<String>,
}

impl Refusal {
    /// Error of nothing but a message.
    #[must_use]
    pub fn plain(message: impl fmt::Display) -> Self {
        Self { message: message.to_string(), key: None, value: None, remedy: None }
    }
}

impl fmt::Display for Refusal {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.message)
    }
}

impl std::error::Error for Refusal {}

impl From<SetupError> for Refusal {
    fn from(error: SetupError) -> Self {
        let message = error.to_string();
        match error {
            SetupError::Value { key, value, remedy } => {
                Self { message, key: Some(key), value: Some(value), remedy: Some(remedy) }
            }
            SetupError::Entry { key, .. } | SetupError::Overlap { key, .. } | SetupError::Touch { key, .. } => {
                Self { key: Some(key), ..Self::plain(message) }
            }
            _ => Self::plain(message),
        }
    }
}

impl From<SceneError> for Refusal {
    fn from(error: SceneError) -> Self {
        Self::plain(error)
    }
}

impl From<OutputError> for Refusal {
    fn from(error: OutputError) -> Self {
        Self::plain(error)
    }
}

impl From<SteadyError> for Refusal {
    fn from(error: SteadyError) -> Self {
        match error {
            SteadyError::Setup(error) => error.into(),
            other => Self::plain(other),
        }
    }
}

impl From<Box<dyn std::error::Error + Send + Sync>> for Refusal {
    fn from(error: Box<dyn std::error::Error + Send + Sync>) -> Self {
        Self::plain(error)
    }
}

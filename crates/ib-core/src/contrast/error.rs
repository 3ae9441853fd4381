//! Errors of layer potentials as errors of a flow.

use stokes_layers::LayerError;

use crate::FlowError;

impl From<LayerError> for FlowError {
    fn from(error: LayerError) -> Self {
        match error {
            LayerError::NonFinite { what, curve, point, x, y } => {
                Self::NonFinite { what, body: curve, marker: point, x, y }
            }
            LayerError::BeyondWall { curve, node, x, y, depth, allowed } => {
                Self::BeyondWall { body: curve, marker: node, x, y, depth, allowed }
            }
            LayerError::NoConvergence { iterations, residual, tolerance } => {
                Self::NoConvergence { what: "the solution for a viscosity contrast", iterations, residual, tolerance }
            }
            LayerError::Input(error) => Self::Input(error),
            LayerError::Clockwise { .. } => Self::Unsupported {
                what: "an interface whose markers run clockwise or that crosses itself",
                remedy: "give its markers in counter-clockwise order",
            },
            other => Self::Layers(other),
        }
    }
}

//! Errors of the solvers as errors of flows.

use motile_scene::FlowError;
use stokes_boundary_integrals::LayerError;
use stokes_grid::StokesError;

/// Turns an error of the boundary integrals into an error of the flow, in the words of bodies and markers.
pub(crate) fn of_layers(error: LayerError) -> FlowError {
    match error {
        LayerError::NonFinite { what, curve, point, x, y } => {
            FlowError::NonFinite { what, body: curve, marker: point, x, y }
        }
        LayerError::BeyondWall { curve, node, x, y, depth, allowed } => {
            FlowError::BeyondWall { body: curve, marker: node, x, y, depth, allowed }
        }
        LayerError::NoConvergence { iterations, residual, tolerance } => {
            let what = "the iteration for the velocities of interfaces and rigid bodies";
            FlowError::NoConvergence { what, iterations, residual, tolerance }
        }
        LayerError::Count { kind: "curve", curve, what, found, least, most } => {
            FlowError::Count { body: curve, what, found, least, most }
        }
        LayerError::NarrowGap { curve, gap, least, nodes, needed } => {
            FlowError::NarrowGap { body: curve, gap, least, nodes, needed }
        }
        LayerError::Input(error) => FlowError::Input(error),
        LayerError::Clockwise { .. } => FlowError::unsupported(
            "an interface whose markers run clockwise or that crosses itself",
            "List its markers in counter-clockwise order",
        ),
        other => FlowError::solver(other),
    }
}

/// Turns an error of a grid solver into an error of the flow.
pub(crate) fn of_grid(error: StokesError) -> FlowError {
    match error {
        StokesError::Input(error) => FlowError::Input(error),
        other => FlowError::solver(other),
    }
}

//! Refusals of surfaces and regions that are not axisymmetric, or that the solver cannot use.

use motile_base::{
    Vec2,
    internal::{Refuse as _, decimals, place},
};
use stokes_boundary_integrals::LayerError;

/// Returns the surfaces with singular equations.
pub(crate) fn singular_surfaces() -> LayerError {
    let remedy = "Use more nodes, or leave more fluid between the surfaces";
    LayerError::refused("the velocities of the surfaces are not determined", "their equations are singular", remedy)
}

/// Returns a two-dimensional region.
pub(crate) fn in_two_dimensions() -> LayerError {
    let remedy = "Use the region `space` or `tube`, or `InterfaceFlow`";
    LayerError::refused("the region is two-dimensional, but this flow is axisymmetric", "", remedy)
}

/// Disturbances of another number of interfaces than one.
pub(crate) fn not_one_interface(found: usize) -> LayerError {
    let value = format!("{found} are loaded");
    let remedy = "Load one interface and no rigid body";
    LayerError::refused("disturbances are computed for one axisymmetric interface only", value, remedy)
}

/// Returns the surfaces that leave too little room in a length of a straight tube whose pressure is prescribed.
pub(crate) fn short_tube(length: f64, least: f64) -> LayerError {
    let what = format!("the tube of length {length}, for which the pressure is prescribed, is too short");
    let value = "the surfaces in it and the next ones are less than a radius apart";
    LayerError::refused(
        what,
        value,
        format!("Use a length of at least {}, or prescribe the flux instead", decimals(4, least)),
    )
}

/// Returns a meridian that meets the axis between its poles, at this coordinate x.
pub(crate) fn meets_axis(curve: usize, x: f64) -> LayerError {
    let what = format!("curve {curve} meets the axis between its poles, at x = {}", decimals(4, x));
    let remedy = "Keep the meridian off the axis. If this ended a run, a neck has pinched: the droplet would become \
                  two droplets, which the model does not describe";
    LayerError::refused(what, "", remedy)
}

/// Returns a curve with an odd number of points.
pub(crate) fn odd_points(found: usize) -> LayerError {
    let remedy = "Use an even number";
    LayerError::refused("an axisymmetric curve needs an even number of points", format!("it has {found}"), remedy)
}

/// Returns the error for a curve whose point has no mirror image in the x axis.
pub(crate) fn not_axisymmetric(curve: usize, point: usize, Vec2 { x, y }: Vec2) -> LayerError {
    let value = format!("point {point} at {} has no mirror image in the x axis", place(x, y));
    let remedy =
        "Use an even number of points, the first on the x axis, and let each be the mirror image of its partner";
    LayerError::refused(format!("curve {curve} is not axisymmetric"), value, remedy)
}

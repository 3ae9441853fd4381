//! Errors of interfaces and of what is computed on them.

use motile_base::{
    InputError, Refusal, Vec2,
    internal::{Refuse, given, place, told, told_apart},
};

/// An error of this crate; its message has the offending values and the remedy.
#[derive(Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum InterfaceError {
    /// A number or list that cannot be used.
    #[error(transparent)]
    Input(#[from] InputError),
    /// A curve that crosses or touches itself.
    #[error("the curve crosses itself {place}: {remedy}")]
    SelfCrossing {
        /// Where, as it reads after "crosses itself".
        place: String,
        /// Remedy.
        remedy: &'static str,
    },
    /// An iteration that did not converge.
    #[error(
        "{what} stopped at a residual of {}, above {}. {remedy}",
        told_apart([*residual, *tolerance])[0], told_apart([*residual, *tolerance])[1]
    )]
    NoConvergence {
        /// The iteration.
        what: &'static str,
        /// Residual reached.
        residual: f64,
        /// Residual asked for.
        tolerance: f64,
        /// Remedy.
        remedy: &'static str,
    },
    /// A tension law without a plateau has drawn the particles together to a point.
    #[error(
        "{part:.2} of all particles are on one interface element: the tension law does not level off, so they collapse \
         towards a point at any resolution. Use a law that levels off, for example with an \
         excluded volume stronger than the activity"
    )]
    Collapse {
        /// Fraction of the particles on the fullest segment.
        part: f64,
    },
    /// A curve, interface, concentration or fit that cannot be used.
    #[error(transparent)]
    Refused(#[from] Refusal),
}

motile_base::debug_as_explanation!(InterfaceError);

impl InterfaceError {
    /// Returns the error for an arc of a corner that is too large for the side of that length that starts there, which
    /// takes another radius at most (all length).
    pub(crate) fn rounding_too_large(radius: f64, corner: Vec2, side: f64, most: f64) -> Self {
        let what = format!("corners cannot be rounded with the radius {}", told(radius));
        let value = format!("the side at {} has the length {} only", place(corner.x, corner.y), told(side));
        Self::refused(what, value, format!("Use at most {} as the radius, or fewer points", told(most)))
    }

    /// Returns the error for a law whose tension (force) is not finite at a concentration (particles per length).
    pub(crate) fn tension_not_finite(tension: f64, c: f64) -> Self {
        let what = format!("the tension law returns {tension} at c = {}", told(c));
        Self::refused(what, "", "Correct the law, so that it is finite at any concentration from 0 on")
    }

    /// Returns the error for a field that is not finite at a place.
    pub(crate) fn field_not_finite(Vec2 { x, y }: Vec2) -> Self {
        let what = format!("a field that the interface feels is not finite at {}", place(x, y));
        Self::refused(what, "", "Use a field that is finite wherever the interface goes")
    }

    /// Returns the error for a wave (radians per length) that does not fit a period (length).
    pub(crate) fn wave_does_not_fit(wave: f64, period: f64, nearest: f64) -> Self {
        let what = format!("a wave of the wave number {} does not fit the period {}", told(wave), told(period));
        Self::refused(what, "it would jump there", format!("Use {nearest:.10e}, or another multiple of 2 pi over it"))
    }

    /// Returns the error for a spot that is wider than a period (both length).
    pub(crate) fn spot_too_wide(radius: f64, period: f64) -> Self {
        let [radius, period] = told_apart([radius, period]);
        let value = format!("its radius is {radius} and the period is {period}");
        Self::refused("a spot is wider than the period that it repeats with", value, "Use a smaller radius")
    }

    /// Returns the error for a table that does not cover a period (both length).
    pub(crate) fn table_does_not_fit(count: usize, length: f64, period: f64) -> Self {
        let [length, period] = told_apart([length, period]);
        let value = format!("{count} values cover {length}, and the period is {period}");
        let remedy = "Use a spacing of the period over the number of values, without the value at its end";
        Self::refused("a table does not repeat with the period of the region", value, remedy)
    }

    /// Returns the error for a table whose rows have different lengths.
    pub(crate) fn ragged_table(first: usize, other: usize) -> Self {
        let value = format!("one has {first} values and another {other}");
        Self::refused("the rows of a table have different lengths", value, "Use rows of the same length")
    }

    /// Returns the error for a field of the exchange on an interface without one.
    pub(crate) fn no_exchange(name: &str) -> Self {
        let what = format!("there is a field of the {name}, but the interface exchanges no particles");
        Self::refused(what, "", "Use it for a droplet with a well-mixed inside, or remove it")
    }

    /// Returns the error for a field of the activity on an interface without particles.
    pub(crate) fn no_particles_to_feel() -> Self {
        let what = "there is a field of the activity, but no particles that have one";
        Self::refused(what, "", "Use a field of the tension, or give the interface particles")
    }

    /// Returns the error for noise on an interface without particles.
    pub(crate) fn nothing_to_shake() -> Self {
        let what = "there is noise on particles, but the interface has none";
        Self::refused(what, "", "Remove the noise, or give the interface particles")
    }

    /// Returns the error for a field that is not symmetric about the axis.
    pub(crate) fn field_not_axisymmetric(name: &str) -> Self {
        let what = format!("the field of the {name} is not symmetric about the axis of a body of revolution");
        Self::refused(what, "", "Use slopes and wave vectors along x, centres on the axis, and symmetric tables")
    }

    /// Returns the error for a field that differs between the ends of a period (length).
    pub(crate) fn field_not_periodic(here: f64, there: f64, period: f64) -> Self {
        let [here, there] = told_apart([here, there]);
        let value = format!("it is {here} at one end and {there} at the other, {period} further along x");
        let remedy = "Use a wave that fits the period, or a slope across it";
        Self::refused("a field is not periodic along an interface that is", value, remedy)
    }

    /// Returns the error for a rate of the exchange that a field makes negative.
    pub(crate) fn negative_rate(name: &str, rate: f64, Vec2 { x, y }: Vec2) -> Self {
        let what = format!("the rate of {name} with its field is {} at {}", told(rate), place(x, y));
        Self::refused(what, "rates are not negative", "Use a weaker field, or a higher rate")
    }

    /// Returns the error for friction that a field makes negative.
    pub(crate) fn negative_friction(friction: f64, Vec2 { x, y }: Vec2) -> Self {
        let what = format!("the friction with its field is {} at {}", told(friction), place(x, y));
        Self::refused(what, "friction is not negative", "Use a weaker field, or a higher friction")
    }

    /// Returns the error for friction with walls that do not exist.
    pub(crate) fn no_walls_to_rub() -> Self {
        let what = "the friction with walls needs the straight walls of a channel";
        Self::refused(what, "there are none", "Use a channel, or leave the friction with walls out")
    }

    /// Returns the error for a marker of an axisymmetric interface that has no mirror image.
    pub(crate) fn not_axisymmetric(marker: Vec2) -> Self {
        let what = format!("the marker at {} has no mirror image in the x axis", place(marker.x, marker.y));
        Self::refused(what, "", AXISYMMETRIC)
    }

    /// Returns the error for an axisymmetric interface whose markers move with the fluid.
    pub(crate) fn moving_meridian() -> Self {
        Self::refused("the markers of an axisymmetric interface cannot move with the fluid", "", AXISYMMETRIC)
    }

    /// Returns the error for particles of an axisymmetric interface that differ from their mirror image.
    pub(crate) fn particles_not_axisymmetric(segment: usize, number: f64, image: f64) -> Self {
        let [number, image] = told_apart([number, image]);
        let value = format!("segment {segment} has {number} particles and its mirror image has {image}");
        let remedy = "Use numbers that are symmetric about the x axis, for example with a heading along it";
        Self::refused("the particles of an axisymmetric interface are not symmetric", value, remedy)
    }

    /// Returns the error for an entry that is not positive in a list of positive numbers.
    pub(crate) fn entry_not_positive(name: &str, index: usize, value: f64) -> Self {
        Self::refused(format!("entry {index} of {name} is {}", given(value)), "", "Use positive finite numbers only")
    }

    /// Returns the error for a curve whose end is not its start.
    pub(crate) fn not_closed(gap: f64) -> Self {
        let value = format!("its end is {gap:.3e} away from its start");
        Self::refused("the curve is not closed", value, "Make it periodic in its parameter")
    }

    /// Returns the error for a curve that does not meet its next image.
    pub(crate) fn not_periodic(gap: f64, advance: f64, spacing: f64) -> Self {
        let value = format!(
            "the image of its first point, {advance} further along x, is {gap:.3e} from its last point, but neighbours \
             are at most {spacing:.3e} apart"
        );
        let remedy = "List the points of one period, without the image of the first point";
        Self::refused("the curve does not close across the period", value, remedy)
    }

    /// Returns the error for elasticity of a closed interface.
    pub(crate) fn closed_membrane() -> Self {
        let remedy = "Use a shell for a closed elastic membrane";
        Self::refused("only interfaces that are periodic along x can be elastic", "this interface is closed", remedy)
    }

    /// Returns the error for a concentration by the polar angle on a curve that goes around nothing.
    pub(crate) fn no_polar_angle() -> Self {
        let what = "an interface that is periodic along x has no polar angle";
        Self::refused(what, "", "Describe the concentration by the arc length")
    }

    /// Returns the error for a polygon whose moments of area belong to no shape.
    pub(crate) fn crossed() -> Self {
        let what = "the second moments of area of the polygon are not positive";
        Self::refused(what, "it crosses itself", "Reorder or move its points")
    }

    /// Returns the error for two successive points of a curve that coincide.
    pub(crate) fn coincident_points(index: usize) -> Self {
        Self::refused(format!("point {index} of the curve coincides with the next one"), "", "Remove one of them")
    }

    /// Returns the error for an elastic interface that is compressed to nearly nothing, which the energy of its
    /// stretching does not prevent.
    pub(crate) fn crushed(stretch: f64, least: f64, Vec2 { x, y }: Vec2) -> Self {
        let what = format!("the elastic interface is compressed to {stretch:.3} of its length near {}", place(x, y));
        let value = format!("below {least} of the length at rest, its stretching energy no longer resists");
        Self::refused(what, value, "Use a larger modulus, or weaker activity of its particles")
    }

    /// Returns the error for a curve through points, two segments of which cross, by their first points.
    pub(crate) fn crossing_points(first: usize, second: usize) -> Self {
        let place = format!("between the segments that start at points {first} and {second}");
        Self::SelfCrossing { place, remedy: "Move or reorder its points" }
    }

    /// Returns the error for a curve of a function that crosses itself at two parameters.
    pub(crate) fn crossing_parameters(first: f64, second: f64) -> Self {
        let place = format!("near the parameters {first:.4} and {second:.4}");
        Self::SelfCrossing { place, remedy: "Use a function whose values are different between 0 and 2 pi" }
    }

    /// Returns the error for markers on a simple curve that are too few, so that the polygon through them crosses
    /// itself.
    pub(crate) fn crossing_markers(place: Vec2, count: usize) -> Self {
        let place = format!("near ({:.4}, {:.4}), as the polygon of {count} markers on it", place.x, place.y);
        Self::SelfCrossing { place, remedy: "Use more markers, or a curve with wider necks" }
    }

    /// Returns the error for a smooth curve through points that leaves their polygon, however many points it goes
    /// through on a side.
    pub(crate) fn strays(point: usize) -> Self {
        let what = format!("the smooth curve through the points leaves the polygon through them next to point {point}");
        let value = "the distances between its neighbours are too different";
        Self::refused(what, value, "Remove points that nearly coincide, or add points there")
    }

    /// Returns the error for points whose distances are too uneven.
    pub(crate) fn uneven_spacing(ratio: f64, bound: f64) -> Self {
        let [ratio, bound] = told_apart([ratio, bound]);
        let value = format!("the longest distance between neighbours is {ratio} times the shortest, more than {bound}");
        Self::refused("the points of the curve are spaced too unevenly", value, "Space them evenly")
    }

    /// Returns the error for a curve that encloses no area.
    pub(crate) fn no_area(area: f64, length: f64) -> Self {
        let value = format!("it is {area:.3e}, too small for the length {length:.4} of the curve");
        Self::refused("the curve encloses no area", value, "Use points that do not lie on a line")
    }

    /// Returns the error for a curve in polar form whose radius is not positive everywhere.
    pub(crate) fn radius_not_positive(radius: f64, angle: f64) -> Self {
        let what = format!("the radius is {radius:.3e} at the polar angle {angle:.4}");
        Self::refused(what, "it must be positive everywhere", "Use smaller amplitudes of the modes")
    }

    /// Returns the error for a shear viscosity of the cortex of a line.
    pub(crate) fn sheared_line() -> Self {
        let what = "a line in two dimensions has no shear viscosity";
        Self::refused(what, "it has no shear along itself", "Use the viscosity of the cortex alone")
    }

    /// Returns the error for an interface that does not stretch where its constraint is not resolved.
    pub(crate) fn unresolved_membrane() -> Self {
        let what = "a membrane that does not stretch";
        let remedy = "Use a region in two dimensions, and the method integral or layers";
        Self::refused(what, "it is resolved in two dimensions only, and not on a grid", remedy)
    }

    /// Returns the error for a round droplet whose interface does not stretch.
    pub(crate) fn round_membrane() -> Self {
        let what = "a round droplet whose membrane does not stretch";
        let remedy = "Start from a longer outline of the same area, such as an ellipse";
        Self::refused(what, "it cannot deform, because a circle has the shortest outline of its area", remedy)
    }

    /// Returns the error for friction of a body of revolution.
    pub(crate) fn resisting_revolution() -> Self {
        let what = "a body of revolution has no friction with a substrate";
        Self::refused(what, "a substrate touches it on one side", "Remove it, or use a region in two dimensions")
    }

    /// Returns the error for a cortex where the flow near the markers is of first order.
    pub(crate) fn cortex_on_plain_grid() -> Self {
        let what = "a cortex needs more accurate velocities than a grid without the mobility correction has: speeds \
                    would be off by several per cent";
        Self::refused(what, "", "Use equidistributed markers with the correction, layers or boundary integrals")
    }

    /// Returns the error for bending of an interface through whose markers no smooth curve goes.
    pub(crate) fn uneven_bending() -> Self {
        let what = "bending needs a fixed number of markers in two dimensions";
        Self::refused(what, "", "Move the markers by Motion::Equidistributed")
    }

    /// Returns the error for a force on the inside of an interface that is periodic along x.
    pub(crate) fn open_body_force() -> Self {
        let what = "a force on the inside of an interface that is periodic along x";
        Self::refused(what, "a layer has no inside of its own", "Use a droplet, or a pressure gradient along a channel")
    }

    /// Returns the error for a body force in the plane.
    pub(crate) fn pushed_plane() -> Self {
        let what = "a body force in the plane, where nothing holds a fluid that is pushed";
        Self::refused(what, "no speed exists there (Stokes' paradox)", "Use a periodic box or a channel")
    }

    /// Returns the error for a force (force) across the axis of a body of revolution.
    pub(crate) fn force_across_axis(force: f64) -> Self {
        let what = format!("the body force across the axis is {}", told(force));
        Self::refused(what, "it would push an axisymmetric body off its axis", "Use a force along x only")
    }

    /// Returns the error for particle numbers with a negative sum.
    pub(crate) fn no_particles(total: f64) -> Self {
        let what = format!("the particle numbers add up to {}", told(total));
        Self::refused(what, "", "Use numbers with a positive sum, or a smaller time step")
    }

    /// Returns the error for points that do not determine what is fitted to them.
    pub(crate) fn no_fit(what: &str, points: usize) -> Self {
        let what = format!("the {points} points do not determine a fit of {what}");
        Self::refused(what, "", "Use more points, or a longer part of the curve")
    }
}

/// Remedy for interfaces that are not axisymmetric.
const AXISYMMETRIC: &str =
    "Use an even number of markers, equidistributed, the first on the axis, and a heading along it";

/// Checks that all entries are positive and finite.
pub(crate) fn all_positive(name: &'static str, values: &[f64]) -> Result<(), InterfaceError> {
    match values.iter().position(|&value| !(value > 0.0 && value.is_finite())) {
        None => Ok(()),
        Some(index) => Err(InterfaceError::entry_not_positive(name, index, values[index])),
    }
}

/// Returns true if an error is a refusal whose text contains these words.
#[cfg(test)]
pub(crate) fn refused(error: &InterfaceError, words: &str) -> bool {
    matches!(error, InterfaceError::Refused { .. }) && error.to_string().contains(words)
}

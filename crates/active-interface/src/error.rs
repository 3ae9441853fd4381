//! Errors of interfaces and of what is computed on them.

use motile_base::{InputError, told, told_apart};

/// An error of this crate; its message has the offending values and the remedy.
#[derive(Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum InterfaceError {
    /// Markers that are not the meridian of a body of revolution with its mirror image.
    #[error(
        "the marker at ({x:.4}, {y:.4}) has no mirror image at the x axis: give a body of revolution an even number of \
         markers, equidistributed, the first on the axis, and a heading along it"
    )]
    NotAxisymmetric {
        /// x coordinate of the marker (length).
        x: f64,
        /// y coordinate of the marker (length).
        y: f64,
    },
    /// Particles of a body of revolution that are not those of their mirror image.
    #[error(
        "segment {segment} of a body of revolution has {} particles and its mirror image {}: give numbers that are \
         symmetric about the x axis, such as those of a heading along it",
        told_apart([*number, *image])[0], told_apart([*number, *image])[1]
    )]
    ParticlesNotAxisymmetric {
        /// Number of the segment.
        segment: usize,
        /// Its number of particles.
        number: f64,
        /// That of its mirror image.
        image: f64,
    },
    /// A number or list that cannot be used.
    #[error(transparent)]
    Input(#[from] InputError),
    /// An entry that is not positive in a list of positive numbers.
    #[error("entry {index} of {name} is {value}: all entries must be positive and finite")]
    EntryNotPositive {
        /// Name of the list.
        name: &'static str,
        /// Index of the entry.
        index: usize,
        /// Value of the entry.
        value: f64,
    },
    /// A curve whose end is not its start.
    #[error("the curve is not closed: its end is {gap:.3e} away from its start; make it periodic in its parameter")]
    NotClosed {
        /// Distance of end and start (length).
        gap: f64,
    },
    /// A curve that does not meet its next image.
    #[error(
        "the curve does not close across the period: from its last point to the image of its first, {advance} further \
         along x, are {gap:.3e}, and at most {spacing:.3e} between neighbours; give the points of one period, the \
         image of the first left out"
    )]
    NotPeriodic {
        /// Distance of the last point from the image of the first (length).
        gap: f64,
        /// Advance along x (length).
        advance: f64,
        /// Largest distance of other neighbours (length).
        spacing: f64,
    },
    /// Elasticity of a closed interface.
    #[error("elasticity is for interfaces that are periodic along x: an elastic membrane around fluid is a shell")]
    ClosedMembrane,
    /// A concentration by the polar angle on a curve that goes around nothing.
    #[error("an interface that is periodic along x has no polar angle: give the concentration by the arc length")]
    NoPolarAngle,
    /// A curve that crosses or touches itself.
    #[error("the curve crosses itself between the segments that start at points {first} and {second}")]
    SelfCrossing {
        /// A segment by its first point.
        first: usize,
        /// The other segment.
        second: usize,
    },
    /// A polygon that crosses itself, so that its moments of area are not those of a shape.
    #[error("the second moments of area of the polygon are not positive: it crosses itself")]
    Crossed,
    /// Two successive points of a curve that coincide.
    #[error("points {index} and the next one of the curve coincide: remove one of them")]
    CoincidentPoints {
        /// The first of the two.
        index: usize,
    },
    /// An elastic interface that is compressed to nearly nothing, which the energy of its stretching does not prevent.
    #[error(
        "the elastic interface is compressed to {stretch:.3} of its length at rest near ({x:.4}, {y:.4}), below \
         {least}: its energy of stretching does not resist that, give it a larger modulus or its particles less \
         activity"
    )]
    Crushed {
        /// Smallest stretch (no dimension).
        stretch: f64,
        /// Stretch below which a step is an error (no dimension).
        least: f64,
        /// Its place in x (length).
        x: f64,
        /// Its place in y (length).
        y: f64,
    },
    /// Points whose distances are too uneven.
    #[error(
        "the longest distance between neighbouring points is {} times the shortest, more than {}: space them \
         evenly",
        told_apart([*ratio, *bound])[0], told_apart([*ratio, *bound])[1]
    )]
    UnevenSpacing {
        /// Longest over shortest distance.
        ratio: f64,
        /// Largest ratio allowed.
        bound: f64,
    },
    /// A curve that encloses no area.
    #[error("the curve encloses an area of {area:.3e}, too small for its length {length:.4}")]
    NoArea {
        /// Signed area (length squared).
        area: f64,
        /// Length of the curve (length).
        length: f64,
    },
    /// A curve in polar form whose radius is not positive everywhere.
    #[error("the radius is {radius:.3e} at the polar angle {angle:.4}: make the amplitudes of the modes smaller")]
    RadiusNotPositive {
        /// Polar angle (radians).
        angle: f64,
        /// The radius there (length).
        radius: f64,
    },
    /// An iteration that did not converge.
    #[error(
        "{what} stopped at a residual of {}, above {}: {remedy}",
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
        "{part:.2} of all particles are on one segment: the tension law has no plateau, so that they collapse towards \
         a point at any resolution; use an activity below the strength of the excluded volume"
    )]
    Collapse {
        /// Part of the particles on the fullest segment.
        part: f64,
    },
    /// Bending of an interface whose markers are inserted and removed, so that no smooth curve goes through them, or of
    /// one of revolution.
    #[error("bending needs a fixed number of markers in two dimensions: move them by Motion::Equidistributed")]
    UnevenBending,
    /// Negative particle numbers without as many particles elsewhere to make up for them.
    #[error(
        "the particle numbers add up to {}: give numbers with a positive sum, or a smaller time step",
        told(*total)
    )]
    NoParticles {
        /// Sum of the particle numbers.
        total: f64,
    },
    /// Points that do not determine what is fitted to them.
    #[error("{points} points that lie as these do determine no fit of {what}: give more of them, or a longer part")]
    NoFit {
        /// Model of the fit.
        what: &'static str,
        /// Number of points.
        points: usize,
    },
}

motile_base::debug_as_explanation!(InterfaceError);

/// Checks that all entries are positive and finite.
pub(crate) fn all_positive(name: &'static str, values: &[f64]) -> Result<(), InterfaceError> {
    match values.iter().position(|&value| !(value > 0.0 && value.is_finite())) {
        None => Ok(()),
        Some(index) => Err(InterfaceError::EntryNotPositive { name, index, value: values[index] }),
    }
}

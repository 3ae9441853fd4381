//! What can go wrong with an interface.

use ib_core::input::{InputError, all_finite};

/// An error of this crate, with the offending values and the remedy.
#[derive(Clone, PartialEq, thiserror::Error)]
#[non_exhaustive]
pub enum InterfaceError {
    /// A number or list that cannot be used.
    #[error(transparent)]
    Input(#[from] InputError),
    /// An entry of a list that must be positive is not.
    #[error("entry {index} of {name} is {value}: all entries must be positive and finite")]
    EntryNotPositive {
        /// The list.
        name: &'static str,
        /// Which entry.
        index: usize,
        /// Its value.
        value: f64,
    },
    /// A curve whose end is not its start.
    #[error("the curve is not closed: its end is {gap:.3e} away from its start; make it periodic in its parameter")]
    NotClosed {
        /// Distance of end and start (length).
        gap: f64,
    },
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
    /// Two successive points of a curve coincide.
    #[error("points {index} and the next one of the curve coincide: remove one of them")]
    CoincidentPoints {
        /// The first of the two.
        index: usize,
    },
    /// Points of very different distances.
    #[error(
        "the longest distance between neighbouring points is {ratio:.4} times the shortest, more than {bound}: space \
         them evenly, for instance by Curve::through_points"
    )]
    UnevenSpacing {
        /// Longest over shortest distance.
        ratio: f64,
        /// What is allowed.
        bound: f64,
    },
    /// A curve that encloses no area.
    #[error("the curve encloses an area of {area:.3e}, too small for its length {length:.4}")]
    NoArea {
        /// Signed area (length squared).
        area: f64,
        /// Length.
        length: f64,
    },
    /// A curve in polar form whose radius is not positive everywhere.
    #[error("the radius is {radius:.3e} at the polar angle {angle:.4}: make the amplitudes of the modes smaller")]
    RadiusNotPositive {
        /// Where (radians).
        angle: f64,
        /// The radius there (length).
        radius: f64,
    },
    /// An iteration did not converge.
    #[error("{what} stopped at a residual of {residual:.1e}, above {tolerance:e}: {remedy}")]
    NoConvergence {
        /// The iteration.
        what: &'static str,
        /// Residual reached.
        residual: f64,
        /// Residual asked for.
        tolerance: f64,
        /// What to do.
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
    /// There are no particles to borrow from.
    #[error("the particle numbers add up to {total}, so no redistribution makes them positive")]
    NoParticles {
        /// Their sum.
        total: f64,
    },
    /// A list that must increase does not.
    #[error("entry {index} of {name} is {value}, not above the one before it: all entries must increase")]
    NotIncreasing {
        /// The list.
        name: &'static str,
        /// Which entry.
        index: usize,
        /// Its value.
        value: f64,
    },
    /// The points do not determine what is fitted to them.
    #[error("{what} cannot be fitted to {points} points that lie as these do")]
    NoFit {
        /// What is fitted.
        what: &'static str,
        /// Number of points.
        points: usize,
    },
}

ib_core::input::debug_as_explanation!(InterfaceError);

/// Whether all entries are finite and each is above the one before it.
pub(crate) fn increasing(name: &'static str, values: &[f64]) -> Result<(), InterfaceError> {
    all_finite(name, values)?;
    match values.windows(2).position(|pair| pair[1] <= pair[0]) {
        None => Ok(()),
        Some(before) => Err(InterfaceError::NotIncreasing { name, index: before + 1, value: values[before + 1] }),
    }
}

/// Whether all entries are positive and finite.
pub(crate) fn all_positive(name: &'static str, values: &[f64]) -> Result<(), InterfaceError> {
    match values.iter().position(|&value| !(value > 0.0 && value.is_finite())) {
        None => Ok(()),
        Some(index) => Err(InterfaceError::EntryNotPositive { name, index, value: values[index] }),
    }
}

//! Points as entries of a state: x and y of the first, of the second, and so on.

use crate::{BodyError, Vec2};

/// Writes points to a state, or velocities to a rate, of twice as many entries.
pub fn write_points(points: &[Vec2], state: &mut [f64]) {
    for (pair, point) in state.chunks_exact_mut(2).zip(points) {
        pair.copy_from_slice(&point.to_array());
    }
}

/// Reads marker positions (length) from a state.
///
/// # Errors
/// A coordinate that is not finite; the points are then as before.
pub fn read_points(state: &[f64], points: &mut [Vec2]) -> Result<(), BodyError> {
    if let Some(index) = state.iter().position(|value| !value.is_finite()) {
        return Err(BodyError::NonFinite { what: "marker coordinate", index, value: state[index] });
    }
    for (point, pair) in points.iter_mut().zip(state.chunks_exact(2)) {
        *point = Vec2::new(pair[0], pair[1]);
    }
    Ok(())
}

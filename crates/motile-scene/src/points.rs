//! States of bodies that are lists of points: x and y of the first, of the second, and so on.

use crate::BodyError;
use motile_base::Vec2;

/// Writes points to a state, or velocities to a rate, as x and y of the first, of the second, and so on: a list of
/// twice as many entries.
pub fn write(points: &[Vec2], state: &mut [f64]) {
    for (pair, point) in state.chunks_exact_mut(2).zip(points) {
        pair.copy_from_slice(&point.to_array());
    }
}

/// Writes the mirror images in y = 0 of the points of a state, point k as number `markers[k]`.
pub fn mirror(markers: &[usize], state: &[f64], image: &mut [f64]) {
    for (pair, &marker) in state.chunks_exact(2).zip(markers) {
        image[2 * marker..2 * marker + 2].copy_from_slice(&[pair[0], -pair[1]]);
    }
}

/// Moves the points of a state by `by`.
pub fn translate(by: Vec2, state: &mut [f64]) {
    for pair in state.chunks_exact_mut(2) {
        pair[0] += by.x;
        pair[1] += by.y;
    }
}

/// Reads marker positions (length) from a state that [`write()`] wrote.
///
/// # Errors
/// Returns an error for a coordinate that is not finite; the points are then as before.
pub fn read(state: &[f64], points: &mut [Vec2]) -> Result<(), BodyError> {
    if let Some(index) = state.iter().position(|value| !value.is_finite()) {
        return Err(BodyError::NonFinite { what: "marker coordinate", index, value: state[index] });
    }
    for (point, pair) in points.iter_mut().zip(state.chunks_exact(2)) {
        *point = Vec2::new(pair[0], pair[1]);
    }
    Ok(())
}

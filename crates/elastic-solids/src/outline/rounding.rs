//! Corners of an outline rounded by arcs.

use std::sync::Arc;

use motile_base::Vec2;

use super::piece::Piece;
use crate::SolidError;

/// Turn of the tangent below which there is no corner to round (radians).
const STRAIGHT_ON: f64 = 1e-6;

/// Arc that replaces a corner, and the length that it cuts off each of the two sides.
struct Corner {
    arc: Piece,
    cut: f64,
}

/// Returns the pieces of an outline with every corner between two straight ones replaced by an arc of `radius`
/// (length).
pub(super) fn rounded(pieces: &[Piece], radius: f64) -> Result<Vec<Piece>, SolidError> {
    let count = pieces.len();
    // Corner k is the one at the start of piece k.
    let corners = (0..count)
        .map(|k| {
            let (before, after) = (&pieces[(k + count - 1) % count], &pieces[k]);
            if before.is_straight() && after.is_straight() { corner(before, after, radius) } else { Ok(None) }
        })
        .collect::<Result<Vec<_>, _>>()?;
    let mut result = Vec::new();
    for (k, piece) in pieces.iter().enumerate() {
        let cut = |corner: &Option<Corner>| corner.as_ref().map_or(0.0, |corner| corner.cut);
        let (first, last) = (cut(&corners[k]), cut(&corners[(k + 1) % count]));
        if first + last == 0.0 {
            result.push(piece.clone());
            continue;
        }
        let side = piece.length();
        if first + last > side * (1.0 + 1e-12) {
            let maximum = radius * side / (first + last);
            return Err(SolidError::rounding_too_large(radius, piece.start(), side, maximum));
        }
        if let Some(corner) = &corners[k] {
            result.push(corner.arc.clone());
        }
        // A side that its two arcs use up leaves nothing between them.
        if first + last < side * (1.0 - 1e-9) {
            result.push(Piece::line(piece.at(first), piece.at(side - last))?);
        }
    }
    Ok(result)
}

fn corner(before: &Piece, after: &Piece, radius: f64) -> Result<Option<Corner>, SolidError> {
    let (one, other) = (before.end_direction(), after.start_direction());
    let turn = one.angle_to(other);
    if turn.abs() < STRAIGHT_ON {
        return Ok(None);
    }
    let cut = radius * (0.5 * turn.abs()).tan();
    let start = after.start() - one * cut;
    let centre = start + Vec2::new(-one.y, one.x) * (radius * turn.signum());
    let spoke = start - centre;
    let arc = Piece::curve(Arc::new(move |t| centre + Vec2::from_angle(turn * t).rotate(spoke)), [0.0, 1.0])?;
    Ok(Some(Corner { arc, cut }))
}

//! Places along an outline by their arc length.
//!
//! ```text
//!   corner        side 0         corner      An outline is cut at its corners into sides. A side may be made of
//! several
//!     o------- p0 -----.- p1 ------o         pieces that join smoothly (at the dots), here p0 and p1. A place is a
//! side
//!     |             X              |         and the arc length `along` it, X: side 0, along = 0.6 of its length.
//!     | side 3                     | side 1
//!     |             side 2         |         A smooth outline, without a corner, has one side whose end is its start,
//!     o------- p4 -----.- p3 ------o         and places may go around it any number of times.
//! ```

use motile_base::Vec2;

use super::Outline;
use super::piece::Piece;

/// A place on an outline.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Place {
    /// Index of the side.
    side: usize,
    /// Arc length from the start of the side (length).
    along: f64,
    /// `true` for the corner at the start of the side.
    corner: bool,
}

/// An outline cut at its corners into sides.
#[derive(Debug)]
pub(crate) struct Track<'a> {
    sides: Vec<Side<'a>>,
    /// Advance in x after one turn (length), zero for a closed outline.
    period: f64,
    closed: bool,
    /// `true` for an outline without a corner.
    smooth: bool,
}

/// A run of pieces that join smoothly, from one corner to the next.
#[derive(Debug)]
struct Side<'a> {
    parts: Vec<Part<'a>>,
    length: f64,
}

/// A piece of a side.
#[derive(Debug)]
struct Part<'a> {
    piece: &'a Piece,
    /// Addition to x of the piece (length): a period where the side goes past the start of the outline.
    shift: f64,
    /// Arc length of the side before the piece (length).
    start: f64,
}

impl<'a> Track<'a> {
    /// Creates the sides of an outline from its first corner on; from its first piece on without a corner.
    pub(crate) fn new(outline: &'a Outline) -> Self {
        let count = outline.pieces.len();
        let period = outline.period.unwrap_or(0.0);
        let corner = (0..count).find(|&k| outline.is_corner(k));
        let first = corner.unwrap_or(0);
        let mut sides: Vec<Side<'a>> = Vec::new();
        for step in first..first + count {
            let k = step % count;
            let (piece, shift) = (&outline.pieces[k], if step < count { 0.0 } else { period });
            match sides.last_mut() {
                Some(side) if !outline.is_corner(k) => {
                    side.parts.push(Part { piece, shift, start: side.length });
                    side.length += piece.length();
                }
                _ => sides.push(Side { parts: vec![Part { piece, shift, start: 0.0 }], length: piece.length() }),
            }
        }
        Self { sides, period, closed: outline.period.is_none(), smooth: corner.is_none() }
    }

    /// Returns the places at about `spacing` (length), equally spaced between corners, corners among them. On a smooth
    /// outline, the first stands the fraction `phase` of a spacing behind the start.
    pub(crate) fn places(&self, spacing: f64, phase: f64) -> Vec<Place> {
        let phase = if self.smooth { phase } else { 0.0 };
        // A closed line of one or two sides needs points in between to enclose an area.
        let least = if self.closed { 3_usize.div_ceil(self.sides.len()) } else { 1 };
        let mut places = Vec::new();
        for (number, side) in self.sides.iter().enumerate() {
            let count = ((side.length / spacing).round() as usize).max(least);
            places.extend((0..count).map(|k| Place {
                side: number,
                along: side.length * (k as f64 + phase) / count as f64,
                corner: k == 0 && !self.smooth,
            }));
        }
        places
    }

    /// Returns the place `by` (length) further along, not beyond the next corner; corners stay.
    pub(crate) fn moved(&self, place: Place, by: f64) -> Place {
        let along = match place {
            Place { corner: true, along, .. } => along,
            Place { along, .. } if self.smooth => along + by,
            Place { along, .. } => (along + by).clamp(0.0, self.sides[place.side].length),
        };
        Place { along, ..place }
    }

    /// Returns the point of the exact outline at a place (length).
    pub(crate) fn at(&self, place: Place) -> Vec2 {
        let side = &self.sides[place.side];
        let turns = if self.smooth { (place.along / side.length).floor() } else { 0.0 };
        let along = place.along - turns * side.length;
        let part = &side.parts[side.parts.partition_point(|part| part.start <= along).max(1) - 1];
        part.piece.at(along - part.start) + Vec2::new(part.shift + turns * self.period, 0.0)
    }
}

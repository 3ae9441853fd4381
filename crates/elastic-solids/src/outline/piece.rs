//! Smooth pieces of an outline, by arc length.

use std::sync::Arc;

use motile_base::{Vec2, internal::all_points_finite};

use crate::SolidError;
use crate::error::length;

pub(super) type Curve = Arc<dyn Fn(f64) -> Vec2 + Send + Sync>;

/// Turn of the tangent above which a joint is a corner (radians), 15 degrees: a polygon of more than 24 corners is
/// taken for the smooth curve that it stands for.
const CORNER: f64 = 0.26;

/// Chords by which the arc length of a curve is measured; its error is of the order of 1/CHORDS^2.
const CHORDS: usize = 2048;

/// A smooth curve with its arc length.
#[derive(Clone)]
pub(super) struct Piece {
    curve: Curve,
    range: [f64; 2],
    straight: bool,
    /// Arc length up to the end of each chord (length); one entry for a straight piece.
    lengths: Arc<[f64]>,
}

impl std::fmt::Debug for Piece {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let kind = if self.straight { "line" } else { "curve" };
        write!(f, "{kind} from {:?} to {:?}, length {}", self.start(), self.end(), self.length())
    }
}

impl Piece {
    pub(super) fn line(from: Vec2, to: Vec2) -> Result<Self, SolidError> {
        Self::measured(Arc::new(move |t| from + (to - from) * t), [0.0, 1.0], true)
    }

    pub(super) fn curve(curve: Curve, range: [f64; 2]) -> Result<Self, SolidError> {
        Self::measured(curve, range, false)
    }

    /// Returns the pieces of a curve cut at the parameters `cuts`.
    pub(super) fn split(curve: &Curve, range: [f64; 2], cuts: &[f64]) -> Result<Vec<Self>, SolidError> {
        let ends: Vec<f64> = std::iter::once(range[0]).chain(cuts.iter().copied()).chain([range[1]]).collect();
        if let Some(k) = (1..ends.len()).find(|&k| ends[k].is_nan() || ends[k] <= ends[k - 1]) {
            let value = if k == ends.len() - 1 { ends[k - 1] } else { ends[k] };
            return Err(SolidError::corners_out_of_order(value, range));
        }
        ends.windows(2).map(|ends| Self::curve(curve.clone(), [ends[0], ends[1]])).collect()
    }

    fn measured(curve: Curve, range: [f64; 2], straight: bool) -> Result<Self, SolidError> {
        let chords = if straight { 1 } else { CHORDS };
        let points: Vec<Vec2> = (0..=chords).map(|k| curve(parameter(range, k as f64 / chords as f64))).collect();
        all_points_finite("the points of a curve", &points)?;
        let mut total = 0.0;
        let lengths: Arc<[f64]> = points
            .windows(2)
            .map(|ends| {
                total += (ends[1] - ends[0]).length();
                total
            })
            .collect();
        if total == 0.0 {
            return Err(SolidError::no_length(points[0]));
        }
        length("the length of a side or curve of an outline", total)?;
        Ok(Self { curve, range, straight, lengths })
    }

    pub(super) fn mapped(&self, map: impl Fn(Vec2) -> Vec2 + Send + Sync + 'static) -> Result<Self, SolidError> {
        let curve = self.curve.clone();
        Self::measured(Arc::new(move |t| map(curve(t))), self.range, self.straight)
    }

    pub(super) fn is_straight(&self) -> bool {
        self.straight
    }

    pub(super) fn length(&self) -> f64 {
        self.lengths[self.lengths.len() - 1]
    }

    pub(super) fn start(&self) -> Vec2 {
        (self.curve)(self.range[0])
    }

    pub(super) fn end(&self) -> Vec2 {
        (self.curve)(self.range[1])
    }

    /// Returns the point at the arc length `along` from the start (length).
    pub(super) fn at(&self, along: f64) -> Vec2 {
        let chords = self.lengths.len();
        let chord = self.lengths.partition_point(|&length| length < along).min(chords - 1);
        let before = if chord == 0 { 0.0 } else { self.lengths[chord - 1] };
        let step = self.lengths[chord] - before;
        let fraction = if step > 0.0 { ((along - before) / step).clamp(0.0, 1.0) } else { 0.0 };
        (self.curve)(parameter(self.range, (chord as f64 + fraction) / chords as f64))
    }

    /// Returns the unit vector along the piece at its start.
    pub(super) fn start_direction(&self) -> Vec2 {
        self.direction(self.at(1e-3 * self.length()) - self.start())
    }

    /// Returns the unit vector along the piece at its end.
    pub(super) fn end_direction(&self) -> Vec2 {
        self.direction(self.end() - self.at((1.0 - 1e-3) * self.length()))
    }

    fn direction(&self, chord: Vec2) -> Vec2 {
        if self.straight { (self.end() - self.start()).normalize() } else { chord.normalize() }
    }
}

/// Returns true if the tangent turns where one piece ends and the next starts.
pub(super) fn is_corner(before: &Piece, after: &Piece) -> bool {
    before.end_direction().angle_to(after.start_direction()).abs() > CORNER
}

fn parameter(range: [f64; 2], fraction: f64) -> f64 {
    // Exact at both ends.
    if fraction >= 1.0 { range[1] } else { range[0] + (range[1] - range[0]) * fraction }
}

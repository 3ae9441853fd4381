//! Outlines of solids.

use std::f64::consts::TAU;
use std::sync::Arc;

use motile_base::{
    Vec2, finite,
    internal::{all_points_finite, at_least},
    positive, within,
};

use crate::SolidError;
use crate::error::{MOST_POINTS, length};

mod interior;
mod piece;
mod rounding;
mod track;

use piece::{Piece, is_corner};

pub use interior::Interior;
pub(crate) use track::{Place, Track};

/// A line that bounds a solid: closed, or repeating itself in x with a period (the surface of a channel wall).
///
/// An outline consists of smooth pieces that join at corners. Meshing keeps the corners and puts points at equal
/// spacing on the exact curve between them. The direction does not matter, because the number of outlines around a
/// point decides whether it is solid ([`Interior`](crate::Interior)).
///
/// ```
/// use elastic_solids::{Outline, SolidError};
/// use elastic_solids::Vec2;
///
/// let post = Outline::rectangle(Vec2::new(-0.5, 0.0), Vec2::new(0.5, 2.0))?.rounded(0.2)?;
/// println!("circumference {:.4}", post.length()); // 6 - 8 r + 2 pi r = 5.6566
/// assert!((post.length() - 5.6566).abs() < 1e-4);
/// # Ok::<(), SolidError>(())
/// ```
#[derive(Debug, Clone)]
pub struct Outline {
    pieces: Vec<Piece>,
    period: Option<f64>,
}

impl Outline {
    /// Creates a closed polygon through `corners` (length).
    ///
    /// # Errors
    /// Returns an error for fewer than three corners, corners that are not finite or coincide with the next.
    pub fn polygon(corners: &[Vec2]) -> Result<Self, SolidError> {
        at_least("corners of the polygon", corners.len(), 3)?;
        Self::straight("the corners of the polygon", corners, corners[0], None)
    }

    /// Creates a rectangle with two opposite corners (length).
    ///
    /// # Errors
    /// Returns an error for corners that are not finite or on one side of a rectangle without area.
    pub fn rectangle(corner: Vec2, opposite: Vec2) -> Result<Self, SolidError> {
        Self::polygon(&[corner, Vec2::new(opposite.x, corner.y), opposite, Vec2::new(corner.x, opposite.y)])
    }

    /// Creates a circle of `radius` about `centre` (length).
    ///
    /// # Errors
    /// Returns an error for a radius that is not positive, a centre that is not finite.
    pub fn circle(centre: Vec2, radius: f64) -> Result<Self, SolidError> {
        Self::ellipse(centre, [radius, radius])
    }

    /// Creates an ellipse with the half axes `axes` along x and y about `centre` (length).
    ///
    /// # Errors
    /// Returns an error for half axes that are not positive, a centre that is not finite.
    pub fn ellipse(centre: Vec2, axes: [f64; 2]) -> Result<Self, SolidError> {
        positive("a half axis", axes[0])?;
        positive("a half axis", axes[1])?;
        Self::closed(move |t| {
            let (sine, cosine) = (TAU * t).sin_cos();
            centre + Vec2::new(axes[0] * cosine, axes[1] * sine)
        })
    }

    /// Returns the closed curve `curve(t)` (length), t from 0 to 1, smooth everywhere.
    ///
    /// # Errors
    /// Returns an error for a curve that is not finite, has no length, or does not close.
    pub fn closed(curve: impl Fn(f64) -> Vec2 + Send + Sync + 'static) -> Result<Self, SolidError> {
        Self::from_pieces(vec![Piece::curve(Arc::new(curve), [0.0, 1.0])?], None)
    }

    /// Creates a level line y = `height` (length) with the period `period` (length) from x = `start`: the flat surface
    /// of a channel wall.
    ///
    /// # Errors
    /// Returns an error for a period that is not positive, a start or height that is not finite.
    pub fn flat(start: f64, period: f64, height: f64) -> Result<Self, SolidError> {
        positive("the period", period)?;
        let points = [Vec2::new(start, height), Vec2::new(start + period, height)];
        all_points_finite("the start and height", &points)?;
        Self::from_pieces(vec![Piece::line(points[0], points[1])?], Some(period))
    }

    /// Returns the smooth line y = `height(x)` (length) for x from `start` to `start + period` (length), repeated.
    ///
    /// # Errors
    /// Returns an error for a period that is not positive, a height that is not finite or does not return to its first
    /// value.
    pub fn profile(
        start: f64,
        period: f64,
        height: impl Fn(f64) -> f64 + Send + Sync + 'static,
    ) -> Result<Self, SolidError> {
        Self::profile_with_corners(start, period, &[], height)
    }

    /// Returns the piecewise smooth line y = `height(x)` (length) for x from `start` to `start + period` (length),
    /// repeated, with corners at the increasing positions `corners` between them.
    ///
    /// # Errors
    /// Returns the errors of [`Outline::profile`]; corners that do not increase from above the start to below the end.
    pub fn profile_with_corners(
        start: f64,
        period: f64,
        corners: &[f64],
        height: impl Fn(f64) -> f64 + Send + Sync + 'static,
    ) -> Result<Self, SolidError> {
        positive("the period", period)?;
        finite("the start of the profile", start)?;
        let curve = move |x: f64| Vec2::new(x, height(x));
        Self::from_pieces(Piece::split(&(Arc::new(curve) as _), [start, start + period], corners)?, Some(period))
    }

    /// Creates a line of straight pieces through `points` (length), repeated with `period` (length) so that the first
    /// point follows the last one period further. It may overhang.
    ///
    /// # Errors
    /// Returns an error if there is no point, or for points that are not finite or coincide with the next, a period
    /// that is not positive.
    pub fn polyline(points: &[Vec2], period: f64) -> Result<Self, SolidError> {
        positive("the period", period)?;
        at_least("points of the line", points.len(), 1)?;
        let last = points[0] + Vec2::new(period, 0.0);
        Self::straight("the points of the line", points, last, Some(period))
    }

    /// Returns straight pieces through `points` and on to `last`.
    fn straight(name: &'static str, points: &[Vec2], last: Vec2, period: Option<f64>) -> Result<Self, SolidError> {
        all_points_finite(name, points)?;
        let next = points[1..].iter().chain(std::iter::once(&last));
        let pieces = points.iter().zip(next).map(|(from, to)| Piece::line(*from, *to)).collect::<Result<_, _>>()?;
        Self::from_pieces(pieces, period)
    }

    fn from_pieces(pieces: Vec<Piece>, period: Option<f64>) -> Result<Self, SolidError> {
        let outline = Self { pieces, period };
        let (first, last) = (outline.pieces[0].start(), outline.pieces[outline.pieces.len() - 1].end());
        let gap = last - first - Vec2::new(period.unwrap_or(0.0), 0.0);
        if gap.length() > 1e-9 * outline.length() {
            return Err(SolidError::open_outline(last, gap.length()));
        }
        Ok(outline)
    }

    /// Returns the period in x (length); `None` for a closed outline.
    #[must_use]
    pub fn period(&self) -> Option<f64> {
        self.period
    }

    /// Returns the first point (length).
    pub(crate) fn start(&self) -> Vec2 {
        self.pieces[0].start()
    }

    /// Returns the length of the outline, or of one period of it (length).
    #[must_use]
    pub fn length(&self) -> f64 {
        self.pieces.iter().map(Piece::length).sum()
    }

    /// Returns the outline moved by `offset` (length).
    ///
    /// # Errors
    /// Returns an error for an offset that is not finite.
    pub fn translated(&self, offset: Vec2) -> Result<Self, SolidError> {
        all_points_finite("the offset", &[offset])?;
        self.mapped(move |point| point + offset, self.period)
    }

    /// Returns the closed outline turned counter-clockwise by `angle` (radians) about `centre` (length).
    ///
    /// # Errors
    /// Returns an error for an angle or centre that is not finite, a periodic outline.
    pub fn rotated(&self, angle: f64, centre: Vec2) -> Result<Self, SolidError> {
        finite("the angle", angle)?;
        all_points_finite("the centre", &[centre])?;
        if self.period.is_some() {
            return Err(SolidError::unsupported(
                "turning a periodic outline",
                "Turn closed outlines only, because a channel runs along x",
            ));
        }
        let rotation = Vec2::from_angle(angle);
        self.mapped(move |point| centre + rotation.rotate(point - centre), None)
    }

    /// Returns the mirror image of the outline about the level y = `height` (length). It is the other wall of a
    /// symmetric channel.
    ///
    /// # Errors
    /// Returns an error for a height that is not finite.
    pub fn mirrored(&self, height: f64) -> Result<Self, SolidError> {
        finite("the height of the mirror", height)?;
        self.mapped(move |point| Vec2::new(point.x, 2.0 * height - point.y), self.period)
    }

    fn mapped(
        &self,
        map: impl Fn(Vec2) -> Vec2 + Clone + Send + Sync + 'static,
        period: Option<f64>,
    ) -> Result<Self, SolidError> {
        let pieces = self.pieces.iter().map(|piece| piece.mapped(map.clone())).collect::<Result<_, _>>()?;
        Self::from_pieces(pieces, period)
    }

    /// Returns the outline with every corner between two straight pieces rounded by a circle of `radius` (length).
    ///
    /// # Errors
    /// Returns an error for a radius that is not positive or too large for the sides next to a corner.
    pub fn rounded(&self, radius: f64) -> Result<Self, SolidError> {
        positive("the radius by which corners are rounded", radius)?;
        Self::from_pieces(rounding::rounded(&self.pieces, radius)?, self.period)
    }

    /// Returns the points on the outline at about `spacing` (length), equally spaced between corners, corners among
    /// them; at least three on a closed outline.
    ///
    /// # Errors
    /// Returns an error for a spacing that is not positive, or so small that there would be more than 1e6 points.
    pub fn resampled(&self, spacing: f64) -> Result<Vec<Vec2>, SolidError> {
        length("the spacing", spacing)?;
        within("the length of an outline over the spacing", self.length() / spacing, 0.0, MOST_POINTS)?;
        let track = Track::new(self);
        Ok(track.places(spacing, 0.0).into_iter().map(|place| track.at(place)).collect())
    }

    /// Returns true if the tangent turns at the start of piece k.
    fn is_corner(&self, k: usize) -> bool {
        let count = self.pieces.len();
        is_corner(&self.pieces[(k + count - 1) % count], &self.pieces[k])
    }
}

#[cfg(test)]
mod tests;

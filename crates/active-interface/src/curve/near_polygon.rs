//! Smooth curves that stay near the polygon through their points.

use motile_base::Vec2;

use super::spline::PeriodicSpline;
use crate::InterfaceError;

/// Largest ratio of neighbouring sides that a spline goes through without points between: beyond it the longer side
/// bulges by a fraction of its length, not of the length of its neighbour.
const MOST_UNEVEN: f64 = 3.0;
/// Largest distances of the curve from a side, over the shortest of the side and its two neighbours; later ones are
/// tried if the curve crosses itself. That of a circle from its octagon is 0.1.
const DISTANCES: [f64; 4] = [0.15, 0.05, 0.015, 0.005];
/// Part of a limit from which on a side is parted: equal sides, as of a rectangle twice as long as wide, which reaches
/// a limit, are then treated alike in spite of round-off.
const BELOW: f64 = 1.0 - 1e-9;
/// Most halvings of sides; a side is then a millionth of a millionth of what it was.
const HALVINGS: usize = 40;
/// Most pieces of the curve: where round-off is larger than the distances that are allowed, no halving ends.
const MOST_PIECES: usize = 1 << 14;
/// Places on a piece at which its distance is measured.
const SAMPLES: u32 = 8;

/// A smooth curve through points, closed or periodic, near their polygon.
///
/// It is the cubic spline through the points and, where that leaves the polygon, through the middles of sides as well.
/// It does so next to a side of a third of its length and less, and next to sharp corners. Through points that are even
/// enough it is the spline through them alone.
#[derive(Debug, Clone)]
pub(crate) struct NearPolygon {
    pub(crate) spline: PeriodicSpline,
    /// Side of the polygon that each piece of the spline follows.
    sides: Vec<usize>,
    /// Largest distance from the polygon (length).
    pub(crate) distance: f64,
}

impl NearPolygon {
    /// Returns the curve through at least three points, no two successive ones the same, that advances by `advance` in
    /// a period (length; zero for a closed one), and for which `crossing` finds no crossing. If there are several such
    /// curves, it is the one with the fewest points between.
    ///
    /// # Errors
    /// Returns an error for points that coincide; the errors of `crossing`; [`InterfaceError::SelfCrossing`] by the
    /// numbers of the points; a curve that leaves the polygon.
    pub(crate) fn new(
        points: &[Vec2],
        advance: Vec2,
        crossing: impl Fn(&PeriodicSpline) -> Result<Option<[f64; 2]>, InterfaceError>,
    ) -> Result<Self, InterfaceError> {
        let mut crossed = [0, 0];
        for distance in DISTANCES {
            let curve = Self::within(points, advance, distance)?;
            match crossing(&curve.spline)? {
                None => return Ok(curve),
                Some(found) => crossed = found.map(|t| curve.side(t)),
            }
        }
        let [first, second] = crossed;
        Err(InterfaceError::crossing_points(first, second))
    }

    /// Creates the curve within that fraction of the sides from the polygon.
    fn within(points: &[Vec2], advance: Vec2, part: f64) -> Result<Self, InterfaceError> {
        let count = points.len();
        let end = |k: usize| if k + 1 < count { points[k + 1] } else { points[0] + advance };
        let length = |k: usize| points[k].distance(end(k));
        let neighbours = |k: usize, count: usize| [(k + count - 1) % count, (k + 1) % count];
        let bounds: Vec<f64> =
            (0..count).map(|k| part * neighbours(k, count).into_iter().map(length).fold(length(k), f64::min)).collect();
        let (mut places, mut sides) = (points.to_vec(), (0..count).collect::<Vec<usize>>());
        for _ in 0..HALVINGS {
            let spline = PeriodicSpline::new(&places, advance)?;
            let from_side = |k: usize, place: Vec2| {
                let (start, end) = (points[sides[k]], end(sides[k]));
                let along = end - start;
                let t = ((place - start).dot(along) / along.length_squared()).clamp(0.0, 1.0);
                place.distance(start + along * t)
            };
            let distances: Vec<f64> = (0..places.len())
                .map(|k| {
                    let at = |i: u32| from_side(k, spline.piece(k, f64::from(i) / f64::from(SAMPLES)).0);
                    (1..SAMPLES).map(at).fold(0.0, f64::max)
                })
                .collect();
            let chord = |k: usize| spline.chord(k);
            let parts = |k: usize| {
                let shortest = neighbours(k, places.len()).into_iter().map(chord).fold(f64::INFINITY, f64::min);
                chord(k) > BELOW * MOST_UNEVEN * shortest || distances[k] > BELOW * bounds[sides[k]]
            };
            let halved: Vec<bool> = (0..places.len()).map(parts).collect();
            if !halved.contains(&true) {
                return Ok(Self { distance: distances.into_iter().fold(0.0, f64::max), spline, sides });
            }
            let (mut finer, mut owners) = (Vec::new(), Vec::new());
            for (k, &place) in places.iter().enumerate() {
                finer.push(place);
                owners.push(sides[k]);
                if halved[k] {
                    let next = if k + 1 < places.len() { places[k + 1] } else { places[0] + advance };
                    finer.push(place.lerp(next, 0.5));
                    owners.push(sides[k]);
                }
            }
            (places, sides) = (finer, owners);
            if places.len() > MOST_PIECES.max(4 * count) {
                break;
            }
        }
        Err(InterfaceError::strays(sides.first().copied().unwrap_or_default()))
    }

    /// Returns the side of the polygon, by its first point, that the curve follows at the fraction `t` in [0, 1] of the
    /// parameter.
    pub(crate) fn side(&self, t: f64) -> usize {
        self.sides[self.spline.piece_at(t)]
    }
}

#[cfg(test)]
mod tests;

//! Points of a mesh that is being made.

use motile_base::Vec2;

use crate::mesher::segments::Segments;
use crate::outline::{Place, Track};

/// Points to be triangulated: first the points of the boundary, outline by outline, then the inner ones.
#[derive(Debug)]
pub(crate) struct PointSet<'a> {
    pub(crate) points: Vec<Vec2>,
    /// Number of boundary points.
    pub(crate) on_boundary: usize,
    /// Boundary edges by the indices of their points.
    pub(crate) boundary: Vec<[usize; 2]>,
    /// Boundary edges by the positions of their points, to distinguish inside and outside.
    pub(crate) segments: Segments,
    /// Outlines on which the boundary points slide, and their places on them.
    pub(crate) tracks: &'a [Track<'a>],
    pub(crate) places: Vec<Vec<Place>>,
    /// Start and period in x (length).
    pub(crate) period: Option<(f64, f64)>,
}

impl PointSet<'_> {
    /// Fixes the boundary points where they are.
    pub(crate) fn with_fixed_boundary(self) -> Self {
        Self { tracks: &[], ..self }
    }

    /// Returns the vector from one point of an edge to the other, the shorter way round (length).
    pub(crate) fn vector(&self, [from, to]: [usize; 2]) -> Vec2 {
        let mut vector = self.points[to] - self.points[from];
        if let Some((_, period)) = self.period {
            vector.x -= period * (vector.x / period).round();
        }
        vector
    }

    /// Moves the boundary points along their outlines by the tangential parts of `steps`, to which it reduces them.
    pub(crate) fn slide(&mut self, steps: &mut [Vec2]) {
        let mut start = 0;
        for (outline, track) in self.tracks.iter().enumerate() {
            let count = self.places[outline].len();
            for k in 0..count {
                let (before, here, after) = (start + (k + count - 1) % count, start + k, start + (k + 1) % count);
                let chord = self.vector([before, here]) + self.vector([here, after]);
                let tangent = chord.try_normalize().unwrap_or_default();
                let by = steps[here].dot(tangent);
                steps[here] = tangent * by;
                let place = &mut self.places[outline][k];
                *place = track.moved(*place, by);
                self.points[here] = track.at(*place);
            }
            start += count;
        }
    }

    /// Brings the set up to date after points have moved: shifts all points into the first period, renews the boundary
    /// segments (with images up to `margin` beyond the ends of the period), and removes inner points that have left the
    /// solid.
    pub(crate) fn renew(&mut self, margin: f64) {
        if let Some((start, period)) = self.period {
            for point in &mut self.points {
                point.x -= period * ((point.x - start) / period).floor();
            }
        }
        let mut start = 0;
        let outline = |places: &Vec<Place>| {
            start += places.len();
            self.points[start - places.len()..start].to_vec()
        };
        let outlines: Vec<Vec<Vec2>> = self.places.iter().map(outline).collect();
        self.segments = Segments::new(&outlines, self.period, margin);
        let (boundary, inner) = self.points.split_at(self.on_boundary);
        let left: Vec<Vec2> = inner.iter().copied().filter(|&point| self.segments.inside(point)).collect();
        if left.len() < inner.len() {
            self.points = [boundary, &left].concat();
        }
    }
}

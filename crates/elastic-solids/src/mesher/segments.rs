//! Segments of the resampled boundary of a solid: crossings, distances, inside and outside.

use std::collections::HashMap;

use motile_base::Vec2;

use crate::SolidError;

/// A straight piece of the boundary, or its image one period to the side.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Segment {
    pub(crate) from: Vec2,
    pub(crate) to: Vec2,
    /// Index of the outline, and of the segment within it.
    pub(crate) outline: usize,
    pub(crate) index: usize,
}

/// All segments of a boundary, sorted into square cells as wide as the longest of them.
#[derive(Debug, Clone)]
pub(crate) struct Segments {
    segments: Vec<Segment>,
    /// Number of segments of each outline.
    counts: Vec<usize>,
    cell: f64,
    cells: HashMap<(i64, i64), Vec<usize>>,
    /// Segments over each interval of x as wide as a cell.
    columns: HashMap<i64, Vec<usize>>,
}

impl Segments {
    /// Creates the segments between the points of each outline in order. With `period` = start and period in x
    /// (length), images within `margin` of that period are added, and points may lie anywhere.
    pub(crate) fn new(outlines: &[Vec<Vec2>], period: Option<(f64, f64)>, margin: f64) -> Self {
        let mut segments = Vec::new();
        for (outline, points) in outlines.iter().enumerate() {
            for (index, &from) in points.iter().enumerate() {
                let to = points[(index + 1) % points.len()];
                let Some((start, period)) = period else {
                    segments.push(Segment { from, to, outline, index });
                    continue;
                };
                let step = if points.len() == 1 { 1.0 } else { -((to.x - from.x) / period).round() };
                // Neighbours compute their common point alike, to the last bit.
                let shifted = |point: Vec2, periods: f64| Vec2::new(point.x + periods * period, point.y);
                let end = to.x + step * period;
                let first = ((start - margin - from.x.max(end)) / period).ceil() as i64;
                let last = ((start + period + margin - from.x.min(end)) / period).floor() as i64;
                for image in first..=last {
                    let image = image as f64;
                    let (from, to) = (shifted(from, image), shifted(to, image + step));
                    segments.push(Segment { from, to, outline, index });
                }
            }
        }
        let longest = segments.iter().map(|s| (s.to - s.from).length()).fold(0.0, f64::max);
        let cell = longest.max(f64::MIN_POSITIVE);
        let mut cells: HashMap<(i64, i64), Vec<usize>> = HashMap::new();
        let mut columns: HashMap<i64, Vec<usize>> = HashMap::new();
        for (k, segment) in segments.iter().enumerate() {
            let (low, high) = (segment.from.min(segment.to), segment.from.max(segment.to));
            let (low, high) = (cell_of(low, cell), cell_of(high, cell));
            for x in low.0..=high.0 {
                columns.entry(x).or_default().push(k);
                for y in low.1..=high.1 {
                    cells.entry((x, y)).or_default().push(k);
                }
            }
        }
        Self { segments, counts: outlines.iter().map(Vec::len).collect(), cell, cells, columns }
    }

    /// Creates the segments of outlines that must not cross.
    ///
    /// # Errors
    /// Returns [`SolidError::Refused`] if outlines cross or touch.
    pub(crate) fn uncrossed(
        outlines: &[Vec<Vec2>],
        period: Option<(f64, f64)>,
        margin: f64,
    ) -> Result<Self, SolidError> {
        let segments = Self::new(outlines, period, margin);
        segments.first_crossing().map_or(Ok(()), |place| Err(SolidError::crossing(place)))?;
        Ok(segments)
    }

    /// Returns true if `point` is solid.
    pub(crate) fn inside(&self, point: Vec2) -> bool {
        self.crossings_above(point, None) % 2 == 1
    }

    /// Returns the number of crossings of a line upwards from `point` with outlines other than `except`.
    pub(crate) fn crossings_above(&self, point: Vec2, except: Option<usize>) -> usize {
        let Some(column) = self.columns.get(&cell_of(point, self.cell).0) else { return 0 };
        column
            .iter()
            .map(|&k| &self.segments[k])
            .filter(|s| Some(s.outline) != except && (s.from.x <= point.x) != (s.to.x <= point.x))
            .filter(|s| {
                let fraction = (point.x - s.from.x) / (s.to.x - s.from.x);
                s.from.y + fraction * (s.to.y - s.from.y) > point.y
            })
            .count()
    }

    /// Returns the nearest point of the boundary within `reach` of `point`, among the segments that `wanted` admits.
    pub(crate) fn nearest(&self, point: Vec2, reach: f64, wanted: impl Fn(&Segment) -> bool) -> Option<Vec2> {
        let low = cell_of(point - Vec2::splat(reach), self.cell);
        let high = cell_of(point + Vec2::splat(reach), self.cell);
        let mut best = (reach, None);
        for x in low.0..=high.0 {
            for y in low.1..=high.1 {
                for &k in self.cells.get(&(x, y)).map_or(&[][..], Vec::as_slice) {
                    let segment = &self.segments[k];
                    let foot = foot(point, segment);
                    let distance = (foot - point).length();
                    if distance < best.0 && wanted(segment) {
                        best = (distance, Some(foot));
                    }
                }
            }
        }
        best.1
    }

    /// Returns the number of steps between two segments of one outline, the shorter way round.
    pub(crate) fn separation(&self, outline: usize, first: usize, second: usize) -> usize {
        let apart = first.abs_diff(second);
        apart.min(self.counts[outline] - apart)
    }

    /// Returns the place where outlines cross, touch or fold back onto themselves, on the first segment that does.
    fn first_crossing(&self) -> Option<Vec2> {
        let mut first: Option<(usize, usize)> = None;
        for list in self.cells.values() {
            for (position, &i) in list.iter().enumerate() {
                for &j in &list[position + 1..] {
                    let pair = (i.min(j), i.max(j));
                    if first.is_none_or(|found| pair < found) && self.meet(i, j) {
                        first = Some(pair);
                    }
                }
            }
        }
        first.map(|(i, _)| (self.segments[i].from + self.segments[i].to) * 0.5)
    }

    fn meet(&self, i: usize, j: usize) -> bool {
        let (a, b) = (&self.segments[i], &self.segments[j]);
        if a.outline == b.outline {
            match self.separation(a.outline, a.index, b.index) {
                // A segment and its image.
                0 => return false,
                1 => {
                    let (before, after) = if a.to == b.from { (a, b) } else { (b, a) };
                    let (one, other) = (before.to - before.from, after.to - after.from);
                    let joined = (before.to - after.from).length() < 1e-9 * self.cell;
                    return joined && one.perp_dot(other).abs() < 1e-12 * self.cell * self.cell && one.dot(other) < 0.0;
                }
                _ => {}
            }
        }
        let side = |p: Vec2, s: &Segment| (s.to - s.from).perp_dot(p - s.from);
        let (a1, a2) = (side(a.from, b), side(a.to, b));
        let (b1, b2) = (side(b.from, a), side(b.to, a));
        if a1 == 0.0 && a2 == 0.0 && b1 == 0.0 && b2 == 0.0 {
            let overlap = |k: usize| {
                a.from[k].max(a.to[k]) >= b.from[k].min(b.to[k]) && b.from[k].max(b.to[k]) >= a.from[k].min(a.to[k])
            };
            return overlap(0) && overlap(1);
        }
        a1 * a2 <= 0.0 && b1 * b2 <= 0.0
    }
}

fn cell_of(point: Vec2, cell: f64) -> (i64, i64) {
    ((point.x / cell).floor() as i64, (point.y / cell).floor() as i64)
}

/// Returns the point of a segment nearest to `point`.
fn foot(point: Vec2, segment: &Segment) -> Vec2 {
    let along = segment.to - segment.from;
    let fraction = (point - segment.from).dot(along) / along.length_squared();
    segment.from + along * fraction.clamp(0.0, 1.0)
}

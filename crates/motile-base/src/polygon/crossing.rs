//! Crossings of a closed polygon with itself.

use crate::{
    InputError, Vec2, finite,
    internal::{all_points_finite, at_least},
};

/// Finds where a closed polygon crosses or touches itself, in a time proportional to the number of its points where
/// they are about equally spaced.
///
/// Segments are sorted by their midpoints into square cells as wide as the longest segment, through a hash table, and
/// tested only against the segments in the nine cells around. Two segments that meet are never further apart. The
/// scratch grows with the number of points and is kept, so that a call in steady state allocates nothing.
///
/// Polygons that are star-shaped about the mean of their points, such as the polygons of most droplets, need no table:
/// one pass over the points is enough.
#[derive(Debug, Clone, Default)]
pub struct CrossingFinder {
    cells: Vec<(i64, i64)>,
    starts: Vec<usize>,
    entries: Vec<usize>,
    closed: Vec<Vec2>,
}

impl CrossingFinder {
    /// Returns the first pair of segments that meet although they are not neighbours, or that are neighbours and fold
    /// back onto each other. Each is given by the number of its first point, the smaller first. Of several pairs, it is
    /// the one with the smallest first, then second number. `None` for a simple polygon.
    ///
    /// # Errors
    /// Returns an error for fewer than three points, points that are not finite.
    pub fn first_crossing(&mut self, points: &[Vec2]) -> Result<Option<(usize, usize)>, InputError> {
        at_least("points of a polygon", points.len(), 3)?;
        all_points_finite("the points of the polygon", points)?;
        if is_star_shaped(points) {
            return Ok(None);
        }
        let m = points.len();
        let end = |k: usize| points[if k + 1 == m { 0 } else { k + 1 }];
        let longest = (0..m).map(|k| (end(k) - points[k]).length_squared()).fold(0.0, f64::max).sqrt();
        if longest == 0.0 {
            return Ok(Some((0, 1)));
        }
        let corner = points.iter().fold(points[0], |a, b| a.min(*b));
        // Slightly wider than the longest segment, so that rounding cannot put two that meet two cells apart.
        let scale = 1.0 / (1.001 * longest);
        let mask = (2 * m).next_power_of_two() - 1;

        self.cells.clear();
        self.cells.extend((0..m).map(|k| {
            let middle = (points[k] + end(k)) * 0.5 - corner;
            ((middle.x * scale).floor() as i64, (middle.y * scale).floor() as i64)
        }));
        self.starts.clear();
        self.starts.resize(mask + 2, 0);
        for &cell in &self.cells {
            self.starts[bucket(cell, mask) + 1] += 1;
        }
        for k in 0..=mask {
            self.starts[k + 1] += self.starts[k];
        }
        self.entries.clear();
        self.entries.resize(m, 0);
        // Filling moves each start to the next bucket's; the loop below reads the ranges shifted by one.
        for (k, &cell) in self.cells.iter().enumerate() {
            let slot = &mut self.starts[bucket(cell, mask)];
            self.entries[*slot] = k;
            *slot += 1;
        }

        for i in 0..m {
            let (p, q) = (points[i], end(i));
            let (x, y) = self.cells[i];
            let mut found: Option<usize> = None;
            for cell in (x - 1..=x + 1).flat_map(|x| (y - 1..=y + 1).map(move |y| (x, y))) {
                let b = bucket(cell, mask);
                let start = if b == 0 { 0 } else { self.starts[b - 1] };
                for &j in &self.entries[start..self.starts[b]] {
                    if j <= i || self.cells[j] != cell || found.is_some_and(|f| f < j) {
                        continue;
                    }
                    let meet = if j == i + 1 {
                        folds_back(q - p, end(j) - q)
                    } else if i == 0 && j == m - 1 {
                        folds_back(p - points[j], q - p)
                    } else {
                        segments_meet(p, q, points[j], end(j))
                    };
                    if meet {
                        found = Some(j);
                    }
                }
            }
            if let Some(j) = found {
                return Ok(Some((i, j)));
            }
        }
        Ok(None)
    }
}

impl CrossingFinder {
    /// Returns the like for a polygon that continues with its image `advance` (length) further along x; a closed one
    /// where that is zero.
    ///
    /// # Errors
    /// Returns the errors of [`CrossingFinder::first_crossing`]; an advance that is not finite.
    pub fn first_crossing_over(&mut self, points: &[Vec2], advance: f64) -> Result<Option<(usize, usize)>, InputError> {
        finite("the advance of the polygon", advance)?;
        if advance == 0.0 {
            return self.first_crossing(points);
        }
        at_least("points of a polygon", points.len(), 3)?;
        all_points_finite("the points of the polygon", points)?;
        let count = points.len();
        let step = |k: usize| if k + 1 < count { points[k + 1].x } else { points[0].x + advance } - points[k].x;
        // The sign alone: a product of small numbers would be zero.
        if (0..count).all(|k| step(k) * advance.signum() > 0.0) {
            return Ok(None);
        }
        // Two periods, closed from the highest point by a way above all of them.
        let top = (0..count).max_by(|&a, &b| points[a].y.total_cmp(&points[b].y)).unwrap_or(0);
        let along = |periods: usize| Vec2::new(advance * periods as f64, 0.0);
        let mut closed = std::mem::take(&mut self.closed);
        closed.clear();
        closed.extend((top..=top + 2 * count).map(|k| points[k % count] + along(k / count)));
        let (start, end) = (closed[0], closed[2 * count]);
        let rise = Vec2::new(0.0, advance.abs());
        let pieces = 2 * count;
        let way = [end, end + rise, start + rise, start];
        for corners in way.windows(2) {
            let piece = |k: usize| corners[0].lerp(corners[1], k as f64 / pieces as f64);
            closed.extend((1..=pieces).map(piece));
        }
        closed.pop();
        let found = self.first_crossing(&closed);
        self.closed = closed;
        Ok(found?.map(|(first, second)| ((top + first) % count, (top + second) % count)))
    }
}

/// Returns the first pair of segments of a closed polygon that cross or touch, segment k from point k to the next;
/// `None` for a simple polygon.
///
/// # Errors
/// Returns an error for fewer than three points, points that are not finite.
pub fn first_crossing(points: &[Vec2]) -> Result<Option<(usize, usize)>, InputError> {
    CrossingFinder::default().first_crossing(points)
}

fn bucket(cell: (i64, i64), mask: usize) -> usize {
    let hash =
        (cell.0 as u64).wrapping_mul(0x9E37_79B9_7F4A_7C15) ^ (cell.1 as u64).wrapping_mul(0xC2B2_AE3D_27D4_EB4F);
    ((hash >> 29) as usize) & mask
}

/// Returns the sufficient test for a simple polygon: it goes once around the mean of its points, always turning the
/// same way.
fn is_star_shaped(points: &[Vec2]) -> bool {
    let centre = points.iter().sum::<Vec2>() / points.len() as f64;
    let (mut turns, mut widest) = (0, 0.0_f64);
    let mut least = f64::INFINITY;
    let mut before = points[points.len() - 1] - centre;
    for point in points {
        let here = point - centre;
        least = least.min(before.perp_dot(here));
        widest = widest.max(here.length_squared());
        turns += usize::from(before.y < 0.0 && here.y >= 0.0);
        before = here;
    }
    // Rounding must not turn the sign.
    turns == 1 && least > 1e-13 * widest
}

/// Returns true if the second of two successive edges runs back along the first, or one of them has no length.
fn folds_back(first: Vec2, second: Vec2) -> bool {
    (first.perp_dot(second) == 0.0 && first.dot(second) < 0.0) || first == Vec2::ZERO || second == Vec2::ZERO
}

/// Returns true if the segments pq and rs have a point in common.
fn segments_meet(p: Vec2, q: Vec2, r: Vec2, s: Vec2) -> bool {
    let (along, other) = (q - p, s - r);
    let (a, b) = (along.perp_dot(r - p), along.perp_dot(s - p));
    let (c, d) = (other.perp_dot(p - r), other.perp_dot(q - r));
    if a == 0.0 && b == 0.0 {
        // On one line: compare along it.
        let (from, to) = (along.dot(r - p), along.dot(s - p));
        return from.max(to) >= 0.0 && from.min(to) <= along.length_squared();
    }
    a * b <= 0.0 && c * d <= 0.0
}

#[cfg(test)]
mod tests;

//! Insertion and removal of markers that move with the fluid.

use motile_base::Vec2;

/// Splits segments longer than 1.5 times `target` and removes segments shorter than half of it, keeping every particle.
///
/// A new marker lies on the cubic through the four nearest ones, in the chord length; the particles of a split segment
/// are shared in proportion to the lengths of its halves. Returns how many markers were inserted and removed.
pub(crate) fn redistribute(
    markers: &mut Vec<Vec2>,
    numbers: &mut Vec<f64>,
    target: f64,
    minimum: usize,
) -> (usize, usize) {
    let (mut inserted, mut removed) = (0, 0);
    let carries = !numbers.is_empty();
    let mut k = 0;
    while k < markers.len() {
        let count = markers.len();
        let next = (k + 1) % count;
        let length = (markers[next] - markers[k]).length();
        if length > 1.5 * target {
            let (before, after) = (markers[(k + count - 1) % count], markers[(k + 2) % count]);
            let middle = midpoint([before, markers[k], markers[next], after]);
            let (first, second) = ((middle - markers[k]).length(), (markers[next] - middle).length());
            markers.insert(k + 1, middle);
            if carries {
                let all = numbers[k];
                let kept = all * first / (first + second);
                numbers[k] = kept;
                numbers.insert(k + 1, all - kept);
            }
            inserted += 1;
            k += 2;
        } else if length < 0.5 * target && count > minimum {
            // Marker `next` goes; segment `next` is merged into segment k.
            markers.remove(next);
            if carries {
                let moved = numbers.remove(next);
                let keeper = if next < k { k - 1 } else { k };
                numbers[keeper] += moved;
            }
            removed += 1;
            k += 1;
        } else {
            k += 1;
        }
    }
    (inserted, removed)
}

/// Returns the point half way (in chord length) between the two middle ones of four points, on the cubic through all of
/// them.
fn midpoint(points: [Vec2; 4]) -> Vec2 {
    let mut at = [0.0; 4];
    for i in 1..4 {
        at[i] = at[i - 1] + (points[i] - points[i - 1]).length();
    }
    let s = 0.5 * (at[1] + at[2]);
    let mut sum = Vec2::ZERO;
    for i in 0..4 {
        let weight: f64 = (0..4).filter(|&j| j != i).map(|j| (s - at[j]) / (at[i] - at[j])).product();
        sum += weight * points[i];
    }
    sum
}

#[cfg(test)]
mod tests;

//! Smooth lines through the markers of an interface.

use motile::base::Vec2;

/// Lines between two neighbouring points, and the number of points from which they are drawn as they are.
const PARTS: usize = 4;
const DENSE: usize = 2000;

/// Returns the smooth line through the points of one period of a curve, up to the next image of the first point, which
/// is displaced by `around` (length; zero for a closed curve). Between two points it is the cubic whose slopes there
/// are the slopes of the chords of their neighbours (Catmull and Rom, "A class of local interpolating splines", 1974).
pub(crate) fn smooth(points: &[Vec2], around: Vec2) -> Vec<Vec2> {
    let count = points.len() as isize;
    let at = |k: isize| points[k.rem_euclid(count) as usize] + k.div_euclid(count) as f64 * around;
    let parts = parts(points.len()) as isize;
    let between = |k: isize| {
        let [before, start, end, after] = [k - 1, k, k + 1, k + 2].map(at);
        let [from, to] = [0.5 * (end - before), 0.5 * (after - start)];
        let rise = end - start;
        (0..parts).map(move |part| {
            let t = part as f64 / parts as f64;
            start + t * (from + t * ((3.0 * rise - 2.0 * from - to) + t * (from + to - 2.0 * rise)))
        })
    };
    (0..count).flat_map(between).chain((count > 0).then(|| at(count))).collect()
}

/// Returns the values at the points of [`smooth`], linear between those at the points of the curve.
pub(crate) fn between(values: &[f64]) -> Vec<f64> {
    let parts = parts(values.len());
    let ends = values.iter().zip(values.iter().cycle().skip(1));
    let parts =
        ends.flat_map(|(start, end)| (0..parts).map(move |part| start + (end - start) * part as f64 / parts as f64));
    parts.chain(values.first().copied()).collect()
}

fn parts(count: usize) -> usize {
    if count < DENSE { PARTS } else { 1 }
}

#[cfg(test)]
mod tests;

//! Smooth lines through the markers of an interface.

use motile::base::Vec2;

/// Lines between two neighbouring points, and the number of points from which they are drawn as they are.
const PARTS: usize = 4;
const DENSE: usize = 2000;

/// Smooth line through the points of one period of a curve, up to the next image of the first point, which is displaced
/// by `around` (length; zero for a closed curve). Between two points it is the cubic whose slopes there are those of
/// the chords of their neighbours (Catmull and Rom, "A class of local interpolating splines", 1974).
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

/// Values at the points of [`smooth`], linear between those at the points of the curve.
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
mod tests {
    use super::*;
    use std::f64::consts::TAU;

    /// Midway between two points of a circle the cubic is off by 3/128 of the fourth power of their angle.
    #[test]
    fn lines_lie_on_the_curve() {
        for (count, expected) in [(16, 5.6e-4), (32, 3.5e-5)] {
            let points: Vec<Vec2> = (0..count).map(|k| Vec2::from_angle(TAU * k as f64 / count as f64)).collect();
            let line = smooth(&points, Vec2::ZERO);
            assert_eq!((line.len(), line[0], line[4 * count]), (4 * count + 1, points[0], points[0]));
            let most = line.iter().map(|point| (point.length() - 1.0).abs()).fold(0.0, f64::max);
            assert!((most / expected - 1.0).abs() < 0.1, "{most}");
        }
    }

    /// A wave goes on into its next period without a kink; chords would be off by 8.5e-3.
    #[test]
    fn periodic_lines_go_on() {
        let wave = |x: f64| Vec2::new(x, (TAU * x / 3.0).sin());
        let points: Vec<Vec2> = (0..24).map(|k| wave(3.0 * f64::from(k) / 24.0)).collect();
        let line = smooth(&points, Vec2::new(3.0, 0.0));
        assert!(line.iter().all(|point| (point.y - wave(point.x).y).abs() < 4e-4));
        assert!(line[96].distance(wave(3.0)) < 1e-14);
        let values: Vec<f64> = points.iter().map(|point| point.y).collect();
        let there = between(&values);
        assert!(there.len() == line.len() && there.iter().zip(&line).all(|(v, point)| (v - point.y).abs() < 0.01));
        assert!(smooth(&[], Vec2::ZERO).is_empty() && between(&[]).is_empty());
    }
}

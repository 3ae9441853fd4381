//! Points at equal distances along a curve, closed or periodic.

use motile_base::{Vec2, internal::all_points_finite};

use super::MAXIMUM_UNEVENNESS;
use crate::InterfaceError;

/// Largest relative difference of chords.
const TOLERANCE: f64 = 1e-12;
/// Round-offs of a coordinate that the difference of two chords may have (measured for ellipses: up to 9).
const ROUND_OFFS: f64 = 16.0;
/// Sweeps without improvement after which a difference that round-off explains is taken.
const STALLED: usize = 5;

/// Returns the equidistant points of the curve `point(t)`, t in [0, 1], closed or advancing by `advance` (length):
/// `count` of them, from `point(0)` on. Chords are equal to 1e-12 of their length (or to the round-off of the
/// coordinates and of the parameter, if that is more). If there are none on a curve that may have corners, because a
/// corner is sharper than their distance, they are at equal arc lengths.
///
/// The first guess is equal arc length in a table. Then each parameter is moved by the deficit of the chords before it
/// over the local speed, which converges by a factor of about (curvature times spacing)^2 a sweep.
pub(crate) fn equidistant(
    point: impl Fn(f64) -> Vec2,
    advance: Vec2,
    count: usize,
    has_corners: bool,
) -> Result<Vec<Vec2>, InterfaceError> {
    let chords = |points: &[Vec2]| {
        let next = points.iter().skip(1).copied().chain(points.first().map(|first| first + advance));
        points.iter().zip(next).map(|(a, b)| (b - a).length()).collect::<Vec<f64>>()
    };
    let fine = (16 * count).max(4096);
    let samples: Vec<Vec2> = (0..fine).map(|i| point(i as f64 / fine as f64)).collect();
    all_points_finite("the points of the curve", &samples)?;
    let mut arc = vec![0.0; fine + 1];
    let mut fastest = 0.0_f64;
    for (i, chord) in chords(&samples).into_iter().enumerate() {
        arc[i + 1] = arc[i] + chord;
        fastest = fastest.max(fine as f64 * chord);
    }
    let mut parameters: Vec<f64> = (0..count)
        .map(|k| {
            let target = arc[fine] * k as f64 / count as f64;
            let i = arc[1..fine].partition_point(|&s| s <= target);
            let step = arc[i + 1] - arc[i];
            (i as f64 + if step > 0.0 { (target - arc[i]) / step } else { 0.0 }) / fine as f64
        })
        .collect();

    let even: Vec<Vec2> = parameters.iter().map(|&t| point(t)).collect();
    let mut points = even.clone();
    let extent = points.iter().map(|point| point.abs().max_element()).fold(0.0, f64::max);
    let (mut best, mut nearest, mut stalled, mut attainable) = (f64::INFINITY, points.clone(), 0, TOLERANCE);
    for _ in 0..200 {
        all_points_finite("the points of the curve", &points)?;
        let chords = chords(&points);
        let mean = chords.iter().sum::<f64>() / count as f64;
        let residual = chords.iter().map(|chord| (chord / mean - 1.0).abs()).fold(0.0, f64::max);
        if residual <= TOLERANCE.max(8.0 * f64::EPSILON * extent / mean) {
            return Ok(points);
        }
        attainable = TOLERANCE.max(ROUND_OFFS * f64::EPSILON * (extent + fastest) / mean);
        if residual < best {
            (best, stalled) = (residual, 0);
            nearest.clone_from(&points);
        } else if best <= attainable {
            stalled += 1;
        }
        if stalled == STALLED {
            return Ok(nearest);
        }
        let old = parameters.clone();
        let mut deficit = 0.0;
        for k in 1..count {
            deficit += mean - chords[k - 1];
            let next = if k + 1 == count { 1.0 } else { old[k + 1] };
            let width = next - old[k - 1];
            let length = chords[k - 1] + chords[k];
            let move_by = if length > 0.0 { deficit * width / length } else { 0.0 };
            // Never past a neighbour.
            parameters[k] = old[k] + move_by.clamp(0.45 * (old[k - 1] - old[k]), 0.45 * (next - old[k]));
            points[k] = point(parameters[k]);
        }
    }
    if best <= attainable {
        return Ok(nearest);
    }
    // Around a corner that is sharper than the distance of points there need be none at equal chords.
    let (least, most) = chords(&even).iter().fold((f64::INFINITY, 0.0_f64), |(a, b), &c| (a.min(c), b.max(c)));
    if has_corners && most <= MAXIMUM_UNEVENNESS * least {
        return Ok(even);
    }
    Err(InterfaceError::NoConvergence {
        what: "the search for equidistant markers",
        residual: best,
        tolerance: attainable,
        remedy: "Use more markers or a curve with less sharp corners",
    })
}

//! Curves that are periodic along x.

use std::f64::consts::TAU;

use motile_base::{
    Vec2, finite,
    internal::{all_finite, all_points_finite, at_least},
    polygon::CrossingFinder,
    positive, within,
};

use super::{
    MAXIMUM_MARKERS, MAXIMUM_UNEVENNESS, MINIMUM_MARKERS, equidistant::equidistant, near_polygon::NearPolygon,
    polygon::raw_area,
};
use crate::InterfaceError;

/// Samples on which a curve is checked.
const SAMPLES: usize = 2048;

/// Returns the equidistant markers of one period of the curve `y = height + sum over k of a_k cos(2 pi k x/L) + b_k
/// sin(2 pi k x/L)`, k from 1, over the advance of plus or minus the period L (length), from x = -advance/2 on. Their
/// polygon encloses the area of the curve.
///
/// # Errors
/// Returns an error for an advance that is zero, numbers that are not finite, fewer than eight or more than a million
/// markers.
pub fn wave(
    height: f64,
    advance: f64,
    cosines: &[f64],
    sines: &[f64],
    count: usize,
) -> Result<Vec<Vec2>, InterfaceError> {
    positive("the period", advance.abs())?;
    finite("the height", height)?;
    all_finite("the amplitudes", cosines)?;
    all_finite("the amplitudes", sines)?;
    within("the number of markers", count as f64, MINIMUM_MARKERS as f64, MAXIMUM_MARKERS as f64)?;
    let point = |t: f64| {
        let x = advance * (t - 0.5);
        let angle = |k: usize| TAU * (k + 1) as f64 * x / advance.abs();
        let of = |amplitudes: &[f64], wave: fn(f64) -> f64| {
            amplitudes.iter().enumerate().map(|(k, a)| a * wave(angle(k))).sum::<f64>()
        };
        Vec2::new(x, of(cosines, f64::cos) + of(sines, f64::sin))
    };
    let mut markers = equidistant(point, Vec2::new(advance, 0.0), count, false)?;
    let mean = area(&markers, advance) / advance;
    markers.iter_mut().for_each(|marker| marker.y += height + mean);
    Ok(markers)
}

/// Returns the equidistant markers of the smooth curve through the points of one period (length), which continues
/// `advance` further along x (length): a cubic spline near the polygon, as
/// [`Curve::through_points`](crate::Curve::through_points).
///
/// # Errors
/// Returns an error for:
/// * an advance that is zero,
/// * fewer than eight points, points that are not finite, coincide or do not close across the period, a crossing,
/// * fewer than eight or more than a million markers.
pub fn line_through(points: &[Vec2], advance: f64, count: usize) -> Result<Vec<Vec2>, InterfaceError> {
    within("the number of markers", count as f64, MINIMUM_MARKERS as f64, MAXIMUM_MARKERS as f64)?;
    let curve = near_line(points, advance)?;
    equidistant(|t| curve.spline.point(t), Vec2::new(advance, 0.0), count, true)
}

/// Returns the largest distance of the curve of [`line_through`] from the polygon through its points (length).
///
/// # Errors
/// Returns the errors of [`line_through`].
pub fn line_distance_from_polygon(points: &[Vec2], advance: f64) -> Result<f64, InterfaceError> {
    Ok(near_line(points, advance)?.distance)
}

fn near_line(points: &[Vec2], advance: f64) -> Result<NearPolygon, InterfaceError> {
    check_period(points, advance)?;
    NearPolygon::new(points, Vec2::new(advance, 0.0), |spline| {
        let samples: Vec<Vec2> = (0..SAMPLES).map(|k| spline.point(k as f64 / SAMPLES as f64)).collect();
        let found = CrossingFinder::default().first_crossing_over(&samples, advance)?;
        Ok(found.map(|(first, second)| [first, second].map(|k| (k % SAMPLES) as f64 / SAMPLES as f64)))
    })
}

/// Returns the area (length squared) between y = 0 and one period of the polygon that continues `advance` further along
/// x, positive where the left side of the polygon is between them. The area of the closed polygon where that is zero.
pub(crate) fn area(markers: &[Vec2], advance: f64) -> f64 {
    let (Some(first), Some(last)) = (markers.first(), markers.last()) else { return 0.0 };
    if advance == 0.0 {
        return raw_area(markers);
    }
    let side = |a: Vec2, b: Vec2| -0.5 * (a.y + b.y) * (b.x - a.x);
    let sides = markers.windows(2).map(|pair| side(pair[0], pair[1]));
    sides.sum::<f64>() + side(*last, *first + Vec2::new(advance, 0.0))
}

/// Checks markers of one period of an interface.
pub(crate) fn check_period(markers: &[Vec2], advance: f64) -> Result<(), InterfaceError> {
    positive("the period", advance.abs())?;
    at_least("markers", markers.len(), MINIMUM_MARKERS)?;
    all_points_finite("the markers", markers)?;
    let closing = (markers[0] + Vec2::new(advance, 0.0) - markers[markers.len() - 1]).length();
    let range = [f64::INFINITY, 0.0_f64];
    let chords = markers.windows(2).map(|pair| (pair[1] - pair[0]).length());
    let [shortest, longest] = chords.fold(range, |[least, most], chord| [chord.min(least), chord.max(most)]);
    if let Some(index) = markers.windows(2).position(|pair| pair[0] == pair[1]) {
        return Err(InterfaceError::coincident_points(index));
    }
    if closing > MAXIMUM_UNEVENNESS * longest || closing < shortest / MAXIMUM_UNEVENNESS {
        return Err(InterfaceError::not_periodic(closing, advance, longest));
    }
    let [shortest, longest] = [closing.min(shortest), closing.max(longest)];
    if longest > MAXIMUM_UNEVENNESS * shortest {
        return Err(InterfaceError::uneven_spacing(longest / shortest, MAXIMUM_UNEVENNESS));
    }
    match CrossingFinder::default().first_crossing_over(markers, advance)? {
        Some((first, second)) => Err(InterfaceError::crossing_points(first, second)),
        None => Ok(()),
    }
}

#[cfg(test)]
mod tests;

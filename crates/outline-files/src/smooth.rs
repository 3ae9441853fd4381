//! Traced outlines without the steps of pixels.

use motile_base::{
    ComplexTransform, Vec2,
    internal::told,
    polygon::{self, CrossingFinder},
    positive,
};
use num_complex::Complex64;

use crate::{Outline, OutlineError, tidy};

/// Least and most samples along an outline.
const SAMPLES: [usize; 2] = [4096, 16384];
/// Most waves of a smooth outline.
const MOST_WAVES: f64 = 1024.0;
/// Points of a smooth outline per wave.
const PER_WAVE: f64 = 8.0;
/// Least points of a smooth outline.
const LEAST_POINTS: f64 = 64.0;
/// Halvings of the range of waves.
const HALVINGS: usize = 24;

const TOO_SMOOTH: &str = "Use a smaller distance for `smooth`";

/// A smooth outline.
#[derive(Debug, Clone, PartialEq)]
pub struct Smoothed {
    /// Points of the smooth outline in the order of [`Outline`], at nearly even distances (unit).
    pub points: Vec<Vec2>,
    /// Largest distance between it and the polygon that it was made from (unit), in either direction.
    pub distance: f64,
}

/// Returns the smoothest outline that stays within a distance (unit) of the polygon through points. Use it for outlines
/// that were traced from pictures, with one or two pixels as the distance. The points are a closed outline, or
/// a line that repeats itself along x with a `period` (unit).
///
/// It is the closed curve `sum over k of z_k/(1 + (k/K)^4) exp(2 pi i k s/L)`, z_k the Fourier coefficients of the
/// polygon over its length s (a smoothing spline). Of all cut-offs K, it has the smallest one for which the curve stays
/// within the distance. A closed curve is scaled about its centroid to the area of the polygon, so that smoothing takes
/// no area away.
///
/// # Errors
/// Returns the errors of [`closed`](crate::closed) and [`line`](crate::line), except that the given points may touch
/// one another. Returns an error for a distance that is not positive, and [`OutlineError::TooClose`] if a curve of 1024
/// waves does not keep the distance.
pub fn smooth(points: &[Vec2], period: Option<f64>, distance: f64) -> Result<Smoothed, OutlineError> {
    positive("the distance of smoothing", distance)?;
    let given = tidy::touching(points, period)?;
    let advance = Vec2::new(period.unwrap_or(0.0), 0.0);
    let wanted = (4 * given.points.len()).clamp(SAMPLES[0], SAMPLES[1]).next_power_of_two();
    let samples = resampled(&given, advance, wanted);
    let mut filter = Filter::new(&samples, advance)?;
    // Curves of few waves stray and curves of many do not.
    let [mut low, mut high] = [0.5_f64.ln(), MOST_WAVES.min(0.25 * wanted as f64).ln()];
    let mut waves = high.exp();
    let closest = filter.curve(waves, &given)?;
    let mut best = (closest.1, closest.0);
    if best.0 > distance {
        return Err(OutlineError::TooClose { wanted: told(distance), least: told(best.0) });
    }
    for _ in 0..HALVINGS {
        let middle = 0.5 * (low + high);
        let (curve, found) = filter.curve(middle.exp(), &given)?;
        if found <= distance {
            (high, waves, best) = (middle, middle.exp(), (found, curve));
        } else {
            low = middle;
        }
    }
    let (found, curve) = best;
    let count = ((PER_WAVE * waves).max(LEAST_POINTS) as usize).next_power_of_two().min(curve.len());
    let stride = curve.len() / count;
    let coarse: Vec<Vec2> = curve.iter().step_by(stride.max(1)).copied().collect();
    let crossing = match period {
        None => CrossingFinder::default().first_crossing(&coarse)?,
        Some(period) => CrossingFinder::default().first_crossing_over(&coarse, period)?,
    };
    if let Some((first, second)) = crossing {
        return Err(OutlineError::crossing(coarse[first], [first, second], TOO_SMOOTH));
    }
    Ok(Smoothed { points: coarse, distance: found })
}

/// Returns so many points at equal distances along a polygon.
fn resampled(outline: &Outline, advance: Vec2, count: usize) -> Vec<Vec2> {
    let points = &outline.points;
    let end = |k: usize| if k + 1 < points.len() { points[k + 1] } else { points[0] + advance };
    let step = outline.perimeter / count as f64;
    let (mut side, mut before) = (0, 0.0);
    (0..count)
        .map(|k| {
            let wanted = step * k as f64;
            while side + 1 < points.len() && before + points[side].distance(end(side)) < wanted {
                before += points[side].distance(end(side));
                side += 1;
            }
            let length = points[side].distance(end(side));
            points[side].lerp(end(side), ((wanted - before) / length).clamp(0.0, 1.0))
        })
        .collect()
}

/// Spectrum of an outline.
struct Filter<'a> {
    samples: &'a [Vec2],
    advance: Vec2,
    spectrum: Vec<Complex64>,
    transform: ComplexTransform,
}

impl<'a> Filter<'a> {
    fn new(samples: &'a [Vec2], advance: Vec2) -> Result<Self, OutlineError> {
        let count = samples.len();
        let mut transform = ComplexTransform::new(count)?;
        let level = |k: usize| samples[k] - advance * (k as f64 / count as f64);
        let mut spectrum: Vec<Complex64> = (0..count).map(|k| Complex64::new(level(k).x, level(k).y)).collect();
        transform.forward(&mut spectrum)?;
        Ok(Self { samples, advance, spectrum, transform })
    }

    /// Returns the curve of that cut-off at the samples, and its largest distance from the polygon.
    fn curve(&mut self, cut: f64, given: &Outline) -> Result<(Vec<Vec2>, f64), OutlineError> {
        let count = self.samples.len();
        let factor = |k: usize| {
            let wave = k.min(count - k) as f64 / cut;
            1.0 / (1.0 + wave.powi(4)) / count as f64
        };
        let mut values: Vec<Complex64> = self.spectrum.iter().enumerate().map(|(k, z)| z * factor(k)).collect();
        self.transform.inverse(&mut values)?;
        let along = |k: usize| self.advance * (k as f64 / count as f64);
        let mut curve: Vec<Vec2> = values.iter().enumerate().map(|(k, z)| Vec2::new(z.re, z.im) + along(k)).collect();
        if self.advance == Vec2::ZERO {
            let (area, arm) = polygon::area_and_arm(&curve);
            if area.is_nan() || area <= 0.0 {
                return Ok((curve, f64::INFINITY));
            }
            let centroid = curve[0] + arm;
            let scale = (given.area / area).sqrt();
            curve.iter_mut().for_each(|point| *point = centroid + (*point - centroid) * scale);
        }
        // Each of the two from the sides of the other that are next to it along the outline.
        let of_curve = curve.iter().copied().enumerate();
        let mut before = 0.0;
        let corners = given.points.iter().enumerate().map(|(k, &corner)| {
            before += if k > 0 { corner.distance(given.points[k - 1]) } else { 0.0 };
            ((before / given.perimeter * count as f64) as usize, corner)
        });
        let apart = from_sides(corners, &curve, self.advance).max(from_sides(of_curve, self.samples, self.advance));
        Ok((curve, apart))
    }
}

/// Returns the largest distance of points from the polygon through others. Each point is compared with the sides around
/// the number that comes with it, up to 64 sides away.
fn from_sides(points: impl Iterator<Item = (usize, Vec2)>, others: &[Vec2], advance: Vec2) -> f64 {
    let count = others.len() as isize;
    let other = |k: isize| others[k.rem_euclid(count) as usize] + advance * k.div_euclid(count) as f64;
    let mut largest = 0.0_f64;
    for (number, point) in points {
        let number = number as isize;
        let mut nearest = f64::INFINITY;
        let mut reach = 0;
        while reach < 64.min(count / 2) {
            for k in [number + reach, number - 1 - reach] {
                let (a, along) = (other(k), other(k + 1) - other(k));
                let squared = along.length_squared();
                let t = if squared > 0.0 { ((point - a).dot(along) / squared).clamp(0.0, 1.0) } else { 0.0 };
                nearest = nearest.min(point.distance(a + along * t));
            }
            if nearest <= largest {
                break;
            }
            reach += 1;
        }
        largest = largest.max(nearest);
    }
    largest
}

#[cfg(test)]
mod tests;

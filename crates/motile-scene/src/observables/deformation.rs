//! The deformation of a closed curve and its motion along itself.

use std::f64::consts::{PI, TAU};

use motile_base::PeriodicSeries;
use motile_base::{
    InputError, Vec2,
    internal::{at_least, spectrum},
    same_length,
};
use num_complex::Complex64;

use super::{MomentEllipse, moment_ellipse::ROUND};

/// Places of a curve for each marker that are looked at for its largest and smallest radius.
const FINER: usize = 4;
/// Most iterations for a place, and the step in the parameter below which it is found.
const MOST_ITERATIONS: usize = 30;
const FOUND: f64 = 1e-14;

/// Deformation of a closed curve, by two definitions of its half axes L and B, `D = (L - B)/(L + B)`, and its motion
/// along itself.
///
/// Everything is computed from the trigonometric interpolant of the markers, at equal steps of its parameter, so that
/// errors fall faster than any power of their number.
#[derive(Debug, Clone, Copy, PartialEq)]
#[non_exhaustive]
pub struct Deformation {
    /// D of the ellipse with the second moments of the area inside; no dimension.
    pub by_moments: f64,
    /// Angle of the long axis of that ellipse from x (radians, from -pi/2 to pi/2); `None` for a shape that is round to
    /// round-off.
    pub angle_of_moments: Option<f64>,
    /// D of the largest and smallest distances of the curve from the centroid of its area; no dimension.
    pub by_extents: f64,
    /// Angle of the largest distance from x (radians, from -pi/2 to pi/2); `None` for a curve that is a circle to
    /// round-off.
    pub angle_of_extents: Option<f64>,
    /// Largest and smallest distance from the centroid (length).
    pub extents: [f64; 2],
    /// Area (length squared) and its centroid (length).
    pub area: f64,
    /// Centroid of the area (length).
    pub centroid: Vec2,
    /// Velocity of the centroid, from the flux of area (length per time).
    pub velocity: Vec2,
    /// Length of the curve (length).
    pub perimeter: f64,
    /// Curvature at the largest distance (1/length).
    pub tip_curvature: f64,
    /// Speed of the fluid relative to the centroid at the largest distance (length per time).
    pub tip_speed: f64,
    /// Speed of the fluid relative to the centroid at the smallest distance (length per time).
    pub waist_speed: f64,
    /// Largest speed of the fluid on the curve relative to the centroid (length per time).
    pub largest_speed: f64,
    /// Time of a point of the curve for a turn along it, `INT ds/|v_t|` (time): the period of tank-treading if the
    /// shape is steady; `None` if the velocity along the curve changes its sign.
    pub period: Option<f64>,
}

/// A function of the parameter as a Fourier series.
struct Series(Vec<(f64, Complex64)>);

impl Series {
    fn new(series: &mut PeriodicSeries, values: &[Vec2]) -> Result<Self, InputError> {
        series.analyse_vectors(values)?;
        let len = values.len();
        let terms = series.coefficients().iter().enumerate();
        Ok(Self(terms.map(|(index, c)| (spectrum::wave(index, len), *c)).collect()))
    }

    /// Returns the value, first and second derivative at a parameter.
    fn at(&self, parameter: f64) -> [Complex64; 3] {
        let mut sums = [Complex64::ZERO; 3];
        for (wave, c) in &self.0 {
            let term = c * Complex64::cis(wave * parameter);
            sums[0] += term;
            sums[1] += Complex64::I * wave * term;
            sums[2] -= wave * wave * term;
        }
        sums
    }

    /// Returns the parameter of the largest (`sign` 1) or smallest (-1) distance from `centre`, for `count` markers.
    fn extreme(&self, centre: Complex64, sign: f64, count: usize) -> f64 {
        let step = TAU / (FINER * count) as f64;
        let places = (0..FINER * count).map(|k| step * k as f64);
        let distances = places.map(|parameter| (parameter, sign * (self.at(parameter)[0] - centre).norm_sqr()));
        let best = distances.max_by(|a, b| a.1.total_cmp(&b.1));
        self.stationary(centre, best.map_or(0.0, |(parameter, _)| parameter), step)
    }

    /// Returns the parameter near `start` at which the distance from `centre` is stationary.
    fn stationary(&self, centre: Complex64, start: f64, widest: f64) -> f64 {
        let mut parameter = start;
        for _ in 0..MOST_ITERATIONS {
            let [z, t, bend] = self.at(parameter);
            let r = z - centre;
            let (slope, curvature) = ((r.conj() * t).re, t.norm_sqr() + (r.conj() * bend).re);
            let step = -slope / curvature;
            if !step.is_finite() {
                break;
            }
            parameter += step.clamp(-widest, widest);
            if step.abs() < FOUND || (parameter - start).abs() > 2.0 * widest {
                break;
            }
        }
        if (parameter - start).abs() > 2.0 * widest { start } else { parameter }
    }
}

impl Deformation {
    /// Creates a deformation of the closed curve through markers, counter-clockwise (length), with these velocities
    /// (length per time).
    ///
    /// # Errors
    /// Returns an error for lists of different length, fewer than eight markers.
    pub fn of(markers: &[Vec2], velocities: &[Vec2]) -> Result<Self, InputError> {
        let count = at_least("markers of a curve", markers.len(), 8)?;
        same_length("velocities", count, velocities.len())?;
        let mut series = PeriodicSeries::new(count)?;
        let curve = Series::new(&mut series, markers)?;
        series.differentiate();
        let tangents = series.values().to_vec();
        let step = TAU / count as f64;
        let nodes = || markers.iter().zip(&tangents);
        let ellipse = MomentEllipse::with_tangents(markers, &tangents);
        let MomentEllipse { area, centroid, angle, .. } = ellipse;
        let centre = Complex64::new(centroid.x, centroid.y);
        let [tip, waist] = [1.0, -1.0].map(|sign| curve.extreme(centre, sign, count));
        let [z, t, bend] = curve.at(tip);
        let extents = [(z - centre).norm(), (curve.at(waist)[0] - centre).norm()];
        let elongated = extents[0] - extents[1] > ROUND * (extents[0] + extents[1] + centroid.length());

        // Velocity of the centroid from the flux of area.
        let flux: Vec2 = nodes().zip(velocities).map(|((x, t), v)| (*x - centroid) * (v.x * t.im - v.y * t.re)).sum();
        let drift = flux * (step / area);
        let own: Vec<Vec2> = velocities.iter().map(|v| *v - drift).collect();
        let along: Vec<f64> =
            own.iter().zip(&tangents).map(|(v, t)| (v.x * t.re + v.y * t.im) / t.norm_sqr()).collect();
        let turns = along.iter().all(|v| *v > 0.0) || along.iter().all(|v| *v < 0.0);
        let speed = Series::new(&mut series, &own)?;
        Ok(Self {
            by_moments: ellipse.deformation(),
            angle_of_moments: angle,
            by_extents: (extents[0] - extents[1]) / (extents[0] + extents[1]),
            angle_of_extents: elongated.then(|| axis(z - centre)),
            extents,
            area,
            centroid,
            velocity: drift,
            perimeter: tangents.iter().map(|t| t.norm()).sum::<f64>() * step,
            tip_curvature: (t.conj() * bend).im / t.norm().powi(3),
            tip_speed: speed.at(tip)[0].norm(),
            waist_speed: speed.at(waist)[0].norm(),
            largest_speed: speed.at(speed.extreme(Complex64::ZERO, 1.0, count))[0].norm(),
            period: turns.then(|| along.iter().map(|v| step / v.abs()).sum()),
        })
    }
}

/// Returns the angle of the line along a vector (radians, from -pi/2 to pi/2).
fn axis(z: Complex64) -> f64 {
    let angle = z.arg();
    if angle > 0.5 * PI {
        angle - PI
    } else if angle < -0.5 * PI {
        angle + PI
    } else {
        angle
    }
}

#[cfg(test)]
mod tests;

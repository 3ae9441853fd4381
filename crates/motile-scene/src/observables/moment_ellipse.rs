//! The ellipse with the second moments of an area.

use std::f64::consts::TAU;

use motile_base::{InputError, PeriodicSeries, Vec2, internal::at_least};
use num_complex::Complex64;

/// Deformation relative to the size of round-off below which a shape is round (no dimension).
pub(super) const ROUND: f64 = 1e-11;

/// The ellipse that has the area, the centroid and the second moments of the area inside a closed curve.
///
/// It does not depend on the motion of the curve, nor on the frame in which the motion is measured.
///
/// ```
/// use motile_base::Vec2;
/// use motile_scene::MomentEllipse;
///
/// let angles = (0..32).map(|k| std::f64::consts::TAU * f64::from(k) / 32.0);
/// let markers: Vec<Vec2> = angles.map(|t| Vec2::new(0.5 * t.cos(), 2.0 * t.sin())).collect();
/// let ellipse = MomentEllipse::of(&markers)?;
/// assert!((ellipse.deformation() - 0.6).abs() < 1e-12);
/// assert!((ellipse.angle.unwrap().abs().to_degrees() - 90.0).abs() < 1e-9);
/// # Ok::<(), motile_base::InputError>(())
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
#[non_exhaustive]
pub struct MomentEllipse {
    /// Area (length squared); in three dimensions the volume (length cubed).
    pub area: f64,
    /// Centroid (length).
    pub centroid: Vec2,
    /// Half axes L and B, the longer one first (length).
    pub half_axes: [f64; 2],
    /// Angle of the long axis from x (radians, from -pi/2 to pi/2); `None` for a shape that is round to round-off.
    pub angle: Option<f64>,
}

impl MomentEllipse {
    /// Returns the ellipse of the smooth closed curve through `markers`, which go around counter-clockwise (length).
    ///
    /// # Errors
    /// Returns an error if there are fewer than eight markers, or more than a Fourier series takes.
    pub fn of(markers: &[Vec2]) -> Result<Self, InputError> {
        let count = at_least("markers of a curve", markers.len(), 8)?;
        let mut series = PeriodicSeries::new(count)?;
        series.analyse_vectors(markers)?;
        series.differentiate();
        Ok(Self::with_tangents(markers, series.values()))
    }

    /// Returns the ellipse of the curve through `markers` with these derivatives to a parameter from 0 to 2 pi.
    pub(super) fn with_tangents(markers: &[Vec2], tangents: &[Complex64]) -> Self {
        let step = TAU / markers.len() as f64;
        // The boundary integrals of polynomials of the fourth degree: about the middle of the markers, not the origin,
        // so that a droplet far from it loses no digits.
        let origin = markers.iter().sum::<Vec2>() / markers.len() as f64;
        let [mut area, mut first, mut second] = [[0.0; 3]; 3];
        for (x, t) in markers.iter().zip(tangents) {
            let Vec2 { x, y } = *x - origin;
            area[0] += 0.5 * (x * t.im - y * t.re) * step;
            first[0] += 0.5 * x * x * t.im * step;
            first[1] -= 0.5 * y * y * t.re * step;
            second[0] += x * x * x * t.im * step / 3.0;
            second[1] += 0.5 * x * x * y * t.im * step;
            second[2] -= y * y * y * t.re * step / 3.0;
        }
        let area = area[0];
        let middle = Vec2::new(first[0], first[1]) / area;
        let moments = [
            second[0] / area - middle.x * middle.x,
            second[1] / area - middle.x * middle.y,
            second[2] / area - middle.y * middle.y,
        ];
        Self::of_moments(area, origin + middle, moments, false)
    }

    /// Returns the ellipse of an area (length squared) with its centroid (length) and the means of x^2, x y and y^2
    /// over it, measured from the centroid (length squared). Of a body of revolution, it is the spheroid of its volume.
    #[must_use]
    pub fn of_moments(area: f64, centroid: Vec2, [xx, xy, yy]: [f64; 3], axisymmetric: bool) -> Self {
        let square_over_mean = if axisymmetric { 5.0 } else { 4.0 };
        let (half, mean) = ((0.25 * (xx - yy).powi(2) + xy * xy).sqrt(), 0.5 * (xx + yy));
        let half_axes = [mean + half, (mean - half).max(0.0)].map(|mean: f64| (square_over_mean * mean).sqrt());
        // A place far from the origin has fewer digits.
        let elongated = half > ROUND * (mean + mean.sqrt() * centroid.length());
        let angle = elongated.then(|| 0.5 * (2.0 * xy).atan2(xx - yy));
        Self { area, centroid, half_axes, angle }
    }

    /// Returns the deformation D = (L - B)/(L + B) (no dimension).
    #[must_use]
    pub fn deformation(&self) -> f64 {
        let [long, short] = self.half_axes;
        (long - short) / (long + short)
    }
}

#[cfg(test)]
mod tests;

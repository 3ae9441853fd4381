//! Taylor series of a Green's function if it has no singularity.

use std::f64::consts::{PI, TAU};

use motile_base::InputError;
use num_complex::Complex64;

use crate::{
    greens::{GreensFunction, ln},
    images::Images,
    transforms::Transform,
};
use motile_base::Region;

/// Largest degree of a series: 62 + 2 coefficients fill half of the longer transform, the other half being their
/// mirror images.
pub(crate) const MOST_DEGREES: usize = 62;
/// Largest ratio of the distance of points to the distance of the nearest singularity for which a series is used: at
/// the largest degree its terms have fallen to 0.6^62 = 2e-14.
pub(crate) const LARGEST_RATIO: f64 = 0.6;

/// Series of a Green's function around a distance D, for target minus source D + delta. The flow of a force F in
/// complex form, w = u + i v, is
///
/// ```text
/// w = F [ (pi/2V)|delta|^2 + Re S(delta) ] + conj F [ -(pi/4V) delta^2 - 1/2 delta conj S'(delta) + conj T(delta) ]
/// ```
///
/// Every solution of the Stokes equations for a force elsewhere has this form, with a uniform background force 1/V
/// where the domain is periodic in both directions. Entry n of each array is n! times the coefficient of
/// (delta/unit)^n, real and imaginary parts apart.
#[derive(Debug, Clone)]
pub(crate) struct Series {
    pub(crate) s: [Vec<f64>; 2],
    pub(crate) t: [Vec<f64>; 2],
}

impl Series {
    /// Creates the empty series, with memory for any degree.
    pub(crate) fn new() -> Self {
        let room = || [Vec::with_capacity(MOST_DEGREES + 2), Vec::with_capacity(MOST_DEGREES + 2)];
        Self { s: room(), t: room() }
    }

    /// Returns the highest power; one coefficient more is stored for the derivative.
    pub(crate) fn degree(&self) -> usize {
        self.s[0].len().saturating_sub(2)
    }

    fn clear(&mut self) {
        self.s.iter_mut().chain(&mut self.t).for_each(Vec::clear);
    }

    fn push(&mut self, s: Complex64, t: Complex64) {
        for (array, value) in self.s.iter_mut().zip([s.re, s.im]).chain(self.t.iter_mut().zip([t.re, t.im])) {
            array.push(value);
        }
    }

    /// Becomes the series of free space around D, not zero: `S = 1/2 - ln(D + delta)`, `T = conj(D)/(2 (D + delta))`.
    pub(crate) fn free(&mut self, distance: Complex64, extent: Extent) {
        let Extent { unit, degree, .. } = extent;
        self.clear();
        let ratio = -Complex64::new(unit, 0.0) / distance;
        let factor = 0.5 * distance.conj() / distance;
        self.push(Complex64::new(0.5 - distance.norm().ln(), 0.0), factor);
        let mut power = Complex64::new(1.0, 0.0);
        for n in 1..=degree + 1 {
            let lower = power * ratio;
            power = lower * n as f64;
            self.push(lower, power * factor);
        }
    }

    /// Becomes another series in a unit of length `ratio` times as large, to a lower degree.
    pub(crate) fn rescale(&mut self, other: &Self, ratio: f64, degree: usize) {
        for (own, other) in self.s.iter_mut().zip(&other.s).chain(self.t.iter_mut().zip(&other.t)) {
            own.clear();
            let mut power = 1.0;
            for value in other.iter().take(degree + 2) {
                own.push(value * power);
                power *= ratio;
            }
        }
    }

    /// Becomes another series with source and target exchanged.
    pub(crate) fn reverse(&mut self, other: &Self) {
        for (own, other) in self.s.iter_mut().zip(&other.s).chain(self.t.iter_mut().zip(&other.t)) {
            own.clear();
            own.extend(other.iter().enumerate().map(|(n, value)| if n.is_multiple_of(2) { *value } else { -value }));
        }
    }
}

/// Radius of validity, unit and degree of a series.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Extent {
    /// Largest |delta| (length).
    pub(crate) reach: f64,
    /// Unit of delta (length).
    pub(crate) unit: f64,
    /// Highest power.
    pub(crate) degree: usize,
}

/// Computation of series from the values of the Green's function on a circle.
#[derive(Debug, Clone)]
pub(crate) struct SeriesFinder {
    circles: [Circle; 2],
    greens: GreensFunction,
    images: Images,
    area: f64,
    tolerance: f64,
}

/// Points on a circle and the values there.
#[derive(Debug, Clone)]
struct Circle {
    transform: Transform,
    /// Points on the unit circle.
    points: Vec<Complex64>,
    /// Factors of F and of conj F in the flow.
    even: Vec<Complex64>,
    odd: Vec<Complex64>,
}

impl SeriesFinder {
    pub(crate) fn new(region: &Region, tolerance: f64) -> Result<Self, InputError> {
        let images = Images::of(region, 0.0);
        let tolerance = tolerance.min(1e-12);
        let greens = GreensFunction::new(region, images.tilt(), tolerance);
        let circles = [Circle::new(64)?, Circle::new(128)?];
        Ok(Self { circles, greens, images, area: images.area(), tolerance })
    }

    /// Takes over displaced images of the region.
    pub(crate) fn set_images(&mut self, region: &Region, images: Images) {
        self.images = images;
        self.greens = GreensFunction::new(region, images.tilt(), self.tolerance);
    }

    /// Writes the series around `distance` (length, target minus source), without the free-space flow of the images at
    /// the distances `direct`.
    pub(crate) fn find(&mut self, distance: Complex64, direct: &[Complex64], extent: Extent, out: &mut Series) {
        // Aliasing: a coefficient is mixed with its mirror image in the length of the transform.
        let circle = &mut self.circles[usize::from(2 * extent.degree + 2 > 64)];
        circle.values(&self.greens, &self.images, distance, extent.reach);
        circle.subtract(direct, extent.reach);
        circle.series(self.area, extent, out);
    }
}

impl Circle {
    fn new(len: usize) -> Result<Self, InputError> {
        let transform = Transform::new(len)?;
        let points = (0..len).map(|j| Complex64::cis(TAU * j as f64 / len as f64)).collect();
        let zeros = vec![Complex64::default(); len];
        Ok(Self { transform, points, even: zeros.clone(), odd: zeros })
    }

    /// Computes the factors of F and conj F on a circle around `centre` (length).
    fn values(&mut self, greens: &GreensFunction, images: &Images, centre: Complex64, radius: f64) {
        for ((point, even), odd) in self.points.iter().zip(&mut self.even).zip(&mut self.odd) {
            let (log, direction) = greens.stokeslet(images.wrap(centre + point * radius));
            *even = Complex64::new(-log, 0.0);
            *odd = 0.5 * direction.conj();
        }
    }

    /// Subtracts the free-space factors around the distances `direct` (length).
    fn subtract(&mut self, direct: &[Complex64], radius: f64) {
        for ((point, even), odd) in self.points.iter().zip(&mut self.even).zip(&mut self.odd) {
            for distance in direct {
                let d = distance + point * radius;
                *even -= 0.5 - 0.5 * ln(d.norm_sqr());
                *odd -= 0.5 * d / d.conj();
            }
        }
    }

    /// Writes the series with these values.
    fn series(&mut self, area: f64, extent: Extent, out: &mut Series) {
        let Extent { reach, unit, degree } = extent;
        self.transform.forward(&mut self.even);
        self.transform.forward(&mut self.odd);
        let len = self.even.len();
        out.clear();
        let mut scale = 1.0;
        for n in 0..=degree + 1 {
            let s = if n == 0 { self.even[0] - 0.5 * PI / area * reach * reach } else { self.even[n] * 2.0 };
            // The term delta conj S' of conj F has waves of the other sign, two below those of S.
            let slope = if n + 2 < len / 2 { self.even[n + 2] * (n + 2) as f64 } else { Complex64::default() };
            let t = self.odd[(len - n) % len].conj() + slope;
            if n > 0 {
                scale *= n as f64 * unit / reach;
            }
            out.push(s * scale, t * scale);
        }
    }
}

#[cfg(test)]
mod tests;

//! Geometry, forces and marker motion of a smooth curve, closed or periodic along x, by Fourier series in the marker
//! number.

use std::f64::consts::{PI, TAU};

use motile_base::{InputError, PeriodicSeries, Vec2};
use num_complex::Complex64;

use super::geometry::{Geometry, Rings, add_tangential_motion, write_normal_motion};

/// Fourier series along a closed curve of M markers, marker k at the parameter alpha = 2 pi k / M, or along one period
/// of a curve that is periodic along x. The steady advance of such a curve is not part of the series.
///
/// If the flow itself is spectrally accurate, the chords of the polygon would be the largest error of a scene: their
/// lengths, directions and normals are of second order in the spacing. Here all of them come from X_alpha.
#[derive(Debug, Clone)]
pub(crate) struct SpectralCurve {
    vectors: PeriodicSeries,
    numbers: PeriodicSeries,
    /// Factors that go over from the markers to the middles of the segments.
    to_middles: Vec<Complex64>,
    /// Factors that integrate over the segments.
    over_segments: Vec<Complex64>,
    /// Factors of [`SpectralCurve::sharpen`].
    sharpening: Vec<Complex64>,
    /// Factors of a quadrature over the meridian, of a body of revolution.
    quadrature: Vec<f64>,
}

fn vector(z: Complex64) -> Vec2 {
    Vec2::new(z.re, z.im)
}

/// Returns the integral of exp(i wave alpha) over a segment from alpha = 0 on.
fn segment_integral(wave: f64, spacing: f64) -> Complex64 {
    if wave == 0.0 { spacing.into() } else { (Complex64::cis(wave * spacing) - 1.0) / Complex64::new(0.0, wave) }
}

/// Computes the coefficients of as many samples as the series has, which cannot fail.
fn analyse(series: &mut PeriodicSeries, samples: impl ExactSizeIterator<Item = Complex64>) {
    let _ = series.analyse(samples);
}

impl SpectralCurve {
    pub(crate) fn new(count: usize) -> Result<Self, InputError> {
        let series = PeriodicSeries::new(count)?;
        let half = PI / count as f64;
        let to_middles = PeriodicSeries::factors(count, |wave| Complex64::cis(wave * half));
        let over_segments = PeriodicSeries::factors(count, |wave| segment_integral(wave, 2.0 * half));
        let sharpening = PeriodicSeries::factors(count, |wave| {
            let x = wave * half;
            (if x == 0.0 { 1.0 } else { x / x.sin() }).into()
        });
        let (vectors, numbers, quadrature) = (series.clone(), series, Vec::new());
        Ok(Self { vectors, numbers, to_middles, over_segments, sharpening, quadrature })
    }

    pub(crate) fn len(&self) -> usize {
        self.vectors.len()
    }

    /// Computes the geometry of the smooth curve through the markers; directions are those at the middle of segments.
    /// The curve advances by `advance` along x (length) in a turn of the parameter.
    pub(crate) fn update(&mut self, markers: &[Vec2], advance: f64, geometry: &mut Geometry) {
        geometry.resize(self.len());
        geometry.stretch.resize(self.len(), 0.0);
        geometry.spans.resize(self.len(), 0.0);
        let spacing = TAU / self.len() as f64;
        // Relative to one marker, so that droplets that have travelled far lose no digits.
        let relative = markers.iter().map(|x| Complex64::new(x.x - markers[0].x, x.y - markers[0].y));
        let (step, slope) = (advance / self.len() as f64, advance / TAU);
        if advance == 0.0 {
            analyse(&mut self.vectors, relative);
        } else {
            analyse(&mut self.vectors, relative.enumerate().map(|(k, z)| z - step * k as f64));
        }
        self.vectors.differentiate();
        for (k, tangent) in self.vectors.values().iter().map(|tangent| tangent + slope).enumerate() {
            let stretch = tangent.norm();
            geometry.stretch[k] = stretch;
            geometry.tangents[k] = vector(tangent / stretch);
            geometry.weights[k] = stretch * spacing;
        }
        self.vectors.multiply_each(&self.to_middles);
        let tangents = self.vectors.values().iter().map(|tangent| tangent + slope);
        for ((direction, span), tangent) in geometry.directions.iter_mut().zip(&mut geometry.spans).zip(tangents) {
            let stretch = tangent.norm();
            *direction = vector(tangent / stretch);
            *span = stretch * spacing;
        }
        // Arc length of a segment: the integral of |X_alpha| over it, mode by mode.
        analyse(&mut self.numbers, geometry.stretch.iter().map(|&stretch| stretch.into()));
        // The unpaired wave of an even number of markers, all minima and maxima at the markers, adds nothing.
        let count = self.len();
        self.numbers.scale(|m| if 2 * m < count { 1.0 } else { 0.0 });
        self.numbers.multiply_each(&self.over_segments);
        geometry.perimeter = 0.0;
        for (length, value) in geometry.lengths.iter_mut().zip(self.numbers.values()) {
            *length = value.re;
            geometry.perimeter += value.re;
        }
    }

    /// Writes the places of the curve at the middles of the segments (length).
    pub(crate) fn write_middles(&mut self, markers: &[Vec2], advance: f64, middles: &mut [Vec2]) {
        let step = advance / self.len() as f64;
        let along = |k: usize| Vec2::new(step * k as f64, 0.0);
        let relative = markers.iter().enumerate().map(|(k, x)| *x - markers[0] - along(k));
        analyse(&mut self.vectors, relative.map(|x| Complex64::new(x.x, x.y)));
        self.vectors.multiply_each(&self.to_middles);
        for (k, (middle, value)) in middles.iter_mut().zip(self.vectors.values()).enumerate() {
            *middle = markers[0] + vector(*value) + along(k) + 0.5 * Vec2::new(step, 0.0);
        }
    }

    /// Computes the rings of a surface of revolution, after [`SpectralCurve::update`].
    pub(crate) fn update_rings(&mut self, markers: &[Vec2], geometry: &mut Geometry) {
        let count = self.len();
        let Rings { areas, circles, middles, weights } = &mut geometry.rings;
        for list in [&mut *areas, circles, middles, weights] {
            list.resize(count, 0.0);
        }
        if self.quadrature.len() != count {
            self.quadrature = Rings::quadrature(count);
        }
        analyse(&mut self.numbers, markers.iter().map(|x| x.y.into()));
        self.numbers.multiply_each(&self.to_middles);
        for (middle, value) in middles.iter_mut().zip(self.numbers.values()) {
            *middle = value.re;
        }
        for (circle, x) in circles.iter_mut().zip(markers) {
            *circle = PI * x.y.abs();
        }
        for (k, weight) in weights.iter_mut().enumerate() {
            *weight = self.quadrature[k] * circles[k] * geometry.weights[k];
        }
        let products = markers.iter().zip(&geometry.stretch);
        analyse(&mut self.numbers, products.map(|(x, stretch)| (PI * x.y * stretch).into()));
        self.numbers.multiply_each(&self.over_segments);
        for (area, value) in areas.iter_mut().zip(self.numbers.values()) {
            *area = value.re.abs();
        }
    }

    /// Returns the forces of the tensions of segments on a surface of revolution (force), those on halves of rings: `pi
    /// INT g dalpha` over a marker's piece with `g_x = d(gamma y tau_x)/dalpha`, `g_y = d(gamma y tau_y)/dalpha - gamma
    /// |X_alpha|`, mirrored below the axis, as densities at the markers times the spacing. The parts `felt` of the
    /// tensions, which fields add, are values at the middles of segments, and the others are means over segments.
    pub(crate) fn ring_forces(&mut self, geometry: &Geometry, tensions: &[f64], felt: &[f64], forces: &mut [Vec2]) {
        let (count, spacing) = (self.len(), TAU / self.len() as f64);
        let pull = |k: usize| PI * tensions[k] * geometry.rings.middles[k] * geometry.directions[k];
        let mut before = pull(count - 1);
        for (k, force) in forces.iter_mut().enumerate() {
            let here = pull(k);
            *force = here - before;
            before = here;
        }
        self.sharpen(forces);
        // The pull around the axis, from the middles of the segments to the markers.
        let around = tensions.iter().zip(&geometry.lengths).map(|(tension, length)| PI * tension * length);
        analyse(&mut self.numbers, around.map(Complex64::from));
        self.numbers.multiply(|wave| {
            let half = 0.5 * wave * spacing;
            Complex64::cis(-half) * if half == 0.0 { 1.0 } else { half / half.sin() }
        });
        for (force, around) in forces.iter_mut().zip(self.numbers.values()) {
            force.y -= around.re;
        }
        if !felt.is_empty() {
            // What the factor above adds to values at the middles.
            let around = felt.iter().zip(&geometry.lengths).map(|(tension, length)| PI * tension * length);
            analyse(&mut self.numbers, around.map(Complex64::from));
            self.numbers.multiply(|wave| {
                let half = 0.5 * wave * spacing;
                Complex64::cis(-half) * if half == 0.0 { 0.0 } else { half / half.sin() - 1.0 }
            });
            for (force, excess) in forces.iter_mut().zip(self.numbers.values()) {
                force.y += excess.re;
            }
        }
        for (k, force) in forces.iter_mut().enumerate() {
            *force = if 2 * k > count { -*force } else { *force };
        }
        // Both parts cancel at the poles.
        (forces[0], forces[count / 2]) = (Vec2::ZERO, Vec2::ZERO);
        // The pull along the axis vanishes at the poles, its series through the middles of segments but nearly: what
        // that leaves of a force on the droplet is taken off, over the sines.
        let net: f64 = forces.iter().zip(&self.quadrature).map(|(force, weight)| weight * force.x).sum();
        for (k, force) in forces.iter_mut().enumerate() {
            force.x -= 0.25 * net * spacing * (spacing * k as f64).sin().abs();
        }
    }

    /// Turns forces that are integrals of a density from the middle of one segment to the middle of the next into the
    /// density at the marker times the spacing, a factor of `x / sin x`, x = pi m / M, for mode m. Their sum stays
    /// zero.
    pub(crate) fn sharpen(&mut self, forces: &mut [Vec2]) {
        let _ = self.vectors.analyse_vectors(forces);
        self.vectors.multiply_each(&self.sharpening);
        let _ = self.vectors.write_vectors(forces);
    }

    /// Returns the velocities of equally spaced markers as in [`super::geometry::equidistribute`], with derivatives and
    /// integrals along the smooth curve.
    ///
    /// A translation by `carried` (length per time) is left out of them, and added to the motion. It would be the same
    /// in exact arithmetic, but the products of its parts with normals and tangents alias if nothing truncates them.
    pub(crate) fn equidistribute(
        &mut self,
        geometry: &Geometry,
        velocities: &[Vec2],
        carried: Vec2,
        relaxation: f64,
        motion: &mut [Vec2],
        slip: &mut [f64],
    ) {
        let count = self.len() as f64;
        write_normal_motion(geometry, velocities, carried, motion);
        let tangential = velocities.iter().zip(&geometry.tangents).map(|(u, tau)| (*u - carried).dot(*tau) / count);
        let mean: f64 = tangential.sum();
        let _ = self.vectors.analyse_vectors(motion);
        self.vectors.differentiate();
        // dW/dalpha up to its mean, which the integration leaves out.
        let slopes = self.vectors.values().iter().zip(&geometry.tangents).zip(&geometry.stretch);
        let slopes = slopes.map(|((derivative, tau), stretch)| -vector(*derivative).dot(*tau) - relaxation * stretch);
        analyse(&mut self.numbers, slopes.map(Complex64::from));
        self.numbers.multiply(|wave| if wave == 0.0 { Complex64::ZERO } else { 1.0 / Complex64::new(0.0, wave) });
        let integral = self.numbers.values();
        add_tangential_motion(geometry, velocities, motion, slip, |k, _| integral[k].re + mean);
        if carried != Vec2::ZERO {
            for ((motion, slip), tau) in motion.iter_mut().zip(slip).zip(&geometry.tangents) {
                *motion += carried;
                *slip -= carried.dot(*tau);
            }
        }
    }
}

#[cfg(test)]
mod tests;

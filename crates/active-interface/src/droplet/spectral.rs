//! Geometry, forces and marker motion of a smooth curve by Fourier series in the marker number.

use std::f64::consts::{PI, TAU};

use fourier::ComplexTransform;
use ib_core::Vec2;
use num_complex::Complex;

use super::geometry::{Geometry, outward};

/// Fourier series along a curve of a fixed number M of markers, marker k at the parameter alpha = 2 pi k / M.
///
/// Where the flow itself is spectrally accurate, the chords of the polygon would be the largest error of a scene: their
/// lengths, directions and normals are of second order in the spacing. Here all of them come from X_alpha.
#[derive(Debug, Clone)]
pub(crate) struct SpectralCurve {
    plan: ComplexTransform,
    spectrum: Vec<Complex<f64>>,
    work: Vec<Complex<f64>>,
}

fn complex(v: Vec2) -> Complex<f64> {
    Complex::new(v.x, v.y)
}

fn vector(z: Complex<f64>) -> Vec2 {
    Vec2::new(z.re, z.im)
}

impl SpectralCurve {
    pub(crate) fn new(count: usize) -> Self {
        let zeros = vec![Complex::default(); count];
        Self { plan: ComplexTransform::new(count), spectrum: zeros.clone(), work: zeros }
    }

    pub(crate) fn len(&self) -> usize {
        self.work.len()
    }

    /// Signed wave number of entry m; 0 for the one in the middle, whose sign is undefined.
    fn wave(&self, m: usize) -> f64 {
        let count = self.len();
        if 2 * m < count {
            m as f64
        } else if 2 * m == count {
            0.0
        } else {
            m as f64 - count as f64
        }
    }

    fn transform(&mut self) {
        // The lengths are this plan's own, so that the call cannot fail.
        let _ = self.plan.forward(&mut self.spectrum);
    }

    /// Fills `work` with the values of the series `spectrum` times `factor(wave number)`.
    fn evaluate(&mut self, factor: impl Fn(f64) -> Complex<f64>) {
        let scale = 1.0 / self.len() as f64;
        for m in 0..self.len() {
            self.work[m] = self.spectrum[m] * factor(self.wave(m)) * scale;
        }
        let _ = self.plan.inverse(&mut self.work);
    }

    /// The geometry of the smooth curve through the markers; directions are those at the middle of the segments.
    pub(crate) fn update(&mut self, markers: &[Vec2], geometry: &mut Geometry) {
        geometry.resize(self.len());
        geometry.stretch.resize(self.len(), 0.0);
        let (count, half) = (self.len(), PI / self.len() as f64);
        // Relative to one marker, so that droplets that have travelled far lose no digits.
        for (entry, marker) in self.spectrum.iter_mut().zip(markers) {
            *entry = complex(marker - markers[0]);
        }
        self.transform();
        self.evaluate(|wave| Complex::new(0.0, wave) * Complex::cis(wave * half));
        for (direction, tangent) in geometry.directions.iter_mut().zip(&self.work) {
            *direction = vector(tangent / tangent.norm());
        }
        self.evaluate(|wave| Complex::new(0.0, wave));
        let spacing = TAU / count as f64;
        for k in 0..count {
            let (tangent, stretch) = (self.work[k], self.work[k].norm());
            geometry.stretch[k] = stretch;
            geometry.tangents[k] = vector(tangent / stretch);
            geometry.weights[k] = stretch * spacing;
        }
        // Arc length of a segment: the integral of |X_alpha| over it, mode by mode.
        for (entry, stretch) in self.spectrum.iter_mut().zip(&geometry.stretch) {
            *entry = Complex::new(*stretch, 0.0);
        }
        self.transform();
        self.evaluate(|wave| {
            if wave == 0.0 {
                Complex::new(spacing, 0.0)
            } else {
                (Complex::cis(wave * spacing) - 1.0) / Complex::new(0.0, wave)
            }
        });
        geometry.perimeter = 0.0;
        for (length, value) in geometry.lengths.iter_mut().zip(&self.work) {
            *length = value.re;
            geometry.perimeter += value.re;
        }
    }

    /// Turns forces that are integrals of a density from the middle of one segment to that of the next into the density
    /// at the marker times the spacing; their sum stays zero.
    pub(crate) fn sharpen(&mut self, forces: &mut [Vec2]) {
        for (entry, force) in self.spectrum.iter_mut().zip(forces.iter()) {
            *entry = complex(*force);
        }
        self.transform();
        let half = PI / self.len() as f64;
        self.evaluate(|wave| {
            let x = wave * half;
            Complex::new(if x == 0.0 { 1.0 } else { x / x.sin() }, 0.0)
        });
        for (force, value) in forces.iter_mut().zip(&self.work) {
            *force = vector(*value);
        }
    }

    /// As [`super::geometry::equidistribute`], with derivatives and integrals along the smooth curve.
    pub(crate) fn equidistribute(
        &mut self,
        geometry: &Geometry,
        velocities: &[Vec2],
        relaxation: f64,
        motion: &mut [Vec2],
        slip: &mut [f64],
    ) {
        let count = self.len() as f64;
        let (mut flux, mut total, mut mean_tangential) = (0.0, 0.0, 0.0);
        for ((u, tau), w) in velocities.iter().zip(&geometry.tangents).zip(&geometry.weights) {
            flux += u.dot(&outward(*tau)) * w;
            total += w;
            mean_tangential += u.dot(tau) / count;
        }
        let mean_normal = flux / total;
        for (((u, tau), out), entry) in
            velocities.iter().zip(&geometry.tangents).zip(motion.iter_mut()).zip(&mut self.spectrum)
        {
            let normal = outward(*tau);
            *out = (u.dot(&normal) - mean_normal) * normal;
            *entry = complex(*out);
        }
        self.transform();
        self.evaluate(|wave| Complex::new(0.0, wave));
        // dW/dalpha up to its mean, which the integration leaves out.
        for (((entry, derivative), tau), stretch) in
            self.spectrum.iter_mut().zip(&self.work).zip(&geometry.tangents).zip(&geometry.stretch)
        {
            *entry = Complex::new(-vector(*derivative).dot(tau) - relaxation * stretch, 0.0);
        }
        self.transform();
        self.evaluate(|wave| if wave == 0.0 { Complex::default() } else { 1.0 / Complex::new(0.0, wave) });
        for (k, out) in motion.iter_mut().enumerate() {
            let tau = geometry.tangents[k];
            let w = self.work[k].re + mean_tangential;
            *out += w * tau;
            slip[k] = velocities[k].dot(&tau) - w;
        }
    }
}

#[cfg(test)]
mod tests;

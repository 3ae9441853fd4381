//! Circles of nodes in the unit disc.

use std::f64::consts::TAU;

use motile_base::{ComplexTransform, InputError, PeriodicSeries, Vec2, internal::spectrum::largest_wave};
use num_complex::Complex64;

/// Factor of a mode below which its share of a position is round-off.
const NEGLIGIBLE: f64 = 1e-17;

/// Nodes on a circle: number of the first one, number of nodes, angle of the first one.
#[derive(Debug, Clone)]
pub(super) struct Ring {
    pub(super) start: usize,
    pub(super) count: usize,
    pub(super) turn: f64,
}

impl Ring {
    pub(super) fn angle(&self, node: usize) -> f64 {
        self.turn + TAU * node as f64 / self.count as f64
    }

    pub(super) fn node(&self, number: usize) -> usize {
        self.start + number % self.count
    }
}

/// The harmonic functions of the disc with given Fourier series on its boundary, at the nodes of a ring.
#[derive(Debug, Clone)]
pub(super) struct RingValues {
    transform: ComplexTransform,
    /// Factors `r^m exp(i m turn)` of the modes m = 0, 1 and on; the factors of -m are conjugate.
    factors: Vec<Complex64>,
    values: Vec<Complex64>,
}

impl RingValues {
    /// Creates values on a ring of a radius, from series through so many samples.
    pub(super) fn new(ring: &Ring, radius: f64, samples: usize) -> Result<Self, InputError> {
        let factor = |m: usize| Complex64::from_polar(radius.powi(m as i32), m as f64 * ring.turn);
        let felt = |m: &usize| *m == 0 || radius.powi(*m as i32) > NEGLIGIBLE;
        let factors = (0..=largest_wave(samples)).take_while(felt).map(factor).collect();
        let transform = ComplexTransform::new(ring.count)?;
        Ok(Self { transform, factors, values: vec![Complex64::ZERO; ring.count] })
    }

    /// Returns the number of nodes.
    pub(super) fn len(&self) -> usize {
        self.values.len()
    }

    /// Writes the vectors at the ring's nodes: modes that look alike there are summed, then transformed.
    pub(super) fn write(&mut self, series: &PeriodicSeries, out: &mut [Vec2]) {
        let Self { transform, factors, values, .. } = self;
        let (coefficients, count) = (series.coefficients(), values.len());
        values.fill(Complex64::ZERO);
        values[0] = coefficients[0];
        let mut place = 0;
        for (m, factor) in factors.iter().enumerate().skip(1) {
            place = if place + 1 == count { 0 } else { place + 1 };
            values[place] += coefficients[m] * factor;
            values[if place == 0 { 0 } else { count - place }] += coefficients[coefficients.len() - m] * factor.conj();
        }
        // The lengths are this plan's own, so that the call cannot fail.
        let _ = transform.inverse(values);
        out.iter_mut().zip(values).for_each(|(out, value)| *out = Vec2::new(value.re, value.im));
    }
}

//! Window by which sources are spread to a grid and values are interpolated from it (Kaiser and Bessel).

use std::f64::consts::PI;

use super::polynomial::powers;

/// Most points of a window.
pub(super) const MOST: usize = 18;
/// Grid points over those that the largest wave number needs.
pub(super) const OVERSAMPLING: f64 = 1.25;
/// Share of the exponent at which aliasing and the end of the window's spectrum err alike.
const SHAPE: f64 = 0.97;
/// Points of windows, and the errors of double layers by them at [`OVERSAMPLING`], which are larger than for single
/// layers, relative to the largest velocity (measured).
const ERRORS: [(usize, f64); 7] = [(6, 2e-4), (8, 7e-6), (10, 2e-7), (12, 8e-9), (14, 3e-10), (16, 1e-11), (MOST, 0.0)];

/// The window `I_0(beta sqrt(1 - (2 t/P)^2))/I_0(beta)` for |t| <= P/2, t in distances of grid points.
#[derive(Debug, Clone)]
pub(super) struct Window {
    /// P.
    pub(super) points: usize,
    beta: f64,
    /// Powers of 2 u - 1, u the part of a distance by which a source lies behind its grid point, for each of the P
    /// points in turn.
    powers: Vec<f64>,
}

impl Window {
    /// Creates the narrowest window with errors below a tolerance.
    pub(super) fn new(tolerance: f64) -> Self {
        let points = ERRORS.iter().find(|(_, error)| *error <= tolerance).map_or(MOST, |(points, _)| *points);
        let p = points as f64;
        let beta = SHAPE * PI * p * (1.0 - 0.5 / OVERSAMPLING);
        let peak = bessel(beta * beta);
        let of_point = |j: usize| {
            powers(1e-2 * tolerance, |v| {
                let t = j as f64 + 0.5 - 0.5 * v - 0.5 * p;
                bessel(beta * beta * (1.0 - (2.0 * t / p).powi(2))) / peak
            })
        };
        let all: Vec<Vec<f64>> = (0..points).map(of_point).collect();
        let len = all.iter().map(Vec::len).max().unwrap_or(0);
        let at = |k: usize, j: usize| all[j].get(k).copied().unwrap_or(0.0);
        let powers = (0..len).flat_map(|k| (0..points).map(move |j| (k, j))).map(|(k, j)| at(k, j)).collect();
        Self { points, beta, powers }
    }

    /// Returns the values at the P grid points from the one at or before a source on, which lies the part u of a
    /// distance behind it, displaced by P/2 - 1 distances.
    #[inline(always)]
    pub(super) fn values<const P: usize>(&self, u: f64) -> [f64; P] {
        let v = 2.0 * u - 1.0;
        let mut values = [0.0; P];
        let (rows, _) = self.powers.as_chunks::<P>();
        for row in rows.iter().rev() {
            for j in 0..P {
                values[j] = values[j] * v + row[j];
            }
        }
        values
    }

    /// Its Fourier transform at a wave number times the distance of grid points, over that distance.
    pub(super) fn transform(&self, wave: f64) -> f64 {
        let p = self.points as f64;
        let z = (self.beta * self.beta - (0.5 * wave * p).powi(2)).max(0.0).sqrt();
        p * if z > 0.0 { z.sinh() / z } else { 1.0 } / bessel(self.beta * self.beta)
    }
}

/// I_0 at the root of x, an entire function of x.
fn bessel(x: f64) -> f64 {
    let (mut sum, mut term, mut k) = (1.0, 1.0, 1.0);
    while f64::abs(term) > 1e-17 * f64::abs(sum) {
        term *= 0.25 * x / (k * k);
        sum += term;
        k += 1.0;
    }
    sum
}

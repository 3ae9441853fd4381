//! Parameters that crowd at the edge of the particles.

use std::f64::consts::{PI, TAU};

/// Strength of the crowding, in units of 1/width.
const STRENGTH: f64 = 0.9;
/// Samples of the density, and terms of its cosine series: enough for widths down to 0.05.
const SAMPLES: usize = 1024;
const TERMS: usize = 320;

/// A change of the colatitude, `dt/dtheta = const (1 + (0.9/d)/(1 + ((cos theta - cos e)/(d sin e))^2))`: parameters t
/// are dense within d of the edge e.
#[derive(Debug, Clone)]
pub(super) struct Crowding {
    /// Coefficients b of `t = theta + sum b_k sin(k theta)`, from k = 1.
    waves: Vec<f64>,
    width: f64,
}

impl Crowding {
    /// Crowds the parameters around this colatitude, within this width (radians).
    pub(super) fn new(edge: f64, width: f64) -> Self {
        let density = |theta: f64| {
            let distance = (theta.cos() - edge.cos()) / (width * edge.sin());
            1.0 + STRENGTH / width / (1.0 + distance * distance)
        };
        let samples: Vec<f64> = (0..SAMPLES).map(|j| density(TAU * j as f64 / SAMPLES as f64)).collect();
        let mean = samples.iter().sum::<f64>() / SAMPLES as f64;
        let wave = |k: usize| {
            let cosine = |j: usize| (TAU * (j * k % SAMPLES) as f64 / SAMPLES as f64).cos();
            let sum: f64 = samples.iter().enumerate().map(|(j, value)| value * cosine(j)).sum();
            2.0 * sum / (SAMPLES as f64 * mean * k as f64)
        };
        Self { waves: (1..=TERMS).map(wave).collect(), width }
    }

    /// Returns the width.
    pub(super) fn width(&self) -> f64 {
        self.width
    }

    /// Returns the parameter of a colatitude, and its derivative.
    pub(super) fn parameter(&self, theta: f64) -> (f64, f64) {
        let waves = self.waves.iter().enumerate();
        waves.fold((theta, 1.0), |(t, slope), (k, wave)| {
            let (sin, cos) = ((k + 1) as f64 * theta).sin_cos();
            (t + wave * sin, slope + (k + 1) as f64 * wave * cos)
        })
    }

    /// Returns the colatitude of a parameter from 0 to pi, and the derivative of the parameter by it.
    pub(super) fn colatitude(&self, parameter: f64) -> (f64, f64) {
        let (mut low, mut high) = (0.0, PI);
        let mut theta = parameter;
        for _ in 0..60 {
            let (t, slope) = self.parameter(theta);
            if t < parameter {
                low = theta;
            } else {
                high = theta;
            }
            let newton = theta - (t - parameter) / slope;
            let next = if newton > low && newton < high { newton } else { 0.5 * (low + high) };
            if (next - theta).abs() < 1e-15 {
                return (next, slope);
            }
            theta = next;
        }
        (theta, self.parameter(theta).1)
    }
}

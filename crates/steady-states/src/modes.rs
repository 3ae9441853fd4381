//! Fourier coefficients of a state, sorted by symmetry.

use std::f64::consts::TAU;
use std::ops::Range;

use fourier::PeriodicSeries;
use nalgebra::DVector;
use num_complex::Complex64;

use crate::SteadyError;

/// Part of all states, of a droplet that is its own mirror image at the x axis.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Part {
    /// Those that are mirror symmetric too: cosines.
    Even,
    /// Those that change their sign: sines.
    Odd,
    /// All.
    Full,
}

/// A state as coefficients without dimension: of offsets over the radius, then of densities over their mean; first the
/// cosines of both from the mean on, then the sines of both. The unpaired mode of an even number of nodes is left out.
#[derive(Debug)]
pub(crate) struct Modes {
    series: PeriodicSeries,
    /// Largest wave number.
    largest: usize,
    /// Units of offset (length) and density.
    scales: [f64; 2],
}

impl Modes {
    pub(crate) fn new(nodes: usize, scales: [f64; 2]) -> Result<Self, SteadyError> {
        Ok(Self { series: PeriodicSeries::new(nodes)?, largest: nodes / 2 - 1, scales })
    }

    pub(crate) fn nodes(&self) -> usize {
        self.series.len()
    }

    /// Number of all coefficients.
    pub(crate) fn len(&self) -> usize {
        4 * self.largest + 2
    }

    pub(crate) fn part(&self, part: Part) -> Range<usize> {
        let even = 2 * (self.largest + 1);
        match part {
            Part::Even => 0..even,
            Part::Odd => even..self.len(),
            Part::Full => 0..self.len(),
        }
    }

    /// Which coefficient this is: of the density (else of the offset), a sine (else a cosine), its wave number.
    pub(crate) fn kind(&self, index: usize) -> (bool, bool, usize) {
        let even = self.largest + 1;
        if index < 2 * even {
            (index >= even, false, index % even)
        } else {
            let index = index - 2 * even;
            (index >= self.largest, true, index % self.largest + 1)
        }
    }

    /// Position of the coefficient of this kind.
    pub(crate) fn index(&self, density: bool, sine: bool, wave: usize) -> usize {
        let even = self.largest + 1;
        let field = usize::from(density);
        if sine { 2 * even + field * self.largest + wave - 1 } else { field * even + wave }
    }

    /// Adds `amount` of a coefficient to the values at the nodes.
    pub(crate) fn perturb(&self, index: usize, amount: f64, offsets: &mut [f64], density: &mut [f64]) {
        let (of_density, sine, wave) = self.kind(index);
        let values = if of_density { density } else { offsets };
        let amount = amount * self.scales[usize::from(of_density)];
        let len = values.len();
        for (k, value) in values.iter_mut().enumerate() {
            let angle = TAU * ((k * wave) % len) as f64 / len as f64;
            *value += amount * if sine { angle.sin() } else { angle.cos() };
        }
    }

    /// Coefficients of values at the nodes.
    pub(crate) fn analyse(&mut self, offsets: &[f64], density: &[f64]) -> Result<DVector<f64>, SteadyError> {
        let [r, c] = self.scales;
        self.series.analyse(offsets.iter().zip(density).map(|(h, m)| Complex64::new(h / r, m / c)))?;
        let coefficients = self.series.coefficients();
        let mut state = DVector::zeros(self.len());
        for wave in 0..=self.largest {
            let up = coefficients[wave];
            let down = if wave == 0 { up } else { coefficients[self.nodes() - wave] };
            let (h, m) = (0.5 * (up + down.conj()), Complex64::new(0.0, -0.5) * (up - down.conj()));
            let factor = if wave == 0 { 1.0 } else { 2.0 };
            for (field, value) in [h, m].into_iter().enumerate() {
                state[self.index(field == 1, false, wave)] = factor * value.re;
                if wave > 0 {
                    state[self.index(field == 1, true, wave)] = -factor * value.im;
                }
            }
        }
        Ok(state)
    }

    /// Values at the nodes, offsets and densities.
    pub(crate) fn synthesise(&self, state: &DVector<f64>) -> (Vec<f64>, Vec<f64>) {
        let nodes = self.nodes();
        let (mut offsets, mut density) = (vec![0.0; nodes], vec![0.0; nodes]);
        for (index, &value) in state.iter().enumerate() {
            if value != 0.0 {
                self.perturb(index, value, &mut offsets, &mut density);
            }
        }
        (offsets, density)
    }
}

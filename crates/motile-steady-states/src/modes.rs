//! Fourier coefficients of a state, sorted by mirror symmetry.

use std::f64::consts::TAU;
use std::ops::Range;

use motile_base::PeriodicSeries;
use nalgebra::DVector;
use num_complex::Complex64;

use crate::SteadyError;

/// Part of the state space, under the mirror image at the x axis.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Part {
    /// Mirror-symmetric states: cosines.
    Even,
    /// States that change their sign: sines.
    Odd,
    /// All states.
    Full,
}

/// Layout of a state as coefficients without dimension, offsets in units of the radius and densities in units of
/// their mean at rest.
///
/// First come the mirror-symmetric ones: cosines of the offsets from the mean on, cosines of the densities, x of the
/// discs over the radius; then the sines of both and y of the discs. The unpaired mode of an even number of nodes is
/// left out. In lists of values at the nodes, x follows the offsets and y the densities.
#[derive(Debug)]
pub(crate) struct Modes {
    series: PeriodicSeries,
    /// Largest wave number.
    largest: usize,
    /// Units of offset (length) and density.
    scales: [f64; 2],
    /// Functions of the parameter: offset and density, or the offset alone without particles.
    fields: usize,
    nuclei: usize,
}

impl Modes {
    /// Returns the layout of so many nodes and discs; a unit of density of zero stands for no particles.
    pub(crate) fn new(nodes: usize, scales: [f64; 2], nuclei: usize) -> Result<Self, SteadyError> {
        let fields = if scales[1] == 0.0 { 1 } else { 2 };
        Ok(Self { series: PeriodicSeries::new(nodes)?, largest: nodes / 2 - 1, scales, fields, nuclei })
    }

    /// Returns the number of nodes.
    pub(crate) fn nodes(&self) -> usize {
        self.series.len()
    }

    /// Returns the largest wave number.
    pub(crate) fn largest(&self) -> usize {
        self.largest
    }

    /// Units of offset (length) and density.
    pub(crate) fn scales(&self) -> [f64; 2] {
        self.scales
    }

    /// Returns the number of all coefficients.
    pub(crate) fn len(&self) -> usize {
        self.fields * (2 * self.largest + 1) + 2 * self.nuclei
    }

    /// Returns the coefficients of a part.
    pub(crate) fn part(&self, part: Part) -> Range<usize> {
        let even = self.even();
        match part {
            Part::Even => 0..even,
            Part::Odd => even..self.len(),
            Part::Full => 0..self.len(),
        }
    }

    /// Returns the number of mirror-symmetric coefficients.
    fn even(&self) -> usize {
        self.fields * (self.largest + 1) + self.nuclei
    }

    /// Returns the kind of a coefficient: true for the density (else the offset), true for a sine (else a cosine), wave
    /// number.
    fn kind(&self, index: usize) -> (bool, bool, usize) {
        let sine = index >= self.even();
        let index = if sine { index - self.even() } else { index };
        let first = usize::from(sine);
        let waves = self.largest + 1 - first;
        (index >= waves, sine, index % waves + first)
    }

    /// Returns the disc whose centre a coefficient belongs to, and true for y (else x); `None` for Fourier
    /// coefficients.
    fn nucleus(&self, index: usize) -> Option<(usize, bool)> {
        let (even, all) = (self.even(), self.len());
        match index {
            _ if (even - self.nuclei..even).contains(&index) => Some((index + self.nuclei - even, false)),
            _ if index >= all - self.nuclei => Some((index + self.nuclei - all, true)),
            _ => None,
        }
    }

    /// Returns true for a coordinate of a disc.
    pub(crate) fn is_of_disc(&self, index: usize) -> bool {
        self.nucleus(index).is_some()
    }

    /// Returns the wave number of a coefficient; 1 for the centre of a disc.
    pub(crate) fn wave(&self, index: usize) -> usize {
        if self.nucleus(index).is_some() { 1 } else { self.kind(index).2 }
    }

    /// Returns the index of the coefficient of a kind.
    pub(crate) fn index(&self, density: bool, sine: bool, wave: usize) -> usize {
        let field = usize::from(density);
        if sine { self.even() + field * self.largest + wave - 1 } else { field * (self.largest + 1) + wave }
    }

    /// Adds `amount` of one coefficient to the values at the nodes.
    pub(crate) fn perturb(&self, index: usize, amount: f64, offsets: &mut [f64], density: &mut [f64]) {
        let len = self.nodes();
        if let Some((nucleus, across)) = self.nucleus(index) {
            let values = if across { density } else { offsets };
            values[len + nucleus] += amount * self.scales[0];
            return;
        }
        let (of_density, sine, wave) = self.kind(index);
        let values = if of_density { density } else { offsets };
        let amount = amount * self.scales[usize::from(of_density)];
        for (k, value) in values[..len].iter_mut().enumerate() {
            let angle = TAU * ((k * wave) % len) as f64 / len as f64;
            *value += amount * if sine { angle.sin() } else { angle.cos() };
        }
    }

    /// Returns the coefficients of offsets and densities at the nodes.
    pub(crate) fn analyse(&mut self, offsets: &[f64], density: &[f64]) -> Result<DVector<f64>, SteadyError> {
        let [r, c] = self.scales;
        let nodes = self.nodes();
        let scaled = |m: f64| if self.fields == 2 { m / c } else { 0.0 };
        self.series.analyse(offsets.iter().zip(density).take(nodes).map(|(h, m)| Complex64::new(h / r, scaled(*m))))?;
        let coefficients = self.series.coefficients();
        let (even, all) = (self.even(), self.len());
        let mut state = DVector::zeros(all);
        for (k, (x, y)) in offsets.iter().zip(density).skip(nodes).enumerate() {
            state[even - self.nuclei + k] = x / r;
            state[all - self.nuclei + k] = y / r;
        }
        for wave in 0..=self.largest {
            let up = coefficients[wave];
            let down = if wave == 0 { up } else { coefficients[nodes - wave] };
            let (h, m) = (0.5 * (up + down.conj()), Complex64::new(0.0, -0.5) * (up - down.conj()));
            let factor = if wave == 0 { 1.0 } else { 2.0 };
            for (field, value) in [h, m].into_iter().enumerate().take(self.fields) {
                state[self.index(field == 1, false, wave)] = factor * value.re;
                if wave > 0 {
                    state[self.index(field == 1, true, wave)] = -factor * value.im;
                }
            }
        }
        Ok(state)
    }

    /// Returns the offsets and densities at the nodes.
    pub(crate) fn synthesise(&self, state: &DVector<f64>) -> (Vec<f64>, Vec<f64>) {
        let values = self.nodes() + self.nuclei;
        let (mut offsets, mut density) = (vec![0.0; values], vec![0.0; values]);
        for (index, &value) in state.iter().enumerate() {
            if value != 0.0 {
                self.perturb(index, value, &mut offsets, &mut density);
            }
        }
        (offsets, density)
    }
}

#[cfg(test)]
mod tests;

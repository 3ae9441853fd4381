//! Viscosity of a shell: resistance to the rate at which it stretches.

use std::f64::consts::TAU;

use motile_base::{InputError, PeriodicSeries, Vec2};
use motile_scene::FluidView;

/// Viscous tensions `eta_s Th` of a closed curve through M markers, with the rate of stretching `Th = tau.dv/ds` of the
/// velocities v of the markers. Derivatives are taken of the Fourier series through them.
///
/// Stresses are the viscous tensions (force) at the markers, and rates are those at which the piece of a marker
/// stretches (length per time). The preconditioner is the inverse on a circle of the same perimeter in fluid.
#[derive(Debug, Clone)]
pub(super) struct ShellViscosity {
    /// Viscosity eta_s (force times time).
    pub(super) viscosity: f64,
    series: PeriodicSeries,
    /// Unit tangents, and compliances of the markers' pieces (length over force and time).
    tangents: Vec<Vec2>,
    pub(super) compliances: Vec<f64>,
    pub(super) stresses: Vec<f64>,
    /// Inverses of the preconditioner for the waves 0, 1, 2, ... that the flow resolves.
    waves: Vec<f64>,
    vectors: Vec<Vec2>,
}

impl ShellViscosity {
    /// Creates the viscosity eta_s (force times time) of a shell of so many markers.
    ///
    /// # Errors
    /// Returns an error for more markers than a Fourier transform takes.
    pub(super) fn new(viscosity: f64, count: usize) -> Result<Self, InputError> {
        Ok(Self {
            viscosity,
            series: PeriodicSeries::new(count)?,
            tangents: vec![Vec2::X; count],
            compliances: vec![0.0; count],
            stresses: vec![0.0; count],
            waves: Vec::new(),
            vectors: vec![Vec2::ZERO; count],
        })
    }

    /// Takes over the markers (length), in fluid of that mean viscosity of both sides (stress times time).
    ///
    /// # Errors
    /// Returns an error for another number of markers.
    pub(super) fn update(&mut self, markers: &[Vec2], view: &FluidView, viscosity: f64) -> Result<(), InputError> {
        self.series.analyse_vectors(markers)?;
        self.series.differentiate();
        let count = markers.len();
        let step = TAU / count as f64;
        let mut perimeter = 0.0;
        let lists = self.tangents.iter_mut().zip(&mut self.compliances);
        for ((tangent, compliance), slope) in lists.zip(self.series.values()) {
            let length = slope.norm() * step;
            *tangent = Vec2::new(slope.re, slope.im) / slope.norm();
            *compliance = length / self.viscosity;
            perimeter += length;
        }
        let spacing = perimeter / count as f64;
        let (stiff, radius) = (spacing / self.viscosity, perimeter / TAU);
        let most = view.shape_modes.map_or(count, |modes| modes.min(count));
        self.waves.clear();
        let waves = 0..=most.saturating_sub(1) / 2;
        self.waves.extend(waves.map(|wave| 1.0 / (stiff + wave as f64 * spacing / (4.0 * viscosity * radius))));
        Ok(())
    }

    /// Writes the rates of the pieces (length per time) for velocities of the markers (length per time).
    pub(super) fn write_rates(&mut self, velocities: &[Vec2], rates: &mut [f64]) {
        // The lists are as long as the series, so that calls cannot fail.
        let _ = self.series.analyse_vectors(velocities);
        self.series.differentiate();
        let step = TAU / velocities.len() as f64;
        for ((rate, tangent), slope) in rates.iter_mut().zip(&self.tangents).zip(self.series.values()) {
            *rate = step * (slope.re * tangent.x + slope.im * tangent.y);
        }
    }

    /// Adds the forces on the fluid (force) of viscous tensions, the transpose of [`ShellViscosity::write_rates`].
    pub(super) fn add_forces(&mut self, tensions: &[f64], forces: &mut [Vec2]) {
        let step = TAU / tensions.len() as f64;
        let pulls = self.vectors.iter_mut().zip(&self.tangents).zip(tensions);
        pulls.for_each(|((pull, tangent), tension)| *pull = *tangent * (step * tension));
        let _ = self.series.analyse_vectors(&self.vectors);
        // The matrix of derivatives is antisymmetric.
        self.series.differentiate();
        for (force, slope) in forces.iter_mut().zip(self.series.values()) {
            *force += Vec2::new(slope.re, slope.im);
        }
    }

    /// Replaces rates by the tensions that cause them on a circle.
    pub(super) fn precondition(&mut self, rates: &mut [f64]) {
        self.vectors.iter_mut().zip(&*rates).for_each(|(vector, rate)| *vector = Vec2::new(*rate, 0.0));
        let _ = self.series.analyse_vectors(&self.vectors);
        let waves = &self.waves;
        self.series.scale(|wave| waves.get(wave).copied().unwrap_or(0.0));
        rates.iter_mut().zip(self.series.values()).for_each(|(rate, value)| *rate = value.re);
    }
}

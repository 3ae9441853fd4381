//! Forces of an energy of a closed curve, such as its bending energy.

use num_complex::Complex64;

use crate::{InputError, PeriodicSeries, Vec2};

/// Forces of a closed curve `X(alpha)` through M markers, marker k at `alpha = 2 pi k/M`, whose energy is the integral
/// over alpha of a density e(v, w) in the speed `v = |X'|` (length) and the cross product `w = X' x X''` (length
/// squared). Its curvature is `w/v^3`.
///
/// Derivatives are taken of the Fourier series through the markers, and the integral is the sum over them. The forces
/// are minus the gradient of this sum by the markers exactly, so that they have neither resultant nor torque where the
/// energy does not change with the curve's place and direction.
#[derive(Debug, Clone)]
pub struct CurveForces {
    series: PeriodicSeries,
    /// First and second derivative of the position by the parameter (length).
    slopes: [Vec<Complex64>; 2],
    /// Derivatives of the density by both.
    pulls: [Vec<Complex64>; 2],
}

impl CurveForces {
    /// Creates forces of curves of `count` markers.
    ///
    /// # Errors
    /// Returns an error for more markers than a Fourier transform takes.
    pub fn new(count: usize) -> Result<Self, InputError> {
        let zeros = || [vec![Complex64::ZERO; count], vec![Complex64::ZERO; count]];
        Ok(Self { series: PeriodicSeries::new(count)?, slopes: zeros(), pulls: zeros() })
    }

    /// Returns the number of markers.
    #[must_use]
    pub fn len(&self) -> usize {
        self.series.len()
    }

    /// Returns `true` for curves without markers, of which there are none.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.series.is_empty()
    }

    /// Takes over the positions of the markers (length).
    ///
    /// # Errors
    /// Returns an error for another number of positions.
    pub fn move_to(&mut self, positions: &[Vec2]) -> Result<(), InputError> {
        self.move_to_over(positions, Vec2::ZERO)
    }

    /// Takes over the positions of the markers (length) of one period of a curve that continues `advance` further
    /// (length).
    ///
    /// # Errors
    /// Returns an error for another number of positions.
    pub fn move_to_over(&mut self, positions: &[Vec2], advance: Vec2) -> Result<(), InputError> {
        let step = advance / positions.len().max(1) as f64;
        self.series.analyse(positions.iter().enumerate().map(|(k, place)| {
            let place = *place - step * k as f64;
            Complex64::new(place.x, place.y)
        }))?;
        for slope in &mut self.slopes {
            self.series.differentiate();
            slope.copy_from_slice(self.series.values());
        }
        let mean = Complex64::new(advance.x, advance.y) / std::f64::consts::TAU;
        self.slopes[0].iter_mut().for_each(|slope| *slope += mean);
        Ok(())
    }

    /// Returns the speed v (length) and cross product w (length squared) at each marker.
    pub fn measures(&self) -> impl Iterator<Item = [f64; 2]> {
        let [first, second] = &self.slopes;
        first.iter().zip(second).map(|(d, dd)| [d.norm(), (d.conj() * dd).im])
    }

    /// Adds minus the gradient of the energy by the markers to `forces` (force), from the derivatives of the density by
    /// v (force) and w (force per length), which `pull` gives for each marker and its v and w.
    ///
    /// # Errors
    /// Returns an error for another number of forces.
    pub fn add(&mut self, pull: impl Fn(usize, [f64; 2]) -> [f64; 2], forces: &mut [Vec2]) -> Result<(), InputError> {
        crate::same_length("forces", self.len(), forces.len())?;
        let mut pulls = std::mem::take(&mut self.pulls);
        let [first, second] = &mut pulls;
        // The density changes by P . dX' + Q . dX''.
        for (index, measures) in self.measures().enumerate() {
            let [d, dd] = [self.slopes[0][index], self.slopes[1][index]];
            let [along, turn] = pull(index, measures);
            first[index] = along / measures[0] * d - turn * Complex64::I * dd;
            second[index] = turn * Complex64::I * d;
        }
        self.series.analyse(second.iter().copied())?;
        self.series.differentiate();
        first.iter_mut().zip(self.series.values()).for_each(|(first, value)| *first -= value);
        self.series.analyse(first.iter().copied())?;
        self.pulls = pulls;
        self.series.differentiate();
        let weight = std::f64::consts::TAU / self.len() as f64;
        for (force, value) in forces.iter_mut().zip(self.series.values()) {
            *force += weight * Vec2::new(value.re, value.im);
        }
        Ok(())
    }

    /// Drops all but so many modes of vectors at the markers ([`PeriodicSeries::truncate_vectors`]).
    ///
    /// # Errors
    /// Returns an error for another number of vectors.
    pub fn truncate(&mut self, vectors: &mut [Vec2], modes: usize) -> Result<(), InputError> {
        self.series.truncate_vectors(vectors, modes)
    }
}

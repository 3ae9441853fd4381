//! Elastic membranes along curves.

use std::f64::consts::TAU;

use serde::{Deserialize, Serialize};

use crate::{CurveForces, InputError, Vec2, finite, not_negative, positive};

/// Measure k of the bending of a membrane in its energy. The measures differ where the membrane is stretched too.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
#[non_exhaustive]
pub enum BendingMeasure {
    /// Curvature kappa, the angle by which the tangent turns per present length (1/length).
    #[default]
    Curvature,
    /// Angle by which the tangent turns per reference length, kappa times the stretch (1/length): the angle of a chain
    /// of links with hinges between them.
    TurningAngle,
}

/// An elastic membrane along a curve that is closed or continues periodically.
///
/// With the stretch lambda, the ratio of present and reference length, and the bending measure k (1/length), k0 at
/// rest,
///
/// ```text
/// energy = INT E_s/2 (lambda - 1)^2 + B/2 (k - k0)^2 dS          over the reference length S
/// ```
///
/// Derivatives along the curve are taken of the Fourier series through the markers, and the forces are minus the
/// gradient of this energy by the markers exactly, so that they have neither resultant nor torque.
///
/// ```
/// use motile_base::{Membrane, Vec2};
///
/// let turn = std::f64::consts::TAU;
/// let circle = |r: f64| (0..64).map(|k| r * Vec2::from_angle(turn * f64::from(k) / 64.0)).collect::<Vec<_>>();
/// let mut membrane = Membrane::new([10.0, 0.5], &circle(1.0), Vec2::ZERO)?;
/// membrane.move_to(&circle(1.2), Vec2::ZERO)?;
/// let exact = turn * (0.5 * 10.0 * 0.2_f64.powi(2) + 0.5 * 0.5 * (1.0 / 1.2_f64 - 1.0).powi(2));
/// assert!((membrane.energy() / exact - 1.0).abs() < 1e-12);
/// # Ok::<(), motile_base::InputError>(())
/// ```
#[derive(Debug, Clone)]
#[doc(alias("vesicle", "capsule", "bending energy", "Helfrich"))]
pub struct Membrane {
    stretching: f64,
    bending: f64,
    measure: BendingMeasure,
    /// Reference length per parameter (length), and bending measure at rest (1/length), at the markers.
    rest: Vec<[f64; 2]>,
    curve: CurveForces,
}

impl Membrane {
    /// Creates a membrane with the moduli of stretching E_s (force) and bending B (force times length squared), at rest
    /// through these markers (length). The markers lie on a closed curve, or on one period of a curve that continues
    /// `advance` further (length).
    ///
    /// # Errors
    /// Returns an error for moduli that are negative or not finite, more markers than a Fourier transform takes,
    /// markers that coincide.
    pub fn new([stretching, bending]: [f64; 2], markers: &[Vec2], advance: Vec2) -> Result<Self, InputError> {
        not_negative("the stretching modulus", stretching)?;
        not_negative("the bending modulus", bending)?;
        let mut curve = CurveForces::new(markers.len())?;
        curve.move_to_over(markers, advance)?;
        let rest: Vec<_> = curve.measures().map(|[speed, cross]| [speed, cross / speed.powi(3)]).collect();
        for [length, _] in &rest {
            positive("the distance of neighbouring points", *length)?;
        }
        Ok(Self { stretching, bending, measure: BendingMeasure::default(), rest, curve })
    }

    /// Measures the bending in another way than by the curvature.
    #[must_use]
    pub fn with_measure(self, measure: BendingMeasure) -> Self {
        Self { measure, ..self }
    }

    /// Puts the bending at rest at one curvature everywhere (1/length; positive for a circle), whatever the shape.
    ///
    /// # Errors
    /// Returns an error for a curvature that is not finite.
    pub fn with_reference_curvature(mut self, curvature: f64) -> Result<Self, InputError> {
        finite("the reference curvature", curvature)?;
        self.rest.iter_mut().for_each(|[_, at_rest]| *at_rest = curvature);
        Ok(self)
    }

    /// Returns the moduli of stretching (force) and of bending (force times length squared).
    #[must_use]
    pub fn moduli(&self) -> [f64; 2] {
        [self.stretching, self.bending]
    }

    /// Returns the measure of the bending.
    #[must_use]
    pub fn measure(&self) -> BendingMeasure {
        self.measure
    }

    /// Returns the length at rest (length), and mean over the markers of the curvature there (1/length).
    #[must_use]
    pub fn at_rest(&self) -> [f64; 2] {
        let count = self.rest.len() as f64;
        let sum = |of: usize| self.rest.iter().map(|rest| rest[of]).sum::<f64>();
        [sum(0) * TAU / count, sum(1) / count]
    }

    /// Takes over the positions of the markers (length) of a curve that continues `advance` further in a period.
    ///
    /// # Errors
    /// Returns an error for another number of positions.
    pub fn move_to(&mut self, positions: &[Vec2], advance: Vec2) -> Result<(), InputError> {
        self.curve.move_to_over(positions, advance)
    }

    /// Adds the elastic forces on the fluid (force): minus the gradient of the energy by the markers.
    ///
    /// # Errors
    /// Returns an error for another number of forces.
    pub fn add_forces(&mut self, forces: &mut [Vec2]) -> Result<(), InputError> {
        let Self { curve, rest, stretching, bending, measure } = self;
        let pull = |index: usize, [speed, cross]: [f64; 2]| {
            let [length, at_rest] = rest[index];
            // The measure is w over this power of v, over the reference length to make up for it.
            let (power, unit) = match measure {
                BendingMeasure::Curvature => (3, 1.0),
                BendingMeasure::TurningAngle => (2, length),
            };
            let per_cross = 1.0 / (speed.powi(power) * unit);
            let moment = *bending * (cross * per_cross - at_rest) * length;
            let along = *stretching * (speed / length - 1.0);
            [along - f64::from(power) * moment * cross * per_cross / speed, moment * per_cross]
        };
        curve.add(pull, forces)
    }

    /// Returns the elastic energy (force times length).
    #[must_use]
    pub fn energy(&self) -> f64 {
        let density = |([stretch, bend], [length, _]): ([f64; 2], &[f64; 2])| {
            length * (self.stretching * (stretch - 1.0).powi(2) + self.bending * bend * bend)
        };
        let sum: f64 = self.strains().zip(&self.rest).map(density).sum();
        0.5 * sum * TAU / self.rest.len() as f64
    }

    /// Returns the stretch (no dimension), and change of the bending measure from that at rest (1/length), at each
    /// marker.
    pub fn strains(&self) -> impl Iterator<Item = [f64; 2]> {
        self.curve.measures().zip(&self.rest).map(|([speed, cross], [length, at_rest])| {
            let stretch = speed / length;
            let bend = cross / speed.powi(3);
            let measured = match self.measure {
                BendingMeasure::Curvature => bend,
                BendingMeasure::TurningAngle => bend * stretch,
            };
            [stretch, measured - at_rest]
        })
    }

    /// Returns the tension T (force) at each marker, in the balance of forces `F dS = d(T tau + M n/lambda)`, n to the
    /// left of the tangent tau: with the bending moment `m = B (k - k0)`, `T = E_s (lambda - 1) - kappa m/lambda` where
    /// the measure is the curvature kappa, and `E_s (lambda - 1)` where it is the turning angle.
    pub fn tensions(&self) -> impl Iterator<Item = f64> {
        self.strains().zip(self.curve.measures()).map(|([stretch, bend], [speed, cross])| {
            let along = self.stretching * (stretch - 1.0);
            match self.measure {
                BendingMeasure::Curvature => along - self.bending * bend * cross / (speed.powi(3) * stretch),
                BendingMeasure::TurningAngle => along,
            }
        })
    }

    /// Returns the modulus by which a wave of that number (1/length) relaxes (force): both moduli at the largest
    /// stretch, and the largest tension by stretching.
    #[must_use]
    pub fn stiffness(&self, wave: f64) -> f64 {
        let (mut stretched, mut tension) = (1.0_f64, 0.0_f64);
        for [stretch, _] in self.strains() {
            stretched = stretched.max(stretch).max(1.0 / stretch);
            tension = tension.max(self.stretching * (stretch - 1.0).abs());
        }
        stretched * (self.stretching + self.bending * wave * wave) + tension
    }

    /// Drops all but so many modes of vectors at the markers ([`crate::PeriodicSeries::truncate_vectors`]).
    ///
    /// # Errors
    /// Returns an error for another number of vectors.
    pub fn truncate(&mut self, vectors: &mut [Vec2], modes: usize) -> Result<(), InputError> {
        self.curve.truncate(vectors, modes)
    }
}

#[cfg(test)]
mod tests;

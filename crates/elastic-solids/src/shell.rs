//! Elastic membranes around fluid: shells and capsules.

use std::f64::consts::{PI, TAU};

use motile_base::{CurveForces, InputError, Vec2, all_points_finite, not_negative, positive, same_length};
use motile_scene::{Body, BodyError, FluidView, MarkerKind, StepLimit, points};
use serde::{Deserialize, Serialize};

use crate::{SolidError, rigid_body::closed_outline};

/// Measure k of the bending of a membrane in its energy. The measures differ where the membrane is stretched too.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
#[non_exhaustive]
pub enum BendingMeasure {
    /// Curvature kappa, the angle by which the tangent turns per present length (1/length).
    #[default]
    Curvature,
    /// Angle by which the tangent turns per reference length, kappa times the stretch (1/length): that of a chain of
    /// links with hinges between them.
    TurningAngle,
}

/// A closed elastic membrane that moves with the fluid, around fluid of its own viscosity: a shell inside a droplet, or
/// a capsule.
///
/// With the stretch lambda, the ratio of present and reference length, and the bending measure k (1/length), k0 at
/// rest,
///
/// ```text
/// energy = INT E_s/2 (lambda - 1)^2 + B/2 (k - k0)^2 dS          over the reference length S
/// ```
///
/// Derivatives along the curve are those of the Fourier series through the markers, and the forces are minus the
/// gradient of this energy by the markers exactly, so that they have neither resultant nor torque.
///
/// ```
/// use elastic_solids::{Shell, SolidError};
/// use motile_base::Vec2;
///
/// let turn = std::f64::consts::TAU;
/// let circle = |r: f64| (0..64).map(|k| r * Vec2::from_angle(turn * f64::from(k) / 64.0)).collect::<Vec<_>>();
/// let shell = Shell::new(&circle(1.0), 10.0, 0.5)?.deformed(&circle(1.2))?;
/// let exact = turn * (0.5 * 10.0 * 0.2_f64.powi(2) + 0.5 * 0.5 * (1.0 / 1.2_f64 - 1.0).powi(2));
/// println!("energy {:.6}", shell.energy());
/// assert!((shell.energy() / exact - 1.0).abs() < 1e-12);
/// # Ok::<(), SolidError>(())
/// ```
#[derive(Debug, Clone)]
pub struct Shell {
    name: String,
    positions: Vec<Vec2>,
    stretching: f64,
    bending: f64,
    measure: BendingMeasure,
    viscosity_inside: Option<f64>,
    /// Reference length per parameter (length), and bending measure at rest (1/length), at the markers.
    lengths: Vec<f64>,
    curvatures: Vec<f64>,
    area: f64,
    curve: CurveForces,
    /// Truncation of the motion where the flow resolves fewer modes than there are markers.
    modes: Option<usize>,
    motions: Vec<Vec2>,
}

impl Shell {
    /// Membrane through points (length) at equally spaced values of some parameter, in either direction, at rest in
    /// this shape, with the moduli of stretching E_s (force) and bending B (force times length squared).
    ///
    /// # Errors
    /// Fewer than 8 points, points that are not finite or coincide, no area, moduli that are negative or not finite.
    pub fn new(points: &[Vec2], stretching: f64, bending: f64) -> Result<Self, SolidError> {
        not_negative("the stretching modulus", stretching)?;
        not_negative("the bending modulus", bending)?;
        let (positions, area, _) = closed_outline(points)?;
        let count = positions.len();
        let mut shell = Self {
            name: "shell".to_owned(),
            positions,
            stretching,
            bending,
            measure: BendingMeasure::default(),
            viscosity_inside: None,
            lengths: Vec::new(),
            curvatures: Vec::new(),
            area,
            curve: CurveForces::new(count)?,
            modes: None,
            motions: vec![Vec2::ZERO; count],
        };
        shell.curve.move_to(&shell.positions)?;
        shell.lengths = shell.curve.measures().map(|[speed, _]| speed).collect();
        for &length in &shell.lengths {
            positive("the distance of neighbouring points", length)?;
        }
        shell.curvatures = shell.curve.measures().map(|[speed, cross]| cross / speed.powi(3)).collect();
        Ok(shell)
    }

    /// Gives the shell a name for messages ("shell" otherwise).
    #[must_use]
    pub fn named(self, name: impl Into<String>) -> Self {
        Self { name: name.into(), ..self }
    }

    /// Measures the bending in another way than by the curvature.
    #[must_use]
    pub fn with_measure(self, measure: BendingMeasure) -> Self {
        Self { measure, ..self }
    }

    /// Puts the bending at rest at one curvature everywhere (1/length; positive for a circle), whatever the shape.
    ///
    /// # Errors
    /// A curvature that is not finite.
    pub fn with_reference_curvature(mut self, curvature: f64) -> Result<Self, SolidError> {
        all_points_finite("the reference curvature", &[Vec2::splat(curvature)])?;
        self.curvatures.fill(curvature);
        Ok(self)
    }

    /// Fills the shell with a fluid of another viscosity (stress times time) than that around it.
    ///
    /// # Errors
    /// A viscosity that is not positive and finite.
    pub fn with_viscosity_inside(self, viscosity: f64) -> Result<Self, SolidError> {
        Ok(Self { viscosity_inside: Some(positive("the viscosity inside", viscosity)?), ..self })
    }

    /// Moves the points of the shell (length); it stays at rest in the shape that it was made in.
    ///
    /// # Errors
    /// Another number of points, points that are not finite or coincide.
    pub fn deformed(mut self, points: &[Vec2]) -> Result<Self, SolidError> {
        same_length("the points of a shell", self.positions.len(), points.len())?;
        all_points_finite("the points of a shell", points)?;
        self.positions.copy_from_slice(points);
        self.curve.move_to(points)?;
        for [speed, _] in self.curve.measures() {
            positive("the distance of neighbouring points", speed)?;
        }
        Ok(self)
    }

    /// Present positions of the markers (length), counter-clockwise, not wrapped into the periods of the region.
    #[must_use]
    pub fn markers(&self) -> &[Vec2] {
        &self.positions
    }

    /// Viscosity of the fluid inside (stress times time), `None` where it is that of the fluid around it.
    #[must_use]
    pub fn viscosity_inside(&self) -> Option<f64> {
        self.viscosity_inside
    }

    /// Elastic energy (force times length).
    #[must_use]
    pub fn energy(&self) -> f64 {
        let sum: f64 = self
            .strains()
            .zip(&self.lengths)
            .map(|([stretch, bend], length)| {
                length * (self.stretching * (stretch - 1.0).powi(2) + self.bending * bend * bend)
            })
            .sum();
        0.5 * sum * TAU / self.positions.len() as f64
    }

    /// Stretch, and change of the bending measure from that at rest (1/length), at each point.
    fn strains(&self) -> impl Iterator<Item = [f64; 2]> {
        let rest = self.lengths.iter().zip(&self.curvatures);
        self.curve.measures().zip(rest).map(|([speed, cross], (length, curvature))| {
            let stretch = speed / length;
            let bend = cross / speed.powi(3);
            let measured = match self.measure {
                BendingMeasure::Curvature => bend,
                BendingMeasure::TurningAngle => bend * stretch,
            };
            [stretch, measured - curvature]
        })
    }

    /// Writes the elastic forces on the fluid (force): minus the gradient of the energy by the points.
    fn forces(&mut self, forces: &mut [Vec2]) -> Result<(), InputError> {
        let Self { curve, lengths, curvatures, stretching, bending, measure, .. } = self;
        forces.fill(Vec2::ZERO);
        let pull = |index: usize, [speed, cross]: [f64; 2]| {
            let length = lengths[index];
            // The measure is w over this power of v, over the reference length to make up for it.
            let (power, unit) = match measure {
                BendingMeasure::Curvature => (3, 1.0),
                BendingMeasure::TurningAngle => (2, length),
            };
            let per_cross = 1.0 / (speed.powi(power) * unit);
            let moment = *bending * (cross * per_cross - curvatures[index]) * length;
            let along = *stretching * (speed / length - 1.0);
            [along - f64::from(power) * moment * cross * per_cross / speed, moment * per_cross]
        };
        curve.add(pull, forces)
    }
}

impl Body for Shell {
    fn name(&self) -> &str {
        &self.name
    }

    fn kind(&self) -> MarkerKind {
        MarkerKind::UnevenInterface { viscosity_inside: self.viscosity_inside }
    }

    fn marker_count(&self) -> usize {
        self.positions.len()
    }

    fn write_markers(&self, positions: &mut [Vec2]) {
        positions.copy_from_slice(&self.positions);
    }

    fn write_forces(&mut self, view: &FluidView, forces: &mut [Vec2]) -> Result<(), BodyError> {
        self.modes = view.shape_modes.filter(|&modes| modes < self.positions.len());
        self.curve.move_to(&self.positions)?;
        Ok(self.forces(forces)?)
    }

    fn state_len(&self) -> usize {
        2 * self.positions.len()
    }

    fn write_state(&self, state: &mut [f64]) {
        points::write(&self.positions, state);
    }

    fn read_state(&mut self, state: &[f64]) -> Result<(), BodyError> {
        points::read(state, &mut self.positions)
    }

    fn mirror(&self, markers: &[usize], state: &[f64], image: &mut [f64]) -> bool {
        points::mirror(markers, state, image);
        true
    }

    fn rate(&mut self, velocities: &[Vec2], rate: &mut [f64]) {
        self.motions.copy_from_slice(velocities);
        if let Some(modes) = self.modes {
            // As long as the series, so that the call cannot fail.
            let _ = self.curve.truncate(&mut self.motions, modes);
        }
        points::write(&self.motions, rate);
    }

    /// Stable step of the shortest wave that moves, of wave number q: on a flat membrane between the two fluids it
    /// relaxes at the rate `q (E_s + |T| + B q^2)/(2 (eta_in + eta_out))`, T the largest tension, both moduli at the
    /// largest stretch.
    fn step_limits(&self, view: &FluidView, limits: &mut dyn FnMut(StepLimit)) {
        let count = self.positions.len();
        let next = self.positions.iter().cycle().skip(1);
        let shortest = self.positions.iter().zip(next).map(|(a, b)| a.distance(*b)).fold(f64::INFINITY, f64::min);
        let wave = match view.shape_modes {
            Some(modes) => PI * modes.min(count) as f64 / (count as f64 * shortest),
            None => 4.0 * view.interface_stiffness,
        };
        let (mut stretched, mut tension) = (1.0_f64, 0.0_f64);
        for [stretch, _] in self.strains() {
            stretched = stretched.max(stretch).max(1.0 / stretch);
            tension = tension.max(self.stretching * (stretch - 1.0).abs());
        }
        let viscosities = view.viscosity + self.viscosity_inside.unwrap_or(view.viscosity);
        let modulus = stretched * (self.stretching + self.bending * wave * wave) + tension;
        limits(StepLimit::decay(4.0 * viscosities / (wave * modulus), "the elastic membrane"));
    }

    fn write_scales(&self, scales: &mut [f64]) {
        scales.fill((self.area / PI).sqrt());
    }

    /// Moduli, and the shape at rest.
    fn properties(&self) -> Vec<(String, f64)> {
        let count = self.positions.len() as f64;
        let mut properties = vec![
            ("the number of markers", count),
            ("the stretching modulus", self.stretching),
            ("the bending modulus", self.bending),
            ("the power of the stretch in the measure of bending", f64::from(self.measure as u8)),
            ("the length at rest", self.lengths.iter().sum::<f64>() * TAU / count),
            ("the mean curvature at rest", self.curvatures.iter().sum::<f64>() / count),
        ];
        properties.extend(self.viscosity_inside.map(|viscosity| ("the viscosity inside", viscosity)));
        properties.into_iter().map(|(name, value)| (name.to_owned(), value)).collect()
    }
}

#[cfg(test)]
mod tests;

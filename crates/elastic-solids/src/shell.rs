//! Elastic membranes around fluid: shells and capsules.

mod viscosity;

use std::f64::consts::PI;

use motile_base::{
    BendingMeasure, Membrane, PeriodicSeries, Vec2,
    internal::{Refuse as _, all_points_finite},
    not_negative, positive, same_length,
};
use motile_scene::{
    Body, BodyError, BodyFlow, FluidView, MarkerKind, Observe, StepLimit, Viscous, checkpoint::SavedState, points,
};

use crate::{SolidError, rigid_body::closed_outline};
use viscosity::ShellViscosity;

/// A closed elastic membrane that moves with the fluid, and may hold fluid of another viscosity: a shell inside a
/// droplet, or a capsule.
///
/// Its energy and forces are the same as in a [`Membrane`]. To measure deformation, angle and period of tank-treading
/// in a flow, use `System::deformation`. To measure strains, observe it in a scene ([`ShellStrains`]).
///
/// ```
/// use elastic_solids::{Shell, SolidError};
/// use elastic_solids::Vec2;
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
#[doc(alias("vesicle", "capsule", "red blood cell", "membrane"))]
pub struct Shell {
    name: String,
    positions: Vec<Vec2>,
    membrane: Membrane,
    viscosity_inside: Option<f64>,
    area: f64,
    /// Truncation of the motion where the flow resolves fewer modes than there are markers.
    modes: Option<usize>,
    motions: Vec<Vec2>,
    viscosity: Option<Box<ShellViscosity>>,
}

impl Shell {
    /// Creates a membrane through points (length) at equally spaced values of some parameter, in either direction, at
    /// rest in this shape, with the moduli of stretching E_s (force) and bending B (force times length squared).
    ///
    /// # Errors
    /// Returns an error for fewer than 8 points, points that are not finite or coincide, no area, moduli that are
    /// negative or not finite.
    pub fn new(points: &[Vec2], stretching: f64, bending: f64) -> Result<Self, SolidError> {
        let (positions, area, _) = closed_outline(points)?;
        Ok(Self {
            name: "shell".to_owned(),
            membrane: Membrane::new([stretching, bending], &positions, Vec2::ZERO)?,
            motions: vec![Vec2::ZERO; positions.len()],
            positions,
            viscosity_inside: None,
            area,
            modes: None,
            viscosity: None,
        })
    }

    /// Gives the shell a name for messages ("shell" otherwise).
    #[must_use]
    pub fn named(self, name: impl Into<String>) -> Self {
        Self { name: name.into(), ..self }
    }

    /// Measures the bending in another way than by the curvature.
    #[must_use]
    pub fn with_measure(self, measure: BendingMeasure) -> Self {
        Self { membrane: self.membrane.with_measure(measure), ..self }
    }

    /// Puts the bending at rest at one curvature everywhere (1/length; positive for a circle), whatever the shape.
    ///
    /// # Errors
    /// Returns an error for a curvature that is not finite.
    pub fn with_reference_curvature(self, curvature: f64) -> Result<Self, SolidError> {
        Ok(Self { membrane: self.membrane.with_reference_curvature(curvature)?, ..self })
    }

    /// Fills the shell with a fluid of another viscosity (stress times time) than the fluid around it.
    ///
    /// # Errors
    /// Returns an error for a viscosity that is not positive and finite.
    pub fn with_viscosity_inside(self, viscosity: f64) -> Result<Self, SolidError> {
        Ok(Self { viscosity_inside: Some(positive("the viscosity inside", viscosity)?), ..self })
    }

    /// Gives the shell a viscosity eta_s (force times time), with which it resists stretching: it carries the tension
    /// `eta_s tau.dv/ds` in addition to its elastic one, v being the velocity of its points. Steps stay as long as they
    /// are.
    ///
    /// # Errors
    /// Returns an error for a viscosity that is negative or not finite.
    #[doc(alias("Kelvin-Voigt", "membrane viscosity"))]
    pub fn with_viscosity(mut self, viscosity: f64) -> Result<Self, SolidError> {
        not_negative("the viscosity of the shell", viscosity)?;
        self.viscosity = match viscosity {
            0.0 => None,
            _ => Some(Box::new(ShellViscosity::new(viscosity, self.positions.len())?)),
        };
        Ok(self)
    }

    /// Returns the viscosity of the shell (force times time), 0 if it has none.
    #[must_use]
    pub fn viscosity(&self) -> f64 {
        self.viscosity.as_ref().map_or(0.0, |own| own.viscosity)
    }

    /// Moves the points of the shell (length). Its shape at rest stays the one that it was made in.
    ///
    /// # Errors
    /// Returns an error for another number of points, points that are not finite or coincide.
    pub fn deformed(mut self, points: &[Vec2]) -> Result<Self, SolidError> {
        same_length("the points of a shell", self.positions.len(), points.len())?;
        all_points_finite("the points of a shell", points)?;
        self.positions.copy_from_slice(points);
        self.membrane.move_to(points, Vec2::ZERO)?;
        for [stretch, _] in self.membrane.strains() {
            positive("the distance of neighbouring points", stretch)?;
        }
        Ok(self)
    }

    /// Returns the present positions of the markers (length), counter-clockwise, not wrapped into the periods of the
    /// region.
    #[must_use]
    pub fn markers(&self) -> &[Vec2] {
        &self.positions
    }

    /// Returns the viscosity of the fluid inside (stress times time), `None` if it is the viscosity of the fluid around
    /// it.
    #[must_use]
    pub fn viscosity_inside(&self) -> Option<f64> {
        self.viscosity_inside
    }

    /// Returns the elastic energy (force times length).
    #[must_use]
    pub fn energy(&self) -> f64 {
        self.membrane.energy()
    }

    /// Returns the membrane, in the shape whose forces were last written, or that the shell was given.
    #[must_use]
    pub fn membrane(&self) -> &Membrane {
        &self.membrane
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
        self.membrane.move_to(&self.positions, Vec2::ZERO)?;
        forces.fill(Vec2::ZERO);
        if let Some(own) = &mut self.viscosity {
            if view.shape_modes.is_none() {
                let what = "a viscous shell on a grid is not resolved";
                let why = "its points are not equally spaced, as the correction of the grid needs them";
                return Err(SolidError::refused(what, why, "Use the method integral or layers").into());
            }
            let mean = self.viscosity_inside.map_or(view.viscosity, |inside| 0.5 * (inside + view.viscosity));
            own.update(&self.positions, view, mean)?;
        }
        Ok(self.membrane.add_forces(forces)?)
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

    fn translate(&self, by: Vec2, state: &mut [f64]) -> bool {
        points::translate(by, state);
        true
    }

    fn rate(&mut self, velocities: &[Vec2], rate: &mut [f64]) {
        self.motions.copy_from_slice(velocities);
        if let Some(modes) = self.modes {
            // As long as the series, so that the call cannot fail.
            let _ = self.membrane.truncate(&mut self.motions, modes);
        }
        points::write(&self.motions, rate);
    }

    /// Stable step of the shortest wave that moves, of wave number q. On a flat membrane between the two fluids it
    /// relaxes at the rate `q (E_s + |T| + B q^2)/(2 (eta_in + eta_ext))`, T the largest tension, both moduli at the
    /// largest stretch.
    fn step_limits(&self, view: &FluidView, limits: &mut dyn FnMut(StepLimit)) {
        let count = self.positions.len();
        let next = self.positions.iter().cycle().skip(1);
        let shortest = self.positions.iter().zip(next).map(|(a, b)| a.distance(*b)).fold(f64::INFINITY, f64::min);
        let wave = match view.shape_modes {
            Some(modes) => PI * modes.min(count) as f64 / (count as f64 * shortest),
            None => 4.0 * view.interface_stiffness,
        };
        let viscosities = view.viscosity + self.viscosity_inside.unwrap_or(view.viscosity);
        let modulus = self.membrane.stiffness(wave);
        limits(StepLimit::decay(4.0 * viscosities / (wave * modulus), "the elastic membrane"));
    }

    fn write_scales(&self, scales: &mut [f64]) {
        scales.fill((self.area / PI).sqrt());
    }

    /// Returns the moduli, and the shape at rest.
    fn properties(&self) -> Vec<(String, f64)> {
        let ([stretching, bending], [length, curvature]) = (self.membrane.moduli(), self.membrane.at_rest());
        let mut properties = vec![
            ("the number of markers", self.positions.len() as f64),
            ("the stretching modulus", stretching),
            ("the bending modulus", bending),
            ("the power of the stretch in the measure of bending", f64::from(self.membrane.measure() as u8)),
            ("the length at rest", length),
            ("the mean curvature at rest", curvature),
        ];
        properties.extend(self.viscosity_inside.map(|viscosity| ("the viscosity inside", viscosity)));
        properties.extend(self.viscosity.as_ref().map(|own| ("the viscosity of the shell", own.viscosity)));
        properties.into_iter().map(|(name, value)| (name.to_owned(), value)).collect()
    }

    fn as_viscous(&mut self) -> Option<&mut dyn Viscous> {
        if self.viscosity.is_some() { Some(self) } else { None }
    }

    fn save(&self) -> SavedState {
        let mut reals = vec![0.0; self.state_len()];
        self.write_state(&mut reals);
        reals.extend_from_slice(Viscous::stresses(self));
        SavedState { reals, counts: Vec::new() }
    }

    fn load(&mut self, _view: &FluidView, saved: &SavedState) -> Result<(), BodyError> {
        let stresses = self.stress_count();
        let (state, stresses) = saved.reals_of(self.state_len() + stresses)?.split_at(self.state_len());
        self.read_state(state)?;
        self.set_stresses(stresses);
        Ok(())
    }
}

impl Viscous for Shell {
    fn stress_count(&self) -> usize {
        self.stresses().len()
    }

    fn write_rates(&mut self, velocities: &[Vec2], rates: &mut [f64]) {
        if let Some(own) = &mut self.viscosity {
            own.write_rates(velocities, rates);
        }
    }

    fn add_stress_forces(&mut self, stresses: &[f64], forces: &mut [Vec2]) {
        if let Some(own) = &mut self.viscosity {
            own.add_forces(stresses, forces);
        }
    }

    fn write_compliances(&self, compliances: &mut [f64]) {
        if let Some(own) = &self.viscosity {
            compliances.copy_from_slice(&own.compliances);
        }
    }

    fn precondition(&mut self, rates: &mut [f64]) {
        if let Some(own) = &mut self.viscosity {
            own.precondition(rates);
        }
    }

    fn stresses(&self) -> &[f64] {
        self.viscosity.as_ref().map_or(&[], |own| &own.stresses)
    }

    fn set_stresses(&mut self, stresses: &[f64]) {
        if let Some(own) = &mut self.viscosity {
            own.stresses.copy_from_slice(stresses);
        }
    }
}

/// Strains of a shell along the trigonometric interpolants of those at its markers.
#[derive(Debug, Clone, Copy, PartialEq)]
#[non_exhaustive]
pub struct ShellStrains {
    /// Largest and smallest stretch (no dimension).
    pub stretches: [f64; 2],
    /// Largest and smallest tension T (force), as in [`Membrane::tensions`].
    pub tensions: [f64; 2],
    /// Elastic energy (force times length).
    pub energy: f64,
}

impl Observe for Shell {
    type Observables = ShellStrains;

    fn observables(&self, _view: &FluidView, _flow: &BodyFlow<'_>) -> Result<ShellStrains, BodyError> {
        let mut membrane = self.membrane.clone();
        membrane.move_to(&self.positions, Vec2::ZERO)?;
        let mut series = PeriodicSeries::new(self.positions.len())?;
        let mut range = |values: &mut dyn Iterator<Item = f64>| -> Result<[f64; 2], BodyError> {
            let values: Vec<_> = values.map(Into::into).collect();
            series.analyse(values.into_iter())?;
            Ok(series.range()?)
        };
        Ok(ShellStrains {
            stretches: range(&mut membrane.strains().map(|[stretch, _]| stretch))?,
            tensions: range(&mut membrane.tensions())?,
            energy: membrane.energy(),
        })
    }
}

#[cfg(test)]
mod tests;

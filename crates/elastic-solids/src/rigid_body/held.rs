//! Rigid bodies whose motion is prescribed.

use std::f64::consts::PI;

use motile_base::Vec2;
use motile_scene::Viscous;

use super::RigidBody;

/// Number of the parts of a rigid motion and of a load: along x, along y, and about the centroid.
const PARTS: usize = 3;

/// A motion that is prescribed, and what it takes.
#[derive(Debug, Clone, PartialEq, Default)]
pub(super) struct Held {
    /// Velocity of the centroid (length per time).
    pub(super) velocity: Vec2,
    /// Angular velocity (radians per time).
    pub(super) spin: f64,
    /// True if every marker is held by its own force ([`RigidBody::by_markers`]).
    pub(super) by_markers: bool,
    /// Minus what holds the body: the force (force) and the torque (force times length) on the fluid, or the forces of
    /// its markers, x then y of each.
    pub(super) stresses: Vec<f64>,
    /// Viscosity of the fluid around it (stress times time).
    pub(super) viscosity: f64,
}

impl Held {
    /// Makes room for what holds a body of so many markers.
    pub(super) fn fit(&mut self, markers: usize) {
        self.stresses.resize(if self.by_markers { 2 * markers } else { PARTS }, 0.0);
    }

    /// Returns the motion with its names.
    pub(super) fn properties(&self) -> [(&'static str, f64); PARTS] {
        let Self { velocity, spin, .. } = self;
        [
            ("the prescribed velocity along x", velocity.x),
            ("the prescribed velocity along y", velocity.y),
            ("the prescribed angular velocity", *spin),
        ]
    }
}

/// The load that holds the body, as stresses without compliance that belong to its rigid motion, or to the velocities
/// of its markers.
impl Viscous for RigidBody {
    fn stress_count(&self) -> usize {
        self.stresses().len()
    }

    fn write_rates(&mut self, velocities: &[Vec2], rates: &mut [f64]) {
        if self.is_held_by_markers() {
            rates.chunks_exact_mut(2).zip(velocities).for_each(|(rate, v)| rate.copy_from_slice(&v.to_array()));
        } else {
            let (velocity, spin) = self.motion(velocities);
            rates.copy_from_slice(&[velocity.x, velocity.y, spin]);
        }
    }

    fn add_stress_forces(&mut self, stresses: &[f64], forces: &mut [Vec2]) {
        if self.is_held_by_markers() {
            let stresses = stresses.chunks_exact(2).map(|stress| Vec2::new(stress[0], stress[1]));
            forces.iter_mut().zip(stresses).for_each(|(force, stress)| *force -= stress);
        } else {
            let [x, y, turn] = [0, 1, 2].map(|part| -stresses[part]);
            self.add_load(Vec2::new(x, y), turn, forces);
        }
    }

    fn subtract_prescribed(&self, rates: &mut [f64]) {
        let Some(&Held { velocity, spin, by_markers, .. }) = self.held.as_deref() else { return };
        if by_markers {
            let turn = Vec2::from_angle(self.angle);
            for (rate, arm) in rates.chunks_exact_mut(2).zip(&self.outline) {
                let prescribed = velocity + spin * turn.rotate(*arm).perp();
                rate[0] -= prescribed.x;
                rate[1] -= prescribed.y;
            }
        } else {
            let prescribed = [velocity.x, velocity.y, spin];
            rates.iter_mut().zip(prescribed).for_each(|(rate, prescribed)| *rate -= prescribed);
        }
    }

    fn is_held(&self) -> bool {
        true
    }

    fn write_compliances(&self, compliances: &mut [f64]) {
        compliances.fill(0.0);
    }

    /// Multiplies velocities by 4 pi eta, about the drag of a cylinder far from walls, and the spin by its torque.
    /// Markers share the drag.
    fn precondition(&mut self, rates: &mut [f64]) {
        let drag = 4.0 * PI * self.held.as_ref().map_or(1.0, |held| held.viscosity);
        if self.is_held_by_markers() {
            let share = drag / self.outline.len() as f64;
            rates.iter_mut().for_each(|rate| *rate *= share);
        } else {
            let factors = [drag, drag, drag * self.squared_radius()];
            rates.iter_mut().zip(factors).for_each(|(rate, factor)| *rate *= factor);
        }
    }

    fn stresses(&self) -> &[f64] {
        self.held.as_ref().map_or(&[], |held| &held.stresses)
    }

    fn set_stresses(&mut self, stresses: &[f64]) {
        if let Some(held) = &mut self.held {
            held.stresses.copy_from_slice(stresses);
        }
    }
}

//! Bending of fluid interfaces.

use motile_base::{CurveForces, InputError, Vec2};

mod stabiliser;

pub(super) use stabiliser::{BendingStabiliser, Stiffness};

/// Bending of a fluid interface, which resists the departure of its curvature kappa (1/length; positive for a circle)
/// from a reference curvature.
#[derive(Debug, Clone)]
pub(crate) struct Bending {
    /// Modulus B (force times length squared).
    pub(crate) modulus: f64,
    /// Reference curvature kappa0 (1/length).
    pub(crate) reference: f64,
    forces: CurveForces,
    pub(super) stabiliser: BendingStabiliser,
}

impl Bending {
    pub(super) fn new(modulus: f64, reference: f64, count: usize) -> Result<Self, InputError> {
        let stabiliser = BendingStabiliser::new(count)?;
        Ok(Self { modulus, reference, forces: CurveForces::new(count)?, stabiliser })
    }

    /// Returns the energy `B/2 INT (kappa - kappa0)^2 ds` (force times length) of the curve through the markers.
    pub(super) fn energy(&self, markers: &[Vec2], advance: f64) -> Result<f64, InputError> {
        let mut curve = self.forces.clone();
        curve.move_to_over(markers, Vec2::new(advance, 0.0))?;
        let density = |[speed, cross]: [f64; 2]| (cross / speed.powi(3) - self.reference).powi(2) * speed;
        Ok(0.5 * self.modulus * std::f64::consts::TAU / curve.len() as f64 * curve.measures().map(density).sum::<f64>())
    }

    /// Adds minus the gradient of the energy by the markers to the forces on the fluid (force).
    pub(super) fn add_forces(&mut self, markers: &[Vec2], advance: f64, forces: &mut [Vec2]) -> Result<(), InputError> {
        let Self { modulus, reference, forces: curve, .. } = self;
        curve.move_to_over(markers, Vec2::new(advance, 0.0))?;
        let pull = |_, [speed, cross]: [f64; 2]| {
            let curvature = cross / speed.powi(3);
            let moment = *modulus * (curvature - *reference);
            [moment * (0.5 * (curvature - *reference) - 3.0 * curvature), moment / (speed * speed)]
        };
        curve.add(pull, forces)
    }

    /// Returns the tension (force) that makes a flat interface relax as fast as the bending does at a wave number
    /// (1/length).
    pub(super) fn tension(&self, wave: f64) -> f64 {
        tension_of(self.modulus, self.reference, wave)
    }

    /// Makes the waves of the next step implicit, or none of them.
    pub(super) fn prepare_step(&mut self, stiffness: Option<Stiffness>) {
        let Self { modulus, reference, stabiliser, .. } = self;
        match stiffness {
            Some(of) => stabiliser.prepare(|wave| tension_of(*modulus, *reference, wave), of),
            None => stabiliser.rest(),
        }
    }
}

fn tension_of(modulus: f64, reference: f64, wave: f64) -> f64 {
    modulus * (wave * wave + 0.5 * reference * reference)
}

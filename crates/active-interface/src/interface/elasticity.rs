//! Elasticity along an interface: a membrane whose points move with the fluid.

use std::f64::consts::TAU;

use motile_base::{CurveForces, InputError, Vec2};

/// Elasticity of a membrane: with the stretch lambda and the curvature kappa, kappa0 at rest, its energy is
///
/// ```text
/// INT E_s/2 (lambda - 1)^2 + B/2 (kappa - kappa0)^2 dS          over the reference length S
/// ```
#[derive(Debug, Clone)]
pub(crate) struct Elasticity {
    /// Modulus of stretching E_s (force) and of bending B (force times length squared).
    pub(crate) stretching: f64,
    pub(crate) bending: f64,
    /// Reference length per parameter (length), and curvature at rest (1/length), at the markers.
    rest: Vec<[f64; 2]>,
    curve: CurveForces,
}

impl Elasticity {
    /// A membrane at rest through these markers, one period of a curve that continues `advance` further along x.
    pub(super) fn new(stretching: f64, bending: f64, markers: &[Vec2], advance: f64) -> Result<Self, InputError> {
        let mut curve = CurveForces::new(markers.len())?;
        curve.move_to_over(markers, Vec2::new(advance, 0.0))?;
        let rest = curve.measures().map(|[speed, cross]| [speed, cross / speed.powi(3)]).collect();
        Ok(Self { stretching, bending, rest, curve })
    }

    /// Adds minus the gradient of the energy by the markers to the forces on the fluid (force).
    pub(super) fn add_forces(&mut self, markers: &[Vec2], advance: f64, forces: &mut [Vec2]) -> Result<(), InputError> {
        let Self { stretching, bending, rest, curve } = self;
        curve.move_to_over(markers, Vec2::new(advance, 0.0))?;
        let pull = |index: usize, [speed, cross]: [f64; 2]| {
            let ([length, at_rest], curvature) = (rest[index], cross / speed.powi(3));
            let moment = *bending * (curvature - at_rest) * length;
            let along = *stretching * (speed / length - 1.0);
            [along - 3.0 * moment * curvature / speed, moment / speed.powi(3)]
        };
        curve.add(pull, forces)
    }

    /// Energy of the last shape whose forces were written (force times length).
    pub(super) fn energy(&self) -> f64 {
        let density = |([speed, cross], [length, at_rest]): ([f64; 2], &[f64; 2])| {
            let (stretch, curvature) = (speed / length, cross / speed.powi(3));
            length * (self.stretching * (stretch - 1.0).powi(2) + self.bending * (curvature - at_rest).powi(2))
        };
        let sum: f64 = self.curve.measures().zip(&self.rest).map(density).sum();
        0.5 * sum * TAU / self.rest.len() as f64
    }

    /// Modulus by which a wave of that number (1/length) relaxes (force), in the last shape whose forces were written.
    pub(super) fn stiffness(&self, wave: f64) -> f64 {
        let (mut stretched, mut tension) = (1.0_f64, 0.0_f64);
        for ([speed, _], [length, _]) in self.curve.measures().zip(&self.rest) {
            let stretch = speed / length;
            stretched = stretched.max(stretch).max(1.0 / stretch);
            tension = tension.max(self.stretching * (stretch - 1.0).abs());
        }
        stretched * (self.stretching + self.bending * wave * wave) + tension
    }
}

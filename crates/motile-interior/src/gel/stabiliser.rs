//! Stiff part of the director's motion, made implicit.

use super::elements::Elements;
use crate::laplacian::{Laplacian, Sides, edges};

/// Residual of the implicit equations, relative to the right-hand side.
const TOLERANCE: f64 = 1e-12;

/// Diffusion of the director's angles that is added implicitly and subtracted explicitly, so that only its action on
/// their change within a step remains. It damps short waves, and differences of whole turns between neighbours do not
/// matter. Its geometry is taken at the start of the step; anchored nodes take no part.
#[derive(Debug, Clone)]
pub(super) struct Stabiliser {
    laplacian: Laplacian,
    /// Edges of each triangle.
    sides: Vec<Sides>,
    /// Diffusivity (length squared per time); 0 if there is no stabiliser.
    diffusivity: f64,
}

impl Stabiliser {
    pub(super) fn new(elements: &Elements, anchored: usize) -> Self {
        let (edges, sides) = edges(&elements.triangles);
        let laplacian = Laplacian::new(edges, elements.masses.len(), anchored, TOLERANCE);
        Self { laplacian, sides, diffusivity: 0.0 }
    }

    /// Takes over the geometry and a diffusivity (length squared per time), 0 for none.
    pub(super) fn freeze(&mut self, elements: &Elements, diffusivity: f64) {
        self.diffusivity = diffusivity;
        if diffusivity == 0.0 {
            return;
        }
        let Laplacian { masses, weights, .. } = &mut self.laplacian;
        masses.copy_from_slice(&elements.masses);
        weights.fill(0.0);
        for ((sides, slopes), area) in self.sides.iter().zip(&elements.gradients).zip(&elements.areas) {
            for (corner, &(edge, _)) in sides.iter().enumerate() {
                weights[edge] -= area * slopes[corner].dot(slopes[(corner + 1) % 3]);
            }
        }
    }

    /// Adds `factor` times the diffusion of the angles that are not anchored (1/time) to `out`.
    pub(super) fn add(&mut self, angles: &[f64], factor: f64, out: &mut [f64]) {
        if self.diffusivity == 0.0 {
            return;
        }
        let (image, masses) = self.laplacian.stiffness(angles);
        for ((out, image), mass) in out.iter_mut().zip(image).zip(masses) {
            *out -= factor * self.diffusivity * image / mass;
        }
    }

    /// Replaces angles by the solution y of `y - factor L y = angles`, L being the diffusion.
    pub(super) fn solve(&mut self, factor: f64, angles: &mut [f64]) {
        self.laplacian.solve(factor * self.diffusivity, angles);
    }
}

#[cfg(test)]
mod tests;

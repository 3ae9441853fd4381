//! Rigid motions of droplets: the modes in which a stiff droplet answers with the viscosity of the exterior fluid.

use stokes_layers::dense::NodeCurve;

use crate::Vec2;

/// Rigid motions of one droplet: along x, along y, and a rotation.
pub(super) const RIGID: usize = 3;

/// Rigid motions of droplets on the nodes of all, orthonormal in the product weighted by arc length; x components of
/// all nodes first, then y components.
#[derive(Debug, Clone, Default)]
pub(crate) struct RigidModes {
    /// Motion by motion, with zeros on all but one droplet.
    motions: Vec<f64>,
    /// The same times the weights.
    weighted: Vec<f64>,
}

impl RigidModes {
    /// For these curves.
    pub(crate) fn fill(&mut self, curves: &[NodeCurve]) {
        let nodes: usize = curves.iter().map(NodeCurve::len).sum();
        let len = 2 * nodes * RIGID * curves.len();
        for array in [&mut self.motions, &mut self.weighted] {
            array.clear();
            array.resize(len, 0.0);
        }
        for (index, curve) in curves.iter().enumerate() {
            let perimeter: f64 = curve.perimeter();
            let centre = curve.positions.iter().zip(&curve.weights).map(|(x, w)| x * *w).sum::<Vec2>() / perimeter;
            let moment: f64 =
                curve.positions.iter().zip(&curve.weights).map(|(x, w)| w * (x - centre).length_squared()).sum();
            let scales = [1.0 / perimeter.sqrt(), 1.0 / perimeter.sqrt(), 1.0 / moment.sqrt()];
            for (motion, scale) in scales.into_iter().enumerate() {
                let start = 2 * nodes * (RIGID * index + motion);
                for (i, (x, w)) in (curve.first..).zip(curve.positions.iter().zip(&curve.weights)) {
                    let r = x - centre;
                    let [u, v] = [[1.0, 0.0], [0.0, 1.0], [-r.y, r.x]][motion];
                    for (component, value) in [(0, u), (nodes, v)] {
                        self.motions[start + component + i] = scale * value;
                        self.weighted[start + component + i] = scale * value * w;
                    }
                }
            }
        }
    }

    /// Component of forces at the nodes along a motion: net force or torque, scaled.
    pub(crate) fn component(&self, motion: usize, forces: &[Vec2]) -> f64 {
        let (x, y) = self.motions[2 * forces.len() * motion..].split_at(forces.len());
        forces.iter().zip(x).zip(y).map(|((force, x), y)| force.x * x + force.y * y).sum()
    }

    /// The motions, one after the other.
    pub(crate) fn motions(&self, nodes: usize) -> std::slice::ChunksExact<'_, f64> {
        self.motions.chunks_exact((2 * nodes).max(1))
    }

    /// The motions times the weights, one after the other.
    pub(crate) fn weighted(&self, nodes: usize) -> std::slice::ChunksExact<'_, f64> {
        self.weighted.chunks_exact((2 * nodes).max(1))
    }
}

#[cfg(test)]
mod tests;

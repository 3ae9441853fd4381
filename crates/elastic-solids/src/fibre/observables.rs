//! Measurements of a fibre.

use motile_base::Vec2;
use motile_scene::{BodyError, BodyFlow, FluidView, Observe};

use super::{Fibre, FibreEnd};

/// State of a fibre.
#[derive(Debug, Clone, Copy, PartialEq)]
#[non_exhaustive]
pub struct FibreState {
    /// Mean position of its nodes (length).
    pub centre: Vec2,
    /// Mean velocity of its nodes (length per time), held ones at rest.
    pub velocity: Vec2,
    /// Present length (length).
    pub length: f64,
    /// Largest and smallest length of a segment over its length at rest (no dimension).
    pub stretches: [f64; 2],
    /// Largest and smallest curvature (1/length).
    pub curvatures: [f64; 2],
    /// Energy of stretching (force times length).
    pub stretching_energy: f64,
    /// Energy of bending (force times length).
    pub bending_energy: f64,
    /// Energy of the targets (force times length).
    pub target_energy: f64,
    /// Forces of the fibre on what holds the first and the last node (force); zero for free ends. In a steady state,
    /// their sum is the force of the fluid, the targets and the loads on the fibre.
    pub end_forces: [Vec2; 2],
    /// Torques of the fibre on the clamps of both ends (force times length), counter-clockwise; zero for other ends.
    pub end_torques: [f64; 2],
    /// Sum of the forces of the targets on the fibre (force).
    pub target_force: Vec2,
    /// Power of the fibre's forces on the fluid (force times length per time).
    pub power: f64,
}

impl Observe for Fibre {
    type Observables = FibreState;

    fn observables(&self, _view: &FluidView, flow: &BodyFlow<'_>) -> Result<FibreState, BodyError> {
        let count = self.nodes.len() as f64;
        let range = |values: &mut dyn Iterator<Item = f64>| {
            values.fold([f64::NEG_INFINITY, f64::INFINITY], |[most, least], value| [most.max(value), least.min(value)])
        };
        let [stretching_energy, bending_energy, target_energy] = self.energies();
        let forces = self.node_forces();
        let last = self.nodes.len() - 1;
        let held = |end: usize, node: usize| {
            if self.ends()[end] == FibreEnd::Free { Vec2::ZERO } else { forces[node] }
        };
        let pulls = self
            .targets()
            .iter()
            .map(|target| target.stiffness * (target.at(self.along[target.node], self.time) - self.nodes[target.node]));
        Ok(FibreState {
            centre: self.nodes.iter().sum::<Vec2>() / count,
            velocity: flow.velocities.iter().sum::<Vec2>() / count,
            length: self.length(),
            stretches: range(&mut self.elasticity.stretches(&self.nodes)),
            curvatures: range(&mut self.elasticity.measured_curvatures(&self.nodes).map(|(_, curvature)| curvature)),
            stretching_energy,
            bending_energy,
            target_energy,
            end_forces: [held(0, 0), held(1, last)],
            end_torques: [0, 1].map(|end| self.elasticity.clamp_torque(&self.nodes, end, |node| self.beat(node))),
            target_force: pulls.sum(),
            power: flow.forces.iter().zip(flow.velocities).map(|(force, velocity)| force.dot(*velocity)).sum(),
        })
    }
}

//! What all curves of one number of nodes share.

use input_checks::InputError;

use crate::{close::CloseWeights, curve::Transforms};

use super::sums::kress_weights;

/// Transforms, weights and room to work in for curves of some number of nodes.
#[derive(Debug, Clone)]
pub(crate) struct Plan {
    pub(crate) nodes: usize,
    pub(crate) transforms: Transforms,
    pub(crate) weights: CloseWeights,
    /// The weights of Kress by shift.
    pub(crate) kress: Vec<f64>,
}

impl Plan {
    fn new(nodes: usize) -> Result<Self, InputError> {
        let (transforms, weights) = (Transforms::new(nodes)?, CloseWeights::new(nodes));
        Ok(Self { nodes, transforms, weights, kress: kress_weights(nodes) })
    }

    /// The number of the plan for so many nodes, made at the first use of a number.
    pub(crate) fn find(plans: &mut Vec<Self>, nodes: usize) -> Result<usize, InputError> {
        if let Some(known) = plans.iter().position(|plan| plan.nodes == nodes) {
            return Ok(known);
        }
        plans.push(Self::new(nodes)?);
        Ok(plans.len() - 1)
    }
}

/// Which curves have their single layer kept as a matrix, for forces that come later.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct Kept {
    /// They are those from this one on.
    pub(crate) first: usize,
    /// Whether layers between two of them are wanted.
    pub(crate) among: bool,
}

impl Kept {
    pub(crate) fn is_kept(self, curve: usize) -> bool {
        curve >= self.first
    }

    /// Whether layers between two curves are wanted.
    pub(crate) fn pair(self, target: usize, source: usize) -> bool {
        self.among || target < self.first || source < self.first
    }
}

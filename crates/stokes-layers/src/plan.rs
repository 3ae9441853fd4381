//! Transforms and quadrature weights shared by all curves of one number of nodes.

use std::f64::consts::{PI, TAU};

use motile_base::InputError;
use num_complex::Complex64;

use crate::{close_weights::CloseWeights, transforms::Transforms};

/// Transforms, weights and working memory for curves of some number of nodes.
#[derive(Debug, Clone)]
pub(crate) struct Plan {
    nodes: usize,
    pub(crate) transforms: Transforms,
    pub(crate) weights: CloseWeights,
    /// Weights of Kress by shift.
    pub(crate) kress: Vec<f64>,
    /// Factors of Fourier coefficients in the cyclic product with them.
    pub(crate) kress_modes: Vec<f64>,
}

impl Plan {
    /// Number of the plan for so many nodes, which is made at their first use.
    pub(crate) fn find(plans: &mut Vec<Self>, nodes: usize) -> Result<usize, InputError> {
        if let Some(known) = plans.iter().position(|plan| plan.nodes == nodes) {
            return Ok(known);
        }
        let (mut transforms, weights, kress) =
            (Transforms::new(nodes)?, CloseWeights::new(nodes), kress_weights(nodes));
        let mut modes: Vec<_> = kress.iter().map(|weight| Complex64::new(*weight, 0.0)).collect();
        transforms.nodes.forward(&mut modes);
        let kress_modes = modes.iter().map(|mode| mode.re * nodes as f64).collect();
        plans.push(Self { nodes, transforms, weights, kress, kress_modes });
        Ok(plans.len() - 1)
    }
}

/// Weights of the quadrature of Kress (Linear Integral Equations, 2014, section 12.3) by shift:
/// `1/2 ln(4 sin^2(pi d/n)) + K_d n/(2 pi)` with `K_d = (1/n) sum over m != 0 of (pi/|m|) exp(2 pi i m d/n)`; at d = 0
/// the second term alone.
fn kress_weights(nodes: usize) -> Vec<f64> {
    let n = nodes as f64;
    let weight = |d: usize| {
        let angle = TAU * d as f64 / n;
        // One entry for each sign of m, and one for the unpaired wave of an even number of nodes.
        let mut sum: f64 = (1..nodes.div_ceil(2)).map(|m| 2.0 * (angle * m as f64).cos() / m as f64).sum();
        if nodes.is_multiple_of(2) {
            sum += 2.0 * if d.is_multiple_of(2) { 1.0 } else { -1.0 } / n;
        }
        let smooth = 0.5 * sum;
        if d == 0 { smooth } else { (2.0 * (PI * d as f64 / n).sin()).ln() + smooth }
    };
    (0..nodes).map(weight).collect()
}

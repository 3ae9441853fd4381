//! Transforms and quadrature weights shared by all curves of one number of nodes.

use std::{
    f64::consts::{PI, TAU},
    ops::{Deref, DerefMut},
};

use motile_base::InputError;
use num_complex::Complex64;

use crate::{close_weights::CloseWeights, curve::Curve, transforms::Transforms};

/// Plans for all numbers of nodes that there are, with copies for pieces of the curves that other threads take.
#[derive(Debug, Clone, Default)]
pub(crate) struct Plans {
    own: Vec<Plan>,
    copies: Vec<Vec<Plan>>,
}

impl Plans {
    /// Returns the number of the plan for so many nodes, which is made at their first use.
    pub(crate) fn find(&mut self, nodes: usize) -> Result<usize, InputError> {
        Plan::find(&mut self.own, nodes)
    }

    /// Makes the copies for so many pieces.
    pub(crate) fn divide(&mut self, pieces: usize) {
        let Self { own, copies } = self;
        if copies.len() + 1 < pieces {
            copies.resize_with(pieces - 1, Vec::new);
        }
        for copy in copies {
            copy.extend_from_slice(&own[copy.len()..]);
        }
    }

    /// Returns the plans of each piece.
    pub(crate) fn pieces(&mut self) -> impl Iterator<Item = &mut [Plan]> {
        std::iter::once(&mut self.own).chain(&mut self.copies).map(Vec::as_mut_slice)
    }
}

impl Deref for Plans {
    type Target = [Plan];

    fn deref(&self) -> &[Plan] {
        &self.own
    }
}

impl DerefMut for Plans {
    fn deref_mut(&mut self) -> &mut [Plan] {
        &mut self.own
    }
}

/// Transforms, weights and working memory for curves of some number of nodes.
#[derive(Debug, Clone)]
pub(crate) struct Plan {
    nodes: usize,
    pub(crate) transforms: Transforms,
    pub(crate) weights: CloseWeights,
    /// Weights of Kress by shift.
    pub(crate) kress: Vec<f64>,
    /// Factors of Fourier coefficients in the cyclic product with them.
    kress_modes: Vec<f64>,
    /// Working memory of the cyclic product.
    product: Vec<Complex64>,
}

impl Plan {
    /// Returns the number of the plan for so many nodes, which is made at their first use.
    pub(crate) fn find(plans: &mut Vec<Self>, nodes: usize) -> Result<usize, InputError> {
        if let Some(known) = plans.iter().position(|plan| plan.nodes == nodes) {
            return Ok(known);
        }
        let (mut transforms, weights, kress) =
            (Transforms::new(nodes)?, CloseWeights::new(nodes), kress_weights(nodes));
        let mut modes: Vec<_> = kress.iter().map(|weight| Complex64::new(*weight, 0.0)).collect();
        transforms.nodes.forward(&mut modes);
        let kress_modes = modes.iter().map(|mode| mode.re * nodes as f64).collect();
        plans.push(Self { nodes, transforms, weights, kress, kress_modes, product: Vec::new() });
        Ok(plans.len() - 1)
    }

    /// Returns the flow at the nodes of the forces on a curve by the weights of Kress alone.
    pub(crate) fn kress_flow(&mut self, curve: &Curve) -> &[Complex64] {
        let Self { transforms, kress_modes, product, .. } = self;
        let weight = curve.weight();
        product.clear();
        product.extend(curve.force.iter().zip(&*kress_modes).map(|(force, kress)| force * (weight * kress)));
        transforms.nodes.inverse(product);
        product
    }
}

/// Returns the weights of the quadrature of Kress (Linear Integral Equations, 2014, section 12.3) by shift: `1/2 ln(4
/// sin^2(pi d/n)) + K_d n/(2 pi)` with `K_d = (1/n) sum over m != 0 of (pi/|m|) exp(2 pi i m d/n)`; at d = 0 the second
/// term alone.
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

//! Projection of fluxes between cells onto fluxes of a given divergence.

use motile_base::Vec2;

use super::cells::Cells;
use crate::{InteriorError, factor::Factor};

/// Correction of fluxes between cells by the differences of a potential, so that a given amount leaves each cell.
///
/// The potential solves the Poisson equation of linear elements on the cells at the start. Any other positive matrix
/// would do, as the correction is of the order of the error of the fluxes.
#[derive(Debug, Clone)]
pub(super) struct Projection {
    weights: Vec<f64>,
    factor: Factor,
    /// Potential at the nodes; it is zero at the first one.
    potential: Vec<f64>,
}

impl Projection {
    pub(super) fn new(cells: &Cells, nodes: &[Vec2]) -> Result<Self, InteriorError> {
        let mut factor = Factor::new(&cells.edges, nodes, 1)?;
        let potential = vec![0.0; nodes.len()];
        factor.set(&potential, 1.0, &cells.weights);
        Ok(Self { weights: cells.weights.clone(), factor, potential })
    }

    /// Adds to the fluxes the amounts `missing` by which too little leaves each cell (length squared per time), of sum
    /// zero.
    pub(super) fn correct(&mut self, edges: &[[usize; 2]], missing: &[f64], fluxes: &mut [f64]) {
        let Self { weights, factor, potential } = self;
        factor.solve(&missing[1..], &mut potential[1..]);
        for ((&[i, j], weight), flux) in edges.iter().zip(&*weights).zip(fluxes) {
            *flux += weight * (potential[i] - potential[j]);
        }
    }
}

//! Projection of fluxes between cells onto those of a given divergence.

use motile_base::{Vec2, dot};

use super::cells::Cells;
use crate::InteriorError;

/// Largest number of entries of the factor: 512 MB.
const MOST_ENTRIES: usize = 1 << 26;

/// Correction of fluxes between cells by the differences of a potential, so that a given amount leaves each cell.
///
/// The potential solves the Poisson equation of linear elements on the cells at the start, by a Cholesky factor of its
/// matrix stored from the first entry of each row (skyline). Any other positive matrix would do, as the correction is
/// of the order of the error of the fluxes.
#[derive(Debug, Clone)]
pub(super) struct Projection {
    weights: Vec<f64>,
    /// Row of each node.
    places: Vec<usize>,
    /// Column of the first entry of each row and start of the row in the factor; the potential of the last node is 0.
    rows: Vec<(usize, usize)>,
    factor: Vec<f64>,
    potential: Vec<f64>,
}

impl Projection {
    pub(super) fn new(cells: &Cells, nodes: &[Vec2]) -> Result<Self, InteriorError> {
        let count = cells.areas.len();
        // In the order of a sweep across the droplet neighbours have numbers that differ little.
        let mut order: Vec<usize> = (0..count).collect();
        order.sort_by(|&i, &j| nodes[i].x.total_cmp(&nodes[j].x));
        let mut places = vec![0; count];
        order.iter().enumerate().for_each(|(place, &node)| places[node] = place);
        let pairs = || cells.edges.iter().map(|edge| edge.map(|node| places[node])).map(|[i, j]| [i.min(j), i.max(j)]);
        let mut firsts: Vec<usize> = (0..count).collect();
        pairs().for_each(|[i, j]| firsts[j] = firsts[j].min(i));
        let entries: usize = firsts.iter().enumerate().map(|(row, first)| row + 1 - first).sum();
        if entries > MOST_ENTRIES {
            return Err(InteriorError::TooFine { nodes: count as f64, most: count / 2 });
        }
        let mut start = 0;
        let rows: Vec<_> = firsts[..count - 1]
            .iter()
            .enumerate()
            .map(|(row, &first)| {
                start += row + 1 - first;
                (first, start - (row + 1 - first))
            })
            .collect();
        let mut factor = vec![0.0; start];
        for ([i, j], weight) in pairs().zip(&cells.weights) {
            for node in [i, j] {
                if let Some((first, start)) = rows.get(node) {
                    factor[start + node - first] += weight;
                }
            }
            if let Some((first, start)) = rows.get(j) {
                factor[start + i - first] -= weight;
            }
        }
        for row in 0..rows.len() {
            let (first, start) = rows[row];
            for column in first..=row {
                let (other, other_start) = rows[column];
                let from = first.max(other);
                let before = &factor[start + from - first..start + column - first];
                let above = &factor[other_start + from - other..other_start + column - other];
                let entry = factor[start + column - first] - dot(before, above);
                factor[start + column - first] =
                    if column == row { entry.sqrt() } else { entry / factor[other_start + column - other] };
            }
        }
        Ok(Self { weights: cells.weights.clone(), places, rows, factor, potential: vec![0.0; count] })
    }

    /// Adds to the fluxes the amounts `missing` by which too little leaves each cell (length squared per time), of sum
    /// zero.
    pub(super) fn correct(&mut self, edges: &[[usize; 2]], missing: &[f64], fluxes: &mut [f64]) {
        let Self { weights, places, rows, factor, potential } = self;
        places.iter().zip(missing).for_each(|(&place, missing)| potential[place] = *missing);
        for (row, &(first, start)) in rows.iter().enumerate() {
            let (entries, diagonal) = (&factor[start..start + row - first], factor[start + row - first]);
            potential[row] = (potential[row] - dot(entries, &potential[first..row])) / diagonal;
        }
        for (row, &(first, start)) in rows.iter().enumerate().rev() {
            let value = potential[row] / factor[start + row - first];
            potential[row] = value;
            let entries = &factor[start..start + row - first];
            potential[first..row].iter_mut().zip(entries).for_each(|(x, entry)| *x -= entry * value);
        }
        potential[rows.len()] = 0.0;
        for ((&[i, j], weight), flux) in edges.iter().zip(&*weights).zip(fluxes) {
            *flux += weight * (potential[places[i]] - potential[places[j]]);
        }
    }
}

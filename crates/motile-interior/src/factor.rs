//! Triangular factor of a sparse matrix on a triangulation.

use motile_base::{
    Vec2,
    internal::{dot, widely},
};

use crate::InteriorError;

/// Largest number of entries of a factor: 512 MB.
const MOST_ENTRIES: usize = 1 << 26;

/// Cholesky factor of a matrix that couples nodes along the edges of a triangulation, stored from the first entry of
/// each row (skyline), with the inverse of the diagonal in its place. Rows are in the order of a sweep across the
/// droplet, in which neighbours have numbers that differ little.
#[derive(Debug, Clone)]
pub(crate) struct Factor {
    edges: Vec<[usize; 2]>,
    /// Number of nodes, the first ones, that are left out.
    held: usize,
    /// Row of each of the other nodes.
    places: Vec<usize>,
    /// Column of the first entry of each row, and start of the row in the entries.
    rows: Vec<(usize, usize)>,
    entries: Vec<f64>,
    values: Vec<f64>,
}

impl Factor {
    /// Returns the place for a factor on edges between nodes at positions (length), of which the first `held` are left
    /// out.
    ///
    /// # Errors
    /// Returns an error for more entries than fit in memory.
    pub(crate) fn new(edges: &[[usize; 2]], nodes: &[Vec2], held: usize) -> Result<Self, InteriorError> {
        let count = nodes.len() - held;
        let mut order: Vec<usize> = (0..count).collect();
        order.sort_by(|&i, &j| nodes[held + i].x.total_cmp(&nodes[held + j].x));
        let mut places = vec![0; count];
        order.iter().enumerate().for_each(|(place, &node)| places[node] = place);
        let mut firsts: Vec<usize> = (0..count).collect();
        for &[i, j] in edges.iter().filter(|edge| edge.iter().all(|&node| node >= held)) {
            let (i, j) = (places[i - held], places[j - held]);
            firsts[i.max(j)] = firsts[i.max(j)].min(i.min(j));
        }
        let mut start = 0;
        let mut rows = Vec::with_capacity(count);
        for (row, first) in firsts.into_iter().enumerate() {
            rows.push((first, start));
            start += row + 1 - first;
        }
        if start > MOST_ENTRIES {
            return Err(InteriorError::too_fine(nodes.len() as f64, nodes.len() / 2));
        }
        Ok(Self { edges: edges.to_vec(), held, places, rows, entries: vec![0.0; start], values: vec![0.0; count] })
    }

    /// Factorises the matrix with `strength w_e` off the diagonal, negative, for each edge e, and on it the sum of
    /// these and `diagonal`, one for each node.
    pub(crate) fn set(&mut self, diagonal: &[f64], strength: f64, weights: &[f64]) {
        let Self { edges, held, places, rows, entries, .. } = self;
        entries.fill(0.0);
        for (&place, diagonal) in places.iter().zip(&diagonal[*held..]) {
            let (first, start) = rows[place];
            entries[start + place - first] = *diagonal;
        }
        for (edge, weight) in edges.iter().zip(weights) {
            let [i, j] = edge.map(|node| node.checked_sub(*held).map(|node| places[node]));
            for row in [i, j].into_iter().flatten() {
                let (first, start) = rows[row];
                entries[start + row - first] += strength * weight;
            }
            if let (Some(i), Some(j)) = (i, j) {
                let (first, start) = rows[i.max(j)];
                entries[start + i.min(j) - first] -= strength * weight;
            }
        }
        widely(
            #[inline(always)]
            || {
                for row in 0..rows.len() {
                    let (first, start) = rows[row];
                    for column in first..=row {
                        let (other, other_start) = rows[column];
                        let from = first.max(other);
                        let before = &entries[start + from - first..start + column - first];
                        let above = &entries[other_start + from - other..other_start + column - other];
                        let entry = entries[start + column - first] - dot(before, above);
                        entries[start + column - first] = if column == row {
                            entry.sqrt().recip()
                        } else {
                            entry * entries[other_start + column - other]
                        };
                    }
                }
            },
        );
    }

    /// Writes the solution of the linear equations for a right-hand side, both without the nodes left out.
    pub(crate) fn solve(&mut self, right: &[f64], out: &mut [f64]) {
        let Self { places, rows, entries, values, .. } = self;
        places.iter().zip(right).for_each(|(&place, right)| values[place] = *right);
        widely(
            #[inline(always)]
            || {
                for (row, &(first, start)) in rows.iter().enumerate() {
                    let (before, inverse) = (&entries[start..start + row - first], entries[start + row - first]);
                    values[row] = (values[row] - dot(before, &values[first..row])) * inverse;
                }
                for (row, &(first, start)) in rows.iter().enumerate().rev() {
                    let value = values[row] * entries[start + row - first];
                    values[row] = value;
                    let before = &entries[start..start + row - first];
                    values[first..row].iter_mut().zip(before).for_each(|(x, entry)| *x -= entry * value);
                }
            },
        );
        out.iter_mut().zip(&*places).for_each(|(out, &place)| *out = values[place]);
    }
}

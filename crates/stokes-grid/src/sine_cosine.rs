//! Sine and cosine transforms across a channel.

use std::fmt;
use std::sync::Arc;

use num_complex::Complex64;
use rustdct::{DctPlanner, Dst1, TransformType2And3};

/// Transforms of complex columns of a channel of N cells, for values in the middle of cells (x velocity, pressure) or
/// on the N - 1 inner rows of nodes (y velocity):
///
/// * sines in cells, zero on the walls: `f[j] = sum over n = 1..=N of F[n] sin(pi n (j + 1/2) / N)`;
/// * cosines in cells, no slope at the walls: `f[j] = sum over n = 0..N of F[n] cos(pi n (j + 1/2) / N)`;
/// * sines on nodes, zero on the walls: `f[j] = sum over n = 1..N of F[n] sin(pi n j / N)`.
///
/// Analysis goes from f to F, synthesis from F to f; one undoes the other. (DST-II and III, DCT-II and III, DST-I,
/// normalised.)
pub(crate) struct SineCosine {
    cells: Arc<dyn TransformType2And3<f64>>,
    nodes: Arc<dyn Dst1<f64>>,
    part: Vec<f64>,
    scratch: Vec<f64>,
}

impl fmt::Debug for SineCosine {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("SineCosine").field("n", &self.part.len()).finish_non_exhaustive()
    }
}

impl SineCosine {
    pub(crate) fn new(n: usize) -> Self {
        let mut planner = DctPlanner::new();
        // One plan of this length does all four transforms of types two and three.
        let (cells, nodes) = (planner.plan_dct2(n), planner.plan_dst1(n - 1));
        let scratch = cells.get_scratch_len().max(nodes.get_scratch_len());
        Self { cells, nodes, part: vec![0.0; n], scratch: vec![0.0; scratch] }
    }

    /// N / 2, by which analysis and synthesis differ from the bare sums.
    fn norm(&self) -> f64 {
        0.5 * self.part.len() as f64
    }

    /// Entry n - 1 of the result is F[n].
    pub(crate) fn analyse_sines(&mut self, column: &mut [Complex64]) {
        let plan = self.cells.clone();
        let scale = 1.0 / self.norm();
        self.each_part(column, |part, scratch| {
            plan.process_dst2_with_scratch(part, scratch);
            for value in part.iter_mut() {
                *value *= scale;
            }
            // The highest sine alternates in sign between cells: its norm is N, not N / 2.
            if let Some(last) = part.last_mut() {
                *last *= 0.5;
            }
        });
    }

    pub(crate) fn synthesise_sines(&mut self, column: &mut [Complex64]) {
        let plan = self.cells.clone();
        self.each_part(column, |part, scratch| {
            if let Some(last) = part.last_mut() {
                *last *= 2.0;
            }
            plan.process_dst3_with_scratch(part, scratch);
        });
    }

    pub(crate) fn analyse_cosines(&mut self, column: &mut [Complex64]) {
        let plan = self.cells.clone();
        let scale = 1.0 / self.norm();
        self.each_part(column, |part, scratch| {
            plan.process_dct2_with_scratch(part, scratch);
            for value in part.iter_mut() {
                *value *= scale;
            }
            part[0] *= 0.5;
        });
    }

    pub(crate) fn synthesise_cosines(&mut self, column: &mut [Complex64]) {
        let plan = self.cells.clone();
        self.each_part(column, |part, scratch| {
            part[0] *= 2.0;
            plan.process_dct3_with_scratch(part, scratch);
        });
    }

    /// Entry n - 1 of the result is F[n]; entry j - 1 of `column` is row j.
    pub(crate) fn analyse_node_sines(&mut self, column: &mut [Complex64]) {
        let scale = 1.0 / self.norm();
        self.synthesise_node_sines(column);
        for value in column {
            *value *= scale;
        }
    }

    pub(crate) fn synthesise_node_sines(&mut self, column: &mut [Complex64]) {
        let plan = self.nodes.clone();
        self.each_part(column, |part, scratch| {
            // The plan takes two values of its scratch for zero without setting them.
            scratch.fill(0.0);
            plan.process_dst1_with_scratch(part, scratch);
        });
    }

    /// Does `work` to the real and to the imaginary part of a column.
    fn each_part(&mut self, column: &mut [Complex64], work: impl Fn(&mut [f64], &mut [f64])) {
        let part = &mut self.part[..column.len()];
        for (part, value) in part.iter_mut().zip(column.iter()) {
            *part = value.re;
        }
        work(part, &mut self.scratch);
        for (value, part) in column.iter_mut().zip(part.iter_mut()) {
            value.re = *part;
            *part = value.im;
        }
        work(part, &mut self.scratch);
        for (value, part) in column.iter_mut().zip(part.iter()) {
            value.im = *part;
        }
    }
}

#[cfg(test)]
mod tests;

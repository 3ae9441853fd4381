//! Sine and cosine transforms across an interval.

use std::f64::consts::PI;

use input_checks::{InputError, same_length};
use num_complex::Complex64;

use crate::ComplexTransform;

/// A plan for sine and cosine transforms across an interval of N cells, of complex values in the middle of cells or on
/// the N - 1 inner nodes:
///
/// * sines in cells, zero at the ends: `f[j] = sum over n = 1..=N of F[n] sin(pi n (j + 1/2) / N)`;
/// * cosines in cells, no slope at the ends: `f[j] = sum over n = 0..N of F[n] cos(pi n (j + 1/2) / N)`;
/// * sines on nodes, zero at the ends: `f[j] = sum over n = 1..N of F[n] sin(pi n j / N)`.
///
/// Analysis goes from f to F, synthesis from F to f; one undoes the other. (DST-II and III, DCT-II and III, DST-I,
/// normalised.) All are in place and take real and imaginary part through one complex transform: of N numbers for
/// cells (J. Makhoul, A fast cosine transform in one and two dimensions, IEEE Trans. ASSP 28, 1980), of 2 N for nodes.
#[derive(Debug, Clone)]
pub struct SineCosine {
    cells: ComplexTransform,
    nodes: ComplexTransform,
    /// `exp(-pi I n / (2 N))`.
    turns: Vec<Complex64>,
    work: Vec<Complex64>,
}

impl SineCosine {
    /// A plan for `cells` cells.
    #[must_use]
    pub fn new(cells: usize) -> Self {
        Self {
            cells: ComplexTransform::new(cells),
            nodes: ComplexTransform::new(2 * cells),
            turns: (0..cells).map(|n| Complex64::cis(-0.5 * PI * n as f64 / cells as f64)).collect(),
            work: vec![Complex64::ZERO; 2 * cells],
        }
    }

    /// N, the number of cells.
    #[must_use]
    pub fn cells(&self) -> usize {
        self.turns.len()
    }

    /// Sines in cells; entry n - 1 of the result is `F[n]`.
    ///
    /// # Errors
    /// Another number of values than N.
    pub fn analyse_sines(&mut self, values: &mut [Complex64]) -> Result<(), InputError> {
        // sin(pi (N - n) (j + 1/2) / N) = (-1)^j cos(pi n (j + 1/2) / N)
        alternate(values);
        self.analyse_cosines(values)?;
        values.reverse();
        Ok(())
    }

    /// Values of sines in cells; entry n - 1 of `values` is `F[n]`.
    ///
    /// # Errors
    /// Another number of values than N.
    pub fn synthesise_sines(&mut self, values: &mut [Complex64]) -> Result<(), InputError> {
        values.reverse();
        self.synthesise_cosines(values)?;
        alternate(values);
        Ok(())
    }

    /// Cosines in cells.
    ///
    /// # Errors
    /// Another number of values than N.
    pub fn analyse_cosines(&mut self, values: &mut [Complex64]) -> Result<(), InputError> {
        let cells = self.cells();
        same_length("the values in cells", cells, values.len())?;
        let work = &mut self.work[..cells];
        for (j, value) in values.iter().enumerate() {
            work[place(j, cells)] = *value;
        }
        self.cells.forward(work)?;
        let scale = 1.0 / cells as f64;
        for (n, (value, turn)) in values.iter_mut().zip(&self.turns).enumerate() {
            let mirrored = work[if n == 0 { 0 } else { cells - n }];
            *value = (turn * work[n] + turn.conj() * mirrored) * scale;
        }
        if let Some(mean) = values.first_mut() {
            *mean *= 0.5;
        }
        Ok(())
    }

    /// Values of cosines in cells.
    ///
    /// # Errors
    /// Another number of values than N.
    pub fn synthesise_cosines(&mut self, values: &mut [Complex64]) -> Result<(), InputError> {
        let cells = self.cells();
        same_length("the values in cells", cells, values.len())?;
        let work = &mut self.work[..cells];
        for (n, (out, turn)) in work.iter_mut().zip(&self.turns).enumerate() {
            *out = if n == 0 {
                values[0]
            } else {
                let mirrored = values[cells - n];
                0.5 * turn.conj() * (values[n] - Complex64::new(-mirrored.im, mirrored.re))
            };
        }
        self.cells.inverse(work)?;
        for (j, value) in values.iter_mut().enumerate() {
            *value = work[place(j, cells)];
        }
        Ok(())
    }

    /// Sines on nodes; entry j - 1 of `values` is node j, entry n - 1 of the result `F[n]`.
    ///
    /// # Errors
    /// Another number of values than N - 1.
    pub fn analyse_node_sines(&mut self, values: &mut [Complex64]) -> Result<(), InputError> {
        self.node_sines(values, 2.0 / self.cells() as f64)
    }

    /// Values of sines on nodes; entry n - 1 of `values` is `F[n]`, entry j - 1 of the result node j.
    ///
    /// # Errors
    /// Another number of values than N - 1.
    pub fn synthesise_node_sines(&mut self, values: &mut [Complex64]) -> Result<(), InputError> {
        self.node_sines(values, 1.0)
    }

    /// `scale` times the sums over the sines, from the transform of the odd continuation to 2 N numbers.
    fn node_sines(&mut self, values: &mut [Complex64], scale: f64) -> Result<(), InputError> {
        let cells = self.cells();
        same_length("the values on nodes", cells.saturating_sub(1), values.len())?;
        self.work.fill(Complex64::ZERO);
        for (j, value) in values.iter().enumerate() {
            self.work[j + 1] = *value;
            self.work[2 * cells - 1 - j] = -value;
        }
        self.nodes.forward(&mut self.work)?;
        let factor = Complex64::new(0.0, 0.5 * scale);
        for (value, sum) in values.iter_mut().zip(self.work.iter().skip(1)) {
            *value = factor * sum;
        }
        Ok(())
    }
}

/// Where Makhoul's order has cell j: even ones upwards from the start, odd ones downwards from the end.
fn place(j: usize, cells: usize) -> usize {
    if j.is_multiple_of(2) { j / 2 } else { cells - 1 - j / 2 }
}

/// Changes the sign of every other value.
fn alternate(values: &mut [Complex64]) {
    for value in values.iter_mut().skip(1).step_by(2) {
        *value = -*value;
    }
}

#[cfg(test)]
mod tests;

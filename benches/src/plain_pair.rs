//! Transforms done plainly.

use std::hint::black_box;

use motile_base::{ComplexTransform, RealTransform};
use num_complex::Complex64;

/// A forward and an inverse real transform as anyone would write them: rows, a transposition, columns.
#[derive(Debug)]
pub struct PlainPair {
    nx: usize,
    ny: usize,
    along_x: RealTransform,
    along_y: ComplexTransform,
    space: Vec<f64>,
    rows: Vec<Complex64>,
    columns: Vec<Complex64>,
}

impl PlainPair {
    /// A pair for `nx` x `ny` real values, both at least one.
    ///
    /// # Panics
    /// Lengths beyond those of any grid.
    #[must_use]
    pub fn new(nx: usize, ny: usize) -> Self {
        let along_x = RealTransform::new(nx).expect("a length of a grid");
        let spectrum = vec![Complex64::ZERO; along_x.spectrum_len() * ny];
        Self {
            nx,
            ny,
            along_x,
            along_y: ComplexTransform::new(ny).expect("a length of a grid"),
            space: (0..nx * ny).map(|i| ((i * i) as f64).sin()).collect(),
            rows: spectrum.clone(),
            columns: spectrum,
        }
    }

    /// Both passes over the rows only.
    ///
    /// # Panics
    /// Never: the lengths are right.
    pub fn rows(&mut self) {
        self.forward_rows();
        self.inverse_rows();
        black_box(&self.space);
    }

    /// The whole pair.
    ///
    /// # Panics
    /// Never: the lengths are right.
    pub fn run(&mut self) {
        let width = self.along_x.spectrum_len();
        self.forward_rows();
        transpose(&self.rows, width, self.ny, &mut self.columns);
        self.along_y.forward(&mut self.columns).expect("right lengths");
        transpose(&self.columns, self.ny, width, &mut self.rows);
        black_box(&mut self.rows);
        transpose(&self.rows, width, self.ny, &mut self.columns);
        self.along_y.inverse(&mut self.columns).expect("right lengths");
        transpose(&self.columns, self.ny, width, &mut self.rows);
        self.inverse_rows();
        black_box(&self.space);
    }

    fn forward_rows(&mut self) {
        let scale = 1.0 / (self.nx * self.ny) as f64;
        self.space.iter_mut().for_each(|x| *x *= scale);
        let width = self.along_x.spectrum_len();
        for (input, output) in self.space.chunks_mut(self.nx).zip(self.rows.chunks_mut(width)) {
            self.along_x.forward(input, output).expect("right lengths");
        }
    }

    fn inverse_rows(&mut self) {
        let width = self.along_x.spectrum_len();
        for (input, output) in self.rows.chunks_mut(width).zip(self.space.chunks_mut(self.nx)) {
            self.along_x.inverse(input, output).expect("right lengths");
        }
    }
}

/// The transpose of rows of length `width`, in blocks.
fn transpose(from: &[Complex64], width: usize, height: usize, to: &mut [Complex64]) {
    const BLOCK: usize = 16;
    for j0 in (0..height).step_by(BLOCK) {
        for i0 in (0..width).step_by(BLOCK) {
            for i in i0..(i0 + BLOCK).min(width) {
                for j in j0..(j0 + BLOCK).min(height) {
                    to[i * height + j] = from[j * width + i];
                }
            }
        }
    }
}

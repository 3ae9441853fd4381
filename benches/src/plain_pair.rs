//! Transforms done plainly.

use std::hint::black_box;
use std::sync::Arc;

use num_complex::Complex64;
use realfft::{ComplexToReal, RealFftPlanner, RealToComplex};
use rustfft::{Fft, FftPlanner};

/// A real transform there and back as anyone would write it: realfft for the rows, a transposition, rustfft for the
/// columns.
pub struct PlainPair {
    nx: usize,
    ny: usize,
    r2c: Arc<dyn RealToComplex<f64>>,
    c2r: Arc<dyn ComplexToReal<f64>>,
    forward: Arc<dyn Fft<f64>>,
    inverse: Arc<dyn Fft<f64>>,
    space: Vec<f64>,
    rows: Vec<Complex64>,
    columns: Vec<Complex64>,
    scratch: Vec<Complex64>,
}

impl std::fmt::Debug for PlainPair {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("PlainPair").field("nx", &self.nx).field("ny", &self.ny).finish_non_exhaustive()
    }
}

impl PlainPair {
    /// A pair for `nx` x `ny` real values, both at least one.
    #[must_use]
    pub fn new(nx: usize, ny: usize) -> Self {
        let (mut real, mut complex) = (RealFftPlanner::new(), FftPlanner::new());
        let (r2c, c2r) = (real.plan_fft_forward(nx), real.plan_fft_inverse(nx));
        let (forward, inverse) = (complex.plan_fft_forward(ny), complex.plan_fft_inverse(ny));
        let width = nx / 2 + 1;
        let lengths = [
            r2c.get_scratch_len(),
            c2r.get_scratch_len(),
            forward.get_inplace_scratch_len(),
            inverse.get_inplace_scratch_len(),
        ];
        let space = (0..nx * ny).map(|i| ((i * i) as f64).sin()).collect();
        Self {
            nx,
            ny,
            r2c,
            c2r,
            forward,
            inverse,
            space,
            rows: vec![Complex64::ZERO; width * ny],
            columns: vec![Complex64::ZERO; width * ny],
            scratch: vec![Complex64::ZERO; lengths.into_iter().max().unwrap_or(0)],
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
        let width = self.nx / 2 + 1;
        self.forward_rows();
        transpose(&self.rows, width, self.ny, &mut self.columns);
        let length = self.forward.get_inplace_scratch_len();
        self.forward.process_with_scratch(&mut self.columns, &mut self.scratch[..length]);
        transpose(&self.columns, self.ny, width, &mut self.rows);
        black_box(&mut self.rows);
        transpose(&self.rows, width, self.ny, &mut self.columns);
        let length = self.inverse.get_inplace_scratch_len();
        self.inverse.process_with_scratch(&mut self.columns, &mut self.scratch[..length]);
        transpose(&self.columns, self.ny, width, &mut self.rows);
        self.inverse_rows();
        black_box(&self.space);
    }

    fn forward_rows(&mut self) {
        let scratch = &mut self.scratch[..self.r2c.get_scratch_len()];
        let scale = 1.0 / (self.nx * self.ny) as f64;
        self.space.iter_mut().for_each(|x| *x *= scale);
        for (input, output) in self.space.chunks_mut(self.nx).zip(self.rows.chunks_mut(self.nx / 2 + 1)) {
            self.r2c.process_with_scratch(input, output, scratch).expect("right lengths");
        }
    }

    fn inverse_rows(&mut self) {
        let scratch = &mut self.scratch[..self.c2r.get_scratch_len()];
        for (input, output) in self.rows.chunks_mut(self.nx / 2 + 1).zip(self.space.chunks_mut(self.nx)) {
            input[0].im = 0.0;
            if self.nx.is_multiple_of(2) {
                input[self.nx / 2].im = 0.0;
            }
            self.c2r.process_with_scratch(input, output, scratch).expect("right lengths");
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

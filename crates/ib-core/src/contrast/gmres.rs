//! Generalised minimal residuals for dense well-conditioned systems.

/// Basis vectors before a restart.
const BASIS: usize = 60;

/// What an iteration did.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Outcome {
    /// Products with the matrix but the one that gives the residual of the guess.
    pub(crate) iterations: usize,
    /// Norm of the residual over that of the right-hand side.
    pub(crate) residual: f64,
}

/// GMRES with its memory: nothing is allocated once a size has been used.
#[derive(Debug, Default)]
pub(crate) struct Gmres {
    /// Orthonormal vectors, one after the other.
    basis: Vec<f64>,
    /// Columns of the triangular factor, BASIS + 1 entries each.
    columns: Vec<f64>,
    rotations: Vec<(f64, f64)>,
    projected: Vec<f64>,
}

impl Gmres {
    /// Solves `A x = b`, x holding a guess on entry, until the residual is below `tolerance` of b or `most` products
    /// have been made.
    pub(crate) fn solve(
        &mut self,
        mut product: impl FnMut(&[f64], &mut [f64]),
        b: &[f64],
        x: &mut [f64],
        tolerance: f64,
        most: usize,
    ) -> Outcome {
        let len = b.len();
        self.basis.resize((BASIS + 1) * len, 0.0);
        self.columns.resize((BASIS + 1) * BASIS, 0.0);
        self.rotations.resize(BASIS, (1.0, 0.0));
        self.projected.resize(BASIS + 1, 0.0);
        let scale = norm(b);
        if scale == 0.0 {
            x.fill(0.0);
            return Outcome { iterations: 0, residual: 0.0 };
        }
        let goal = tolerance * scale;
        let mut iterations = 0;
        loop {
            let first = &mut self.basis[..len];
            product(x, first);
            for (r, b) in first.iter_mut().zip(b) {
                *r = b - *r;
            }
            let start = norm(first);
            // A residual that is not a number must end the iteration as well.
            if start <= goal || iterations >= most || !start.is_finite() {
                return Outcome { iterations, residual: start / scale };
            }
            first.iter_mut().for_each(|r| *r /= start);
            self.projected[0] = start;
            let mut size = 0;
            while size < BASIS && iterations < most && self.projected[size].abs() > goal {
                self.extend(&mut product, size, len);
                size += 1;
                iterations += 1;
            }
            self.back_substitute(size);
            for j in 0..size {
                axpy(self.projected[j], &self.basis[j * len..(j + 1) * len], x);
            }
            let left = self.projected[size].abs();
            if left <= goal {
                return Outcome { iterations, residual: left / scale };
            }
        }
    }

    /// Adds a vector to the basis and a column to the triangular factor.
    fn extend(&mut self, product: &mut impl FnMut(&[f64], &mut [f64]), size: usize, len: usize) {
        let (done, free) = self.basis.split_at_mut((size + 1) * len);
        let next = &mut free[..len];
        product(&done[size * len..], next);
        let column = &mut self.columns[size * (BASIS + 1)..(size + 1) * (BASIS + 1)];
        for (entry, vector) in column.iter_mut().zip(done.chunks_exact(len)) {
            *entry = dot(vector, next);
            axpy(-*entry, vector, next);
        }
        let length = norm(next);
        if length > 0.0 {
            next.iter_mut().for_each(|value| *value /= length);
        }
        for (j, &(c, s)) in self.rotations[..size].iter().enumerate() {
            (column[j], column[j + 1]) = (c * column[j] + s * column[j + 1], c * column[j + 1] - s * column[j]);
        }
        let hypotenuse = column[size].hypot(length);
        let (c, s) = if hypotenuse > 0.0 { (column[size] / hypotenuse, length / hypotenuse) } else { (1.0, 0.0) };
        self.rotations[size] = (c, s);
        column[size] = hypotenuse;
        self.projected[size + 1] = -s * self.projected[size];
        self.projected[size] *= c;
    }

    /// Turns the projected right-hand side into coefficients of the basis vectors.
    fn back_substitute(&mut self, size: usize) {
        for j in (0..size).rev() {
            let column = &self.columns[j * (BASIS + 1)..(j + 1) * (BASIS + 1)];
            let value = if column[j] == 0.0 { 0.0 } else { self.projected[j] / column[j] };
            self.projected[j] = value;
            for (projected, entry) in self.projected[..j].iter_mut().zip(column) {
                *projected -= entry * value;
            }
        }
    }
}

/// Scalar product in eight partial sums, which the compiler can keep in vector registers.
pub(crate) fn dot(a: &[f64], b: &[f64]) -> f64 {
    const LANES: usize = 8;
    let (a_chunks, a_rest) = a.as_chunks::<LANES>();
    let (b_chunks, b_rest) = b.as_chunks::<LANES>();
    let mut lanes = [0.0; LANES];
    for (a, b) in a_chunks.iter().zip(b_chunks) {
        for lane in 0..LANES {
            lanes[lane] += a[lane] * b[lane];
        }
    }
    lanes.iter().sum::<f64>() + a_rest.iter().zip(b_rest).map(|(a, b)| a * b).sum::<f64>()
}

fn norm(a: &[f64]) -> f64 {
    dot(a, a).sqrt()
}

fn axpy(factor: f64, x: &[f64], y: &mut [f64]) {
    for (y, x) in y.iter_mut().zip(x) {
        *y += factor * x;
    }
}

#[cfg(test)]
mod tests;

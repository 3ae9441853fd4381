//! Generalised minimal residuals for dense well-conditioned systems.

mod recycled;

use recycled::Recycled;

/// Basis vectors before a restart.
const BASIS: usize = 60;
/// The same where directions of earlier solutions precondition.
const SHORT: usize = 30;

/// What an iteration did.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Outcome {
    /// Products with the matrix but the one that gives the residual of the guess.
    pub iterations: usize,
    /// Norm of the residual over that of the right-hand side.
    pub residual: f64,
}

/// GMRES (Saad and Schultz, SIAM J. Sci. Stat. Comput. 7, 856, 1986), restarted, with its memory: nothing is allocated
/// once a size has been used.
///
/// ```
/// use stokes_layers::gmres::Gmres;
///
/// let product = |x: &[f64], out: &mut [f64], _accuracy: f64| {
///     (out[0], out[1]) = (2.0 * x[0] + x[1], x[0] + 3.0 * x[1]);
/// };
/// let mut x = [0.0; 2];
/// let outcome = Gmres::default().solve(product, &[5.0, 10.0], &mut x, 1e-12, 10);
/// assert!((x[0] - 1.0).abs() < 1e-10 && (x[1] - 3.0).abs() < 1e-10 && outcome.iterations == 2);
/// ```
#[derive(Debug, Clone, Default)]
pub struct Gmres {
    /// Orthonormal vectors, one after the other.
    basis: Vec<f64>,
    /// Columns of the triangular factor, BASIS + 1 entries each.
    columns: Vec<f64>,
    rotations: Vec<(f64, f64)>,
    projected: Vec<f64>,
    recycled: Option<Recycled>,
    /// The basis times the preconditioner, and the products of that with the matrix.
    directions: Vec<f64>,
    images: Vec<f64>,
}

impl Gmres {
    /// One whose solutions leave directions that precondition the next one, for matrices that change little from
    /// solution to solution.
    #[must_use]
    pub fn recycling() -> Self {
        Self { recycled: Some(Recycled::default()), ..Self::default() }
    }

    /// Forgets what earlier solutions left, so that the next one does not depend on them.
    pub fn forget(&mut self) {
        if let Some(recycled) = &mut self.recycled {
            recycled.forget();
        }
    }

    /// Length of the vectors of what earlier solutions left.
    #[must_use]
    pub fn len(&self) -> usize {
        self.recycled.as_ref().map_or(0, Recycled::len)
    }

    /// Whether earlier solutions left nothing.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.recycled.as_ref().is_none_or(Recycled::is_empty)
    }

    /// What earlier solutions left, vector after vector.
    #[must_use]
    pub fn save(&self) -> Vec<f64> {
        self.recycled.as_ref().map_or_else(Vec::new, Recycled::save)
    }

    /// Continues from what [`Gmres::save`] wrote for vectors of length `len`; forgets what there is if it does not fit.
    pub fn restore(&mut self, len: usize, kept: &[f64]) {
        if let Some(recycled) = &mut self.recycled {
            recycled.restore(len, kept);
        }
    }

    /// Solves `A x = b`, x holding a guess on entry, until the residual is below `tolerance` of b or `most` products
    /// have been made.
    ///
    /// `product(x, out, accuracy)` may err by `accuracy` times the norm of x: the smaller the residual already is, the
    /// less a new direction contributes to the solution and the less exactly its product need be known (Simoncini and
    /// Szyld, SIAM J. Sci. Comput. 25, 454, 2003).
    pub fn solve(
        &mut self,
        mut product: impl FnMut(&[f64], &mut [f64], f64),
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
        self.directions.resize(BASIS * len, 0.0);
        self.images.resize(BASIS * len, 0.0);
        if let Some(recycled) = &mut self.recycled {
            recycled.fit(len);
        }
        let scale = norm(b);
        if scale == 0.0 {
            x.fill(0.0);
            return Outcome { iterations: 0, residual: 0.0 };
        }
        let goal = tolerance * scale;
        let mut iterations = 0;
        // A first cycle that does not converge is taken for the fault of what it relies on: the next does without.
        let mut slack = goal;
        loop {
            let longest = if self.is_empty() { BASIS } else { SHORT };
            let first = &mut self.basis[..len];
            product(x, first, tolerance);
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
            while size < longest && iterations < most && self.projected[size].abs() > goal {
                self.extend(&mut product, size, len, slack);
                size += 1;
                iterations += 1;
            }
            self.back_substitute(size);
            for j in 0..size {
                axpy(self.projected[j], &self.directions[j * len..(j + 1) * len], x);
            }
            let left = self.projected[size].abs();
            if left <= goal {
                if let Some(recycled) = &mut self.recycled {
                    recycled.renew(&mut self.directions[..size * len], &self.images[..size * len]);
                }
                return Outcome { iterations, residual: left / scale };
            }
            self.forget();
            slack = 0.0;
        }
    }

    /// Adds a vector to the basis and a column to the triangular factor.
    fn extend(&mut self, product: &mut impl FnMut(&[f64], &mut [f64], f64), size: usize, len: usize, slack: f64) {
        let (done, free) = self.basis.split_at_mut((size + 1) * len);
        let next = &mut free[..len];
        let direction = &mut self.directions[size * len..(size + 1) * len];
        match &self.recycled {
            Some(recycled) => recycled.apply(&done[size * len..], direction),
            None => direction.copy_from_slice(&done[size * len..]),
        }
        let accuracy = slack / (self.projected[size].abs() * norm(direction));
        product(direction, next, accuracy);
        self.images[size * len..(size + 1) * len].copy_from_slice(next);
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
#[must_use]
pub fn dot(a: &[f64], b: &[f64]) -> f64 {
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

pub(crate) fn axpy(factor: f64, x: &[f64], y: &mut [f64]) {
    for (y, x) in y.iter_mut().zip(x) {
        *y += factor * x;
    }
}

#[cfg(test)]
mod tests;

//! Generalised minimal residuals (GMRES) for dense well-conditioned systems, with directions recycled from solution to
//! solution.

use motile_base::internal::dot;

/// Basis vectors before a restart: with directions and images 180 vectors, 2 MB for ten interfaces of 64 nodes. Usual
/// solutions take a few iterations.
const BASIS: usize = 60;
/// Basis vectors before a restart where directions of earlier solutions precondition: if half as many do not do, the
/// matrix has changed too much and a start without these directions is better.
const SHORT: usize = 30;

/// Result of an iteration.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Outcome {
    /// Products with the matrix, without the one that gives the residual of the guess.
    pub iterations: usize,
    /// Norm of the residual over the norm of the right-hand side.
    pub residual: f64,
}

/// Restarted GMRES (Saad and Schultz, SIAM J. Sci. Stat. Comput. 7, 856, 1986) with its memory: nothing is allocated
/// once a size has been used.
///
/// ```
/// use stokes_boundary_integrals::internal::gmres::Gmres;
///
/// let product = |x: &[f64], out: &mut [f64], _accuracy: f64| {
///     (out[0], out[1]) = (2.0 * x[0] + x[1], x[0] + 3.0 * x[1]);
/// };
/// let mut x = [0.0; 2];
/// let outcome = Gmres::default().solve(product, &[5.0, 10.0], &mut x, 1e-12, 10);
/// assert!((x[0] - 1.0).abs() < 1e-10 && (x[1] - 3.0).abs() < 1e-10 && outcome.iterations == 2);
/// ```
#[derive(Debug, Clone, Default)]
#[doc(alias("Krylov", "iterative solver"))]
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
    /// Creates a solver in which the directions of one solution precondition the next, for matrices that change little
    /// in between.
    #[must_use]
    pub fn recycling() -> Self {
        Self { recycled: Some(Recycled::default()), ..Self::default() }
    }

    /// Drops the recycled directions, so that the next solution does not depend on earlier ones.
    pub fn forget(&mut self) {
        if let Some(recycled) = &mut self.recycled {
            recycled.forget();
        }
    }

    /// Returns the recycled directions for a checkpoint, vector after vector; none unless they have the length `len`.
    #[must_use]
    pub fn save(&self, len: usize) -> Vec<f64> {
        self.recycled.as_ref().filter(|recycled| recycled.len == len).map_or_else(Vec::new, Recycled::save)
    }

    /// Takes over directions of length `len` that [`Gmres::save`] wrote, and drops the present ones if these do not
    /// fit.
    pub fn restore(&mut self, len: usize, saved: &[f64]) {
        if let Some(recycled) = &mut self.recycled {
            recycled.restore(len, saved);
        }
    }

    /// Solves `A x = b`, x holding a guess on entry, until the norm of the residual is below `tolerance` times the norm
    /// of b or `most` products have been made.
    ///
    /// `product(x, out, accuracy)` writes A x with an error of up to `accuracy` times the norm of x. As the residual
    /// becomes smaller, a new direction contributes less to the solution and its product may be less exact (Simoncini
    /// and Szyld, SIAM J. Sci. Comput. 25, 454, 2003).
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
        // If the first cycle does not converge, the next uses exact products and no recycled directions.
        let mut slack = goal;
        loop {
            let recycled = self.recycled.as_ref().is_some_and(|recycled| recycled.now.size > 0);
            let longest = if recycled { SHORT } else { BASIS };
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

/// Number of directions that are recycled, half of the basis vectors between restarts: applying them costs as much as
/// orthogonalising against as many.
const MOST: usize = 16;
/// Directions of a solution up to which the recycled ones stay: they have served, and renewing them costs more.
const FEW: usize = 3;
/// Minimum fraction of an older image that is independent of newer ones for its direction to stay: below, its direction
/// is mostly the newer ones' with the errors of an older matrix.
const OLD: f64 = 0.1;
/// Least independent part among images of the same solution, whose matrix is the same: round-off over this part stays
/// below the usual tolerances.
const NEW: f64 = 1e-6;
/// Cosine below which two images count as orthogonal, so that subtracting one from the other is saved: most older ones
/// still are, and the preconditioner need not be exact.
const ORTHOGONAL: f64 = 1e-4;

/// Directions u from earlier solutions and their orthonormal images c = A u, for matrices A that were nearly equal.
///
/// From step to step of a run the matrix and the change of the right-hand side vary slowly, so the directions that
/// mattered in one solution matter in the next. The preconditioner `M = 1 + sum over i of (u_i - c_i) c_i^T` takes c_i
/// to u_i, as the inverse of A does, and is the identity on all that is orthogonal to them. Images of an older matrix
/// make M a worse preconditioner, but the solution no less exact.
#[derive(Debug, Clone, Default)]
struct Recycled {
    len: usize,
    now: Pairs,
    /// Memory for the exchange of old directions for new ones.
    before: Pairs,
}

/// Orthonormal images and directions minus images, row after row.
#[derive(Debug, Clone, Default)]
struct Pairs {
    size: usize,
    differences: Vec<f64>,
    images: Vec<f64>,
}

impl Recycled {
    /// Prepares for vectors of that length; vectors of another length are dropped.
    fn fit(&mut self, len: usize) {
        if self.len != len {
            self.len = len;
            for pairs in [&mut self.now, &mut self.before] {
                pairs.size = 0;
                pairs.differences.resize(MOST * len, 0.0);
                pairs.images.resize(MOST * len, 0.0);
            }
        }
    }

    fn forget(&mut self) {
        self.now.size = 0;
    }

    /// Returns all differences, then all images.
    fn save(&self) -> Vec<f64> {
        let kept = self.now.size * self.len;
        [&self.now.differences[..kept], &self.now.images[..kept]].concat()
    }

    /// Takes over what [`Recycled::save`] wrote.
    fn restore(&mut self, len: usize, saved: &[f64]) {
        self.fit(len);
        self.forget();
        let size = saved.len() / (2 * len.max(1));
        if len > 0 && size <= MOST && saved.len() == 2 * size * len {
            let (differences, images) = saved.split_at(size * len);
            self.now.differences[..size * len].copy_from_slice(differences);
            self.now.images[..size * len].copy_from_slice(images);
            self.now.size = size;
        }
    }

    /// `out = M v`.
    fn apply(&self, v: &[f64], out: &mut [f64]) {
        out.copy_from_slice(v);
        let pairs = self.now.differences.chunks_exact(self.len).zip(self.now.images.chunks_exact(self.len));
        for (difference, image) in pairs.take(self.now.size) {
            axpy(dot(image, v), difference, out);
        }
    }

    /// Takes over the directions of a solution with their images, row after row: all new ones, then older ones as far
    /// as they are independent of these.
    fn renew(&mut self, directions: &mut [f64], images: &[f64]) {
        let len = self.len;
        if directions.len() > MOST * len {
            // A part of the directions of so hard a problem preconditions worse than none.
            self.forget();
            return;
        }
        if directions.len() <= FEW * len && self.now.size > 0 {
            return;
        }
        axpy(-1.0, images, directions);
        std::mem::swap(&mut self.now, &mut self.before);
        self.now.size = 0;
        for (difference, image) in directions.chunks_exact(len).zip(images.chunks_exact(len)) {
            self.now.add(difference, image, NEW);
        }
        let old = self.before.differences.chunks_exact(len).zip(self.before.images.chunks_exact(len));
        for (difference, image) in old.take(self.before.size) {
            self.now.add(difference, image, OLD);
        }
    }
}

impl Pairs {
    /// Adds a direction unless less than the part `least` of its image is orthogonal to the present ones.
    fn add(&mut self, difference: &[f64], image: &[f64], least: f64) {
        if self.size == MOST {
            return;
        }
        let len = image.len();
        let (differences, own_differences) = self.differences.split_at_mut(self.size * len);
        let (images, own_images) = self.images.split_at_mut(self.size * len);
        let (new_difference, new_image) = (&mut own_differences[..len], &mut own_images[..len]);
        new_difference.copy_from_slice(difference);
        new_image.copy_from_slice(image);
        let norm = dot(image, image).sqrt();
        for (difference, image) in differences.chunks_exact(len).zip(images.chunks_exact(len)) {
            let part = dot(image, new_image);
            if part.abs() > ORTHOGONAL * norm {
                axpy(-part, difference, new_difference);
                axpy(-part, image, new_image);
            }
        }
        let left = dot(new_image, new_image).sqrt();
        if left > least * norm {
            new_difference.iter_mut().for_each(|value| *value /= left);
            new_image.iter_mut().for_each(|value| *value /= left);
            self.size += 1;
        }
    }
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

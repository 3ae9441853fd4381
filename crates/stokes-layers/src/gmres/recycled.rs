//! What one solution by GMRES leaves for the next.

use super::{axpy, dot};

/// Directions that are kept.
const MOST: usize = 16;
/// A solution that needed no more directions than this changes nothing: what there is serves.
const FEW: usize = 3;
/// What is left of an older image beside newer ones must be more than this part of it.
const OLD: f64 = 0.1;
/// The same for the images of one solution.
const NEW: f64 = 1e-6;
/// Cosine below which two images count as orthogonal: most older ones still are.
const ORTHOGONAL: f64 = 1e-4;

/// Directions u with their images c = A u, orthonormal, from earlier solutions with matrices A that were nearly the
/// same.
///
/// From step to step of a run the matrix and the change of the right-hand side vary slowly, so the directions that
/// mattered in one solution matter in the next. `M = 1 + sum over i of (u_i - c_i) c_i^T` takes c_i to u_i, which the
/// inverse of A would do, and leaves alone what is orthogonal to them. Old images make M a worse preconditioner but not
/// the solution less exact.
#[derive(Debug, Clone, Default)]
pub(crate) struct Recycled {
    len: usize,
    now: Pairs,
    before: Pairs,
}

/// Rows of images, orthonormal, and of directions minus images.
#[derive(Debug, Clone, Default)]
struct Pairs {
    size: usize,
    differences: Vec<f64>,
    images: Vec<f64>,
}

impl Recycled {
    /// Makes ready for vectors of that length; those of another length are forgotten.
    pub(crate) fn fit(&mut self, len: usize) {
        if self.len != len {
            self.len = len;
            for pairs in [&mut self.now, &mut self.before] {
                pairs.size = 0;
                pairs.differences.resize(MOST * len, 0.0);
                pairs.images.resize(MOST * len, 0.0);
            }
        }
    }

    pub(crate) fn forget(&mut self) {
        self.now.size = 0;
    }

    /// Length of the vectors.
    pub(crate) fn len(&self) -> usize {
        self.len
    }

    /// What is kept, row after row: differences, then images.
    pub(crate) fn save(&self) -> Vec<f64> {
        let kept = self.now.size * self.len;
        [&self.now.differences[..kept], &self.now.images[..kept]].concat()
    }

    /// Takes over what [`Recycled::save`] wrote.
    pub(crate) fn restore(&mut self, len: usize, kept: &[f64]) {
        self.fit(len);
        self.forget();
        let size = kept.len() / (2 * len.max(1));
        if len > 0 && size <= MOST && kept.len() == 2 * size * len {
            let (differences, images) = kept.split_at(size * len);
            self.now.differences[..size * len].copy_from_slice(differences);
            self.now.images[..size * len].copy_from_slice(images);
            self.now.size = size;
        }
    }

    pub(crate) fn is_empty(&self) -> bool {
        self.now.size == 0
    }

    /// `out = M v`.
    pub(crate) fn apply(&self, v: &[f64], out: &mut [f64]) {
        out.copy_from_slice(v);
        let pairs = self.now.differences.chunks_exact(self.len).zip(self.now.images.chunks_exact(self.len));
        for (difference, image) in pairs.take(self.now.size) {
            axpy(dot(image, v), difference, out);
        }
    }

    /// Takes over the directions of a solution with their images, row after row. The newest come first, and older ones
    /// only as far as they add something: so all images stay fresh.
    pub(crate) fn renew(&mut self, directions: &mut [f64], images: &[f64]) {
        let len = self.len;
        if directions.len() > MOST * len {
            // Where so many matter, some of them serve worse than none.
            self.forget();
            return;
        }
        if directions.len() <= FEW * len && !self.is_empty() {
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

//! What one solution by GMRES leaves for the next.

use crate::gmres::{axpy, dot};

/// Directions that are kept.
const MOST: usize = 20;
/// What is left of an older direction beside newer ones must be more than this part of it.
const OLD: f64 = 0.1;
/// The same for the directions of one solution.
const NEW: f64 = 1e-6;

/// Directions u with their images c = A u, orthonormal, from earlier solutions with matrices A that were nearly the same.
///
/// From step to step of a run the matrix and the change of the right-hand side vary slowly, so the directions that
/// mattered in one solution matter in the next. `M = 1 + sum over i of (u_i - c_i) c_i^T` takes c_i to u_i, which the
/// inverse of A would do, and leaves alone what is orthogonal to them. Old images make M a worse preconditioner but not
/// the solution less exact.
#[derive(Debug, Default)]
pub(crate) struct Recycled {
    len: usize,
    size: usize,
    directions: Vec<f64>,
    images: Vec<f64>,
    old_directions: Vec<f64>,
    old_images: Vec<f64>,
}

impl Recycled {
    /// Makes ready for vectors of that length; those of another length are forgotten.
    pub(crate) fn fit(&mut self, len: usize) {
        if self.len != len {
            self.len = len;
            self.size = 0;
            for values in [&mut self.directions, &mut self.images, &mut self.old_directions, &mut self.old_images] {
                values.clear();
                values.resize(MOST * len, 0.0);
            }
        }
    }

    pub(crate) fn forget(&mut self) {
        self.size = 0;
    }

    pub(crate) fn is_empty(&self) -> bool {
        self.size == 0
    }

    /// `out = M v`.
    pub(crate) fn apply(&self, v: &[f64], out: &mut [f64]) {
        out.copy_from_slice(v);
        let (directions, images) = (self.directions.chunks_exact(self.len), self.images.chunks_exact(self.len));
        for (direction, image) in directions.zip(images).take(self.size) {
            let part = dot(image, v);
            for ((out, direction), image) in out.iter_mut().zip(direction).zip(image) {
                *out += part * (direction - image);
            }
        }
    }

    /// Takes over the directions of a solution with their images, row after row; the oldest ones give way.
    pub(crate) fn renew(&mut self, directions: &[f64], images: &[f64]) {
        let old = std::mem::take(&mut self.size);
        std::mem::swap(&mut self.directions, &mut self.old_directions);
        std::mem::swap(&mut self.images, &mut self.old_images);
        let len = self.len;
        for (direction, image) in directions.chunks_exact(len).zip(images.chunks_exact(len)) {
            self.add(direction, image, NEW);
        }
        let (old_directions, old_images) =
            (std::mem::take(&mut self.old_directions), std::mem::take(&mut self.old_images));
        for (direction, image) in old_directions.chunks_exact(len).zip(old_images.chunks_exact(len)).take(old) {
            self.add(direction, image, OLD);
        }
        (self.old_directions, self.old_images) = (old_directions, old_images);
    }

    fn add(&mut self, direction: &[f64], image: &[f64], least: f64) {
        if self.size == MOST {
            return;
        }
        let len = self.len;
        let (directions, images) =
            (self.directions.split_at_mut(self.size * len), self.images.split_at_mut(self.size * len));
        let (new_direction, new_image) = (&mut directions.1[..len], &mut images.1[..len]);
        new_direction.copy_from_slice(direction);
        new_image.copy_from_slice(image);
        let norm = dot(image, image).sqrt();
        for (direction, image) in directions.0.chunks_exact(len).zip(images.0.chunks_exact(len)) {
            let part = -dot(image, new_image);
            axpy(part, direction, new_direction);
            axpy(part, image, new_image);
        }
        let left = dot(new_image, new_image).sqrt();
        if left > least * norm {
            new_direction.iter_mut().for_each(|value| *value /= left);
            new_image.iter_mut().for_each(|value| *value /= left);
            self.size += 1;
        }
    }
}

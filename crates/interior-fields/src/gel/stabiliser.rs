//! The stiff part of the director's motion, made implicit.

use std::collections::HashMap;

use super::elements::Elements;

/// Residual of the conjugate gradients, relative to the right side, and the most iterations.
const TOLERANCE: f64 = 1e-12;
const MOST_ITERATIONS: usize = 500;

/// A diffusion of the angles that is added implicitly and taken off explicitly, so that only its action on their change
/// within a step is left: jumps of whole turns between neighbours do not matter. Its geometry is that of the start of
/// the step, anchored nodes stay out of it.
#[derive(Debug, Clone, Default)]
pub(super) struct Stabiliser {
    /// Pairs of nodes with a common triangle, and of each triangle the pairs opposite to its corners.
    edges: Vec<[usize; 2]>,
    sides: Vec<[usize; 3]>,
    anchored: usize,
    /// Weights of the pairs and the sums of those around a node, areas of nodes (length squared).
    weights: Vec<f64>,
    diagonal: Vec<f64>,
    masses: Vec<f64>,
    /// Diffusivity (length squared per time); 0 where there is no stabiliser.
    diffusivity: f64,
    residual: Vec<f64>,
    direction: Vec<f64>,
    image: Vec<f64>,
}

impl Stabiliser {
    pub(super) fn new(elements: &Elements, anchored: usize) -> Self {
        let (mut edges, mut numbers) = (Vec::new(), HashMap::new());
        let sides = elements.triangles.iter().map(|&[a, b, c]| {
            [[b, c], [c, a], [a, b]].map(|[i, j]| {
                let edge = [i.min(j), i.max(j)];
                *numbers.entry(edge).or_insert_with(|| {
                    edges.push(edge);
                    edges.len() - 1
                })
            })
        });
        let sides = sides.collect();
        let (nodes, free) = (elements.masses.len(), elements.masses.len() - anchored);
        Self {
            weights: vec![0.0; edges.len()],
            diagonal: vec![0.0; nodes],
            masses: vec![0.0; nodes],
            residual: vec![0.0; free],
            direction: vec![0.0; free],
            image: vec![0.0; free],
            edges,
            sides,
            anchored,
            diffusivity: 0.0,
        }
    }

    /// Takes over the geometry and a diffusivity (length squared per time), 0 for none.
    pub(super) fn freeze(&mut self, elements: &Elements, diffusivity: f64) {
        self.diffusivity = diffusivity;
        if diffusivity == 0.0 {
            return;
        }
        self.masses.copy_from_slice(&elements.masses);
        self.weights.fill(0.0);
        self.diagonal.fill(0.0);
        for ((sides, slopes), area) in self.sides.iter().zip(&elements.gradients).zip(&elements.areas) {
            for (corner, &side) in sides.iter().enumerate() {
                self.weights[side] -= area * slopes[(corner + 1) % 3].dot(slopes[(corner + 2) % 3]);
            }
        }
        for (&[i, j], weight) in self.edges.iter().zip(&self.weights) {
            self.diagonal[i] += weight;
            self.diagonal[j] += weight;
        }
    }

    /// Adds `factor` times the diffusion of `angles`, those that are not anchored, to `out`.
    pub(super) fn add(&mut self, angles: &[f64], factor: f64, out: &mut [f64]) {
        if self.diffusivity == 0.0 {
            return;
        }
        let mut image = std::mem::take(&mut self.image);
        self.multiply(angles, &mut image);
        for ((out, image), mass) in out.iter_mut().zip(&image).zip(&self.masses[self.anchored..]) {
            *out -= factor * self.diffusivity * image / mass;
        }
        self.image = image;
    }

    /// Replaces `angles` by the solution y of `y - factor L y = angles`, L being the diffusion, by conjugate gradients.
    pub(super) fn solve(&mut self, factor: f64, angles: &mut [f64]) {
        let strength = factor * self.diffusivity;
        if strength == 0.0 {
            return;
        }
        let [mut residual, mut direction, mut image] =
            [&mut self.residual, &mut self.direction, &mut self.image].map(std::mem::take);
        let first = self.anchored;
        let scale = |node: usize, stabiliser: &Self| {
            stabiliser.masses[first + node] + strength * stabiliser.diagonal[first + node]
        };
        // Where the angles are now the residual is that of the diffusion alone.
        self.multiply(angles, &mut image);
        let (mut size, mut goal) = (0.0, 0.0);
        for (node, residual) in residual.iter_mut().enumerate() {
            *residual = -strength * image[node];
            direction[node] = *residual / scale(node, self);
            size += *residual * direction[node];
            let right = self.masses[first + node] * angles[node];
            goal += right * right / scale(node, self);
        }
        for _ in 0..MOST_ITERATIONS {
            if size <= TOLERANCE * TOLERANCE * goal {
                break;
            }
            self.multiply(&direction, &mut image);
            let mut power = 0.0;
            for (node, image) in image.iter_mut().enumerate() {
                *image = self.masses[first + node] * direction[node] + strength * *image;
                power += *image * direction[node];
            }
            let (length, before) = (size / power, size);
            size = 0.0;
            for (node, residual) in residual.iter_mut().enumerate() {
                angles[node] += length * direction[node];
                *residual -= length * image[node];
                size += *residual * *residual / scale(node, self);
            }
            for (node, direction) in direction.iter_mut().enumerate() {
                *direction = residual[node] / scale(node, self) + size / before * *direction;
            }
        }
        (self.residual, self.direction, self.image) = (residual, direction, image);
    }

    /// The stiffness matrix of the nodes that are not anchored, times a vector.
    fn multiply(&self, vector: &[f64], image: &mut [f64]) {
        let first = self.anchored;
        for ((image, value), diagonal) in image.iter_mut().zip(vector).zip(&self.diagonal[first..]) {
            *image = diagonal * value;
        }
        for (&[i, j], weight) in self.edges.iter().zip(&self.weights).filter(|([i, _], _)| *i >= first) {
            image[i - first] -= weight * vector[j - first];
            image[j - first] -= weight * vector[i - first];
        }
    }
}

#[cfg(test)]
mod tests;

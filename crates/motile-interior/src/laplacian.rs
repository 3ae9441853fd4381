//! Laplace operator on a triangulation, by linear elements with lumped masses.

use std::collections::HashMap;

use motile_base::{Vec2, internal::dot};

use crate::{InteriorError, factor::Factor};

/// Iterations before the conjugate gradients end; they take the root of the condition number, below a hundred.
const MOST_ITERATIONS: usize = 3000;

/// Sides of a triangle, from the first corner to the second and so on: number of the edge, and 1 if the side runs from
/// its lower node to its higher, else -1.
pub(crate) type Sides = [(usize, f64); 3];

/// Returns the edges of a triangulation as pairs of nodes, the lower first, and the sides of each triangle.
pub(crate) fn edges(triangles: &[[usize; 3]]) -> (Vec<[usize; 2]>, Vec<Sides>) {
    let (mut edges, mut numbers) = (Vec::new(), HashMap::new());
    let mut side = |from: usize, to: usize| {
        let pair = [from.min(to), from.max(to)];
        let number = *numbers.entry(pair).or_insert_with(|| {
            edges.push(pair);
            edges.len() - 1
        });
        (number, if from < to { 1.0 } else { -1.0 })
    };
    let sides = triangles.iter().map(|&[a, b, c]| [side(a, b), side(b, c), side(c, a)]).collect();
    (edges, sides)
}

/// Laplace operator for values at the nodes of a triangulation: `(lap c)_i = -(K c)_i/M_i`, `(K c)_i = SUM_j w_ij (c_i
/// - c_j)` over the edges at a node.
///
/// Values at the first nodes may be held at zero; lists of values then hold the others.
#[derive(Debug, Clone)]
pub(crate) struct Laplacian {
    edges: Vec<[usize; 2]>,
    /// Weight w of each edge: half the sum of the cotangents of the angles opposite to it (no dimension).
    pub(crate) weights: Vec<f64>,
    /// Mass M of each node: a third of the areas around it (length squared).
    pub(crate) masses: Vec<f64>,
    /// Number of nodes, the first ones, at which values are zero.
    held: usize,
    /// Residual of linear equations, relative to the right-hand side.
    tolerance: f64,
    preconditioner: Preconditioner,
    residual: Vec<f64>,
    scaled: Vec<f64>,
    direction: Vec<f64>,
    image: Vec<f64>,
}

/// Approximate inverse for the conjugate gradients.
#[derive(Debug, Clone)]
enum Preconditioner {
    /// Division by the diagonal.
    Diagonal(Vec<f64>),
    /// Exact inverse for other weights and masses, those given, and a strength near the one asked for, of so many
    /// quarters of an octave. It takes the iterations to a handful, and does not depend on what has been solved before.
    Factor { factor: Box<Factor>, weights: Vec<f64>, masses: Vec<f64>, quarters: Option<i32> },
}

impl Preconditioner {
    /// Makes ready for `masses + strength weights`.
    fn set(&mut self, edges: &[[usize; 2]], held: usize, (strength, weights, masses): (f64, &[f64], &[f64])) {
        match self {
            Self::Diagonal(diagonal) => {
                diagonal.copy_from_slice(&masses[held..]);
                for (edge, weight) in edges.iter().zip(weights) {
                    for node in edge.iter().filter_map(|node| node.checked_sub(held)) {
                        diagonal[node] += strength * weight;
                    }
                }
            }
            Self::Factor { factor, weights, masses, quarters } => {
                let wanted = (4.0 * strength.log2()).round();
                if *quarters != Some(wanted as i32) {
                    factor.set(masses, (0.25 * wanted).exp2(), weights);
                    *quarters = Some(wanted as i32);
                }
            }
        }
    }

    fn apply(&mut self, residual: &[f64], out: &mut [f64]) {
        match self {
            Self::Diagonal(diagonal) => {
                out.iter_mut().zip(residual).zip(diagonal).for_each(|((out, r), d)| *out = r / *d);
            }
            Self::Factor { factor, .. } => factor.solve(residual, out),
        }
    }
}

impl Laplacian {
    /// Returns the operator with weights and masses of zero.
    pub(crate) fn new(edges: Vec<[usize; 2]>, nodes: usize, held: usize, tolerance: f64) -> Self {
        let [diagonal, residual, scaled, direction, image] = [(); 5].map(|()| vec![0.0; nodes - held]);
        let (weights, masses) = (vec![0.0; edges.len()], vec![0.0; nodes]);
        let preconditioner = Preconditioner::Diagonal(diagonal);
        Self { edges, weights, masses, held, tolerance, preconditioner, residual, scaled, direction, image }
    }

    /// Returns the operator with weights and masses for nodes at positions (length), solved with the help of a factor
    /// for them: for a mesh without periods that stays near these positions.
    pub(crate) fn with_factor(
        mut self,
        nodes: &[Vec2],
        weights: &[f64],
        masses: &[f64],
    ) -> Result<Self, InteriorError> {
        self.set(weights, masses);
        let factor = Box::new(Factor::new(&self.edges, nodes, self.held)?);
        let (weights, masses) = (weights.to_vec(), masses.to_vec());
        self.preconditioner = Preconditioner::Factor { factor, weights, masses, quarters: None };
        Ok(self)
    }

    /// Takes over weights and masses.
    pub(crate) fn set(&mut self, weights: &[f64], masses: &[f64]) {
        self.weights.copy_from_slice(weights);
        self.masses.copy_from_slice(masses);
    }

    /// Writes K c to `image`.
    fn multiply(&self, values: &[f64], image: &mut [f64]) {
        image.fill(0.0);
        for (&[i, j], weight) in self.edges.iter().zip(&self.weights) {
            match (i.checked_sub(self.held), j.checked_sub(self.held)) {
                (Some(i), Some(j)) => {
                    let flux = weight * (values[i] - values[j]);
                    image[i] += flux;
                    image[j] -= flux;
                }
                (None, Some(node)) | (Some(node), None) => image[node] += weight * values[node],
                (None, None) => {}
            }
        }
    }

    /// K c, and the masses of its nodes.
    pub(crate) fn stiffness(&mut self, values: &[f64]) -> (&[f64], &[f64]) {
        let mut image = std::mem::take(&mut self.image);
        self.multiply(values, &mut image);
        self.image = image;
        (&self.image, &self.masses[self.held..])
    }

    /// Replaces values c by the solution y of `y - strength lap y = c`, by preconditioned conjugate gradients from c.
    pub(crate) fn solve(&mut self, strength: f64, values: &mut [f64]) {
        if strength == 0.0 {
            return;
        }
        let [mut residual, mut scaled, mut direction, mut image] =
            [&mut self.residual, &mut self.scaled, &mut self.direction, &mut self.image].map(std::mem::take);
        self.preconditioner.set(&self.edges, self.held, (strength, &self.weights, &self.masses));
        let masses = &self.masses[self.held..];
        // The norm of `r` by the inverse of the operator, in which the residual is measured, is at most that by masses.
        let size: f64 = masses.iter().zip(&*values).map(|(mass, c)| mass * c * c).sum();
        let goal = self.tolerance * self.tolerance * size;
        // From c itself the residual is that of the second term alone.
        self.multiply(values, &mut image);
        residual.iter_mut().zip(&image).for_each(|(r, image)| *r = -strength * image);
        self.preconditioner.apply(&residual, &mut scaled);
        direction.copy_from_slice(&scaled);
        let mut norm = dot(&residual, &scaled);
        for _ in 0..MOST_ITERATIONS {
            if norm <= goal {
                break;
            }
            self.multiply(&direction, &mut image);
            for ((image, p), mass) in image.iter_mut().zip(&direction).zip(masses) {
                *image = mass * p + strength * *image;
            }
            let (length, before) = (norm / dot(&image, &direction), norm);
            values.iter_mut().zip(&direction).for_each(|(c, p)| *c += length * p);
            residual.iter_mut().zip(&image).for_each(|(r, image)| *r -= length * image);
            self.preconditioner.apply(&residual, &mut scaled);
            norm = dot(&residual, &scaled);
            let kept = norm / before;
            direction.iter_mut().zip(&scaled).for_each(|(p, z)| *p = z + kept * *p);
        }
        (self.residual, self.scaled, self.direction, self.image) = (residual, scaled, direction, image);
    }
}

//! Diffusion from cell to cell.

use super::cells::Cells;

/// Residual at which the iteration ends, relative to the right side.
const TOLERANCE: f64 = 1e-13;
const MOST_ITERATIONS: usize = 3000;

/// Diffusion of the numbers of particles in cells at fixed places, `dN_i/dt = D SUM_j w_ij (C_j - C_i)`, `C = N/A`:
/// linear elements with lumped masses.
#[derive(Debug, Clone)]
pub(super) struct Diffusion {
    /// Diffusion constant (length squared per time).
    pub(super) constant: f64,
    areas: Vec<f64>,
    weights: Vec<f64>,
    diagonal: Vec<f64>,
    densities: Vec<f64>,
    residual: Vec<f64>,
    direction: Vec<f64>,
    image: Vec<f64>,
}

impl Diffusion {
    pub(super) fn new(constant: f64, cells: &Cells) -> Self {
        let [diagonal, densities, residual, direction, image] = [(); 5].map(|()| vec![0.0; cells.areas.len()]);
        let (areas, weights) = (cells.areas.clone(), cells.weights.clone());
        Self { constant, areas, weights, diagonal, densities, residual, direction, image }
    }

    /// Takes over where the cells are.
    pub(super) fn move_to(&mut self, cells: &Cells) {
        self.areas.copy_from_slice(&cells.areas);
        self.weights.copy_from_slice(&cells.weights);
    }

    /// Adds `factor` times the rates of the numbers to `out`.
    pub(super) fn add(&self, edges: &[[usize; 2]], numbers: &[f64], factor: f64, out: &mut [f64]) {
        for (&[i, j], weight) in edges.iter().zip(&self.weights) {
            let flux = factor * self.constant * weight * (numbers[i] / self.areas[i] - numbers[j] / self.areas[j]);
            out[i] -= flux;
            out[j] += flux;
        }
    }

    /// Replaces the numbers by the solution y of `y - factor * rate(y) = numbers`, whose sum is what theirs is. By
    /// conjugate gradients for the densities.
    pub(super) fn solve(&mut self, edges: &[[usize; 2]], factor: f64, numbers: &mut [f64]) {
        let scale = factor * self.constant;
        if scale == 0.0 {
            return;
        }
        let Self { areas, weights, diagonal, densities, residual, direction, image, .. } = self;
        diagonal.copy_from_slice(areas);
        for (&[i, j], weight) in edges.iter().zip(&*weights) {
            diagonal[i] += scale * weight;
            diagonal[j] += scale * weight;
        }
        let apply = |x: &[f64], out: &mut [f64]| {
            out.iter_mut().zip(&*areas).zip(x).for_each(|((out, area), x)| *out = area * x);
            for (&[i, j], weight) in edges.iter().zip(&*weights) {
                let flux = scale * weight * (x[i] - x[j]);
                out[i] += flux;
                out[j] -= flux;
            }
        };
        densities.iter_mut().zip(&*numbers).zip(&*areas).for_each(|((c, n), area)| *c = n / area);
        apply(densities, image);
        residual.iter_mut().zip(&*numbers).zip(&*image).for_each(|((r, n), image)| *r = n - image);
        let weighed = |r: &[f64]| r.iter().zip(&*diagonal).map(|(r, d)| r * r / d).sum::<f64>();
        let goal = TOLERANCE * TOLERANCE * weighed(numbers);
        let mut norm = weighed(residual);
        direction.iter_mut().zip(&*residual).zip(&*diagonal).for_each(|((p, r), d)| *p = r / d);
        for _ in 0..MOST_ITERATIONS {
            if norm <= goal {
                break;
            }
            apply(direction, image);
            let length = norm / direction.iter().zip(&*image).map(|(p, image)| p * image).sum::<f64>();
            densities.iter_mut().zip(&*direction).for_each(|(c, p)| *c += length * p);
            residual.iter_mut().zip(&*image).for_each(|(r, image)| *r -= length * image);
            let next = weighed(residual);
            let keep = next / norm;
            norm = next;
            direction.iter_mut().zip(&*residual).zip(&*diagonal).for_each(|((p, r), d)| *p = r / d + keep * *p);
        }
        // By fluxes, so that no particle is lost.
        for (&[i, j], weight) in edges.iter().zip(&*weights) {
            let flux = scale * weight * (densities[i] - densities[j]);
            numbers[i] -= flux;
            numbers[j] += flux;
        }
    }
}

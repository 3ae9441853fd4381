//! Flow inside one interface, from the velocities on it alone.

use std::f64::consts::{FRAC_2_PI, TAU};

use motile_base::{
    Vec2,
    internal::{spectrum::differentiate, widely},
};
use num_complex::Complex64;

use crate::{
    LayerError, Settings,
    curve::Curve,
    gmres::{Gmres, Outcome},
    transforms::Transforms,
};

/// Points whose sums run side by side.
const LANES: usize = 8;

/// Stokes flow inside a closed curve, by analytic functions phi and psi of z = x + i y (Goursat):
///
/// `v = phi(z) - z conj(phi'(z)) + conj(psi(z))`.
///
/// The velocity on the curve is a double layer of a density m (Pozrikidis, Boundary Integral and Singularity Methods,
/// 1992, section 4.2; complex: the equation of Sherman and Lauricella), d = y - x and n the outward normal,
///
/// `v(x) = m(x) + 2/pi INT d (d.m) (d.n)/|d|^4 ds(y)`,
///
/// and `2 pi i phi` is the Cauchy integral of m. With the values of phi on the curve, the values of psi follow from v,
/// and Cauchy's formula in barycentric form (Ioakimidis, Papadakis and Perdios, BIT 31 (1991) 276) gives both functions
/// at points inside, to spectral accuracy up to the curve: no logarithm, and no point is a close one.
#[derive(Debug, Clone, Default)]
pub(super) struct InsideFlow {
    gmres: Gmres,
    /// Entries xx, xy, yy of the double layer for each pair of nodes.
    kernel: Vec<[f64; 3]>,
    /// Density m at the nodes, x then y (length per time).
    density: Vec<f64>,
    /// Density at the nodes, and the derivative of it or of phi by the parameter.
    complex: Vec<Complex64>,
    slopes: Vec<Complex64>,
    poles: Vec<Pole>,
}

/// A node of the curve.
#[derive(Debug, Clone, Copy, Default)]
struct Pole {
    position: Complex64,
    /// Weight of the node in Cauchy's formula.
    weight: Complex64,
    /// Values of phi, phi' and psi there.
    values: [Complex64; 3],
}

impl InsideFlow {
    /// Takes over velocities at the nodes of a curve, x then y (length per time), relative to its centre.
    pub(super) fn prepare(
        &mut self,
        curve: &Curve,
        transforms: &mut Transforms,
        velocities: &[f64],
        &Settings { tolerance, most_iterations, .. }: &Settings,
    ) -> Result<(), LayerError> {
        self.fill_kernel(curve);
        self.density.clear();
        self.density.extend_from_slice(velocities);
        let Self { gmres, kernel, density, .. } = self;
        let product = |m: &[f64], out: &mut [f64], _accuracy: f64| apply(kernel, curve, m, out);
        let Outcome { iterations, residual } = gmres.solve(product, velocities, density, tolerance, most_iterations);
        if residual.is_nan() || residual > tolerance {
            return Err(LayerError::NoConvergence { iterations, residual, tolerance });
        }
        self.find_functions(curve, transforms, velocities);
        Ok(())
    }

    fn fill_kernel(&mut self, curve: &Curve) {
        let (nodes, tangents) = (&curve.nodes.position, &curve.nodes.tangent);
        let weight = FRAC_2_PI * curve.weight();
        self.kernel.clear();
        self.kernel.reserve(nodes.len() * nodes.len());
        for (i, x) in nodes.iter().enumerate() {
            for (j, (y, tangent)) in nodes.iter().zip(tangents).enumerate() {
                let (d, factor) = if i == j {
                    // (d.n)/|d|^2 tends to half the curvature.
                    let square = tangent.norm_sqr();
                    (*tangent, 0.5 * curve.curvature[i] * weight / square.sqrt())
                } else {
                    let d = y - x;
                    let square = d.norm_sqr();
                    (d, weight * (d.re * tangent.im - d.im * tangent.re) / (square * square))
                };
                self.kernel.push([factor * d.re * d.re, factor * d.re * d.im, factor * d.im * d.im]);
            }
        }
    }

    /// Values of phi, its derivative and psi at the nodes.
    fn find_functions(&mut self, curve: &Curve, transforms: &mut Transforms, velocities: &[f64]) {
        let Self { density, complex, slopes, poles, .. } = self;
        let (count, weight) = (curve.len(), curve.weight());
        let (x, y) = density.split_at(count);
        complex.clear();
        complex.extend(x.iter().zip(y).map(|(x, y)| Complex64::new(*x, *y)));
        slopes.clone_from(complex);
        let mut slope = |values: &mut Vec<Complex64>| {
            transforms.nodes.forward(values);
            differentiate(values);
            transforms.nodes.inverse(values);
        };
        slope(slopes);
        poles.clear();
        poles.extend(curve.nodes.position.iter().zip(&curve.nodes.tangent).map(|(position, tangent)| Pole {
            position: *position,
            weight: weight * tangent,
            values: [Complex64::default(); 3],
        }));
        let before = Complex64::new(0.0, -1.0 / TAU);
        for i in 0..count {
            let (at, here) = (poles[i].position, complex[i]);
            let mut sum = weight * slopes[i];
            for (j, pole) in poles.iter().enumerate() {
                if i != j {
                    sum += (complex[j] - here) * pole.weight / (pole.position - at);
                }
            }
            poles[i].values[0] = here + before * sum;
        }
        slopes.iter_mut().zip(&*poles).for_each(|(slope, pole)| *slope = pole.values[0]);
        slope(slopes);
        let (x, y) = velocities.split_at(count);
        for (i, (pole, tangent)) in poles.iter_mut().zip(&curve.nodes.tangent).enumerate() {
            let (phi, slope) = (pole.values[0], slopes[i] / tangent);
            let psi = (Complex64::new(x[i], y[i]) - phi + pole.position * slope.conj()).conj();
            pole.values = [phi, slope, psi];
        }
    }

    /// Returns the velocities (length per time) at points inside, `place` giving each one relative to the centre of the
    /// curve.
    pub(super) fn write(&self, points: &[Vec2], place: impl Fn(Vec2) -> Complex64, out: &mut [Vec2]) {
        for (points, out) in points.chunks(LANES).zip(out.chunks_mut(LANES)) {
            let [mut x, mut y] = [[0.0; LANES]; 2];
            for (lane, x) in x.iter_mut().enumerate() {
                let z = place(points[lane.min(points.len() - 1)]);
                (*x, y[lane]) = (z.re, z.im);
            }
            let sums = widely(
                #[inline(always)]
                || self.sums(&x, &y),
            );
            for (lane, out) in out.iter_mut().enumerate() {
                let sum = |k: usize| Complex64::new(sums[2 * k][lane], sums[2 * k + 1][lane]);
                let z = Complex64::new(x[lane], y[lane]);
                let [phi, slope, psi] = if sum(0).is_finite() {
                    [1, 2, 3].map(|k| sum(k) / sum(0))
                } else {
                    self.poles.iter().find(|pole| pole.position == z).map_or([z * f64::NAN; 3], |pole| pole.values)
                };
                let velocity = phi - z * slope.conj() + psi.conj();
                *out = Vec2::new(velocity.re, velocity.im);
            }
        }
    }

    /// Sums of the weights over the distances from points, without and with the values: real and imaginary parts.
    #[inline(always)]
    fn sums(&self, x: &[f64; LANES], y: &[f64; LANES]) -> [[f64; LANES]; 8] {
        let mut sums = [[0.0; LANES]; 8];
        for &Pole { position, weight, values: [phi, slope, psi] } in &self.poles {
            for lane in 0..LANES {
                let (dx, dy) = (position.re - x[lane], position.im - y[lane]);
                let scale = 1.0 / (dx * dx + dy * dy);
                let re = (weight.re * dx + weight.im * dy) * scale;
                let im = (weight.im * dx - weight.re * dy) * scale;
                sums[0][lane] += re;
                sums[1][lane] += im;
                sums[2][lane] += re * phi.re - im * phi.im;
                sums[3][lane] += re * phi.im + im * phi.re;
                sums[4][lane] += re * slope.re - im * slope.im;
                sums[5][lane] += re * slope.im + im * slope.re;
                sums[6][lane] += re * psi.re - im * psi.im;
                sums[7][lane] += re * psi.im + im * psi.re;
            }
        }
        sums
    }
}

/// The double layer of the density m on the inner side, and the mean of m.n along n, which it lacks.
fn apply(kernel: &[[f64; 3]], curve: &Curve, m: &[f64], out: &mut [f64]) {
    let count = curve.len();
    let (mx, my) = m.split_at(count);
    out.copy_from_slice(m);
    let (x, y) = out.split_at_mut(count);
    for ((row, x), y) in kernel.chunks_exact(count).zip(x).zip(y) {
        let terms = row.iter().zip(mx).zip(my);
        let [sum_x, sum_y] = terms
            .fold([0.0; 2], |[x, y], ((&[xx, xy, yy], mx), my)| [x + (xx * mx + xy * my), y + (xy * mx + yy * my)]);
        (*x, *y) = (*x + sum_x, *y + sum_y);
    }
    super::equation::growth(curve, 1.0, m, out);
}

#[cfg(test)]
mod tests;

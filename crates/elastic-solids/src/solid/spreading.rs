//! Forces of a solid on the fluid, spread over its triangles.

use motile_base::Vec2;

use crate::mesh::TriangleMesh;

/// Places in a triangle at which the fluid acts on it, by the shares of its corners: with equal weights they integrate
/// quadratic functions exactly.
const PLACES: [[f64; 3]; 3] = {
    let (most, least) = (2.0 / 3.0, 1.0 / 6.0);
    [[most, least, least], [least, most, least], [least, least, most]]
};

/// Square of the residual of the mass matrix over the square of the right-hand side at which its solution is taken.
const TOLERANCE: f64 = 1e-26;
/// Most iterations for it. The diagonal is within a factor of two of the matrix whatever the mesh, so that each takes
/// two thirds of the error away, and 27 are enough.
const MOST_ITERATIONS: usize = 40;

/// Forces on inner points spread over the triangles as the piecewise linear density g with `integral of N_i g = F_i`,
/// N_i the share of point i, and velocities of inner points as the velocities of the piecewise linear field nearest to
/// the velocity of the fluid.
///
/// Markers are the free points of the boundary, in increasing order, and then three places in each triangle that has an
/// inner point. With M the mass matrix of the reference state, i the inner points, b the points of the boundary and u
/// the velocity of the fluid,
///
/// ```text
/// M_ii g = F_i    F_b := F_b - M_bi g    M_ii V_i = integral of N_i u - M_ib V_b
/// ```
///
/// The second is the transposed of the first, so that forces give the same power on both sides; both are exact for
/// fields that are linear in space.
#[derive(Debug, Clone)]
pub(super) struct Spreading {
    /// Free points of the boundary, which are the first markers.
    pub(super) surface: Vec<usize>,
    /// Free points that are not on the boundary.
    inner: Vec<usize>,
    triangles: Vec<Part>,
    /// Diagonal of M_ii (length squared).
    diagonal: Vec<f64>,
    /// At all points: right-hand side, solution, direction and product with the mass matrix, kept between calls.
    residual: Vec<Vec2>,
    solution: Vec<Vec2>,
    direction: Vec<Vec2>,
    product: Vec<Vec2>,
}

/// A triangle with an inner point.
#[derive(Debug, Clone, Copy)]
struct Part {
    number: usize,
    points: [usize; 3],
    /// Reference area (length squared).
    area: f64,
}

impl Spreading {
    /// Creates the spreading over a mesh of which these points, in increasing order, are free.
    pub(super) fn new(mesh: &TriangleMesh, free: &[usize]) -> Self {
        let mut is_inner = mesh.inner_points();
        let surface: Vec<usize> = free.iter().copied().filter(|point| !is_inner[*point]).collect();
        let inner: Vec<usize> = free.iter().copied().filter(|point| is_inner[*point]).collect();
        // Pinned points have no velocity, wherever they are.
        is_inner.fill(false);
        inner.iter().for_each(|point| is_inner[*point] = true);
        let parts = mesh.triangles().iter().zip(mesh.areas()).enumerate();
        let parts = parts.map(|(number, (points, area))| Part { number, points: *points, area: *area });
        let triangles: Vec<Part> = parts.filter(|part| part.points.iter().any(|point| is_inner[*point])).collect();
        let mut diagonal = vec![0.0; is_inner.len()];
        for part in &triangles {
            part.points.iter().for_each(|point| diagonal[*point] += part.area / 6.0);
        }
        let zeros = vec![Vec2::ZERO; is_inner.len()];
        let [residual, solution, direction] = [zeros.clone(), zeros.clone(), zeros.clone()];
        Self { surface, inner, triangles, diagonal, residual, solution, direction, product: zeros }
    }

    /// Returns the number of markers.
    pub(super) fn marker_count(&self) -> usize {
        self.surface.len() + PLACES.len() * self.triangles.len()
    }

    /// Writes the positions of the markers (length) of the points given.
    pub(super) fn write_markers(&self, mesh: &TriangleMesh, positions: &[Vec2], markers: &mut [Vec2]) {
        let (surface, places) = markers.split_at_mut(self.surface.len());
        for (marker, &point) in surface.iter_mut().zip(&self.surface) {
            *marker = positions[point];
        }
        for (markers, part) in places.chunks_exact_mut(PLACES.len()).zip(&self.triangles) {
            let corners = mesh.raw_corners(part.number, positions);
            for (marker, shares) in markers.iter_mut().zip(&PLACES) {
                *marker = weighted(shares, &corners);
            }
        }
    }

    /// Adds the forces of the markers on the fluid (force), those on all points given.
    pub(super) fn add_forces(&mut self, forces: &[Vec2], markers: &mut [Vec2]) {
        self.residual.copy_from_slice(forces);
        self.solve();
        multiply(&self.triangles, &self.solution, &mut self.product);
        let (surface, places) = markers.split_at_mut(self.surface.len());
        for (marker, &point) in surface.iter_mut().zip(&self.surface) {
            *marker += forces[point] - self.product[point];
        }
        for (markers, part) in places.chunks_exact_mut(PLACES.len()).zip(&self.triangles) {
            let density = part.points.map(|point| self.solution[point]);
            for (marker, shares) in markers.iter_mut().zip(&PLACES) {
                *marker += weighted(shares, &density) * (part.area / PLACES.len() as f64);
            }
        }
    }

    /// Returns the velocities of all points (length per time), pinned ones at rest, given the velocities of the fluid
    /// at the markers.
    pub(super) fn velocities(&mut self, markers: &[Vec2]) -> &[Vec2] {
        let (surface, places) = markers.split_at(self.surface.len());
        self.direction.fill(Vec2::ZERO);
        for (&velocity, &point) in surface.iter().zip(&self.surface) {
            self.direction[point] = velocity;
        }
        multiply(&self.triangles, &self.direction, &mut self.product);
        for (residual, product) in self.residual.iter_mut().zip(&self.product) {
            *residual = -*product;
        }
        for (markers, part) in places.chunks_exact(PLACES.len()).zip(&self.triangles) {
            for (marker, shares) in markers.iter().zip(&PLACES) {
                for (&point, share) in part.points.iter().zip(shares) {
                    self.residual[point] += *marker * (share * part.area / PLACES.len() as f64);
                }
            }
        }
        self.solve();
        for (&velocity, &point) in surface.iter().zip(&self.surface) {
            self.solution[point] = velocity;
        }
        &self.solution
    }

    /// Solves M_ii x = r for the residual at inner points, by conjugate gradients with the diagonal; x is zero at other
    /// points.
    fn solve(&mut self) {
        self.solution.fill(Vec2::ZERO);
        self.direction.fill(Vec2::ZERO);
        let Self { inner, triangles, diagonal, residual, solution, direction, product, .. } = self;
        let norm = |residual: &[Vec2]| -> f64 {
            inner.iter().map(|&point| residual[point].length_squared() / diagonal[point]).sum()
        };
        inner.iter().for_each(|&point| direction[point] = residual[point] / diagonal[point]);
        let first = norm(residual);
        let mut now = first;
        for _ in 0..MOST_ITERATIONS {
            if now <= TOLERANCE * first {
                break;
            }
            multiply(triangles, direction, product);
            let step = now / inner.iter().map(|&point| direction[point].dot(product[point])).sum::<f64>();
            for &point in &*inner {
                solution[point] += step * direction[point];
                residual[point] -= step * product[point];
            }
            let next = norm(residual);
            for &point in &*inner {
                direction[point] = residual[point] / diagonal[point] + (next / now) * direction[point];
            }
            now = next;
        }
    }
}

/// Writes the product of the mass matrix of all points with `values`.
fn multiply(triangles: &[Part], values: &[Vec2], product: &mut [Vec2]) {
    product.fill(Vec2::ZERO);
    for Part { points, area, .. } in triangles {
        let sum: Vec2 = points.iter().map(|&point| values[point]).sum();
        for &point in points {
            product[point] += (sum + values[point]) * (area / 12.0);
        }
    }
}

fn weighted(shares: &[f64; 3], values: &[Vec2; 3]) -> Vec2 {
    shares.iter().zip(values).map(|(share, value)| *share * *value).sum()
}

#[cfg(test)]
mod tests;

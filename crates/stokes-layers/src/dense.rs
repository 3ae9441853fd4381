//! The double layer of curves given node by node, as a matrix with a transpose.
//!
//! Where the single layer comes from elsewhere, from a grid for instance, the velocities v on fluid interfaces follow
//! from those that the same forces have in a fluid of one viscosity: `A v = s`.

mod curve;
mod walls;

use input_checks::within;
use num_complex::Complex64;

use crate::{Forcing, Geometry, LayerError, Vec2, geometry::Images, gmres::dot, greens::StressKernel};
pub use curve::{Foot, NodeCurve};
use walls::DenseWalls;

const FOUR_PI: f64 = 4.0 * std::f64::consts::PI;
/// Relative size of the rows of images that are left out.
const TOLERANCE: f64 = 1e-6;
/// Most nodes of all curves: the matrix then takes 2.4 GB.
const MOST_NODES: usize = 10_000;

/// The matrix A of `A v = s` for the velocities v at the nodes of closed interfaces; s is the velocity times viscosity
/// that all forces have in a fluid of one viscosity:
///
/// ```text
/// A = H + K D,    K_(ia),(jb) = (1/4 pi) T_ab(X_j - X_i; n_j) w_j  -  (1/V) (X_j)_a (n_j)_b w_j
/// ```
///
/// H the viscosity outside of the curve of the node, D that inside less H, and V the area of a periodic box
/// (no such term in a channel, which has the stress of its walls instead). The diagonal blocks of K follow from the
/// exact identity that it takes a uniform velocity of a curve to zero, without curvatures. K is kept, not A, so that
/// nothing cancels where D is small.
///
/// A curve with less viscous fluid inside gets the mode of uniform growth, which incompressible flow does not have,
/// moved from the eigenvalue of the viscosity inside to the mean one.
///
/// Vectors have the x components of all nodes first, then the y components.
#[derive(Debug, Clone)]
pub struct DoubleLayerMatrix {
    kernel: StressKernel,
    images: Images,
    area: f64,
    walls: Option<DenseWalls>,
    nodes: usize,
    /// Symmetric blocks of K, row after row.
    blocks: [Vec<f64>; 3],
    /// Velocities times the contrast of their curve.
    scaled: Vec<f64>,
    dipoles: Vec<[f64; 3]>,
}

/// Products `T n` of a stress and a vector, (xx, xy, yy).
#[inline(always)]
fn contract([xxx, xxy, xyy, yyy]: &[f64; 4], n: Vec2) -> [f64; 3] {
    [xxx * n.x + xxy * n.y, xxy * n.x + xyy * n.y, xyy * n.x + yyy * n.y]
}

impl DoubleLayerMatrix {
    /// For a box or a channel, whose `middle` is at that height (length). Nodes closer to a wall than `least_gap`
    /// (length) count as that far away.
    ///
    /// # Errors
    /// The plane, for which there is no such matrix, or a region out of its range.
    pub fn new(geometry: Geometry, middle: f64, least_gap: f64) -> Result<Self, LayerError> {
        geometry.check()?;
        let walls = match geometry {
            Geometry::Plane => return Err(LayerError::NoPeriod),
            Geometry::Box { .. } => None,
            Geometry::Channel { length, width, forcing } => {
                Some(DenseWalls::new(length, width, middle, matches!(forcing, Forcing::Flux(_)), least_gap))
            }
        };
        let (images, area) = (geometry.images(), geometry.area());
        let kernel = StressKernel::new(&images, TOLERANCE);
        let (blocks, scaled, dipoles) = Default::default();
        Ok(Self { kernel, images, area, walls, nodes: 0, blocks, scaled, dipoles })
    }

    /// The shortest of the periodically equivalent distances.
    #[must_use]
    pub fn wrap(&self, d: Vec2) -> Vec2 {
        let d = self.images.wrap(Complex64::new(d.x, d.y));
        Vec2::new(d.re, d.im)
    }

    /// Computes K for curves whose nodes follow each other.
    ///
    /// # Errors
    /// More than 10,000 nodes.
    pub fn build(&mut self, curves: &[NodeCurve]) -> Result<(), LayerError> {
        let n = curves.iter().map(NodeCurve::len).sum();
        within("the number of nodes of a double layer", n as f64, 0.0, MOST_NODES as f64)?;
        self.nodes = n;
        if let Some(walls) = &mut self.walls {
            walls.load(curves);
        }
        for block in &mut self.blocks {
            block.resize(n * n, 0.0);
        }
        for target in curves {
            for source in curves {
                if target.first == source.first {
                    self.fill_own(target);
                } else {
                    self.fill_other(target, source);
                }
            }
        }
        Ok(())
    }

    /// Blocks between the nodes of one curve; the stress is odd in the distance.
    fn fill_own(&mut self, curve: &NodeCurve) {
        let (first, count, n) = (curve.first, curve.len(), self.nodes);
        let [xx, xy, yy] = &mut self.blocks;
        for i in 0..count {
            let row = (first + i) * n + first;
            // Above the diagonal from the kernel, below it by symmetry.
            self.kernel.stresses(curve.positions[i], &curve.sources, i + 1, |j, stress| {
                let here = contract(&stress, curve.normals[j] / FOUR_PI);
                let mirrored = contract(&stress, -curve.normals[i] / FOUR_PI);
                let column = (first + j) * n + first + i;
                [xx[row + j], xy[row + j], yy[row + j]] = here;
                [xx[column], xy[column], yy[column]] = mirrored;
            });
        }
        let background = curve.area / self.area;
        for i in 0..count {
            let row = (first + i) * n + first;
            for (block, diagonal) in [(&mut *xx, true), (&mut *xy, false), (&mut *yy, true)] {
                block[row + i] = 0.0;
                let sum: f64 = block[row..row + count].iter().sum();
                block[row + i] = if diagonal { background - sum } else { -sum };
            }
        }
    }

    fn fill_other(&mut self, target: &NodeCurve, source: &NodeCurve) {
        let n = self.nodes;
        let offset = self.wrap(target.centre - source.centre);
        let [xx, xy, yy] = &mut self.blocks;
        for (i, position) in target.positions.iter().enumerate() {
            let row = (target.first + i) * n + source.first;
            self.kernel.stresses(position + offset, &source.sources, 0, |j, stress| {
                [xx[row + j], xy[row + j], yy[row + j]] = contract(&stress, source.normals[j] / FOUR_PI);
            });
        }
    }

    /// `out = A v`.
    pub fn product(&mut self, curves: &[NodeCurve], v: &[f64], out: &mut [f64]) {
        let n = self.nodes;
        self.scale(curves, v);
        let (vx, vy) = self.scaled.split_at(n);
        let mean = self.mean(curves);
        let [xx, xy, yy] = &self.blocks;
        let (ux, uy) = out.split_at_mut(n);
        for curve in curves {
            for i in curve.first..curve.first + curve.len() {
                let row = i * n..(i + 1) * n;
                let mixed = &xy[row.clone()];
                ux[i] = curve.outside * v[i] + dot(&xx[row.clone()], vx) + dot(mixed, vy) + mean.x;
                uy[i] = curve.outside * v[n + i] + dot(mixed, vx) + dot(&yy[row], vy) + mean.y;
            }
        }
        for curve in curves.iter().filter(|curve| curve.contrast < 0.0) {
            let nodes = curve.first..curve.first + curve.len();
            let flux: f64 =
                nodes.clone().zip(&curve.normals).map(|(i, normal)| vx[i] * normal.x + vy[i] * normal.y).sum();
            let amount = growth(curve) * flux;
            for ((i, normal), w) in nodes.zip(&curve.normals).zip(&curve.weights) {
                ux[i] += amount * normal.x / w;
                uy[i] += amount * normal.y / w;
            }
        }
        if self.walls.is_some() {
            self.fill_dipoles(curves);
            let Some(walls) = &mut self.walls else { return };
            walls.add_dipoles(&self.dipoles, ux, uy);
        }
    }

    /// `out = K^T q`, so that `A^T q` is H q plus D times this.
    pub fn transposed_product(&mut self, curves: &[NodeCurve], q: &[f64], out: &mut [f64]) {
        let n = self.nodes;
        out.fill(0.0);
        let (qx, qy) = q.split_at(n);
        let (ux, uy) = out.split_at_mut(n);
        let [xx, xy, yy] = &self.blocks;
        for i in 0..n {
            let row = i * n..(i + 1) * n;
            let (a, b, c) = (&xx[row.clone()], &xy[row.clone()], &yy[row]);
            let (x, y) = (qx[i], qy[i]);
            for j in 0..n {
                ux[j] += a[j] * x + b[j] * y;
                uy[j] += b[j] * x + c[j] * y;
            }
        }
        let total = Vec2::new(qx.iter().sum(), qy.iter().sum());
        let background = 1.0 / self.area;
        for curve in curves {
            let nodes = curve.first..curve.first + curve.len();
            let growth = if curve.contrast < 0.0 {
                let unit = nodes.clone().zip(&curve.normals).zip(&curve.weights);
                growth(curve) * unit.map(|((i, n), w)| (qx[i] * n.x + qy[i] * n.y) / w).sum::<f64>()
            } else {
                0.0
            };
            for ((j, normal), position) in nodes.zip(&curve.normals).zip(&curve.positions) {
                let amount = growth - background * position.dot(total);
                ux[j] += amount * normal.x;
                uy[j] += amount * normal.y;
            }
        }
        if let Some(walls) = &mut self.walls {
            walls.add_tractions(curves, qx, qy, ux, uy);
        }
    }

    /// `D v`.
    fn scale(&mut self, curves: &[NodeCurve], v: &[f64]) {
        self.scaled.clear();
        self.scaled.extend_from_slice(v);
        for curve in curves {
            curve.entries(self.nodes).for_each(|i| self.scaled[i] *= curve.contrast);
        }
    }

    /// `-(1/V) sum D X (v.n) w` in a box.
    fn mean(&self, curves: &[NodeCurve]) -> Vec2 {
        let (n, v) = (self.nodes, &self.scaled);
        let mut sum = Vec2::ZERO;
        if self.area.is_infinite() {
            return sum;
        }
        for curve in curves {
            for (k, (x, normal)) in curve.positions.iter().zip(&curve.normals).enumerate() {
                let i = curve.first + k;
                sum -= (v[i] * normal.x + v[n + i] * normal.y) * x;
            }
        }
        sum / self.area
    }

    fn fill_dipoles(&mut self, curves: &[NodeCurve]) {
        let n = self.nodes;
        self.dipoles.clear();
        for curve in curves {
            for (k, normal) in curve.normals.iter().enumerate() {
                let [x, y] = [0, n].map(|component| self.scaled[component + curve.first + k] / FOUR_PI);
                self.dipoles.push([x * normal.x, x * normal.y + y * normal.x, y * normal.y]);
            }
        }
    }

    /// Part of the mean pressure gradient that comes from velocities on the nodes (force per volume).
    #[must_use]
    pub fn pressure_gradient(&mut self, curves: &[NodeCurve], v: &[f64]) -> f64 {
        self.scale(curves, v);
        self.fill_dipoles(curves);
        self.walls.as_mut().map_or(0.0, |walls| -walls.pressure_gradient(&self.dipoles))
    }
}

/// What the flux of a curve with less viscous fluid inside is multiplied by: brings the eigenvalue of its growth to the
/// mean viscosity.
fn growth(curve: &NodeCurve) -> f64 {
    -0.5 / curve.perimeter()
}

#[cfg(test)]
mod tests;

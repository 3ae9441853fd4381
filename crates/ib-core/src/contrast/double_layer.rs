//! The double layer of all droplets as a matrix.

use crate::Vec2;

use super::droplet::Droplet;
use super::gmres::dot;
use super::images::Images;
use super::rigid_walls::RigidWalls;
use super::stress::{Stress, StressKernel};

const FOUR_PI: f64 = 4.0 * std::f64::consts::PI;

/// The matrix A of `A v = s`, s the velocity times viscosity that all forces have in a fluid of one viscosity:
///
/// ```text
/// A_(ia),(jb) = (D_j/4 pi) T_ab(X_j - X_i; n_j) w_j  -  (D_j/V) (X_j)_a (n_j)_b w_j
/// ```
///
/// D the viscosity inside less that of the surroundings, V the area of a periodic box (no such term in a channel, which
/// has the stress of its walls instead). The diagonal blocks follow from the exact identity that a uniform velocity on
/// a droplet is multiplied by the viscosity of the surroundings, without curvatures.
///
/// A droplet thinner than its surroundings gets the mode of uniform growth, which incompressible flow does not have,
/// moved from the eigenvalue of the viscosity inside to the mean one.
///
/// Vectors have the x components of all nodes first, then the y components.
#[derive(Debug)]
pub(crate) struct DoubleLayer {
    kernel: StressKernel,
    images: Images,
    walls: Option<RigidWalls>,
    viscosity: f64,
    nodes: usize,
    /// Symmetric blocks, row after row.
    blocks: [Vec<f64>; 3],
    dipoles: Vec<[f64; 3]>,
}

/// Products `T n` of a stress and a vector, (xx, xy, yy).
#[inline(always)]
fn contract(t: &Stress, n: Vec2) -> [f64; 3] {
    [t.xxx * n.x + t.xxy * n.y, t.xxy * n.x + t.xyy * n.y, t.xyy * n.x + t.yyy * n.y]
}

impl DoubleLayer {
    pub(crate) fn new(images: Images, walls: Option<RigidWalls>, viscosity: f64) -> Self {
        let kernel = StressKernel::new(images.along, images.across);
        Self { kernel, images, walls, viscosity, nodes: 0, blocks: Default::default(), dipoles: Vec::new() }
    }

    pub(crate) fn kernel(&self) -> &StressKernel {
        &self.kernel
    }

    pub(crate) fn images(&self) -> &Images {
        &self.images
    }

    /// Computes the matrix for the present shapes.
    pub(crate) fn build(&mut self, droplets: &[Droplet]) {
        self.place(droplets);
        let n = self.nodes;
        for block in &mut self.blocks {
            block.resize(n * n, 0.0);
        }
        for target in droplets {
            for source in droplets {
                if target.first == source.first {
                    self.fill_own(target);
                } else {
                    self.fill_other(target, source);
                }
            }
        }
    }

    /// Takes over the nodes of the present shapes.
    pub(crate) fn place(&mut self, droplets: &[Droplet]) {
        self.nodes = droplets.iter().map(Droplet::nodes).sum();
        if let Some(walls) = &mut self.walls {
            walls.load(droplets);
        }
    }

    /// Blocks between the nodes of one droplet; the stress is odd in the distance.
    fn fill_own(&mut self, droplet: &Droplet) {
        let (first, count, n) = (droplet.first, droplet.nodes(), self.nodes);
        let scale = droplet.contrast / FOUR_PI;
        let [xx, xy, yy] = &mut self.blocks;
        for i in 0..count {
            let row = (first + i) * n + first;
            // Above the diagonal from the kernel, below it by symmetry.
            if i + 1 < count {
                let target = self.kernel.target(droplet.positions[i]);
                self.kernel.sum(&target, &droplet.sources, i + 1);
                for j in i + 1..count {
                    let t = self.kernel.stress(j - i - 1);
                    let here = contract(&t, scale * droplet.normals[j]);
                    let mirrored = contract(&t, -scale * droplet.normals[i]);
                    let column = (first + j) * n + first + i;
                    (xx[row + j], xy[row + j], yy[row + j]) = (here[0], here[1], here[2]);
                    (xx[column], xy[column], yy[column]) = (mirrored[0], mirrored[1], mirrored[2]);
                }
            }
        }
        let background = self.images.area().map_or(0.0, |area| droplet.contrast * droplet.area / area);
        for i in 0..count {
            let row = (first + i) * n + first;
            for (block, diagonal) in [(&mut *xx, true), (&mut *xy, false), (&mut *yy, true)] {
                block[row + i] = 0.0;
                let sum: f64 = block[row..row + count].iter().sum();
                block[row + i] = if diagonal { self.viscosity + background - sum } else { -sum };
            }
        }
    }

    fn fill_other(&mut self, target: &Droplet, source: &Droplet) {
        let n = self.nodes;
        let scale = source.contrast / FOUR_PI;
        let offset = self.images.wrap(target.centre - source.centre);
        let [xx, xy, yy] = &mut self.blocks;
        for (i, position) in target.positions.iter().enumerate() {
            let at = self.kernel.target(position + offset);
            self.kernel.sum(&at, &source.sources, 0);
            let row = (target.first + i) * n + source.first;
            for (j, normal) in source.normals.iter().enumerate() {
                let block = contract(&self.kernel.stress(j), scale * normal);
                (xx[row + j], xy[row + j], yy[row + j]) = (block[0], block[1], block[2]);
            }
        }
    }

    /// `out = A v`.
    pub(crate) fn product(&mut self, droplets: &[Droplet], v: &[f64], out: &mut [f64]) {
        let n = self.nodes;
        let (vx, vy) = v.split_at(n);
        let (ux, uy) = out.split_at_mut(n);
        let mean = self.mean(droplets, v);
        let [xx, xy, yy] = &self.blocks;
        for i in 0..n {
            let row = i * n..(i + 1) * n;
            let mixed = &xy[row.clone()];
            ux[i] = dot(&xx[row.clone()], vx) + dot(mixed, vy) + mean.x;
            uy[i] = dot(mixed, vx) + dot(&yy[row], vy) + mean.y;
        }
        for droplet in droplets.iter().filter(|droplet| droplet.contrast < 0.0) {
            let nodes = droplet.first..droplet.first + droplet.nodes();
            let flux: f64 =
                nodes.clone().zip(&droplet.normals).map(|(i, normal)| vx[i] * normal.x + vy[i] * normal.y).sum();
            let amount = growth(droplet) * flux;
            for ((i, normal), w) in nodes.zip(&droplet.normals).zip(&droplet.weights) {
                ux[i] += amount * normal.x / w;
                uy[i] += amount * normal.y / w;
            }
        }
        if self.walls.is_some() {
            self.fill_dipoles(droplets, v);
            let Some(walls) = &mut self.walls else { return };
            walls.add_dipoles(&self.dipoles, ux, uy);
        }
    }

    /// `out = A^T q`.
    pub(crate) fn transposed_product(&mut self, droplets: &[Droplet], q: &[f64], out: &mut [f64]) {
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
        let background = self.images.area().map_or(0.0, |area| 1.0 / area);
        for droplet in droplets {
            let nodes = droplet.first..droplet.first + droplet.nodes();
            let growth = if droplet.contrast < 0.0 {
                let unit = nodes.clone().zip(&droplet.normals).zip(&droplet.weights);
                growth(droplet) * unit.map(|((i, n), w)| (qx[i] * n.x + qy[i] * n.y) / w).sum::<f64>()
            } else {
                0.0
            };
            for ((j, normal), position) in nodes.zip(&droplet.normals).zip(&droplet.positions) {
                let amount = growth - droplet.contrast * background * position.dot(&total);
                ux[j] += amount * normal.x;
                uy[j] += amount * normal.y;
            }
        }
        if let Some(walls) = &mut self.walls {
            walls.add_tractions(droplets, qx, qy, ux, uy);
        }
    }

    /// `-(1/V) sum D X (v.n) w` in a box.
    fn mean(&self, droplets: &[Droplet], v: &[f64]) -> Vec2 {
        let Some(area) = self.images.area() else { return Vec2::zeros() };
        let n = self.nodes;
        let mut sum = Vec2::zeros();
        for droplet in droplets {
            for (k, (x, normal)) in droplet.positions.iter().zip(&droplet.normals).enumerate() {
                let i = droplet.first + k;
                sum -= droplet.contrast * (v[i] * normal.x + v[n + i] * normal.y) * x;
            }
        }
        sum / area
    }

    fn fill_dipoles(&mut self, droplets: &[Droplet], v: &[f64]) {
        let n = self.nodes;
        self.dipoles.clear();
        for droplet in droplets {
            let scale = droplet.contrast / FOUR_PI;
            for (k, normal) in droplet.normals.iter().enumerate() {
                let (x, y) = (v[droplet.first + k], v[n + droplet.first + k]);
                self.dipoles.push([scale * x * normal.x, scale * (x * normal.y + y * normal.x), scale * y * normal.y]);
            }
        }
    }

    /// Part of the mean pressure gradient that comes from velocities on the nodes (force per volume).
    pub(crate) fn pressure_gradient(&mut self, droplets: &[Droplet], v: &[f64]) -> f64 {
        self.fill_dipoles(droplets, v);
        self.walls.as_mut().map_or(0.0, |walls| -walls.pressure_gradient(&self.dipoles))
    }
}

/// What the flux of a thin droplet is multiplied by: brings the eigenvalue of its growth to the mean viscosity.
fn growth(droplet: &Droplet) -> f64 {
    -0.5 * droplet.contrast / droplet.weights.iter().sum::<f64>()
}

#[cfg(test)]
mod tests;

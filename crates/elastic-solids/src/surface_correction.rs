//! Putting back the mobility that the grid takes from the surface of a solid.

use ib_core::{MobilityDeficit, Vec2};

use crate::TriangleMesh;

/// The mobility correction of a solid's surface.
///
/// On the surface the elastic stress jumps by the traction, and with it the velocity gradient of the fluid. Spreading
/// and interpolation smear that kink: where the traction is f_t per length along the surface, points at the distance d
/// from it miss the velocity
/// ```text
/// (h/eta) phi(d/h) f_t,    phi(s) = 1/2 (E|s + Z| - |s|),    phi(0) = G_t(0)
/// ```
/// with a random number Z that stands for the kernels and the grid (a cubic B-spline for the default kernel, whose
/// phi(0) is 7/30), and the deficit G_t of a flat interface ([`MobilityDeficit`]). Without it the velocity has an error
/// of first order in h: a stiff wall stops the fluid about 0.3 to 0.6 h inside the channel.
#[derive(Debug, Clone)]
pub(crate) struct SurfaceCorrection {
    vertices: Vec<Vertex>,
    /// Tangents of the reference state.
    tangents: Vec<Vec2>,
    /// phi(0) at vertices by their tangent.
    deficits: Vec<f64>,
    near: Vec<Near>,
    /// Grid spacing that `near` is made for.
    spacing: f64,
    /// Viscosity of the last evaluation.
    viscosity: f64,
    tractions: Vec<f64>,
    smoothed: Vec<f64>,
    /// How often the tractions are averaged over neighbours.
    passes: usize,
    slips: Vec<Vec2>,
}

/// A point of the surface between its neighbours along it.
#[derive(Debug, Clone, Copy)]
struct Vertex {
    point: usize,
    /// Itself and its neighbours, as places in the list of vertices.
    own: usize,
    before: usize,
    after: usize,
    /// What to add to the vector from the neighbour before to the one after, across the seam of a periodic mesh.
    shift: f64,
    pinned: bool,
}

/// A point next to the surface.
#[derive(Debug, Clone, Copy)]
struct Near {
    /// Place among the free points.
    marker: usize,
    /// The edge nearest to it, by its first vertex, and where along it.
    vertex: usize,
    fraction: f64,
    /// phi at its distance.
    weight: f64,
}

/// How often tractions are averaged with those of their neighbours, (1, 2, 1)/4, where the points are one grid spacing
/// apart. The deficit falls with the wave number q along the surface; four times make it `exp(-(q h)^2)`, which is near
/// enough where it matters, for q h up to 0.5, and the least that does not make nearly incompressible solids (kappa =
/// 20 mu) stiffer.
const SMOOTHING: f64 = 4.0;

/// phi(0) of the shape below.
const SHAPE_AT_ZERO: f64 = 7.0 / 30.0;

/// phi(s) for a cubic B-spline: its second derivative is the spline, its slope at 0 is -1/2, and it ends at 2.
fn shape(s: f64) -> f64 {
    if s < 1.0 {
        SHAPE_AT_ZERO + s * (-0.5 + s * (1.0 / 3.0 + s * s * (-1.0 / 12.0 + s / 40.0)))
    } else if s < 2.0 {
        (2.0 - s).powi(5) / 120.0
    } else {
        0.0
    }
}

impl SurfaceCorrection {
    /// For the free points of a mesh; parts of the surface that are pinned have no traction.
    pub(crate) fn new(mesh: &TriangleMesh, free: &[usize], deficit: &MobilityDeficit) -> Self {
        let mut vertices = Vec::new();
        for boundary in mesh.boundary_loops() {
            let (start, count) = (vertices.len(), boundary.points.len());
            for (k, &point) in boundary.points.iter().enumerate() {
                let (before, after) = ((k + count - 1) % count, (k + 1) % count);
                let span = nearest_step(mesh, boundary.points[before], point)
                    + nearest_step(mesh, point, boundary.points[after]);
                let shift = span.x - (mesh.points()[boundary.points[after]] - mesh.points()[boundary.points[before]]).x;
                vertices.push(Vertex {
                    point,
                    own: start + k,
                    before: start + before,
                    after: start + after,
                    shift,
                    pinned: false,
                });
            }
        }
        let count = vertices.len();
        let mut correction = Self {
            tangents: vec![Vec2::zeros(); count],
            deficits: vec![0.0; count],
            near: Vec::new(),
            spacing: 0.0,
            viscosity: 0.0,
            tractions: vec![0.0; count],
            smoothed: vec![0.0; count],
            passes: 0,
            slips: vec![Vec2::zeros(); count],
            vertices,
        };
        let flat = deficit.at(0.0);
        for k in 0..count {
            let tangent = correction.span(k, mesh.points()).try_normalize(0.0).unwrap_or_else(Vec2::zeros);
            let z = tangent.x.powi(4) + tangent.y.powi(4) - 0.75;
            let missing =
                flat.tangential + flat.tangential_slope * z + flat.tangential_curvature * (32.0 * z * z - 1.0);
            correction.tangents[k] = tangent;
            correction.deficits[k] = missing.max(0.0);
        }
        correction.with_free(free)
    }

    /// The same for other free points.
    pub(crate) fn with_free(mut self, free: &[usize]) -> Self {
        for vertex in &mut self.vertices {
            vertex.pinned = free.binary_search(&vertex.point).is_err();
        }
        self.near.clear();
        self.spacing = 0.0;
        self
    }

    /// From the neighbour before a vertex to the one after.
    fn span(&self, vertex: usize, positions: &[Vec2]) -> Vec2 {
        let Vertex { before, after, shift, .. } = self.vertices[vertex];
        let span = positions[self.vertices[after].point] - positions[self.vertices[before].point];
        span + Vec2::new(shift, 0.0)
    }

    /// Takes the fluid over; finds the points next to the surface for a new grid spacing.
    pub(crate) fn prepare(&mut self, mesh: &TriangleMesh, free: &[usize], viscosity: f64, spacing: Option<f64>) {
        self.viscosity = viscosity;
        let spacing = spacing.unwrap_or(0.0);
        if self.spacing == spacing {
            return;
        }
        self.spacing = spacing;
        self.near.clear();
        if spacing > 0.0 {
            let lengths = (0..self.vertices.len()).map(|k| 0.5 * self.span(k, mesh.points()).norm());
            let edge = lengths.sum::<f64>() / self.vertices.len() as f64;
            self.passes = (SMOOTHING * (spacing / edge).powi(2)).round().max(1.0) as usize;
            let found =
                free.iter().enumerate().filter_map(|(marker, &point)| self.find(mesh, marker, mesh.points()[point]));
            self.near = found.collect();
        }
    }

    /// The edge of the surface nearest to a point, if the point is within its reach.
    fn find(&self, mesh: &TriangleMesh, marker: usize, place: Vec2) -> Option<Near> {
        let mut nearest: Option<(f64, usize, f64)> = None;
        for (k, vertex) in self.vertices.iter().enumerate() {
            if vertex.pinned && self.vertices[vertex.after].pinned {
                continue;
            }
            let mut from = place - mesh.points()[vertex.point];
            if let Some(period) = mesh.period() {
                from.x -= period * (from.x / period).round();
            }
            let edge = nearest_step(mesh, vertex.point, self.vertices[vertex.after].point);
            let fraction = (from.dot(&edge) / edge.norm_squared()).clamp(0.0, 1.0);
            let distance = (from - edge * fraction).norm();
            if nearest.is_none_or(|(least, ..)| distance < least) {
                nearest = Some((distance, k, fraction));
            }
        }
        let (distance, vertex, fraction) = nearest?;
        let after = self.vertices[vertex].after;
        let deficit = self.deficits[vertex] * (1.0 - fraction) + self.deficits[after] * fraction;
        // The shape of another kernel is as much wider as its deficit is larger; the slope at 0 is that of the kink.
        let scale = deficit / SHAPE_AT_ZERO;
        let weight = if scale > 0.0 { scale * shape(distance / (self.spacing * scale)) } else { 0.0 };
        (weight > 0.0).then_some(Near { marker, vertex, fraction, weight })
    }

    /// Adds the missing velocities (length per time) to the rates of the free points, for the present positions
    /// (length) and forces (force) of all points.
    pub(crate) fn add(&mut self, positions: &[Vec2], forces: &[Vec2], rate: &mut [f64]) {
        if self.near.is_empty() {
            return;
        }
        for (k, vertex) in self.vertices.iter().enumerate() {
            let span = self.span(k, positions);
            let length = span.norm();
            let along = if length > 0.0 { span / length } else { Vec2::zeros() };
            self.tangents[k] = along;
            let pulled = !vertex.pinned && length > 0.0;
            self.tractions[k] = if pulled { forces[vertex.point].dot(&along) / (0.5 * length) } else { 0.0 };
        }
        for _ in 0..self.passes {
            for (smooth, vertex) in self.smoothed.iter_mut().zip(&self.vertices) {
                let [before, here, after] = [vertex.before, vertex.own, vertex.after].map(|k| self.tractions[k]);
                *smooth = 0.5 * here + 0.25 * (before + after);
            }
            std::mem::swap(&mut self.smoothed, &mut self.tractions);
        }
        for ((slip, along), traction) in self.slips.iter_mut().zip(&self.tangents).zip(&self.tractions) {
            *slip = along * (traction * self.spacing / self.viscosity);
        }
        for near in &self.near {
            let after = self.vertices[near.vertex].after;
            let slip = self.slips[near.vertex].lerp(&self.slips[after], near.fraction) * near.weight;
            rate[2 * near.marker] += slip.x;
            rate[2 * near.marker + 1] += slip.y;
        }
    }
}

/// From a point of the surface to the next, in the reference state.
fn nearest_step(mesh: &TriangleMesh, from: usize, to: usize) -> Vec2 {
    let mut step = mesh.points()[to] - mesh.points()[from];
    if let Some(period) = mesh.period() {
        step.x -= period * (step.x / period).round();
    }
    step
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_shape_is_the_mean_distance_from_a_spline() {
        // phi(s) = 1/2 (E|s + Z| - |s|) by quadrature over the cubic B-spline.
        let spline = |z: f64| {
            let a = z.abs();
            if a < 1.0 { 2.0 / 3.0 - a * a + 0.5 * a * a * a } else { (2.0 - a).powi(3) / 6.0 }
        };
        for s in [0.0, 0.3, 0.9, 1.0, 1.4, 2.0, 2.5] {
            let steps = 40_000;
            let mean: f64 = (0..steps)
                .map(|k| 4.0 * (f64::from(k) + 0.5) / f64::from(steps) - 2.0)
                .map(|z| spline(z) * (s + z).abs() * 4.0 / f64::from(steps))
                .sum();
            assert!((shape(s) - 0.5 * (mean - s)).abs() < 1e-8, "{s}");
        }
    }

    #[test]
    fn the_deficit_of_the_default_kernel_is_that_of_the_shape() {
        let flat = MobilityDeficit::new(&ib_core::CubicQuadratic::default()).at(0.0);
        let along_the_grid = flat.tangential + 0.25 * flat.tangential_slope + flat.tangential_curvature;
        assert!((along_the_grid - SHAPE_AT_ZERO).abs() < 2e-3, "{along_the_grid}");
    }
}

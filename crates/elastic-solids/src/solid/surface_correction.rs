//! Putting back the mobility that the grid takes from the surface of a solid.

use std::sync::Arc;

use ib_core::input::within;
use ib_core::{Discretisation, MobilityDeficit, Vec2};

use crate::solid::rounded_kink::{Beside, RoundedKink};
use crate::{SolidError, TriangleMesh};

/// The mobility correction of a solid's surface.
///
/// On the surface the elastic stress jumps by the traction, and with it the velocity gradient of the fluid. Spreading
/// and interpolation round that kink off; without the correction the velocity has an error of first order in h, and a
/// stiff wall stops the fluid about 0.3 to 0.6 h inside the channel. With D the flow beside a missing velocity along
/// the surface ([`RoundedKink`]) the points move, besides with the fluid, with
/// ```text
/// V = (h/eta) D G^(1/2) P l^-1 P G^(1/2) D^T F
/// ```
/// where D^T F are the forces F of the points as they work on the surface, l the lengths of its edges, P an average
/// over neighbours, and G the deficit G_t of a flat interface ([`MobilityDeficit::flat`]) over what D has on the
/// surface. D has no divergence: else surfaces are compressed for as long as forces vary along them, by what no flow
/// undoes (0.015 R0 at k = 1e6 and h = 0.1). The operator is symmetric and positive, as reciprocity asks: it takes
/// energy in any state. With the force of the surface's points in place of D^T F soft surfaces fold.
#[derive(Debug, Clone)]
pub(crate) struct SurfaceCorrection {
    vertices: Vec<Vertex>,
    /// Of the kernel in use.
    deficit: Arc<MobilityDeficit>,
    /// G_t(0) at vertices, by their tangent in the reference state.
    flat: Vec<f64>,
    /// The square root of what is missing where the vertices are now, zero where they are pinned.
    roots: Vec<f64>,
    near: Vec<Near>,
    /// Of the grid.
    spacing: f64,
    /// How often forces, and then missing velocities, are averaged over neighbours.
    passes: usize,
    /// The edges that begin at the vertices as they are now.
    edges: Vec<Edge>,
    /// How the surface runs at the vertices, averaged over neighbours.
    bends: Vec<Bend>,
    /// Beside the edges.
    kinks: Vec<RoundedKink>,
    /// Where the points of `near` are now.
    feet: Vec<Foot>,
    /// Missing along the surface at vertices (length per time).
    missing: Vec<f64>,
    /// Its slope (1/time).
    slopes: Vec<f64>,
    /// For averages.
    directions: Vec<Vec2>,
    scratch: Vec<f64>,
}

/// A point of the surface between its neighbours along it.
#[derive(Debug, Clone, Copy)]
struct Vertex {
    point: usize,
    /// Itself and its neighbours, as places in the list of vertices.
    own: usize,
    before: usize,
    after: usize,
    pinned: bool,
}

/// A point near the surface, as a place among the free points, and the vertex at which the edge begins that is nearest
/// in the reference state.
#[derive(Debug, Clone, Copy)]
struct Near {
    marker: usize,
    vertex: usize,
}

/// A straight piece of the surface.
#[derive(Debug, Clone, Copy)]
struct Edge {
    from: Vec2,
    tangent: Vec2,
    length: f64,
}

/// How the surface runs at a vertex.
#[derive(Debug, Clone, Copy, Default)]
struct Bend {
    /// Unit tangent.
    tangent: Vec2,
    /// Positive where it turns to the left of the tangent (1/length).
    curvature: f64,
}

/// The place of the surface nearest to a point.
#[derive(Debug, Clone, Copy)]
struct Foot {
    vertex: usize,
    fraction: f64,
    /// `None` where the point has come out of reach.
    beside: Option<Beside>,
}

/// How often both together are averaged, (1, 2, 1)/4, where the points are one grid spacing apart. The deficit falls
/// with the wave number q along the surface; four times make it `exp(-(q h)^2)`, which is near enough where it matters,
/// for q h up to 0.5.
const SMOOTHING: f64 = 4.0;

/// Largest grid spacing over the mean edge of the surface; averages take its square.
const COARSEST: f64 = 50.0;

/// Edges along which the nearest one is looked for.
const FARTHEST: usize = 100;

impl SurfaceCorrection {
    /// For the free points of a mesh and the kernel and grid of a flow; parts of the surface that are pinned have no
    /// traction.
    ///
    /// # Errors
    /// A flow without a grid; a mesh much finer than the grid.
    pub(crate) fn new(
        mesh: &TriangleMesh,
        free: &[usize],
        discretisation: &Discretisation,
    ) -> Result<Self, SolidError> {
        let (Some(spacing), Some(deficit)) = (discretisation.spacing, &discretisation.mobility_deficit) else {
            return Err(SolidError::Unsupported {
                what: "correcting the surface of a solid in a flow without a grid",
                remedy: "use a grid, or leave the correction out",
            });
        };
        let mut vertices = Vec::new();
        let mut flat = Vec::new();
        for boundary in mesh.boundary_loops() {
            let (start, count) = (vertices.len(), boundary.points.len());
            for (k, &point) in boundary.points.iter().enumerate() {
                let (before, after) = ((k + count - 1) % count, (k + 1) % count);
                let span = nearest_step(mesh, boundary.points[before], point)
                    + nearest_step(mesh, point, boundary.points[after]);
                flat.push(deficit.flat(span.normalize_or_zero()));
                vertices.push(Vertex {
                    point,
                    own: start + k,
                    before: start + before,
                    after: start + after,
                    pinned: free.binary_search(&point).is_err(),
                });
            }
        }
        let count = vertices.len();
        let mut correction = Self {
            deficit: Arc::clone(deficit),
            flat,
            roots: vec![0.0; count],
            near: Vec::new(),
            spacing,
            passes: 0,
            edges: vec![Edge { from: Vec2::ZERO, tangent: Vec2::ZERO, length: 0.0 }; count],
            bends: vec![Bend::default(); count],
            kinks: Vec::new(),
            feet: Vec::new(),
            missing: vec![0.0; count],
            slopes: vec![0.0; count],
            directions: vec![Vec2::ZERO; count],
            scratch: vec![0.0; count],
            vertices,
        };
        correction.find_edges(mesh, mesh.points());
        let edge = correction.edges.iter().map(|edge| edge.length).sum::<f64>() / count as f64;
        let coarseness = within("the grid spacing over that of a corrected surface", spacing / edge, 0.0, COARSEST)?;
        correction.passes = (0.5 * SMOOTHING * coarseness.powi(2)).round().max(1.0) as usize;
        correction.find_near(mesh, free);
        Ok(correction)
    }

    /// Whether it is made for this flow.
    pub(crate) fn suits(&self, discretisation: &Discretisation) -> bool {
        discretisation.spacing == Some(self.spacing)
            && discretisation.mobility_deficit.as_ref().is_some_and(|deficit| Arc::ptr_eq(deficit, &self.deficit))
    }

    /// Finds the points near the surface.
    fn find_near(&mut self, mesh: &TriangleMesh, free: &[usize]) {
        let found = free.iter().enumerate();
        let found = found.filter_map(|(marker, &point)| self.find(mesh, marker, mesh.points()[point]));
        let feet: Vec<(Near, f64)> = found.collect();
        // The deepest point of a solid is half as deep as the solid is thick.
        let room = feet.iter().map(|(_, depth)| depth / self.spacing).fold(0.0, f64::max);
        let deficit = |vertex: &Vertex| 0.5 * (self.flat[vertex.own] + self.flat[vertex.after]);
        self.kinks = self.vertices.iter().map(|vertex| RoundedKink::new(deficit(vertex), room)).collect();
        let reaches = |(near, depth): &(Near, f64)| *depth < self.spacing * self.kinks[near.vertex].reach();
        self.near = feet.into_iter().filter(reaches).map(|(near, _)| near).collect();
        self.feet = vec![Foot { vertex: 0, fraction: 0.0, beside: None }; self.near.len()];
    }

    /// The edge of the surface nearest to a point of the reference state, and how far away it is (length).
    fn find(&self, mesh: &TriangleMesh, marker: usize, place: Vec2) -> Option<(Near, f64)> {
        let free = self.vertices.iter().filter(|vertex| !(vertex.pinned && self.vertices[vertex.after].pinned));
        let distances = free.map(|vertex| (vertex.own, self.away(vertex.own, place, mesh.period()).0.length()));
        let nearest = distances.fold(None, |nearest: Option<(usize, f64)>, this| match nearest {
            Some(least) if least.1 <= this.1 => nearest,
            _ => Some(this),
        });
        nearest.map(|(vertex, distance)| (Near { marker, vertex }, distance))
    }

    /// Takes over where the surface is.
    fn find_edges(&mut self, mesh: &TriangleMesh, positions: &[Vec2]) {
        for (edge, vertex) in self.edges.iter_mut().zip(&self.vertices) {
            let from = positions[vertex.point];
            let along = wrapped(positions[self.vertices[vertex.after].point] - from, mesh.period());
            let length = along.length();
            *edge = Edge { from, tangent: if length > 0.0 { along / length } else { Vec2::ZERO }, length };
        }
    }

    /// Takes over how it runs. The flow beside it has no divergence only if directions change along it steadily.
    fn find_bends(&mut self) {
        for vertex in &self.vertices {
            let [before, after] = [self.edges[vertex.before], self.edges[vertex.own]];
            let sum = before.tangent * before.length + after.tangent * after.length;
            self.bends[vertex.own].tangent = sum.normalize_or_zero();
        }
        for vertex in &self.vertices {
            let [before, here, after] = [vertex.before, vertex.own, vertex.after].map(|k| self.bends[k].tangent);
            self.directions[vertex.own] = (before + 2.0 * here + after).normalize_or_zero();
        }
        for vertex in &self.vertices {
            let turn = self.directions[vertex.before].perp_dot(self.directions[vertex.after]);
            let curvature = turn * self.inverse_span(vertex);
            self.bends[vertex.own] = Bend { tangent: self.directions[vertex.own], curvature };
        }
    }

    /// The vector to a point from the nearest place of an edge, and where along the edge that is.
    fn away(&self, vertex: usize, point: Vec2, period: Option<f64>) -> (Vec2, f64) {
        let Edge { from, tangent, length } = self.edges[vertex];
        let away = wrapped(point - from, period);
        let along = away.dot(tangent).clamp(0.0, length);
        (away - tangent * along, if length > 0.0 { along / length } else { 0.0 })
    }

    /// The place of the surface nearest to a point now, from one edge on: a sheared solid carries its points far along
    /// its surface.
    fn foot(&self, mut vertex: usize, point: Vec2, period: Option<f64>) -> Foot {
        let (mut away, mut fraction) = self.away(vertex, point, period);
        for _ in 0..FARTHEST {
            let Vertex { before, after, .. } = self.vertices[vertex];
            let next = if fraction <= 0.0 {
                before
            } else if fraction >= 1.0 {
                after
            } else {
                break;
            };
            let there = self.away(next, point, period);
            if there.0.length_squared() >= away.length_squared() {
                break;
            }
            (vertex, (away, fraction)) = (next, there);
        }
        let [first, second] = [self.bends[vertex], self.bends[self.vertices[vertex].after]];
        let tangent = first.tangent.lerp(second.tangent, fraction).normalize_or_zero();
        let curvature = first.curvature + fraction * (second.curvature - first.curvature);
        let beside = self.kinks[vertex].beside(away, tangent, curvature, self.spacing);
        Foot { vertex, fraction, beside }
    }

    /// What is missing at the vertices: the deficit of an interface of their direction and, where the surface runs
    /// along the grid, the first grid harmonic ([`MobilityDeficit::harmonic`]), which follows their place between the
    /// grid lines.
    fn find_roots(&mut self, origin: [f64; 2]) {
        for (root, vertex) in self.roots.iter_mut().zip(&self.vertices) {
            let Edge { from, tangent, .. } = self.edges[vertex.own];
            let harmonic = |across: usize| {
                // An inclined surface passes from line to line at this wave number.
                let amplitude = self.deficit.harmonic(std::f64::consts::PI * tangent[across]);
                let place = (from[across] - origin[across]) / self.spacing;
                if amplitude == 0.0 { 0.0 } else { 2.0 * amplitude * (std::f64::consts::TAU * place).cos() }
            };
            let missing = self.flat[vertex.own] - harmonic(0) - harmonic(1);
            *root = if vertex.pinned { 0.0 } else { missing.max(0.0).sqrt() };
        }
    }

    /// Finds the missing velocities for the present positions (length) and forces (force) of all points.
    pub(crate) fn update(
        &mut self,
        mesh: &TriangleMesh,
        free: &[usize],
        discretisation: &Discretisation,
        positions: &[Vec2],
        forces: &[Vec2],
    ) {
        if self.near.is_empty() {
            return;
        }
        self.find_edges(mesh, positions);
        self.find_bends();
        self.find_roots(discretisation.domain.origin);
        self.missing.fill(0.0);
        self.slopes.fill(0.0);
        let mut feet = std::mem::take(&mut self.feet);
        for (foot, near) in feet.iter_mut().zip(&self.near) {
            let point = free[near.marker];
            *foot = self.foot(near.vertex, positions[point], mesh.period());
        }
        self.feet = feet;
        for (Foot { vertex, fraction, beside }, near) in self.feet.iter().zip(&self.near) {
            if let Some(beside) = beside {
                let after = self.vertices[*vertex].after;
                let [along, across] = beside.work(forces[free[near.marker]]);
                for (at, share) in [(*vertex, 1.0 - fraction), (after, *fraction)] {
                    self.missing[at] += share * along;
                    self.slopes[at] += share * across;
                }
            }
        }
        for vertex in &self.vertices {
            let change = self.slopes[vertex.own] * self.inverse_span(vertex);
            self.missing[vertex.after] += change;
            self.missing[vertex.before] -= change;
        }
        self.weigh(1.0);
        self.smooth();
        for vertex in &self.vertices {
            self.missing[vertex.own] *= 2.0 * self.inverse_span(vertex);
        }
        self.smooth();
        self.weigh(self.spacing / discretisation.viscosity);
        for (slope, vertex) in self.slopes.iter_mut().zip(&self.vertices) {
            let span = self.edges[vertex.before].length + self.edges[vertex.own].length;
            let change = self.missing[vertex.after] - self.missing[vertex.before];
            *slope = if span > 0.0 { change / span } else { 0.0 };
        }
    }

    /// One over the length of both edges of a vertex.
    fn inverse_span(&self, vertex: &Vertex) -> f64 {
        let span = self.edges[vertex.before].length + self.edges[vertex.own].length;
        if span > 0.0 { 1.0 / span } else { 0.0 }
    }

    /// Multiplies by the root of what is missing and a factor.
    fn weigh(&mut self, factor: f64) {
        for (value, root) in self.missing.iter_mut().zip(&self.roots) {
            *value *= factor * root;
        }
    }

    fn smooth(&mut self) {
        for _ in 0..self.passes {
            for (smooth, vertex) in self.scratch.iter_mut().zip(&self.vertices) {
                let [before, here, after] = [vertex.before, vertex.own, vertex.after].map(|k| self.missing[k]);
                *smooth = 0.5 * here + 0.25 * (before + after);
            }
            std::mem::swap(&mut self.scratch, &mut self.missing);
        }
    }

    /// Adds the missing velocities (length per time) to the rates of the free points.
    pub(crate) fn add(&self, rate: &mut [f64]) {
        for (Foot { vertex, fraction, beside }, near) in self.feet.iter().zip(&self.near) {
            if let Some(beside) = beside {
                let after = self.vertices[*vertex].after;
                let between = |values: &[f64]| values[*vertex] + fraction * (values[after] - values[*vertex]);
                let velocity = beside.velocity(between(&self.missing), between(&self.slopes));
                rate[2 * near.marker] += velocity.x;
                rate[2 * near.marker + 1] += velocity.y;
            }
        }
    }
}

/// A vector in x-periodic space at its shortest.
fn wrapped(mut vector: Vec2, period: Option<f64>) -> Vec2 {
    if let Some(period) = period.filter(|period| vector.x.abs() > 0.5 * period) {
        vector.x -= period * (vector.x / period).round();
    }
    vector
}

/// From a point of the surface to the next, in the reference state.
fn nearest_step(mesh: &TriangleMesh, from: usize, to: usize) -> Vec2 {
    wrapped(mesh.points()[to] - mesh.points()[from], mesh.period())
}

#[cfg(test)]
mod tests;

//! Triangle meshes of the reference state.

mod file;
mod finer_boundary;
pub(crate) mod gmsh;
pub(crate) mod lattice;
mod quality;
mod topology;

use motile_base::{
    Vec2,
    internal::{all_points_finite, at_least},
    positive,
};

use crate::SolidError;

use topology::{connect, loops};

pub use file::{BoundaryGroup, MeshFile};
pub use gmsh::{GmshMesh, PhysicalGroup};
pub use lattice::{equilateral_block, equilateral_strip, fitted_strip};
pub use quality::MeshQuality;

/// Edge of a mesh.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Edge {
    /// Indices of its two points.
    pub points: [usize; 2],
    /// Number of periods to add to x of the second point to place it next to the first: 0, 1 or -1.
    pub periods: i32,
    /// Indices of the triangle on its left and of that on its right; `None` for an edge on the boundary.
    pub triangles: (usize, Option<usize>),
}

/// A closed loop of boundary edges with the solid to their left: outer boundaries run counter-clockwise, holes
/// clockwise.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct BoundaryLoop {
    /// Indices of its points in order; the last one is joined to the first.
    pub points: Vec<usize>,
    /// Number of periods by which the loop advances in x before it closes: 1 for the lower surface of a periodic wall,
    /// -1 for the upper one, 0 for a loop that closes on itself.
    pub periods: i32,
}

/// A triangle mesh of the reference state of a solid, possibly periodic in x.
///
/// Triangles are counter-clockwise. In a periodic mesh, the two ends share their points: a triangle across the periodic
/// edge has corners one period away from its points, which [`TriangleMesh::corners`] accounts for. Every point belongs
/// to a triangle and every edge to one or two.
#[derive(Debug, Clone, PartialEq)]
pub struct TriangleMesh {
    points: Vec<Vec2>,
    triangles: Vec<[usize; 3]>,
    /// Numbers of periods to add to x of the second and third corner.
    shifts: Vec<[i8; 2]>,
    period: Option<f64>,
    edges: Vec<Edge>,
    loops: Vec<BoundaryLoop>,
    areas: Vec<f64>,
}

impl TriangleMesh {
    /// Creates a mesh of points (length) and triangles, each by the indices of its three points; clockwise triangles
    /// are turned around.
    ///
    /// # Errors
    /// Returns an error if there is no triangle, or for points that are not finite or in no triangle, indices beyond
    /// the points, triangles without area, edges of more than two triangles or of two that lie on one side.
    pub fn new(points: Vec<Vec2>, triangles: Vec<[usize; 3]>) -> Result<Self, SolidError> {
        Self::build(points, triangles, None)
    }

    /// Creates a mesh that repeats itself in x with `period` (length): triangles whose points seem further apart than
    /// half a period are taken across the periodic edge.
    ///
    /// # Errors
    /// Returns the errors of [`TriangleMesh::new`], a period that is not positive, triangles as wide as half a period.
    pub fn periodic(points: Vec<Vec2>, triangles: Vec<[usize; 3]>, period: f64) -> Result<Self, SolidError> {
        positive("the period", period)?;
        Self::build(points, triangles, Some(period))
    }

    fn build(points: Vec<Vec2>, mut triangles: Vec<[usize; 3]>, period: Option<f64>) -> Result<Self, SolidError> {
        all_points_finite("the points of the mesh", &points)?;
        at_least("triangles", triangles.len(), 1)?;
        let mut shifts = vec![[0; 2]; triangles.len()];
        let mut areas = Vec::with_capacity(triangles.len());
        let mut used = vec![false; points.len()];
        for (number, (triangle, shift)) in triangles.iter_mut().zip(&mut shifts).enumerate() {
            for &point in triangle.iter() {
                let seen = used.get_mut(point).ok_or_else(|| SolidError::no_such_point(number, point, points.len()))?;
                *seen = true;
            }
            if let Some(period) = period {
                *shift = nearest_images(number, triangle.map(|point| points[point].x), period)?;
            }
            let corners = corners_of(triangle, *shift, period.unwrap_or(0.0), &points);
            let (first, second) = (corners[1] - corners[0], corners[2] - corners[0]);
            let area = 0.5 * first.perp_dot(second);
            let longest = first.length_squared().max(second.length_squared()).max((second - first).length_squared());
            // The negation also catches an area that overflowed.
            if !(area.abs() > 1e-12 * longest && area.is_finite()) {
                return Err(SolidError::flat_triangle(number, corners[0], area.abs()));
            }
            if area < 0.0 {
                triangle.swap(1, 2);
                shift.swap(0, 1);
            }
            areas.push(area.abs());
        }
        if let Some(point) = used.iter().position(|used| !used) {
            return Err(SolidError::loose_point(point, points[point]));
        }
        let (edges, twins) = connect(&triangles, &shifts)?;
        let loops = loops(&triangles, &shifts, &twins);
        Ok(Self { points, triangles, shifts, period, edges, loops, areas })
    }

    /// Returns the reference positions of the points (length).
    #[must_use]
    pub fn points(&self) -> &[Vec2] {
        &self.points
    }

    /// Returns the triangles by the indices of their points, counter-clockwise.
    #[must_use]
    pub fn triangles(&self) -> &[[usize; 3]] {
        &self.triangles
    }

    /// Returns the period in x (length); `None` for a mesh that does not repeat itself.
    #[must_use]
    pub fn period(&self) -> Option<f64> {
        self.period
    }

    /// Returns the edges, each once.
    #[must_use]
    pub fn edges(&self) -> &[Edge] {
        &self.edges
    }

    /// Loops of the boundary.
    #[must_use]
    pub fn boundary_loops(&self) -> &[BoundaryLoop] {
        &self.loops
    }

    /// Returns the areas of the triangles in the reference state (length squared).
    #[must_use]
    pub fn areas(&self) -> &[f64] {
        &self.areas
    }

    /// Returns the area of the mesh in the reference state (length squared).
    #[must_use]
    pub fn area(&self) -> f64 {
        self.areas.iter().sum()
    }

    /// Returns the area dA_i of each point, a third of the areas of the triangles around it (length squared; Cowley
    /// (4.2)).
    pub(crate) fn point_areas(&self) -> Vec<f64> {
        let mut areas = vec![0.0; self.points.len()];
        for (triangle, area) in self.triangles.iter().zip(&self.areas) {
            for &point in triangle {
                areas[point] += area / 3.0;
            }
        }
        areas
    }

    /// Returns the flag of each point, `true` for one that is not on the boundary.
    pub(crate) fn inner_points(&self) -> Vec<bool> {
        let mut inner = vec![true; self.points.len()];
        self.loops.iter().flat_map(|boundary| &boundary.points).for_each(|&point| inner[point] = false);
        inner
    }

    /// Returns the corners of a triangle (length) with the points of the mesh at `positions` (length, one per point):
    /// one continuous triangle, also across the edge of a periodic mesh. `None` for a triangle beyond the last or
    /// another number of positions than points.
    #[must_use]
    pub fn corners(&self, triangle: usize, positions: &[Vec2]) -> Option<[Vec2; 3]> {
        (triangle < self.triangles.len() && self.fits(positions)).then(|| self.raw_corners(triangle, positions))
    }

    fn fits(&self, positions: &[Vec2]) -> bool {
        positions.len() == self.points.len()
    }

    /// [`TriangleMesh::corners`] for a triangle and positions of this mesh.
    #[inline]
    pub(crate) fn raw_corners(&self, triangle: usize, positions: &[Vec2]) -> [Vec2; 3] {
        corners_of(&self.triangles[triangle], self.shifts[triangle], self.period.unwrap_or(0.0), positions)
    }

    /// Returns the centroid of a triangle of this mesh in the reference state (length).
    pub(crate) fn centroid(&self, triangle: usize) -> Vec2 {
        self.raw_corners(triangle, &self.points).iter().sum::<Vec2>() / 3.0
    }

    /// Returns the vector from the first to the second point of an edge of this mesh with the points at `positions`
    /// (length).
    pub(crate) fn edge_vector(&self, edge: &Edge, positions: &[Vec2]) -> Vec2 {
        let mut vector = positions[edge.points[1]] - positions[edge.points[0]];
        vector.x += f64::from(edge.periods) * self.period.unwrap_or(0.0);
        vector
    }

    /// Returns the polygon of a boundary loop with the points at `positions` (length): one continuous line, without the
    /// repeated first point. For a loop with periods, its end is that many periods ahead of its start. `None` for a
    /// loop of another mesh or another number of positions than points.
    #[must_use]
    pub fn boundary_polygon(&self, boundary: &BoundaryLoop, positions: &[Vec2]) -> Option<Vec<Vec2>> {
        let known = self.fits(positions) && boundary.points.iter().all(|&point| point < positions.len());
        known.then(|| self.raw_polygon(boundary, positions))
    }

    /// [`TriangleMesh::boundary_polygon`] for a loop and positions of this mesh.
    pub(crate) fn raw_polygon(&self, boundary: &BoundaryLoop, positions: &[Vec2]) -> Vec<Vec2> {
        let period = self.period.unwrap_or(0.0);
        let mut polygon: Vec<Vec2> = Vec::with_capacity(boundary.points.len());
        let mut shift = 0.0;
        for (k, &point) in boundary.points.iter().enumerate() {
            if k > 0 && period > 0.0 {
                // Reference positions decide, so that the deformation cannot change the image.
                let step = self.points[point].x - self.points[boundary.points[k - 1]].x;
                shift -= period * (step / period).round();
            }
            polygon.push(positions[point] + Vec2::new(shift, 0.0));
        }
        polygon
    }

    /// Returns the mesh with y reversed: the mesh of the other wall of a symmetric channel. Points keep their numbers.
    #[must_use]
    pub fn mirrored(&self) -> Self {
        let mut mesh = self.clone();
        mesh.points.iter_mut().for_each(|point| point.y = -point.y);
        mesh.triangles.iter_mut().for_each(|[_, second, third]| std::mem::swap(second, third));
        mesh.shifts.iter_mut().for_each(|[second, third]| std::mem::swap(second, third));
        for edge in &mut mesh.edges {
            // What was to the left of an edge is to its right, and a side has its triangle to the left.
            edge.points.reverse();
            edge.periods = -edge.periods;
        }
        for boundary in &mut mesh.loops {
            boundary.points[1..].reverse();
            boundary.periods = -boundary.periods;
        }
        mesh
    }

    /// Moves the mesh by `offset` (length).
    ///
    /// # Errors
    /// Returns an error for an offset that is not finite.
    pub fn translated(mut self, offset: Vec2) -> Result<Self, SolidError> {
        all_points_finite("the offset", &[offset])?;
        for point in &mut self.points {
            *point += offset;
        }
        Ok(self)
    }
}

#[inline]
fn corners_of(triangle: &[usize; 3], shift: [i8; 2], period: f64, positions: &[Vec2]) -> [Vec2; 3] {
    let at = |corner: usize, shift: i8| {
        let point = positions[triangle[corner]];
        Vec2::new(point.x + f64::from(shift) * period, point.y)
    };
    [at(0, 0), at(1, shift[0]), at(2, shift[1])]
}

/// Returns the numbers of periods that bring the second and third corner next to the first.
fn nearest_images(triangle: usize, x: [f64; 3], period: f64) -> Result<[i8; 2], SolidError> {
    let steps = [x[1] - x[0], x[2] - x[0]];
    let periods = steps.map(|step| -(step / period).round());
    let wide = |step: f64| step.abs() > 0.499 * period;
    let [first, second] = [0, 1].map(|k| steps[k] + periods[k] * period);
    let width = first.abs().max(second.abs()).max((second - first).abs());
    if wide(width) || periods.iter().any(|n| n.abs() > 1.0) {
        return Err(SolidError::triangle_too_wide(triangle, width.max(steps[0].abs()).max(steps[1].abs()), period));
    }
    Ok(periods.map(|n| n as i8))
}

#[cfg(test)]
mod tests;

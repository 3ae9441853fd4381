//! Constrained Delaunay triangulation of a set of points, also across the edge of a period.

use motile_base::Vec2;
use spade::{ConstrainedDelaunayTriangulation, Point2, Triangulation};

use crate::SolidError;
use crate::mesher::point_set::PointSet;

/// Width of the images beyond each end of a period, in spacings. Delaunay triangles of a set without gaps are smaller
/// than two.
const IMAGES: f64 = 8.0;

/// Displacement that decides between equally good diagonals, in spacings: an image of four points on a circle must not
/// be cut otherwise than the four themselves.
const TIE_BREAK: f64 = 1e-7;

/// Area, in spacings squared, below which a triangle between points of a straight side is round-off and no part of the
/// solid.
const SLIVER: f64 = 1e-6;

/// Returns the triangles inside the solid, each once.
pub(crate) fn triangulate(set: &mut PointSet<'_>, spacing: f64) -> Result<Vec<[usize; 3]>, SolidError> {
    set.renew(IMAGES * spacing);
    let (vertices, originals, edges) = images(set, spacing);
    let count = vertices.len();
    let triangulation = build(vertices, edges)?;
    if triangulation.num_vertices() != count {
        return Err(SolidError::meshing_failed("two points coincide"));
    }
    let mut triangles = Vec::with_capacity(2 * set.points.len());
    for face in triangulation.inner_faces() {
        let corners = face.vertices().map(|vertex| vertex.index());
        let of = corners.map(|corner| originals[corner]);
        // One representative of each class of images: the one whose point of lowest number is itself no image.
        let lowest = of.iter().min().copied().unwrap_or_default();
        if lowest.1 != 0 {
            continue;
        }
        let place = of.map(|(point, image)| set.points[point] + image_shift(set.period, image));
        let area = 0.5 * (place[1] - place[0]).perp_dot(place[2] - place[0]).abs();
        let flat = area < SLIVER * spacing * spacing && of.iter().all(|&(point, _)| point < set.on_boundary);
        if !flat && set.segments.inside((place[0] + place[1] + place[2]) / 3.0) {
            triangles.push(of.map(|(point, _)| point));
        }
    }
    Ok(triangles)
}

type Vertices = (Vec<Point2<f64>>, Vec<(usize, i8)>, Vec<[usize; 2]>);

/// Vertices of a triangulation: all points and their images near the ends of the period, in units of the spacing; the
/// index of the point and the number of periods for each; and the boundary edges between vertices.
fn images(set: &PointSet<'_>, spacing: f64) -> Vertices {
    let near = |x: f64, image: i8| match (set.period, image) {
        (Some((start, period)), 1) => x < start + (IMAGES * spacing).min(period),
        (Some((start, period)), -1) => x > start + period - (IMAGES * spacing).min(period),
        (_, image) => image == 0,
    };
    let mut vertices = Vec::with_capacity(set.points.len());
    let mut originals = Vec::with_capacity(set.points.len());
    let mut numbers = vec![[usize::MAX; 3]; set.points.len()];
    for image in [0, -1, 1] {
        for (point, position) in set.points.iter().enumerate().filter(|(_, position)| near(position.x, image)) {
            let mut place = (position + image_shift(set.period, image)) / spacing;
            if point >= set.on_boundary {
                place += tie_break(point);
            }
            numbers[point][(image + 1) as usize] = vertices.len();
            vertices.push(Point2::new(place.x, place.y));
            originals.push((point, image));
        }
    }
    let mut edges = Vec::with_capacity(set.boundary.len());
    for &[from, to] in &set.boundary {
        // Periods by which the second point stands off the first.
        let step =
            set.period.map_or(0, |(_, period)| -((set.points[to].x - set.points[from].x) / period).round() as i8);
        for image in [-1_i8, 0, 1] {
            let other = image + step;
            if !(-1..=1).contains(&other) {
                continue;
            }
            let ends = [numbers[from][(image + 1) as usize], numbers[to][(other + 1) as usize]];
            if !ends.contains(&usize::MAX) {
                edges.push(ends);
            }
        }
    }
    (vertices, originals, edges)
}

fn image_shift(period: Option<(f64, f64)>, image: i8) -> Vec2 {
    Vec2::new(period.map_or(0.0, |(_, period)| period * f64::from(image)), 0.0)
}

/// Returns a small displacement that differs from point to point and is the same for all images of one.
fn tie_break(point: usize) -> Vec2 {
    let hash = (point as u64).wrapping_add(1).wrapping_mul(0x9E37_79B9_7F4A_7C15);
    let part = |shift: u32| ((hash >> shift) & 0xFFFF) as f64 / 65536.0 - 0.5;
    Vec2::new(part(16), part(40)) * TIE_BREAK
}

pub(super) fn build(
    vertices: Vec<Point2<f64>>,
    edges: Vec<[usize; 2]>,
) -> Result<ConstrainedDelaunayTriangulation<Point2<f64>>, SolidError> {
    let mut conflict = None;
    let triangulation = ConstrainedDelaunayTriangulation::try_bulk_load_cdt(vertices, edges, |edge| {
        conflict.get_or_insert(edge);
    })
    .map_err(|_| SolidError::meshing_failed("a coordinate is too small or too large for the spacing"))?;
    match conflict {
        None => Ok(triangulation),
        Some(_) => Err(SolidError::meshing_failed("boundary edges cross")),
    }
}

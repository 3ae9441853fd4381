//! Adjacency of triangles: shared edges, and the loops of the boundary.

use crate::SolidError;
use crate::mesh::{BoundaryLoop, Edge};

/// Half-edge k of triangle t has the number 3 t + k and runs from corner k to the next.
type HalfEdge = usize;

fn next(half: HalfEdge) -> HalfEdge {
    if half % 3 == 2 { half - 2 } else { half + 1 }
}

/// Returns the edges of a mesh, each once, and for each half-edge its twin on the other side; `None` on the boundary.
pub(crate) fn connect(
    triangles: &[[usize; 3]],
    shifts: &[[i8; 2]],
) -> Result<(Vec<Edge>, Vec<Option<HalfEdge>>), SolidError> {
    let mut sorted: Vec<(usize, usize, HalfEdge)> = (0..3 * triangles.len())
        .map(|half| {
            let (from, to) = ends(triangles, half);
            (from.min(to), from.max(to), half)
        })
        .collect();
    sorted.sort_unstable();
    let mut twins = vec![None; sorted.len()];
    let mut edges = Vec::with_capacity(sorted.len() / 2 + 1);
    for group in sorted.chunk_by(|a, b| (a.0, a.1) == (b.0, b.1)) {
        let (first, second, half) = group[0];
        if first == second {
            return Err(SolidError::folded_mesh(first, second, half / 3));
        }
        let right = match group {
            [_] => None,
            &[_, (.., other)] if ends(triangles, half).0 != ends(triangles, other).0 => {
                twins[half] = Some(other);
                twins[other] = Some(half);
                Some(other / 3)
            }
            _ => return Err(SolidError::folded_mesh(first, second, group[group.len() - 1].2 / 3)),
        };
        let (from, to) = ends(triangles, half);
        edges.push(Edge { points: [from, to], periods: periods(shifts, half), triangles: (half / 3, right) });
    }
    Ok((edges, twins))
}

/// Loops of half-edges without a twin, which make the boundary.
pub(crate) fn loops(triangles: &[[usize; 3]], shifts: &[[i8; 2]], twins: &[Option<HalfEdge>]) -> Vec<BoundaryLoop> {
    let mut visited = vec![false; twins.len()];
    let mut loops = Vec::new();
    for start in 0..twins.len() {
        if twins[start].is_some() || visited[start] {
            continue;
        }
        let mut boundary = BoundaryLoop { points: Vec::new(), periods: 0 };
        let mut half = start;
        while !visited[half] {
            visited[half] = true;
            boundary.points.push(ends(triangles, half).0);
            boundary.periods += periods(shifts, half);
            // Turn about the end point through the fan of triangles until the boundary is met again.
            half = next(half);
            while let Some(twin) = twins[half] {
                half = next(twin);
            }
        }
        loops.push(boundary);
    }
    loops
}

fn ends(triangles: &[[usize; 3]], half: HalfEdge) -> (usize, usize) {
    let triangle = &triangles[half / 3];
    (triangle[half % 3], triangle[(half + 1) % 3])
}

fn periods(shifts: &[[i8; 2]], half: HalfEdge) -> i32 {
    let [second, third] = shifts[half / 3];
    i32::from(match half % 3 {
        0 => second,
        1 => third - second,
        _ => -third,
    })
}

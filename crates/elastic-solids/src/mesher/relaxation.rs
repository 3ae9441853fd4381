//! Relaxation of a mesh towards equal edges.

use motile_base::Vec2;

use crate::SolidError;
use crate::mesher::point_set::PointSet;
use crate::mesher::triangulation::triangulate;

/// Sweeps between two triangulations; the first ones follow each other sooner.
const SWEEPS_PER_TRIANGULATION: usize = 20;

/// Fraction of the sweeps in which the edges only push.
const PUSHING: f64 = 2.0 / 3.0;

/// Length over the spacing at which an edge ceases to push. Edges that never pull drive points away from their nearest
/// neighbours and dislocations away from the boundary. Above 1.33, a lattice under such a pressure is unstable.
const PUSH_LENGTH: f64 = 1.25;

/// Displacement over force: with the six edges of a point, it would overshoot above 1/3.
const STEP: f64 = 0.15;

/// Fraction of the last displacement that the next one repeats: strains as wide as a wall die out in about 20 sweeps
/// instead of 100. At 0.9 points are thrown across the boundary.
const MOMENTUM: f64 = 0.8;

/// Moves the points towards equal edges and returns the triangles and how often a point was moved. Every edge is a
/// spring, and in every sweep each inner point moves along the force on it, each boundary point but the corners along
/// its outline.
///
/// First the edges all push; the lattice they make resists shear little and finds its order. Then their rest length is
/// their mean length, so that the variance of the lengths falls to its minimum for these triangles.
pub(crate) fn relax(
    set: &mut PointSet<'_>,
    sweeps: usize,
    spacing: f64,
) -> Result<(Vec<[usize; 3]>, usize), SolidError> {
    let pushing = (PUSHING * sweeps as f64).round() as usize;
    let mut triangles = triangulate(set, spacing)?;
    let mut motion = Motion::of(set);
    let (mut done, mut moves) = (0, 0);
    while done < sweeps {
        let edges = edges(&triangles);
        let push = done < pushing;
        let end = if push { pushing } else { sweeps };
        let batch = SWEEPS_PER_TRIANGULATION.min(done.max(5)).min(end - done);
        let mean = edges.iter().map(|&edge| set.vector(edge).length()).sum::<f64>() / edges.len() as f64;
        let rest = if push { PUSH_LENGTH * spacing } else { mean };
        for _ in 0..batch {
            motion.sweep(set, &edges, rest, spacing);
        }
        done += batch;
        moves += batch * set.points.len();
        triangles = triangulate(set, spacing)?;
        // Points that were pushed out of a tip are gone.
        if motion.steps.len() != set.points.len() {
            motion = Motion::of(set);
        }
    }
    Ok((triangles, moves))
}

fn edges(triangles: &[[usize; 3]]) -> Vec<[usize; 2]> {
    let mut edges: Vec<[usize; 2]> =
        triangles.iter().flat_map(|&[a, b, c]| [[a, b], [b, c], [c, a]]).map(|[a, b]| [a.min(b), a.max(b)]).collect();
    edges.sort_unstable();
    edges.dedup();
    edges
}

/// Forces and last displacements of all points.
struct Motion {
    forces: Vec<Vec2>,
    steps: Vec<Vec2>,
}

impl Motion {
    fn of(set: &PointSet<'_>) -> Self {
        let still = vec![Vec2::ZERO; set.points.len()];
        Self { forces: still.clone(), steps: still }
    }

    fn sweep(&mut self, set: &mut PointSet<'_>, edges: &[[usize; 2]], rest: f64, spacing: f64) {
        self.forces.fill(Vec2::ZERO);
        for &[a, b] in edges {
            let along = set.vector([a, b]);
            let force = along * (1.0 - rest / along.length().max(1e-3 * spacing));
            self.forces[a] += force;
            self.forces[b] -= force;
        }
        for (step, force) in self.steps.iter_mut().zip(&self.forces) {
            *step = *step * MOMENTUM + force * STEP;
            // No point may pass its neighbours within a sweep.
            let (squared, longest) = (step.length_squared(), 0.2 * spacing);
            if squared > longest * longest {
                *step = longest * (*step / squared.sqrt());
            }
        }
        let (boundary, inner) = self.steps.split_at_mut(set.on_boundary);
        set.slide(boundary);
        for (point, step) in set.points[set.on_boundary..].iter_mut().zip(inner) {
            *point += *step;
        }
    }
}

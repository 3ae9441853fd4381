//! Forces of the bodies.

use crate::{Body, BodyError, FluidView};
use motile_base::Vec2;

/// Markers from which a half of the bodies pays for a thread.
#[cfg(feature = "rayon")]
const LEAST_MARKERS: usize = 15_000;

/// Writes the forces of `bodies`, the first of which has the number `first`, and which lie in fluids of the viscosities
/// `outside`.
pub(super) fn write_forces(
    first: usize,
    bodies: &mut [Box<dyn Body>],
    outside: &[Option<f64>],
    forces: &mut [Vec2],
    view: &FluidView,
) -> Option<(usize, BodyError)> {
    #[cfg(feature = "rayon")]
    if bodies.len() > 1 && forces.len() >= 2 * LEAST_MARKERS {
        let middle = bodies.len() / 2;
        let (bodies, bodies_above) = bodies.split_at_mut(middle);
        let (outside, outside_above) = outside.split_at(middle);
        let markers = bodies.iter().map(|body| body.marker_count()).sum();
        let (forces, forces_above) = forces.split_at_mut(markers);
        let (failed, failed_above) = rayon::join(
            || write_forces(first, bodies, outside, forces, view),
            || write_forces(first + middle, bodies_above, outside_above, forces_above, view),
        );
        return failed.or(failed_above);
    }
    let mut start = 0;
    for (index, (body, &outside)) in bodies.iter_mut().zip(outside).enumerate() {
        let range = start..start + body.marker_count();
        start = range.end;
        if let Err(source) = body.write_forces(&view.in_fluid(outside), &mut forces[range]) {
            return Some((first + index, source));
        }
    }
    None
}

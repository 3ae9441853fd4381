//! Gels as triangles.

use motile::ib_core::{Hydrodynamics, System};
use motile::interior_fields::GelInDroplet;

use crate::{Vec2, VtkFile};

/// All gels of a system in one file; `None` if there are none.
pub(crate) fn file<H: Hydrodynamics>(system: &System<H>) -> Option<VtkFile> {
    let (mut points, mut directors): (Vec<Vec2>, Vec<Vec2>) = Default::default();
    let (mut triangles, mut numbers) = (Vec::new(), Vec::new());
    for (number, (_, gel)) in system.bodies::<GelInDroplet>().enumerate() {
        let start = points.len();
        points.extend(gel.nodes());
        directors.extend(gel.directors());
        triangles.extend(gel.triangles().iter().map(|nodes| nodes.map(|node| start + node)));
        numbers.resize(triangles.len(), number as f64);
    }
    if points.is_empty() {
        return None;
    }
    Some(VtkFile::triangles(&points, &triangles).point_vectors("director", directors).cell_scalars("gel", numbers))
}

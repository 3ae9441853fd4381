//! Particles inside droplets as triangles.

use motile::ib_core::{Hydrodynamics, System};
use motile::interior_fields::ParticlesInDroplet;

use crate::{Vec2, VtkFile};

/// The particles that diffuse inside all droplets of a system in one file; `None` if there are none.
pub(crate) fn file<H: Hydrodynamics>(system: &System<H>) -> Option<VtkFile> {
    let (mut points, mut densities, mut triangles): (Vec<Vec2>, Vec<f64>, Vec<[usize; 3]>) = Default::default();
    for (_, inside) in system.bodies::<ParticlesInDroplet>() {
        let start = points.len();
        points.extend(inside.nodes());
        densities.extend(inside.densities());
        triangles.extend(inside.triangles().iter().map(|nodes| nodes.map(|node| start + node)));
    }
    if points.is_empty() {
        return None;
    }
    Some(VtkFile::triangles(&points, &triangles).point_scalars("density", densities))
}

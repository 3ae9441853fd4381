//! Solids as triangles.

use std::collections::HashMap;

use motile::{
    elastic_solids::Solid,
    ib_core::{Hydrodynamics, System},
};

use crate::{Vec2, VtkFile, solids::solids};

/// All solids of a system in one file; `None` if there are none.
pub(crate) fn file<H: Hydrodynamics>(system: &System<H>) -> Option<VtkFile> {
    let mut pieces = Pieces::default();
    solids(system).enumerate().for_each(|(number, solid)| pieces.add(number, solid));
    if pieces.points.is_empty() {
        return None;
    }
    let component = |k: usize| pieces.stress.iter().map(move |s| s[k]);
    Some(
        VtkFile::triangles(&pieces.points, &pieces.triangles)
            .point_vectors("displacement", pieces.displacement)
            .cell_scalars("J", pieces.jacobian)
            .cell_scalars("stress_xx", component(0))
            .cell_scalars("stress_xy", component(1))
            .cell_scalars("stress_yy", component(2))
            .cell_scalars("stress_deviator", pieces.stress.iter().map(|[xx, xy, yy]| (0.5 * (xx - yy)).hypot(*xy)))
            .cell_scalars("solid", pieces.solid),
    )
}

/// Triangles of all solids; those across the seam of a period have points of their own.
#[derive(Debug, Default)]
struct Pieces {
    points: Vec<Vec2>,
    displacement: Vec<Vec2>,
    triangles: Vec<[usize; 3]>,
    jacobian: Vec<f64>,
    stress: Vec<[f64; 3]>,
    solid: Vec<f64>,
}

impl Pieces {
    fn add(&mut self, number: usize, solid: &Solid) {
        let (mesh, start) = (solid.mesh(), self.points.len());
        self.points.extend(solid.positions());
        self.displacement.extend(solid.displacements());
        let mut images: HashMap<(usize, bool), usize> = HashMap::new();
        for (triangle, home) in mesh.triangles().iter().enumerate() {
            let Some(at) = mesh.corners(triangle, solid.positions()) else { continue };
            self.triangles.push([0, 1, 2].map(|k| {
                let ahead = at[k].x - solid.positions()[home[k]].x;
                if ahead == 0.0 {
                    return start + home[k];
                }
                *images.entry((home[k], ahead > 0.0)).or_insert_with(|| {
                    self.points.push(at[k]);
                    self.displacement.push(self.displacement[start + home[k]]);
                    self.points.len() - 1
                })
            }));
        }
        self.jacobian.extend(solid.jacobians());
        match solid.stresses() {
            Ok(stresses) => self.stress.extend(stresses.iter().map(|s| [s.x_axis.x, s.y_axis.x, s.y_axis.y])),
            // An inverted triangle has none.
            Err(_) => self.stress.resize(self.jacobian.len(), [f64::NAN; 3]),
        }
        self.solid.resize(self.jacobian.len(), number as f64);
    }
}

#[cfg(test)]
mod tests;

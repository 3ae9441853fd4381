//! Meshes of gels, of particles inside droplets and of solids as files of triangles.

use std::collections::HashMap;

use motile::active_interface::ActiveDroplet;
use motile::base::Vec2;
use motile::elastic_solids::{Mat2, Solid};
use motile::interior::{GelInDroplet, GelInLayer, ParticlesInDroplet};
use motile::scene::{Hydrodynamics, System};

use super::file::revolved;
use crate::VtkFile;
use crate::snapshot::at_markers;
use crate::solids::{deviator, solids as solids_of, stress_deviators};

/// Triangles of several bodies.
#[derive(Debug, Default)]
struct Triangles {
    points: Vec<Vec2>,
    triangles: Vec<[usize; 3]>,
    /// Number of the body of each triangle, in the order of addition.
    numbers: Vec<f64>,
}

impl Triangles {
    /// Adds the triangles of the next body.
    fn add(&mut self, points: &[Vec2], triangles: &[[usize; 3]]) {
        let (start, number) = (self.points.len(), self.numbers.last().map_or(0.0, |last| last + 1.0));
        self.points.extend(points);
        self.triangles.extend(triangles.iter().map(|corners| corners.map(|corner| start + corner)));
        self.numbers.resize(self.triangles.len(), number);
    }

    /// Returns the file of the triangles; `None` if there are none.
    fn file(&self) -> Option<VtkFile> {
        (!self.points.is_empty()).then(|| VtkFile::triangles(&self.points, &self.triangles))
    }
}

/// Sectors of a surface of revolution.
const SECTORS: usize = 64;

/// Returns the file of the surfaces of all droplets of revolution of a system; `None` if there are none.
pub(crate) fn surfaces<H: Hydrodynamics>(system: &System<H>) -> Option<VtkFile> {
    let (mut meridians, mut concentration, mut tension): (Vec<Vec<Vec2>>, Vec<f64>, Vec<f64>) = Default::default();
    for (_, droplet) in system.bodies::<ActiveDroplet>().filter(|(_, droplet)| droplet.is_axisymmetric()) {
        let half = droplet.markers().len() / 2 + 1;
        meridians.push(droplet.markers()[..half].to_vec());
        for (out, segments) in [(&mut concentration, droplet.concentrations()), (&mut tension, droplet.tensions())] {
            out.extend(revolved(&at_markers(segments)[..half.min(segments.len())], SECTORS));
        }
    }
    let file = || VtkFile::surfaces(&meridians, SECTORS).point_scalars("tension", tension);
    let carries = !concentration.is_empty();
    (!meridians.is_empty()).then(|| if carries { file().point_scalars("concentration", concentration) } else { file() })
}

/// Returns the file of all gels of a system; `None` if there are none.
pub(crate) fn gels<H: Hydrodynamics>(system: &System<H>) -> Option<VtkFile> {
    let (mut mesh, mut directors) = (Triangles::default(), Vec::new());
    for (_, gel) in system.bodies::<GelInDroplet>() {
        mesh.add(gel.nodes(), gel.triangles());
        directors.extend(gel.directors().iter().copied());
    }
    for (_, gel) in system.bodies::<GelInLayer>() {
        // Without the triangles across the end of the period.
        let (nodes, period) = (gel.nodes(), system.hydrodynamics().fluid_view().domain.periods[0]);
        let narrow = |triangle: &&[usize; 3]| {
            let [a, b, c] = triangle.map(|node| nodes[node].x);
            let width = a.max(b).max(c) - a.min(b).min(c);
            period.is_none_or(|period| width < 0.5 * period)
        };
        let triangles: Vec<[usize; 3]> = gel.triangles().iter().filter(narrow).copied().collect();
        mesh.add(nodes, &triangles);
        directors.extend(gel.directors().iter().copied());
    }
    Some(mesh.file()?.point_vectors("director", directors).cell_scalars("gel", mesh.numbers))
}

/// Returns the file of the particles that diffuse inside all droplets of a system; `None` if there are none.
pub(crate) fn particles<H: Hydrodynamics>(system: &System<H>) -> Option<VtkFile> {
    let (mut mesh, mut densities) = (Triangles::default(), Vec::new());
    for (_, inside) in system.bodies::<ParticlesInDroplet>() {
        mesh.add(inside.nodes(), inside.triangles());
        densities.extend(inside.densities());
    }
    Some(mesh.file()?.point_scalars("density", densities))
}

/// Returns the file of all solids of a system; `None` if there are none.
pub(crate) fn solids<H: Hydrodynamics>(system: &System<H>) -> Option<VtkFile> {
    let mut pieces = Pieces::default();
    solids_of(system).for_each(|solid| pieces.add(solid));
    let component = |k: usize| pieces.stress.iter().map(move |s| s[k]);
    let mut file = pieces
        .mesh
        .file()?
        .point_vectors("displacement", pieces.displacement)
        .cell_scalars("J", pieces.jacobian)
        .cell_scalars("stress_xx", component(0))
        .cell_scalars("stress_xy", component(1))
        .cell_scalars("stress_yy", component(2))
        .cell_scalars("stress_deviator", pieces.deviator)
        .cell_scalars("solid", pieces.mesh.numbers);
    if solids_of(system).any(|solid| !matches!(solid.internal_stresses(), Ok(None))) {
        let inner = |value: fn(&Mat2) -> f64| pieces.internal.iter().map(value);
        file = file
            .cell_scalars("internal_xx", inner(|s| s.x_axis.x))
            .cell_scalars("internal_xy", inner(|s| s.x_axis.y))
            .cell_scalars("internal_yy", inner(|s| s.y_axis.y))
            .cell_scalars("internal_deviator", inner(deviator))
            .cell_scalars("active_part", pieces.active);
    }
    Some(file)
}

/// Triangles of solids with their values; triangles across the edge of a period have separate points.
#[derive(Debug, Default)]
struct Pieces {
    mesh: Triangles,
    displacement: Vec<Vec2>,
    jacobian: Vec<f64>,
    stress: Vec<[f64; 3]>,
    deviator: Vec<f64>,
    /// Stress that is not elastic.
    internal: Vec<Mat2>,
    /// Fraction of the sides whose active springs are on.
    active: Vec<f64>,
}

impl Pieces {
    fn add(&mut self, solid: &Solid) {
        let mesh = solid.mesh();
        let mut points = solid.positions().to_vec();
        let mut displacement: Vec<Vec2> = solid.displacements().collect();
        let mut triangles = Vec::with_capacity(mesh.triangles().len());
        let mut images: HashMap<(usize, bool), usize> = HashMap::new();
        for (triangle, home) in mesh.triangles().iter().enumerate() {
            let Some(at) = mesh.corners(triangle, solid.positions()) else { continue };
            triangles.push([0, 1, 2].map(|k| {
                let ahead = at[k].x - solid.positions()[home[k]].x;
                if ahead == 0.0 {
                    return home[k];
                }
                *images.entry((home[k], ahead > 0.0)).or_insert_with(|| {
                    points.push(at[k]);
                    displacement.push(displacement[home[k]]);
                    points.len() - 1
                })
            }));
        }
        self.mesh.add(&points, &triangles);
        self.displacement.extend(displacement);
        self.jacobian.extend(solid.jacobians());
        self.deviator.extend(stress_deviators(solid));
        match solid.internal_stresses() {
            Ok(Some(stresses)) => self.internal.extend(stresses),
            Ok(None) => self.internal.resize(self.jacobian.len(), Mat2::ZERO),
            Err(_) => self.internal.resize(self.jacobian.len(), Mat2::from_diagonal(Vec2::splat(f64::NAN))),
        }
        let first = self.active.len();
        self.active.resize(self.jacobian.len(), 0.0);
        for (edge, _) in mesh.edges().iter().zip(solid.active_bonds().unwrap_or_default()).filter(|(_, on)| **on) {
            for triangle in std::iter::once(edge.triangles.0).chain(edge.triangles.1) {
                self.active[first + triangle] += 1.0 / 3.0;
            }
        }
        match solid.stresses() {
            Ok(stresses) => self.stress.extend(stresses.iter().map(|s| [s.x_axis.x, s.y_axis.x, s.y_axis.y])),
            // An inverted triangle has none.
            Err(_) => self.stress.resize(self.jacobian.len(), [f64::NAN; 3]),
        }
    }
}

#[cfg(test)]
mod tests;

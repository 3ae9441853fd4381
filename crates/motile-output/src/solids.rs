//! What is seen of the elastic solids of a scene.

use std::{collections::HashMap, path::Path};

use anyhow::Result;
use motile::elastic_solids::{Solid, channel::width_between, solid::Observables};
use motile::{SolidGap, ib_core::Hydrodynamics, ib_core::System};

use crate::{SolidShape, Vec2, VtkFile, VtkSeries};

/// The solids of a system, in the order of addition.
pub fn solids<H: Hydrodynamics>(system: &System<H>) -> impl Iterator<Item = &Solid> {
    system.bodies().map(|(_, solid)| solid)
}

/// A solid where it is now; of a periodic wall one period.
#[must_use]
pub fn solid_shape(solid: &Solid) -> SolidShape {
    let mesh = solid.mesh();
    let mut shape = SolidShape::default();
    // Lines around the period, to the right and to the left, with the solid on their left: one period of both.
    let mut end: Option<Vec2> = None;
    let mut around: Vec<Vec2> = Vec::new();
    for boundary in mesh.boundary_loops() {
        let mut line = mesh.boundary_polygon(boundary, solid.positions());
        let period = f64::from(boundary.periods) * mesh.period().unwrap_or(0.0);
        line.push(line[0] + Vec2::new(period, 0.0));
        if boundary.periods == 0 {
            shape.area.push(line.clone());
        } else {
            if let Some(end) = end {
                let shift = period * ((end.x - line[0].x) / period).round();
                line.iter_mut().for_each(|point| point.x += shift);
            }
            end = line.last().copied();
            around.extend(&line);
        }
        shape.edges.push(line);
    }
    if !around.is_empty() {
        shape.area.push(around);
    }
    shape
}

/// Measures the solids of a system, for rows of a table.
#[derive(Debug)]
pub struct SolidMeter {
    gap: SolidGap,
    set_back: f64,
}

impl SolidMeter {
    /// What is measured: smallest and largest width of the channel between the first two solids, gap between droplet
    /// and solids, largest displacements in any direction and across a surface, the mean displacement of a solid that
    /// is the largest along the channel (lengths), elastic energy, smallest ratio of deformed and reference area of a
    /// triangle.
    pub const NAMES: [&'static str; 8] = [
        "channel_width_min",
        "channel_width_max",
        "droplet_gap",
        "largest_displacement",
        "largest_normal_displacement",
        "wall_drift",
        "elastic_energy",
        "smallest_jacobian",
    ];

    /// A meter for a system with solids; `None` for one without.
    #[must_use]
    pub fn of<H: Hydrodynamics>(system: &System<H>) -> Option<Self> {
        solids(system).next().map(|_| Self { gap: SolidGap::new(f64::INFINITY), set_back: 0.0 })
    }

    /// For solids that are meshed this far behind the surfaces where they stop the fluid (length): widths and gaps are
    /// those between these surfaces.
    pub fn set_back(&mut self, set_back: f64) {
        self.gap = SolidGap::new(f64::INFINITY).with_set_back(set_back);
        self.set_back = set_back;
    }

    /// The values of [`SolidMeter::NAMES`] at the present state; not a number where there is none.
    ///
    /// # Errors
    /// A state that cannot be measured.
    pub fn measure<H: Hydrodynamics>(&mut self, system: &System<H>) -> Result<[f64; 8]> {
        let mut pair = solids(system);
        let width = pair.next().zip(pair.next()).and_then(|(lower, upper)| width_between(lower, upper).ok());
        let gap = self.gap.measure(system)?.map_or(f64::NAN, |(gap, _)| gap);
        let (mut total, mut normal, mut drift, mut energy, mut jacobian) =
            (0.0_f64, 0.0_f64, 0.0_f64, 0.0, f64::INFINITY);
        for solid in solids(system) {
            let seen = Observables::of(solid);
            total = total.max(seen.largest_displacement);
            normal = normal.max(seen.largest_normal_displacement);
            drift = if seen.drift.x.abs() > drift.abs() { seen.drift.x } else { drift };
            energy += solid.elastic_energy()?;
            jacobian = jacobian.min(seen.smallest_jacobian);
        }
        let [narrowest, widest] =
            width.map_or([f64::NAN; 2], |width| [width.minimum, width.maximum].map(|w| w - 2.0 * self.set_back));
        Ok([narrowest, widest, gap, total, normal, drift, energy, jacobian])
    }
}

/// Writes the solids of a system as triangles (`solids.pvd`).
#[derive(Debug)]
pub struct SolidFiles {
    series: VtkSeries,
}

impl SolidFiles {
    /// Files in `directory`.
    ///
    /// # Errors
    /// A directory that cannot be made.
    pub fn create(directory: &Path) -> Result<Self> {
        Ok(Self { series: VtkSeries::new(directory, "solids")? })
    }

    /// Displacement at the points (length); deformed over reference area J, the components of the Cauchy stress, and
    /// its deviator `sqrt(((s_xx - s_yy)/2)^2 + s_xy^2)` in the triangles (force per length); the number of the solid.
    /// Does nothing for a system without solids.
    ///
    /// # Errors
    /// Files that cannot be written.
    pub fn write<H: Hydrodynamics>(&mut self, system: &System<H>) -> Result<()> {
        let mut pieces = Pieces::default();
        solids(system).enumerate().for_each(|(number, solid)| pieces.add(number, solid));
        if pieces.points.is_empty() {
            return Ok(());
        }
        let component = |k: usize| pieces.stress.iter().map(|s| s[k]).collect::<Vec<f64>>();
        let [xx, xy, yy] = [0, 1, 2].map(component);
        let deviator: Vec<f64> = pieces.stress.iter().map(|[xx, xy, yy]| (0.5 * (xx - yy)).hypot(*xy)).collect();
        let file = VtkFile::triangles(&pieces.points, &pieces.triangles)
            .point_vectors("displacement", &pieces.displacement)
            .cell_scalars("J", &pieces.jacobian)
            .cell_scalars("stress_xx", &xx)
            .cell_scalars("stress_xy", &xy)
            .cell_scalars("stress_yy", &yy)
            .cell_scalars("stress_deviator", &deviator)
            .cell_scalars("solid", &pieces.solid);
        self.series.push(system.time(), &file)
    }
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
            let at = mesh.corners(triangle, solid.positions());
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
            Ok(stresses) => self.stress.extend(stresses.iter().map(|s| [s.m11, s.m12, s.m22])),
            // With a triangle turned inside out there is none.
            Err(_) => self.stress.resize(self.jacobian.len(), [f64::NAN; 3]),
        }
        self.solid.resize(self.jacobian.len(), number as f64);
    }
}

#[cfg(test)]
mod tests;

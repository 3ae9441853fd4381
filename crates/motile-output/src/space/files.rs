//! Files for ParaView of droplets in three dimensions without symmetry.

use std::path::Path;

use motile::scene::{Handle, Hydrodynamics, Observer, System};
use motile::space_droplets::SpaceBody;

use crate::{OutputError, VtkFile, VtkSeries};

/// Name of the record with the times of the files in a system.
const RECORD: &str = "files for ParaView";

/// Observer that writes the surfaces of droplets in three dimensions for ParaView, as triangles (`surface.pvd`). At the
/// points, there are the concentration (particles per area), the tension (force per length) and the velocity (length
/// per time), and in the triangles the number of the droplet.
///
/// Checkpoints hold the times of the files, so that a resumed run continues their numbers.
#[derive(Debug)]
pub struct SpaceParaView {
    body: Handle<SpaceBody>,
    surface: VtkSeries,
    begun: bool,
}

impl SpaceParaView {
    /// Creates an observer whose files are in `directory`, which is created if needed.
    ///
    /// # Errors
    /// Returns [`OutputError::Write`] for a directory that cannot be created.
    pub fn create(directory: impl AsRef<Path>, body: Handle<SpaceBody>) -> Result<Self, OutputError> {
        Ok(Self { body, surface: VtkSeries::create(directory, "surface")?, begun: false })
    }

    /// Returns the file of the surfaces of all droplets in the present state, whose flow must be known.
    ///
    /// # Errors
    /// Returns [`OutputError::Observer`] for a surface that is not finite.
    pub fn file(body: &SpaceBody) -> Result<VtkFile, OutputError> {
        let (mut points, mut triangles, mut numbers) = (Vec::new(), Vec::new(), Vec::new());
        let (mut concentrations, mut tensions, mut velocities) = (Vec::new(), Vec::new(), Vec::new());
        for (number, droplet) in body.droplets().droplets().iter().enumerate() {
            let mesh = droplet.mesh().map_err(|error| OutputError::Observer(error.into()))?;
            let first = points.len();
            triangles.extend(mesh.triangles.iter().map(|corners| corners.map(|corner| first + corner)));
            points.extend(mesh.points);
            numbers.resize(triangles.len(), number as f64);
            concentrations.extend(mesh.concentrations);
            tensions.extend(mesh.tensions);
            velocities.extend(mesh.velocities);
        }
        Ok(VtkFile::triangles_in_space(&points, &triangles)
            .point_scalars("concentration", concentrations)
            .point_scalars("tension", tensions)
            .point_vectors_in_space("velocity", velocities)
            .cell_scalars("droplet", numbers))
    }
}

impl<H: Hydrodynamics> Observer<H> for SpaceParaView {
    fn observe(&mut self, system: &mut System<H>) -> Result<(), Box<dyn std::error::Error + Send + Sync>> {
        let (time, files) = (system.time(), &mut system.record_mut(RECORD).numbers);
        if !std::mem::replace(&mut self.begun, true) {
            files.retain(|&earlier| time > 0.0 && earlier <= time);
            if !files.is_empty() {
                self.surface.after(files);
                // The resumed state has its file, or was not due for one.
                return Ok(());
            }
        }
        system.evaluate()?;
        let file = Self::file(system.body(self.body)?)?.of_origin(system.origin());
        self.surface.push(time, &file)?;
        let files = &mut system.record_mut(RECORD).numbers;
        if files.last() != Some(&time) {
            files.push(time);
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests;

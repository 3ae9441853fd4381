//! A run as files for ParaView.

use std::path::Path;

use anyhow::Result;
use motile::{
    active_interface::{ActiveDroplet, observables::InterfaceState},
    ib_core::{Handle, Hydrodynamics, Observer, System},
};

use crate::{Raster, Snapshot, SolidFiles, VtkFile, VtkSeries, at_markers};

/// Writes the flow (`fields.pvd`), the interface (`interface.pvd`) and, where there are some, elastic solids
/// (`solids.pvd`) whenever it is called.
#[derive(Debug)]
pub struct VtkOutput {
    droplet: Handle<ActiveDroplet>,
    raster: Raster,
    fields: VtkSeries,
    interface: VtkSeries,
    solids: SolidFiles,
}

impl VtkOutput {
    /// Files in `directory`, which is made if it is not there, with the flow in the cells of `raster`.
    ///
    /// # Errors
    /// A directory that cannot be made.
    pub fn create(directory: &Path, raster: Raster, droplet: Handle<ActiveDroplet>) -> Result<Self> {
        let (fields, interface) = (VtkSeries::new(directory, "fields")?, VtkSeries::new(directory, "interface")?);
        Ok(Self { droplet, raster, fields, interface, solids: SolidFiles::create(directory)? })
    }

    /// Pressure (force per length), velocity (length per time) and vorticity (1/time) in the cells; concentration
    /// (particles per length), tension (force), velocity and force on the fluid (force) at the markers.
    fn write<H: Hydrodynamics>(&mut self, system: &mut System<H>) -> Result<()> {
        let seen = Snapshot::take(system, self.raster)?;
        let (pressure, velocity, vorticity) = (seen.pressure(), seen.velocity(), seen.vorticity());
        let file = VtkFile::image(self.raster)
            .cell_scalars("pressure", &pressure)
            .cell_vectors("velocity", &velocity)
            .cell_scalars("vorticity", &vorticity);
        self.fields.push(seen.time, &file)?;

        let droplet = system.body(self.droplet)?;
        let state = InterfaceState::of(system, self.droplet)?;
        let tension = at_markers(droplet.tensions());
        let file = VtkFile::closed_line(state.markers)
            .point_scalars("concentration", &seen.concentration)
            .point_scalars("tension", &tension)
            .point_vectors("velocity", state.velocities)
            .point_vectors("force", state.forces);
        self.interface.push(seen.time, &file)?;
        self.solids.write(system)
    }
}

impl<H: Hydrodynamics> Observer<H> for VtkOutput {
    fn observe(&mut self, system: &mut System<H>) -> Result<(), Box<dyn std::error::Error + Send + Sync>> {
        Ok(self.write(system)?)
    }
}

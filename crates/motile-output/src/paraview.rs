//! Files for ParaView.

pub(crate) mod file;
mod gels;
mod solids;

use std::path::Path;

use motile::active_interface::{ActiveDroplet, observables::InterfaceState};
use motile::ib_core::{Hydrodynamics, Observer, System};

use crate::{Error, Raster, Snapshot, Vec2, VtkFile, VtkSeries, snapshot::at_markers, solids::curves};

/// Writes the flow (`fields.pvd`), the interfaces of all droplets (`interface.pvd`) and, where there are some, all
/// elastic solids (`solids.pvd`), gels (`gels.pvd`), rigid bodies and membranes (`curves.pvd`) whenever it is called.
///
/// | file | where | what (dimension) |
/// |---|---|---|
/// | fields | in the cells | pressure (force per length), velocity (length per time), vorticity (1/time) |
/// | interface | at the markers | concentration (particles per length), tension (force), velocity (length per time) |
/// | interface | at the markers | force on the fluid (force) |
/// | interface | one line a droplet | its number, in the order of addition |
/// | solids | at the points | displacement (length) |
/// | solids | in the triangles | deformed over reference area J, Cauchy stress (force per length), its deviator |
/// | solids | in the triangles | the number of the solid |
/// | gels | at the nodes | director (no dimension) |
/// | gels | in the triangles | the number of the gel |
/// | curves | at the markers | velocity (length per time), force on the fluid (force) |
/// | curves | one line a body | its number, in the order of addition |
///
/// The vorticity is `dv/dx - du/dy`, the deviator of the stress `sqrt(((s_xx - s_yy)/2)^2 + s_xy^2)`.
///
/// ```
/// use motile::prelude::*;
/// use motile_output::{ParaView, Raster};
///
/// let Built { mut scene, .. } = Setup::default().build()?;
/// let directory = std::env::temp_dir().join("a-run-for-paraview");
/// let mut files = ParaView::create(&directory, Raster::of(scene.system(), 0.2)?)?;
/// scene.run(0.2).observe(Every::Time(0.1), &mut files).go()?;
/// assert!(directory.join("interface.pvd").exists());
/// # std::fs::remove_dir_all(&directory)?;
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug)]
pub struct ParaView {
    raster: Raster,
    fields: VtkSeries,
    interface: VtkSeries,
    solids: VtkSeries,
    gels: VtkSeries,
    curves: VtkSeries,
}

impl ParaView {
    /// Files in `directory`, which is made if it is not there, with the flow in the cells of `raster`.
    ///
    /// # Errors
    /// [`Error::Write`]: a directory that cannot be made.
    pub fn create(directory: impl AsRef<Path>, raster: Raster) -> Result<Self, Error> {
        let series = |name| VtkSeries::create(directory.as_ref(), name);
        let [fields, interface, solids] = [series("fields")?, series("interface")?, series("solids")?];
        Ok(Self { raster, fields, interface, solids, gels: series("gels")?, curves: series("curves")? })
    }

    fn write<H: Hydrodynamics>(&mut self, system: &mut System<H>) -> Result<(), Error> {
        let seen = Snapshot::take(system, self.raster)?;
        let file = VtkFile::image(seen.raster)
            .cell_scalars("pressure", seen.pressure())
            .cell_vectors("velocity", seen.velocity())
            .cell_scalars("vorticity", seen.flow.iter().map(|sample| sample.gradient[1][0] - sample.gradient[0][1]));
        self.fields.push(seen.time, &file)?;

        self.interface.push(seen.time, &interfaces(system, &seen)?)?;
        if let Some(file) = curve_lines(system)? {
            self.curves.push(seen.time, &file)?;
        }
        if let Some(file) = solids::file(system) {
            self.solids.push(seen.time, &file)?;
        }
        gels::file(system).map_or(Ok(()), |file| self.gels.push(seen.time, &file))
    }
}

/// All interfaces, each droplet's markers with its own forces and velocities.
fn interfaces<H: Hydrodynamics>(system: &System<H>, seen: &Snapshot) -> Result<VtkFile, Error> {
    let (mut tension, mut velocity, mut force): (Vec<f64>, Vec<Vec2>, Vec<Vec2>) = Default::default();
    for (handle, droplet) in system.bodies::<ActiveDroplet>() {
        let state = InterfaceState::of(system, handle)?;
        tension.extend(at_markers(droplet.tensions()));
        velocity.extend(state.velocities);
        force.extend(state.forces);
    }
    let lines: Vec<Vec<Vec2>> = seen.droplets.iter().map(|droplet| droplet.markers.clone()).collect();
    Ok(VtkFile::closed_lines(&lines)
        .point_scalars("concentration", seen.droplets.iter().flat_map(|droplet| droplet.concentration.clone()))
        .point_scalars("tension", tension)
        .point_vectors("velocity", velocity)
        .point_vectors("force", force)
        .cell_scalars("droplet", (0..lines.len()).map(|number| number as f64)))
}

/// All rigid bodies and membranes; `None` if there are none.
fn curve_lines<H: Hydrodynamics>(system: &System<H>) -> Result<Option<VtkFile>, Error> {
    let (mut lines, mut velocity, mut force): (Vec<Vec<Vec2>>, Vec<Vec2>, Vec<Vec2>) = Default::default();
    for (handle, _) in curves(system) {
        let flow = system.flow_at(handle)?;
        lines.push(flow.positions.to_vec());
        velocity.extend(flow.velocities);
        force.extend(flow.forces);
    }
    let numbers = (0..lines.len()).map(|number| number as f64);
    let file = || VtkFile::closed_lines(&lines).point_vectors("velocity", velocity).point_vectors("force", force);
    Ok((!lines.is_empty()).then(|| file().cell_scalars("body", numbers)))
}

impl<H: Hydrodynamics> Observer<H> for ParaView {
    fn observe(&mut self, system: &mut System<H>) -> Result<(), Box<dyn std::error::Error + Send + Sync>> {
        Ok(self.write(system)?)
    }
}

#[cfg(test)]
mod tests;

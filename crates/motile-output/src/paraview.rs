//! Files of runs for ParaView.

pub(crate) mod file;
mod meshes;

use std::path::Path;

use motile::active_interface::{ActiveDroplet, ActiveInterface, observables::InterfaceState};
use motile::elastic_solids::{Fibre, FibreEnd};
use motile::scene::{Hydrodynamics, Observer, System};

use crate::{
    OutputError, Raster, Snapshot, VtkFile, VtkSeries, interfaces::closed, snapshot::at_markers, solids::curves,
    solids::fibre_line, solids::others,
};
use motile::base::Vec2;

/// Name of the record with the times of the files in a system.
const RECORD: &str = "files for ParaView";

/// Observer that writes files for ParaView: the flow (`fields.pvd`), the interfaces of all droplets (`interface.pvd`)
/// and, if there are some, the surfaces of droplets of revolution (`surface.pvd`), elastic solids (`solids.pvd`), gels
/// (`gels.pvd`), particles that diffuse inside droplets (`inside.pvd`), rigid bodies, membranes and fibres
/// (`curves.pvd`), and the markers of your own bodies that are not curves (`points.pvd`).
///
/// | file | location | quantity (dimension) |
/// |---|---|---|
/// | fields | in the cells | pressure (stress, as [`motile::base::FlowSample::pressure`]), velocity (length per time) |
/// | fields | in the cells | vorticity (1/time) |
/// | interface | at the markers | concentration (particles per length), tension (force), velocity (length per time) |
/// | interface | at the markers | force on the fluid (force) |
/// | interface | in each droplet's line | number of the droplet, in the order of addition |
/// | interface | in the line of an interface across the period | -1, -2 and so on, in the order of addition |
/// | surface | at the points | concentration (particles per area), tension (force per length) |
/// | solids | at the points | displacement (length) |
/// | solids | in the triangles | deformed over reference area J, Cauchy stress (force per length), its deviator |
/// | solids | in the triangles | number of the solid |
/// | solids | in the triangles | of Maxwell elements and active springs: their Cauchy stress, its deviator |
/// | solids | in the triangles | part of the sides whose active springs are on |
/// | gels | at the nodes | director (no dimension) |
/// | gels | in the triangles | number of the gel |
/// | inside | at the nodes | density (particles per area) |
/// | curves | at the markers | velocity (length per time), force on the fluid (force) |
/// | curves | in each body's line | number of the body, in the order of addition, fibres last |
/// | points | at the markers | velocity (length per time), force on the fluid (force) |
/// | points | at the markers | number of the body, in the order of addition |
///
/// Checkpoints hold the times of the files, so that a resumed run continues their numbers.
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
    inside: VtkSeries,
    surface: VtkSeries,
    points: VtkSeries,
    begun: bool,
}

impl ParaView {
    /// Creates an observer whose files are in `directory`, which is created if needed, with the flow in the cells of
    /// `raster`.
    ///
    /// # Errors
    /// Returns [`OutputError::Write`] for a directory that cannot be created.
    pub fn create(directory: impl AsRef<Path>, raster: Raster) -> Result<Self, OutputError> {
        let series = |name| VtkSeries::create(directory.as_ref(), name);
        let [fields, interface, solids] = [series("fields")?, series("interface")?, series("solids")?];
        let [gels, curves, inside] = [series("gels")?, series("curves")?, series("inside")?];
        let [surface, points] = [series("surface")?, series("points")?];
        Ok(Self { raster, fields, interface, solids, gels, curves, inside, surface, points, begun: false })
    }

    fn write<H: Hydrodynamics>(&mut self, system: &mut System<H>) -> Result<(), OutputError> {
        let seen = Snapshot::take(system, self.raster)?;
        let file = VtkFile::image(seen.raster)
            .cell_scalars("pressure", seen.pressure())
            .cell_vectors("velocity", seen.velocity())
            .cell_scalars("vorticity", seen.flow.iter().map(|sample| sample.gradient[1][0] - sample.gradient[0][1]));
        let put = |series: &mut VtkSeries, file: VtkFile| series.push(seen.time, &file.of_origin(&seen.origin));
        put(&mut self.fields, file)?;
        put(&mut self.interface, interfaces(system, &seen)?)?;
        let present = [
            (&mut self.curves, curve_lines(system)?),
            (&mut self.points, marker_points(system)?),
            (&mut self.surface, meshes::surfaces(system)),
            (&mut self.solids, meshes::solids(system)),
            (&mut self.inside, meshes::particles(system)),
            (&mut self.gels, meshes::gels(system)),
        ];
        let files = present.into_iter().filter_map(|(series, file)| Some((series, file?)));
        files.into_iter().try_for_each(|(series, file)| put(series, file))
    }
}

/// Returns the file of all interfaces, each droplet's markers with its own forces and velocities.
fn interfaces<H: Hydrodynamics>(system: &System<H>, seen: &Snapshot) -> Result<VtkFile, OutputError> {
    let (mut tension, mut velocity, mut force): (Vec<f64>, Vec<Vec2>, Vec<Vec2>) = Default::default();
    for (handle, droplet) in system.bodies::<ActiveDroplet>() {
        let state = InterfaceState::of(system, handle)?;
        tension.extend(at_markers(droplet.tensions()));
        velocity.extend(state.velocities);
        force.extend(state.forces);
    }
    for (handle, interface) in system.bodies::<ActiveInterface>() {
        let flow = system.flow_at(handle)?;
        tension.extend(closed(at_markers(interface.tensions())));
        velocity.extend(closed(flow.velocities.to_vec()));
        force.extend(closed(flow.forces.to_vec()));
    }
    let droplets: Vec<Vec<Vec2>> = seen.droplets.iter().map(|droplet| droplet.markers.clone()).collect();
    let others: Vec<Vec<Vec2>> = seen.interfaces.iter().map(|line| line.markers.clone()).collect();
    let of_others = seen.interfaces.iter().flat_map(|line| line.concentration.clone());
    let concentrations = seen.droplets.iter().flat_map(|droplet| droplet.concentration.clone()).chain(of_others);
    let numbers = (0..droplets.len()).map(|number| number as f64).chain((1..=others.len()).map(|n| -(n as f64)));
    Ok(VtkFile::lines(&droplets, &others)
        .point_scalars("concentration", concentrations)
        .point_scalars("tension", tension)
        .point_vectors("velocity", velocity)
        .point_vectors("force", force)
        .cell_scalars("droplet", numbers))
}

/// Returns the file of all rigid bodies, membranes and fibres; `None` if there are none.
fn curve_lines<H: Hydrodynamics>(system: &System<H>) -> Result<Option<VtkFile>, OutputError> {
    let (mut lines, mut velocity, mut force): (Vec<Vec<Vec2>>, Vec<Vec2>, Vec<Vec2>) = Default::default();
    for (handle, _) in curves(system) {
        let flow = system.flow_at(handle)?;
        lines.push(flow.positions.to_vec());
        velocity.extend(flow.velocities);
        force.extend(flow.forces);
    }
    let mut open: Vec<Vec<Vec2>> = Vec::new();
    for (handle, fibre) in system.bodies::<Fibre>() {
        let (flow, line) = (system.flow_at(handle)?, fibre_line(fibre));
        // Held ends are no markers; the last point of a line without ends is the first one.
        let held = fibre.ends()[0] != FibreEnd::Free;
        for (out, values) in [(&mut velocity, flow.velocities), (&mut force, flow.forces)] {
            let first = out.len();
            out.extend(held.then_some(Vec2::ZERO));
            out.extend(values);
            let last = if fibre.period().is_some() { out[first] } else { Vec2::ZERO };
            out.resize(first + line.len(), last);
        }
        open.push(line);
    }
    let count = lines.len() + open.len();
    let numbers = (0..count).map(|number| number as f64);
    let file = || VtkFile::lines(&lines, &open).point_vectors("velocity", velocity).point_vectors("force", force);
    Ok((count > 0).then(|| file().cell_scalars("body", numbers)))
}

/// Returns the file of the markers of all bodies of other types; `None` if there are none.
fn marker_points<H: Hydrodynamics>(system: &System<H>) -> Result<Option<VtkFile>, OutputError> {
    let (mut points, mut velocity, mut force): (Vec<Vec2>, Vec<Vec2>, Vec<Vec2>) = Default::default();
    let mut numbers: Vec<f64> = Vec::new();
    for (number, (handle, _)) in others(system).enumerate() {
        let flow = system.flow_at(handle)?;
        points.extend(flow.positions);
        velocity.extend(flow.velocities);
        force.extend(flow.forces);
        numbers.resize(points.len(), number as f64);
    }
    let file = || VtkFile::points(&points).point_vectors("velocity", velocity).point_vectors("force", force);
    Ok((!points.is_empty()).then(|| file().point_scalars("body", numbers)))
}

impl<H: Hydrodynamics> Observer<H> for ParaView {
    fn observe(&mut self, system: &mut System<H>) -> Result<(), Box<dyn std::error::Error + Send + Sync>> {
        let (time, files) = (system.time(), &mut system.record_mut(RECORD).numbers);
        if !std::mem::replace(&mut self.begun, true) {
            files.retain(|&earlier| time > 0.0 && earlier <= time);
            if !files.is_empty() {
                let Self { fields, interface, solids, gels, curves, inside, surface, points, .. } = self;
                let all = [fields, interface, solids, gels, curves, inside, surface, points];
                all.into_iter().for_each(|series| series.after(files));
                // The resumed state has its files, or was not due for any.
                return Ok(());
            }
        }
        self.write(system)?;
        let files = &mut system.record_mut(RECORD).numbers;
        if files.last() != Some(&time) {
            files.push(time);
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests;

//! Tables of all bodies that are neither droplets nor interfaces, and of the flow, as CSV files.

use std::error::Error;
use std::path::Path;

use motile::elastic_solids::{Fibre, RigidBody, Shell, Solid};
use motile::interior::{GelInBox, GelInDroplet, GelInLayer};
use motile::scene::{Handle, Hydrodynamics, Observer, System};

use crate::{CsvTable, OutputError};

/// Values of a row by the names of their columns.
type Row = Vec<(&'static str, f64)>;

/// Observer that measures all rigid bodies, shells, fibres, elastic solids and gels, and writes them to one CSV file:
/// at each call, one row for each of them.
///
/// The columns are `time`, `body` (the [`Handle::index`] of the body in its scene) and what the bodies of the scene
/// have, with empty fields for a body that lacks it:
///
/// * rigid bodies: centre `x`, `y` (length), `velocity_x`, `velocity_y` (length per time), `angle_degrees` since the
///   start, and `spin` (1/time). If they are held or moved: also the force of the fluid, `force_x`, `force_y` (force),
///   and its `torque` about the centroid (force times length);
/// * shells: centroid and velocity as rigid bodies, `deformation` and `inclination_degrees` of the ellipse with the
///   moments of the area, `area`, `perimeter`, largest and smallest stretch and tension (force), and elastic `energy`
///   (force times length);
/// * fibres: mean place and velocity of the nodes as rigid bodies, `length`, largest and smallest stretch and curvature
///   (1/length), and elastic `energy` without targets. Forces are `force_start_x` to `force_end_y` on what holds the
///   ends (force), and `target_force_x`, `target_force_y` of all targets on the fibre (force). Torques on clamps are
///   `torque_start` and `torque_end` (force times length);
/// * solids: centroid `x`, `y`, mean displacement `drift_x`, `drift_y`, `largest_displacement` and
///   `largest_normal_displacement` (length), elastic `energy`, and `smallest_jacobian`;
/// * gels: `polarisation_x`, `polarisation_y`, number of `defects`, and `energy` of the director.
///
/// ```
/// use motile::prelude::*;
/// use motile::setup::RigidBodySetup;
/// use motile_output::BodiesCsv;
///
/// let rigid_bodies = vec![RigidBodySetup::disc(0.5)];
/// let flow = FlowSetup { shear: 1.0, ..FlowSetup::default() };
/// let setup = Setup { region: Region::Plane, flow, rigid_bodies, droplets: Vec::new(), ..Setup::default() };
/// let mut scene = setup.build()?.scene;
/// let path = std::env::temp_dir().join("a-disc.csv");
/// let mut rows = BodiesCsv::create(&path, scene.system_mut())?;
/// scene.run(0.2).observe(Every::Time(0.1), &mut rows).go()?;
/// let text = std::fs::read_to_string(&path)?;
/// assert!(text.starts_with("time,body,x,y,velocity_x,velocity_y,angle_degrees,spin,origin\n"));
/// assert_eq!(text.lines().count(), 1 + 3);
/// # std::fs::remove_file(&path)?;
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug)]
pub struct BodiesCsv {
    table: CsvTable,
}

impl BodiesCsv {
    /// Creates an observer of all bodies that writes to `path`. In a resumed run, past time 0, the table begins with
    /// the rows that the checkpoint holds.
    ///
    /// # Errors
    /// Returns [`OutputError::Empty`] if the scene has no such body, [`OutputError::Scene`] if a body cannot be
    /// measured, and [`OutputError::Write`] if the file cannot be written.
    pub fn create<H: Hydrodynamics>(path: impl AsRef<Path>, system: &mut System<H>) -> Result<Self, OutputError> {
        let mut names: Vec<&'static str> = Vec::new();
        for row in rows(system)? {
            names.extend(row.iter().map(|(name, _)| *name).filter(|name| !names.contains(name)).collect::<Vec<_>>());
        }
        if names.is_empty() {
            return Err(OutputError::Empty("a table of a scene without rigid or elastic bodies"));
        }
        Ok(Self { table: CsvTable::of_run(path, &names, system, "table of all bodies")? })
    }

    /// Returns true if a scene has bodies for this table.
    #[must_use]
    pub fn has_bodies<H: Hydrodynamics>(system: &System<H>) -> bool {
        system.bodies::<RigidBody>().next().is_some()
            || system.bodies::<Shell>().next().is_some()
            || system.bodies::<Fibre>().next().is_some()
            || system.bodies::<Solid>().next().is_some()
            || system.bodies::<GelInBox>().next().is_some()
            || system.bodies::<GelInDroplet>().next().is_some()
            || system.bodies::<GelInLayer>().next().is_some()
    }

    /// Returns the names and values of the row of each body in the present state, the time and the body's number first.
    ///
    /// # Errors
    /// Returns [`OutputError::Scene`] if a body cannot be measured.
    pub fn rows<H: Hydrodynamics>(system: &mut System<H>) -> Result<Vec<Vec<(&'static str, f64)>>, OutputError> {
        rows(system)
    }

    /// Returns the table of all rows, in a resumed run also of those before.
    #[must_use]
    pub fn table(&self) -> &CsvTable {
        &self.table
    }
}

impl<H: Hydrodynamics> Observer<H> for BodiesCsv {
    fn observe(&mut self, system: &mut System<H>) -> Result<(), Box<dyn Error + Send + Sync>> {
        let rows = rows(system)?.into_iter().map(|row| self.table.row(row.into_iter()));
        let rows = rows.collect::<Result<Vec<_>, _>>()?;
        Ok(self.table.push_rows(system, &rows)?)
    }
}

/// Handles of all bodies of a kind.
fn all<B: motile::scene::Body, H: Hydrodynamics>(system: &System<H>) -> Vec<Handle<B>> {
    system.bodies().map(|(handle, _)| handle).collect()
}

/// Returns the columns and values of each body.
fn rows<H: Hydrodynamics>(system: &mut System<H>) -> Result<Vec<Row>, OutputError> {
    let time = system.time();
    let row = |index: usize, values: &[(&'static str, f64)]| -> Row {
        [("time", time), ("body", index as f64)].into_iter().chain(values.iter().copied()).collect()
    };
    let mut rows = Vec::new();
    for handle in all::<RigidBody, H>(system) {
        let seen = system.observe(handle)?;
        let mut values = vec![
            ("x", seen.centre.x),
            ("y", seen.centre.y),
            ("velocity_x", seen.velocity.x),
            ("velocity_y", seen.velocity.y),
            ("angle_degrees", seen.angle.to_degrees()),
            ("spin", seen.spin),
        ];
        if system.body(handle)?.is_held() {
            let force = [("force_x", seen.force.x), ("force_y", seen.force.y), ("torque", seen.torque)];
            values.extend(force);
        }
        rows.push(row(handle.index(), &values));
    }
    for handle in all::<Shell, H>(system) {
        let (seen, shape) = (system.observe(handle)?, system.deformation(handle)?);
        let values = [
            ("x", shape.centroid.x),
            ("y", shape.centroid.y),
            ("velocity_x", shape.velocity.x),
            ("velocity_y", shape.velocity.y),
            ("deformation", shape.by_moments),
            ("inclination_degrees", shape.angle_of_moments.map_or(f64::NAN, f64::to_degrees)),
            ("area", shape.area),
            ("perimeter", shape.perimeter),
            ("stretch_max", seen.stretches[0]),
            ("stretch_min", seen.stretches[1]),
            ("tension_max", seen.tensions[0]),
            ("tension_min", seen.tensions[1]),
            ("energy", seen.energy),
        ];
        rows.push(row(handle.index(), &values));
    }
    for handle in all::<Fibre, H>(system) {
        let seen = system.observe(handle)?;
        let [start, end] = seen.end_forces;
        let values = [
            ("x", seen.centre.x),
            ("y", seen.centre.y),
            ("velocity_x", seen.velocity.x),
            ("velocity_y", seen.velocity.y),
            ("length", seen.length),
            ("stretch_max", seen.stretches[0]),
            ("stretch_min", seen.stretches[1]),
            ("curvature_max", seen.curvatures[0]),
            ("curvature_min", seen.curvatures[1]),
            ("energy", seen.stretching_energy + seen.bending_energy),
            ("force_start_x", start.x),
            ("force_start_y", start.y),
            ("force_end_x", end.x),
            ("force_end_y", end.y),
            ("torque_start", seen.end_torques[0]),
            ("torque_end", seen.end_torques[1]),
            ("target_force_x", seen.target_force.x),
            ("target_force_y", seen.target_force.y),
        ];
        rows.push(row(handle.index(), &values));
    }
    for handle in all::<Solid, H>(system) {
        let seen = system.observe(handle)?;
        let values = [
            ("x", seen.centroid.x),
            ("y", seen.centroid.y),
            ("drift_x", seen.drift.x),
            ("drift_y", seen.drift.y),
            ("largest_displacement", seen.largest_displacement),
            ("largest_normal_displacement", seen.largest_normal_displacement),
            ("energy", seen.elastic_energy),
            ("smallest_jacobian", seen.smallest_jacobian),
        ];
        rows.push(row(handle.index(), &values));
    }
    let gels = all::<GelInBox, H>(system).into_iter().map(|handle| Ok((handle.index(), system.observe(handle)?)));
    let mut gels = gels.collect::<Result<Vec<_>, OutputError>>()?;
    for handle in all::<GelInDroplet, H>(system) {
        gels.push((handle.index(), system.observe(handle)?));
    }
    for handle in all::<GelInLayer, H>(system) {
        gels.push((handle.index(), system.observe(handle)?));
    }
    for (index, seen) in gels {
        let values = [
            ("polarisation_x", seen.polarisation[0]),
            ("polarisation_y", seen.polarisation[1]),
            ("defects", seen.defects.len() as f64),
            ("energy", seen.director_energy),
        ];
        rows.push(row(index, &values));
    }
    Ok(rows)
}

/// Observer that writes what there is of the whole flow to a CSV file, a row at each call.
///
/// The columns are `time`, `pressure_gradient_x` and `pressure_gradient_y` (the mean one, stress per length;
/// empty in a tube that is not straight),
/// `smallest_gap` of the run so far between bodies and to walls (length), and in a periodic box the mean particle
/// stress `stress_xx`, `stress_xy`, `stress_yy` (stress; [`motile::scene::Stress`]) and the `effective_viscosity` in a
/// shear. Fields are empty for what does not exist.
///
/// ```
/// use motile::prelude::*;
/// use motile_output::FlowCsv;
///
/// let flow = FlowSetup { shear: 1.0, ..FlowSetup::default() };
/// let mut scene = Setup { flow, droplets: vec![DropletSetup::passive(50.0)], ..Setup::default() }.build()?.scene;
/// let path = std::env::temp_dir().join("a-flow.csv");
/// let mut rows = FlowCsv::create(&path, scene.system_mut())?;
/// scene.run(0.2).observe(Every::Time(0.1), &mut rows).go()?;
/// let viscosity = rows.table().curve("time", "effective_viscosity")?;
/// assert!(viscosity.last().is_some_and(|(_, viscosity)| *viscosity > 100.0));
/// # std::fs::remove_file(&path)?;
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug)]
pub struct FlowCsv {
    table: CsvTable,
}

impl FlowCsv {
    /// Creates an observer of the flow that writes to `path`. In a resumed run, past time 0, the table begins with the
    /// rows that the checkpoint holds.
    ///
    /// # Errors
    /// Returns [`OutputError::Scene`] if the flow cannot be computed, and [`OutputError::Write`] if the file cannot be
    /// written.
    pub fn create<H: Hydrodynamics>(path: impl AsRef<Path>, system: &mut System<H>) -> Result<Self, OutputError> {
        let names: Vec<&str> = flow_row(system)?.into_iter().map(|(name, _)| name).collect();
        Ok(Self { table: CsvTable::of_run(path, &names, system, "table of the flow")? })
    }

    /// Returns the table of all rows, in a resumed run also of those before.
    #[must_use]
    pub fn table(&self) -> &CsvTable {
        &self.table
    }
}

impl<H: Hydrodynamics> Observer<H> for FlowCsv {
    fn observe(&mut self, system: &mut System<H>) -> Result<(), Box<dyn Error + Send + Sync>> {
        let row = self.table.row(flow_row(system)?.into_iter())?;
        Ok(self.table.push_state(system, &row)?)
    }
}

/// Returns the columns and values of the flow.
fn flow_row<H: Hydrodynamics>(system: &mut System<H>) -> Result<Row, OutputError> {
    system.evaluate()?;
    let [along, up] = system.report().mean_pressure_gradient;
    let gaps = [system.minimum_gap(), system.minimum_wall_gap()];
    let gap = gaps.into_iter().flatten().reduce(f64::min);
    let mut row = vec![
        ("time", system.time()),
        ("pressure_gradient_x", along),
        ("pressure_gradient_y", up),
        ("smallest_gap", gap.unwrap_or(f64::NAN)),
    ];
    if let Ok(stress) = system.stress() {
        let [[xx, xy], [_, yy]] = stress.of_particles();
        let viscosity = stress.effective_viscosity().unwrap_or(f64::NAN);
        row.extend([("stress_xx", xx), ("stress_xy", xy), ("stress_yy", yy), ("effective_viscosity", viscosity)]);
    }
    Ok(row)
}

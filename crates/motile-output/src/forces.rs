//! Tables of forces on bodies and walls, as CSV files.

use std::error::Error;
use std::path::Path;

use motile::base::Vec2;
use motile::elastic_solids::RigidBody;
use motile::scene::{ChannelForces, Hydrodynamics, Observer, System};

use crate::{CsvTable, OutputError};

/// Observer that writes the forces along a channel to a CSV file, a row at each call.
///
/// The columns are `time` and the force of the fluid on all bodies together, `force_bodies_x` and `force_bodies_y`
/// (force). Between straight walls ([`motile::scene::ChannelForces`]), there are the `pressure_drop` of a period
/// (stress) and the forces along x on the walls, `force_lower` and `force_upper`. If a flux drives the channel,
/// `extra_pressure_drop` is the part of the pressure drop that the bodies cause. Closed rigid walls add the force on
/// all of them, `force_obstacles_x` and `force_obstacles_y`, and the torque on one alone, `torque_obstacle`. Friction
/// of the fluid adds the force on the plates, `force_plates`. The forces on each held body are in [`crate::BodiesCsv`].
///
/// ```
/// use motile::prelude::*;
/// use motile::setup::RigidBodySetup;
/// use motile_output::ForcesCsv;
///
/// let region = Region::Channel { length: 6.0, width: 3.0, drive: Drive::Flux(1.0) };
/// let rigid_bodies = vec![RigidBodySetup { held: true, ..RigidBodySetup::disc(0.5) }];
/// let setup = Setup { region, viscosity: 1.0, rigid_bodies, droplets: Vec::new(), ..Setup::default() };
/// let mut scene = setup.build()?.scene;
/// let path = std::env::temp_dir().join("a-post.csv");
/// let mut rows = ForcesCsv::create(&path, scene.system_mut())?;
/// scene.run(0.1).observe(Every::Time(0.1), &mut rows).go()?;
/// let drag = rows.table().curve("time", "force_bodies_x")?;
/// assert!((drag[0].1 - 16.71876).abs() < 1e-5);
/// # std::fs::remove_file(&path)?;
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug)]
pub struct ForcesCsv {
    table: CsvTable,
}

impl ForcesCsv {
    /// Creates an observer of the forces that writes to `path`. In a resumed run, past time 0, the table begins with
    /// the rows that the checkpoint holds.
    ///
    /// # Errors
    /// Returns [`OutputError::Scene`] if the flow cannot be computed, and [`OutputError::Write`] if the file cannot be
    /// written.
    pub fn create<H: Hydrodynamics>(path: impl AsRef<Path>, system: &mut System<H>) -> Result<Self, OutputError> {
        let names: Vec<&str> = row(system)?.into_iter().map(|(name, _)| name).collect();
        Ok(Self { table: CsvTable::of_run(path, &names, system, "table of the forces")? })
    }

    /// Returns true if a scene has a body that is held or moved.
    #[must_use]
    pub fn has_held_bodies<H: Hydrodynamics>(system: &System<H>) -> bool {
        system.bodies::<RigidBody>().any(|(_, body)| body.is_held())
    }

    /// Returns the table of all rows, in a resumed run also of those before.
    #[must_use]
    pub fn table(&self) -> &CsvTable {
        &self.table
    }
}

impl<H: Hydrodynamics> Observer<H> for ForcesCsv {
    fn observe(&mut self, system: &mut System<H>) -> Result<(), Box<dyn Error + Send + Sync>> {
        let row = self.table.row(row(system)?.into_iter())?;
        Ok(self.table.push_state(system, &row)?)
    }
}

/// Returns the columns and values of the forces.
fn row<H: Hydrodynamics>(system: &mut System<H>) -> Result<Vec<(&'static str, f64)>, OutputError> {
    let force = system.force_on_bodies()?;
    let mut row = vec![("time", system.time()), ("force_bodies_x", force.x), ("force_bodies_y", force.y)];
    let (obstacles, rubs) = (system.obstacle_loads()?, system.hydrodynamics().friction() > 0.0);
    if let Some(forces) = system.channel_forces()? {
        let ChannelForces { pressure_drop, extra_pressure_drop, on_walls, on_plates, .. } = forces;
        row.push(("pressure_drop", pressure_drop));
        row.extend(extra_pressure_drop.map(|drop| ("extra_pressure_drop", drop)));
        row.extend([("force_lower", on_walls[0]), ("force_upper", on_walls[1])]);
        row.extend(rubs.then_some(("force_plates", on_plates)));
    }
    // Walls that are not closed have no forces of their own.
    if !obstacles.is_empty() && obstacles.iter().all(Option::is_some) {
        let all: Vec2 = obstacles.iter().flatten().map(|load| load.force).sum();
        let torque = if let [Some(load)] = obstacles[..] { load.torque } else { f64::NAN };
        row.extend([("force_obstacles_x", all.x), ("force_obstacles_y", all.y), ("torque_obstacle", torque)]);
    }
    Ok(row)
}

/// Observer that writes the shear stress along the straight walls of a channel to a CSV file, a row for each place at
/// each call.
///
/// The columns are `time`, `x` (length), and the shear stress of the fluid on the lower and on the upper wall along x,
/// `lower` and `upper` (stress).
///
/// ```
/// use motile::prelude::*;
/// use motile_output::WallShearCsv;
///
/// let region = Region::Channel { length: 6.0, width: 2.0, drive: Drive::Gradient(-3.0) };
/// let mut scene = Setup { region, droplets: Vec::new(), ..Setup::default() }.build()?.scene;
/// let path = std::env::temp_dir().join("a-wall.csv");
/// let mut rows = WallShearCsv::create(&path, scene.system_mut(), 8)?;
/// scene.run(0.1).observe(Every::Time(0.1), &mut rows).go()?;
/// assert!(rows.table().curve("x", "upper")?.iter().all(|(_, stress)| (stress - 3.0).abs() < 1e-9));
/// # std::fs::remove_file(&path)?;
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug)]
pub struct WallShearCsv {
    table: CsvTable,
    places: usize,
}

impl WallShearCsv {
    /// Creates an observer of the shear stress at so many places of each wall that writes to `path`. In a resumed run,
    /// past time 0, the table begins with the rows that the checkpoint holds.
    ///
    /// # Errors
    /// Returns [`OutputError::Empty`] for a scene without straight walls, [`OutputError::Scene`] if the flow cannot be
    /// computed, and [`OutputError::Write`] if the file cannot be written.
    pub fn create<H: Hydrodynamics>(
        path: impl AsRef<Path>,
        system: &mut System<H>,
        places: usize,
    ) -> Result<Self, OutputError> {
        if system.channel_forces()?.is_none() {
            return Err(OutputError::Empty("a table of the shear stress on walls of a scene without straight walls"));
        }
        let names = ["time", "x", "lower", "upper"];
        Ok(Self { table: CsvTable::of_run(path, &names, system, "table of the walls")?, places })
    }

    /// Returns the table of all rows, in a resumed run also of those before.
    #[must_use]
    pub fn table(&self) -> &CsvTable {
        &self.table
    }
}

impl<H: Hydrodynamics> Observer<H> for WallShearCsv {
    fn observe(&mut self, system: &mut System<H>) -> Result<(), Box<dyn Error + Send + Sync>> {
        let Some([lower, upper]) = system.wall_shear(self.places)? else { return Ok(()) };
        let domain = system.hydrodynamics().fluid_view().domain;
        let (time, period) = (system.time(), domain.periods[0].unwrap_or_default());
        let x = (0..self.places).map(|k| domain.origin[0] + period * k as f64 / self.places as f64);
        let rows: Vec<[f64; 4]> =
            x.zip(lower.iter().zip(&upper)).map(|(x, (lower, upper))| [time, x, *lower, *upper]).collect();
        Ok(self.table.push_rows(system, &rows)?)
    }
}

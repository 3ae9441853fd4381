//! Trajectory of a droplet as a CSV file.

pub(crate) mod meter;

use std::path::Path;

use motile::active_interface::ActiveDroplet;
use motile::analysis::trajectory::{Trajectory, TrajectoryRecord};
use motile::base::Vec2;
use motile::interior::ParticlesInDroplet;
use motile::scene::{Handle, Hydrodynamics, Observer, System};

use crate::{CsvTable, OutputError, SolidMeter, Track};
use meter::DropletMeter;

/// Columns of particles that diffuse inside.
const INSIDE: [&str; 2] = ["number_inside", "exchange_flux"];

/// Observer that measures a droplet and writes the observables to a CSV file, a row at each call.
///
/// The columns are the entries of [`TrajectoryRecord::entries`], without the columns of walls if there are none. If
/// particles diffuse inside the droplet, their number and the flux of exchange follow (`number_inside`,
/// `exchange_flux`, as with a well-mixed inside), and if there are elastic solids the quantities of
/// [`SolidMeter::NAMES`].
///
/// ```
/// use motile::prelude::*;
/// use motile_output::TrajectoryCsv;
///
/// let Built { mut scene, droplets, .. } = Setup::default().build()?;
/// let path = std::env::temp_dir().join("a-trajectory.csv");
/// let mut rows = TrajectoryCsv::create(&path, scene.system_mut(), droplets[0])?;
/// scene.run(0.5).observe(Every::Time(0.1), &mut rows).go()?;
/// rows.finish(scene.system_mut())?;
/// assert!(std::fs::read_to_string(&path)?.starts_with("time,x,y,"));
/// # std::fs::remove_file(&path)?;
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug)]
pub struct TrajectoryCsv {
    meter: DropletMeter,
    last: Option<TrajectoryRecord>,
    centre_line: Option<f64>,
    table: CsvTable,
    inside: Option<Handle<ParticlesInDroplet>>,
    solids: Option<SolidMeter>,
    last_solids: Option<[f64; 8]>,
}

impl TrajectoryCsv {
    /// Creates an observer of a droplet that writes to `path`. In a resumed run, past time 0, the table begins with the
    /// rows that the checkpoint holds, and the others follow as if the run had not been interrupted.
    ///
    /// # Errors
    /// Returns [`OutputError::Write`]; [`OutputError::Observer`] for a state that cannot be measured.
    pub fn create<H: Hydrodynamics>(
        path: impl AsRef<Path>,
        system: &mut System<H>,
        droplet: Handle<ActiveDroplet>,
    ) -> Result<Self, OutputError> {
        let walls = system.hydrodynamics().fluid_view().domain.walls;
        let centre_line = walls.map(|[bottom, top]| 0.5 * (bottom + top));
        let (solids, meter) = (SolidMeter::of(system), DropletMeter::of(system, droplet)?);
        let mut names = meter.names().to_vec();
        let inside = system.bodies::<ParticlesInDroplet>().find(|(_, body)| body.droplet() == droplet);
        let inside = inside.map(|(handle, _)| handle);
        names.extend(inside.iter().flat_map(|_| INSIDE));
        names.extend(solids.iter().flat_map(|_| SolidMeter::NAMES));
        let table = CsvTable::of_run(path, &names, system, &format!("trajectory of body {}", droplet.index()))?;
        Ok(Self { meter, last: None, centre_line, table, inside, solids, last_solids: None })
    }

    /// Returns the last record; `None` before the run.
    #[must_use]
    pub fn last(&self) -> Option<&TrajectoryRecord> {
        self.last.as_ref()
    }

    /// Returns the table of all rows, in a resumed run also of those before.
    #[must_use]
    pub fn table(&self) -> &CsvTable {
        &self.table
    }

    /// Returns the times and positions of the centroid.
    #[must_use]
    pub fn track(&self) -> Track {
        let columns = self.table.curve("time", "x").and_then(|x| Ok((x, self.table.curve("time", "y")?)));
        let (x, y) = columns.unwrap_or_default();
        x.into_iter().zip(y).map(|((time, x), (_, y))| (time, Vec2::new(x, y))).collect()
    }

    /// Returns the trajectory across the channel, with heights from the centre line; without walls from the height of
    /// the first row.
    ///
    /// # Errors
    /// Returns no error for the rows of a run.
    pub fn trajectory(&self) -> Result<Trajectory, OutputError> {
        let column = |name: &str| -> Result<Vec<f64>, OutputError> {
            Ok(self.table.curve("time", name)?.into_iter().map(|(_, value)| value).collect())
        };
        let (times, mut heights) = (column("time")?, column("y")?);
        let origin = self.centre_line.or(heights.first().copied()).unwrap_or(0.0);
        heights.iter_mut().for_each(|y| *y -= origin);
        let trajectory = Trajectory::new(times, heights, column("speed")?)?;
        Ok(trajectory.with_lateral_velocities(column("velocity_y")?)?)
    }

    /// Returns the last measurement of the solids ([`SolidMeter::NAMES`]); `None` without solids.
    #[must_use]
    pub fn last_solids(&self) -> Option<&[f64; 8]> {
        self.last_solids.as_ref()
    }

    /// Completes the file: adds the last state of a run that broke off, if it can be measured, and writes all rows.
    ///
    /// # Errors
    /// Returns [`OutputError::Write`] if the file cannot be written.
    pub fn finish<H: Hydrodynamics>(&mut self, system: &mut System<H>) -> Result<(), OutputError> {
        if self.table.rows().last().map(|row| row[0]) != Some(system.time()) {
            // A state from which a run cannot continue may be one that cannot be measured.
            if let Ok(row) = self.measure(system) {
                self.table.push(&row)?;
            }
        }
        self.table.flush()
    }
}

impl TrajectoryCsv {
    /// Returns the row of the present state.
    fn measure<H: Hydrodynamics>(
        &mut self,
        system: &mut System<H>,
    ) -> Result<Vec<f64>, Box<dyn std::error::Error + Send + Sync>> {
        let record = self.meter.record(system)?;
        let mut row = self.meter.row(&record);
        self.last = Some(record);
        if let Some(inside) = self.inside {
            let seen = system.body(inside)?.seen();
            row.extend([seen.number, seen.flux]);
        }
        if let Some(meter) = &mut self.solids {
            let values = meter.measure(system)?;
            row.extend(values);
            self.last_solids = Some(values);
        }
        Ok(row)
    }
}

impl<H: Hydrodynamics> Observer<H> for TrajectoryCsv {
    fn observe(&mut self, system: &mut System<H>) -> Result<(), Box<dyn std::error::Error + Send + Sync>> {
        let row = self.measure(system)?;
        Ok(self.table.push_state(system, &row)?)
    }
}

#[cfg(test)]
mod tests;

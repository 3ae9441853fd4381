//! The trajectory of a droplet as a CSV file.

use std::path::Path;

use motile::active_interface::ActiveDroplet;
use motile::active_interface::trajectory::{TrajectoryRecord, TrajectoryRecorder};
use motile::ib_core::{Handle, Hydrodynamics, Observer, System};
use motile::interior_fields::ParticlesInDroplet;

use crate::{CsvTable, Error, SolidMeter, Track};

/// Columns that only channels have, and of them those that elastic walls do not have: gap and flow beside the droplet
/// are those up to rigid walls.
const BETWEEN_WALLS: [&str; 4] = ["gap", "pressure_gradient", "net_flux", "retrograde_flow"];
const BETWEEN_RIGID_WALLS: [&str; 3] = ["gap", "net_flux", "retrograde_flow"];
/// And those that walls that are not straight do not have.
const BETWEEN_STRAIGHT_WALLS: [&str; 2] = ["net_flux", "retrograde_flow"];

/// Columns of particles that diffuse inside.
const INSIDE: [&str; 2] = ["number_inside", "exchange_flux"];

/// Records a droplet whenever it is called and writes what it sees to a CSV file.
///
/// The columns are those of [`TrajectoryRecord::entries`], without those about walls where there are none, where
/// particles diffuse inside the droplet their number and what is exchanged (`number_inside`, `exchange_flux`, as with
/// a well-mixed inside), and where there are elastic solids those of [`SolidMeter::NAMES`].
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
    records: TrajectoryRecorder,
    table: CsvTable,
    columns: Vec<usize>,
    inside: Option<Handle<ParticlesInDroplet>>,
    solids: Option<SolidMeter>,
    last_solids: Option<[f64; 8]>,
    /// The time from which a trajectory that was begun before goes on: that state was due for a row or not.
    resumed: Option<f64>,
}

impl TrajectoryCsv {
    /// A recorder of a droplet that writes to `path`. Where the system is past time 0, as after resuming, the rows up
    /// to its time that the file has stay, and the others follow as if the run had not been cut.
    ///
    /// # Errors
    /// [`Error::Write`]; [`Error::Observer`]: a state that cannot be measured.
    pub fn create<H: Hydrodynamics>(
        path: impl AsRef<Path>,
        system: &mut System<H>,
        droplet: Handle<ActiveDroplet>,
    ) -> Result<Self, Error> {
        let curved = system.hydrodynamics().walls().is_some();
        let walls = system.hydrodynamics().discretisation().domain.walls.is_some();
        let records = TrajectoryRecorder::new(droplet);
        let solids = SolidMeter::of(system);
        let records = if walls && !curved && solids.is_none() { records.with_gap_flow() } else { records };
        let mut probe = records.clone();
        probe.observe(system).map_err(Error::Observer)?;
        let entries = probe.records()[0].entries();
        let wanted = |k: &usize| {
            let name = entries[*k].0;
            (walls || !BETWEEN_WALLS.contains(&name))
                && (solids.is_none() || !BETWEEN_RIGID_WALLS.contains(&name))
                && !(curved && BETWEEN_STRAIGHT_WALLS.contains(&name))
        };
        let columns: Vec<usize> = (0..entries.len()).filter(wanted).collect();
        let mut names: Vec<&str> = columns.iter().map(|&k| entries[k].0).collect();
        let inside = system.bodies::<ParticlesInDroplet>().find(|(_, body)| body.droplet() == droplet);
        let inside = inside.map(|(handle, _)| handle);
        names.extend(inside.iter().flat_map(|_| INSIDE));
        names.extend(solids.iter().flat_map(|_| SolidMeter::NAMES));
        // A run from the start leaves nothing of another one that the file may have.
        let begun = system.time() > 0.0;
        let table = if begun { CsvTable::resume(path, &names, system.time()) } else { CsvTable::create(path, &names) }?;
        let resumed = (!table.rows().is_empty()).then(|| system.time());
        Ok(Self { records, table, columns, inside, solids, last_solids: None, resumed })
    }

    /// Everything measured, record by record.
    #[must_use]
    pub fn records(&self) -> &TrajectoryRecorder {
        &self.records
    }

    /// Everything measured, by column.
    #[must_use]
    pub fn table(&self) -> &CsvTable {
        &self.table
    }

    /// Times and positions of the centroid.
    #[must_use]
    pub fn track(&self) -> Track {
        self.records.records().iter().map(|record| (record.time, record.observables.centroid)).collect()
    }

    /// What was last measured of the solids ([`SolidMeter::NAMES`]); `None` without solids.
    #[must_use]
    pub fn last_solids(&self) -> Option<&[f64; 8]> {
        self.last_solids.as_ref()
    }

    /// Makes sure that everything is in the file, also the last state of a run that broke off, if it can be measured.
    ///
    /// # Errors
    /// [`Error::Write`].
    pub fn finish<H: Hydrodynamics>(&mut self, system: &mut System<H>) -> Result<(), Error> {
        if self.records.records().last().map(|record| record.time) != Some(system.time()) {
            // A state after which nothing can go on may be one that cannot be measured.
            let _ = self.observe(system);
        }
        self.table.flush()
    }
}

impl<H: Hydrodynamics> Observer<H> for TrajectoryCsv {
    fn observe(&mut self, system: &mut System<H>) -> Result<(), Box<dyn std::error::Error + Send + Sync>> {
        self.records.observe(system)?;
        let entries = self.records.records().last().map(TrajectoryRecord::entries).unwrap_or_default();
        let mut row: Vec<f64> = self.columns.iter().map(|&k| entries[k].1.unwrap_or(f64::NAN)).collect();
        if let Some(inside) = self.inside {
            let seen = system.body(inside)?.seen();
            row.extend([seen.number, seen.flux]);
        }
        if let Some(meter) = &mut self.solids {
            let values = meter.measure(system)?;
            row.extend(values);
            self.last_solids = Some(values);
        }
        if self.resumed.take().is_none_or(|start| start < system.time()) {
            self.table.push(&row)?;
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests;

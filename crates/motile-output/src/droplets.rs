//! Table of all droplets of a scene as a CSV file.

use std::error::Error;
use std::path::Path;

use motile::active_interface::ActiveDroplet;
use motile::scene::{Handle, Hydrodynamics, Observer, System};

use crate::trajectory::meter::DropletMeter;
use crate::{CsvTable, OutputError};

/// Observer that measures all droplets and writes their observables to one CSV file, at each call a row for each of
/// them.
///
/// The columns are `time`, `droplet` (the [`Handle::index`] of the droplet in its scene) and the observables of
/// [`crate::TrajectoryCsv`] without those of solids and of particles inside. Centroids `x` and `y` (length) are not
/// wrapped: a droplet that leaves a periodic region on one side goes on beyond it, and does not return on the other.
/// Droplets that are added or removed during the run have rows for as long as they are there.
///
/// ```
/// use motile::prelude::*;
/// use motile_output::DropletsCsv;
///
/// let droplets = [-2.0, 2.0].map(|x| DropletSetup { centre: [x, 0.0], ..DropletSetup::default() }).to_vec();
/// let region = Region::Box { lengths: [8.0, 4.0] };
/// let Built { mut scene, .. } = Setup { region, droplets, ..Setup::default() }.build()?;
/// let path = std::env::temp_dir().join("two-droplets.csv");
/// let mut rows = DropletsCsv::create(&path, scene.system_mut())?;
/// scene.run(0.2).observe(Every::Time(0.1), &mut rows).go()?;
/// let text = std::fs::read_to_string(&path)?;
/// assert!(text.starts_with("time,droplet,x,y,") && text.lines().count() == 1 + 3 * 2);
/// # std::fs::remove_file(&path)?;
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug)]
pub struct DropletsCsv {
    table: CsvTable,
}

impl DropletsCsv {
    /// Observer of all droplets that writes to `path`. In a resumed run, past time 0, the table begins with the rows
    /// that the checkpoint holds.
    ///
    /// # Errors
    /// [`OutputError::Empty`]: a scene without droplets; [`OutputError::Write`]; [`OutputError::Observer`]: a state
    /// that cannot be measured.
    pub fn create<H: Hydrodynamics>(path: impl AsRef<Path>, system: &mut System<H>) -> Result<Self, OutputError> {
        let first = system.bodies::<ActiveDroplet>().next().map(|(handle, _)| handle);
        let first = first.ok_or(OutputError::Empty("a table of a scene without droplets"))?;
        let mut names = DropletMeter::of(system, first)?.names().to_vec();
        names.insert(1, "droplet");
        Ok(Self { table: CsvTable::of_run(path, &names, system, "table of all droplets")? })
    }

    /// Table of all rows, in a resumed run also of those before.
    #[must_use]
    pub fn table(&self) -> &CsvTable {
        &self.table
    }
}

impl<H: Hydrodynamics> Observer<H> for DropletsCsv {
    fn observe(&mut self, system: &mut System<H>) -> Result<(), Box<dyn Error + Send + Sync>> {
        let droplets: Vec<Handle<ActiveDroplet>> = system.bodies().map(|(handle, _)| handle).collect();
        let mut rows = Vec::with_capacity(droplets.len());
        for droplet in droplets {
            let meter = DropletMeter::of(system, droplet)?;
            let mut row = meter.row(&meter.record(system)?);
            row.insert(1, droplet.index() as f64);
            rows.push(row);
        }
        Ok(self.table.push_rows(system, &rows)?)
    }
}

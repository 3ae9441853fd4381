//! Table of all droplets of a scene as a CSV file.

use std::error::Error;
use std::path::Path;

use motile::active_interface::ActiveDroplet;
use motile::scene::{Handle, Hydrodynamics, Observer, System};

use crate::trajectory::meter::DropletMeter;
use crate::{CsvTable, OutputError};

/// Column of the number of the droplet.
const DROPLET: &str = "droplet";

/// Observer that measures all droplets and writes their observables to one CSV file: at each call, one row for each of
/// them.
///
/// The columns are `time`, `droplet` (the [`Handle::index`] of the droplet in its scene) and the observables of
/// [`crate::TrajectoryCsv`] without the observables of solids and of particles inside: all that some droplet has, with
/// empty fields for a droplet that lacks them. Centroids `x` and `y` (length) are not wrapped: a droplet that leaves a
/// periodic region on one side continues beyond it, and does not return on the other. Droplets that are added or
/// removed during the run have rows for as long as they are there; one that is added may not have observables that no
/// droplet had at the start.
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
    /// Creates an observer of all droplets that writes to `path`. In a resumed run, past time 0, the table begins with
    /// the rows that the checkpoint holds.
    ///
    /// # Errors
    /// Returns [`OutputError::Empty`] for a scene without droplets; [`OutputError::Write`]; [`OutputError::Observer`]
    /// for a state that cannot be measured.
    pub fn create<H: Hydrodynamics>(path: impl AsRef<Path>, system: &mut System<H>) -> Result<Self, OutputError> {
        let mut names = Vec::new();
        for droplet in all(system) {
            merge(&mut names, DropletMeter::of(system, droplet)?.names());
        }
        if names.is_empty() {
            return Err(OutputError::Empty("a table of a scene without droplets"));
        }
        names.insert(1, DROPLET);
        Ok(Self { table: CsvTable::of_run(path, &names, system, "table of all droplets")? })
    }

    /// Returns the table of all rows, in a resumed run also of those before.
    #[must_use]
    pub fn table(&self) -> &CsvTable {
        &self.table
    }
}

impl<H: Hydrodynamics> Observer<H> for DropletsCsv {
    fn observe(&mut self, system: &mut System<H>) -> Result<(), Box<dyn Error + Send + Sync>> {
        let droplets = all(system);
        let mut rows = Vec::with_capacity(droplets.len());
        for droplet in droplets {
            let meter = DropletMeter::of(system, droplet)?;
            let values = meter.row(&meter.record(system)?);
            let named = meter.names().iter().copied().zip(values).chain([(DROPLET, droplet.index() as f64)]);
            rows.push(self.table.row(named)?);
        }
        Ok(self.table.push_rows(system, &rows)?)
    }
}

/// Returns all droplets.
fn all<H: Hydrodynamics>(system: &System<H>) -> Vec<Handle<ActiveDroplet>> {
    system.bodies().map(|(handle, _)| handle).collect()
}

/// Adds the names that are missing, each behind the name that it follows.
fn merge(names: &mut Vec<&'static str>, others: &[&'static str]) {
    let mut place = 0;
    for other in others {
        let known = names.iter().position(|name| name == other);
        if known.is_none() {
            names.insert(place, other);
        }
        place = known.unwrap_or(place) + 1;
    }
}

#[cfg(test)]
mod tests;

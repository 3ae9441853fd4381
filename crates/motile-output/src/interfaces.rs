//! Interfaces that are periodic along x: a table of all of them, and their lines.

use std::error::Error;
use std::path::Path;

use motile::active_interface::ActiveInterface;
use motile::base::Vec2;
use motile::scene::{Handle, Hydrodynamics, Observer, System};

use crate::{CsvTable, OutputError, snapshot::at_markers};

/// Observer that measures all interfaces that are periodic along x and writes their observables to one CSV file: at
/// each call, one row for each of them.
///
/// The columns are `time`, `interface` (the [`Handle::index`] of the interface in its scene) and the entries of
/// [`motile::active_interface::observables::PeriodicObservables`]: height, length, number of particles, flux,
/// velocity, modes.
///
/// ```
/// use motile::prelude::*;
/// use motile::setup::InterfaceSetup;
/// use motile_output::InterfacesCsv;
///
/// let interfaces = vec![InterfaceSetup::active(-0.5)];
/// let Built { mut scene, .. } = Setup { interfaces, droplets: Vec::new(), ..Setup::default() }.build()?;
/// let path = std::env::temp_dir().join("interfaces.csv");
/// let mut rows = InterfacesCsv::create(&path, scene.system_mut())?;
/// scene.run(0.2).observe(Every::Time(0.1), &mut rows).go()?;
/// let text = std::fs::read_to_string(&path)?;
/// assert!(text.starts_with("time,interface,height,length,") && text.lines().count() == 1 + 3);
/// # std::fs::remove_file(&path)?;
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug)]
pub struct InterfacesCsv {
    table: CsvTable,
}

impl InterfacesCsv {
    /// Creates an observer of all interfaces that writes to `path`. In a resumed run, past time 0, the table begins
    /// with the rows that the checkpoint holds.
    ///
    /// # Errors
    /// Returns [`OutputError::Empty`] for a scene without such interfaces; [`OutputError::Write`];
    /// [`OutputError::Observer`] for a state that cannot be measured.
    pub fn create<H: Hydrodynamics>(path: impl AsRef<Path>, system: &mut System<H>) -> Result<Self, OutputError> {
        let rows = rows(system)?;
        let first =
            rows.first().ok_or(OutputError::Empty("a table of a scene without interfaces across the period"))?;
        let names: Vec<&str> = first.iter().map(|(name, _)| *name).collect();
        Ok(Self { table: CsvTable::of_run(path, &names, system, "table of all interfaces")? })
    }

    /// Returns the table of all rows, in a resumed run also of those before.
    #[must_use]
    pub fn table(&self) -> &CsvTable {
        &self.table
    }
}

impl<H: Hydrodynamics> Observer<H> for InterfacesCsv {
    fn observe(&mut self, system: &mut System<H>) -> Result<(), Box<dyn Error + Send + Sync>> {
        let rows = rows(system)?;
        let values = rows.iter().map(|row| row.iter().map(|(_, value)| *value).collect()).collect::<Vec<Vec<f64>>>();
        Ok(self.table.push_rows(system, &values)?)
    }
}

/// Returns the columns and values of each interface.
fn rows<H: Hydrodynamics>(system: &mut System<H>) -> Result<Vec<Vec<(&'static str, f64)>>, OutputError> {
    let time = system.time();
    let handles: Vec<Handle<ActiveInterface>> = system.bodies().map(|(handle, _)| handle).collect();
    let row = |handle: Handle<ActiveInterface>| {
        let seen = system.observe(handle)?;
        let entries = seen.entries().into_iter().map(|(name, value)| (name, value.unwrap_or(f64::NAN)));
        Ok([("time", time), ("interface", handle.index() as f64)].into_iter().chain(entries).collect())
    };
    handles.into_iter().map(row).collect()
}

/// Interface that is periodic along x at one time.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub struct InterfaceLine {
    /// Markers of one period and the next image of the first (length).
    pub markers: Vec<Vec2>,
    /// Concentration there (particles per length), the mean of the segments on both sides; zero without particles.
    pub concentration: Vec<f64>,
}

impl InterfaceLine {
    pub(crate) fn of(interface: &ActiveInterface) -> Self {
        let around = interface.markers().first().map(|first| *first + Vec2::new(interface.advance(), 0.0));
        let markers = interface.markers().iter().copied().chain(around).collect();
        Self { markers, concentration: closed(at_markers(interface.concentrations())) }
    }
}

/// Returns the values with the first one again at the end.
pub(crate) fn closed<T: Copy>(mut values: Vec<T>) -> Vec<T> {
    values.extend(values.first().copied());
    values
}

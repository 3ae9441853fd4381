//! Measurement of the observables of a droplet, for rows of tables.

use std::error::Error;

use motile::active_interface::ActiveDroplet;
use motile::analysis::trajectory::{TrajectoryRecord, TrajectoryRecorder};
use motile::scene::{Handle, Hydrodynamics, Observer, System};

use crate::{OutputError, SolidMeter};

/// Columns that only channels have, and which of them need rigid walls.
const BETWEEN_WALLS: [&str; 4] = ["gap", "pressure_gradient", "net_flux", "retrograde_flow"];
const BETWEEN_RIGID_WALLS: [&str; 3] = ["gap", "net_flux", "retrograde_flow"];
/// Columns that channels of curved walls do not have.
const BETWEEN_STRAIGHT_WALLS: [&str; 2] = ["net_flux", "retrograde_flow"];

/// Measurement of a droplet: the entries of [`TrajectoryRecord`] that its scene has, as rows of tables have them.
#[derive(Debug, Clone)]
pub struct DropletMeter {
    recorder: TrajectoryRecorder,
    columns: Vec<usize>,
    names: Vec<&'static str>,
}

impl DropletMeter {
    /// Creates a meter of a droplet.
    ///
    /// # Errors
    /// Returns [`OutputError::Observer`] for a state that cannot be measured.
    pub fn of<H: Hydrodynamics>(system: &mut System<H>, droplet: Handle<ActiveDroplet>) -> Result<Self, OutputError> {
        let curved = system.hydrodynamics().walls().is_some();
        let walls = system.hydrodynamics().fluid_view().domain.walls.is_some();
        let solids = SolidMeter::of(system).is_some();
        let recorder = TrajectoryRecorder::new(droplet);
        let recorder = if walls && !curved && !solids { recorder.with_gap_flow() } else { recorder };
        let mut meter = Self { recorder, columns: Vec::new(), names: Vec::new() };
        let entries = meter.record(system).map_err(OutputError::Observer)?.entries();
        let absent = |name: &str| {
            (!walls && BETWEEN_WALLS.contains(&name))
                || (solids && BETWEEN_RIGID_WALLS.contains(&name))
                || (curved && BETWEEN_STRAIGHT_WALLS.contains(&name))
        };
        let wanted = entries.iter().map(|(name, _)| *name).enumerate().filter(|(_, name)| !absent(name));
        (meter.columns, meter.names) = wanted.unzip();
        Ok(meter)
    }

    /// Returns the names of the values, the time first.
    #[must_use]
    pub fn names(&self) -> &[&'static str] {
        &self.names
    }

    /// Returns the record of the present state.
    ///
    /// # Errors
    /// Returns an error for a state that cannot be measured.
    pub fn record<H: Hydrodynamics>(
        &self,
        system: &mut System<H>,
    ) -> Result<TrajectoryRecord, Box<dyn Error + Send + Sync>> {
        let mut recorder = self.recorder.clone();
        recorder.observe(system)?;
        Ok(recorder.records().last().cloned().ok_or("no record was made")?)
    }

    /// Returns the values of a record, in the order of the names; not a number if there is none.
    #[must_use]
    pub fn row(&self, record: &TrajectoryRecord) -> Vec<f64> {
        let entries = record.entries();
        self.columns.iter().map(|&k| entries[k].1.unwrap_or(f64::NAN)).collect()
    }
}

//! What is measured while a droplet swims.

use std::{mem::discriminant, path::Path};

use anyhow::{Result, anyhow};
use motile::{
    active_interface::{
        ActiveDroplet, DropletWarning,
        observables::{InterfaceState, centroid_velocity},
        trajectory::{TrajectoryRecord, TrajectoryRecorder},
    },
    ib_core::{Handle, Hydrodynamics, Observer, System},
};

use crate::{Progress, SolidMeter, Trajectory};

type Outcome = Result<(), Box<dyn std::error::Error + Send + Sync>>;

/// Columns that only channels have, and of them those that elastic walls do not have: gap and flow beside the droplet
/// are those up to rigid walls.
const BETWEEN_WALLS: [&str; 4] = ["gap", "pressure_gradient", "net_flux", "retrograde_flow"];
const BETWEEN_RIGID_WALLS: [&str; 3] = ["gap", "net_flux", "retrograde_flow"];

/// A [`TrajectoryRecorder`] that also writes what it sees to a CSV file.
#[derive(Debug)]
pub struct Recorder {
    records: TrajectoryRecorder,
    table: Trajectory,
    columns: Vec<usize>,
    solids: Option<SolidMeter>,
    last_solids: Option<[f64; 8]>,
}

impl Recorder {
    /// A recorder of a droplet that writes to `path`; the columns are those of [`TrajectoryRecord::entries`], without those about
    /// walls where there are none, and where there are elastic solids those of [`SolidMeter::NAMES`].
    ///
    /// # Errors
    /// A file that cannot be written, a state that cannot be measured.
    pub fn create<H: Hydrodynamics>(
        path: &Path,
        system: &mut System<H>,
        droplet: Handle<ActiveDroplet>,
    ) -> Result<Self> {
        let walls = system.hydrodynamics().medium().domain.walls.is_some();
        let records = TrajectoryRecorder::new(droplet);
        let solids = SolidMeter::of(system);
        let records = if walls && solids.is_none() { records.with_gap_flow() } else { records };
        let mut probe = records.clone();
        probe.observe(system).map_err(|error| anyhow!(error))?;
        let entries = probe.records()[0].entries();
        let wanted = |k: &usize| {
            (walls || !BETWEEN_WALLS.contains(&entries[*k].0))
                && (solids.is_none() || !BETWEEN_RIGID_WALLS.contains(&entries[*k].0))
        };
        let columns: Vec<usize> = (0..entries.len()).filter(wanted).collect();
        let mut names: Vec<&str> = columns.iter().map(|&k| entries[k].0).collect();
        if solids.is_some() {
            names.extend(SolidMeter::NAMES);
        }
        Ok(Self { records, table: Trajectory::create(path, &names)?, columns, solids, last_solids: None })
    }

    fn record<H: Hydrodynamics>(&mut self, system: &mut System<H>) -> Result<()> {
        self.records.observe(system).map_err(|error| anyhow!(error))?;
        let entries = self.last().map(TrajectoryRecord::entries).unwrap_or_default();
        let mut row: Vec<f64> = self.columns.iter().map(|&k| entries[k].1.unwrap_or(f64::NAN)).collect();
        if let Some(meter) = &mut self.solids {
            let values = meter.measure(system)?;
            row.extend(values);
            self.last_solids = Some(values);
        }
        self.table.push(&row)
    }

    /// Everything measured, record by record.
    #[must_use]
    pub fn records(&self) -> &TrajectoryRecorder {
        &self.records
    }

    /// Everything measured, by column.
    #[must_use]
    pub fn table(&self) -> &Trajectory {
        &self.table
    }

    /// What was measured first.
    #[must_use]
    pub fn first(&self) -> Option<&TrajectoryRecord> {
        self.records.records().first()
    }

    /// Tells how far solids are meshed behind the surfaces where they stop the fluid ([`SolidMeter::set_back`]).
    pub fn set_back(&mut self, set_back: f64) {
        if let Some(meter) = &mut self.solids {
            meter.set_back(set_back);
        }
    }

    /// What was last measured of the solids ([`SolidMeter::NAMES`]); `None` without solids.
    #[must_use]
    pub fn last_solids(&self) -> Option<&[f64; 8]> {
        self.last_solids.as_ref()
    }

    /// What was measured last.
    #[must_use]
    pub fn last(&self) -> Option<&TrajectoryRecord> {
        self.records.records().last()
    }

    /// Makes sure that everything is in the file. After a run that broke off its last state is measured too, if it can
    /// be.
    ///
    /// # Errors
    /// A file that cannot be written.
    pub fn finish<H: Hydrodynamics>(&mut self, system: &mut System<H>) -> Result<()> {
        if self.last().map(|record| record.time) != Some(system.time())
            && let Err(error) = self.record(system)
        {
            eprintln!("note: the last state could not be measured: {error:#}");
        }
        self.table.flush()
    }
}

impl<H: Hydrodynamics> Observer<H> for Recorder {
    fn observe(&mut self, system: &mut System<H>) -> Outcome {
        Ok(self.record(system)?)
    }
}

/// Tells how far a run is, and once what its user should know. To be called after every step.
#[derive(Debug)]
pub struct Dial {
    droplet: Handle<ActiveDroplet>,
    progress: Progress,
    warned: Vec<DropletWarning>,
}

impl Dial {
    /// A run to time `end`.
    #[must_use]
    pub fn new(end: f64, hidden: bool, droplet: Handle<ActiveDroplet>) -> Self {
        Self { droplet, progress: Progress::new(end, hidden), warned: Vec::new() }
    }

    /// Takes the progress bar away; gives the seconds since the start.
    pub fn finish(&self) -> f64 {
        self.progress.finish();
        self.progress.seconds()
    }

    /// What the user was warned of.
    #[must_use]
    pub fn warnings(&self) -> &[DropletWarning] {
        &self.warned
    }

    fn look<H: Hydrodynamics>(&mut self, system: &mut System<H>) -> Result<()> {
        // The flow at the end of a step is that at the start of the next, so that this costs nothing.
        system.evaluate()?;
        let body = system.body(self.droplet)?;
        for warning in body.warnings() {
            if !self.warned.iter().any(|known| discriminant(known) == discriminant(&warning)) {
                self.progress.note(&format!("warning: at t = {:.3}, {warning}", system.time()));
                self.warned.push(warning);
            }
        }
        let state = InterfaceState::of(system, self.droplet)?;
        let speed = centroid_velocity(state.markers, state.velocities)?.norm();
        self.progress.update(system.time(), system.steps(), speed);
        Ok(())
    }
}

impl<H: Hydrodynamics> Observer<H> for Dial {
    fn observe(&mut self, system: &mut System<H>) -> Outcome {
        Ok(self.look(system)?)
    }
}

//! Recorder of a droplet during runs.

use std::error::Error;

use motile_scene::{Handle, Hydrodynamics, Observer, System, gap::wall_gap};

use active_interface::{
    ActiveDroplet,
    observables::{Convention, GapFlow, InterfaceState, Observables, gap_flow, observe},
};

use crate::{
    AnalysisError,
    trajectory::{RegimeCriteria, RegimeReport, Trajectory},
};

/// Record of a droplet at one time, made by a [`TrajectoryRecorder`].
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub struct TrajectoryRecord {
    /// Time of the record.
    pub time: f64,
    /// All observables of the droplet.
    pub observables: Observables,
    /// Distance of the droplet's nearest marker from a wall (length, see [`wall_gap`]); `None` without walls.
    pub gap: Option<f64>,
    /// Mean pressure gradient dp/dx (stress per length); not a number in a tube that is not straight.
    pub pressure_gradient: f64,
    /// Fluxes past the droplet; `None` unless asked for by [`TrajectoryRecorder::with_gap_flow`].
    pub flow: Option<GapFlow>,
}

impl TrajectoryRecord {
    /// Returns the names and values of all entries, in the order of the columns of a table: `time`, the
    /// [`Observables::entries`], `gap`, `pressure_gradient`, `net_flux`, `retrograde_flow`. Values that do not exist
    /// are `None`.
    #[must_use]
    pub fn entries(&self) -> Vec<(&'static str, Option<f64>)> {
        let mut entries = vec![("time", Some(self.time))];
        entries.extend(self.observables.entries());
        entries.push(("gap", self.gap));
        entries.push(("pressure_gradient", Some(self.pressure_gradient).filter(|gradient| gradient.is_finite())));
        entries.push(("net_flux", self.flow.map(|flow| flow.net())));
        entries.push(("retrograde_flow", self.flow.and_then(|flow| flow.retrograde())));
        entries
    }
}

/// Observer of one droplet of a scene, which keeps a record of every time at which a run shows it the scene.
///
/// ```no_run
/// # fn run<H: motile_scene::Hydrodynamics>(
/// #     mut scene: motile_scene::Scene<H>, droplet: motile_scene::Handle<active_interface::ActiveDroplet>,
/// # ) -> Result<(), Box<dyn std::error::Error>> {
/// use motile_analysis::trajectory::{RegimeCriteria, TrajectoryRecorder};
/// use motile_scene::Every;
///
/// let mut recorder = TrajectoryRecorder::new(droplet);
/// scene.run(500.0).observe(Every::StepAfter(0.5), &mut recorder).go()?;
/// let report = recorder.regime(&RegimeCriteria::default())?;
/// println!("{}, amplitude {}", report.regime, report.evidence.amplitude);
/// println!("closest to a wall: {:?}", recorder.minimum_gap());
/// # Ok(())
/// # }
/// ```
#[derive(Debug, Clone, PartialEq)]
pub struct TrajectoryRecorder {
    droplet: Handle<ActiveDroplet>,
    convention: Convention,
    with_gap_flow: bool,
    centre_line: Option<f64>,
    minimum_gap: Option<f64>,
    records: Vec<TrajectoryRecord>,
}

impl TrajectoryRecorder {
    /// Creates a recorder of a droplet, with force moments in the far-field convention.
    #[must_use]
    pub fn new(droplet: Handle<ActiveDroplet>) -> Self {
        let (convention, records) = (Convention::FarField, Vec::new());
        Self { droplet, convention, with_gap_flow: false, centre_line: None, minimum_gap: None, records }
    }

    /// Computes force moments in another convention.
    #[must_use]
    pub fn with_convention(mut self, convention: Convention) -> Self {
        self.convention = convention;
        self
    }

    /// Records the fluxes past the droplet too (see [`active_interface::observables::gap_flow`]). This costs a sampling
    /// of the flow a record, a little more than half a time step, and works in channels only.
    #[must_use]
    pub fn with_gap_flow(mut self) -> Self {
        self.with_gap_flow = true;
        self
    }

    /// Returns the records, at increasing times.
    #[must_use]
    pub fn records(&self) -> &[TrajectoryRecord] {
        &self.records
    }

    /// Returns the values of the entry `name` (see [`TrajectoryRecord::entries`]), record by record; `None` for an
    /// unknown name or without records.
    #[must_use]
    pub fn column(&self, name: &str) -> Option<Vec<Option<f64>>> {
        let place = self.records.first()?.entries().iter().position(|entry| entry.0 == name)?;
        Some(self.records.iter().map(|record| record.entries()[place].1).collect())
    }

    /// Returns the smallest gap to the walls of all records (length); `None` without walls or records. The scene keeps
    /// the smallest gap of all steps and bodies ([`System::minimum_wall_gap`]).
    #[must_use]
    pub fn minimum_gap(&self) -> Option<f64> {
        self.minimum_gap
    }

    /// Returns the trajectory across the channel, heights measured from the centre line; without walls from the first
    /// record's.
    ///
    /// # Errors
    /// Returns no error for records of a run.
    pub fn trajectory(&self) -> Result<Trajectory, AnalysisError> {
        let list = |value: fn(&TrajectoryRecord) -> f64| self.records.iter().map(value).collect::<Vec<f64>>();
        let mut heights = list(|record| record.observables.centroid.y);
        let origin = self.centre_line.or(heights.first().copied()).unwrap_or(0.0);
        heights.iter_mut().for_each(|y| *y -= origin);
        Trajectory::new(list(|record| record.time), heights, list(|record| record.observables.speed()))?
            .with_lateral_velocities(list(|record| record.observables.velocity.y))
    }

    /// Returns the long-time regime of the droplet; see [`Trajectory::regime`].
    ///
    /// # Errors
    /// Returns an error if there are no records, or for criteria out of their ranges.
    pub fn regime(&self, criteria: &RegimeCriteria) -> Result<RegimeReport, AnalysisError> {
        self.trajectory()?.regime(criteria)
    }
}

impl<H: Hydrodynamics> Observer<H> for TrajectoryRecorder {
    /// Evaluates the present state and records it. A record at the time of the last one takes its place, so that a run
    /// can be continued.
    ///
    /// # Errors
    /// Returns an error for a handle of another scene, a time before the last record, and the errors of an evaluation.
    fn observe(&mut self, system: &mut System<H>) -> Result<(), Box<dyn Error + Send + Sync>> {
        let time = system.time();
        system.body(self.droplet)?;
        match self.records.last() {
            Some(last) if last.time > time => {
                let index = self.records.len();
                return Err(AnalysisError::not_increasing("the times of the records", index, time).into());
            }
            Some(last) if last.time == time => {
                self.records.pop();
            }
            _ => {}
        }
        system.evaluate()?;
        let pressure_gradient = system.report().mean_pressure_gradient[0];
        let flow = self.with_gap_flow.then(|| gap_flow(system, self.droplet)).transpose()?;
        let state = InterfaceState::of(system, self.droplet)?;
        let observables = observe(&state, self.convention)?;
        let walls = system.hydrodynamics().fluid_view().domain.walls;
        let straight = walls.map(|walls| wall_gap(state.markers, walls));
        let periods = system.hydrodynamics().fluid_view().domain.periods;
        let others = system.hydrodynamics().walls().and_then(|walls| walls.smallest(state.markers, periods));
        let gap = [straight, others.map(|(gap, _)| gap)].into_iter().flatten().reduce(f64::min);
        if let Some(gap) = gap {
            self.minimum_gap = Some(self.minimum_gap.map_or(gap, |least| least.min(gap)));
        }
        self.centre_line = walls.map(|[bottom, top]| 0.5 * (bottom + top));
        self.records.push(TrajectoryRecord { time, observables, gap, pressure_gradient, flow });
        Ok(())
    }
}

#[cfg(test)]
mod tests;

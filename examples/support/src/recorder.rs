//! What is measured while a droplet swims.

use std::{mem::discriminant, path::Path};

use anyhow::{Context, Result, ensure};
use motile::{
    active_interface::{ActiveDroplet, Convention, DropletWarning, Observables, centroid_velocity, observe},
    ib_core::{Handle, Hydrodynamics, Observer, Scene, StepSize, System},
};

use crate::{Progress, Trajectory};

type Outcome = Result<(), Box<dyn std::error::Error + Send + Sync>>;

/// All observables of a droplet at the present state of its system.
///
/// # Errors
/// A flow that cannot be computed, a state that cannot be measured.
pub fn measure<H: Hydrodynamics>(system: &mut System<H>, droplet: Handle<ActiveDroplet>) -> Result<Observables> {
    system.evaluate()?;
    let body: &ActiveDroplet = system.find().context("a scene without a droplet cannot be measured")?;
    Ok(observe(&body.interface_state(system, droplet.index()), Convention::FarField)?)
}

/// Most steps of a run: more would take weeks.
const MOST_STEPS: f64 = 1e9;

/// Refuses a run that could not start with its time step, or could not end in a lifetime, before anything is written.
///
/// # Errors
/// A time step that is not stable, or one so short that the run would take more than 1e9 steps.
pub fn check_run<H: Hydrodynamics>(scene: &mut Scene<H>, end: f64, step: StepSize) -> Result<()> {
    let dt = match step {
        StepSize::Fixed(dt) => {
            scene.check_step(dt)?;
            dt
        }
        StepSize::OfLimit(fraction) => {
            scene.system().step_limit().map_or(f64::INFINITY, |(limit, _)| fraction * limit.dt)
        }
    };
    ensure!(
        end / dt <= MOST_STEPS,
        "time {end} would take {:.0e} steps of {dt:.1e}: give a higher viscosity, a larger spacing or a shorter time",
        end / dt
    );
    Ok(())
}

/// Measures a droplet whenever it is called, and writes all observables to a CSV file.
#[derive(Debug)]
pub struct Recorder {
    droplet: Handle<ActiveDroplet>,
    trajectory: Trajectory,
    first: Option<Observables>,
    last: Option<Observables>,
}

impl Recorder {
    /// A recorder of a droplet that writes to `path`; the columns are the time, those of [`Observables::entries`], and
    /// between walls the `gap` to them (length) and the mean `pressure_gradient` along them (force per volume).
    ///
    /// # Errors
    /// A file that cannot be written, a state that cannot be measured.
    pub fn create<H: Hydrodynamics>(
        path: &Path,
        system: &mut System<H>,
        droplet: Handle<ActiveDroplet>,
    ) -> Result<Self> {
        let columns = measure(system, droplet)?.entries().into_iter().map(|(name, _)| name);
        let between_walls: &[&str] = if system.wall_gap().is_some() { &["gap", "pressure_gradient"] } else { &[] };
        let names: Vec<&str> = std::iter::once("time").chain(columns).chain(between_walls.iter().copied()).collect();
        Ok(Self { droplet, trajectory: Trajectory::create(path, &names)?, first: None, last: None })
    }

    fn record<H: Hydrodynamics>(&mut self, system: &mut System<H>) -> Result<()> {
        let seen = measure(system, self.droplet)?;
        let values = seen.entries().into_iter().map(|(_, value)| value.unwrap_or(f64::NAN));
        let mut row: Vec<f64> = std::iter::once(system.time()).chain(values).collect();
        if let Some(gap) = system.wall_gap() {
            row.extend([gap, system.report().mean_pressure_gradient[0]]);
        }
        self.trajectory.push(&row)?;
        self.first.get_or_insert_with(|| seen.clone());
        self.last = Some(seen);
        Ok(())
    }

    /// Everything measured, by column.
    #[must_use]
    pub fn trajectory(&self) -> &Trajectory {
        &self.trajectory
    }

    /// What was measured first.
    #[must_use]
    pub fn first(&self) -> Option<&Observables> {
        self.first.as_ref()
    }

    /// What was measured last.
    #[must_use]
    pub fn last(&self) -> Option<&Observables> {
        self.last.as_ref()
    }

    /// Makes sure that everything is in the file. After a run that broke off its last state is measured too, if it can
    /// be.
    ///
    /// # Errors
    /// A file that cannot be written.
    pub fn finish<H: Hydrodynamics>(&mut self, system: &mut System<H>) -> Result<()> {
        let time = self.trajectory.column("time")?.last().copied();
        if time != Some(system.time())
            && let Err(error) = self.record(system)
        {
            eprintln!("note: the last state could not be measured: {error:#}");
        }
        self.trajectory.flush()
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
        let body: &ActiveDroplet = system.find().context("a scene without a droplet")?;
        for warning in body.warnings() {
            if !self.warned.iter().any(|known| discriminant(known) == discriminant(&warning)) {
                self.progress.note(&format!("warning: at t = {:.3}, {warning}", system.time()));
                self.warned.push(warning);
            }
        }
        let state = body.interface_state(system, self.droplet.index());
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

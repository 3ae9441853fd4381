//! Progress of runs and other long work.

use std::io::IsTerminal;
use std::time::{Duration, Instant};

use motile::active_interface::ActiveDroplet;
use motile::active_interface::observables::{InterfaceState, centroid_velocity};
use motile::base::internal::decimals;
use motile::scene::{Hydrodynamics, Observer, System, Warnings};

/// Smallest time between two updates of the bar, and between two lines if there is no terminal.
const BAR_INTERVAL: Duration = Duration::from_millis(80);
const LINE_INTERVAL: Duration = Duration::from_secs(15);
/// Divisions of the bar.
const DIVISIONS: f64 = 12.0;
/// Control sequence that returns to the start of a terminal's line and clears it (ECMA-48).
const CLEAR: &str = "\r\x1b[K";

/// Progress bar on the standard error, with a text on the state of the work and the time left. If standard error is not
/// a terminal, a line every quarter of a minute; if hidden, nothing.
#[derive(Debug)]
pub struct Progress {
    started: Instant,
    due: Instant,
    hidden: bool,
    terminal: bool,
}

impl Progress {
    /// Creates a progress bar of work that starts now.
    #[must_use]
    pub fn new(hidden: bool) -> Self {
        let (started, terminal) = (Instant::now(), std::io::stderr().is_terminal());
        // A bar appears at once, the first line when the work takes long.
        Self { started, due: if terminal { started } else { started + LINE_INTERVAL }, hidden, terminal }
    }

    /// Updates the bar: the part of the work that is done (0 to 1), and a text on its state. To be called often: mostly
    /// it returns at once.
    pub fn update(&mut self, done: f64, state: impl FnOnce() -> String) {
        if self.hidden || Instant::now() < self.due {
            return;
        }
        self.due = Instant::now() + if self.terminal { BAR_INTERVAL } else { LINE_INTERVAL };
        let text = format!("{:>3.0} %  {}  {} left", 100.0 * done, state(), left(self.seconds(), done));
        if self.terminal {
            eprint!("{CLEAR}[{:<12}] {text}", "=".repeat((DIVISIONS * done.clamp(0.0, 1.0)) as usize));
        } else {
            eprintln!("{text}");
        }
    }

    /// Writes a line to the standard error, in place of the bar until this is drawn again.
    pub fn note(&self, line: &str) {
        eprintln!("{}{line}", if self.terminal { CLEAR } else { "" });
    }

    /// Removes the bar and returns the wall clock time since the start (seconds).
    pub fn finish(&self) -> f64 {
        if self.terminal && !self.hidden {
            eprint!("{CLEAR}");
        }
        self.seconds()
    }

    fn seconds(&self) -> f64 {
        self.started.elapsed().as_secs_f64()
    }
}

/// Observer that shows the progress of a run: time, speed of the first droplet, steps per second, and each of the
/// [`Warnings`] once. To be called after every step.
#[derive(Debug)]
pub struct RunProgress {
    end: f64,
    progress: Progress,
    warnings: Warnings,
}

impl RunProgress {
    /// Creates a progress of a run to time `end`.
    #[must_use]
    pub fn new(end: f64, hidden: bool) -> Self {
        Self { end, progress: Progress::new(hidden), warnings: Warnings::default() }
    }

    /// Returns the warnings of the run so far.
    #[must_use]
    pub fn warnings(&self) -> &Warnings {
        &self.warnings
    }

    /// Removes the progress bar and returns the wall clock time since the start (seconds).
    pub fn finish(&self) -> f64 {
        self.progress.finish()
    }
}

impl<H: Hydrodynamics> Observer<H> for RunProgress {
    fn observe(&mut self, system: &mut System<H>) -> Result<(), Box<dyn std::error::Error + Send + Sync>> {
        // The flow at the end of a step is that at the start of the next: this costs nothing.
        system.evaluate()?;
        for (time, warning) in self.warnings.look(system) {
            self.progress.note(&format!("warning: at t = {}, {warning}", decimals(3, *time)));
        }
        let first = system.bodies::<ActiveDroplet>().next().map(|(handle, _)| handle);
        let speed = first.map(|handle| {
            let state = InterfaceState::of(system, handle)?;
            Ok::<_, Box<dyn std::error::Error + Send + Sync>>(
                centroid_velocity(state.markers, state.velocities)?.length(),
            )
        });
        let speed = speed.transpose()?;
        let (time, end, steps, seconds) = (system.time(), self.end, system.steps(), self.progress.seconds());
        self.progress.update(time / end, || {
            let pace = steps as f64 / seconds.max(1e-9);
            let speed = speed.map_or(String::new(), |speed| format!("speed {}  ", decimals(4, speed)));
            format!("t = {} of {end}  {speed}{pace:.0} steps/s", decimals(2, time))
        });
        Ok(())
    }
}

/// Returns the time left, given the seconds that a fraction of the work took: as minutes and seconds, or hours, minutes
/// and seconds.
fn left(seconds: f64, done: f64) -> String {
    if done.is_nan() || done <= 0.0 {
        return "?".into();
    }
    let whole = (seconds * (1.0 - done).max(0.0) / done).round().clamp(0.0, 359_999.0) as u64;
    let (h, m, s) = (whole / 3600, whole / 60 % 60, whole % 60);
    if h > 0 { format!("{h}:{m:02}:{s:02}") } else { format!("{m}:{s:02}") }
}

#[cfg(test)]
mod tests;

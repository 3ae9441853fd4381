//! How far a run is.

use std::{
    io::IsTerminal,
    time::{Duration, Instant},
};

use indicatif::{ProgressBar, ProgressDrawTarget, ProgressStyle};

/// Least time between two updates of the bar, and between two lines where there is no terminal.
const BAR_INTERVAL: Duration = Duration::from_millis(80);
const LINE_INTERVAL: Duration = Duration::from_secs(15);
/// Divisions of the bar.
const DIVISIONS: u64 = 1000;

/// A progress bar on the error output with the state of the run, its pace and the time left. Where the output is not
/// a terminal, a line now and then; hidden, nothing.
#[derive(Debug)]
pub struct Progress {
    end: f64,
    started: Instant,
    shown: Option<Instant>,
    display: Display,
}

#[derive(Debug)]
enum Display {
    Bar(ProgressBar),
    Lines,
    Nothing,
}

impl Progress {
    /// A run from time 0 to `end`.
    #[must_use]
    pub fn new(end: f64, hidden: bool) -> Self {
        let display = match (hidden, std::io::stderr().is_terminal()) {
            (true, _) => Display::Nothing,
            (false, false) => Display::Lines,
            (false, true) => {
                let bar = ProgressBar::with_draw_target(Some(DIVISIONS), ProgressDrawTarget::stderr());
                if let Ok(style) = ProgressStyle::with_template("[{bar:30}] {percent:>3} %  {msg}") {
                    bar.set_style(style.progress_chars("=> "));
                }
                Display::Bar(bar)
            }
        };
        let started = Instant::now();
        // A bar appears at once, the first line when a run takes long.
        let shown = matches!(display, Display::Lines).then_some(started);
        Self { end, started, shown, display }
    }

    /// Tells where the run is: its time, the number of steps so far, and the speed of what moves (length per time).
    /// To be called after every step: it mostly returns at once.
    pub fn update(&mut self, time: f64, steps: usize, speed: f64) {
        if self.due() {
            let state = state(time, self.end, steps, speed, self.seconds());
            self.show(time / self.end, &state);
        }
    }

    /// The same for a study: tells how many of its runs are done, and which was the last one.
    pub fn update_runs(&mut self, done: usize, total: usize, last: &str) {
        if self.due() {
            let left = left(self.seconds(), done as f64, total as f64);
            self.show(done as f64 / total as f64, &format!("{done} of {total} runs  {left} left  {last}"));
        }
    }

    /// Whether it is time for an update.
    fn due(&mut self) -> bool {
        let interval = match self.display {
            Display::Bar(_) => BAR_INTERVAL,
            Display::Lines => LINE_INTERVAL,
            Display::Nothing => return false,
        };
        let due = self.shown.is_none_or(|shown| shown.elapsed() >= interval);
        if due {
            self.shown = Some(Instant::now());
        }
        due
    }

    fn show(&self, fraction: f64, state: &str) {
        let fraction = fraction.clamp(0.0, 1.0);
        match &self.display {
            Display::Bar(bar) => {
                bar.set_position((fraction * DIVISIONS as f64) as u64);
                bar.set_message(state.to_string());
            }
            Display::Lines => eprintln!("{:>3.0} %  {state}", 100.0 * fraction),
            Display::Nothing => {}
        }
    }

    /// Writes a line to the error output, above the bar.
    pub fn note(&self, line: &str) {
        match &self.display {
            Display::Bar(bar) => bar.suspend(|| eprintln!("{line}")),
            Display::Lines | Display::Nothing => eprintln!("{line}"),
        }
    }

    /// Wall clock time since the start (seconds).
    #[must_use]
    pub fn seconds(&self) -> f64 {
        self.started.elapsed().as_secs_f64()
    }

    /// Takes the bar away.
    pub fn finish(&self) {
        if let Display::Bar(bar) = &self.display {
            bar.finish_and_clear();
        }
    }
}

/// The state of a run in words.
fn state(time: f64, end: f64, steps: usize, speed: f64, seconds: f64) -> String {
    let pace = if seconds > 0.0 { steps as f64 / seconds } else { 0.0 };
    let left = left(seconds, time, end);
    format!("t = {time:.2} of {end}  speed {speed:.4}  {pace:.0} steps/s  {left} left")
}

/// The time that is left when `done` of `all` took some seconds.
fn left(seconds: f64, done: f64, all: f64) -> String {
    if done > 0.0 { clock(seconds * (all - done).max(0.0) / done) } else { "?".into() }
}

/// Seconds as minutes and seconds, or hours, minutes and seconds.
fn clock(seconds: f64) -> String {
    let whole = seconds.round().clamp(0.0, 359_999.0) as u64;
    let (h, m, s) = (whole / 3600, whole / 60 % 60, whole % 60);
    if h > 0 { format!("{h}:{m:02}:{s:02}") } else { format!("{m}:{s:02}") }
}

#[cfg(test)]
mod tests;

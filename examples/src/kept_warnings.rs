//! The warnings of a run, kept beside its checkpoints: a run that goes on from one tells those from before it too.

use std::path::{Path, PathBuf};

use motile::AnyFlow;
use motile::ib_core::{Observer, System, Warning};
use motile_output::RunProgress;

/// A warning and its time.
#[derive(Debug, Clone, PartialEq)]
struct Kept {
    time: f64,
    excess: f64,
    body: String,
    cause: String,
    message: String,
}

impl Kept {
    fn of((time, warning): &(f64, Warning)) -> Self {
        let Warning { body, cause, excess, message } = warning.clone();
        Self { time: *time, excess, body, cause: cause.to_owned(), message }
    }

    fn read(line: &str) -> Option<Self> {
        let mut fields = line.splitn(5, '\t');
        let mut number = || fields.next()?.parse().ok();
        let (time, excess) = (number()?, number()?);
        let mut text = || fields.next().map(str::to_owned);
        Some(Self { time, excess, body: text()?, cause: text()?, message: text()? })
    }

    fn line(&self) -> String {
        let Self { time, excess, body, cause, message } = self;
        format!("{time}\t{excess}\t{body}\t{cause}\t{message}\n")
    }

    fn is_like(&self, other: &Self) -> bool {
        (&self.body, &self.cause) == (&other.body, &other.cause)
    }
}

/// Progress and warnings of a run; every so many steps, those at which checkpoints are saved, it keeps the warnings.
#[derive(Debug)]
pub(crate) struct KeptWarnings {
    pub(crate) progress: RunProgress,
    /// Those from before the checkpoint that the run goes on from.
    earlier: Vec<Kept>,
    file: Option<(PathBuf, usize)>,
}

impl KeptWarnings {
    /// Of a run that goes on from the checkpoint `resumed`, and saves to `saved` every so many steps.
    pub(crate) fn new(progress: RunProgress, resumed: Option<&Path>, saved: Option<(&Path, usize)>) -> Self {
        // Without such a file there were none.
        let text = resumed.and_then(|path| std::fs::read_to_string(beside(path)).ok()).unwrap_or_default();
        let earlier = text.lines().filter_map(Kept::read).collect();
        Self { progress, earlier, file: saved.map(|(path, every)| (beside(path), every)) }
    }

    /// Of each body and cause the worst.
    fn worst(&self) -> Vec<Kept> {
        let mut all = self.earlier.clone();
        for now in self.progress.warnings().worst().iter().map(Kept::of) {
            match all.iter_mut().find(|other| other.is_like(&now)) {
                Some(other) if now.excess <= other.excess => {}
                Some(other) => *other = now,
                None => all.push(now),
            }
        }
        all
    }

    /// In words.
    pub(crate) fn texts(&self) -> Vec<String> {
        let text =
            |Kept { time, body, cause, message, .. }: &Kept| format!("t = {time:.3}: {body}: {cause}: {message}");
        self.worst().iter().map(text).collect()
    }

    /// Keeps the warnings so far.
    ///
    /// # Errors
    /// A file that cannot be written.
    pub(crate) fn keep(&self) -> std::io::Result<()> {
        let Some((path, _)) = &self.file else { return Ok(()) };
        let lines: String = self.worst().iter().map(Kept::line).collect();
        if !lines.is_empty() || path.exists() { std::fs::write(path, lines) } else { Ok(()) }
    }
}

impl Observer<AnyFlow> for KeptWarnings {
    fn observe(&mut self, system: &mut System<AnyFlow>) -> Result<(), Box<dyn std::error::Error + Send + Sync>> {
        self.progress.observe(system)?;
        let due = self.file.as_ref().is_some_and(|(_, every)| system.steps().is_multiple_of(*every));
        if due { Ok(self.keep()?) } else { Ok(()) }
    }
}

fn beside(checkpoint: &Path) -> PathBuf {
    let mut path = checkpoint.to_path_buf().into_os_string();
    path.push(".warnings");
    path.into()
}

#[cfg(test)]
mod tests;

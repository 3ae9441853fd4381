//! Runs in parallel, without those that are finished already.

use std::{
    path::Path,
    sync::{
        atomic::{AtomicUsize, Ordering},
        mpsc,
    },
    thread,
};

use anyhow::{Context, Result, anyhow};
use serde_json::Value;

use crate::run::{Summary, make_directory};
use motile_output::Progress;

/// Entry of a summary with the name of its run.
const NAME: &str = "run";

/// Pool of threads that make runs, each of which leaves its results in a file of a directory.
#[derive(Debug)]
pub struct RunPool<'a> {
    directory: &'a Path,
    threads: usize,
    hidden: bool,
}

impl<'a> RunPool<'a> {
    /// Creates a pool that keeps its files in `directory`, which is created if needed; `hidden` shows no progress.
    ///
    /// # Errors
    /// Returns an error for a directory that cannot be created.
    pub fn new(directory: &'a Path, threads: usize, hidden: bool) -> Result<Self> {
        make_directory(directory)?;
        Ok(Self { directory, threads: threads.max(1), hidden })
    }

    /// Returns the results of all jobs, in their order, in which they are also begun. A job is run by `run`, unless its
    /// file `<name>.json` has its results already, of this version of the program. A job that fails does not keep the
    /// others from running.
    pub fn run<J: Sync>(
        &self,
        jobs: &[J],
        name: impl Fn(&J) -> String + Sync,
        run: impl Fn(&J) -> Result<Summary> + Sync,
    ) -> Vec<Result<Summary>> {
        let mut results: Vec<Option<Result<Summary>>> = jobs.iter().map(|_| None).collect();
        let mut progress = Progress::new(self.hidden);
        let next = AtomicUsize::new(0);
        let (next, name, run) = (&next, &name, &run);
        thread::scope(|scope| {
            let (sender, receiver) = mpsc::channel();
            for _ in 0..self.threads.min(jobs.len()) {
                let sender = sender.clone();
                scope.spawn(move || {
                    loop {
                        let k = next.fetch_add(1, Ordering::Relaxed);
                        let Some(job) = jobs.get(k) else { break };
                        // The receiver lives as long as there are senders.
                        let _ = sender.send((k, self.one(&name(job), || run(job))));
                    }
                });
            }
            drop(sender);
            for (done, (k, result)) in receiver.into_iter().enumerate() {
                let (done, all) = (done + 1, jobs.len());
                progress.update(done as f64 / all as f64, || format!("{done} of {all} runs, last {}", name(&jobs[k])));
                results[k] = Some(result);
            }
        });
        progress.finish();
        results.into_iter().map(|result| result.unwrap_or_else(|| Err(anyhow!("a run was lost")))).collect()
    }

    /// Returns the finished jobs with their results, and the errors of the others, as by [`RunPool::run`].
    pub fn study<J: Sync>(
        &self,
        jobs: Vec<J>,
        name: impl Fn(&J) -> String + Sync,
        run: impl Fn(&J) -> Result<Summary> + Sync,
    ) -> (Vec<(J, Summary)>, Vec<anyhow::Error>) {
        let results = self.run(&jobs, name, run);
        let (mut points, mut failures) = (Vec::new(), Vec::new());
        for (job, result) in jobs.into_iter().zip(results) {
            match result {
                Ok(summary) => points.push((job, summary)),
                Err(error) => failures.push(error),
            }
        }
        (points, failures)
    }

    fn one(&self, name: &str, run: impl FnOnce() -> Result<Summary>) -> Result<Summary> {
        let path = self.directory.join(format!("{name}.json"));
        // A file that cannot be read or is of something else is no result.
        if let Ok(Some(summary)) = Summary::read(&path)
            && summary.values().get(NAME).and_then(Value::as_str) == Some(name)
        {
            if summary.version() == Some(motile::VERSION) {
                return Ok(summary);
            }
            eprintln!("{}", made_again(&path, summary.version()));
        }
        let mut summary = run().with_context(|| name.trim_end_matches("/summary").to_owned())?;
        summary.put(NAME, name, "");
        summary.write(&path)?;
        Ok(summary)
    }
}

/// Returns the note about results of another version of the program.
pub(super) fn made_again(path: &Path, version: Option<&str>) -> String {
    let (path, found, own) = (path.display(), version.unwrap_or("of an older version"), motile::VERSION);
    format!("{path} was written by motile {found}, and this is motile {own}: it is made again")
}

#[cfg(test)]
mod tests;

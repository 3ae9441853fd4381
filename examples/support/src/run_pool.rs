//! Many runs in parallel, of which those that were finished before are not run again.

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

use crate::{Progress, Summary, make_directory};

/// The entry by which a file says which run it is of.
const NAME: &str = "run";

/// Runs to be made by a number of threads, each leaving its results in a file of a directory.
#[derive(Debug)]
pub struct RunPool<'a> {
    directory: &'a Path,
    threads: usize,
    hidden: bool,
}

impl<'a> RunPool<'a> {
    /// A pool that keeps its files in `directory`, which is made if it is not there; `hidden` shows no progress.
    ///
    /// # Errors
    /// A directory that cannot be made.
    pub fn new(directory: &'a Path, threads: usize, hidden: bool) -> Result<Self> {
        make_directory(directory)?;
        Ok(Self { directory, threads: threads.max(1), hidden })
    }

    /// The results of all jobs, in their order, which is also the order in which they are begun. A job whose results are
    /// in its file, `<name>.json`, is not run; one whose file does not hold them is run again. A job that fails does not
    /// keep the others from running.
    pub fn run<J: Sync>(
        &self,
        jobs: &[J],
        name: impl Fn(&J) -> String + Sync,
        run: impl Fn(&J) -> Result<Summary> + Sync,
    ) -> Vec<Result<Summary>> {
        let mut results: Vec<Option<Result<Summary>>> = jobs.iter().map(|_| None).collect();
        let mut progress = Progress::new(jobs.len() as f64, self.hidden);
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
                progress.update_runs(done + 1, jobs.len(), &name(&jobs[k]));
                results[k] = Some(result);
            }
        });
        progress.finish();
        results.into_iter().map(|result| result.unwrap_or_else(|| Err(anyhow!("a run was lost")))).collect()
    }

    /// The same for a study: the jobs that finished with their results, and the errors of the others.
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
            return Ok(summary);
        }
        let mut summary = run().with_context(|| name.to_string())?;
        summary.put(NAME, name, "");
        summary.write(&path)?;
        Ok(summary)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use anyhow::ensure;
    use std::fs;

    #[test]
    fn finished_runs_are_kept_and_spoilt_or_failed_ones_made_again() {
        let directory = std::env::temp_dir().join(format!("motile-pool-{}", std::process::id()));
        let runs = AtomicUsize::new(0);
        let jobs: Vec<u32> = (0..7).collect();
        let go = |fails: u32| {
            let pool = RunPool::new(&directory, 3, true).unwrap();
            let results = pool.run(
                &jobs,
                |job| format!("job_{job}"),
                |&job| {
                    runs.fetch_add(1, Ordering::Relaxed);
                    ensure!(job != fails, "job {job} does not work");
                    let mut summary = Summary::new();
                    summary.put("square", job * job, "");
                    Ok(summary)
                },
            );
            let count = runs.swap(0, Ordering::Relaxed);
            (results, count)
        };
        let (results, count) = go(3);
        assert_eq!(count, 7);
        assert_eq!(format!("{:#}", results[3].as_ref().unwrap_err()), "job_3: job 3 does not work");
        assert!(
            results.iter().enumerate().all(|(k, r)| k == 3 || r.as_ref().unwrap().number("square") == (k * k) as f64)
        );

        // Cut short, not JSON, JSON of something else, that of another run.
        let file = |k: usize| directory.join(format!("job_{k}.json"));
        let whole = fs::read_to_string(file(0)).unwrap();
        fs::write(file(0), &whole[..whole.len() / 2]).unwrap();
        fs::write(file(1), "").unwrap();
        fs::write(file(2), "[1, 2]").unwrap();
        fs::copy(file(5), file(6)).unwrap();
        let (results, count) = go(100);
        assert_eq!(count, 5);
        assert!(results.iter().enumerate().all(|(k, r)| r.as_ref().unwrap().number("square") == (k * k) as f64));
        assert_eq!(go(100).1, 0);
        fs::remove_dir_all(&directory).unwrap();
    }
}

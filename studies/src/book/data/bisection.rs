//! Bisection for the value of a scene's entry from which on a droplet passes.

use std::path::Path;

use anyhow::{Context, Result, bail, ensure};
use motile_output::run::Summary;
use motile_output::sweep::{Plan, State, Trial};
use serde::Deserialize;
use toml::{Table, Value};

/// What is looked for, for each run of a plan.
#[derive(Debug, Clone, Deserialize)]
#[serde(deny_unknown_fields, rename_all = "kebab-case")]
pub(super) struct Bisection {
    /// Entries of the scene that have the value.
    entries: Vec<String>,
    /// Values between which it is: at the first one droplets do not pass, at the second they do.
    between: [f64; 2],
    /// Largest difference of the values that are left, relative to the larger.
    relative: f64,
    /// Place that a droplet has passed with its centroid (length).
    passed: f64,
}

impl Bisection {
    /// Summary of the passage at the least value, with `passes_at` and `turns_at`, the values with and without a
    /// passage that are next to each other, `runs`, and the seconds of all. A value that no run has is left out.
    ///
    /// # Errors
    /// A run that ends in an error.
    pub(super) fn search(&self, base: &Trial) -> Result<Summary> {
        let run = |value: f64| self.made(base, value);
        let [turns, passes, runs, seconds] = self.halve(run)?;
        let mut summary = Summary::default();
        let known = |value: f64| value.is_finite().then_some(value);
        summary.put("passes_at", known(passes), "least value with a passage");
        summary.put("turns_at", known(turns), "largest value without one");
        summary.put("runs", runs, "");
        summary.put("seconds", seconds, "");
        Ok(summary)
    }

    /// Largest value without a passage, least value with one (not a number where no run was so), number of runs and
    /// their seconds; `run` says how far a droplet comes, and its seconds.
    pub(super) fn halve(&self, mut run: impl FnMut(f64) -> Result<[f64; 2]>) -> Result<[f64; 4]> {
        let [mut low, mut high] = self.between;
        ensure!(
            0.0 < low && low < high && self.relative > 0.0,
            "bisection between {low} and {high}: give 0 < low < high"
        );
        let [mut turns, mut passes, mut runs, mut seconds] = [f64::NAN, f64::NAN, 0.0, 0.0];
        while high - low > self.relative * high {
            let middle = 0.5 * (low + high);
            let [furthest, own] = run(middle)?;
            (runs, seconds) = (runs + 1.0, seconds + own);
            if furthest > self.passed {
                (high, passes) = (middle, middle);
            } else {
                (low, turns) = (middle, middle);
            }
        }
        Ok([turns, passes, runs, seconds])
    }

    /// Furthest place and seconds of the run at a value, which is not made again.
    fn made(&self, base: &Trial, value: f64) -> Result<[f64; 2]> {
        let trial = self.trial(base, value)?;
        let summary = match trial.state() {
            State::Finished(summary) => summary,
            State::Failed(failure) => bail!("{}: {failure}", trial.label),
            _ => {
                let summary = trial.run().with_context(|| trial.label.clone())?;
                summary.write(&trial.folder.join("summary.json"))?;
                summary
            }
        };
        Ok(["furthest_x", "seconds"].map(|name| summary.number(name)))
    }

    /// The run of a value.
    fn trial(&self, base: &Trial, value: f64) -> Result<Trial> {
        let list = |entry: &String| (entry.clone(), Value::from(vec![value]));
        let plan = Table::from_iter([
            ("time".to_owned(), Value::from(base.time)),
            ("scene".to_owned(), toml::from_str::<Table>(&base.setup.to_toml()?)?.into()),
            ("zip".to_owned(), self.entries.iter().map(list).collect::<Table>().into()),
        ]);
        let folder: &Path = &base.folder;
        Plan::of(plan)?.trials(folder)?.pop().context("a plan without a run")
    }
}

#[cfg(test)]
mod tests;

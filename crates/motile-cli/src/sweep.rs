//! Parameter sweeps: many runs of one scene, on all cores of a machine or on many machines.
//!
//! The command `motile sweep plan.toml` makes the runs of a [`Plan`]: a scene, a time, ranges of the scene's entries.
//! Each run has its own folder with scene file, trajectory, checkpoint and summary. Finished runs are not repeated,
//! unless scene, settings, time or the version of the program have changed; interrupted ones continue from their
//! checkpoints; failed ones are listed and do not keep the others from running. Several processes may work on one
//! sweep: a run belongs to the first that takes it. `--shard 2/4` makes the second of four shares. `motile sweep
//! plan.toml collect` writes one table of all results, byte for byte the same in whatever order they were made; `motile
//! sweep plan.toml status` lists how many runs are left.
//!
//! In a program, [`Plan::trials`] are the runs, [`Trial::run`] makes one, and a [`RunPool`] makes many.

mod plan;
mod run_pool;
mod trial;

use std::path::PathBuf;
use std::sync::atomic::{AtomicBool, Ordering};

use anyhow::{Context, Result, bail, ensure};
use clap::{Args, ValueEnum};
use motile::scene::SceneError;

pub use plan::Plan;
pub use run_pool::RunPool;
pub use trial::{State, Trial};

use crate::run::{ORIGIN_KEY, Summary, Taken, VERSION_KEY, explained, say, write_results};

/// Options of a sweep: a plan, and what to do with its runs.
#[derive(Debug, Args)]
pub struct SweepFlags {
    /// Plan: a scene, a time, and ranges of the scene's entries (TOML)
    #[arg(value_name = "FILE")]
    plan: PathBuf,
    /// Task, after the file: make the runs, write one table of their results, or list how many are left
    #[arg(value_enum, default_value_t = Action::Run)]
    action: Action,
    /// Share of the runs to make, such as 2/4 for the second of four
    #[arg(long, value_parser = shard, default_value = "1/1")]
    shard: Shard,
    /// Runs at a time; without it as many as there are processors
    #[arg(long, value_parser = clap::value_parser!(u16).range(1..=1024))]
    threads: Option<u16>,
    /// Make runs again that failed before
    #[arg(long)]
    retry: bool,
    /// Show no progress
    #[arg(long)]
    quiet: bool,
    /// Directory of the sweep; without it out/sweep/ and the name of the plan
    #[arg(long, value_name = "DIRECTORY")]
    out: Option<PathBuf>,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
enum Action {
    /// Make the runs
    Run,
    /// Write the results of all finished runs to results.csv
    Collect,
    /// List how many runs are finished, failed, begun and not begun
    Status,
}

/// Share of the runs: its number, counted from 0, and the number of shares.
#[derive(Debug, Clone, Copy)]
struct Shard {
    number: usize,
    of: usize,
}

fn shard(text: &str) -> Result<Shard, String> {
    let parts = text.split_once('/').and_then(|(number, of)| Some((number.parse().ok()?, of.parse().ok()?)));
    match parts {
        Some((number, of)) if (1..=of).contains(&number) => Ok(Shard { number: number - 1, of }),
        _ => Err("must be a number and how many there are, such as 2/4".to_owned()),
    }
}

/// Makes the runs of a plan, collects their results, or lists their states, as the flags say.
///
/// # Errors
/// Returns an error for a plan that cannot be read or is not valid; files that cannot be written; runs that failed or
/// were stopped.
pub fn sweep(flags: &SweepFlags) -> Result<()> {
    let plan = Plan::read(&flags.plan)?;
    let name = flags.plan.file_stem().context("a plan is a file")?;
    let directory = flags.out.clone().unwrap_or_else(|| PathBuf::from("out/sweep").join(name));
    let trials = plan.trials(&directory.join("runs"))?;
    // Before any work: a table of two scenes would be of none.
    trials.iter().try_for_each(|trial| trial.check_scene().map(drop))?;
    match flags.action {
        Action::Run => {
            let Shard { number, of } = flags.shard;
            make(trials.into_iter().skip(number).step_by(of).collect(), flags)
        }
        Action::Collect => collect(&trials, &directory),
        Action::Status => status(&trials),
    }
}

fn make(mut trials: Vec<Trial>, flags: &SweepFlags) -> Result<()> {
    let total = trials.len();
    if !flags.retry {
        for trial in &trials {
            if let State::Failed(failure) = trial.state() {
                say(format_args!("{}: failed before (--retry makes it again): {failure}", trial.label));
            }
        }
        trials.retain(|trial| !matches!(trial.state(), State::Failed(_)));
    }
    let failed_before = total - trials.len();
    let stopped = AtomicBool::new(false);
    let processors = || std::thread::available_parallelism().map_or(1, std::num::NonZero::get);
    let threads = flags.threads.map_or_else(processors, usize::from);
    let Some(runs) = trials.first().and_then(|trial| trial.folder.parent().map(PathBuf::from)) else {
        bail!("no run is left here: {failed_before} of {total} failed before. Remove their folders to retry");
    };
    trials.iter().try_for_each(Trial::discard_others)?;
    let pool = RunPool::new(&runs, threads, flags.quiet)?;
    let (done, failures) = pool.study(
        trials,
        |trial| format!("{}/summary", trial.label),
        |trial| {
            ensure!(!stopped.load(Ordering::Relaxed), "not begun");
            let outcome = trial.run();
            if outcome.as_ref().is_err_and(is_stop) {
                stopped.store(true, Ordering::Relaxed);
            }
            outcome
        },
    );
    ensure!(!stopped.into_inner(), "stopped with {} of {total} runs finished; the same command goes on", done.len());
    let (taken, failures): (Vec<_>, Vec<_>) = failures.into_iter().partition(anyhow::Error::is::<Taken>);
    for failure in &failures {
        say(format_args!("failed: {}", explained(failure)));
    }
    say(format_args!("{} of {total} runs are finished in {}", done.len(), runs.display()));
    if !taken.is_empty() {
        say(format_args!("{} runs are being made by another process", taken.len()));
    }
    let failed = failures.len() + failed_before;
    ensure!(failed == 0, "{failed} of {total} runs failed");
    Ok(())
}

fn is_stop(error: &anyhow::Error) -> bool {
    error.downcast_ref::<SceneError>().is_some_and(|error| matches!(error, SceneError::Stopped { .. }))
}

/// Entries of a summary that collected tables leave out: names of the run, and costs, which differ between machines.
const COST: [&str; 14] = [
    "run",
    VERSION_KEY,
    ORIGIN_KEY,
    "seconds",
    "evaluations",
    "stokes_solves",
    "solver_iterations_mean",
    "solver_iterations_max",
    "stages",
    "steps_rejected",
    "steps_failed",
    "dt_shortest",
    "dt_longest",
    "step_error",
];

fn collect(trials: &[Trial], directory: &std::path::Path) -> Result<()> {
    let mut rows = Vec::new();
    let older = trials.iter().filter(|trial| trial.other_version().is_some()).count();
    if older > 0 {
        say(format_args!("{older} results are of another version of motile and left out. Make the runs again"));
    }
    for trial in trials {
        let State::Finished(found) = trial.state() else { continue };
        let mut row = Summary::default();
        row.put("label", trial.label.clone(), "");
        for (path, value) in &trial.values {
            row.put(path, value.clone(), "");
        }
        for (name, value) in found.values().iter().filter(|(name, _)| !COST.contains(&name.as_str())) {
            row.put(name, value.clone(), "");
        }
        rows.push(row);
    }
    ensure!(!rows.is_empty(), "none of the {} runs is finished", trials.len());
    let (path, partial) = (directory.join("results.csv"), directory.join("results.csv.part"));
    write_results(&partial, &rows)?;
    std::fs::rename(&partial, &path).with_context(|| format!("writing {}", path.display()))?;
    say(format_args!("{} of {} runs in {}", rows.len(), trials.len(), path.display()));
    Ok(())
}

fn status(trials: &[Trial]) -> Result<()> {
    let mut counts = [0; 4];
    for trial in trials {
        let kind = match trial.state() {
            State::Finished(_) => 0,
            State::Failed(failure) => {
                say(format_args!("failed: {}: {failure}", trial.label));
                1
            }
            State::Cut => 2,
            State::Left => 3,
        };
        counts[kind] += 1;
    }
    let [finished, failed, cut, left] = counts;
    let older = trials.iter().filter(|trial| trial.other_version().is_some()).count();
    if older > 0 {
        say(format_args!("{older} results are of another version of motile: these runs count as not begun"));
    }
    say(format_args!("{finished} finished, {failed} failed, {cut} begun, {left} not begun, of {}", trials.len()));
    Ok(())
}

#[cfg(test)]
mod tests;

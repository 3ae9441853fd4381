//! Droplets between elastic walls of many stiffnesses, as in chapter 4 of Cowley.
//!
//! `cargo run --release -p studies -- stiffness` makes the runs on a coarse grid, some ten minutes on two cores;
//! `--full` makes all of Cowley's on a fine grid, which takes hours; `--only` makes part of them. Each finished run
//! leaves a file in `out/stiffness/runs/` and is not made again; delete the directory to start afresh. Prints a table
//! for each part (speeds with the fits (4.3), the maps 4.17 and 4.19, the comparison of materials ...), which `--write`
//! keeps as `docs/tables/elastic-PART.csv`, and writes `points.csv` and figures.

mod figures;
mod history;
mod jobs;
mod run;
mod tables;

use std::collections::BTreeSet;

use anyhow::Result;
use clap::{Args, ValueEnum};
use motile_examples::{OutputFlags, Summary, say};
use motile_tests::validation::Table;

use crate::results::write_results;
use crate::run_pool::RunPool;
use crate::stiffness::run::{Job, Purpose};
use crate::tables as files;

/// Droplets between elastic walls of many stiffnesses.
#[derive(Debug, Args)]
pub(crate) struct Flags {
    /// Fine grid, all widths, activities and stiffnesses
    #[arg(long)]
    full: bool,
    /// Only this part
    #[arg(long, value_enum)]
    only: Option<Purpose>,
    /// Grid spacings h (R0); without them 0.1, or 0.05 with --full
    #[arg(long, value_parser = spacing, value_delimiter = ',', allow_hyphen_values = true)]
    spacing: Vec<f64>,
    /// The method of Cowley, for the constriction
    #[arg(long)]
    thesis: bool,
    /// Only runs whose names contain this
    #[arg(long)]
    matching: Option<String>,
    /// Runs at a time; without it as many as there are processors
    #[arg(long, value_parser = clap::value_parser!(u16).range(1..=1024))]
    threads: Option<u16>,
    /// Write the tables to docs/tables, with the commit and what they depend on
    #[arg(long)]
    write: bool,
    #[command(flatten)]
    output: OutputFlags,
}

/// A grid spacing that resolves a droplet and divides all lengths of the study.
fn spacing(text: &str) -> Result<f64, String> {
    let divides = |h: f64| ((1.0 / h) - (1.0 / h).round()).abs() < 1e-9;
    text.parse()
        .ok()
        .filter(|&h| (0.02..=0.2).contains(&h) && divides(h))
        .ok_or_else(|| "must be a number from 0.02 to 0.2 that divides 1, such as 0.1".to_string())
}

pub(crate) fn run(flags: &Flags) -> Result<()> {
    let default = if flags.full { 0.05 } else { 0.1 };
    let spacings = if flags.spacing.is_empty() { &[default][..] } else { &flags.spacing };
    let jobs = spacings.iter().flat_map(|&h| jobs::list(flags.only, flags.full, flags.thesis, h));
    let mut jobs: Vec<Job> = jobs.collect();
    if let Some(text) = &flags.matching {
        jobs.retain(|job| job.name().contains(text));
    }
    let directory = flags.output.directory("stiffness")?;
    let threads = flags
        .threads
        .map_or_else(|| std::thread::available_parallelism().map_or(1, std::num::NonZero::get), usize::from);
    let runs = directory.join("runs");
    let pool = RunPool::new(&runs, threads, flags.output.quiet)?;
    let (points, failures) = pool.study(jobs, Job::name, Job::run);
    let rows: Vec<Summary> = points.iter().map(|(_, summary)| history::without(summary)).collect();
    write_results(&directory.join("points.csv"), &rows)?;
    let made: BTreeSet<Purpose> = points.iter().map(|(job, _)| job.purpose).collect();
    for purpose in made {
        let tables = tables::tables(&points, purpose);
        tables.iter().for_each(say);
        // Runs of other parts that this one compares with are not all of theirs.
        if flags.write && failures.is_empty() && flags.only.is_none_or(|only| only == purpose) {
            flags.keep(purpose, &tables)?;
        }
    }
    if !flags.output.no_pictures {
        let finest = spacings.iter().copied().fold(f64::INFINITY, f64::min);
        let finest: Vec<(Job, Summary)> = points.iter().filter(|(job, _)| job.spacing == finest).cloned().collect();
        figures::write(&finest, &directory)?;
    }
    say(format_args!("results of {} runs in {}", points.len(), directory.display()));
    match failures.into_iter().next() {
        Some(first) => Err(first.context("a run failed; the study can be started again")),
        None => Ok(()),
    }
}

impl Flags {
    /// Writes the tables of a part to docs/tables.
    fn keep(&self, purpose: Purpose, tables: &[Table]) -> Result<()> {
        let Some(part) = purpose.to_possible_value() else { return Ok(()) };
        let mut command = format!("stiffness --only {}", part.get_name());
        if self.full {
            command += " --full";
        }
        if !self.spacing.is_empty() {
            let list: Vec<String> = self.spacing.iter().map(f64::to_string).collect();
            command += &format!(" --spacing {}", list.join(","));
        }
        if let Some(text) = &self.matching {
            command += &format!(" --matching {text}");
        }
        let inputs = [&files::RUNS[..7], &["crates/elastic-solids", "studies/src/stiffness"]].concat();
        files::write(&format!("elastic-{}", part.get_name()), &format!("{command} --write"), &inputs, tables)
    }
}

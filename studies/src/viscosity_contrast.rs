//! Droplets of another viscosity than the exterior fluid: section 2.3 of Cowley, figures 2.8 to 2.26, without a
//! grid.
//!
//! `cargo run --release -p studies -- viscosity_contrast` makes the runs, some minutes on two cores; `--full` makes
//! more of them, longer and finer, an hour or so. Each finished run leaves a file in `out/viscosity_contrast/runs/` and
//! is not made again. From all runs come `points.csv`, the figures (SVG and PNG) and a table, Cowley's statements
//! beside what the runs say, which `--write` keeps in `docs/tables/viscosity-contrast.csv`.

mod figures;
mod run;
mod statements;

use crate::results::write_results;
use crate::run_pool::RunPool;
use crate::tables;
use anyhow::Result;
use clap::Args;
use motile_examples::{OutputFlags, Summary, positive, say};

use crate::viscosity_contrast::run::{Domain, Job};

/// Droplets of another viscosity than the exterior fluid, beside the statements of Cowley.
#[derive(Debug, Args)]
pub(crate) struct Flags {
    /// More viscosities and activities, longer and finer runs
    #[arg(long)]
    full: bool,
    /// Strength A of the excluded volume; Cowley does not give its own
    #[arg(long, default_value_t = 10.0, value_parser = positive, allow_hyphen_values = true)]
    excluded_volume: f64,
    /// Time of each run (R0 = 1); without it 40, or 120 with --full
    #[arg(long, value_parser = positive, allow_hyphen_values = true)]
    time: Option<f64>,
    /// Runs at a time; without it as many as there are processors
    #[arg(long, value_parser = clap::value_parser!(u16).range(1..=1024))]
    threads: Option<u16>,
    /// Write the table to docs/tables
    #[arg(long)]
    write: bool,
    #[command(flatten)]
    output: OutputFlags,
}

pub(crate) fn run(flags: &Flags) -> Result<()> {
    let jobs = jobs(flags);
    let directory = flags.output.directory("viscosity_contrast")?;
    let threads = flags
        .threads
        .map_or_else(|| std::thread::available_parallelism().map_or(1, std::num::NonZero::get), usize::from);
    let runs = directory.join("runs");
    let pool = RunPool::new(&runs, threads, flags.output.quiet)?;
    let (points, failures) = pool.study(jobs, Job::name, Job::run);
    let rows: Vec<Summary> = points.iter().map(|(_, summary)| summary.clone()).collect();
    write_results(&directory.join("points.csv"), &rows)?;
    let table = statements::table(&points);
    say(&table);
    if flags.write {
        let inputs = [&tables::RUNS[..], &["studies/src/viscosity_contrast"]].concat();
        tables::write("viscosity-contrast", "viscosity_contrast --write", &inputs, &[table])?;
    }
    if !flags.output.no_pictures {
        for (name, figure) in figures::all(&points) {
            figure.write(&directory, name)?;
        }
    }
    say(format_args!("results of {} runs in {}", points.len(), directory.display()));
    match failures.into_iter().next() {
        Some(first) => Err(first.context("a run failed; the study can be started again")),
        None => Ok(()),
    }
}

/// All runs, the slowest (of low viscosity) first, so that no thread is left with one of them in the end.
fn jobs(flags: &Flags) -> Vec<Job> {
    let mut pairs: Vec<(f64, f64, f64)> = Vec::new();
    // Equal viscosities, at multiples of the threshold (2.20): the abscissa of figure 2.8 is the same for all of them.
    let equal: &[f64] = if flags.full { &[10.0, 25.0, 50.0, 100.0, 200.0, 500.0] } else { &[25.0, 100.0, 200.0] };
    let multiples: &[f64] =
        if flags.full { &[0.5, 0.8, 1.25, 1.5, 2.0, 3.0, 5.0, 7.5, 10.0] } else { &[0.8, 1.5, 3.0, 5.0, 10.0] };
    for &viscosity in equal {
        pairs.extend(multiples.iter().map(|multiple| (viscosity, viscosity, -0.004 * viscosity * multiple)));
    }
    // A constant sum, figures 2.9 and 2.10; its threshold is -2.
    let differences: &[f64] =
        if flags.full { &[-800.0, -400.0, 0.0, 200.0, 400.0, 600.0, 800.0] } else { &[-400.0, 0.0, 400.0, 800.0] };
    let activities: &[f64] =
        if flags.full { &[-1.5, -2.5, -3.0, -4.0, -5.0, -6.0, -7.0, -8.0] } else { &[-1.5, -3.0, -5.0, -7.0] };
    for difference in differences {
        pairs.extend(activities.iter().map(|activity| (500.0 + 0.5 * difference, 500.0 - 0.5 * difference, *activity)));
    }
    // Large contrasts, among them the droplets of figure 2.5 and that of section 2.3.3.3, (1000, 10) at -1.
    let viscous: &[(f64, f64, &[f64])] = &[
        (100.0, 10.0, &[-0.5, -1.0, -2.0, -3.0]),
        (1000.0, 10.0, &[-1.0, -3.0, -5.0, -7.0]),
        (1000.0, 100.0, &[-4.0, -8.0]),
        (1000.0, 500.0, &[-5.0, -8.0]),
        (10.0, 100.0, &[-1.0, -2.0, -3.0]),
    ];
    for (inside, outside, activities) in viscous {
        pairs.extend(activities.iter().map(|activity| (*inside, *outside, *activity)));
    }
    let time = flags.time.unwrap_or(if flags.full { 120.0 } else { 40.0 });
    let [nodes, cells] = if flags.full { [96, 384] } else { [64, 256] };
    let mut jobs = Vec::new();
    for domain in [Domain::Unbounded, Domain::Box] {
        jobs.extend(pairs.iter().map(|&(inside, outside, activity)| Job {
            domain,
            inside,
            outside,
            activity,
            excluded_volume: flags.excluded_volume,
            nodes,
            cells,
            time,
        }));
    }
    let slowness = |job: &Job| -job.activity / (job.inside + job.outside);
    jobs.sort_by(|a, b| slowness(b).total_cmp(&slowness(a)));
    let mut different: Vec<Job> = Vec::new();
    for job in jobs {
        if !different.contains(&job) {
            different.push(job);
        }
    }
    different
}

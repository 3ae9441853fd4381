//! Speed and amplitude of droplets in rigid channels of many lengths and widths, beside the fits of Cowley
//! (chapter 3).
//!
//! `cargo run --release -p studies -- channels` makes the runs, a few minutes on two cores; `--full` makes them on
//! a fine grid, which takes an hour or more. Each finished run leaves a file in `out/channels/runs/` and is not
//! made again; delete the directory to start afresh. From all runs come `points.csv` and the figures (SVG and PNG)
//! `speed_against_length`, `speed_against_width` and `amplitude_against_length`.

mod figures;
mod run;

use crate::results::write_results;
use crate::run_pool::RunPool;
use anyhow::{Result, ensure};
use clap::Args;
use motile_examples::{OutputFlags, Summary, positive, say};

use crate::channels::figures::{amplitude_against_length, print_speeds, speed_against_length, speed_against_width};
use crate::channels::run::{Job, NARROW, OSCILLATING, Purpose, THESIS_FITS};

/// Side of the box that is called unconfined (R0).
const BOX: f64 = 12.0;
/// Speed and amplitude of droplets in rigid channels, beside the fits of Cowley.
#[derive(Debug, Args)]
pub(crate) struct Flags {
    /// Fine grid, long runs and more lengths
    #[arg(long)]
    full: bool,
    /// Grid spacing h (R0), at most 0.25; without it 0.1, or 0.05 with --full
    #[arg(long, value_parser = spacing, allow_hyphen_values = true)]
    spacing: Option<f64>,
    /// Time of each run for a speed (those for an amplitude take six times as long); without it 80, or 150 with --full
    #[arg(long, value_parser = positive, allow_hyphen_values = true)]
    time: Option<f64>,
    /// Runs at a time; without it as many as there are processors
    #[arg(long, value_parser = clap::value_parser!(u16).range(1..=1024))]
    threads: Option<u16>,
    #[command(flatten)]
    output: OutputFlags,
}

/// A grid spacing that resolves a droplet, and channels of length 36 with at most some thousand cells.
fn spacing(text: &str) -> Result<f64, String> {
    positive(text)
        .ok()
        .filter(|h| (0.01..=0.25).contains(h))
        .ok_or_else(|| "must be a number from 0.01 to 0.25".to_string())
}

pub(crate) fn run(flags: &Flags) -> Result<()> {
    let (jobs, left_out): (Vec<Job>, Vec<Job>) = jobs(flags).into_iter().partition(Job::fits);
    if let Some(first) = left_out.first() {
        let count = left_out.len();
        eprintln!(
            "note: {count} runs are left out, their channels are no whole number of cells (such as {})",
            first.name()
        );
    }
    ensure!(!jobs.is_empty(), "no channel is a whole number of cells: give a spacing that divides 2, such as 0.1");
    let directory = flags.output.directory("channels")?;
    let threads = flags
        .threads
        .map_or_else(|| std::thread::available_parallelism().map_or(1, std::num::NonZero::get), usize::from);
    let runs = directory.join("runs");
    let pool = RunPool::new(&runs, threads, flags.output.quiet)?;
    let (points, failures) = pool.study(jobs, Job::name, Job::run);
    let rows: Vec<Summary> = points.iter().map(|(_, summary)| summary.clone()).collect();
    write_results(&directory.join("points.csv"), &rows)?;
    print_speeds(&points);
    if !flags.output.no_pictures {
        speed_against_length(&points).write(&directory, "speed_against_length")?;
        speed_against_width(&points).write(&directory, "speed_against_width")?;
        amplitude_against_length(&points).write(&directory, "amplitude_against_length")?;
    }
    say(format_args!("results of {} runs in {}", points.len(), directory.display()));
    match failures.into_iter().next() {
        Some(first) => Err(first.context("a run failed; the study can be started again")),
        None => Ok(()),
    }
}

/// All runs, the longest first, so that no thread is left with one of them in the end.
fn jobs(flags: &Flags) -> Vec<Job> {
    let spacing = flags.spacing.unwrap_or(if flags.full { 0.05 } else { 0.1 });
    let time = flags.time.unwrap_or(if flags.full { 150.0 } else { 80.0 });
    let lengths: &[f64] =
        if flags.full { &[8.0, 10.0, 12.0, 16.0, 18.0, 24.0, 30.0, 36.0] } else { &[8.0, 12.0, 24.0, 36.0] };
    let base =
        Job { purpose: Purpose::Speed, length: 12.0, width: NARROW, activity: -4.0, viscosity: 100.0, spacing, time };
    let oscillating = [12.0, 15.0, 18.0, 24.0, 30.0, 36.0].map(|length| Job {
        purpose: Purpose::Amplitude,
        length,
        width: OSCILLATING,
        time: 6.0 * time,
        ..base
    });
    let mut jobs = oscillating.to_vec();
    for (activity, viscosity, _, _) in THESIS_FITS {
        jobs.extend(lengths.iter().map(|&length| Job { length, activity, viscosity, ..base }));
    }
    for activity in [-1.0, -2.0, -3.0, -4.0, -5.0] {
        let widths = [2.0, 2.5, 3.0, 3.5, 4.0, 4.5, 5.0];
        jobs.extend(widths.map(|width| Job { width, activity, ..base }));
        jobs.push(Job { purpose: Purpose::Unconfined, length: BOX, width: BOX, activity, ..base });
    }
    let size = |job: &Job| job.length * job.width * job.time;
    jobs.sort_by(|a, b| size(b).total_cmp(&size(a)));
    // Channels of length 12 and width 2 belong to both series.
    let mut different: Vec<Job> = Vec::new();
    for job in jobs {
        if !different.contains(&job) {
            different.push(job);
        }
    }
    different
}

//! Droplets between elastic walls of many stiffnesses, as in chapter 4 of the thesis.
//!
//! `cargo run --release --example stiffness_study` makes the runs on a coarse grid, some ten minutes on two cores;
//! `--full` makes all of the thesis' on a fine grid, which takes hours; `--only` makes part of them. Each finished run
//! leaves a file in `out/stiffness_study/runs/` and is not made again; delete the directory to start afresh. Prints the
//! speeds with the fits (4.3), the maps 4.17 and 4.19 and the comparison of materials, and writes `points.csv` and figures.

mod figures;
mod history;
mod run;
mod tables;

use std::process::ExitCode;

use anyhow::Result;
use clap::{Parser, ValueEnum};
use motile::{WallMaterial, WallMesh, WallSurface};
use support::{OutputFlags, RunPool, Summary, say, write_results};

use crate::run::{Job, Purpose};

/// Parts of the study.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
enum Part {
    /// Speed, shape and walls against stiffness.
    Speed,
    /// Droplets off the centre line.
    Lateral,
    /// The constriction.
    Passage,
    /// Springs and neo-Hookean walls, lattice and unstructured mesh.
    Comparison,
    /// A channel half as wide as the droplet.
    Narrow,
    /// Droplets more viscous than their surroundings.
    Contrast,
    /// How a droplet in contact with stiff walls starts by the method of the thesis.
    Start,
}

/// Droplets between elastic walls of many stiffnesses.
#[derive(Debug, Parser)]
struct Flags {
    /// Fine grid, all widths, activities and stiffnesses
    #[arg(long)]
    full: bool,
    /// Only this part
    #[arg(long, value_enum)]
    only: Option<Part>,
    /// Grid spacing h (R0); without it 0.1, or 0.05 with --full
    #[arg(long, value_parser = spacing, allow_hyphen_values = true)]
    spacing: Option<f64>,
    /// The method of the thesis, for the constriction
    #[arg(long)]
    thesis: bool,
    /// Only runs whose names contain this
    #[arg(long)]
    matching: Option<String>,
    /// Runs at a time; without it as many as there are processors
    #[arg(long, value_parser = clap::value_parser!(u16).range(1..=1024))]
    threads: Option<u16>,
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

fn main() -> ExitCode {
    support::run(study)
}

fn study(flags: &Flags) -> Result<()> {
    let jobs = jobs(flags);
    let directory = flags.output.directory("stiffness_study")?;
    let threads = flags
        .threads
        .map_or_else(|| std::thread::available_parallelism().map_or(1, std::num::NonZero::get), usize::from);
    let runs = directory.join("runs");
    let pool = RunPool::new(&runs, threads, flags.output.quiet)?;
    let (points, failures) = pool.study(jobs, Job::name, Job::run);
    let rows: Vec<Summary> = points.iter().map(|(_, summary)| history::without(summary)).collect();
    write_results(&directory.join("points.csv"), &rows)?;
    tables::print(&points);
    if !flags.output.no_pictures {
        figures::write(&points, &directory)?;
    }
    say(format_args!("results of {} runs in {}", points.len(), directory.display()));
    match failures.into_iter().next() {
        Some(first) => Err(first.context("a run failed; the study can be started again")),
        None => Ok(()),
    }
}

/// All runs that are asked for, the longest first, so that no thread is left with one of them in the end.
fn jobs(flags: &Flags) -> Vec<Job> {
    let h = flags.spacing.unwrap_or(if flags.full { 0.05 } else { 0.1 });
    let mut jobs = Vec::new();
    for part in Part::value_variants().iter().filter(|part| flags.only.is_none_or(|only| only == **part)) {
        match part {
            Part::Speed => speeds(flags.full, h, &mut jobs),
            Part::Lateral => lateral(flags.full, h, &mut jobs),
            Part::Passage => passages(flags.thesis, h, &mut jobs),
            Part::Comparison => comparisons(h, &mut jobs),
            Part::Narrow => narrow(h, &mut jobs),
            Part::Contrast => contrasts(h, &mut jobs),
            Part::Start => starts(h, &mut jobs),
        }
    }
    if let Some(text) = &flags.matching {
        jobs.retain(|job| job.name().contains(text));
    }
    jobs.sort_by(|a, b| b.size().total_cmp(&a.size()));
    jobs
}

fn speeds(full: bool, h: f64, jobs: &mut Vec<Job>) {
    let widths: &[f64] = if full { &[2.0, 3.0, 5.0] } else { &[2.0] };
    let activities: &[f64] = if full { &[-1.0, -2.0, -3.0, -4.0, -5.0] } else { &[-2.0, -4.0] };
    let stiffnesses: Vec<f64> =
        if full { (1..=10).map(|k| 1e4 * f64::from(k)).chain([1e6]).collect() } else { vec![1e4, 3e4, 1e5, 1e6] };
    let time = 60.0;
    for &width in widths {
        for &activity in activities {
            jobs.extend(stiffnesses.iter().map(|&k| Job::new(Purpose::Speed, width, activity, k, h, time)));
            jobs.push(Job::new(Purpose::Rigid, width, activity, f64::INFINITY, h, time));
            jobs.push(Job::new(Purpose::Unconfined, LARGE, activity, 0.0, h, time));
        }
    }
    if !full {
        // Where the thesis' least active droplet swims, and where it does not.
        jobs.extend([1e4, 4e4].map(|k| Job::new(Purpose::Speed, 2.0, -1.0, k, h, 150.0)));
    }
    jobs.dedup();
}

/// Width that is none.
const LARGE: f64 = 12.0;

fn lateral(full: bool, h: f64, jobs: &mut Vec<Job>) {
    let widths: &[f64] = if full { &[3.0, 4.0, 5.0] } else { &[3.0] };
    let activities: &[f64] = if full { &[-1.0, -2.0, -3.0, -4.0, -5.0] } else { &[-4.0] };
    let stiffnesses: &[f64] = if full { &[1e4, 2e4, 4e4, 6e4, 8e4, 1e5, 1e6] } else { &[1e4, 1e5, 1e6] };
    for &width in widths {
        for &activity in activities {
            let job = |&k: &f64| Job::new(Purpose::Lateral, width, activity, k, h, 150.0);
            jobs.extend(stiffnesses.iter().map(|k| Job { excluded_volume: 13.5, ..job(k) }));
        }
    }
}

fn passages(thesis: bool, h: f64, jobs: &mut Vec<Job>) {
    for k in [1e4, 5e4, 1e5, 1e6] {
        for activity in [-1.0, -2.0, -3.0, -4.0, -5.0] {
            jobs.push(Job { thesis, ..Job::new(Purpose::Passage, 2.0, activity, k, h, 300.0) });
        }
    }
}

fn comparisons(h: f64, jobs: &mut Vec<Job>) {
    let job =
        Job { viscosity: 1000.0, excluded_volume: 20.0, ..Job::new(Purpose::Comparison, 2.0, -10.0, 1e4, h, 80.0) };
    for mesh in [WallMesh::Equilateral, WallMesh::Unstructured] {
        for material in [WallMaterial::Springs, WallMaterial::NeoHookean] {
            jobs.push(Job { material, mesh, ..job });
        }
    }
}

fn contrasts(h: f64, jobs: &mut Vec<Job>) {
    // On the finest grids only the beginning.
    let time = if h < 0.04 { 5.0 } else { 20.0 };
    // In the narrower channel the droplet touches the walls when it starts.
    for width in [2.0, 2.2] {
        for ratio in [1.0, 10.0, 100.0] {
            // The droplet keeps its viscosity of 100; its surroundings are thinner.
            let job = Job::new(Purpose::Contrast, width, -2.0, 1e4, h, time);
            jobs.push(Job { viscosity: 100.0 / ratio, ratio, ..job });
        }
    }
}

fn starts(h: f64, jobs: &mut Vec<Job>) {
    let start = Job { thesis: true, ..Job::new(Purpose::Start, 2.0, -5.0, 1e6, h, 15.0) };
    jobs.extend([0.0, 0.3 * h, 0.6 * h, h].map(|back| Job { back, ..start }));
    jobs.push(Job { equidistant: true, ..start });
    let passage = Job { purpose: Purpose::Passage, time: 300.0, ..start };
    jobs.push(Job { back: 0.6 * h, ..passage });
    jobs.push(Job { equidistant: true, ..passage });
}

fn narrow(h: f64, jobs: &mut Vec<Job>) {
    for young in [1e3, 1e4] {
        for activity in [-1.0, -2.0, -3.0, -4.0, -5.0] {
            let job = Job::new(Purpose::Narrow, 1.0, activity, young, h, 60.0);
            // Set back, walls as soft as the softer ones are entered by the droplet or turn inside out.
            let surface = WallSurface::Corrected;
            jobs.push(Job { material: WallMaterial::NeoHookean, mesh: WallMesh::Unstructured, surface, ..job });
        }
    }
}

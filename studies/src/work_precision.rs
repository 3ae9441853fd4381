//! Error against cost: every kind of scene by every method, over spacings, nodes, time steps, kernels, corrections and
//! integrators.
//!
//! `cargo run --release -p studies -- work_precision` takes some minutes on one core; `--only
//! SCENE` makes one scene. Each finished run leaves a file in `out/work_precision/runs/BUILD/`, where BUILD
//! is a number that another build of this program does not have, and is not made again. So the tables may be made in
//! several goes, by one state of the code all the same. From all runs come `points.csv` and a figure a scene (SVG and
//! PNG); with `--write` the tables of docs/tables and the figures of docs/images/work_precision.
//!
//! Costs are measured by turns with a plain real transform, so that what else the machine does cancels; runs are made
//! one at a time.

pub(crate) mod cost;
mod figures;
mod front;
mod lists;
mod report;
mod settings;
mod shapes;
mod studies;
mod swimmers;

use crate::tables::{self, Measure, all_wanted, program};
use anyhow::{Context, Result};
use clap::Args;
use motile_cli::run::{OutputFlags, Summary, say, write_results};
use motile_cli::sweep::RunPool;

use crate::work_precision::front::Point;
use crate::work_precision::settings::Settings;
use crate::work_precision::studies::Study;

/// Error against cost, over all scenes, methods and resolutions.
#[derive(Debug, Args)]
pub(crate) struct Flags {
    /// Only this scene
    #[arg(long, value_enum)]
    only: Option<Study>,
    /// Print the speed that the swimmer of ratio 100 is compared with, and nothing else
    #[arg(long)]
    reference: bool,
    #[command(flatten)]
    keep: tables::Keep,
    #[command(flatten)]
    output: OutputFlags,
}

pub(crate) fn run(flags: &Flags) -> Result<()> {
    if flags.reference {
        say(format_args!("{:.10}", swimmers::reference_of_ratio_100()?));
        return Ok(());
    }
    let directory = flags.output.directory("work_precision")?;
    let jobs: Vec<(Study, Settings)> = Study::all()
        .filter(|study| flags.only.is_none_or(|only| only == *study))
        .flat_map(|study| lists::settings(study).into_iter().map(move |settings| (study, settings)))
        .collect();
    let name = |(study, settings): &(Study, Settings)| format!("{}_{}", study.name(), settings.name());
    if !all_wanted() {
        let mut table = report::empty();
        for job in &jobs {
            table.measure(report::name(job.0, &job.1), || Ok(report::cells(&point(job)?, " | ", "")))?;
        }
        return flags.keep.tables("work-precision", COMMAND, &[table]);
    }
    let runs = directory.join("runs").join(program()?);
    let results = RunPool::new(&runs, 1, flags.output.quiet)?.run(&jobs, name, point);

    let mut points = Vec::new();
    for ((study, settings), result) in jobs.into_iter().zip(results) {
        match result {
            Ok(summary) => points.push(Point { study, settings, summary }),
            // Settings that do not get through, such as steps that turn out too long, are an outcome too.
            Err(error) => say(format_args!("{error:#}")),
        }
    }
    let rows: Vec<Summary> = points.iter().map(|point| point.summary.clone()).collect();
    write_results(&directory.join("points.csv"), &rows)?;
    let found = report::tables(&points);
    flags.keep.tables("work-precision", COMMAND, &found)?;
    for study in Study::all() {
        let own: Vec<Point> = points.iter().filter(|point| point.study == study).cloned().collect();
        if own.is_empty() || flags.output.no_pictures {
            continue;
        }
        let figure = figures::figure(study, &own);
        figure.write(&directory, study.name())?;
        if flags.keep.writes() {
            let pictures = tables::root().join("docs/images/work_precision");
            motile_cli::run::make_directory(&pictures)?;
            let path = pictures.join(format!("{}.svg", study.name()));
            std::fs::copy(directory.join(format!("{}.svg", study.name())), &path)
                .with_context(|| format!("writing {}", path.display()))?;
        }
    }
    say(format_args!("{} points in {}", points.len(), directory.display()));
    Ok(())
}

fn point((study, settings): &(Study, Settings)) -> Result<Summary> {
    let started = std::time::Instant::now();
    let (error, cost) = study.run(settings)?;
    let mut summary = Summary::default();
    summary.put("study", study.name(), "");
    settings.put(&mut summary);
    summary.put("error", error, "");
    cost.put(&mut summary);
    summary.put("seconds", started.elapsed().as_secs_f64(), "");
    Ok(summary)
}

/// How the tables are made.
const COMMAND: &str = "work_precision";

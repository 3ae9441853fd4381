//! Error against cost: every kind of scene by every method, over spacings, nodes, time steps, kernels, corrections and
//! integrators.
//!
//! `cargo run --release -p studies -- work_precision` takes some minutes on one core; `--only
//! SCENE` makes one scene. Each finished run leaves a file in `out/work_precision/runs/COMMIT/`, COMMIT being the
//! last change to the library or to this study, and is not made again, so that the tables may be made in several goes,
//! by one state of the code all the same. From all runs come `points.csv` and a figure a scene (SVG and PNG); with
//! `--write` the tables of docs/tables and the figures of docs/images/work_precision.
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

use crate::tables;
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
    /// Write the tables and figures of docs/ too
    #[arg(long)]
    write: bool,
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
    let commit = tables::commit(&CODE)?;
    let runs = directory.join("runs").join(&commit);
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
    found.iter().for_each(say);
    if flags.write {
        tables::write("work-precision", "work_precision", &CODE, &found)?;
    }
    for study in Study::all() {
        let own: Vec<Point> = points.iter().filter(|point| point.study == study).cloned().collect();
        if own.is_empty() || flags.output.no_pictures {
            continue;
        }
        let figure = figures::figure(study, &own);
        figure.write(&directory, study.name())?;
        if flags.write {
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
    let (error, cost) = study.run(settings)?;
    let mut summary = Summary::default();
    summary.put("study", study.name(), "");
    settings.put(&mut summary);
    summary.put("error", error, "");
    cost.put(&mut summary);
    Ok(summary)
}

/// Sources that the tables depend on beside runs of droplets.
const CODE: [&str; 3] = ["tests/src/validation", "crates/elastic-solids", "studies/src/work_precision"];

//! Scenes that are hard to compute, and what becomes of them.
//!
//! `cargo run --release -p studies -- hard_cases` runs the long version of the suite in `tests/src/hard_cases`, prints
//! a table (case, method, outcome, steps, changes of area and particles, seconds), and writes to `out/hard_cases/` a
//! picture of the last state of each run and `summary.json`. `--case N` runs one case, `--quick` the short version,
//! `--write` keeps the table in `docs/tables`. `--help` lists the flags.

use std::path::PathBuf;

use crate::tables;
use anyhow::Result;
use clap::Args;
use motile_cli::run::{Summary, make_directory, say, write_results};
use motile_output::{Look, Raster, Snapshot};
use motile_tests::hard_cases::{Extent, Outcome, Trial, cases};
use motile_tests::validation::Table;

/// Scenes that are hard to compute.
#[derive(Debug, Args)]
pub(crate) struct Flags {
    /// Numbers of the cases to run; without it all
    #[arg(long = "case", value_name = "NUMBER", value_delimiter = ',')]
    cases: Vec<usize>,
    /// Run the short version, as the tests do
    #[arg(long)]
    quick: bool,
    /// Draw no pictures
    #[arg(long)]
    no_pictures: bool,
    /// Write the table to docs/tables, with the commit and what it depends on
    #[arg(long, conflicts_with_all = ["quick", "cases"])]
    write: bool,
    /// Directory of the results
    #[arg(long, value_name = "DIRECTORY", default_value = "out/hard_cases")]
    out: PathBuf,
}

/// Grid spacing of the fields in pictures.
const SPACING: f64 = 0.05;
/// Concentration that counts as one in pictures (particles per length).
const CONCENTRATION: f64 = 100.0;

pub(crate) fn run(flags: &Flags) -> Result<()> {
    make_directory(&flags.out)?;
    let extent = if flags.quick { Extent::Quick } else { Extent::Long };
    let columns =
        ["case", "what is hard", "method", "outcome", "time", "steps", "rejected", "area", "particles", "seconds"];
    say(columns.join(" | "));
    let mut table = Table::new("How hard cases end", &columns);
    let (mut results, mut wrong) = (Vec::new(), Vec::new());
    let chosen = |trial: &&Trial| flags.cases.is_empty() || flags.cases.contains(&trial.number);
    for (index, trial) in cases().iter().filter(chosen).enumerate() {
        let name = format!("{:02}_{}_{index}.png", trial.number, trial.way.to_string().replace([' ', ','], "_"));
        let mut drawn = Ok(());
        let outcome = trial.run(extent, &mut |system| {
            if !flags.no_pictures {
                let caption = format!("{}: {}", trial.number, trial.name);
                let look = Look {
                    caption,
                    concentration: Some(CONCENTRATION),
                    length_unit: "R_{0}".into(),
                    ..Look::default()
                };
                drawn = Raster::of(system, SPACING)
                    .and_then(|raster| Snapshot::take(system, raster))
                    .and_then(|seen| look.write_picture(&seen, &[], flags.out.join(&name)));
            }
        })?;
        if let Err(error) = drawn {
            say(format_args!("note: no picture of {trial:?}: {error}"));
        }
        let row = row(trial, &outcome);
        say(row.join(" | "));
        table.push(row);
        results.push(summary(trial, &outcome, &name));
        wrong.extend(trial.complaint(&outcome));
    }
    write_results(&flags.out.join("summary.json"), &results)?;
    say(format_args!("results in {}", flags.out.display()));
    if flags.write {
        tables::write("hard-cases", "hard_cases", &["crates/elastic-solids", "tests/src/hard_cases"], &[table])?;
    }
    anyhow::ensure!(wrong.is_empty(), "{} runs did not end as they should: {}", wrong.len(), wrong.join("; "));
    Ok(())
}

fn row(trial: &Trial, outcome: &Outcome) -> [String; 10] {
    let Outcome { ending, time, steps, rejected, drift, seconds, .. } = outcome;
    [
        trial.number.to_string(),
        trial.name.to_owned(),
        trial.way.to_string(),
        format!("{ending:?}"),
        format!("{time:.4}"),
        steps.to_string(),
        rejected.to_string(),
        format!("{:+.1e}", drift.area),
        format!("{:+.1e}", drift.particles),
        format!("{seconds:.1}"),
    ]
}

fn summary(trial: &Trial, outcome: &Outcome, picture: &str) -> Summary {
    let mut summary = Summary::default();
    summary.put("case", trial.number, "");
    summary.put("name", trial.name, "");
    summary.put("method", trial.way.to_string(), "");
    summary.put("outcome", format!("{:?}", outcome.ending), "");
    summary.put("error", outcome.explanation.clone(), "");
    summary.put("time", outcome.time, "");
    summary.put("steps", outcome.steps, "");
    summary.put("taken_back", outcome.rejected, "");
    summary.put("evaluations", outcome.evaluations, "");
    summary.put("area_relative_change", outcome.drift.area, "");
    summary.put("particle_relative_change", outcome.drift.particles, "");
    summary.put("seconds", outcome.seconds, "");
    summary.put("picture", picture, "");
    summary
}

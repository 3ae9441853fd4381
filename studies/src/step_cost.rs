//! Where the time of a step goes.
//!
//! `cargo run --release -p studies -- step_cost` steps every kind of scene at several sizes, by turns with the bare
//! real transforms of its grid, prints what each phase of a step takes, and writes `step_cost.json` to
//! `out/step_cost/`. A few minutes; `--only NAME` measures only scenes whose names contain NAME.
//!
//! Phases of the bodies, the solves and the flow are timed within the steps; spreading, interpolation and transforms by
//! themselves on the state of the step, as often as the step has them. `coupling` is what is left of the flow: the
//! mobility correction, checks, the double layer of a contrast or the iterations of a varying viscosity beyond their
//! solves, and without a grid all of it. The unit of the column "pairs" is one forward and one inverse real FFT of the
//! grid, done plainly with realfft; without a grid that of the grid of spacing 0.05.

mod phases;
mod scenes;
mod watched;

use std::path::PathBuf;
use std::time::Duration;

use anyhow::{Context, Result};
use clap::Args;
use motile_cli::run::{Summary, say};
use motile_examples::positive;
use serde_json::{Value, json};

use crate::step_cost::phases::PHASES;

/// Where the time of a step goes.
#[derive(Debug, Args)]
pub(crate) struct Flags {
    /// Time spent on each scene (seconds)
    #[arg(long, default_value_t = 3.0, value_parser = positive)]
    seconds: f64,
    /// Measure only scenes whose names contain this
    #[arg(long, default_value = "")]
    only: String,
    /// Directory of the results
    #[arg(long, value_name = "DIRECTORY", default_value = "out/step_cost")]
    out: PathBuf,
}

pub(crate) fn run(flags: &Flags) -> Result<()> {
    motile_cli::run::make_directory(&flags.out)?;
    say(header());
    let mut results = Vec::new();
    for (name, run) in scenes::jobs()? {
        if !name.contains(&flags.only) {
            continue;
        }
        let summary = run(Duration::from_secs_f64(flags.seconds)).with_context(|| name.clone())?;
        say(row(&name, &summary));
        results.push(Value::Object(summary.values().clone()));
    }
    let path = flags.out.join("step_cost.json");
    let text = format!("{:#}\n", json!({ "scenes": results }));
    std::fs::write(&path, text).with_context(|| format!("writing {}", path.display()))?;
    say(format_args!("{}", path.display()));
    Ok(())
}

fn header() -> String {
    let phases: String = PHASES.iter().map(|phase| format!(" {phase:>13}")).collect();
    format!("{:<38} {:>7} {:>9} {:>9} {:>6}{phases}  (us)", "scene", "markers", "pair", "step", "pairs")
}

fn row(name: &str, summary: &Summary) -> String {
    let phases: String =
        PHASES.iter().map(|phase| format!(" {:>13.1}", summary.number(&format!("{phase}_us")))).collect();
    let [markers, pair, step, pairs] = ["markers", "pair_us", "step_us", "step_pairs"].map(|key| summary.number(key));
    format!("{name:<38} {markers:>7} {pair:>9.1} {step:>9.1} {pairs:>6.2}{phases}")
}

//! A branch of steady states over a parameter, with its stability and special points.
//!
//! `cargo run --release --example bifurcation_diagram -- --in activity --from -0.3 --to -4` follows the droplet at
//! rest, and the swimmers that branch off where it polarises, and writes to `out/bifurcation_diagram/`:
//! `branches.csv`, all points; `special.csv`, folds (kind 0), branch points (1), Hopf points (2) and the ends of
//! branches (3); `summary.json`, why they end; `diagram.svg` (also as PNG), stable parts drawn through and unstable
//! ones dashed. With `--swimmer` it starts from the swimmer at `--from`. It goes on with `--resume` where it was broken
//! off. `--help` lists the flags.

use std::path::PathBuf;
use std::process::ExitCode;

use clap::Parser;
use motile_cli::steady::DiagramSettings;
use motile_steady_examples::SteadyFlags;
use motile_steady_states::Parameter;

/// A branch of steady states over a parameter, with its stability and special points.
#[derive(Debug, Parser)]
struct Flags {
    #[command(flatten)]
    scene: SteadyFlags,
    /// Parameter
    #[arg(long = "in", value_name = "PARAMETER", value_parser = parameter)]
    parameter: Parameter,
    /// Its first value
    #[arg(long, allow_hyphen_values = true)]
    from: f64,
    /// Its last value
    #[arg(long, allow_hyphen_values = true)]
    to: f64,
    /// Start from the swimmer at the first value instead of the droplet at rest
    #[arg(long)]
    swimmer: bool,
    /// Largest step, as a part of the range
    #[arg(long, default_value_t = 0.05)]
    step: f64,
    /// Another observable for the table, such as beta, active_fraction or stresslet_xx; may be repeated
    #[arg(long, value_name = "NAME")]
    observable: Vec<String>,
    /// Go on from the last point in the directory of the results
    #[arg(long)]
    resume: bool,
    /// Show no progress
    #[arg(long)]
    quiet: bool,
    /// Directory of the results
    #[arg(long, value_name = "DIRECTORY", default_value = "out/bifurcation_diagram")]
    out: PathBuf,
}

fn parameter(text: &str) -> Result<Parameter, String> {
    let found = Parameter::NAMES.iter().find(|(name, _)| *name == text);
    let names = || Parameter::NAMES.map(|(name, _)| name).join(", ");
    found.map(|(_, parameter)| *parameter).ok_or_else(|| format!("must be one of {}", names()))
}

fn main() -> ExitCode {
    motile_examples::run(|flags: &Flags| {
        let &Flags { parameter, from, to, swimmer, step, resume, quiet, .. } = flags;
        let (range, observables, out) = ([from, to], flags.observable.clone(), flags.out.clone());
        let settings = DiagramSettings { parameter, range, swimmer, step, observables, resume, quiet, out };
        motile_cli::steady::draw(&flags.scene.setup()?, &settings)
    })
}

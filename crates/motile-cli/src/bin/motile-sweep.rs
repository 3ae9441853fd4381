//! Parameter sweeps from the command line: [`motile_cli::sweep`].

use std::process::ExitCode;

use clap::Parser;
use motile_cli::run::explained;
use motile_cli::sweep::{SweepFlags, sweep};

/// Makes the runs of a plan, on all cores of a machine or on many machines, and collects their results.
#[derive(Debug, Parser)]
#[command(name = "motile-sweep", version)]
struct Command {
    #[command(flatten)]
    sweep: SweepFlags,
}

fn main() -> ExitCode {
    match sweep(&Command::parse().sweep) {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            eprintln!("error: {}", explained(&error));
            ExitCode::FAILURE
        }
    }
}

//! The program `motile`: runs, sweeps, steady states and checks of scene files.

mod check;
mod new;

use std::process::ExitCode;

use anyhow::Result;
use clap::{Args, Parser, Subcommand};
use motile_cli::command_line::positive;
use motile_cli::keys::SceneFlags;
use motile_cli::run::{OutputFlags, SceneRun, SpaceRun, View, say};
use motile_cli::steady::{SteadyFlags, steady};
use motile_cli::sweep::{SweepFlags, sweep};

/// Active droplets, elastic and rigid bodies in Stokes flow: runs scene files, records and draws them.
#[derive(Debug, Parser)]
#[command(name = "motile", version)]
struct Command {
    #[command(subcommand)]
    task: Task,
}

#[derive(Debug, Subcommand)]
enum Task {
    /// Run a scene, with tables, pictures, an animation and checkpoints
    Run(RunFlags),
    /// Make the runs of a plan, on all cores of a machine or on many machines, and collect their results
    Sweep(SweepFlags),
    /// Find the steady state of a scene and its stability, or follow it along a key
    Steady(SteadyFlags),
    /// Check a scene: say what would run, without running it
    Check(CheckFlags),
    /// Write an annotated scene to begin with
    New(new::NewFlags),
}

/// Options of a run.
#[derive(Debug, Args)]
struct RunFlags {
    #[command(flatten)]
    scene: SceneFlags,
    /// Time to be simulated
    #[arg(long, default_value_t = 60.0, value_parser = positive, allow_hyphen_values = true)]
    time: f64,
    #[command(flatten)]
    output: OutputFlags,
}

/// Options of a check.
#[derive(Debug, Args)]
struct CheckFlags {
    #[command(flatten)]
    scene: SceneFlags,
    /// Time of the run whose cost is estimated
    #[arg(long, default_value_t = 60.0, value_parser = positive, allow_hyphen_values = true)]
    time: f64,
}

fn main() -> ExitCode {
    motile_cli::command_line::run(|command: &Command| match &command.task {
        Task::Run(flags) => run(flags),
        Task::Sweep(flags) => sweep(flags),
        Task::Steady(flags) => steady(flags),
        Task::Check(flags) => {
            let setup = flags.scene.setup()?;
            check::check(&setup, flags.time)
        }
        Task::New(flags) => new::write(flags),
    })
}

fn run(RunFlags { scene, time, output }: &RunFlags) -> Result<()> {
    let name = scene.name();
    output.check(&name, Some(&scene.file))?;
    let setup = scene.setup()?;
    if !output.quiet {
        setup.hints().iter().for_each(|hint| say(format_args!("note: {hint}")));
    }
    let built = setup.build()?;
    if let Some(body) = built.space {
        let mut run = SpaceRun::new(built.scene, body, &setup, *time, output, &name)?;
        run.go()?;
        let summary = run.summary()?;
        return run.finish(&summary);
    }
    let mut run = SceneRun::new(built, &setup, *time, output, &name, &View::of(&setup))?;
    run.go(None)?;
    // The results, also of a run that broke off.
    let summary = run.summary()?;
    run.finish(&summary)
}

//! An active droplet swims in a channel with rigid no-slip walls (Cowley, chapter 3).
//!
//! `cargo run --release --example rigid_channel` simulates it, prints what was measured, and writes to
//! `out/rigid_channel/` what the example `swimming_droplet` writes, with the channel and the path of the droplet in the
//! pictures. `--help` lists the flags.

use std::process::ExitCode;

use anyhow::Result;
use clap::Parser;
use motile::active_interface::observables::net_flux;
use motile::analysis::trajectory::Evidence;
use motile_examples::{ChannelFlags, SceneFlags};

/// An active droplet swims in a channel with rigid walls.
#[derive(Debug, Parser)]
#[command(after_help = "The default run takes 1,132 steps, 2,265 evaluations of the flow.")]
struct Flags {
    #[command(flatten)]
    scene: SceneFlags<ChannelFlags>,
}

fn main() -> ExitCode {
    motile_examples::run(swim)
}

fn swim(Flags { scene: flags }: &Flags) -> Result<()> {
    // The droplet, in the middle of its channel unless an offset is given, and the channel.
    let mut setup = flags.method.setup(&flags.droplet, None)?;
    flags.region.apply(&mut setup)?;

    // The run, with all that watches it.
    let mut run = flags.watch(setup.build()?, &setup, "rigid_channel")?;
    run.go(None)?;

    // The results, also of a run that broke off.
    let mut summary = run.summary()?;
    let Evidence { period, growth_rate, .. } = run.put_regime(&mut summary)?;
    summary.put("period", period.map(|period| period.value), "of the oscillation");
    summary.put("growth_rate", growth_rate.map(|rate| rate.value), "of its amplitude");
    let last = run.last()?.clone();
    summary.put("pressure_gradient", last.pressure_gradient, "mean along the channel");
    // Far from the interface, where the flow is smooth.
    let opposite = last.observables.centroid.x + 0.5 * flags.region.along.length;
    let flux = net_flux(run.scene.system_mut(), opposite)?;
    summary.put("net_flux", flux, "along the channel (R0^2 per time)");
    summary.put("retrograde_flow", last.flow.and_then(|flow| flow.retrograde()), "past the droplet, seen from it");
    summary.put("gap", last.gap, "to the walls, in the end (R0)");
    summary.put("minimum_gap", run.scene.system().minimum_wall_gap(), "to the walls, over the run (R0)");
    run.finish(&summary)
}

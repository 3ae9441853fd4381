//! An active droplet meets a constriction between elastic walls (thesis, section 4.1.3).
//!
//! `cargo run --release --example constriction` simulates it until it is clear what becomes of the droplet, prints that
//! and what was measured, and writes to `out/constriction/` what the example `elastic_channel` writes. The channel is
//! that of thesis figure 4.18, the droplet starts in the middle of its wide part; `--width`, `--throat` and
//! `--throat-length` change it. Walls are set back (`--surface set-back`) unless another `--surface` is asked for.
//! `--help` lists the flags.

use std::process::ExitCode;

use anyhow::{Result, ensure};
use clap::Parser;
use motile::{Built, ChannelShape};
use motile_examples::{
    DropletFlags, ElasticFlags, MethodFlags, OutputFlags, Passage, SurfaceRule, WatchedRun, caption, positive, say,
};

/// An active droplet meets a constriction between elastic walls.
#[derive(Debug, Parser)]
struct Flags {
    /// Width of the throat (R0)
    #[arg(long, default_value_t = 1.0, value_parser = positive, allow_hyphen_values = true)]
    throat: f64,
    /// Length of the throat (R0)
    #[arg(long, default_value_t = 4.0, value_parser = positive, allow_hyphen_values = true)]
    throat_length: f64,
    /// Length of the ramps on both sides of it (R0)
    #[arg(long, default_value_t = 1.0, value_parser = positive, allow_hyphen_values = true)]
    ramp: f64,
    /// Time after which a droplet that is still on its way is called undecided; takes the place of --time
    #[arg(long, default_value_t = 400.0, value_parser = positive, allow_hyphen_values = true)]
    patience: f64,
    #[command(flatten)]
    droplet: DropletFlags,
    #[command(flatten)]
    walls: ElasticFlags,
    #[command(flatten)]
    method: MethodFlags,
    #[command(flatten)]
    output: OutputFlags,
}

fn main() -> ExitCode {
    motile_examples::run(meet)
}

fn meet(flags: &Flags) -> Result<()> {
    // The channel, and the droplet half a period away from the middle of the throat.
    let &Flags { throat, throat_length, ramp, patience, .. } = flags;
    let method = MethodFlags { time: patience, ..flags.method.clone() };
    // Droplets that are pressed against the mouth for long enter corrected surfaces.
    let surface = Some(SurfaceRule::SetBack);
    let ElasticFlags { length: period, width, .. } = flags.walls;
    ensure!(throat <= width, "--throat {throat} is wider than the channel: give a number up to --width {width}");
    ensure!(
        throat_length + 2.0 * ramp <= period,
        "--throat-length {throat_length} and two --ramp {ramp} do not fit into --length {period}: make one of them smaller"
    );
    let shape = ChannelShape::Constriction { width, throat, throat_length, ramp, centre: 0.0 };
    let setup = flags.walls.setup(&shape, &flags.droplet, &method, -0.5 * period, surface)?;
    let Built { mut scene, droplets, .. } = setup.build()?;

    // The run, with all that watches it, until the verdict.
    let title = format!("{},  {}", caption(&setup), flags.walls.caption()?);
    let mut run = WatchedRun::new(&mut scene, &droplets, &setup, &method, &flags.output, "constriction", title)?;
    let mut passage = Passage::new(0.5 * throat_length + ramp);
    let outcome = run.go_until(&mut scene, &mut passage)?;

    // The results, also of a run that broke off.
    let mut summary = run.summary()?;
    passage.put(&mut summary);
    summary.put("throat", throat, "(R0)");
    summary.put("throat_length", throat_length, "(R0)");
    summary.write(&run.directory().join("summary.json"))?;
    say(summary.table().trim_end());
    run.write_pictures(&mut scene)?;
    say(format_args!("results in {}", run.directory().display()));
    Ok(outcome?)
}

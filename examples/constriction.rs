//! An active droplet meets a constriction between elastic walls (Cowley, section 4.1.3).
//!
//! `cargo run --release --example constriction` simulates it until it is clear what becomes of the droplet, prints that
//! and what was measured, and writes to `out/constriction/` what the example `elastic_channel` writes. The channel is
//! that of Cowley figure 4.18, the droplet, twice as active and on a grid twice as coarse for a run of a minute, starts
//! in the middle of its wide part and passes; `--activity -2 --spacing 0.05` has the figure's, `--width`, `--throat`
//! and
//! `--throat-length` change the channel. `--help` lists the flags.

use std::process::ExitCode;

use anyhow::{Result, ensure};
use clap::Parser;
use motile::elastic_solids::ChannelShape;
use motile_examples::{ElasticFlags, Passage, SceneFlags, positive};

/// An active droplet meets a constriction between elastic walls.
#[derive(Debug, Parser)]
#[command(
    after_help = "The default run takes 2,160 steps, 4,321 evaluations of the flow.",
    mut_arg("time", |time| time.visible_alias("patience").default_value("400").help(
        "Time after which a droplet that is still on its way is called undecided"
    )),
    mut_arg("spacing", |spacing| spacing.default_value("0.1").help("Grid spacing h (R0)")),
    mut_arg("activity", |activity| activity.default_value("-4").help(
        "Activity zeta delta-mu, negative: contractile; at -2, as in Cowley, the droplet takes far longer"
    ))
)]
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
    #[command(flatten)]
    scene: SceneFlags<ElasticFlags>,
}

fn main() -> ExitCode {
    motile_examples::run(meet)
}

fn meet(flags: &Flags) -> Result<()> {
    // The channel, and the droplet half a period away from the middle of the throat.
    let &Flags { throat, throat_length, ramp, ref scene } = flags;
    let flags = scene;
    let (width, period) = (flags.region.width, flags.region.along.length);
    ensure!(throat <= width, "--throat {throat} is wider than the channel: give a number up to --width {width}");
    ensure!(
        throat_length + 2.0 * ramp <= period,
        "--throat-length {throat_length} and two --ramp {ramp} do not fit into --length {period}: make one of them \
         smaller"
    );
    let shape = ChannelShape::Constriction { width, throat, throat_length, ramp, centre: 0.0 };
    let mut setup = flags.setup(&shape, -0.5 * period)?;
    // Walls that a droplet presses against for long are compressed by a third and more along their surface.
    setup.solids.iter_mut().for_each(|wall| wall.finer_surface = Some(false));

    // The run, with all that watches it, until the verdict.
    let mut run = flags.watch(setup.build()?, &setup, "constriction")?;
    let mut passage = Passage::new(0.5 * throat_length + ramp);
    run.go(Some(&mut passage))?;

    // The results, also of a run that broke off.
    let mut summary = run.summary()?;
    passage.put(&mut summary);
    summary.put("throat", throat, "(R0)");
    summary.put("throat_length", throat_length, "(R0)");
    run.finish(&summary)
}

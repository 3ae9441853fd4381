//! An active droplet filled with an active polar gel swims in a periodic box or a channel.
//!
//! `cargo run --release --example active_gel` simulates it, prints what was measured, and writes to `out/active_gel/`
//! what the example `swimming_droplet` writes, with the director and its defects in the pictures, and for ParaView as
//! `vtk/gels.pvd`; `summary.json` also has `defects`, `director_energy` and `polarisation`. `--activity 0
//! --excluded-volume 0 --tension 200 --frank 2 --alignment 0.5 --bulk-activity -200` swims by the gel alone. `--help`
//! lists the flags.

use std::process::ExitCode;

use anyhow::{Context, Result, bail};
use clap::Parser;
use motile::interior::GelInDroplet;
use motile::setup::{GridMethod, Method, Setup};
use motile_examples::{AnyRegionFlags, GelFlags, Preset, RegionKind, SceneFlags};

/// Grid spacing unless another one is given.
const SPACING: f64 = 0.1;

/// An active droplet filled with an active polar gel.
#[derive(Debug, Parser)]
#[command(after_help = "The default run takes 1,641 steps, 3,289 evaluations of the flow.")]
struct Flags {
    #[command(flatten)]
    gel: GelFlags,
    #[command(flatten)]
    scene: SceneFlags<AnyRegionFlags>,
}

fn main() -> ExitCode {
    motile_examples::run(swim)
}

fn swim(Flags { gel: gel_flags, scene: flags }: &Flags) -> Result<()> {
    // The droplet, on a grid, and the gel; the seed is the gel's.
    let base = match flags.method.preset {
        Preset::Accurate => Setup { method: Method::Grid(GridMethod::of_spacing(SPACING)), ..Setup::default() },
        Preset::Thesis => Setup::thesis(),
    };
    let mut droplet = flags.droplet.clone();
    let seed = droplet.seed.take_if(|_| droplet.initial.is_none());
    let mut setup = flags.method.setup(&droplet, Some(base))?;
    if flags.region.region == RegionKind::Plane {
        bail!("a gel needs a grid, which unbounded fluid has not: give --region box --box 20, say");
    }
    flags.region.apply(&mut setup)?;
    gel_flags.apply(&mut setup.droplets[0], seed.or(flags.droplet.seed))?;

    // The run, with all that watches it.
    let mut run = flags.watch(setup.build()?, &setup, "active_gel")?;
    run.go(None)?;

    // The results, also of a run that broke off.
    let mut summary = run.summary()?;
    let (gel, _) = run.scene.system().bodies::<GelInDroplet>().next().context("the scene has no gel")?;
    let seen = run.scene.observe(gel)?;
    summary.put("defects", serde_json::to_value(&seen.defects)?, "of the director, in the end");
    summary.put("director_energy", seen.director_energy, "in the end (force times R0)");
    summary.put("polarisation", seen.polarisation.to_vec(), "mean director");
    run.finish(&summary)
}

//! Gain of several threads, which change no result.
//!
//! `cargo run --release -p studies --features rayon -- threads` times steps of a droplet in a box of 1024 x 1024 cells
//! and between elastic walls of 50,000 points, and of 4 to 144 droplets by integrals, on one thread and on more by
//! turns, and compares the states bit by bit.

use std::time::Instant;

use anyhow::{Context, Result, ensure};
use clap::Args;
use motile::base::Drive;
use motile::base::Region;
use motile::elastic_solids::ChannelShape;
use motile::elastic_solids::Moduli;
use motile::scene::{Hydrodynamics, Scene, integrator::Dynamics as _};
use motile::setup::{DropletSetup, GridMethod, IntegralMethod, LayersMethod, Material, Method, Setup, SolidSetup};
use motile_cli::run::say;

use crate::many;

/// Compares one thread with several.
#[derive(Debug, Args)]
pub(crate) struct Flags {
    /// Threads to compare with one
    #[arg(long, default_value_t = 2, value_parser = clap::value_parser!(u16).range(2..=256))]
    threads: u16,
    /// Steps of each scene
    #[arg(long, default_value_t = 10, value_parser = clap::value_parser!(u16).range(2..))]
    steps: u16,
    /// Smaller scenes: 900 x 900 cells, 32,000 points
    #[arg(long)]
    quick: bool,
}

pub(crate) fn run(flags: &Flags) -> Result<()> {
    ensure!(
        cfg!(feature = "rayon"),
        "motile runs on one thread here: cargo run --release -p studies --features rayon -- threads"
    );
    let (cells, spacing) = if flags.quick { (900.0, 0.04) } else { (1024.0, 0.025) };
    let boxed = Setup {
        region: Region::Box { lengths: [4.0, 4.0] },
        method: Method::Grid(GridMethod::of_spacing(4.0 / cells)),
        droplets: vec![DropletSetup::active(-3.0)],
        ..Setup::default()
    };
    let title = format!("a box of {cells} x {cells} cells");
    turns(flags, &title, || Ok(boxed.build()?.scene))?;
    let shear = Moduli::from_thesis_spring_constant(1e5)?.shear();
    let elastic = Setup {
        region: Region::Channel { length: 12.0, width: 5.0, drive: Drive::ZeroGradient },
        method: Method::Layers(LayersMethod::of_spacing(spacing)),
        droplets: vec![DropletSetup::active(-4.0)],
        solids: SolidSetup::walls(&ChannelShape::Straight { width: 2.0 }, &Material::Springs { shear }),
        ..Setup::default()
    };
    turns(flags, "elastic walls", || Ok(elastic.build()?.scene))?;
    for side in [2, 4, 6, 8, 12] {
        let integral = Method::Integral(IntegralMethod { nodes: 48, elements: 192 });
        let droplets = many::setup(side, integral, false);
        turns(flags, &format!("{} droplets by integrals", side * side), || Ok(droplets.build()?.scene))?;
    }
    Ok(())
}

/// Steps two equal scenes by turns, one on one thread.
fn turns<H: Hydrodynamics>(flags: &Flags, title: &str, build: impl Fn() -> Result<Scene<H>>) -> Result<()> {
    let pools =
        [1, usize::from(flags.threads)].map(|threads| rayon::ThreadPoolBuilder::new().num_threads(threads).build());
    let mut scenes = [build()?, build()?];
    let mut times = [Vec::new(), Vec::new()];
    for _ in 0..flags.steps {
        for ((scene, pool), times) in scenes.iter_mut().zip(&pools).zip(&mut times) {
            let pool = pool.as_ref().ok().context("no threads to be had")?;
            let start = Instant::now();
            pool.install(|| scene.step(1e-3))?;
            times.push(start.elapsed().as_secs_f64());
        }
    }
    let [one, several] = times.map(|mut times| {
        times.sort_by(f64::total_cmp);
        times[times.len() / 2]
    });
    let [first, second] = scenes.map(|scene| {
        let mut state = Vec::new();
        scene.system().write_state(&mut state);
        state
    });
    let equal = first.iter().map(|value| value.to_bits()).eq(second.iter().map(|value| value.to_bits()));
    say(format_args!(
        "{title}, {} numbers of state: a step on {} threads {:.2} times as fast as on one; {}",
        first.len(),
        flags.threads,
        one / several,
        if equal { "bitwise identical" } else { "DIFFERENT" },
    ));
    ensure!(equal, "the state depends on the number of threads");
    Ok(())
}

//! Droplets that exchange their particles with the inside: speed, and two caps instead of one.
//!
//! `cargo run --release -p studies -- exchange` prints a table, which `--write` keeps as `docs/tables/exchange.csv`.

use anyhow::{Context, Result};
use clap::Args;
use motile::motile_base::Region;
use motile::setup::{Built, DropletSetup, ExchangeSetup, Exclusion, IntegralMethod, Method, Particles, Setup, Start};
use motile_examples::positive;
use motile_output::run::say;
use motile_tests::validation::Table;

use crate::tables;

/// Droplets that exchange their particles with the inside.
#[derive(Debug, Args)]
pub(crate) struct Flags {
    /// Time to which they run
    #[arg(long, default_value_t = 60.0, value_parser = positive)]
    time: f64,
    #[command(flatten)]
    keep: tables::Keep,
}

const ACTIVITY: f64 = -4.0;
const BINDING: f64 = 0.2;
const UNBINDING: [f64; 4] = [0.0, 0.2, 0.5, 1.0];
const DIFFUSIONS: [f64; 4] = [0.05, 0.2, 1.0, f64::INFINITY];
/// 2 Sigma R/c0 of a droplet with as viscous an inside, diffusion constant on the interface.
const SCALE: f64 = 4.0;
const DIFFUSION: f64 = 0.1;

fn setup(unbinding: f64, bulk: f64) -> Setup {
    let diffusion_inside = Some(bulk).filter(|bulk| bulk.is_finite());
    let particles = Particles {
        activity: ACTIVITY,
        diffusion: DIFFUSION,
        excluded_volume: Exclusion::Step(-2.0 * ACTIVITY),
        start: Start::Perturbed { amplitude: 0.05, seed: 1 },
        exchange: Some(ExchangeSetup { diffusion_inside, ..ExchangeSetup::new(BINDING, unbinding) }),
        ..Particles::default()
    };
    Setup {
        region: Region::Plane,
        method: Method::Integral(IntegralMethod { nodes: 48, cells: 96 }),
        droplets: vec![DropletSetup { particles: Some(particles), ..DropletSetup::default() }],
        ..Setup::default()
    }
}

/// The activity from which on mode k grows.
fn threshold(k: f64, unbinding: f64, bulk: f64) -> f64 {
    -SCALE / k * (DIFFUSION * k * k + unbinding / (1.0 + BINDING / (k * bulk)))
}

/// Speed, modes 1 and 2 of the concentration over the mean one, number on the interface over that at the start.
fn run_one(setup: &Setup, time: f64) -> Result<[f64; 4]> {
    let Built { mut scene, droplets, .. } = setup.build()?;
    let droplet = *droplets.first().context("no droplet")?;
    let before = scene.observe(droplet)?.particle_number;
    scene.run(time).go()?;
    let seen = scene.observe(droplet)?;
    let modes = &seen.concentration_modes;
    let relative = |k: usize| modes.amplitude(k) / modes.mean;
    Ok([seen.speed(), relative(1), relative(2), seen.particle_number / before])
}

pub(crate) fn run(flags: &Flags) -> Result<()> {
    let columns = ["k_off", "D_b", "threshold 1", "threshold 2", "speed", "mode 1", "mode 2", "number on"];
    let title = format!("Activity {ACTIVITY}, k_on {BINDING}, late");
    let mut table = Table::new(&title, &columns);
    for unbinding in UNBINDING {
        for bulk in DIFFUSIONS.into_iter().filter(|bulk| unbinding > 0.0 || bulk.is_infinite()) {
            let thresholds = [1.0, 2.0].map(|k| format!("{:.3}", threshold(k, unbinding, bulk)));
            let row = [vec![unbinding.to_string(), bulk.to_string()], thresholds.to_vec()].concat();
            let values = match run_one(&setup(unbinding, bulk), flags.time) {
                Ok(values) => values.map(|value| format!("{value:.4}")).to_vec(),
                Err(error) => vec![error.to_string(), String::new(), String::new(), String::new()],
            };
            say(format_args!("{} {}", row.join(" "), values.join(" ")));
            table.push(row.into_iter().chain(values));
        }
    }
    flags.keep.tables("exchange", "exchange", &["crates/interior-fields/src", "studies/src/exchange.rs"], &[table])
}

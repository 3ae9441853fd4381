//! Droplets that exchange their particles with the inside: speed, and two caps instead of one; errors of rates and
//! speed over the resolution.
//!
//! `cargo run --release -p studies -- exchange` prints two tables, which `--write` keeps as `docs/tables/exchange.csv`
//! and `exchange-2.csv`.

use anyhow::{Context, Result};
use motile::base::Region;
use motile::setup::{
    Built, DropletSetup, ExchangeSetup, ExcludedVolume, IntegralMethod, Method, Particles, Setup, Start,
};
use motile_tests::validation::exchange::{Mode, bare_rate, rate, speed};
use motile_tests::validation::{Table, order};

use crate::tables::{self, Measure, Once, all_wanted};

/// Time to which the droplets run.
const TIME: f64 = 60.0;
const ACTIVITY: f64 = -4.0;
const BINDING: f64 = 0.2;
const UNBINDING: [f64; 4] = [0.0, 0.2, 0.5, 1.0];
const DIFFUSIONS: [f64; 4] = [0.05, 0.2, 1.0, f64::INFINITY];
/// 2 Sigma R/c0 of a droplet with as viscous an inside, diffusion constant on the interface.
const SCALE: f64 = 4.0;
const DIFFUSION: f64 = 0.1;

/// Resolutions, diffusion constant inside, and time of the speed of the table of errors.
const NODES: [usize; 4] = [16, 24, 32, 48];
const FINEST: usize = 128;
const BULK: f64 = 0.3;
const LATE: f64 = 4.0;

fn setup(unbinding: f64, bulk: f64) -> Setup {
    let diffusion_inside = Some(bulk).filter(|bulk| bulk.is_finite());
    let particles = Particles {
        activity: ACTIVITY,
        diffusion: DIFFUSION,
        excluded_volume: ExcludedVolume::Step(-2.0 * ACTIVITY),
        start: Start::Perturbed { amplitude: 0.05, seed: 1 },
        exchange: Some(ExchangeSetup { diffusion_inside, ..ExchangeSetup::new(BINDING, unbinding) }),
        ..Particles::default()
    };
    Setup {
        region: Region::Plane,
        method: Method::Integral(IntegralMethod { nodes: 48, elements: 96 }),
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

pub(crate) fn run(keep: tables::Keep) -> Result<()> {
    let columns = "k_off | D_b | threshold 1 | threshold 2 | speed | mode 1 | mode 2 | number on";
    let title = format!("Activity {ACTIVITY}, k_on {BINDING}, late");
    let mut table = Table::new(&title, columns);
    for unbinding in UNBINDING {
        for bulk in DIFFUSIONS.into_iter().filter(|bulk| unbinding > 0.0 || bulk.is_infinite()) {
            let [first, second] = [1.0, 2.0].map(|k| threshold(k, unbinding, bulk));
            table.measure(format_args!("{unbinding} | {bulk} | {first:.3} | {second:.3}"), || {
                Ok(match run_one(&setup(unbinding, bulk), TIME) {
                    Ok(values) => values.map(|value| format!("{value:.4}")).join(" | "),
                    Err(error) => format!("{error} |  |  | "),
                })
            })?;
        }
    }
    keep.tables("exchange", "exchange", &[table, errors()?])
}

/// The spacing of the field inside that goes with so many nodes (R0).
fn spacing(nodes: usize) -> f64 {
    3.84 / nodes as f64
}

/// Relative errors of rates of mode 1 and of a speed, with a field inside, over the nodes.
fn errors() -> Result<Table> {
    let columns = "nodes | elements | spacing | growing mode | decaying mode | speed";
    let title = format!(
        "Relative errors with a field inside, D_b {BULK}: rates of mode 1 at activity -8 and 0; speed at activity -4, \
         t = {LATE}, from that of {FINEST} nodes"
    );
    let finest = Once::new();
    let mut table = Table::new(&title, columns);
    for nodes in NODES {
        let (cells, spacing) = (2 * nodes, spacing(nodes));
        table.measure(format_args!("{nodes} | {cells} | {spacing:.3}"), || {
            let [grows, decays] = [-8.0, 0.0].map(|activity| -> Result<f64> {
                let mode = Mode::find(1.0, BULK, bare_rate(1.0, activity));
                Ok((rate(mode, activity, cells, spacing)? / mode.rate() - 1.0).abs())
            });
            let finest = finest.get(|| speed(BULK, 2 * FINEST, self::spacing(FINEST), LATE))?;
            let values = [grows?, decays?, (speed(BULK, cells, spacing, LATE)? / finest - 1.0).abs()];
            Ok(values.map(|value| format!("{value:.1e}")).join(" | "))
        })?;
    }
    if all_wanted() {
        let orders = [3, 4, 5].map(|column| {
            let errors: Vec<f64> = table.rows().iter().filter_map(|row| row.get(column)?.parse().ok()).collect();
            format!("{:.2}", order(&NODES.map(spacing), &errors))
        });
        table.push(["order".to_owned(), String::new(), String::new()].into_iter().chain(orders));
    }
    Ok(table)
}

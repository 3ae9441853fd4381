//! Droplets that swim by a gel alone.
//!
//! `cargo run --release -p studies -- gel` lets passive droplets with gels swim to their steady speeds at several
//! spacings of the grid; `--write` keeps the table as `docs/tables/gel.csv`.

use anyhow::{Context, Result};
use motile::base::Vec2;
use motile::interior::{DirectorStart, GelInDroplet, GelMaterial};
use motile::setup::{Built, DropletSetup, GelSetup, GridMethod, Method, Setup};
use motile_tests::validation::Table;

use crate::tables::{self, Measure};

/// Tension of the interface (force).
const TENSION: f64 = 200.0;
/// End of the runs, over which the speeds have come to rest.
const END: f64 = 80.0;
/// Alignment and activity of the gels.
const GELS: [[f64; 2]; 5] = [[0.5, -50.0], [0.5, -100.0], [0.5, -200.0], [0.5, -300.0], [-0.5, 200.0]];

pub(crate) fn run(keep: tables::Keep) -> Result<()> {
    let columns = "nu1 | zeta_b | h | speed | aspect ratio | polarisation | defects | steps per time";
    let title = format!("Passive droplets with a free gel, K = 2, tension 200, at t = {END}");
    let mut swimmers = Table::new(&title, columns);
    for [alignment, activity] in GELS {
        for spacing in [0.2, 0.15, 0.1] {
            swimmers.measure(format_args!("{alignment} | {activity} | {spacing}"), || {
                swimmer(alignment, activity, spacing)
            })?;
        }
    }
    keep.tables("gel", "gel", &[swimmers])
}

fn setup(alignment: f64, activity: f64, spacing: f64) -> Setup {
    let material = GelMaterial { frank: 2.0, alignment, activity, ..GelMaterial::default() };
    let start = DirectorStart::Uniform { angle: 0.0, noise: 0.5, seed: 1 };
    let gel = Some(GelSetup { material, start, ..GelSetup::default() });
    Setup {
        method: Method::Grid(GridMethod::of_spacing(spacing)),
        droplets: vec![DropletSetup { gel, ..DropletSetup::passive(TENSION) }],
        ..Setup::default()
    }
}

fn swimmer(alignment: f64, activity: f64, spacing: f64) -> Result<String> {
    let Built { mut scene, droplets, .. } = setup(alignment, activity, spacing).build()?;
    scene.run(END).go()?;
    let droplet = scene.observe(droplets[0])?;
    let (gel, _) = scene.system().bodies::<GelInDroplet>().next().context("no gel")?;
    let seen = scene.observe(gel)?;
    let (speed, aspect_ratio, defects) = (droplet.speed(), droplet.aspect_ratio_moments, seen.defects.len());
    let (polarisation, steps) = (Vec2::from(seen.polarisation).length(), scene.steps() as f64 / END);
    Ok(format!("{speed:.4} | {aspect_ratio:.3} | {polarisation:.3} | {defects} | {steps:.1}"))
}

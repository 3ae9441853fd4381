//! Droplets that swim by a gel alone, and where the time of their steps goes.
//!
//! `cargo run --release -p studies -- gel` lets passive droplets with gels swim to their steady speeds at several
//! spacings of the grid, and times the parts of an evaluation one after another on the state of a running scene, the
//! median of many; `--write` keeps both as `docs/tables/gel.csv` and `gel-2.csv`. Some 5 minutes; `--quick` runs the
//! coarsest grid alone.

use std::time::Instant;

use anyhow::{Context, Result};
use clap::Args;
use motile::base::Vec2;
use motile::interior::{DirectorStart, GelInDroplet, GelMaterial};
use motile::scene::{Body, Hydrodynamics, InteriorBody};
use motile::setup::{Built, DropletSetup, GelSetup, GridMethod, Method, Setup};
use motile_tests::validation::Table;

use crate::tables;

/// Tension of the interface (force).
const TENSION: f64 = 200.0;
/// End of the runs, over which the speeds have come to rest.
const END: f64 = 80.0;
/// Repetitions of what is timed.
const REPETITIONS: usize = 200;
/// Alignment and activity of the gels.
const GELS: [[f64; 2]; 5] = [[0.5, -50.0], [0.5, -100.0], [0.5, -200.0], [0.5, -300.0], [-0.5, 200.0]];

/// Swimmers by a gel alone, and the cost of their steps.
#[derive(Debug, Args)]
pub(crate) struct Flags {
    /// Run the coarsest grid alone
    #[arg(long)]
    quick: bool,
    #[command(flatten)]
    keep: tables::Keep,
}

pub(crate) fn run(flags: &Flags) -> Result<()> {
    let spacings = if flags.quick { &[0.2][..] } else { &[0.2, 0.15, 0.1] };
    let columns = ["nu1", "zeta_b", "h", "speed", "aspect ratio", "polarisation", "defects", "steps per time"];
    let mut swimmers = Table::new("Passive droplets with a free gel, K = 2, tension 200, at t = 80", &columns);
    for [alignment, activity] in GELS {
        for &spacing in spacings {
            swimmers.push(swimmer(alignment, activity, spacing)?);
        }
    }
    let mut cost = Table::new("Time of the parts of an evaluation with a gel, one core (ms)", &["h", "part", "ms"]);
    for &spacing in spacings {
        for (part, time) in parts(spacing)? {
            cost.push([spacing.to_string(), part.to_owned(), format!("{time:.3}")]);
        }
    }
    flags.keep.tables("gel", "gel", &["crates/motile-interior", "studies/src/gel.rs"], &[swimmers, cost])
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

fn swimmer(alignment: f64, activity: f64, spacing: f64) -> Result<[String; 8]> {
    let Built { mut scene, droplets, .. } = setup(alignment, activity, spacing).build()?;
    scene.run(END).go()?;
    let droplet = scene.observe(droplets[0])?;
    let (gel, _) = scene.system().bodies::<GelInDroplet>().next().context("no gel")?;
    let seen = scene.observe(gel)?;
    Ok([
        alignment.to_string(),
        activity.to_string(),
        spacing.to_string(),
        format!("{:.4}", droplet.speed()),
        format!("{:.3}", droplet.aspect_ratio_moments),
        format!("{:.3}", Vec2::from(seen.polarisation).length()),
        seen.defects.len().to_string(),
        format!("{:.1}", scene.steps() as f64 / END),
    ])
}

/// Median times (ms).
fn parts(spacing: f64) -> Result<Vec<(&'static str, f64)>> {
    let Built { mut scene, droplets, .. } = setup(0.5, -200.0, spacing).build()?;
    (0..10).try_for_each(|_| scene.step(1e-3))?;
    let (handle, gel) = scene.system().bodies::<GelInDroplet>().next().context("no gel")?;
    let (mut gel, droplet) = (gel.clone(), scene.body(droplets[0])?.clone());
    let view = scene.system().hydrodynamics().fluid_view();
    let mut forces = vec![Vec2::ZERO; gel.marker_count()];
    let mut rate = vec![0.0; gel.state_len()];
    let here = scene.system_mut().evaluate()?;
    let [host, inner] = [droplets[0].index(), handle.index()].map(|group| here.groups()[group].range.clone());
    let (outer, velocities) = (here.velocities()[host].to_vec(), here.velocities()[inner].to_vec());
    let mut times = vec![
        (
            "mesh and elements",
            median(|| {
                gel.update_host(&droplet);
                Ok(())
            })?,
        ),
        ("gel's forces", median(|| Ok(gel.write_forces(&view, &mut forces)?))?),
    ];
    let rates = median(|| {
        gel.host_moved(&droplet, &outer);
        gel.rate(&velocities, &mut rate);
        Ok(())
    })?;
    times.push(("gel's rate", rates));
    times.push(("whole step of two evaluations", median(|| Ok(scene.step(1e-4)?))?));
    let mut without = setup(0.5, -200.0, spacing);
    without.droplets[0].gel = None;
    let mut scene = without.build()?.scene;
    times.push(("the same without the gel", median(|| Ok(scene.step(1e-4)?))?));
    Ok(times)
}

fn median(mut work: impl FnMut() -> Result<()>) -> Result<f64> {
    let mut times = Vec::with_capacity(REPETITIONS);
    for _ in 0..REPETITIONS {
        let start = Instant::now();
        work()?;
        times.push(start.elapsed().as_secs_f64() * 1e3);
    }
    times.sort_by(f64::total_cmp);
    Ok(times[REPETITIONS / 2])
}

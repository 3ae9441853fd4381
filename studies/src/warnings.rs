//! Whether runs warn of their errors: scenes at default settings against resolved ones.
//!
//! `cargo run --release -p studies -- warnings` prints a table, which `--write` keeps as
//! `docs/tables/warnings.csv`.

use anyhow::{Context, Result};
use clap::Args;
use motile::motile_base::Drive;
use motile::motile_base::Region;
use motile::motile_scene::{Every, Warnings};
use motile::setup::{Built, DropletSetup, GridMethod, IntegralMethod, Method, Setup};
use motile_examples::positive;
use motile_tests::validation::Table;

use crate::tables;

/// Whether runs warn of their errors.
#[derive(Debug, Args)]
pub(crate) struct Flags {
    /// Time to which the scenes are run
    #[arg(long, default_value_t = 8.0, value_parser = positive)]
    time: f64,
    /// Number of scenes, from the first on
    #[arg(long, default_value_t = SCENES.len())]
    scenes: usize,
    #[command(flatten)]
    keep: tables::Keep,
}

/// Length and width of a channel or none for a box of 6 x 6, activity, viscosities inside and outside, grid spacing or
/// none for boundary integrals.
type Scene = (Option<[f64; 2]>, f64, [f64; 2], Option<f64>);

const EQUAL: [f64; 2] = [100.0; 2];

const SCENES: [Scene; 20] = [
    (None, -1.0, EQUAL, None),
    (None, -4.0, EQUAL, Some(0.05)),
    (None, -6.0, [300.0, 1.0], None),
    (None, -9.0, EQUAL, None),
    (None, -9.0, EQUAL, Some(0.05)),
    (None, -4.0, [5.0, 100.0], Some(0.05)),
    (None, -4.0, [300.0, 30.0], Some(0.05)),
    (None, -4.0, EQUAL, Some(0.1)),
    (Some([6.0, 2.0]), -4.0, EQUAL, None),
    (Some([6.0, 2.0]), -4.0, EQUAL, Some(0.05)),
    (Some([6.0, 2.2]), -2.0, EQUAL, Some(0.05)),
    (Some([6.0, 2.2]), -6.0, EQUAL, None),
    (Some([6.0, 2.2]), -6.0, EQUAL, Some(0.05)),
    (Some([6.0, 2.2]), -8.0, [1000.0, 100.0], Some(0.1)),
    (Some([5.0, 3.0]), -6.0, EQUAL, None),
    (Some([6.0, 3.0]), -2.0, EQUAL, Some(0.1)),
    (Some([6.0, 3.0]), -6.0, EQUAL, Some(0.05)),
    (Some([36.0, 3.0]), -4.0, EQUAL, None),
    (Some([6.0, 5.0]), -8.0, EQUAL, None),
    (Some([6.0, 5.0]), -8.0, [5.0, 100.0], Some(0.1)),
];

/// The nodes and markers of resolved runs.
const RESOLVED: Method = Method::Integral(IntegralMethod { nodes: 112, cells: 448 });

fn setup(&(channel, activity, [inside, outside], spacing): &Scene) -> Setup {
    let region = channel.map_or(Region::Box { lengths: [6.0; 2] }, |[length, width]| Region::Channel {
        length,
        width,
        drive: Drive::ZeroGradient,
    });
    let viscosity = (inside != outside).then_some(inside);
    Setup {
        region,
        method: spacing.map_or(Method::default(), |spacing| Method::Grid(GridMethod::of_spacing(spacing))),
        viscosity: outside,
        droplets: vec![DropletSetup { viscosity, ..DropletSetup::active(activity) }],
        ..Setup::default()
    }
}

/// The speed in the end, and the causes of the warnings on the way.
fn speed(setup: &Setup, time: f64) -> Result<(f64, Vec<String>)> {
    let Built { mut scene, droplets, .. } = setup.build()?;
    let mut warnings = Warnings::default();
    scene.run(time).observe(Every::Steps(1), &mut warnings).go()?;
    let droplet = *droplets.first().context("no droplet")?;
    let causes = warnings.worst().iter().map(|(_, warning)| warning.cause.to_string()).collect();
    Ok((scene.observe(droplet)?.velocity.length(), causes))
}

pub(crate) fn run(flags: &Flags) -> Result<()> {
    let columns = ["region", "activity", "viscosities", "method", "speed", "error", "warned of"];
    let mut table = Table::new("Warnings of scenes at default settings, and the errors of their speeds", &columns);
    for scene in SCENES.iter().take(flags.scenes) {
        let (channel, activity, [inside, outside], spacing) = scene;
        let setup = setup(scene);
        let (exact, _) = speed(&Setup { method: RESOLVED, ..setup.clone() }, flags.time)?;
        let (found, causes) = match speed(&setup, flags.time) {
            Ok((speed, causes)) => (speed, causes.join(", ")),
            Err(error) => (f64::NAN, error.to_string()),
        };
        let region = channel.map_or("box".to_owned(), |[length, width]| format!("channel {length} x {width}"));
        let method = spacing.map_or("integrals".to_owned(), |spacing| format!("grid {spacing}"));
        let error = format!("{:+.2} %", 100.0 * (found / exact - 1.0));
        let scene = [region, activity.to_string(), format!("{inside}/{outside}"), method];
        table.push(scene.into_iter().chain([format!("{found:.5}"), error, causes]));
    }
    flags.keep.tables("warnings", "warnings", &["studies/src/warnings.rs"], &[table])
}

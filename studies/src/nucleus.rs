//! Droplets with a rigid nucleus: whether they swim in circles.
//!
//! `cargo run --release -p studies -- nucleus` prints a table, which `--write` keeps as `docs/tables/nucleus.csv`.

use anyhow::{Context, Result};
use clap::Args;
use motile::active_interface::trajectory::TrajectoryRecorder;
use motile::ib_core::{Every, Vec2};
use motile::{Built, DropletSetup, IntegralMethod, Method, Region, RepulsionSetup, RigidBodySetup, Setup};
use motile_examples::{positive, say, turning_rate};
use motile_tests::validation::Table;

use crate::tables;

/// Whether droplets with a nucleus swim in circles.
#[derive(Debug, Args)]
pub(crate) struct Flags {
    /// Time to which they swim
    #[arg(long, default_value_t = 40.0, value_parser = positive)]
    time: f64,
    /// Write the table to docs/tables, with the commit and what it depends on
    #[arg(long)]
    write: bool,
}

/// Whether in a box of 6 x 6 or in the plane, activity, radius and place of the nucleus.
type Scene = (bool, f64, f64, [f64; 2]);

const ASIDE: [f64; 2] = [0.05, 0.15];

const SCENES: [Scene; 12] = [
    (false, -1.0, 0.3, [0.0, 0.0]),
    (false, -1.0, 0.3, ASIDE),
    (false, -1.0, 0.5, ASIDE),
    (false, -1.0, 0.5, [-0.3, 0.25]),
    (false, -1.0, 0.7, ASIDE),
    (false, -2.0, 0.3, ASIDE),
    (false, -2.0, 0.5, [0.0, 0.0]),
    (false, -2.0, 0.5, ASIDE),
    (false, -2.0, 0.7, ASIDE),
    (true, -1.0, 0.5, ASIDE),
    (true, -2.0, 0.5, ASIDE),
    (true, -2.0, 0.7, ASIDE),
];

fn setup(&(boxed, activity, radius, centre): &Scene) -> Setup {
    Setup {
        region: if boxed { Region::Box { lengths: [6.0; 2] } } else { Region::Plane },
        method: Method::Integral(IntegralMethod { nodes: 48, cells: 192 }),
        repulsion: Some(RepulsionSetup { strength: 500.0, range: 0.1 }),
        droplets: vec![DropletSetup::active(activity)],
        rigid_bodies: vec![RigidBodySetup { centre, ..RigidBodySetup::disc(radius) }],
        ..Setup::default()
    }
}

/// Time, speed, turning rate, distance of the nucleus from the centroid and from the axis of motion, its angular
/// velocity, the least gap.
fn run_one(setup: &Setup, time: f64) -> Result<[f64; 7]> {
    let Built { mut scene, droplets, rigid_bodies, .. } = setup.build()?;
    let (droplet, core) = (*droplets.first().context("no droplet")?, *rigid_bodies.first().context("no nucleus")?);
    let mut recorder = TrajectoryRecorder::new(droplet);
    scene.run(time).observe(Every::StepAfter(time / 400.0), &mut recorder).go()?;
    let seen = scene.observe(droplet)?;
    let nucleus = scene.observe(core)?;
    let offset = nucleus.centre - seen.centroid;
    let aside = seen.velocity.normalize_or(Vec2::X).perp_dot(offset);
    let turning = turning_rate(recorder.records()).context("too few steps")?;
    let gap = scene.system().minimum_gap().unwrap_or(f64::NAN);
    Ok([scene.time(), seen.speed(), turning, offset.length(), aside, nucleus.spin, gap])
}

pub(crate) fn run(flags: &Flags) -> Result<()> {
    let columns = [
        "region",
        "activity",
        "radius",
        "start",
        "speed",
        "turning rate",
        "track radius",
        "offset",
        "aside",
        "spin",
        "least gap",
    ];
    let mut table = Table::new("Droplets with a rigid nucleus, late", &columns);
    for scene in &SCENES {
        let (boxed, activity, radius, [x, y]) = scene;
        let region = if *boxed { "box" } else { "plane" };
        let row = [region.to_owned(), activity.to_string(), radius.to_string(), format!("{x}, {y}")];
        let values = match run_one(&setup(scene), flags.time) {
            Ok([_, speed, turning, offset, aside, spin, gap]) => {
                let radius = speed / turning.abs();
                let signed = |value: f64| format!("{value:+.1e}");
                let track = if radius < 1e4 { format!("{radius:.3}") } else { "straight".to_owned() };
                vec![
                    format!("{speed:.5}"),
                    signed(turning),
                    track,
                    format!("{offset:.4}"),
                    signed(aside),
                    signed(spin),
                    format!("{gap:.3}"),
                ]
            }
            Err(error) => {
                let mut values = vec![String::new(); columns.len() - row.len()];
                values[0] = error.to_string();
                values
            }
        };
        say(format_args!("{} {}", row.join(" "), values.join(" ")));
        table.push(row.into_iter().chain(values));
    }
    say(&table);
    if flags.write {
        let code = [&tables::RUNS[..7], &["studies/src/nucleus.rs", "examples/src/turning.rs"]].concat();
        tables::write("nucleus", "nucleus --write", &code, &[table])?;
    }
    Ok(())
}

//! Droplets that meet: pairs over their resolution, and suspensions over activity, fraction and ratio of viscosities.
//!
//! `cargo run --release -p studies -- suspensions` prints two tables, which `--write` keeps as
//! `docs/tables/suspensions.csv` and `suspensions-2.csv`. The first one is of two droplets in the plane that swim
//! towards each other or side by side, without a repulsion and with the one that nodes resolve: their film over time
//! and by how much the first one is turned. The second one is of random suspensions in a box.

use std::f64::consts::{PI, TAU};

use anyhow::{Context, Result};
use clap::Args;
use motile::active_interface::suspension::{Member, rotational_diffusion};
use motile::motile_base::Region;
use motile::motile_scene::{Every, gap::Repulsion};
use motile::setup::{Built, Distribution, DropletSetup, IntegralMethod, Method, Setup, SuspensionSetup};
use motile_output::SuspensionCsv;
use motile_output::run::say;
use motile_tests::validation::Table;

use crate::tables;

/// Droplets that meet, in pairs and in suspensions.
#[derive(Debug, Args)]
pub(crate) struct Flags {
    /// Droplets of a suspension
    #[arg(long, default_value_t = 16)]
    count: usize,
    /// Time that suspensions are followed
    #[arg(long, default_value_t = 20.0)]
    time: f64,
    /// Pairs alone
    #[arg(long)]
    pairs: bool,
    #[command(flatten)]
    keep: tables::Keep,
}

/// Nodes of the droplets of pairs and of suspensions, and cells for each node.
const NODES: [usize; 2] = [48, 96];
const FEWER: usize = 48;
const CELLS: usize = 4;
/// Activity of pairs, and the capillary pressure that their films are held against (force per length).
const ACTIVITY: f64 = -2.0;
/// Names of the meetings, places of the two droplets (R0) and whether the second one swims back.
const MEETINGS: [(&str, [[f64; 2]; 2], bool); 3] = [
    ("head-on", [[-1.8, 0.0], [1.8, 0.0]], true),
    ("offset 1", [[-1.8, -0.5], [1.8, 0.5]], true),
    ("side by side", [[0.0, -1.2], [0.0, 1.2]], false),
];
/// Times at which films are told.
const TIMES: [f64; 4] = [2.0, 5.0, 10.0, 20.0];
/// Suspensions: parts of the area, activities, viscosities inside over that outside.
const FRACTIONS: [f64; 2] = [0.2, 0.5];
const ACTIVITIES: [f64; 2] = [-2.0, -3.0];
const RATIOS: [f64; 2] = [1.0, 10.0];
/// Rows of the tables of a suspension, and the gap of droplets in contact (R0).
const ROWS: f64 = 100.0;
const CONTACT: f64 = 0.2;
/// Accuracy of the flow.
const TOLERANCE: f64 = 1e-6;

/// The repulsion that nodes resolve: it holds a film as thick as their distance against the capillary pressure.
fn held(nodes: usize, activity: f64) -> Result<Repulsion> {
    let droplet = DropletSetup::active(activity);
    let concentration = droplet.particles.map_or(0.0, |particles| particles.concentration);
    Ok(Repulsion::holding(TAU / nodes as f64, droplet.tension - activity * concentration)?)
}

pub(crate) fn run(flags: &Flags) -> Result<()> {
    let mut pairs = Table::new(
        "two droplets that meet",
        &[
            "meeting",
            "nodes",
            "repulsion",
            "film at 2",
            "at 5",
            "at 10",
            "at 20",
            "least film",
            "turned by",
            "steps",
            "end",
        ],
    );
    for (name, places, back) in MEETINGS {
        for (nodes, repulsion) in NODES.into_iter().flat_map(|nodes| [(nodes, false), (nodes, true)]) {
            let row = pair((name, places, back), nodes, repulsion)?;
            say(row.join("  "));
            pairs.push(row);
        }
    }
    let mut all = vec![pairs];
    if !flags.pairs {
        all.push(suspensions(flags)?);
    }
    let inputs = ["crates/motile-output/src/suspension.rs", "studies/src/suspensions.rs"];
    flags.keep.tables("suspensions", "suspensions", &inputs, &all)
}

/// A row of the table of pairs.
fn pair((name, places, back): (&str, [[f64; 2]; 2], bool), nodes: usize, repulsion: bool) -> Result<Vec<String>> {
    let angles = [0.0, if back { PI } else { 0.0 }];
    let droplets = places.into_iter().zip(angles);
    let setup = Setup {
        region: Region::Plane,
        method: Method::Integral(IntegralMethod { nodes, cells: CELLS * nodes }),
        repulsion: if repulsion { Some(held(nodes, ACTIVITY)?) } else { None },
        droplets: droplets
            .map(|(centre, angle)| DropletSetup { centre, angle, ..DropletSetup::active(ACTIVITY) })
            .collect(),
        ..Setup::default()
    };
    let Built { mut scene, droplets, .. } = setup.build()?;
    let (mut films, mut end) = (Vec::new(), "at 20".to_owned());
    for time in TIMES {
        if let Err(error) = scene.run(time).go() {
            say(format!("{name}, {nodes} nodes: {error}"));
            end = format!("at {:.1}", scene.time());
            break;
        }
        films.push(scene.system().gap(droplets[0], droplets[1])?.context("no gap")?);
    }
    let seen = Member::all(scene.system_mut())?;
    let turned = seen.first().map_or(f64::NAN, |first| first.velocity.y.atan2(first.velocity.x).to_degrees());
    let film = |k: usize| films.get(k).map_or_else(String::new, |film| format!("{film:.4}"));
    let least = scene.system().minimum_gap().unwrap_or(f64::NAN);
    Ok(vec![
        name.to_owned(),
        nodes.to_string(),
        if repulsion { "on" } else { "off" }.to_owned(),
        film(0),
        film(1),
        film(2),
        film(3),
        format!("{least:.4}"),
        format!("{turned:.1}"),
        scene.steps().to_string(),
        end,
    ])
}

/// The table of suspensions.
fn suspensions(flags: &Flags) -> Result<Table> {
    let columns = [
        "fraction",
        "activity",
        "ratio",
        "polar order",
        "nematic order",
        "contacts a droplet",
        "largest cluster",
        "square displacement",
        "rotational diffusion",
        "least film",
        "film held",
        "area change",
        "steps",
        "end",
    ];
    let mut table = Table::new("random suspensions", &columns);
    let ways = FRACTIONS.into_iter().flat_map(|fraction| ACTIVITIES.map(|activity| (fraction, activity)));
    for ((fraction, activity), ratio) in ways.flat_map(|way| RATIOS.map(|ratio| (way, ratio))) {
        let row = suspension(flags, fraction, activity, ratio)?;
        say(row.join("  "));
        table.push(row);
    }
    Ok(table)
}

/// A row of the table of suspensions: means over the second half of the run.
fn suspension(flags: &Flags, fraction: f64, activity: f64, ratio: f64) -> Result<Vec<String>> {
    let viscosity = Setup::default().viscosity;
    let suspension = SuspensionSetup {
        count: Some(flags.count),
        activity: Some(Distribution::Value(activity)),
        viscosity: Some(Distribution::Value(ratio * viscosity)),
        ..SuspensionSetup::default()
    };
    let side = (flags.count as f64 * suspension.mean_area() / fraction).sqrt();
    let setup = Setup {
        region: Region::Box { lengths: [side; 2] },
        method: Method::Integral(IntegralMethod { nodes: FEWER, cells: CELLS * FEWER }),
        tolerance: Some(TOLERANCE),
        repulsion: Some(held(FEWER, activity)?),
        droplets: Vec::new(),
        suspension: vec![suspension],
        ..Setup::default()
    };
    let Built { mut scene, .. } = setup.build()?;
    let directory = std::env::temp_dir().join(format!("suspensions-{}", std::process::id()));
    std::fs::create_dir_all(&directory)?;
    let mut tables = SuspensionCsv::create(&directory, scene.system_mut(), CONTACT)?;
    let end = match scene.run(flags.time).observe(Every::StepAfter(flags.time / ROWS), &mut tables).go() {
        Ok(()) => "finished".to_owned(),
        Err(error) => {
            say(error);
            format!("at {:.1}", scene.time())
        }
    };
    let half = 0.5 * scene.time();
    let mean = |column: &str| -> Result<f64> {
        let curve = tables.table().curve("time", column)?;
        let late: Vec<f64> =
            curve.into_iter().filter(|row| row.0 >= half && row.1.is_finite()).map(|row| row.1).collect();
        Ok(late.iter().sum::<f64>() / late.len() as f64)
    };
    let diffusion = tables.diffusion(half);
    let interval = diffusion.get(1).map_or(0.0, |row| row[0]);
    let correlation: Vec<f64> = diffusion.iter().map(|row| row[2]).collect();
    let changes = tables.table().curve("time", "area_change")?;
    let row = vec![
        fraction.to_string(),
        activity.to_string(),
        ratio.to_string(),
        format!("{:.2}", mean("polar_order")?),
        format!("{:.2}", mean("nematic_order")?),
        format!("{:.2}", 2.0 * mean("contacts")? / flags.count as f64),
        format!("{:.1}", mean("largest_cluster")?),
        format!("{:.2}", tables.last("square_displacement").unwrap_or(f64::NAN)),
        rotational_diffusion(&correlation, interval).map_or_else(String::new, |rate| format!("{rate:.3}")),
        format!("{:.3}", scene.system().minimum_gap().unwrap_or(f64::NAN)),
        format!("{:.3}", mean("film")?),
        format!("{:.0e}", changes.iter().map(|row| row.1).fold(0.0, f64::max)),
        scene.steps().to_string(),
        end,
    ];
    std::fs::remove_dir_all(&directory)?;
    Ok(row)
}

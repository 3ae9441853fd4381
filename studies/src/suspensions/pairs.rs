//! Two droplets in the plane that swim towards each other or side by side, without a repulsion and with the one that
//! nodes resolve: their film over time and by how much they are turned.

use std::f64::consts::PI;

use anyhow::{Context, Result};
use motile::analysis::suspension::Member;
use motile::base::Region;
use motile::setup::{Built, DropletSetup, Setup};
use motile_cli::run::say;
use motile_tests::validation::Table;

use super::{held, integral};
use crate::tables::Measure;

const NODES: [usize; 3] = [48, 96, 192];
const ACTIVITY: f64 = -2.0;
/// Names of the meetings, places of the two droplets (R0) and whether the second one swims back.
const MEETINGS: [(&str, [[f64; 2]; 2], bool); 3] = [
    ("head-on", [[-1.8, 0.0], [1.8, 0.0]], true),
    ("offset 1", [[-1.8, -0.5], [1.8, 0.5]], true),
    ("side by side", [[0.0, -1.2], [0.0, 1.2]], false),
];
/// Times at which films are told.
const TIMES: [f64; 4] = [2.0, 5.0, 10.0, 20.0];
/// Part of the speed at the first of these times below which a droplet stands still, so that it has no direction.
const MOVING: f64 = 0.2;

pub(super) fn table() -> Result<Table> {
    let mut table = Table::new(
        "two droplets that meet",
        "meeting | nodes | repulsion | film at 2 | at 5 | at 10 | at 20 | least film | turned by | steps | end",
    );
    for meeting in MEETINGS {
        for (nodes, repulsion) in NODES.into_iter().flat_map(|nodes| [(nodes, false), (nodes, true)]) {
            let on = if repulsion { "on" } else { "off" };
            table.measure(format_args!("{} | {nodes} | {on}", meeting.0), || pair(meeting, nodes, repulsion))?;
        }
    }
    Ok(table)
}

fn pair((name, places, back): (&str, [[f64; 2]; 2], bool), nodes: usize, repulsion: bool) -> Result<String> {
    let angles = [0.0, if back { PI } else { 0.0 }];
    let droplets = places.into_iter().zip(angles);
    let setup = Setup {
        region: Region::Plane,
        method: integral(nodes),
        repulsion: if repulsion { Some(held(nodes, ACTIVITY)?) } else { None },
        droplets: droplets
            .map(|(centre, angle)| DropletSetup { centre, angle, ..DropletSetup::active(ACTIVITY) })
            .collect(),
        ..Setup::default()
    };
    let Built { mut scene, droplets, .. } = setup.build()?;
    let (mut films, mut velocities, mut end) = (Vec::new(), Vec::new(), "at 20".to_owned());
    for time in TIMES {
        if let Err(error) = scene.run(time).go() {
            say(format!("{name}, {nodes} nodes: {error}"));
            end = format!("at {:.1}", scene.time());
            break;
        }
        films.push(scene.system().gap(droplets[0], droplets[1])?.context("no gap")?);
        velocities.extend(Member::all(scene.system_mut())?.first().map(|first| first.velocity));
    }
    let turned = match velocities[..] {
        [first, .., last] if films.len() == TIMES.len() && last.length() > MOVING * first.length() => {
            format!("{:.1}", first.angle_to(last).to_degrees())
        }
        _ => String::new(),
    };
    let film = |k: usize| films.get(k).map_or_else(String::new, |film| format!("{film:.4}"));
    let least = scene.system().minimum_gap().unwrap_or(f64::NAN);
    let (films, steps) = ([0, 1, 2, 3].map(film).join(" | "), scene.steps());
    Ok(format!("{films} | {least:.4} | {turned} | {steps} | {end}"))
}

//! When the trajectories of a hundred droplets part that are computed with more nodes, or to a smaller tolerance.

use anyhow::{Context, Result};
use motile::active_interface::suspension::Member;
use motile::motile_base::Vec2;
use motile::setup::{Built, Setup};
use motile_tests::validation::Table;

use super::{Rows, integral, suspension};

const COUNT: usize = 100;
const FRACTION: f64 = 0.3;
const ACTIVITY: f64 = -2.0;
const NODES: usize = 64;
/// Settings that are compared with [`NODES`] nodes at the usual tolerance, all with the same repulsion.
const OTHERS: [(&str, usize, f64); 2] = [("96 nodes", 96, 1e-6), ("tolerance 1e-9", NODES, 1e-9)];
const TIMES: [f64; 5] = [1.0, 2.0, 5.0, 10.0, 20.0];

pub(super) fn table(rows: &mut Rows) -> Result<Table> {
    let at: Vec<String> = TIMES.iter().map(|time| format!("at {time}")).collect();
    let columns: Vec<&str> = ["against", "steps"].into_iter().chain(at.iter().map(String::as_str)).collect();
    let mut table = Table::new("largest distance of a droplet from where it is with 64 nodes at 1e-6", &columns);
    for (name, nodes, tolerance) in OTHERS {
        table.push(rows.row(&format!("parting {name}"), || {
            let usual = suspension(COUNT, FRACTION, ACTIVITY, 1.0, NODES)?;
            let other = Setup { method: integral(nodes), tolerance: Some(tolerance), ..usual.clone() };
            let [(usual, _), (other, steps)] = [way(&usual)?, way(&other)?];
            let apart = usual.iter().zip(&other).map(|(a, b)| {
                let largest = a.iter().zip(b).map(|(a, b)| a.distance(*b)).fold(0.0, f64::max);
                format!("{largest:.1e}")
            });
            Ok([name.to_owned(), steps.to_string()].into_iter().chain(apart).collect())
        })?);
    }
    Ok(table)
}

/// Centroids at all times, and the number of steps.
fn way(setup: &Setup) -> Result<(Vec<Vec<Vec2>>, usize)> {
    let Built { mut scene, .. } = setup.build()?;
    let mut places = Vec::new();
    for time in TIMES {
        scene.run(time).go().with_context(|| format!("before {time}"))?;
        places.push(Member::all(scene.system_mut())?.iter().map(|member| member.centroid).collect());
    }
    Ok((places, scene.steps()))
}

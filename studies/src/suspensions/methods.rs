//! Sixteen droplets by a grid, by layers and without a grid: error against cost.

use anyhow::Result;
use motile::analysis::suspension::Member;
use motile::base::{Region, Vec2};
use motile::setup::{Built, GridMethod, LayersMethod, Method, Setup};
use motile_tests::validation::Table;

use super::{CELLS, integral, suspension};
use crate::many::costs;
use crate::tables::{Measure, Once};

const COUNT: usize = 16;
const FRACTION: f64 = 0.3;
const ACTIVITY: f64 = -2.0;
/// Nodes of what all are compared with, and those that the repulsion is made for.
const FINEST: usize = 96;
const HELD: usize = 48;
const TIME: f64 = 2.0;
/// Time over which a method's steps are measured (seconds).
const BUDGET: f64 = 6.0;

pub(super) fn table() -> Result<Table> {
    let columns = "method | error in % of the way | steps | FFT pairs a unit of time";
    let mut table = Table::new("sixteen droplets in a box, area fraction 0.3: error at t = 2 against cost", columns);
    let usual = suspension(COUNT, FRACTION, ACTIVITY, 1.0, HELD)?;
    let Region::Box { lengths: [side, _] } = usual.region else { anyhow::bail!("no box") };
    // The next spacing of which the box has a whole number.
    let fitting = |spacing: f64| side / (side / spacing).round();
    let layers = |spacing| {
        let of_spacing = LayersMethod::of_spacing(fitting(spacing));
        Method::Layers(LayersMethod { nodes: HELD, elements: CELLS * HELD, ..of_spacing })
    };
    let all = [
        ("integrals, 24 nodes", integral(24)),
        ("integrals, 32 nodes", integral(32)),
        ("integrals, 48 nodes", integral(48)),
        ("integrals, 64 nodes", integral(64)),
        ("layers, h = 0.1", layers(0.1)),
        ("layers, h = 0.06", layers(0.06)),
        ("grid, h = 0.1", Method::Grid(GridMethod::of_spacing(fitting(0.1)))),
        ("grid, h = 0.06", Method::Grid(GridMethod::of_spacing(fitting(0.06)))),
    ];
    let by = |method: Method| {
        // A grid has no accuracy of its own.
        let tolerance = usual.tolerance.filter(|_| !matches!(method, Method::Grid(_)));
        Setup { method, tolerance, ..usual.clone() }
    };
    let exact = Once::new();
    for (name, method) in all {
        table.measure(name, || {
            let exact = exact.get(|| Ok(way(&by(integral(FINEST)))?.0))?;
            let (found, steps) = way(&by(method))?;
            let (mut error, mut length) = (0.0_f64, 0.0_f64);
            for ([start, end], [_, other]) in exact.iter().zip(&found) {
                error = error.max(end.distance(*other));
                length = length.max(end.distance(*start));
            }
            let cost = costs(std::iter::once((by(method), steps as f64 / TIME)), BUDGET)?[0];
            Ok(format!("{:.2} | {steps} | {cost:.0}", 100.0 * error / length))
        })?;
    }
    Ok(table)
}

/// Centroids at the start and the end, and the number of steps.
fn way(setup: &Setup) -> Result<(Vec<[Vec2; 2]>, usize)> {
    let Built { mut scene, .. } = setup.build()?;
    let start = Member::all(scene.system_mut())?;
    scene.run(TIME).go()?;
    let end = Member::all(scene.system_mut())?;
    Ok((start.iter().zip(&end).map(|(start, end)| [start.centroid, end.centroid]).collect(), scene.steps()))
}

//! When the trajectories of a hundred droplets part that are computed by sums over pairs, or with more nodes.

use anyhow::{Context, Result};
use motile::analysis::suspension::Member;
use motile::base::Vec2;
use motile::scene::{Every, Hydrodynamics, SceneError, System};
use motile::setup::{Built, Setup};
use motile_tests::validation::Table;

use super::{TOLERANCE, integral, suspension};
use crate::tables::{Measure, Once};

const COUNT: usize = 100;
const FRACTION: f64 = 0.3;
const ACTIVITY: f64 = -2.0;
const NODES: usize = 64;
/// Runs with their nodes, tolerance and end (time), all with the same repulsion; the first is what the others are
/// compared with. Sums are over pairs below a tolerance of 1e-12.
const RUNS: [(&str, usize, f64, f64); 3] =
    [("itself", NODES, TOLERANCE, 80.0), ("sums over pairs", NODES, 1e-13, 5.0), ("96 nodes", 96, TOLERANCE, 80.0)];
const TIMES: [f64; 7] = [1.0, 5.0, 10.0, 20.0, 40.0, 60.0, 80.0];

pub(super) fn table() -> Result<Table> {
    let at = TIMES.map(|time| format!("at {time}")).join(" | ");
    let columns = format!("against | steps | {at} | area change | particle change | least film");
    let mut table = Table::new("largest distance of a droplet from where it is with 64 nodes at 1e-6", &columns);
    let first = Once::new();
    for (number, (name, nodes, tolerance, end)) in RUNS.into_iter().enumerate() {
        table.measure(name, || {
            let (_, usual_nodes, usual_tolerance, usual_end) = RUNS[0];
            let usual = first.get(|| Way::of(usual_nodes, usual_tolerance, usual_end))?;
            let other = if number > 0 { &Way::of(nodes, tolerance, end)? } else { usual };
            let apart = (0..TIMES.len()).map(|time| match other.places.get(time) {
                Some(there) if number > 0 => {
                    let distances = usual.places[time].iter().zip(there).map(|(a, b)| a.distance(*b));
                    format!("{:.1e}", distances.fold(0.0, f64::max))
                }
                _ => String::new(),
            });
            let changes = other.changes.map(|change| format!("{change:.0e}")).join(" | ");
            let apart = apart.collect::<Vec<_>>().join(" | ");
            Ok(format!("{} | {apart} | {changes} | {:.3}", other.steps, other.film))
        })?;
    }
    Ok(table)
}

/// Run of the droplets.
struct Way {
    /// Centroids at the times that it came to.
    places: Vec<Vec<Vec2>>,
    steps: usize,
    /// Largest relative changes of area and of particle number of a droplet.
    changes: [f64; 2],
    /// Narrowest film (length).
    film: f64,
}

impl Way {
    fn of(nodes: usize, tolerance: f64, end: f64) -> Result<Self> {
        let usual = suspension(COUNT, FRACTION, ACTIVITY, 1.0, NODES)?;
        let Built { mut scene, .. } = Setup { method: integral(nodes), tolerance: Some(tolerance), ..usual }.build()?;
        let start = Member::all(scene.system_mut())?;
        let (mut places, mut changes) = (Vec::new(), [0.0_f64; 2]);
        for time in TIMES.into_iter().filter(|time| *time <= end) {
            let mut look = |system: &mut System<Box<dyn Hydrodynamics>>| {
                for (start, now) in start.iter().zip(Member::all(system)?) {
                    let parts = [now.area / start.area, now.particles / start.particles];
                    changes.iter_mut().zip(parts).for_each(|(change, part)| *change = change.max((part - 1.0).abs()));
                }
                Ok::<_, SceneError>(())
            };
            let run = scene.run(time).observe(Every::StepAfter(1.0), &mut look).go();
            run.with_context(|| format!("before {time}"))?;
            places.push(Member::all(scene.system_mut())?.iter().map(|member| member.centroid).collect());
        }
        let film = scene.system().minimum_gap().unwrap_or(f64::NAN);
        Ok(Self { places, steps: scene.steps(), changes, film })
    }
}

//! Threshold, speed and shape of swimmers from droplet to cortex.

use anyhow::Result;
use motile::active_interface::Cortex;
use motile::base::{Drive, Region};
use motile::setup::{DropletSetup, Setup};
use motile_cli::run::explained;
use motile_steady_states::SteadyState;
use motile_tests::validation::Table;

use super::nodes;
use crate::steady_states::{activity, polarisation};
use crate::tables::{Measure, Once};

/// Viscosity of the cortex over the viscosities of both fluids and the radius.
const RATIOS: [f64; 6] = [0.0, 0.01, 0.1, 1.0, 10.0, 100.0];
/// Viscosities inside; outside it is 100.
const INSIDE: [f64; 2] = [100.0, 20.0];
/// Nodes of the thresholds and of the swimmers.
const NODES: [usize; 2] = [32, 96];

/// Thresholds, and swimmers at twice the threshold of the plane and at a fixed activity.
pub(super) fn cortex() -> Result<Vec<Table>> {
    let header = "region | viscosity inside | cortex | held | threshold | over the closed form | activity | speed | \
                  aspect ratio | stresslet | largest concentration";
    let mut table = Table::new("Swimmers from droplet to cortex", header);
    let regions = [
        ("plane", Region::Plane),
        ("box 6", Region::Box { lengths: [6.0; 2] }),
        ("channel 12 x 5", Region::Channel { length: 12.0, width: 5.0, drive: Drive::ZeroGradient }),
    ];
    for (name, region) in regions {
        for inside in INSIDE {
            for ratio in RATIOS {
                let sum = 100.0 + inside;
                let scene = |activity: f64, count| {
                    let droplet = DropletSetup {
                        viscosity: Some(inside),
                        cortex: Cortex::new(ratio * sum),
                        ..DropletSetup::active(activity)
                    };
                    Setup { region, method: nodes(count), droplets: vec![droplet], ..Setup::default() }
                };
                // The closed form of a circle in the plane.
                let plane = -0.2 * (sum + 0.5 * ratio * sum) / 100.0;
                let threshold = Once::new();
                for (how, given) in [("twice the closed form", 2.0 * plane), ("-4", -4.0)] {
                    // Below the threshold nothing swims.
                    if given > plane {
                        continue;
                    }
                    table.measure(format_args!("{name} | {inside} | {ratio} | {how}"), || {
                        let found = threshold.get(|| Ok(activity(&polarisation(&scene(plane, NODES[0]))?)))?;
                        let first = format!("{found:.4} | {:.4} | {given:.4}", found / plane);
                        let swimmer = SteadyState::find(&scene(given, NODES[1])).and_then(|state| state.measured());
                        Ok(match swimmer {
                            Ok(seen) => format!(
                                "{first} | {:.5} | {:.4} | {:.3} | {:.3}",
                                seen.speed, seen.aspect_ratio, seen.stresslet, seen.concentration[0]
                            ),
                            Err(error) => format!("{first} | {} |  |  | ", explained(&error.into())),
                        })
                    })?;
                }
            }
        }
    }
    Ok(vec![table])
}

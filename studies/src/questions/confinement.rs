//! Speed over the width of a channel, for interfaces with friction.

use anyhow::Result;
use motile::base::{Drive, Region};
use motile::setup::{DropletSetup, Setup};
use motile_cli::run::explained;
use motile_steady_states::SteadyState;
use motile_tests::validation::Table;

use super::nodes;
use crate::tables::{Measure, Once};

/// Friction xi R/(2 (eta_in + eta_ext)) of the interface.
const FRICTIONS: [f64; 6] = [0.0, 0.03, 0.1, 0.3, 1.0, 10.0];
/// Widths of the channel; the speed in the first is the unit.
const WIDTHS: [f64; 5] = [12.0, 6.0, 4.0, 3.0, 2.4];
const NODES: usize = 96;

/// Steady swimmers at fixed multiples of the threshold in the plane.
pub(super) fn confinement() -> Result<Vec<Table>> {
    let header =
        "length | drive | over threshold | friction | width | activity | speed | over the widest | aspect ratio";
    let mut table = Table::new("Swimmers in channels, with friction", header);
    for (length, drive, name, factor) in [
        (12.0, Drive::ZeroGradient, "zero gradient", 4.0),
        (12.0, Drive::ZeroFlux, "zero flux", 4.0),
        (12.0, Drive::ZeroGradient, "zero gradient", 10.0),
        (24.0, Drive::ZeroGradient, "zero gradient", 4.0),
    ] {
        for friction in FRICTIONS {
            let activity = -0.4 * factor * (1.0 + 0.5 * friction);
            let speed = |width: f64| {
                let droplet = DropletSetup { friction: 400.0 * friction, ..DropletSetup::active(activity) };
                let region = Region::Channel { length, width, drive };
                let setup = Setup { region, method: nodes(NODES), droplets: vec![droplet], ..Setup::default() };
                SteadyState::find(&setup).and_then(|state| state.measured()).map(|seen| (seen.speed, seen.aspect_ratio))
            };
            let widest = Once::new();
            for width in WIDTHS {
                table.measure(format_args!("{length} | {name} | {factor} | {friction} | {width}"), || {
                    let (unit, _) = widest.get(|| Ok(speed(WIDTHS[0])?))?;
                    Ok(match speed(width) {
                        Ok((found, aspect)) => {
                            format!("{activity:.3} | {found:.5} | {:.4} | {aspect:.4}", found / unit)
                        }
                        Err(error) => format!("{activity:.3} | {} |  | ", explained(&error.into())),
                    })
                })?;
            }
        }
    }
    Ok(vec![table])
}

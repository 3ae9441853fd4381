//! Two droplets that meet head-on.

use std::f64::consts::PI;

use motile::base::Region;
use motile::scene::gap::Repulsion;
use motile::setup::{DropletSetup, IntegralMethod, Method, Setup};
use motile_tests::validation::Table;

use super::Tables;
use crate::tables::Measure;

/// Without a repulsion and with one of a strength and range.
pub(super) fn two_droplets() -> Tables {
    let mut table = Table::new(
        "Two droplets of activity -4 and viscosity 100 in a box of 12 x 6 R0",
        "meeting | repulsion | method | end | least gap",
    );
    for (nodes, pair, time) in [
        (48, None, 20.0),
        (96, None, 40.0),
        (48, Some([2000.0, 0.2]), 40.0),
        (48, Some([5000.0, 0.1]), 40.0),
        (72, Some([5000.0, 0.1]), 40.0),
        (96, Some([20_000.0, 0.05]), 40.0),
        (48, Some([100.0, 0.1]), 40.0),
    ] {
        let droplet = |name: &str, x: f64, angle: f64| DropletSetup {
            name: name.to_owned(),
            centre: [x, 0.0],
            angle,
            ..DropletSetup::active(-4.0)
        };
        let setup = Setup {
            region: Region::Box { lengths: [12.0, 6.0] },
            method: Method::Integral(IntegralMethod { nodes, elements: 4 * nodes }),
            droplets: vec![droplet("first", -2.0, 0.0), droplet("second", 2.0, PI)],
            repulsion: pair.and_then(|[strength, range]| Repulsion::new(strength, range).ok()),
            least_gap: Some(0.0),
            ..Setup::default()
        };
        let pair = pair.map_or_else(|| "none".to_owned(), |[strength, range]| format!("{strength}, {range}"));
        table.measure(format_args!("head-on | {pair} | {nodes} nodes"), || {
            let mut scene = setup.build()?.scene;
            let end = match scene.run(time).go() {
                Ok(()) => format!("t = {time}"),
                Err(_) => format!("film gone at t = {:.1}", scene.time()),
            };
            Ok(format!("{end} | {:.3}", scene.system().minimum_gap().unwrap_or(f64::NAN)))
        })?;
    }
    Ok(vec![table])
}

//! A droplet in a tube narrower than itself.

use anyhow::Result;
use motile::motile_base::Region;
use motile::setup::DropletSetup;
use motile_output::run::say;
use motile_tests::validation::Table;

use super::scene;

/// Radius of the tube (R0).
const RADIUS: f64 = 0.9;
const NODES: [usize; 3] = [64, 96, 128];
/// When runs are looked at.
const TIMES: [f64; 4] = [5.0, 10.0, 20.0, 40.0];

/// Speeds and films over time and nodes, of runs that start squeezed to a spheroid.
pub(super) fn narrow() -> Result<Table> {
    let title = format!("A droplet of activity -2, A = 4 in a tube of radius {RADIUS} without flux, from a spheroid");
    let mut table = Table::new(&title, &["nodes", "t", "speed", "film", "film over distance of nodes", "aspect ratio"]);
    for count in NODES {
        let setup = scene(Region::tube(RADIUS), DropletSetup::contractile(-2.0, 4.0), count);
        let mut built = setup.build()?;
        for time in TIMES {
            if let Err(error) = built.scene.run(time).go() {
                say(format_args!("{error}"));
                let at = format!("ends at {:.1}", built.scene.time());
                table.push([count.to_string(), at, String::new(), String::new(), String::new(), String::new()]);
                break;
            }
            let seen = built.scene.observe(built.droplets[0])?;
            let film = built.scene.system_mut().wall_gap().unwrap_or(f64::NAN);
            let markers = built.scene.body(built.droplets[0])?.markers();
            let neighbours = markers.iter().zip(markers.iter().cycle().skip(1));
            let apart = neighbours.map(|(a, b)| (*b - *a).length()).sum::<f64>() / count as f64;
            let cells = [count.to_string(), time.to_string(), format!("{:.5}", seen.speed()), format!("{film:.4}")];
            let rest = [format!("{:.2}", film / apart), format!("{:.3}", seen.aspect_ratio_moments)];
            say(format_args!("{cells:?} {rest:?}"));
            table.push(cells.into_iter().chain(rest));
        }
    }
    Ok(table)
}

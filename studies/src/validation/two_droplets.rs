//! Two droplets that meet.

use motile::base::Region;
use motile::base::Vec2;
use motile::scene::gap::Repulsion;
use motile::setup::{Built, DropletSetup, GridMethod, IntegralMethod, Method, Setup};
use motile_tests::validation::{StudyError, Table};

use super::Tables;

const SIDES: [f64; 2] = [12.0, 6.0];

/// Places of both droplets, and whether the second swims towards the first.
type Meeting = (&'static str, [[f64; 2]; 2], bool);

const HEAD_ON: Meeting = ("head-on", [[-2.0, 0.0], [2.0, 0.0]], true);
const FOLLOWER: Meeting = ("leader and follower", [[-2.0, 0.0], [2.0, 0.0]], false);
const BESIDE: Meeting = ("side by side", [[0.0, -1.5], [0.0, 1.5]], false);

fn grid() -> Method {
    Method::Grid(GridMethod::of_spacing(0.1))
}

fn nodes(nodes: usize) -> Method {
    Method::Integral(IntegralMethod { nodes, elements: 4 * nodes })
}

/// Speeds, distance of the centres and least gap in the end, and what ended it early.
fn row(&(_, places, towards): &Meeting, method: Method, pair: [f64; 2], time: f64) -> Result<[String; 5], StudyError> {
    let angle = if towards { std::f64::consts::PI } else { 0.0 };
    let droplet = |name: &str, k: usize, angle| DropletSetup {
        name: name.to_owned(),
        centre: places[k],
        angle,
        ..DropletSetup::active(-4.0)
    };
    let [strength, range] = pair;
    let setup = Setup {
        region: Region::Box { lengths: SIDES },
        method,
        droplets: vec![droplet("first", 0, 0.0), droplet("second", 1, angle)],
        repulsion: Repulsion::new(strength, range).ok(),
        least_gap: Some(0.0),
        ..Setup::default()
    };
    let Built { mut scene, droplets, .. } = setup.build()?;
    let end = scene.run(time).go();
    let [first, second] = [scene.observe(droplets[0])?, scene.observe(droplets[1])?];
    let apart = second.centroid - first.centroid;
    let sides = Vec2::from(SIDES);
    let distance = (apart - sides * (apart / sides).round()).length();
    let area = scene.body(droplets[0])?.initial_area();
    let ended = end.map_or_else(|_| format!("film gone at t = {:.1}", scene.time()), |_| format!("t = {time}"));
    let gap = scene.system().minimum_gap().unwrap_or(f64::NAN);
    Ok([
        ended,
        format!("{:.4}, {:.4}", first.speed(), second.speed()),
        format!("{distance:.3}"),
        format!("{gap:.3}"),
        format!("{:.1e}", first.area / area - 1.0),
    ])
}

/// With both methods, with and without a repulsion.
pub(super) fn two_droplets(quick: bool) -> Tables {
    let none = [0.0, 1.0];
    let mut cases = vec![
        (BESIDE, nodes(48), none, 20.0),
        (BESIDE, grid(), none, 20.0),
        (FOLLOWER, nodes(48), none, 20.0),
        (FOLLOWER, grid(), none, 20.0),
        (HEAD_ON, nodes(48), none, 20.0),
        (HEAD_ON, nodes(96), none, 40.0),
        (HEAD_ON, grid(), none, 20.0),
    ];
    for (method, pair) in [
        (grid(), [100.0, 0.2]),
        (nodes(48), [2000.0, 0.2]),
        (nodes(48), [5000.0, 0.1]),
        (nodes(72), [5000.0, 0.1]),
        (nodes(96), [20_000.0, 0.05]),
        (nodes(48), [100.0, 0.1]),
    ] {
        cases.push((HEAD_ON, method, pair, 40.0));
    }
    if quick {
        cases.truncate(2);
    }
    let mut table = Table::new(
        "Two droplets of activity -4 and viscosity 100 in a box of 12 x 6 R0",
        &["meeting", "repulsion", "method", "end", "speeds", "distance of centres", "least gap", "area"],
    );
    for (meeting, method, pair, time) in cases {
        let name = match &method {
            Method::Layers(layers) => format!("layers, {} nodes", layers.nodes),
            Method::Grid(grid) => format!("grid, h = {}", grid.spacing),
            Method::Integral(integral) => format!("{} nodes", integral.nodes),
            other => other.kind().name().to_owned(),
        };
        let repulsion = if pair[0] > 0.0 { format!("{}, {}", pair[0], pair[1]) } else { String::new() };
        table.push([meeting.0.to_owned(), repulsion, name].into_iter().chain(row(&meeting, method, pair, time)?));
    }
    Ok(vec![table])
}

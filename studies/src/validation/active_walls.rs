//! Active walls: interfaces that are periodic along x.

use motile::base::{Drive, Region};
use motile::setup::{Built, DropletSetup, IntegralMethod, InterfaceSetup, Method, Particles, Setup, Side, Start};
use motile_tests::validation::flat::{Flat, PERIOD, difference, half_space, wall};
use motile_tests::validation::{StudyError, Table};

use motile::active_interface::theory::{Stratum, StratumEnd};

use super::Tables;
use crate::tables::Measure;

/// End of the long runs, and of those of a droplet.
const LONG: f64 = 200.0;
const SWIM: f64 = 80.0;

/// Growth of waves, long runs of a pair of walls, a droplet between two walls.
pub(super) fn active_walls() -> Tables {
    Ok(vec![growth()?, patterns()?, swimmers()?])
}

fn growth() -> Result<Table, StudyError> {
    let mut table = Table::new(
        "Matrix of growth of waves on flat interfaces, error over the largest entry, and of the relaxation of the \
         shape alone",
        "geometry | viscosities | waves | 64 cells a wave | 128 | 256 | shape",
    );
    let channel = |width: f64| Region::Channel { length: PERIOD, width, drive: Drive::ZeroGradient };
    let high = Region::Box { lengths: [PERIOD, 30.0] };
    let inner = |end: StratumEnd| Stratum { viscosity: 1.0, end };
    let single = [[1.0, 1.0]];
    let (same, opposite) = ([[1.0, -1.0], [1.0, 1.0]], [[-1.0, 1.0], [1.0, 1.0]]);
    let pair = [(-0.8, -PERIOD, 3.0), (0.8, PERIOD, 3.0)];
    let thickness = 1.6;
    let between = |end: StratumEnd| [inner(end), wall(3.0, 1.2)];
    type Geometry<'a> = (&'a str, &'a str, Region, &'a [(f64, f64, f64)], &'a [[f64; 2]], usize, [Stratum; 2]);
    let geometries: [Geometry<'_>; 7] = [
        ("half-spaces", "1, 1", high, &[(0.3, PERIOD, 1.0)], &single, 1, [half_space(1.0); 2]),
        ("half-spaces", "1, 10", channel(24.0), &[(0.0, PERIOD, 10.0)], &single, 1, [1.0, 10.0].map(half_space)),
        ("channel, middle", "1, 1", channel(2.0), &[(0.0, PERIOD, 1.0)], &single, 1, [wall(1.0, 1.0); 2]),
        ("channel, aside", "1, 5", channel(2.0), &[(0.3, PERIOD, 5.0)], &single, 1, [wall(1.0, 1.3), wall(5.0, 0.7)]),
        (
            "channel, aside",
            "1, 0.1",
            channel(2.0),
            &[(-0.6, PERIOD, 0.1)],
            &single,
            2,
            [wall(1.0, 0.4), wall(0.1, 1.6)],
        ),
        ("pair, same", "3, 1, 3", channel(4.0), &pair, &same, 1, between(StratumEnd::Same { thickness })),
        ("pair, opposite", "3, 1, 3", channel(4.0), &pair, &opposite, 1, between(StratumEnd::Opposite { thickness })),
    ];
    for (name, viscosities, region, interfaces, signs, waves, [below, above]) in geometries {
        table.measure(format_args!("{name} | {viscosities} | {waves}"), || {
            let flat = Flat { region, exterior: 1.0, interfaces, signs, waves };
            let exact = flat.theory(below, above)?;
            let found = [64, 128, 256].map(|cells| flat.growth(64, cells * waves));
            let [coarse, middle, fine] = found;
            let errors = [&coarse?, &middle?, &fine?].map(|found| (difference(*found, exact), found[1][1]));
            let shape = (errors[0].1 / exact[1][1] - 1.0).abs();
            let [coarse, middle, fine] = errors.map(|(error, _)| error);
            Ok(format!("{coarse:.1e} | {middle:.1e} | {fine:.1e} | {shape:.0e}"))
        })?;
    }
    Ok(table)
}

/// Two walls with particles of that activity in a box of 6 x 6, the fluid everywhere of viscosity 100.
fn walls(activity: f64, amplitude: f64, gap: f64, nodes: usize) -> Setup {
    let wall = |height: f64, inside: Side, seed: u64| InterfaceSetup {
        height,
        inside,
        particles: Some(Particles { activity, start: Start::Perturbed { amplitude, seed }, ..Particles::default() }),
        ..InterfaceSetup::default()
    };
    Setup {
        method: Method::Integral(IntegralMethod { nodes, elements: 4 * nodes }),
        droplets: Vec::new(),
        interfaces: vec![wall(-0.5 * gap, Side::Below, 1), wall(0.5 * gap, Side::Above, 2)],
        ..Setup::default()
    }
}

fn patterns() -> Result<Table, StudyError> {
    let mut table = Table::new(
        "Two active walls 3 R0 apart in a box of 6 x 6 R0 to t = 200: the upper one in the end, and changes since the \
         start",
        "activity | nodes | largest c/c0 | height of the longest wave | drift | flux | particles | mean height",
    );
    for (activity, nodes) in [(-0.5, 32), (-0.5, 48), (-1.0, 32), (-1.0, 48), (-2.0, 32), (-2.0, 48)] {
        table.measure(format_args!("{activity} | {nodes}"), || {
            let Built { mut scene, interfaces, .. } = walls(activity, 0.05, 3.0, nodes).build()?;
            let before = scene.observe(interfaces[1])?;
            let phase = |modes: &motile::active_interface::observables::FourierModes| {
                modes.sines[0].atan2(modes.cosines[0]) * PERIOD / std::f64::consts::TAU
            };
            scene.run(0.9 * LONG).go()?;
            let earlier = phase(&scene.observe(interfaces[1])?.concentration_modes);
            scene.run(LONG).go()?;
            let seen = scene.observe(interfaces[1])?;
            let moved = phase(&seen.concentration_modes) - earlier;
            let drift = (moved - PERIOD * (moved / PERIOD).round()) / (0.1 * LONG);
            let most = seen.concentration_range.map_or(f64::NAN, |[most, _]| most / 100.0);
            Ok(format!(
                "{most:.4} | {:.5} | {drift:.1e} | {:.1e} | {:.0e} | {:.0e}",
                seen.height_modes.amplitude(1),
                seen.flux,
                (seen.particle_number / before.particle_number - 1.0).abs(),
                (seen.height - before.height).abs()
            ))
        })?;
    }
    Ok(table)
}

fn swimmers() -> Result<Table, StudyError> {
    let mut table = Table::new(
        "A droplet between two active walls 3 R0 apart in a box of 6 x 6 R0: mean speed along them from t = 40 to 80",
        "droplet | wall activity | speed at 32 nodes | speed at 48 nodes",
    );
    for (name, droplet) in [("activity -2", DropletSetup::active(-2.0)), ("passive", DropletSetup::passive(10.0))] {
        for activity in [0.0, -0.25, -0.5, -0.75, -1.0] {
            let speed = |nodes: usize| -> Result<String, StudyError> {
                let droplets = vec![DropletSetup { centre: [0.3, 0.0], ..droplet.clone() }];
                let setup = Setup { droplets, ..walls(activity, 0.05, 3.0, nodes) };
                let Built { mut scene, droplets, .. } = setup.build()?;
                scene.run(0.5 * SWIM).go().ok();
                let start = scene.observe(droplets[0])?.centroid;
                Ok(match scene.run(SWIM).go() {
                    Ok(()) => {
                        let end = scene.observe(droplets[0])?.centroid;
                        format!("{:.4}", (end.x - start.x) / (0.5 * SWIM))
                    }
                    Err(_) => format!("film gone at t = {:.1}", scene.time()),
                })
            };
            table.measure(format_args!("{name} | {activity}"), || Ok([speed(32)?, speed(48)?].join(" | ")))?;
        }
    }
    Ok(table)
}

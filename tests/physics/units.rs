//! Nothing depends on the units of length, time and force.

use motile::base::Drive;
use motile::base::Region;
use motile::elastic_solids::ChannelShape;
use motile::scene::StepSize;
use motile::scene::gap::Repulsion;
use motile::setup::{Material, Method, Setup, SolidSetup};
use motile_tests::units::Units;

#[derive(Debug, Clone, Copy)]
enum Scene {
    Integral,
    Grid,
    Pair,
    PairWithoutGrid,
    Solids,
}

const SYSTEMS: [Units; 5] = [
    Units { length: 1.0, time: 1e-6, force: 1.0 },
    Units { length: 1.0, time: 30.0, force: 1.0 },
    Units { length: 1e-5, time: 1.0, force: 1.0 },
    Units { length: 7.0, time: 0.3, force: 1e-9 },
    Units { length: 1e6, time: 1e4, force: 1e5 },
];

fn walls(units: Units) -> Vec<SolidSetup> {
    let stress = units.force / units.length;
    let material = Material::NeoHookean { shear: 200.0 * stress, bulk: 400.0 * stress };
    SolidSetup::walls(&ChannelShape::Straight { width: 2.4 * units.length }, &material)
}

fn setup(units: Units, scene: Scene) -> Setup {
    let channel = |length, width| Region::Channel {
        length: length * units.length,
        width: width * units.length,
        drive: Drive::ZeroFlux,
    };
    let square = |length| Region::Box { lengths: [length * units.length; 2] };
    let alone = |activity, viscosity| vec![units.droplet(activity, [0.1, 0.05], viscosity)];
    let pair =
        |viscosity| vec![units.droplet(-3.0, [-1.1, 0.05], viscosity), units.droplet(-5.0, [1.2, -0.1], Some(300.0))];
    let range = 0.3 * units.length;
    let repulsion = Repulsion::new(200.0 * units.force / range.powi(2), range).ok();
    let (region, method, droplets) = match scene {
        Scene::Integral => (channel(6.0, 2.6), Method::default(), alone(-3.0, None)),
        Scene::Grid => (square(5.0), units.grid(0.1), alone(-4.0, None)),
        Scene::Pair => (square(6.0), units.layers(0.1), pair(Some(30.0))),
        Scene::PairWithoutGrid => (Region::Plane, Method::default(), pair(None)),
        Scene::Solids => (channel(5.0, 5.0), units.layers(0.1), alone(-4.0, None)),
    };
    let solids = if matches!(scene, Scene::Solids) { walls(units) } else { Vec::new() };
    let repulsion = repulsion.filter(|_| droplets.len() == 2);
    let viscosity = units.viscosity(100.0);
    let step = StepSize::OfLimit(0.5);
    Setup { region, method, viscosity, droplets, solids, repulsion, step, ..Setup::default() }
}

/// Speed, direction, stresslet, aspect ratio and place of the first droplet in the units of the scene, and the steps.
fn result(units: Units, scene: Scene) -> ([f64; 6], usize) {
    let mut built = setup(units, scene).build().expect("a valid setup");
    built.scene.run(2.0 * units.time).go().expect("a run");
    let seen = built.scene.observe(built.droplets[0]).expect("a droplet");
    let speed = seen.velocity.length() * units.time / units.length;
    let stresslet = seen.get("stresslet_xx").expect("a name") / (units.force * units.length);
    let [x, y] = [seen.centroid.x, seen.centroid.y].map(|x| x / units.length);
    let heading = seen.velocity.y.atan2(seen.velocity.x);
    let ratio = seen.get("aspect_ratio_moments").expect("a name");
    ([speed, heading, stresslet, ratio, x, y], built.scene.steps())
}

#[test]
fn nothing_depends_on_the_units() {
    for scene in [Scene::Integral, Scene::Grid, Scene::Pair, Scene::PairWithoutGrid, Scene::Solids] {
        let (expected, steps) = result(Units::PLAIN, scene);
        for units in SYSTEMS {
            let (found, taken) = result(units, scene);
            let worst = found.iter().zip(expected).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
            assert!(worst < 1e-10 && taken == steps, "{scene:?} {units:?}: {worst:e}, {taken} and {steps} steps");
        }
    }
}

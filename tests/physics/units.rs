//! Nothing depends on the units of length, time and force.

use motile::ib_core::StepSize;
use motile::stokes_grid::Drive;
use motile::{
    ChannelShape, DropletSetup, DropletShape, Exclusion, GridMethod, Material, Method, Particles, Region,
    RepulsionSetup, Setup, SolidSetup,
};

#[derive(Debug, Clone, Copy)]
enum Scene {
    Integral,
    Grid,
    Pair,
    PairWithoutGrid,
    Solids,
}

/// Units of length, time and force in those of the scene.
#[derive(Debug, Clone, Copy)]
struct Units {
    length: f64,
    time: f64,
    force: f64,
}

const SYSTEMS: [Units; 5] = [
    Units { length: 1.0, time: 1e-6, force: 1.0 },
    Units { length: 1.0, time: 30.0, force: 1.0 },
    Units { length: 1e-5, time: 1.0, force: 1.0 },
    Units { length: 7.0, time: 0.3, force: 1e-9 },
    Units { length: 1e6, time: 1e4, force: 1e5 },
];

impl Units {
    fn viscosity(self, value: f64) -> f64 {
        value * self.force * self.time / self.length
    }

    fn droplet(self, activity: f64, at: [f64; 2], viscosity: Option<f64>) -> DropletSetup {
        let Self { length, time, force } = self;
        let particles = Particles {
            activity: activity * force * length,
            excluded_volume: Exclusion::Step(10.0 * force * length),
            diffusion: 0.1 * length * length / time,
            concentration: 100.0 / length,
            ..Particles::default()
        };
        DropletSetup {
            centre: at.map(|x| x * length),
            angle: 0.3,
            viscosity: viscosity.map(|value| self.viscosity(value)),
            tension: 10.0 * force,
            shape: DropletShape::Round { radius: length },
            particles: Some(particles),
            ..DropletSetup::default()
        }
    }

    fn grid(self, spacing: f64) -> Method {
        Method::Grid(GridMethod::of_spacing(spacing * self.length))
    }

    fn walls(self) -> Vec<SolidSetup> {
        let stress = self.force / self.length;
        let material = Material::NeoHookean { shear: 200.0 * stress, bulk: 400.0 * stress };
        SolidSetup::walls(&ChannelShape::Straight { width: 2.4 * self.length }, &material)
    }

    fn setup(self, scene: Scene) -> Setup {
        let channel = |length, width| Region::Channel {
            length: length * self.length,
            width: width * self.length,
            drive: Drive::ZeroFlux,
        };
        let square = |length| Region::Box { lengths: [length * self.length; 2] };
        let alone = |activity, viscosity| vec![self.droplet(activity, [0.1, 0.05], viscosity)];
        let pair =
            |viscosity| vec![self.droplet(-3.0, [-1.1, 0.05], viscosity), self.droplet(-5.0, [1.2, -0.1], Some(300.0))];
        let range = 0.3 * self.length;
        let repulsion = Some(RepulsionSetup { strength: 200.0 * self.force / range.powi(2), range });
        let (region, method, droplets) = match scene {
            Scene::Integral => (channel(6.0, 2.6), Method::default(), alone(-3.0, None)),
            Scene::Grid => (square(5.0), self.grid(0.1), alone(-4.0, None)),
            Scene::Pair => (square(6.0), self.grid(0.1), pair(Some(30.0))),
            Scene::PairWithoutGrid => (Region::Plane, Method::default(), pair(None)),
            Scene::Solids => (channel(5.0, 5.0), self.grid(0.1), alone(-4.0, None)),
        };
        let solids = if matches!(scene, Scene::Solids) { self.walls() } else { Vec::new() };
        let repulsion = repulsion.filter(|_| droplets.len() == 2);
        let viscosity = self.viscosity(100.0);
        let step = StepSize::OfLimit(0.5);
        Setup { region, method, viscosity, droplets, solids, rigid: Vec::new(), repulsion, step }
    }
}

/// Speed, direction, stresslet, aspect ratio and place of the first droplet in the units of the scene, and the steps.
fn result(units: Units, scene: Scene) -> ([f64; 6], usize) {
    let mut built = units.setup(scene).build().expect("a valid setup");
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
    let unity = Units { length: 1.0, time: 1.0, force: 1.0 };
    for scene in [Scene::Integral, Scene::Grid, Scene::Pair, Scene::PairWithoutGrid, Scene::Solids] {
        let (expected, steps) = result(unity, scene);
        for units in SYSTEMS {
            let (found, taken) = result(units, scene);
            let worst = found.iter().zip(expected).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
            assert!(worst < 1e-10 && taken == steps, "{scene:?} {units:?}: {worst:e}, {taken} and {steps} steps");
        }
    }
}

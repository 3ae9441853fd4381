//! Runs of bodies of revolution with a cortex, against closed forms and steady states.

use std::f64::consts::TAU;

use motile::active_interface::theory::{RoundDroplet, Sphere};
use motile::active_interface::{
    ActiveDroplet, ContractileTension, Cortex, Curve, ExcludedVolume, InitialConcentration, Scene,
};
use motile::base::TubeShape;
use motile::prelude::*;
use motile_steady_states::SteadyState;

const SPACE: Region = Region::Space;

fn droplet(curve: &Curve, markers: usize, [inside, length]: [f64; 2], cortex: Cortex, degree: u32) -> ActiveDroplet {
    let markers = curve.markers(markers).expect("a good scene");
    let wave = move |angle: f64| 100.0 * (1.0 + 0.3 * legendre(degree, angle.cos()));
    let numbers = InitialConcentration::by_polar_angle(wave).particle_numbers(&markers).expect("a good scene");
    // A tension of the size of its unit, viscosity times velocity.
    let law = ContractileTension::new(10.0 * length, -0.02 * length, ExcludedVolume::None, 1.0).expect("a good scene");
    let made = ActiveDroplet::new(&markers, numbers, law, 0.1 * length * length)
        .expect("a good scene")
        .axisymmetric()
        .expect("a good scene");
    made.with_viscosity_inside(inside).expect("a good scene").with_cortex(cortex).expect("a good scene")
}

fn legendre(degree: u32, x: f64) -> f64 {
    match degree {
        1 => x,
        2 => 1.5 * x * x - 0.5,
        _ => 2.5 * x * x * x - 1.5 * x,
    }
}

fn flow(nodes: usize, elements: usize, viscosity: f64) -> Setup {
    let method = Method::Integral(IntegralMethod { nodes, elements });
    Setup { region: SPACE, viscosity, method, ..Setup::default() }
}

/// The radius of the markers, and amplitudes of the velocities outward and along the sphere, of a degree.
fn response(radius: f64, count: usize, inside: f64, cortex: Cortex, degree: u32) -> [f64; 3] {
    let made = droplet(&Curve::circle(radius).expect("a good scene"), count, [inside, radius], cortex, degree);
    let made_radius = made.markers()[0].length();
    let mut scene = Scene::new(flow(48, count, 100.0).flow().expect("a good scene"));
    scene.add(made);
    scene.system_mut().evaluate().expect("a good scene");
    // The polygon has the area of the circle.
    let mut parts = [made_radius, 0.0, 0.0];
    for (k, v) in scene.system().markers().velocities().iter().enumerate().take(count / 2) {
        let (sin, cos) = (TAU * k as f64 / count as f64).sin_cos();
        let outward = v.x * cos + v.y * sin;
        let along = v.y * cos - v.x * sin;
        // Along the sphere by the slope of the harmonic.
        let slope = match degree {
            1 => -sin,
            2 => -3.0 * sin * cos,
            _ => -sin * (7.5 * cos * cos - 1.5),
        };
        parts[1] += outward * legendre(degree, cos) * sin;
        parts[2] += along * slope * sin;
    }
    parts
}

#[test]
fn modes_of_the_sphere() {
    for (inside, dilatational, shear) in
        [(100.0, 50.0, 0.0), (100.0, 100.0, 30.0), (20.0, 0.0, 50.0), (100.0, 1e5, 1e4)]
    {
        for radius in [1.0, 1e-6] {
            let cortex = Cortex { shear_viscosity: shear * radius, ..Cortex::new(dilatational * radius) };
            for degree in 1..=3 {
                let errors = |count: usize| {
                    let [plain, with] =
                        [Cortex::default(), cortex].map(|cortex| response(radius, count, inside, cortex, degree));
                    let size = plain[0] / radius;
                    let sphere = |dilatational: f64, shear: f64| {
                        let droplet = RoundDroplet {
                            radius: size,
                            viscosity_inside: inside,
                            viscosity_outside: 100.0,
                            tension: 10.0,
                            activity: -1.0,
                            concentration: 100.0,
                            diffusivity: 0.1,
                        };
                        let sphere = Sphere::new(droplet)
                            .expect("a good scene")
                            .with_cortex(dilatational)
                            .expect("a good scene");
                        let [[_, outward], [_, gathering]] = sphere
                            .with_shear_viscosity(shear)
                            .expect("a good scene")
                            .growth_matrix(degree)
                            .expect("a good scene");
                        let waves = f64::from(degree * (degree + 1));
                        // c0 (L w - 2 u)/R.
                        [outward, (size * (gathering + 0.1 * waves / (size * size)) / 100.0 + 2.0 * outward) / waves]
                    };
                    let (without, exact) = (sphere(0.0, 0.0), sphere(dilatational, shear));
                    [0, 1].map(|k| (with[k + 1] / plain[k + 1]) / (exact[k] / without[k]) - 1.0)
                };
                // Tensions are of second order in the segments.
                let (coarse, fine) = (errors(256), errors(512));
                let errors: [f64; 2] = [0, 1].map(|k| (4.0 * fine[k] - coarse[k]) / 3.0);
                println!("{inside} {dilatational} {shear} {radius} degree {degree}: {errors:?}");
                assert!(errors.iter().all(|error| error.abs() < 1e-6), "{errors:?}");
            }
        }
    }
}

#[test]
fn few_iterations_at_any_resolution() {
    for nodes in [72, 144] {
        for ([dilatational, shear], most) in
            [([20.0, 0.0], 18), ([200.0, 50.0], 18), ([0.0, 200.0], 18), ([2e4, 0.0], 18), ([2e4, 2e4], 30)]
        {
            let cortex = Cortex { shear_viscosity: shear, ..Cortex::new(dilatational) };
            let ellipse = Curve::ellipse(1.3, 1.0 / 1.3).expect("a good scene");
            let mut scene = Scene::new(flow(nodes, 2 * nodes, 100.0).flow().expect("a good scene"));
            scene.add(droplet(&ellipse, 2 * nodes, [50.0, 1.0], cortex, 1));
            scene.system_mut().evaluate().expect("a good scene");
            let evaluations = scene.system().work().evaluations;
            println!("{nodes} nodes, {cortex:?}: {evaluations}");
            assert!(evaluations <= most, "{nodes} nodes, {cortex:?}: {evaluations}");
        }
    }
}

#[test]
fn runs_end_at_the_steady_swimmer() {
    let cortex = Cortex { shear_viscosity: 30.0, ..Cortex::new(100.0) };
    let mut setup = flow(64, 256, 100.0);
    setup.droplets = vec![DropletSetup { cortex, ..DropletSetup::active(-1.5) }];
    setup.droplets[0].particles.as_mut().expect("a good scene").excluded_volume = ExcludedVolume::Step(2.0);
    let state = SteadyState::find(&setup).expect("a good scene").measured().expect("a good scene");
    let Built { mut scene, droplets, .. } = setup.build().expect("a good scene");
    scene.run(40.0).go().expect("a good scene");
    let seen = scene.observe(droplets[0]).expect("a good scene");
    let errors = [seen.speed() / state.speed - 1.0, seen.aspect_ratio_moments / state.aspect_ratio - 1.0];
    println!("{} {}: {errors:?}", seen.speed(), state.speed);
    assert!(errors.iter().all(|error| error.abs() < 2e-4), "{errors:?}");
}

fn swimmer(region: Region, cortex: Cortex) -> Setup {
    let method = Method::Integral(IntegralMethod { nodes: 32, elements: 96 });
    let droplets = vec![DropletSetup { cortex, ..DropletSetup::active(-1.5) }];
    Setup { region, method, droplets, ..Setup::default() }
}

#[test]
fn steps_stay_as_long_as_without() {
    let tube = Region::Tube { radius: 2.0, shape: TubeShape::Straight, drive: Drive::ZeroFlux, length: None };
    for region in [SPACE, tube] {
        let per_concentration = Cortex { per_concentration: 0.5, ..Cortex::default() };
        let large = Cortex { shear_viscosity: 1e3, ..Cortex::new(1e3) };
        let steps = |cortex: Cortex| {
            let Built { mut scene, droplets, .. } = swimmer(region, cortex).build().expect("a good scene");
            scene.run(2.0).go().expect("a good scene");
            let droplet = scene.body(droplets[0]).expect("a good scene");
            assert_eq!(droplet.tensions().len(), 96);
            (scene.steps(), scene.observe(droplets[0]).expect("a good scene").speed())
        };
        let (plain, fastest) = steps(Cortex::default());
        for cortex in [per_concentration, large] {
            let (with, speed) = steps(cortex);
            println!("{region:?} {cortex:?}: {with} steps, {plain} without, speeds {speed} {fastest}");
            assert!(with <= plain && speed < fastest);
        }
    }
}

#[test]
fn checkpoints_hold_the_stresses() {
    let setup = swimmer(SPACE, Cortex { shear_viscosity: 30.0, ..Cortex::new(100.0) });
    let Built { mut scene, droplets, .. } = setup.build().expect("a good scene");
    scene.run(0.3).go().expect("a good scene");
    let saved = scene.checkpoint("");
    let Built { scene: mut again, droplets: same, .. } = setup.build().expect("a good scene");
    again.resume(&saved).expect("a good scene");
    let tensions = |scene: &Scene<_>| scene.body(droplets[0]).expect("a good scene").tensions().to_vec();
    assert_eq!(tensions(&scene), again.body(same[0]).expect("a good scene").tensions().to_vec());
    scene.run(0.6).go().expect("a good scene");
    again.run(0.6).go().expect("a good scene");
    assert_eq!(scene.system().markers().positions(), again.system().markers().positions());
    // Another cortex, or none, takes the state over.
    for cortex in [Cortex::default(), Cortex::new(50.0)] {
        let mut other = setup.clone();
        other.droplets[0].cortex = cortex;
        let Built { scene: mut other, .. } = other.build().expect("a good scene");
        assert!(other.resume(&saved).is_err());
        other.take_over(&saved).expect("a good scene");
        other.run(0.4).go().expect("a good scene");
    }
}

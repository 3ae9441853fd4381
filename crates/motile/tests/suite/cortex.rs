//! Interfaces with a viscous cortex and with friction, against closed forms and independent programs.

use std::f64::consts::{PI, TAU};

use motile::active_interface::{
    ActiveDroplet, ContractileTension, Cortex, Curve, ExcludedVolume, InitialConcentration, Scene, Vec2,
};
use motile::prelude::*;
use motile::scene::{Body, Viscous};
use motile::setup::{
    DropletShape, Hold, InterfaceSetup, InterfaceShape, LayersMethod, Material, SolidOutline, SolidSetup, Start,
};

fn integral(nodes: usize, elements: usize) -> Method {
    Method::Integral(IntegralMethod { nodes, elements })
}

fn in_plane(viscosity: f64, method: Method) -> Setup {
    Setup { region: Region::Plane, viscosity, method, ..Setup::default() }
}

/// Resistances of a droplet: viscosity inside, cortex, friction.
#[derive(Clone, Copy)]
struct Law {
    inside: f64,
    cortex: Cortex,
    friction: f64,
}

/// A droplet with the concentration `100 (1 + amplitude cos(m theta))` and the tension `10 + slope c`.
fn droplet(curve: &Curve, markers: usize, law: Law, m: usize, amplitude: f64, slope: f64) -> ActiveDroplet {
    let markers = curve.markers(markers).expect("a good scene");
    let wave = move |angle: f64| 100.0 * (1.0 + amplitude * (m as f64 * angle).cos());
    let numbers = InitialConcentration::by_polar_angle(wave).particle_numbers(&markers).expect("a good scene");
    let tension = ContractileTension::new(10.0, -slope, ExcludedVolume::Step(0.0), 100.0).expect("a good scene");
    let made = ActiveDroplet::new(&markers, numbers, tension, 0.1).expect("a good scene");
    let made = made.with_viscosity_inside(law.inside).expect("a good scene");
    made.with_cortex(law.cortex).expect("a good scene").with_friction(law.friction).expect("a good scene")
}

/// The radius of a circle through the markers, the amplitudes of cos(m theta) of the tension of the law and the outward
/// velocity, and of sin(m theta) of the velocity along it, for tension in that mode.
fn response(setup: &Setup, radius: f64, law: Law, m: usize) -> [f64; 4] {
    let count = 256;
    let made = droplet(&Curve::circle(radius).expect("a good scene"), count, law, m, 0.3, 2.0);
    let angle = |k: f64| TAU * k / count as f64;
    let wave = |k: f64| 2.0 / count as f64 * (m as f64 * angle(k)).cos();
    let radius = made.markers()[0].length();
    let mut scene = Scene::new(setup.flow().expect("a good scene"));
    let handle = scene.add(made);
    scene.system_mut().evaluate().expect("a good scene");
    let concentrations = scene.body(handle).expect("a good scene").concentrations();
    let tension: f64 = concentrations.iter().enumerate().map(|(k, c)| 2.0 * c * wave(k as f64 + 0.5)).sum();
    assert!((tension / 60.0 - 1.0).abs() < 1e-3);
    let markers = scene.system().markers();
    let [mut outward, mut along] = [0.0; 2];
    for (k, v) in markers.velocities().iter().enumerate() {
        let (sin, cos) = angle(k as f64).sin_cos();
        outward += v.dot(Vec2::new(cos, sin)) * wave(k as f64);
        along += v.dot(Vec2::new(-sin, cos)) * 2.0 / count as f64 * (m as f64 * angle(k as f64)).sin();
    }
    [radius, tension, outward, along]
}

/// With Sigma_m = Sigma + m eta_s/(2R): the tension mode moves along a circle at `-gamma_m/(2 Sigma_m)` and leaves it
/// round, the droplet at `gamma_1/(4 Sigma + 2 eta_s/R)`. With friction, a = xi R/(2 Sigma), d = (m + a)^2 - 1: the
/// closed forms of the plane, in which all friction adds up to zero.
#[test]
fn modes_of_a_circle() {
    for (radius, inside, outside) in [(1.0, 100.0, 100.0), (1.3, 70.0, 130.0)] {
        let (setup, sigma) = (in_plane(outside, integral(64, 256)), inside + outside);
        for m in 1..=3 {
            let mode = m as f64;
            for viscosity in [50.0, 150.0, 1e6] {
                let law = Law { inside, cortex: Cortex::new(viscosity), friction: 0.0 };
                let [r, tension, outward, along] = response(&setup, radius, law, m);
                let exact = -tension / (2.0 * sigma + mode * viscosity / r);
                if m == 1 {
                    let exact = -tension / (4.0 * sigma + 2.0 * viscosity / r);
                    assert!((outward / exact - 1.0).abs() < 1e-8 && (along / exact - 1.0).abs() < 1e-8);
                } else {
                    assert!((along / exact - 1.0).abs() < 1e-8, "{m} {viscosity}: {along} {exact}");
                    assert!(outward.abs() < 1e-8 * along.abs());
                }
            }
            for friction in [20.0, 90.0, 1e5] {
                let law = Law { inside, cortex: Cortex::default(), friction };
                let [r, tension, outward, along] = response(&setup, radius, law, m);
                let a = friction * r / (2.0 * sigma);
                let d = (mode + a).powi(2) - 1.0;
                let exact = if m == 1 {
                    [-tension / (4.0 * sigma + friction * r); 2]
                } else {
                    [a / d, (mode * mode + mode * a - 1.0) / d].map(|part| -tension / (2.0 * sigma) * part)
                };
                for (found, exact) in [outward, along].into_iter().zip(exact) {
                    assert!((found / exact - 1.0).abs() < 1e-8, "{m} {friction}: {found} {exact}");
                }
            }
        }
    }
}

/// Both together: (C + friction) (u, w) = drive, by the 2 x 2 matrix of the mode.
#[test]
fn cortex_and_friction_together() {
    let (setup, sigma, viscosity, friction) = (in_plane(130.0, integral(64, 256)), 200.0, 150.0, 90.0);
    let law = Law { inside: 70.0, cortex: Cortex::new(viscosity), friction };
    for m in 2..=4 {
        let [r, tension, outward, along] = response(&setup, 1.3, law, m);
        let mode = m as f64;
        let (fluid, cortex) = (2.0 * sigma / r, viscosity / (r * r));
        let [xx, xy, yy] =
            [mode * fluid + cortex + friction, fluid + mode * cortex, mode * fluid + mode * mode * cortex + friction];
        let drive = [-tension / r, -tension * mode / r];
        let determinant = xx * yy - xy * xy;
        let exact = [(yy * drive[0] - xy * drive[1]) / determinant, (xx * drive[1] - xy * drive[0]) / determinant];
        for (found, exact) in [outward, along].into_iter().zip(exact) {
            assert!((found - exact).abs() < 1e-7 * along.abs(), "{m}: {found} {exact}");
        }
    }
}

/// A cortex that follows its particles, eta_s = e0 + e1 cos theta (tridiagonal system of the modes, 200 of them).
#[test]
fn a_cortex_that_follows_its_particles() {
    for (amplitude, viscosity, per_concentration, exact) in
        [(0.8, 25.0, 1.25, 9.213_785_358_57e-4), (1.0, 0.0, 2.0, 8.730_870_019_79e-4)]
    {
        let law =
            Law { inside: 100.0, cortex: Cortex { viscosity, per_concentration, ..Cortex::default() }, friction: 0.0 };
        let slope = 1.0 / (100.0 * amplitude);
        let made = droplet(&Curve::circle(1.0).unwrap(), 1024, law, 1, amplitude, slope);
        let mut scene = Scene::new(in_plane(100.0, integral(128, 1024)).flow().unwrap());
        let handle = scene.add(made);
        let seen = scene.observe(handle).unwrap();
        assert!((seen.velocity.x / -exact - 1.0).abs() < 1e-5, "{} {exact}", seen.velocity.x);
        let evaluations = scene.system().work().evaluations;
        assert!(evaluations < 60, "{evaluations}");
    }
}

/// Iterations do not grow with the number of nodes, nor with the viscosity of the cortex.
#[test]
fn few_iterations_at_any_resolution() {
    for nodes in [64, 128, 256] {
        let evaluations = |markers: usize, [inside, cortex, friction]: [f64; 3]| {
            let law = Law { inside, cortex: Cortex::new(cortex), friction };
            let ellipse = Curve::ellipse(1.6, 1.0 / 1.6).unwrap();
            let mut scene = Scene::new(in_plane(1.0, integral(nodes, markers)).flow().unwrap());
            scene.add(droplet(&ellipse, markers, law, 1, 0.3, 0.01));
            scene.system_mut().evaluate().unwrap();
            scene.system().work().evaluations
        };
        assert_eq!(evaluations(nodes, [1.0, 0.0, 0.0]), 1);
        for ratio in [0.1, 1.0, 10.0, 100.0, 1e4] {
            for markers in [nodes, 2 * nodes, 5 * nodes] {
                let all = [[1.0, 2.0 * ratio, 0.0], [10.0, 2.0 * ratio, 0.0], [1.0, 0.0, 2.0 * ratio]];
                let found = all.map(|law| evaluations(markers, law));
                assert!(found.iter().all(|&count| count <= 18), "{nodes} nodes, {markers}, {ratio}: {found:?}");
            }
        }
        let found = evaluations(2 * nodes, [1.0, 20.0, 20.0]);
        assert!(found <= 20, "{nodes} nodes, both: {found}");
    }
}

/// Speed, and largest and smallest concentration over the mean, of a swimmer of activity -2 after a while.
fn swims(region: Region, viscosity: f64, elements: usize, time: f64) -> ([f64; 3], f64) {
    let droplet = DropletSetup { cortex: Cortex::new(viscosity), ..DropletSetup::active(-2.0) };
    let setup = Setup { region, method: integral(64, elements), droplets: vec![droplet], ..Setup::default() };
    let Built { mut scene, droplets, .. } = setup.build().expect("a good scene");
    scene.run(time).go().expect("a good scene");
    let seen = scene.observe(droplets[0]).expect("a good scene");
    let [most, least] = seen.concentration_range.expect("a good scene");
    ([seen.speed(), most / 100.0, least / 100.0], seen.aspect_ratio_moments)
}

/// Round swimmers in the plane are exact one-dimensional problems (Newton's method, 512 points).
#[test]
fn swimmers_in_the_plane() {
    for (viscosity, exact) in [
        (20.0, [0.129_710_816_2, 2.303_091_115_67, 0.024_007_445_635]),
        (200.0, [0.098_707_296_1, 2.285_999_392_71, 0.063_073_966_776]),
        (800.0, [0.058_442_227_2, 2.189_454_145_77, 0.233_606_704_606]),
    ] {
        let (found, aspect_ratio) = swims(Region::Plane, viscosity, 512, 70.0);
        assert!((found[0] - exact[0]).abs() < 6e-6, "{viscosity}: {found:?}");
        assert!((found[1] - exact[1]).abs() < 1e-3 && (found[2] - exact[2]).abs() < 2e-4, "{viscosity}: {found:?}");
        assert!((aspect_ratio - 1.0).abs() < 2e-5, "{viscosity}: {aspect_ratio}");
    }
}

/// In a box of side 6 (an independent boundary-integral program).
#[test]
fn swimmer_in_a_box() {
    let ([speed, most, _], aspect_ratio) = swims(Region::Box { lengths: [6.0; 2] }, 100.0, 512, 60.0);
    assert!((speed - 0.107_707_4).abs() < 5e-6, "{speed}");
    assert!((most - 2.297_393).abs() < 1e-4 && (aspect_ratio - 1.021_099).abs() < 2e-5, "{most} {aspect_ratio}");
}

/// A wave of the concentration on a flat interface grows at `-zeta c0 q/(2 Sigma_q) - D q^2`, Sigma_q = Sigma + q
/// eta_s/2.
#[test]
fn flat_interface() {
    let (length, viscosity) = (TAU, 120.0);
    let particles = Particles {
        activity: -1.0,
        start: Start::Uniform,
        excluded_volume: ExcludedVolume::Step(0.0),
        ..Particles::default()
    };
    let interface = InterfaceSetup {
        cortex: Cortex::new(viscosity),
        particles: Some(Particles { start: Start::Perturbed { amplitude: 1e-4, seed: 3 }, ..particles }),
        shape: InterfaceShape::Flat,
        ..InterfaceSetup::default()
    };
    let setup = Setup {
        region: Region::Box { lengths: [length, 12.0 * PI] },
        method: integral(32, 256),
        interfaces: vec![interface],
        droplets: Vec::new(),
        ..Setup::default()
    };
    let Built { mut scene, interfaces, .. } = setup.build().unwrap();
    let amplitude = |scene: &Scene<_>, m: f64| {
        let body = scene.body(interfaces[0]).unwrap();
        let count = body.concentrations().len() as f64;
        let waves = body.concentrations().iter().enumerate().map(|(k, c)| {
            let (sin, cos) = (m * TAU * (k as f64 + 0.5) / count).sin_cos();
            Vec2::new(c * cos, c * sin)
        });
        (waves.sum::<Vec2>() / count).length()
    };
    let before = [1.0, 2.0].map(|m| amplitude(&scene, m));
    scene.run(1.0).step_size(StepSize::Fixed(0.01)).go().unwrap();
    for (m, before) in [1.0, 2.0].into_iter().zip(before) {
        let rate = (amplitude(&scene, m) / before).ln();
        let exact = 100.0 * m / (2.0 * (200.0 + 0.5 * m * viscosity)) - 0.1 * m * m;
        assert!((rate - exact).abs() < 2e-4, "{m}: {rate} {exact}");
    }
}

/// Viscous tensions are eta_s times the rates of stretching, and friction xi times the velocities, by the velocities
/// that the bodies see: of near droplets, of other viscosity, beside a viscous solid, in a channel.
#[test]
fn stresses_belong_to_velocities() {
    let small = |x: f64, viscosity: Option<f64>| DropletSetup {
        centre: [x, 0.1],
        cortex: Cortex::new(150.0),
        viscosity,
        ..DropletSetup::active(-2.0).with_radius(0.6)
    };
    let channel = |width: f64| Region::Channel { length: 6.0, width, drive: Drive::Flux(0.3) };
    let near = vec![small(-0.63, None), DropletSetup { friction: 20.0, ..small(0.63, Some(500.0)) }];
    let outline = SolidOutline::Disc { centre: [2.3, 0.0], radius: 0.5 };
    let material = Material::Springs { shear: 50.0 };
    let solid = SolidSetup { viscosity: Some(400.0), hold: Hold::Free, ..SolidSetup::new(outline, material) };
    let layers = Method::Layers(LayersMethod { nodes: 32, elements: 64, ..LayersMethod::of_spacing(0.1) });
    let base = Setup { droplets: near.clone(), method: integral(48, 128), ..Setup::default() };
    let scenes = [
        Setup { region: Region::Plane, ..base.clone() },
        Setup { region: channel(2.0), ..base.clone() },
        Setup { method: layers, solids: vec![solid.clone()], region: channel(3.0), ..base.clone() },
        Setup {
            method: layers,
            solids: vec![solid],
            droplets: vec![DropletSetup { friction: 20.0, ..small(-0.63, None) }],
            ..base.clone()
        },
    ];
    for (number, setup) in scenes.into_iter().enumerate() {
        let Built { mut scene, droplets, solids, .. } = setup.build().unwrap();
        scene.step(0.01).unwrap();
        scene.system_mut().evaluate().unwrap();
        let markers = scene.system().markers();
        let of = |index: usize| markers.velocities()[markers.groups()[index].range.clone()].to_vec();
        let check = |body: &mut dyn Viscous, velocities: &[Vec2]| {
            let [mut rates, mut compliances] = [0; 2].map(|_| vec![0.0; body.stress_count()]);
            body.write_rates(velocities, &mut rates);
            body.write_compliances(&mut compliances);
            let stresses = body.stresses().to_vec();
            let mut size = |rates: &[f64]| {
                let mut improved = rates.to_vec();
                body.precondition(&mut improved);
                improved.iter().zip(rates).map(|(a, b)| a * b).sum::<f64>().sqrt()
            };
            let all = size(&rates);
            for ((rate, compliance), stress) in rates.iter_mut().zip(&compliances).zip(&stresses) {
                *rate -= compliance * stress;
            }
            assert!(size(&rates) < 1e-5 * all && all > 0.0, "{number}: {} {all}", size(&rates));
        };
        for (index, handle) in droplets.iter().enumerate() {
            let mut body = scene.body(*handle).unwrap().clone();
            // In the plane, velocities are relative to a substrate that floats.
            if setup.region != Region::Plane {
                check(body.as_viscous().unwrap(), &of(index));
            }
        }
        for (index, handle) in solids.iter().enumerate() {
            let mut body = scene.body(*handle).unwrap().clone();
            check(body.as_viscous().unwrap(), &of(droplets.len() + index));
        }
    }
}

/// A swimmer with a cortex and friction in a channel, by all methods that compute it.
#[test]
fn methods_agree() {
    let droplet = DropletSetup { cortex: Cortex::new(100.0), friction: 20.0, ..DropletSetup::active(-2.0) };
    let region = Region::Channel { length: 6.0, width: 3.0, drive: Drive::ZeroGradient };
    let run = |method: Method, step: StepSize| {
        let setup = Setup { region, method, droplets: vec![droplet.clone()], ..Setup::default() };
        let Built { mut scene, droplets, .. } = setup.build().unwrap();
        scene.run(1.0).step_size(step).go().unwrap();
        let seen = scene.observe(droplets[0]).unwrap();
        [seen.centroid.x, seen.speed(), seen.moments.stresslet()[0][0]]
    };
    let usual = StepSize::default();
    let [_, speed, stresslet] = run(integral(48, 128), usual);
    for (method, tolerance) in [
        (Method::Layers(LayersMethod { nodes: 48, elements: 128, ..LayersMethod::of_spacing(0.1) }), 1e-6),
        (Method::Grid(GridMethod { spacing: 0.1, ..GridMethod::default() }), 0.01),
    ] {
        let [_, found, dipole] = run(method, usual);
        assert!((found / speed - 1.0).abs() < tolerance, "{method:?}: {found} {speed}");
        assert!((dipole / stresslet - 1.0).abs() < 4.0 * tolerance, "{method:?}: {dipole} {stresslet}");
    }
}

/// Of a drop that relaxes, because particles need shorter steps for their order to show.
#[test]
fn steps_are_of_second_order() {
    let run = |dt: f64| {
        let shape = DropletShape::Ellipse { half_axes: [1.4, 0.7] };
        let droplet = DropletSetup { cortex: Cortex::new(300.0), shape, ..DropletSetup::passive(100.0) };
        let setup = Setup { droplets: vec![droplet], ..in_plane(100.0, integral(48, 80)) };
        let Built { mut scene, droplets, .. } = setup.build().unwrap();
        scene.run(1.0).step_size(StepSize::Fixed(dt)).go().unwrap();
        scene.observe(droplets[0]).unwrap().shape.deformation()
    };
    let found = [0.05, 0.025, 0.0125, 0.00625].map(run);
    let [first, second, third] = [0, 1, 2].map(|k| found[k] - found[k + 1]);
    assert!((3.6..5.0).contains(&(first / second)) && (3.7..4.5).contains(&(second / third)), "{found:?}");
}

/// A run that goes on from a checkpoint is bitwise the same, tensions included.
#[test]
fn checkpoints_hold_the_stresses() {
    let droplet = DropletSetup { cortex: Cortex::new(100.0), friction: 20.0, ..DropletSetup::active(-2.0) };
    let setup = Setup {
        region: Region::Box { lengths: [6.0; 2] },
        method: integral(32, 96),
        droplets: vec![droplet],
        ..Setup::default()
    };
    let Built { mut scene, droplets, .. } = setup.build().unwrap();
    scene.run(0.3).go().unwrap();
    let saved = scene.checkpoint("");
    let Built { scene: mut again, droplets: same, .. } = setup.build().unwrap();
    again.resume(&saved).unwrap();
    let tensions = |scene: &Scene<_>| scene.body(droplets[0]).unwrap().tensions().to_vec();
    assert_eq!(tensions(&scene), again.body(same[0]).unwrap().tensions().to_vec());
    scene.run(0.6).go().unwrap();
    again.run(0.6).go().unwrap();
    assert_eq!(scene.system().markers().positions(), again.system().markers().positions());
    // Another cortex, or none, takes the state over.
    for cortex in [0.0, 50.0] {
        let mut other = setup.clone();
        (other.droplets[0].cortex, other.droplets[0].friction) = (Cortex::new(cortex), 0.0);
        let Built { scene: mut other, .. } = other.build().unwrap();
        assert!(other.resume(&saved).is_err());
        other.take_over(&saved).unwrap();
        other.run(0.4).go().unwrap();
    }
}

#[test]
fn impossible_resistances_are_refused() {
    let refused = |setup: &Setup| setup.build().map(|_| ()).unwrap_err().to_string();
    let of = |change: &dyn Fn(&mut DropletSetup), method: Method| {
        let mut droplet = DropletSetup::active(-2.0);
        change(&mut droplet);
        Setup { method, droplets: vec![droplet], ..Setup::default() }
    };
    let smooth = || integral(32, 96);
    let found = refused(&of(&|droplet| droplet.cortex.viscosity = -1.0, smooth()));
    assert!(found.starts_with("droplets[0].cortex.viscosity = -1"), "{found}");
    let found = refused(&of(&|droplet| droplet.friction = f64::NAN, smooth()));
    assert!(found.starts_with("droplets[0].friction = NaN"), "{found}");
    let bare = |droplet: &mut DropletSetup| (droplet.cortex.per_concentration, droplet.particles) = (1.0, None);
    let found = refused(&of(&bare, smooth()));
    assert!(found.contains("cortex.per-concentration") && found.contains("no particles"), "{found}");
    let found = refused(&of(&|droplet| droplet.cortex.viscosity = 1.0, Method::Grid(GridMethod::uncorrected(0.1))));
    assert!(found.contains("corrected") && found.contains("cortex"), "{found}");
}

/// Round drops rest, whatever the round-off of their velocities is.
#[test]
fn drops_at_rest_stay() {
    for (region, friction) in [(Region::Plane, 0.0), (Region::Plane, 3.0), (Region::Box { lengths: [6.0; 2] }, 3.0)] {
        for viscosity in [None, Some(1000.0)] {
            let droplet =
                DropletSetup { cortex: Cortex::new(50.0), friction, viscosity, ..DropletSetup::passive(10.0) };
            let setup = Setup { region, method: integral(32, 80), droplets: vec![droplet], ..Setup::default() };
            let Built { mut scene, droplets, .. } = setup.build().unwrap();
            scene.run(1.0).go().unwrap();
            let seen = scene.observe(droplets[0]).unwrap();
            assert!(!seen.moves && seen.speed() < 1e-9, "{region:?} {friction} {viscosity:?}: {}", seen.speed());
        }
    }
}

/// Two interfaces much closer than nodes are have a quarter of the stable step of one, and far ones the same step.
#[test]
fn near_interfaces_take_shorter_steps() {
    let limit = |gap: f64| {
        let of = |side: f64| {
            let particles = Particles { start: Start::Uniform, ..Particles::default() };
            let centre = [side * (1.0 + 0.5 * gap), 0.0];
            DropletSetup { centre, particles: Some(particles), ..DropletSetup::default() }
        };
        let setup = Setup { droplets: vec![of(-1.0), of(1.0)], ..in_plane(100.0, integral(32, 96)) };
        let Built { mut scene, .. } = setup.build().unwrap();
        scene.system_mut().evaluate().unwrap();
        let mut found = f64::INFINITY;
        scene.system().each_limit(&mut |limit, _| {
            if limit.reason.starts_with("the coupling") {
                found = found.min(limit.dt);
            }
        });
        found
    };
    let far = limit(3.0);
    assert!((limit(1.0) / far - 1.0).abs() < 1e-12);
    let ratios = [0.5, 0.2, 0.05, 0.002].map(|gap| limit(gap) / far);
    assert!(ratios[0] > 0.8 && ratios.is_sorted_by(|a, b| a > b) && (0.25..0.27).contains(&ratios[3]), "{ratios:?}");
}

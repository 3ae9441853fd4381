//! Droplets with a rigid core or a shell inside against exact solutions.

use std::f64::consts::TAU;

use motile::base::Region;
use motile::base::{FlowSample, Vec2};
use motile::elastic_solids::{BendingMeasure, Shell};
use motile::scene::{Hydrodynamics, MarkerKind, Markers, Scene, SceneError, StepSize, checkpoint::Checkpoint};
use motile::setup::{
    Built, DropletSetup, DropletShape, ExcludedVolume, Hold, IntegralMethod, LayersMethod, Material, Method, Particles,
    RigidBodySetup, Setup, ShellSetup, SolidOutline, SolidSetup, Start,
};
use motile_tests::validation::scene::flow;

const NODES: usize = 128;

fn angle(k: usize) -> f64 {
    TAU * k as f64 / NODES as f64
}

fn integrals() -> Method {
    Method::Integral(IntegralMethod { nodes: NODES, elements: NODES })
}

/// Amplitudes of cos(m theta) in the normal components and of sin(m theta) in the tangential ones.
fn amplitudes(velocities: &[Vec2], m: usize) -> [f64; 2] {
    let waves = velocities.iter().enumerate().map(|(k, v)| {
        let (normal, phase) = (Vec2::from_angle(angle(k)), m as f64 * angle(k));
        [v.dot(normal) * phase.cos(), v.dot(normal.perp()) * phase.sin()]
    });
    waves.fold([0.0; 2], |[a, b], [u, w]| [a + u, b + w]).map(|sum| 2.0 * sum / velocities.len() as f64)
}

/// The matrix by which the fluid around a concentric rigid disc of that radius resists modes of a unit circle, in units
/// of twice its viscosity: entries rr, rt, tt.
fn resistance(m: usize, radius: f64) -> [f64; 3] {
    let (order, square) = (m as f64, radius * radius);
    let power = square.powi(m as i32);
    let bottom = square * (1.0 - power).powi(2) - order * order * power * (1.0 - square).powi(2);
    let shared = power * (1.0 - square);
    [
        order * square * (1.0 - power * power) + shared * (order * order * (3.0 - square) - 4.0),
        square * (1.0 - power * power) + order * shared * (order * order * (1.0 - square) - 2.0),
        order * square * (1.0 - power * power) - order * order * power * (1.0 - square * square),
    ]
    .map(|top| top / bottom)
}

/// Velocities (normal, tangential) for a force of a mode on a circle around a rigid core: exterior viscosity of 1.
fn response(m: usize, radius: f64, inside: f64, [normal, tangential]: [f64; 2]) -> [f64; 2] {
    let order = m as f64;
    let [rr, rt, tt] = resistance(m, radius).map(|value| inside * value);
    let [a, b, d] = [2.0 * (order + rr), 2.0 * (1.0 + rt), 2.0 * (order + tt)];
    let determinant = a * d - b * b;
    [(d * normal - b * tangential) / determinant, (a * tangential - b * normal) / determinant]
}

/// A circle around a rigid disc with a force of a mode per length on it.
fn cell(m: usize, radius: f64, inside: f64, [normal, tangential]: [f64; 2]) -> Markers {
    let mut markers = Markers::new();
    markers.push_group(NODES, MarkerKind::Interface { viscosity_inside: Some(inside) });
    markers.push_group(NODES, MarkerKind::Rigid);
    markers.set_viscosity_outside(1, Some(inside)).expect("a viscosity");
    for k in 0..NODES {
        let (outward, phase) = (Vec2::from_angle(angle(k)), m as f64 * angle(k));
        let force = normal * phase.cos() * outward + tangential * phase.sin() * outward.perp();
        markers.positions_mut()[k] = outward;
        markers.positions_mut()[NODES + k] = radius * outward;
        markers.forces_mut()[k] = TAU / NODES as f64 * force;
    }
    markers
}

#[test]
fn modes_around_a_rigid_core_move_as_in_closed_form() {
    let mut worst = 0.0_f64;
    for inside in [0.1, 1.0, 10.0, 100.0] {
        for radius in [0.1, 0.3, 0.5, 0.7, 0.9] {
            for m in 1..=4 {
                let mut flow = flow(Region::Plane, integrals(), 1.0, 1e-12).unwrap();
                // A tension of amplitude one, and, beyond translations, a pressure.
                for force in [[-1.0, -(m as f64)], [1.0, 0.0]].into_iter().take(if m == 1 { 1 } else { 2 }) {
                    let mut markers = cell(m, radius, inside, force);
                    flow.velocities(&mut markers).unwrap();
                    let found = amplitudes(&markers.velocities()[..NODES], m);
                    let exact = if m == 1 {
                        let part = radius.powi(4);
                        let speed = -0.25 / (1.0 + inside * (1.0 + part) / (1.0 - part));
                        let core = markers.velocities()[NODES..].iter().sum::<Vec2>() / NODES as f64;
                        assert!((core.x * (1.0 + radius * radius) / (2.0 * speed) - 1.0).abs() < 1e-8);
                        [speed; 2]
                    } else {
                        response(m, radius, inside, force)
                    };
                    let size = exact[0].hypot(exact[1]);
                    let error = (found[0] - exact[0]).hypot(found[1] - exact[1]) / size;
                    worst = worst.max(error);
                    assert!(error < 1e-8, "{inside} {radius} {m}: {found:?} {exact:?}");
                }
            }
        }
    }
    println!("largest error {worst:e}");
}

/// Mode 2 of the empty droplet grows or decays; with a core its shape and its concentration drive one another.
#[test]
fn a_core_makes_mode_two_oscillate() {
    let (inside, outside, activity, tension, radius, amplitude) = (1000.0, 10.0, -7.0, 10.0, 0.75, 1e-5);
    let particles =
        Particles { activity, excluded_volume: ExcludedVolume::None, start: Start::Uniform, ..Particles::default() };
    let (concentration, diffusion) = (particles.concentration, particles.diffusion);
    let shape = DropletShape::Modes { radius: 1.0, cosines: vec![0.0, amplitude], sines: Vec::new() };
    let droplet =
        DropletSetup { tension, viscosity: Some(inside), shape, particles: Some(particles), ..DropletSetup::default() };
    let setup = |elements: usize| Setup {
        region: Region::Plane,
        method: Method::Integral(IntegralMethod { nodes: 32, elements }),
        viscosity: outside,
        step: StepSize::OfLimit(0.25),
        droplets: vec![droplet.clone()],
        rigid_bodies: vec![RigidBodySetup::disc(radius)],
        ..Setup::default()
    };
    // d/dt of concentration and shape, from the velocities that each makes.
    let mean_tension = tension - activity * concentration;
    let rates = |[c, r]: [f64; 2]| {
        let gamma = -activity * c;
        let force = [-gamma - 3.0 * mean_tension * r, -2.0 * gamma];
        let [u, w] = response(2, radius, inside / outside, force.map(|value| value / outside));
        [-concentration * (2.0 * w + u) - 4.0 * diffusion * c, u]
    };
    let ([p, q], [r, s]) = (rates([1.0, 0.0]), rates([0.0, 1.0]));
    let (mean, determinant) = (0.5 * (p + s), p * s - q * r);
    let frequency = (determinant - mean * mean).sqrt();
    println!("growth {mean:.5}, frequency {frequency:.5}");
    assert!(mean > 0.04 && frequency > 0.08);

    let errors = [96, 192].map(|cells| {
        let Built { mut scene, droplets, .. } = setup(cells).build().unwrap();
        let (mut error, mut sign_changes, mut last) = (0.0_f64, 0, amplitude);
        for step in 1..=30 {
            let time = 3.0 * f64::from(step);
            scene.run(time).go().unwrap();
            let markers = scene.body(droplets[0]).unwrap().markers();
            let waves = markers.iter().map(|x| (x.length() - 1.0) * (2.0 * x.to_angle()).cos());
            let shape = 2.0 / markers.len() as f64 * waves.sum::<f64>();
            let (sine, cosine) = (frequency * time).sin_cos();
            let grown = amplitude * (mean * time).exp();
            let exact = grown * (cosine + (s - mean) / frequency * sine);
            error = error.max((shape - exact).abs() / grown);
            sign_changes += usize::from(shape * last < 0.0);
            last = shape;
        }
        assert!(sign_changes >= 2, "{sign_changes}");
        error
    });
    println!("errors {errors:?}");
    assert!(errors[1] < 1e-2 && errors[0] > 3.0 * errors[1], "{errors:?}");
}

/// Rates of change of normal and tangential displacements cos(k theta) and sin(k theta) of a ring, their trace and
/// determinant.
fn ring(k: usize, measure: BendingMeasure, [stretching, bending]: [f64; 2], viscosities: [f64; 2]) -> [f64; 2] {
    let rest: Vec<Vec2> = (0..NODES).map(|i| Vec2::from_angle(angle(i))).collect();
    let rates = |column: usize| {
        let step = 1e-4;
        let found = [1.0, -1.0].map(|sign| {
            let moved = (0..NODES).map(|i| {
                let (out, phase) = (Vec2::from_angle(angle(i)), k as f64 * angle(i));
                out + sign * step * if column == 0 { phase.cos() * out } else { phase.sin() * out.perp() }
            });
            let shell = Shell::new(&rest, stretching, bending).expect("a valid shell").with_measure(measure);
            let shell = shell.deformed(&moved.collect::<Vec<_>>()).expect("a valid shell");
            let shell = shell.with_viscosity_inside(viscosities[0]).expect("a valid shell");
            let mut scene = Scene::new(flow(Region::Plane, integrals(), viscosities[1], 1e-12).expect("a valid shell"));
            let shell = scene.add(shell);
            scene.system_mut().evaluate().expect("a valid shell");
            amplitudes(scene.system().flow_at(shell).expect("a valid shell").velocities, k)
        });
        [0, 1].map(|row| (found[0][row] - found[1][row]) / (2.0 * step))
    };
    let [[a, b], [c, d]] = [rates(0), rates(1)];
    [a + d, a * d - b * c]
}

#[test]
fn shells_relax_at_their_rates_by_both_measures_of_bending() {
    let (moduli, viscosities) = ([3.0, 0.4], [10.0, 1.0]);
    let total = viscosities[0] + viscosities[1];
    let (e, b) = (moduli[0] / (2.0 * total), moduli[1] / (2.0 * total));
    for k in 2..=6 {
        let n = k as f64;
        for (measure, trace, determinant) in [
            (BendingMeasure::Curvature, -b * n * (n * n - 1.0) - n * e, b * n * (n * n - 1.0) * n * e),
            (BendingMeasure::TurningAngle, -b * n.powi(3) - e * n, b * e * n * n * (n * n - 1.0)),
        ] {
            let found = ring(k, measure, moduli, viscosities);
            let error = (found[0] / trace - 1.0).abs().max((found[1] / determinant - 1.0).abs());
            println!("{k} {measure:?}: {error:e}");
            assert!(error < 1e-5, "{k} {measure:?}: {found:?}, {trace} {determinant}");
        }
    }
}

#[test]
fn nested_circles_relax_at_their_rates() {
    let (inner, tensions, viscosity) = (0.6, [2.0, 5.0], 3.0);
    let radii = [1.0, inner];
    for k in 2..=6 {
        // Rates of the shapes of both for a wave on one.
        let rates = |wavy: usize| {
            let step = 1e-4;
            let found = [1.0, -1.0].map(|sign| {
                let droplet = |index: usize| {
                    let mut cosines = vec![0.0; k];
                    cosines[k - 1] = if index == wavy { sign * step / radii[index] } else { 0.0 };
                    let shape = DropletShape::Modes { radius: radii[index], cosines, sines: Vec::new() };
                    DropletSetup { shape, ..DropletSetup::passive(tensions[index]) }
                };
                let droplets = vec![droplet(0), droplet(1)];
                let setup =
                    Setup { region: Region::Plane, method: integrals(), viscosity, droplets, ..Setup::default() };
                let Built { mut scene, droplets, .. } = setup.build().unwrap();
                scene.system_mut().evaluate().unwrap();
                droplets
                    .iter()
                    .map(|&handle| {
                        let flow = scene.system().flow_at(handle).unwrap();
                        let sum: f64 = flow
                            .positions
                            .iter()
                            .zip(flow.velocities)
                            .map(|(x, v)| {
                                let normal = x.normalize();
                                v.dot(normal) * (k as f64 * x.to_angle()).cos()
                            })
                            .sum();
                        2.0 * sum / NODES as f64
                    })
                    .collect::<Vec<_>>()
            });
            [0, 1].map(|index| (found[0][index] - found[1][index]) / (2.0 * step))
        };
        let n = k as f64;
        let g = n / (8.0 * viscosity) * (inner.powf(n - 1.0) / (n - 1.0) - inner.powf(n + 1.0) / (n + 1.0));
        let cross = n * n - 1.0;
        let exact = [
            [-n * tensions[0] / (4.0 * viscosity), -g * tensions[0] * cross],
            [-inner * g * tensions[1] * cross / (inner * inner), -n * tensions[1] / (4.0 * viscosity * inner)],
        ];
        for wavy in 0..2 {
            for (found, exact) in rates(wavy).into_iter().zip(exact[wavy]) {
                assert!((found / exact - 1.0).abs() < 1e-4, "{k} {wavy}: {found} {exact}");
            }
        }
    }
}

/// Where droplet and core are at the end of a short run, and the stresslet of both together.
fn moved(setup: &Setup) -> ([Vec2; 2], Vec2) {
    let Built { mut scene, droplets, solids, rigid_bodies, .. } = setup.build().expect("a valid scene");
    scene.run(0.6).go().expect("a run without trouble");
    let seen = scene.observe(droplets[0]).expect("a droplet");
    let core = match (solids.first(), rigid_bodies.first()) {
        (Some(&solid), _) => {
            let points = scene.body(solid).expect("a solid").positions();
            points.iter().sum::<Vec2>() / points.len() as f64
        }
        (None, Some(&body)) => scene.body(body).expect("a rigid body").centre(),
        (None, None) => Vec2::ZERO,
    };
    // In the axes of the laboratory: the directions of motion differ.
    ([seen.centroid, core], seen.stresslet_in_laboratory[0].into())
}

#[test]
fn an_elastic_core_tends_to_a_rigid_one_with_its_stiffness() {
    let (centre, radius) = ([0.1, 0.15], 0.45);
    let integral = IntegralMethod { nodes: 32, elements: 128 };
    let bare = Setup { method: Method::Integral(integral), ..Setup::default() };
    let rigid = Setup { rigid_bodies: vec![RigidBodySetup { centre, ..RigidBodySetup::disc(radius) }], ..bare.clone() };
    let (exact, stresslet) = moved(&rigid);
    let bare_stresslet = moved(&bare).1;
    assert!(bare_stresslet.distance(stresslet) > 0.1 * stresslet.length(), "{bare_stresslet} {stresslet}");
    let method = Method::Layers(LayersMethod { nodes: 32, elements: 128, ..LayersMethod::of_spacing(0.1) });
    let (layered, stresslet_of_layers) = moved(&Setup { method, ..rigid });
    assert!(stresslet_of_layers.distance(stresslet) < 1e-3 * stresslet.length(), "{stresslet_of_layers} {stresslet}");
    let apart = |found: [Vec2; 2]| found.iter().zip(&exact).map(|(a, b)| a.distance(*b)).fold(0.0, f64::max);
    assert!(apart(layered) < 1e-4 * exact[0].length(), "{layered:?} {exact:?}");
    let errors = [200.0, 2000.0, 8000.0].map(|shear| {
        let material = Material::NeoHookean { shear, bulk: 2.0 * shear };
        let disc = SolidSetup { hold: Hold::Free, ..SolidSetup::new(SolidOutline::Disc { centre, radius }, material) };
        let at_rest = {
            let points = Setup { method, solids: vec![disc.clone()], ..bare.clone() }.build().expect("a valid scene");
            let solid = points.scene.body(points.solids[0]).expect("a solid").positions();
            solid.iter().sum::<Vec2>() / solid.len() as f64 - Vec2::from(centre)
        };
        let ([droplet, core], found) = moved(&Setup { method, solids: vec![disc], ..bare.clone() });
        (apart([droplet, core - at_rest]) / exact[0].length(), found - stresslet)
    });
    let [(soft, _), (hard, away), (_, near)] = errors;
    println!("{errors:?}, stresslets {bare_stresslet} {stresslet}");
    assert!(hard < 0.012 && hard < 0.25 * soft, "{errors:?}");
    // Of first order in the softness.
    assert!(near.length() < 0.35 * away.length() && near.length() < 0.05 * stresslet.length(), "{errors:?}");
}

/// Relaxation takes energy and leaves the area.
#[test]
fn shells_keep_their_area() {
    let shape = DropletShape::Ellipse { half_axes: [0.6, 0.4] };
    let shell = ShellSetup { shape, bending: 0.02, reference_curvature: Some(2.0), ..ShellSetup::default() };
    let setup = Setup {
        region: Region::Plane,
        method: Method::Integral(IntegralMethod { nodes: 32, elements: 64 }),
        viscosity: 1.0,
        droplets: Vec::new(),
        shells: vec![shell],
        ..Setup::default()
    };
    let Built { mut scene, shells, .. } = setup.build().unwrap();
    let area = |points: &[Vec2]| {
        let pairs = points.iter().zip(points.iter().cycle().skip(1));
        0.5 * pairs.map(|(a, b)| a.perp_dot(*b)).sum::<f64>()
    };
    let energy = |scene: &Scene<_>| scene.body(shells[0]).unwrap().energy();
    let before = [area(scene.body(shells[0]).unwrap().markers()), energy(&scene)];
    scene.run(5.0).go().unwrap();
    let after = [area(scene.body(shells[0]).unwrap().markers()), energy(&scene)];
    println!("{before:?} {after:?}, {} steps", scene.steps());
    assert!(after[1] < 0.9 * before[1] && (after[0] / before[0] - 1.0).abs() < 1e-4, "{before:?} {after:?}");
}

/// On the way pictures are taken of one of them, and it is saved and resumed.
#[test]
fn cells_resume_bit_by_bit_and_looking_changes_nothing() {
    let layers = LayersMethod { nodes: 32, elements: 64, ..LayersMethod::of_spacing(0.2) };
    for method in [Method::Integral(IntegralMethod { nodes: 32, elements: 64 }), Method::Layers(layers)] {
        let setup = Setup {
            method,
            step: StepSize::Fixed(0.01),
            rigid_bodies: vec![RigidBodySetup { centre: [-0.4, 0.1], ..RigidBodySetup::disc(0.3) }],
            shells: vec![ShellSetup {
                centre: [0.45, 0.0],
                shape: DropletShape::Round { radius: 0.3 },
                viscosity: Some(300.0),
                ..ShellSetup::default()
            }],
            ..Setup::default()
        };
        let mut whole = setup.build().unwrap().scene;
        whole.run(0.08).go().unwrap();
        let mut parts = setup.build().unwrap().scene;
        assert!(matches!(parts.run(0.08).most_steps(5).go(), Err(SceneError::TooManySteps { .. })));
        let mut samples = [FlowSample::default(); 2];
        parts.system_mut().sample(&[Vec2::new(-0.4, 0.1), Vec2::new(0.9, 1.2)], &mut samples).unwrap();
        assert!(samples.iter().all(|sample| sample.velocity.length() > 1e-3), "{samples:?}");
        let saved = parts.checkpoint("").to_bytes().unwrap();
        parts = setup.build().unwrap().scene;
        parts.resume(&Checkpoint::from_bytes(&saved).unwrap()).unwrap();
        parts.run(0.08).go().unwrap();
        assert!(parts.checkpoint("").to_bytes().unwrap() == whole.checkpoint("").to_bytes().unwrap(), "{method:?}");
    }
}

//! Droplets with a rigid nucleus against closed forms.

use motile::active_interface::observables::{Convention, InterfaceState, observe};
use motile::prelude::*;
use motile::setup::{DropletSetup, DropletShape, ExcludedVolume, Particles, RigidBodySetup};
use motile_steady_states::{Continuation, Parameter, SpecialKind, SteadyState, Symmetry};
use num_complex::Complex64;

const OUTSIDE: f64 = 10.0;

fn setup(nodes: usize, ratio: f64, activity: f64, radius: f64) -> Setup {
    let particles = Particles { activity, excluded_volume: ExcludedVolume::None, ..Particles::default() };
    let droplet = DropletSetup {
        tension: 10.0,
        viscosity: Some(ratio * OUTSIDE),
        particles: Some(particles),
        ..DropletSetup::default()
    };
    Setup {
        region: Region::Plane,
        method: Method::Integral(IntegralMethod { nodes, elements: 4 * nodes }),
        viscosity: OUTSIDE,
        droplets: vec![droplet],
        rigid_bodies: vec![RigidBodySetup::disc(radius)],
        ..Setup::default()
    }
}

/// The matrix by which the fluid around a concentric rigid disc resists modes of a unit circle, in units of twice its
/// viscosity: entries rr, rt, tt.
fn resistance(m: i32, radius: f64) -> [f64; 3] {
    let (order, square) = (f64::from(m), radius * radius);
    let power = square.powi(m);
    let bottom = square * (1.0 - power).powi(2) - order * order * power * (1.0 - square).powi(2);
    let shared = power * (1.0 - square);
    [
        order * square * (1.0 - power * power) + shared * (order * order * (3.0 - square) - 4.0),
        square * (1.0 - power * power) + order * shared * (order * order * (1.0 - square) - 2.0),
        order * square * (1.0 - power * power) - order * order * power * (1.0 - square * square),
    ]
    .map(|top| top / bottom)
}

/// Growth rates of concentration and shape of a mode around a concentric nucleus; of mode 1, which has no shape of its
/// own, that of the concentration.
fn rates(m: i32, setup: &Setup) -> Vec<Complex64> {
    let droplet = &setup.droplets[0];
    let particles = droplet.particles.expect("particles");
    let radius = match setup.rigid_bodies[0].shape {
        DropletShape::Round { radius } => radius,
        _ => f64::NAN,
    };
    let (order, inside) = (f64::from(m), droplet.viscosity.unwrap_or(OUTSIDE) / OUTSIDE);
    let (c0, diffusion, activity) = (particles.concentration, particles.diffusion, particles.activity);
    if m == 1 {
        let part = radius.powi(4);
        let drift = 0.25 / (1.0 + inside * (1.0 + part) / (1.0 - part)) / OUTSIDE;
        return vec![Complex64::new(-2.0 * c0 * activity * drift - diffusion, 0.0)];
    }
    let mean = droplet.tension - activity * c0;
    let [rr, rt, tt] = resistance(m, radius).map(|value| inside * value);
    let [a, b, d] = [2.0 * (order + rr), 2.0 * (1.0 + rt), 2.0 * (order + tt)].map(|value| value * OUTSIDE);
    let respond = |[normal, tangential]: [f64; 2]| {
        [(d * normal - b * tangential) / (a * d - b * b), (a * tangential - b * normal) / (a * d - b * b)]
    };
    let column = |[c, r]: [f64; 2]| {
        let gamma = -activity * c;
        let [u, w] = respond([-gamma - (order * order - 1.0) * mean * r, -order * gamma]);
        [-c0 * (order * w + u) - order * order * diffusion * c, u]
    };
    let ([p, q], [r, s]) = (column([1.0, 0.0]), column([0.0, 1.0]));
    let (half, determinant) = (0.5 * (p + s), p * s - q * r);
    let root = Complex64::new(half * half - determinant, 0.0).sqrt();
    vec![half + root, half - root]
}

/// The circle around a concentric nucleus: all eigenvalues of modes 1 to 4, over sizes and viscosities. Where nothing
/// flows a nucleus may stay anywhere, which is an eigenvalue of zero.
#[test]
fn growth_rates_around_a_nucleus() {
    let mut worst = 0.0_f64;
    for ratio in [0.1, 1.0, 100.0] {
        for radius in [0.1, 0.5, 0.75] {
            let setup = setup(48, ratio, -0.3, radius);
            let spectrum = SteadyState::uniform(&setup).unwrap().spectrum().unwrap();
            for m in 1..=4 {
                for exact in rates(m, &setup) {
                    let nearest = |a: &&motile_steady_states::Eigenmode| (a.value - exact).norm();
                    let found = spectrum.modes.iter().min_by(|a, b| nearest(a).total_cmp(&nearest(b))).unwrap();
                    let error = (found.value - exact).norm() / exact.norm();
                    worst = worst.max(error);
                    assert!(error < 1e-6, "{ratio} {radius} {m}: {} {exact}", found.value);
                }
            }
            let neutral = spectrum.modes.iter().map(|mode| mode.value.norm()).fold(f64::INFINITY, f64::min);
            assert!(neutral < 1e-8, "{ratio} {radius}: {neutral:e}");
        }
    }
    println!("largest error {worst:e}");
}

/// The nucleus that makes mode 2 oscillate: 0.0465 and 0.0811 in a run.
#[test]
fn mode_two_oscillates() {
    let setup = setup(64, 100.0, -7.0, 0.75);
    let spectrum = SteadyState::uniform(&setup).unwrap().spectrum().unwrap();
    let exact = rates(2, &setup)[0];
    let found = spectrum.modes.iter().find(|mode| mode.value.im > 1e-3).unwrap().value;
    println!("{found} {exact}");
    assert!((found.re - exact.re).abs() < 1e-7 && (found.im - exact.im.abs()).abs() < 1e-7, "{found} {exact}");
    assert!((found.re - 0.0465).abs() < 1e-4 && (found.im - 0.0811).abs() < 1e-4);
}

/// A disc that starts aside stays there, and the droplet goes round in circles as that of a run does.
#[test]
fn a_disc_aside_makes_the_droplet_swim_in_stable_circles() {
    let nucleus = RigidBodySetup { centre: [0.0, 0.4], ..RigidBodySetup::disc(0.5) };
    let aside = Setup {
        viscosity: 100.0,
        droplets: vec![DropletSetup::active(-2.0)],
        rigid_bodies: vec![nucleus],
        ..setup(64, 1.0, -2.0, 0.5)
    };
    let [coarse, circle] = [64, 96].map(|nodes| {
        let method = Method::Integral(IntegralMethod { nodes, elements: 4 * nodes });
        SteadyState::find(&Setup { method, ..aside.clone() }).expect("a circle")
    });
    let [rough, spectrum] = [&coarse, &circle].map(|state| state.spectrum().expect("resolved"));
    println!("neutral {:.1e} {:.1e}", rough.neutral, spectrum.neutral);
    assert!(!circle.is_mirror_symmetric() && spectrum.unstable() == 0 && spectrum.neutral < 0.3 * rough.neutral);
    assert!((rough.modes[0].value - spectrum.modes[0].value).norm() < 2e-5 && spectrum.modes[0].value.im > 0.1);
    // A run of the same without a repulsion turns alike.
    let method = Method::Integral(IntegralMethod { nodes: 48, elements: 192 });
    let built = Setup { method, ..aside }.build().expect("as described");
    let (mut scene, droplet) = (built.scene, built.droplets[0]);
    scene.run(40.0).go().expect("a run");
    let before = scene.observe(droplet).expect("seen").velocity;
    scene.run(50.0).go().expect("a run");
    let seen = scene.observe(droplet).expect("seen");
    let after = seen.velocity;
    let rate = before.angle_to(after) / 10.0;
    println!("turning {} {rate}, speed {} {}", circle.turning_rate(), circle.velocity().length(), after.length());
    assert!((circle.turning_rate() / rate - 1.0).abs() < 0.02, "{} {rate}", circle.turning_rate());
    assert!((circle.velocity().length() / after.length() - 1.0).abs() < 0.003, "{}", circle.velocity());
    // Force moments are those of the whole droplet in both: of the interface alone they are others.
    let measured = circle.measured().expect("measured");
    let interface = {
        let mut state = InterfaceState::of(scene.system(), droplet).expect("evaluated");
        state.enclosed.clear();
        observe(&state, Convention::FarField).expect("seen").moments.stresslet()[0][0]
    };
    let all = circle.observables().expect("observed");
    let [run, steady] = [&seen, &all].map(|seen| seen.moments.stresslet()[0]);
    println!("stresslet {} {steady:?}, run {run:?}, interface {interface}", measured.stresslet);
    assert!((steady[0] / measured.stresslet - 1.0).abs() < 1e-4, "{steady:?} {}", measured.stresslet);
    let apart = (run[0] - steady[0]).hypot(run[1] - steady[1]) / steady[0].hypot(steady[1]);
    assert!(apart < 0.01 && (interface / run[0] - 1.0).abs() > 0.2, "{run:?} {steady:?} {interface}");
    for seen in [&seen, &all] {
        assert!(seen.moments.quadrupole.is_none() && seen.get("n_xyy").is_none() && seen.get("f_xy").is_some());
    }
}

/// A disc that is too large or elsewhere, and a profile without the disc of the scene.
#[test]
fn discs_that_are_not_inside_are_refused() {
    let large = SteadyState::uniform(&setup(32, 1.0, -2.0, 2.0)).unwrap_err().to_string();
    assert!(large.contains("radius 2") && large.contains("smaller disc"), "{large}");
    let mut elsewhere = setup(32, 1.0, -2.0, 0.3);
    elsewhere.rigid_bodies[0].centre = [3.0, 0.0];
    let elsewhere = SteadyState::find(&elsewhere).unwrap_err().to_string();
    assert!(elsewhere.contains("not inside"), "{elsewhere}");
    let scene = setup(32, 1.0, -0.3, 0.3);
    let empty = SteadyState::uniform(&scene).unwrap().profile().clone().with_nuclei(Vec::new());
    let lack = SteadyState::near(&scene, &empty, Vec2::ZERO, true).unwrap_err().to_string();
    assert!(lack.contains("nuclei"), "{lack}");
}

/// The stresslet of all that is inside is that of the flow far away, u = x (x . S x)/(2 pi eta r^4); the forces of the
/// interface alone do not tell it.
#[test]
fn the_stresslet_of_a_droplet_with_a_nucleus_is_that_of_the_flow_far_away() {
    for ratio in [1.0, 3.0] {
        let scene = Setup {
            viscosity: 100.0,
            droplets: vec![DropletSetup { viscosity: Some(100.0 * ratio), ..DropletSetup::active(-2.0) }],
            rigid_bodies: vec![RigidBodySetup { centre: [0.0, 0.4], ..RigidBodySetup::disc(0.5) }],
            ..setup(64, ratio, -2.0, 0.5)
        };
        let state = SteadyState::find(&scene).expect("a swimmer");
        let seen = state.measured().expect("measured");
        let forward = state.velocity().normalize();
        let flow = |r: f64| {
            let place = |side: f64| seen.centroid + side * r * forward;
            let samples = state.sample(&[place(1.0), place(-1.0)]).expect("a flow");
            // The source dipole's velocity is the same on both sides, the stresslet's is opposite.
            0.5 * (samples[0].velocity - samples[1].velocity).dot(forward) * std::f64::consts::TAU * 100.0 * r
        };
        let (near, far) = (flow(50.0), flow(400.0));
        println!("{ratio}: {} {near} {far}", seen.stresslet);
        assert!((far / seen.stresslet - 1.0).abs() < 1e-3, "{ratio}: {} {near} {far}", seen.stresslet);
    }
}

/// Both thresholds of a droplet with a nucleus, each once, although the nucleus may rest anywhere.
#[test]
fn thresholds_around_a_nucleus_are_found_once() {
    // The rate of mode 1 is a straight line in the activity.
    let rate = |activity: f64| rates(1, &setup(32, 1.0, activity, 0.5))[0].re;
    let exact = -0.1 - 0.1 * rate(-0.1) / (rate(-0.1) - rate(-0.2));
    let rest = SteadyState::uniform(&setup(32, 1.0, 0.8 * exact, 0.5)).expect("at rest");
    let range = Continuation::new(Parameter::Activity, 0.8 * exact, 1.5 * exact);
    let branch = Continuation { largest_step: 0.2, ..range }.follow(&rest, |_, _| true).expect("a branch");
    let found: Vec<_> = branch.special.iter().map(|point| (point.critical.mode.symmetry, point.value)).collect();
    println!("{exact} {found:?}");
    assert_eq!(found.iter().map(|point| point.0).collect::<Vec<_>>(), [Symmetry::Symmetric, Symmetry::Antisymmetric]);
    assert!(found.iter().all(|point| (point.1 / exact - 1.0).abs() < 1e-6), "{exact} {found:?}");
    assert!(branch.special.iter().all(|point| point.kind == SpecialKind::BranchPoint));
    // No swimmer has its nucleus in the middle, as the flow inside carries it away: what branches off is at rest.
    let refused = range.switch(&branch.special[0], true, |_, _| true).unwrap_err().to_string();
    assert!(refused.contains("at rest with a nucleus elsewhere"), "{refused}");
}

#[test]
fn a_nucleus_that_is_held_has_no_steady_state_here() {
    let mut held = setup(32, 1.0, -2.0, 0.5);
    held.region = Region::Box { lengths: [6.0; 2] };
    held.rigid_bodies[0].held = true;
    let refused = SteadyState::uniform(&held).expect_err("a refusal").to_string();
    assert!(refused.contains("held or moved") && refused.contains("run the scene"), "{refused}");
}

//! Bending of fluid interfaces, and shells that start deformed.

use motile::active_interface::{ActiveDroplet, Motion};
use motile::base::{Region, Vec2};
use motile::boundary_integrals::{AxisymmetricIntegral, BoundaryIntegral, Settings};
use motile::elastic_solids::Shell;
use motile::scene::{Hydrodynamics, Scene, StepSize};
use motile::setup::{Built, DropletSetup, DropletShape, GridMethod, IntegralMethod, Method, Setup, ShellSetup};
use motile_tests::validation::order;

const TENSION: f64 = 0.3;
const MODULUS: f64 = 0.7;

/// A circle of that radius (length) with a wave of relative amplitude 1e-5.
fn wavy(radius: f64, wave: usize) -> DropletSetup {
    let mut cosines = vec![0.0; wave];
    cosines[wave - 1] = 1e-5;
    let shape = DropletShape::Modes { radius, cosines, sines: Vec::new() };
    DropletSetup { shape, bending: MODULUS, ..DropletSetup::passive(TENSION) }
}

/// Rate (1/time) at which the wave grows, from the velocities of the markers at the start.
fn rate<H: Hydrodynamics>(scene: &mut Scene<H>, radius: f64, wave: usize) -> f64 {
    scene.system_mut().evaluate().expect("a flow");
    let markers = scene.system().markers();
    let each = markers.positions().iter().zip(markers.velocities());
    let [velocity, place] = each.fold([0.0; 2], |[velocity, place], (x, u)| {
        let cosine = (wave as f64 * x.y.atan2(x.x)).cos();
        [velocity + cosine * u.dot(*x) / x.length(), place + cosine * (x.length() - radius)]
    });
    velocity / place
}

/// Circle of that radius through `count` markers, with waves given by their relative height at an angle.
fn circle(radius: f64, count: usize, waves: impl Fn(f64) -> f64) -> Vec<Vec2> {
    let angle = |k: usize| std::f64::consts::TAU * k as f64 / count as f64;
    (0..count).map(|k| radius * (1.0 + waves(angle(k))) * Vec2::from_angle(angle(k))).collect()
}

/// In the plane a mode k of a circle of radius R grows at the rate
/// `-k/(2 (eta_in + eta_ext) R) (gamma + B (k^2 - 3/2)/R^2 + B kappa0^2/2)`: the energy `B/2 INT (kappa - kappa0)^2 ds`
/// makes the normal force density `B (kappa_ss + kappa (kappa^2 - kappa0^2)/2)`.
#[test]
fn modes_relax_at_the_rate_of_the_closed_form() {
    for (radius, inside, reference) in [(1.0, 1.0, 0.0), (1.0, 10.0, 1.5), (2.0, 0.1, -0.8)] {
        for wave in 2..7 {
            let k = wave as f64;
            let markers = circle(radius, 64, |angle| 1e-5 * (k * angle).cos());
            let droplet = ActiveDroplet::passive(&markers, TENSION).and_then(|it| it.with_bending(MODULUS, reference));
            let droplet = droplet.and_then(|it| it.with_viscosity_inside(inside)).expect("a droplet");
            let flow = BoundaryIntegral::new(Region::Plane, 1.0, Settings { nodes: 64, ..Settings::default() });
            let mut scene = Scene::new(flow.expect("a flow"));
            scene.add(droplet);
            let bending = MODULUS * ((k * k - 1.5) / (radius * radius) + 0.5 * reference * reference);
            let exact = -k * (TENSION + bending) / (2.0 * (inside + 1.0) * radius);
            let found = rate(&mut scene, radius, wave);
            assert!((found / exact - 1.0).abs() < 1e-6, "R = {radius}, mode {wave}: {found} {exact}");
        }
    }
}

/// A grid gives the rates of boundary integrals in the same box, to second order.
#[test]
fn a_grid_converges_to_boundary_integrals() {
    let found = |method| {
        let setup = Setup { droplets: vec![wavy(1.0, 3)], viscosity: 1.0, method, ..Setup::default() };
        rate(&mut setup.build().expect("a scene").scene, 1.0, 3)
    };
    let exact = found(Method::Integral(IntegralMethod { nodes: 64, elements: 1024 }));
    let steps = [0.2, 0.1, 0.05];
    let errors = steps.map(|h| (found(Method::Grid(GridMethod::of_spacing(h))) / exact - 1.0).abs());
    assert!(order(&steps, &errors) > 1.8 && errors[2] < 7e-4, "{errors:?}");
}

/// Largest distance of the markers from the unit circle, over that at the start, after 400 steps of `part` of the
/// explicit limit, with short waves implicit or not.
fn wrinkled(viscosity_inside: f64, part: f64, stabilised: bool) -> f64 {
    let nodes = 96;
    let settings = Settings { nodes, ..Settings::default() };
    let waves = |t: f64| 1e-9 * (nodes / 4..nodes / 2).map(|m| (m as f64 * t + (m * m) as f64).cos()).sum::<f64>();
    let made = |stabilised: bool| {
        let flow = BoundaryIntegral::new(Region::Plane, 1.0, settings).expect("a solver");
        let droplet = ActiveDroplet::passive(&circle(1.0, 2 * nodes, waves), TENSION).expect("a droplet");
        let droplet = droplet.with_motion(Motion::Equidistributed { relaxation: 0.0, filter: false });
        let droplet = droplet.with_bending(MODULUS, 0.0).and_then(|it| it.with_viscosity_inside(viscosity_inside));
        let mut scene = Scene::new(flow);
        let droplet = scene.add(droplet.expect("a droplet").with_stabiliser(stabilised));
        (scene, droplet)
    };
    let (limit, reason, _) = made(false).0.step_limit().expect("a limit");
    assert_eq!(reason, "the bending");
    let (mut scene, droplet) = made(stabilised);
    let distance = |scene: &Scene<BoundaryIntegral>| {
        let markers = scene.body(droplet).expect("its droplet").markers();
        markers.iter().map(|x| (x.length() - 1.0).abs()).fold(0.0, f64::max)
    };
    let start = distance(&scene);
    for _ in 0..400 {
        // A wave that grows ends in a curve that crosses itself.
        if scene.step(part * limit).is_err() {
            return f64::INFINITY;
        }
    }
    distance(&scene) / start
}

#[test]
fn bending_is_stable_up_to_its_limit() {
    for inside in [0.1, 1.0, 10.0] {
        let [below, above] = [0.98, 1.3].map(|part| wrinkled(inside, part, false));
        assert!(below < 0.1 && above > 1e3, "{inside}: {below:e} {above:e}");
        // If short waves are implicit, much longer steps are stable too.
        for part in [1.3, 5.0, 100.0] {
            let implicit = wrinkled(inside, part, true);
            assert!(implicit < 0.1, "{inside}, {part} limits: {implicit:e}");
        }
    }
}

/// Steps of the limit are stable on a grid, and the droplet becomes round.
#[test]
fn a_bent_droplet_becomes_round_on_a_grid() {
    let shape = DropletShape::Ellipse { half_axes: [1.25, 0.8] };
    let droplet = DropletSetup { shape, bending: 5.0, ..DropletSetup::passive(0.0) };
    let setup = Setup {
        method: Method::Grid(GridMethod::of_spacing(0.1)),
        viscosity: 1.0,
        droplets: vec![droplet],
        step: StepSize::OfLimit(0.95),
        ..Setup::default()
    };
    let Built { mut scene, droplets, .. } = setup.build().expect("a scene");
    scene.run(2.0).go().expect("a run");
    let seen = scene.observe(droplets[0]).expect("observables");
    assert!((seen.aspect_ratio_moments - 1.0).abs() < 4e-5, "{}", seen.aspect_ratio_moments);
}

#[test]
fn bending_needs_a_fixed_number_of_markers() {
    let droplet = DropletSetup { bending: 1.0, ..DropletSetup::passive(1.0) };
    let setup = Setup { droplets: vec![DropletSetup { motion: Motion::WithFluid, ..droplet }], ..Setup::default() };
    let error = setup.build().unwrap_err().to_string();
    assert!(error.starts_with("droplets[0].motion = with-fluid"), "{error}");
    // Put together by hand it is refused at the first look.
    let droplet = ActiveDroplet::passive(&circle(1.0, 32, |_| 0.0), 1.0)
        .and_then(|it| it.with_bending(1.0, 0.0))
        .expect("a droplet");
    let flow = BoundaryIntegral::new(Region::Plane, 1.0, Settings { nodes: 32, ..Settings::default() });
    let mut scene = Scene::new(flow.expect("a flow"));
    scene.add(droplet.with_motion(Motion::WithFluid));
    let error = scene.step(0.1).unwrap_err();
    assert!(format!("{error:?}").contains("bending needs a fixed number of markers"), "{error:?}");
}

/// The forces are those of a curve in the plane: a body of revolution has a second curvature, which they leave out.
#[test]
fn bending_is_refused_in_three_dimensions() {
    for region in [Region::Space, Region::tube(2.0)] {
        let droplet = DropletSetup { bending: MODULUS, ..DropletSetup::passive(TENSION) };
        let setup = Setup { region, droplets: vec![droplet], ..Setup::default() };
        let error = setup.build().unwrap_err().to_string();
        assert!(error.starts_with(&format!("droplets[0].bending = {MODULUS}")), "{error}");
        assert!(error.contains("bending stiffness exists in two dimensions only"), "{error}");
    }
    // Put together by hand, in either order.
    let droplet = || ActiveDroplet::passive(&circle(1.0, 32, |_| 0.0), TENSION).expect("a droplet");
    let first = droplet().with_bending(MODULUS, 0.0).and_then(ActiveDroplet::axisymmetric).expect("a droplet");
    let last = droplet().axisymmetric().and_then(|it| it.with_bending(MODULUS, 0.0)).expect("a droplet");
    for droplet in [first, last] {
        let settings = Settings { nodes: 32, ..Settings::default() };
        let flow = AxisymmetricIntegral::new(Region::Space, 1.0, settings, std::f64::consts::TAU);
        let mut scene = Scene::new(flow.expect("a flow"));
        scene.add(droplet);
        let error = scene.step(0.1).unwrap_err();
        assert!(format!("{error:?}").contains("in two dimensions"), "{error:?}");
    }
}

/// A circle of radius 0.5 at rest that starts as an ellipse has the energy of a shell made so by hand, and goes back.
#[test]
fn a_shell_starts_deformed() {
    let shell = ShellSetup {
        shape: DropletShape::Ellipse { half_axes: [0.625, 0.4] },
        rest: Some(DropletShape::Round { radius: 0.5 }),
        stretching: 10.0,
        bending: 0.1,
        ..ShellSetup::default()
    };
    let method = Method::Integral(IntegralMethod { nodes: 32, elements: 64 });
    let setup = Setup {
        region: Region::Plane,
        method,
        viscosity: 1.0,
        droplets: Vec::new(),
        shells: vec![shell],
        ..Setup::default()
    };
    let Built { mut scene, shells, .. } = setup.build().expect("a scene");
    let energy = |scene: &Scene<_>| scene.body(shells[0]).expect("the shell").energy();
    let start = energy(&scene);
    let at_rest: Vec<Vec2> =
        (0..64).map(|k| 0.5 * Vec2::from_angle(std::f64::consts::TAU * f64::from(k) / 64.0)).collect();
    let by_hand = Shell::new(&at_rest, 10.0, 0.1).and_then(|it| it.deformed(scene.body(shells[0]).unwrap().markers()));
    assert!((start / by_hand.expect("a shell").energy() - 1.0).abs() < 1e-12 && start > 0.01, "{start}");
    scene.run(2.0).go().expect("a run");
    assert!(energy(&scene) < 0.02 * start, "{}", energy(&scene));
    let wrong = ShellSetup { rest: Some(DropletShape::Round { radius: -1.0 }), ..setup.shells[0].clone() };
    let error = Setup { shells: vec![wrong], ..setup.clone() }.build().unwrap_err().to_string();
    assert!(error.starts_with("shells[0].rest.round.radius = -1"), "{error}");
}

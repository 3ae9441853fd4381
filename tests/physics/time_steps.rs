//! Integrators and step sizes: order, stability, accuracy, and what is reported of them.

use motile::active_interface::{
    ActiveDroplet, ContractileTension, Curve, ExcludedVolume, Motion, observables::centroid_velocity,
};
use motile::base::Region;
use motile::base::{Drive, Vec2};
use motile::boundary_integrals::{BoundaryIntegral, Settings};
use motile::elastic_solids::ChannelShape;
use motile::elastic_solids::mesh::equilateral_strip;
use motile::elastic_solids::{Moduli, NeoHookean, Solid};
use motile::ib_core::{BSpline, ImmersedBoundary};
use motile::scene::{
    Body, Handle, Hydrodynamics, Scene, SceneError, StepSize,
    integrator::{Integrator, Midpoint, RungeKuttaChebyshev, SpectralEstimate},
};
use motile::setup::{
    AnyFlow, Built, DropletSetup, GridMethod, IntegralMethod, LayersMethod, Material, Method, Setup, SolidSetup,
};
use motile::stokes_grid::{ChannelStokes, Grid};
use motile_tests::validation::order;
use motile_tests::validation::scene::{on_grid, open_channel, without_grid};

fn state<B: Body, H: Hydrodynamics>(scene: &Scene<H>, body: Handle<B>) -> Vec<f64> {
    let body = scene.body(body).expect("its body");
    let mut state = vec![0.0; body.state_len()];
    body.write_state(&mut state);
    state
}

fn distance(a: &[f64], b: &[f64]) -> f64 {
    (a.iter().zip(b).map(|(a, b)| (a - b).powi(2)).sum::<f64>() / a.len() as f64).sqrt()
}

/// The droplet after a time of 0.8, with equal steps; no filter, which is of first order in time.
fn swimmer(integrator: impl Integrator, dt: f64, stabilised: bool) -> Vec<f64> {
    filtered(integrator, dt, stabilised, [false; 2])
}

/// Steps with or without the filter, before and in the last step.
fn filtered(integrator: impl Integrator, dt: f64, stabilised: bool, [before, last]: [bool; 2]) -> Vec<f64> {
    let filtered = |filter| Motion::Equidistributed { filter, relaxation: 50.0 };
    let droplets = vec![DropletSetup { motion: filtered(before), ..DropletSetup::default() }];
    let method = Method::Grid(GridMethod::of_spacing(0.2));
    let setup = Setup { method, viscosity: 40.0, droplets, ..Setup::default() };
    let Built { scene, droplets, .. } = setup.build().expect("a scene");
    let mut scene = scene.advanced_by(integrator);
    let droplet = scene.body_mut(droplets[0]).expect("its droplet");
    *droplet = droplet.clone().with_stabiliser(stabilised);
    scene.run(0.8 - dt).step_size(StepSize::Fixed(dt)).go().expect("a run");
    let droplet = scene.body_mut(droplets[0]).expect("its droplet");
    *droplet = droplet.clone().with_motion(filtered(last));
    scene.step(dt).expect("the last step");
    state(&scene, droplets[0])
}

/// A state is off by some half of what the filter does in the last step, which is of first order.
#[test]
fn the_filter_leaves_half_a_step_of_itself() {
    let steps = [0.01, 0.005, 0.0025];
    let run = |dt, last| filtered(Midpoint::default(), dt, false, [true, last]);
    let positions = |state: Vec<f64>| state[..2 * state.len() / 3].to_vec();
    let [with, without] = [true, false].map(|last| steps.map(|dt| positions(run(dt, last))));
    let change = |states: &[Vec<f64>; 3]| [0, 1].map(|k| distance(&states[k], &states[k + 1]));
    let order = |[first, second]: [f64; 2]| (first / second).log2();
    let after = order(change(&with));
    // Half way between both it is nearer to second order, which it has without the filter.
    let middle = |k: usize| with[k].iter().zip(&without[k]).map(|(a, b): (&f64, &f64)| 0.5 * (a + b)).collect();
    let between = order(change(&[0, 1, 2].map(middle)));
    let bare = order(change(&steps.map(|dt| positions(swimmer(Midpoint::default(), dt, false)))));
    assert!((bare - 2.0).abs() < 0.1 && between > 1.8 && after < 1.7, "{bare} {between} {after}");
}

#[test]
fn integrators_are_of_second_order_with_implicit_diffusion() {
    let chebyshev = |dt| swimmer(RungeKuttaChebyshev::new(), dt, true);
    let exact = chebyshev(0.00125);
    let steps = [0.01, 0.005, 0.0025];
    let errors = steps.map(|dt| distance(&chebyshev(dt), &exact));
    assert!(order(&steps, &errors) > 1.8, "{errors:?}");
    // The midpoint rule converges to the same, from further away because of its stabiliser, which is stiff.
    let others = steps.map(|dt| distance(&swimmer(Midpoint::default(), dt, true), &exact));
    assert!(order(&steps, &others) > 1.4 && others[2] > 5.0 * errors[2], "{others:?}");
    let [long, middle, short] = [0.005, 0.0025, 0.00125].map(|dt| swimmer(Midpoint::default(), dt, false));
    let bare = (distance(&long, &middle) / distance(&middle, &short)).log2();
    assert!((bare - 2.0).abs() < 0.1 && distance(&short, &exact) < errors[2], "{bare}: {:e}", distance(&short, &exact));
}

type Channel = Scene<ImmersedBoundary<ChannelStokes, BSpline<4>>>;

/// A layer of shear modulus 1000 in fluid of viscosity 10, pinned below, its top deformed in a smooth way.
fn block(integrator: impl Integrator) -> (Channel, Handle<Solid>) {
    let grid = Grid::channel(16, 16, 0.1).expect("a grid");
    let flow = ImmersedBoundary::new(ChannelStokes::new(grid, 10.0).expect("a solver"), BSpline::<4>);
    let mesh = equilateral_strip(Vec2::new(0.0, -0.8), 16, 8, 0.1).expect("a mesh");
    let deformed = |s: Vec2| {
        let wave = (std::f64::consts::TAU * s.x / 1.6).sin();
        s + 0.05 * (s.y + 0.8) * Vec2::new(1.0 + wave, wave)
    };
    let solid = Solid::hyperelastic(mesh, NeoHookean::new(1000.0, 3000.0).expect("moduli"));
    let solid = solid.pinned(|s| s.y < -0.79).expect("free points").deformed(deformed).expect("positions");
    let mut scene = Scene::new(flow).advanced_by(integrator);
    let handle = scene.add(solid);
    (scene, handle)
}

fn relaxed(integrator: impl Integrator, dt: f64) -> Vec<f64> {
    let (mut scene, block) = block(integrator);
    scene.run(0.1).step_size(StepSize::Fixed(dt)).go().expect("a run");
    state(&scene, block)
}

/// The midpoint rule is stable up to 2 eta/mu = 0.02; the slow modes that are left at t = 0.1 are followed with second
/// order by steps well beyond that.
#[test]
fn chebyshev_takes_long_steps_with_stiff_solids() {
    let exact = relaxed(Midpoint::default(), 0.0005);
    let steps = [0.025, 0.0125, 0.00625];
    let errors = steps.map(|dt| distance(&relaxed(RungeKuttaChebyshev::new(), dt), &exact));
    let order = order(&steps, &errors);
    assert!(order > 1.8, "{order}: {errors:?}");
    let moved = distance(&exact, &relaxed(Midpoint::default(), 0.1 / 100.0));
    assert!(errors[0] < 1e-3 && moved < errors[2], "{errors:?} {moved}");
}

#[test]
fn the_power_method_finds_the_rate_that_the_solid_predicts() {
    let (mut scene, _) = block(RungeKuttaChebyshev::new());
    scene.step(0.05).expect("a step");
    // The bound is mu/eta; what is found is 0.6 to 1 of it, and the bound is not lowered for that.
    let integrator: &dyn std::any::Any = scene.integrator();
    let integrator: &RungeKuttaChebyshev = integrator.downcast_ref().expect("that integrator");
    let found = integrator.measured();
    assert!(found > 0.6 && found < 1.1, "{found}");
    assert!(integrator.correction() >= 1.0);
    let work = scene.integrator_work();
    assert!(work.estimates > 2 && work.estimates <= 30, "{work:?}");
    // dt rate = 5 takes four stages: 0.65 * 15 = 9.8.
    assert!(work.stages >= 3 && work.stages <= 4, "{work:?}");
}

#[test]
fn the_stages_follow_the_step() {
    let (mut scene, _) = block(RungeKuttaChebyshev::new().with_estimate(SpectralEstimate::Predicted));
    let mut stages = 0;
    // The rate is a bit above 100: 2, 4 and 8 stages reach 1.96, 9.8 and 41.
    for (dt, expected) in [(0.01, 2), (0.05, 4), (0.3, 8)] {
        scene.step(dt).expect("a step");
        let taken = scene.integrator_work().stages - stages;
        stages += taken;
        assert_eq!(taken, expected, "{dt}");
    }
    assert_eq!(scene.integrator_work().estimates, 0);
}

/// Between walls whose rates lie densely up to the fastest, and beside a droplet whose rates are far slower, which is
/// what the power method sees first.
#[test]
fn the_predicted_step_between_stiff_walls_is_stable() {
    let shear = Moduli::from_thesis_spring_constant(1e6).expect("moduli").shear();
    let walls = SolidSetup::walls(&ChannelShape::Straight { width: 2.0 }, &Material::Springs { shear });
    let plain = Method::Grid(GridMethod::uncorrected(0.1));
    let layers = Method::Layers(LayersMethod::of_spacing(0.1));
    for (stages, method) in [(5, plain), (8, plain), (5, layers), (8, layers)] {
        let setup = Setup {
            region: open_channel(6.0, 5.0),
            viscosity: 10.0,
            droplets: vec![DropletSetup::active(0.0)],
            solids: walls.clone(),
            method,
            ..Setup::default()
        };
        let Built { scene, droplets, .. } = setup.build().expect("a scene");
        let droplet = droplets[0];
        let mut scene = scene.advanced_by(RungeKuttaChebyshev::new().with_most_stages(stages));
        let start = scene.body(droplet).unwrap().markers().to_vec();
        let (limit, reason, _) = scene.step_limit().expect("a limit");
        // Beside layers a droplet has more cells.
        assert!(method == layers || reason == "the elastic moduli", "{reason}");
        // Of fewer stages, whose number follows the step, the least are just enough.
        for part in [0.7, 0.99] {
            (0..30).for_each(|_| scene.step(part * limit).expect("a stable step"));
            let moved = scene.body(droplet).unwrap().markers().iter().zip(&start).map(|(a, b)| (a - b).length());
            assert!(moved.fold(0.0, f64::max) < 0.2, "{stages} stages, {part} of the limit");
        }
    }
}

/// Modes that decay set no bound here, and the first thing that happens is over in a thousandth of such a step.
#[test]
fn steps_of_a_fraction_of_a_long_limit_are_accurate() {
    let setup = Setup { droplets: vec![DropletSetup::active(-4.0)], ..without_grid(24, 96) };
    let build = || setup.build().expect("a scene").scene;
    let (midpoint, _) = run_and_look(&mut build());
    let (chebyshev, steps) = run_and_look(&mut build().advanced_by(RungeKuttaChebyshev::new()));
    assert!((chebyshev / midpoint - 1.0).abs() < 1e-5, "{chebyshev} {midpoint}");
    assert!(steps < 1500, "{steps}");
}

/// The speed at t = 60, and the steps to there.
fn run_and_look<H: Hydrodynamics>(scene: &mut Scene<H>) -> (f64, usize) {
    scene.run(60.0).go().expect("a run");
    scene.system_mut().evaluate().expect("a flow");
    let markers = scene.system().markers();
    let velocity = centroid_velocity(markers.positions(), markers.velocities()).expect("an interface");
    (velocity.length(), scene.steps())
}

fn adaptive(integrator: impl Integrator, tolerance: f64) -> (Scene<AnyFlow>, Handle<ActiveDroplet>) {
    let setup = Setup { droplets: vec![DropletSetup::active(-3.0)], ..on_grid(0.2) };
    let Built { scene, droplets, .. } = setup.build().expect("a scene");
    let mut scene = scene.advanced_by(integrator);
    scene.run(6.0).step_size(StepSize::Adaptive { tolerance }).go().expect("a run");
    (scene, droplets[0])
}

#[test]
fn adaptive_steps_keep_the_error_they_are_asked_for() {
    let (scene, droplet) = adaptive(Midpoint::default(), 1e-7);
    let exact = state(&scene, droplet);
    let positions = 2 * scene.body(droplet).unwrap().marker_count();
    let mut last = (f64::INFINITY, 0);
    for tolerance in [1e-4, 1e-5, 1e-6] {
        let (scene, droplet) = adaptive(Midpoint::default(), tolerance);
        let error = distance(&state(&scene, droplet)[..positions], &exact[..positions]);
        let report = scene.step_report();
        // Local errors of the tolerance add up to some tens of it at most.
        assert!(error < 60.0 * tolerance, "{tolerance}: {error:e}");
        assert!(error < last.0 && report.steps > last.1, "{tolerance}: {error:e} {report:?}");
        assert!(report.rejections < report.steps / 5 && report.failures == 0, "{report:?}");
        assert_eq!(report.limiting.iter().map(|limiting| limiting.steps).sum::<usize>(), report.steps);
        assert_eq!(report.steps, scene.steps());
        last = (error, report.steps);
    }
}

#[test]
fn both_integrators_come_to_the_same() {
    let (scene, droplet) = adaptive(Midpoint::default(), 1e-6);
    let (other, same) = adaptive(RungeKuttaChebyshev::new(), 1e-6);
    let (a, b) = (state(&scene, droplet), state(&other, same));
    let positions = 2 * scene.body(droplet).unwrap().marker_count();
    assert!(distance(&a[..positions], &b[..positions]) < 3e-4, "{:e}", distance(&a[..positions], &b[..positions]));
}

/// A droplet without tension that the fluid carries along states bounds on its steps, but none that is finite. A part
/// of them is no step; steps that are given, or bounded by their error, are taken.
#[test]
fn bodies_without_a_finite_bound_need_a_step_that_is_given() {
    let channel = |step| Setup {
        region: Region::Channel { length: 4.0, width: 4.0, drive: Drive::Gradient(-100.0) },
        droplets: vec![DropletSetup { motion: Motion::WithFluid, ..DropletSetup::passive(0.0) }],
        method: Method::Grid(GridMethod { spacing: 0.1, ..GridMethod::thesis() }),
        step,
        ..Setup::default()
    };
    let mut scene = channel(StepSize::OfLimit(0.5)).build().expect("a scene").scene;
    assert_eq!(scene.step_limit().expect("a bound").0, f64::INFINITY);
    let error = scene.run(1.0).go().expect_err("a part of infinity");
    assert!(matches!(error, SceneError::Refused { .. }), "{error}");
    assert!(error.to_string().contains("no body states a limit of the time step"), "{error}");
    assert_eq!((scene.steps(), scene.time()), (0, 0.0));
    for step in [StepSize::Fixed(0.05), StepSize::Adaptive { tolerance: 1e-4 }] {
        let Built { mut scene, droplets, .. } = channel(step).build().expect("a scene");
        let foremost = |scene: &Scene<AnyFlow>| {
            let droplet = scene.body(droplets[0]).expect("the droplet");
            droplet.markers().iter().map(|marker| marker.x).fold(f64::NEG_INFINITY, f64::max)
        };
        let start = foremost(&scene);
        scene.run(1.0).go().expect("a run");
        // Poiseuille's flow on the centre line: 100 w^2/(8 eta).
        assert!((foremost(&scene) - start - 2.0).abs() < 0.005, "{step:?}: {}", foremost(&scene) - start);
    }
}

#[test]
fn a_bound_on_steps_and_their_number_ends_a_run() {
    let mut scene = on_grid(0.2).build().expect("a scene").scene;
    let error = scene.run(10.0).most_steps(3).go().expect_err("too few steps");
    assert!(matches!(error, SceneError::TooManySteps { most: 3, .. }), "{error}");
    assert_eq!(scene.steps(), 3);
    let adaptive = StepSize::Adaptive { tolerance: 1e-9 };
    let error = scene.run(10.0).step_size(adaptive).least_step(0.5).go().expect_err("steps too long");
    assert!(matches!(error, SceneError::Stagnation { least: 0.5, .. }), "{error}");
    assert_eq!(scene.steps(), 3);
    for bad in [0.0, -1.0, f64::NAN, f64::INFINITY, 1.0] {
        let outcome = scene.run(10.0).step_size(StepSize::Adaptive { tolerance: bad }).go();
        assert!(matches!(outcome, Err(SceneError::Input(_))), "{bad}");
    }
    for bad in [-1.0, f64::NAN, f64::INFINITY] {
        assert!(matches!(scene.run(10.0).least_step(bad).go(), Err(SceneError::Input(_))), "{bad}");
    }
}

/// A droplet 300 times as viscous as the exterior fluid changes slowly, but not in a single step.
#[test]
fn the_first_step_is_bounded_as_all_are() {
    let speed = |step| {
        let droplet = DropletSetup { viscosity: Some(3000.0), ..DropletSetup::active(-4.0) };
        let method = Method::Integral(IntegralMethod { nodes: 48, elements: 192 });
        let setup = Setup { viscosity: 10.0, droplets: vec![droplet], method, step, ..Setup::default() };
        let Built { mut scene, droplets, .. } = setup.build().unwrap();
        scene.run(10.0).go().unwrap();
        scene.observe(droplets[0]).unwrap().speed()
    };
    let (found, expected) = (speed(StepSize::default()), speed(StepSize::Fixed(0.05)));
    assert!((found / expected - 1.0).abs() < 1e-4, "{found} {expected}");
}

/// Largest difference of the concentration from its mean, over that at the start, on a circle of crowded particles
/// (gamma = 1.01 - c, hardly any diffusion) of fluid of a viscosity in fluid of viscosity 1, after 100 steps of `part`
/// of the limit.
fn crowded<H: Hydrodynamics>(flow: H, nodes: usize, viscosity_inside: f64, part: f64) -> f64 {
    let law = ContractileTension::new(1.01, 1.0, ExcludedVolume::None, 1.0).expect("a law");
    let markers = Curve::circle(1.0).and_then(|circle| circle.markers(4 * nodes)).expect("a circle");
    let length = markers[0].distance(markers[1]);
    let angle = |wave: usize, k: usize| std::f64::consts::TAU * (wave * k) as f64 / markers.len() as f64;
    let waves = |k: usize| (1..nodes / 2).map(|m| angle(m, k + m).cos()).sum::<f64>();
    let numbers = (0..markers.len()).map(|k| length * (1.0 + 1e-9 * waves(k))).collect();
    let mut scene = Scene::new(flow);
    let droplet = ActiveDroplet::new(&markers, numbers, law, 1e-6).expect("a droplet");
    let droplet = scene.add(droplet.with_viscosity_inside(viscosity_inside).expect("a viscosity"));
    scene.step(1e-9).expect("a step");
    let (limit, reason, _) = scene.step_limit().expect("a limit");
    assert_eq!(reason, "the coupling of concentration and tension");
    let dt = part * limit;
    let change = |scene: &Scene<H>| {
        let found = scene.body(droplet).expect("its droplet").concentrations();
        let mean = found.iter().sum::<f64>() / found.len() as f64;
        found.iter().map(|c| (c - mean).abs()).fold(0.0, f64::max)
    };
    let start = change(&scene);
    (0..100).for_each(|_| scene.step(dt).expect("a step"));
    change(&scene) / start
}

/// The limit is that of the linearised scheme: every mode decays just below it, and one grows just above.
#[test]
fn the_stabilised_coupling_is_stable_up_to_its_limit() {
    for (nodes, inside) in [(32, 1.0), (48, 1.0), (72, 1.0), (48, 10.0), (48, 0.1)] {
        let settings = Settings { nodes, ..Settings::default() };
        let flow = || BoundaryIntegral::new(Region::Plane, 1.0, settings).expect("a solver");
        let [below, above] = [0.95, 1.1].map(|part| crowded(flow(), nodes, inside, part));
        assert!(below < 1e-2 && above > 1e3, "{nodes} nodes, viscosity {inside}: {below:e} {above:e}");
    }
}

/// Largest distance of the markers from the unit circle, over that at the start, of a passive droplet in fluid of
/// viscosity 1 after 400 steps of `part` of the limit.
fn wrinkled(viscosity_inside: f64, part: f64) -> f64 {
    let nodes = 32;
    let settings = Settings { nodes, ..Settings::default() };
    let flow = BoundaryIntegral::new(Region::Plane, 1.0, settings).expect("a solver");
    let angle = |k: usize| std::f64::consts::TAU * k as f64 / (4 * nodes) as f64;
    let waves = |t: f64| (2..nodes / 2).map(|m| (m as f64 * t + (m * m) as f64).cos()).sum::<f64>();
    let markers = (0..4 * nodes).map(|k| (1.0 + 1e-9 * waves(angle(k))) * Vec2::from_angle(angle(k)));
    let droplet = ActiveDroplet::passive(&markers.collect::<Vec<_>>(), 1.0).expect("a droplet");
    let droplet = droplet.with_motion(Motion::Equidistributed { relaxation: 0.0, filter: false });
    let mut scene = Scene::new(flow);
    let droplet = scene.add(droplet.with_viscosity_inside(viscosity_inside).expect("a viscosity"));
    // The limit is that of the viscosities once the flow has been computed.
    scene.step(1e-9).expect("a step");
    let (limit, reason, _) = scene.step_limit().expect("a limit");
    assert_eq!(reason, "the surface tension");
    let distance = |scene: &Scene<BoundaryIntegral>| {
        let markers = scene.body(droplet).expect("its droplet").markers();
        markers.iter().map(|x| (x.length() - 1.0).abs()).fold(0.0, f64::max)
    };
    let start = distance(&scene);
    (0..400).for_each(|_| scene.step(part * limit).expect("a step"));
    distance(&scene) / start
}

/// A wave of wave number q relaxes at `gamma q/(2 (eta_in + eta_ext))`, the mean of both viscosities counted once.
#[test]
fn the_tension_is_stable_up_to_its_limit_at_any_viscosity_inside() {
    for inside in [0.02, 1.0, 10.0] {
        let [below, above] = [0.98, 1.2].map(|part| wrinkled(inside, part));
        assert!(below < 0.1 && above > 1e3, "{inside}: {below:e} {above:e}");
    }
}

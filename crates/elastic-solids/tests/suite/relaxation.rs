//! Viscoelastic layers on a wall under fluid at rest: rates of relaxation against the exact ones; orders in space and
//! time, limits, no allocation.

use allocation_counter::measure;
use elastic_solids::mesh::fitted_strip;
use elastic_solids::{ActiveSprings, Maxwell, NeoHookean, Solid};
use ib_core::{AnyKernel, ImmersedBoundary};
use motile_base::Vec2;
use motile_scene::Scene;
use stokes_grid::{ChannelStokes, Grid};

const HEIGHT: f64 = 2.0;
const THICKNESS: f64 = 1.0;
const VISCOSITY: f64 = 10.0;
const STRAIN: f64 = 1e-3;

#[derive(Clone, Copy)]
struct Case {
    springs: bool,
    moduli: [f64; 2],
    time: f64,
}

/// Roots of `lambda^2 + lambda [m (Ginf+G1) + 1/tau] + m Ginf/tau = 0`.
fn rates(case: &Case) -> [f64; 2] {
    let mobility = (1.0 - THICKNESS / HEIGHT) / VISCOSITY;
    let [rest, relaxing] = case.moduli;
    let (sum, product) = (mobility * (rest + relaxing) + 1.0 / case.time, mobility * rest / case.time);
    let root = (0.25 * sum * sum - product).sqrt();
    [product / (0.5 * sum + root), 0.5 * sum + root]
}

/// The exact shear over that at the start, of a layer whose Maxwell element is unstrained in the reference state.
fn exact(case: &Case, t: f64) -> f64 {
    let [slow, fast] = rates(case);
    let first = (1.0 - THICKNESS / HEIGHT) / VISCOSITY * (case.moduli[0] + case.moduli[1]);
    let part = (fast - first) / (fast - slow);
    part * (-slow * t).exp() + (1.0 - part) * (-fast * t).exp()
}

fn layer(case: &Case, h: f64) -> Solid {
    let mesh = fitted_strip(Vec2::new(0.0, -0.5 * HEIGHT), [8.0 * h, THICKNESS], h).expect("a scene");
    let [shear, relaxing] = case.moduli;
    let solid = match (shear > 0.0, case.springs) {
        (false, _) => Solid::fluid_like(mesh),
        (true, true) => Solid::springs(mesh, shear).expect("a scene"),
        (true, false) => Solid::hyperelastic(mesh, NeoHookean::new(shear, 2.0 * shear).expect("a scene")),
    };
    let solid = if relaxing > 0.0 {
        solid.with_maxwell(Maxwell::new(relaxing, case.time).expect("a scene")).expect("a scene")
    } else {
        solid
    };
    let low = |s: Vec2| s.y < -0.5 * HEIGHT + 1e-9;
    solid
        .pinned(low)
        .expect("a scene")
        .deformed(|s| s + Vec2::new(STRAIN * (s.y + 0.5 * HEIGHT), 0.0))
        .expect("a scene")
}

fn channel(h: f64) -> Scene<ImmersedBoundary<ChannelStokes, AnyKernel>> {
    let grid = Grid::channel(8, (HEIGHT / h).round() as usize, h).expect("a scene");
    let solver = ChannelStokes::new(grid, VISCOSITY).expect("a scene");
    Scene::new(ImmersedBoundary::new(solver, AnyKernel::BSpline4))
}

/// Shear of the layer over that at the start after the time 1, in `steps` steps.
fn sheared(case: &Case, h: f64, steps: usize) -> f64 {
    let mut scene = channel(h);
    let handle = scene.add(layer(case, h));
    (0..steps).for_each(|_| scene.step(1.0 / steps as f64).expect("a scene"));
    top(scene.body(handle).expect("a scene"))
}

/// Shear of the layer up to its surface, over that at the start.
fn top(solid: &Solid) -> f64 {
    let moved = |y: f64| {
        let row = solid.mesh().points().iter().zip(solid.displacements());
        let at = row.filter(|(s, _)| (s.y - y).abs() < 1e-9).map(|(_, moved)| moved.x).collect::<Vec<f64>>();
        at.iter().sum::<f64>() / at.len() as f64
    };
    moved(-0.5 * HEIGHT + THICKNESS) / (STRAIN * THICKNESS)
}

/// Errors of the grid are of first order in its spacing, as those of an elastic layer are.
#[test]
fn layers_relax_at_the_exact_rates() {
    for springs in [false, true] {
        for (moduli, time) in [([20.0, 60.0], 0.5), ([20.0, 60.0], 0.05), ([20.0, 60.0], 5.0), ([0.0, 80.0], 0.5)] {
            let case = Case { springs, moduli, time };
            let error = |h: f64| (sheared(&case, h, 100) - exact(&case, 1.0)).abs();
            let [coarse, fine] = [error(0.1), error(0.05)];
            assert!(fine < 0.013, "{springs} {moduli:?} {time}: {fine:e}");
            // Rows of springs fit a layer better or worse, by chance.
            let order = (coarse / fine).log2();
            assert!(springs && moduli[0] > 0.0 || (0.9..1.2).contains(&order), "{moduli:?} {time}: {order}");
        }
    }
}

/// At any relaxation time, also far below the step.
#[test]
fn steps_are_of_second_order() {
    for springs in [false, true] {
        for time in [0.5, 5.0, 50.0] {
            let case = Case { springs, moduli: [20.0, 60.0], time };
            let fine = sheared(&case, 0.2, 320);
            let error = |steps: usize| (sheared(&case, 0.2, steps) - fine).abs();
            let [coarse, half] = [error(20), error(40)];
            assert!((1.9..2.4).contains(&(coarse / half).log2()), "{springs} {time}: {coarse:e} {half:e}");
            assert!(half < 1e-3, "{springs} {time}: {half:e}");
        }
        // Steps of forty relaxation times err no more than those of an elastic layer.
        let case = Case { springs, moduli: [20.0, 5.0], time: 1e-3 };
        let error = (sheared(&case, 0.2, 25) - sheared(&case, 0.2, 2000)).abs();
        assert!(error < 3e-4, "{springs}: {error:e}");
    }
}

/// A short time leaves the modulus of the long run, a long one that of fast strains.
#[test]
fn extreme_times_are_those_of_elastic_layers() {
    let found = |moduli: [f64; 2], time: f64| sheared(&Case { springs: false, moduli, time }, 0.1, 80);
    let [soft, stiff] = [20.0, 80.0].map(|shear| found([shear, 0.0], 1.0));
    assert!((soft - stiff).abs() > 0.3);
    for time in [1e-4, 1e-6, 1e-30, 1e-300] {
        assert!((found([20.0, 60.0], time) - soft).abs() < 2e-4, "{time:e}");
    }
    for time in [1e6, 1e30, 1e300] {
        assert!((found([20.0, 60.0], time) - stiff).abs() < 1e-5, "{time:e}");
    }
}

/// The limit counts the moduli that relax, at any relaxation time.
#[test]
fn steps_are_stable_up_to_their_limit() {
    let rough = |s: Vec2| s + 1e-4 * Vec2::new((91.0 * s.x + 37.0 * s.y).sin(), (53.0 * s.x - 71.0 * s.y).sin());
    let growth = |springs: bool, time: f64, part: f64| {
        let h = 0.1;
        let mut scene = channel(h);
        let case = Case { springs, moduli: [5.0, 15.0], time };
        let solid = layer(&case, h).deformed(rough).unwrap();
        let energy = |solid: &Solid| solid.elastic_energy().unwrap() + solid.relaxing_energy().unwrap();
        let start = energy(&solid);
        let handle = scene.add(solid);
        let limit = scene.system().step_limit().unwrap().0.dt;
        for _ in 0..60 {
            if scene.step(part * limit).is_err() {
                return f64::INFINITY;
            }
        }
        energy(scene.body(handle).unwrap()) / start
    };
    for springs in [false, true] {
        for time in [1e-9, 1e-3, 0.1, 0.3, 1.0, 3.0, 100.0] {
            let grown = growth(springs, time, 0.97);
            assert!(grown < 1.0, "{springs} {time}: {grown}");
        }
        assert!(growth(springs, 100.0, 1.5) > 1e3);
    }
}

/// A Kelvin-Voigt layer of the viscosity e relaxes at the rate `G/(e + eta a/(H - a))`, in the steps of an elastic one,
/// also where it is a thousand times as viscous as the fluid; and resists the least mobile of all motions not at all.
#[test]
fn viscous_layers_relax_at_the_exact_rate_in_elastic_steps() {
    for ratio in [1.5, 4.0, 30.0, 1000.0] {
        let shear = 20.0;
        let rate = shear / (VISCOSITY * (ratio + THICKNESS / (HEIGHT - THICKNESS)));
        let elastic = Case { springs: false, moduli: [shear, 0.0], time: 1.0 };
        let found = |h: f64, steps: usize| {
            let mut scene = channel(h);
            let solid = layer(&elastic, h).with_excess_viscosity((ratio - 1.0) * VISCOSITY).unwrap();
            let handle = scene.add(solid);
            let dt = 1.0 / (rate * steps as f64);
            (0..steps).for_each(|_| scene.step(dt).unwrap());
            top(scene.body(handle).unwrap())
        };
        let exact = (-1.0_f64).exp();
        let error = |h: f64| (found(h, 30) - exact).abs();
        let [coarse, fine] = [error(0.2), error(0.1)];
        assert!(fine < 0.03 && fine < 0.7 * coarse, "{ratio}: {coarse:e} {fine:e}");
        let best = found(0.2, 320);
        let [longer, half] = [(found(0.2, 10) - best).abs(), (found(0.2, 20) - best).abs()];
        assert!((1.8..2.4).contains(&(longer / half).log2()), "{ratio}: {longer:e} {half:e}");
    }
}

#[test]
fn a_step_allocates_nothing() {
    for springs in [false, true] {
        let mut scene = channel(0.1);
        let case = Case { springs, moduli: [20.0, 60.0], time: 0.5 };
        scene.add(layer(&case, 0.1).with_active_springs(ActiveSprings::new(0.1, 1.0, 1.0, 1).unwrap()));
        (0..3).for_each(|_| scene.step(0.01).unwrap());
        assert_eq!(measure(|| (0..5).for_each(|_| scene.step(0.01).unwrap())).count_total, 0);
    }
}

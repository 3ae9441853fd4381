//! Solids in the flow of the grid: stability limits, no allocation.

use allocation_counter::measure;
use elastic_solids::mesh::{TriangleMesh, equilateral_block, fitted_strip};
use elastic_solids::{NeoHookean, Outline, Solid};
use ib_core::{AnyKernel, ImmersedBoundary};
use motile_base::Vec2;
use motile_scene::Scene;
use stokes_grid::{ChannelStokes, Grid};

type Channel = Scene<ImmersedBoundary<ChannelStokes, AnyKernel>>;

const LENGTH: f64 = 1.6;
const HEIGHT: f64 = 2.0;
const VISCOSITY: f64 = 10.0;
const SHEAR: f64 = 5.0;

fn channel(h: f64) -> Channel {
    let grid = Grid::channel((LENGTH / h).round() as usize, (HEIGHT / h).round() as usize, h).expect("a grid");
    let solver = ChannelStokes::new(grid, VISCOSITY).expect("a solver");
    Scene::new(ImmersedBoundary::new(solver, AnyKernel::BSpline4))
}

/// A layer of the given thickness on the lower wall.
fn layer(thickness: f64, spacing: f64) -> TriangleMesh {
    fitted_strip(Vec2::new(0.0, -0.5 * HEIGHT), [LENGTH, thickness], spacing).expect("a mesh")
}

fn on_the_wall(s: Vec2) -> bool {
    s.y < -0.5 * HEIGHT + 1e-9
}

/// Pinned on the lower wall.
fn held(solid: Solid) -> Solid {
    solid.pinned(on_the_wall).expect("free points")
}

fn springs(mesh: TriangleMesh) -> Solid {
    Solid::springs(mesh, SHEAR).expect("a modulus")
}

/// The elastic or tether energy after 60 steps over that at the start; infinite after an error.
fn growth(solid: Solid, h: f64, steps_over_limit: f64, energy: fn(&Solid) -> f64) -> f64 {
    let mut scene = channel(h);
    let handle = scene.add(solid);
    let limit = scene.system().step_limit().expect("a limit").0.dt;
    let start = energy(scene.body(handle).expect("a solid"));
    for _ in 0..60 {
        if scene.step(steps_over_limit * limit).is_err() {
            return f64::INFINITY;
        }
    }
    energy(scene.body(handle).expect("a solid")) / start
}

#[test]
fn steps_are_stable_up_to_their_limit() {
    let h = 0.1;
    let rough = |s: Vec2| s + 1e-4 * Vec2::new((91.0 * s.x + 37.0 * s.y).sin(), (53.0 * s.x - 71.0 * s.y).sin());
    for (bulk, spacing) in [(2.0, 0.5), (2.0, 1.0), (2.0, 2.0), (20.0, 0.5), (20.0, 1.0), (20.0, 1.5), (20.0, 2.0)] {
        let grown = |steps_over_limit: f64| {
            let material = NeoHookean::new(SHEAR, bulk * SHEAR).unwrap();
            let solid = held(Solid::hyperelastic(layer(1.0, spacing * h), material)).deformed(rough).unwrap();
            growth(solid, h, steps_over_limit, |solid| solid.elastic_energy().unwrap())
        };
        assert!(grown(0.97) < 1.0, "bulk {bulk}, spacing {spacing}");
        // The limit is at least two thirds of what it could be.
        assert!(grown(1.5) > 1e3, "bulk {bulk}, spacing {spacing}");
    }
}

#[test]
fn tethered_solids_are_stable_up_to_their_limit() {
    let h = 0.1;
    let held = |low: f64, high: f64, steps_over_limit: f64| {
        let mesh = fitted_strip(Vec2::new(0.0, -0.6), [LENGTH, 1.2], h).unwrap();
        let solid = Solid::springs(mesh, 1e-3).unwrap().tethered(100.0, |s| s.y > low && s.y < high).unwrap();
        growth(solid.deformed(|s| s + Vec2::new(1e-3, 0.0)).unwrap(), h, steps_over_limit, Solid::tether_energy)
    };
    for (low, high) in [(-0.06, 0.06), (-0.3, 0.3), (-0.7, 0.7)] {
        let (stable, unstable) = (held(low, high, 0.97), held(low, high, 1.5));
        assert!(stable < 1.0 && unstable > 1e3, "from {low} to {high}: {stable} {unstable}");
    }
}

/// In mid-stream, the fluid carries the free points past the pinned points, which makes the elements between the two
/// the stiffest.
#[test]
fn solids_pinned_in_mid_stream_are_stable_up_to_their_limit() {
    let h = 0.1;
    let held = |rows: usize, bulk: f64, pinned: &dyn Fn(Vec2) -> bool, steps_over_limit: f64| {
        let height = h * rows as f64;
        let mesh = equilateral_block(Vec2::new(0.3, -0.5 * height), 12, rows, h).unwrap();
        let material = NeoHookean::new(SHEAR, bulk * SHEAR).unwrap();
        let mut solid = Solid::hyperelastic(mesh, material).pinned(pinned).unwrap();
        let mut moved = solid.positions().to_vec();
        solid.free_points().iter().for_each(|&point| moved[point] += Vec2::splat(1e-4));
        solid.set_positions(&moved).unwrap();
        growth(solid, h, steps_over_limit, |solid| solid.elastic_energy().unwrap())
    };
    for (rows, bulk, too_long) in [(4, 1.0, 3.0), (10, 1.0, 3.0), (16, 1.0, 3.0), (10, 20.0, 8.0), (16, 20.0, 8.0)] {
        let lowest = -0.05 * rows as f64;
        let places: [(&str, &dyn Fn(Vec2) -> bool); 3] = [
            ("one column", &|s: Vec2| s.x < 0.36),
            ("two columns", &|s: Vec2| s.x < 0.46),
            ("the lowest row", &|s: Vec2| s.y < lowest + 0.01),
        ];
        for (name, pinned) in places {
            let [stable, unstable] = [0.97, too_long].map(|by| held(rows, bulk, pinned, by));
            assert!(stable < 1.0 && unstable > 1e3, "{rows} rows, bulk {bulk}, {name}: {stable} {unstable}");
        }
    }
}

#[test]
fn a_step_allocates_nothing() {
    let mut scene = channel(0.1);
    let solid = Solid::springs(layer(0.8, 0.1), SHEAR).unwrap().pinned(on_the_wall).unwrap();
    scene.add(solid.tethered(1.0, |s| s.y > -0.5).unwrap());
    let material = NeoHookean::new(SHEAR, SHEAR).unwrap();
    scene.add(Solid::hyperelastic(Outline::circle(Vec2::new(0.5, 0.4), 0.3).unwrap().mesh(0.1).unwrap(), material));
    (0..3).for_each(|_| scene.step(0.01).unwrap());
    assert_eq!(measure(|| (0..5).for_each(|_| scene.step(0.01).unwrap())).count_total, 0);
}

#[test]
fn a_scene_tells_what_is_seen_of_a_solid() {
    let mut scene = channel(0.1);
    let shear = |s: Vec2| s + Vec2::new(0.1 * (s.y + 0.5 * HEIGHT), 0.0);
    let handle = scene.add(held(springs(layer(0.5, 0.1))).deformed(shear).expect("positions"));
    let seen = scene.observe(handle).expect("a solid");
    assert!((seen.largest_displacement - 0.05).abs() < 1e-12 && seen.largest_normal_displacement < 1e-12);
    assert!((seen.drift - Vec2::new(0.025, 0.0)).length() < 1e-12);
    assert!((seen.smallest_jacobian - 1.0).abs() < 1e-12);
    // The density of the energy of a simple shear g is mu g^2/2, of springs to third order.
    let energy = 0.5 * SHEAR * 0.01 * LENGTH * 0.5;
    assert!((seen.elastic_energy / energy - 1.0).abs() < 0.05, "{} {energy}", seen.elastic_energy);
}

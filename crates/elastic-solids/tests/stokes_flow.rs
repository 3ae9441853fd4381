//! Solids in the flow of the grid: exact relaxation, stability limits, no allocation.

use allocation_counter::measure;
use elastic_solids::{
    ElasticForces, ElasticSolid, Mesher, NeoHookean, Outline, Region, Solid, SpringLattice, TriangleMesh, fitted_strip,
};
use ib_core::{Body, CubicQuadratic, Hydrodynamics, ImmersedBoundary, Scene, Vec2};
use stokes_grid::{ChannelStokes, Grid};

type Channel = Scene<ImmersedBoundary<ChannelStokes, CubicQuadratic>>;

const LENGTH: f64 = 1.6;
const HEIGHT: f64 = 2.0;
const VISCOSITY: f64 = 10.0;
const SHEAR: f64 = 5.0;

/// The time eta/mu.
const TIME: f64 = VISCOSITY / SHEAR;

fn channel(h: f64) -> Channel {
    let grid = Grid::channel((LENGTH / h).round() as usize, (HEIGHT / h).round() as usize, h).unwrap();
    let solver = ChannelStokes::new(grid, VISCOSITY).unwrap();
    Scene::new(ImmersedBoundary::new(solver, CubicQuadratic::default()))
}

/// A layer of the given thickness on the lower wall.
fn layer(thickness: f64, spacing: f64) -> TriangleMesh {
    fitted_strip(Vec2::new(0.0, -0.5 * HEIGHT), [LENGTH, thickness], spacing).unwrap()
}

fn on_the_wall(s: Vec2) -> bool {
    s.y < -0.5 * HEIGHT + 1e-9
}

/// Mean displacement of the upper surface along x.
fn slide<F: ElasticForces>(solid: &Solid<F>) -> f64 {
    let boundary = solid.mesh().boundary_loops().iter().find(|boundary| boundary.periods == -1).unwrap();
    let displacements: Vec<Vec2> = solid.displacements().collect();
    boundary.points.iter().map(|&point| displacements[point].x).sum::<f64>() / boundary.points.len() as f64
}

/// The rate, times eta/mu, at which a sheared layer relaxes below a fluid of the same viscosity.
///
/// Under the shear gamma the stress is `eta dgamma/dt + mu gamma` in the layer (Kelvin-Voigt; exact at any shear for the
/// neo-Hookean material), `eta du/dy` above, and the same everywhere; with both walls at rest, `a dgamma/dt + (H - a) du/dy = 0`. So gamma
/// decays at the rate `mu/eta (1 - a/H)`.
fn relaxation_rate<F: ElasticForces>(solid: Solid<F>, h: f64, amplitude: f64) -> f64 {
    let sheared = |s: Vec2| s + Vec2::new(amplitude * (s.y + 0.5 * HEIGHT), 0.0);
    let mut scene = channel(h);
    let handle = scene.add(solid.pinned(on_the_wall).unwrap().deformed(sheared).unwrap());
    let start = slide(scene.body(handle));
    (0..50).for_each(|_| scene.step(TIME / 50.0).unwrap());
    -(slide(scene.body(handle)) / start).ln()
}

#[test]
fn a_sheared_layer_relaxes_as_kelvin_voigt() {
    let thickness = 0.9;
    let exact = 1.0 - thickness / HEIGHT;
    let errors = |rate: &dyn Fn(f64) -> f64| [0.2, 0.1, 0.05].map(|h| rate(h) / exact - 1.0);
    let neo_hookean = |mesh| ElasticSolid::new(mesh, NeoHookean::new(SHEAR, 3.0 * SHEAR).unwrap());
    let hyperelastic = errors(&|h| relaxation_rate(neo_hookean(layer(thickness, h)), h, 0.3));
    let springs = errors(&|h| relaxation_rate(SpringLattice::new(layer(thickness, h), SHEAR).unwrap(), h, 0.01));
    let unstructured = errors(&|h| {
        let flat = |y| Outline::flat(0.0, LENGTH, y).unwrap();
        let region = Region::new([flat(-0.5 * HEIGHT), flat(thickness - 0.5 * HEIGHT)]).unwrap();
        let mesh = Mesher::new(h).unwrap().turned(0.2).unwrap().mesh(&region).unwrap();
        relaxation_rate(neo_hookean(mesh), h, 0.3)
    });
    for errors in [hyperelastic, springs, unstructured] {
        assert!(errors[2].abs() < 0.035, "{errors:?}");
        // First order: the stress of the layer is smeared over its surface.
        let order = (errors[0] / errors[2]).log2() / 2.0;
        assert!(order > 0.8, "{errors:?}, order {order}");
    }
    for (structured, unstructured) in hyperelastic.iter().zip(unstructured) {
        assert!((structured - unstructured).abs() < 2e-3, "{structured} {unstructured}");
    }
}

/// The elastic or tether energy after 60 steps over that at the start; infinite after an error.
fn growth<F: ElasticForces>(solid: Solid<F>, h: f64, steps_over_limit: f64, energy: fn(&Solid<F>) -> f64) -> f64 {
    let mut scene = channel(h);
    let handle = scene.add(solid);
    let limit = scene.body(handle).step_limits(&scene.system().hydrodynamics().medium())[0].dt;
    let start = energy(scene.body(handle));
    for _ in 0..60 {
        if scene.step(steps_over_limit * limit).is_err() {
            return f64::INFINITY;
        }
    }
    energy(scene.body(handle)) / start
}

#[test]
fn steps_are_stable_up_to_their_limit() {
    let h = 0.1;
    let rough = |s: Vec2| s + 1e-4 * Vec2::new((91.0 * s.x + 37.0 * s.y).sin(), (53.0 * s.x - 71.0 * s.y).sin());
    for (bulk, spacing) in [(2.0, 0.5), (2.0, 1.0), (2.0, 2.0), (20.0, 0.5), (20.0, 1.0), (20.0, 1.5), (20.0, 2.0)] {
        let grown = |steps_over_limit: f64| {
            let material = NeoHookean::new(SHEAR, bulk * SHEAR).unwrap();
            let solid = ElasticSolid::new(layer(1.0, spacing * h), material);
            let solid = solid.pinned(on_the_wall).unwrap().deformed(rough).unwrap();
            growth(solid, h, steps_over_limit, |solid| solid.elastic_energy().unwrap())
        };
        assert!(grown(0.97) < 1.0, "bulk {bulk}, spacing {spacing}");
        // The limit is no more than half as small as it need be.
        assert!(grown(1.5) > 1e3, "bulk {bulk}, spacing {spacing}");
    }
}

#[test]
fn tethered_solids_are_stable_up_to_their_limit() {
    let h = 0.1;
    let held = |low: f64, high: f64, steps_over_limit: f64| {
        let mesh = fitted_strip(Vec2::new(0.0, -0.6), [LENGTH, 1.2], h).unwrap();
        let solid = SpringLattice::new(mesh, 1e-3).unwrap().tethered(100.0, |s| s.y > low && s.y < high).unwrap();
        growth(solid.deformed(|s| s + Vec2::new(1e-3, 0.0)).unwrap(), h, steps_over_limit, Solid::tether_energy)
    };
    for (low, high) in [(-0.06, 0.06), (-0.3, 0.3), (-0.7, 0.7)] {
        let (stable, unstable) = (held(low, high, 0.97), held(low, high, 1.5));
        assert!(stable < 1.0 && unstable > 1e3, "from {low} to {high}: {stable} {unstable}");
    }
}

#[test]
fn a_step_allocates_nothing() {
    let mut scene = channel(0.1);
    let solid = SpringLattice::new(layer(0.8, 0.1), SHEAR).unwrap().pinned(on_the_wall).unwrap();
    scene.add(solid.tethered(1.0, |s| s.y > -0.5).unwrap());
    let material = NeoHookean::new(SHEAR, SHEAR).unwrap();
    scene.add(ElasticSolid::new(Outline::circle(Vec2::new(0.5, 0.4), 0.3).unwrap().mesh(0.1).unwrap(), material));
    (0..3).for_each(|_| scene.step(0.01).unwrap());
    assert_eq!(measure(|| (0..5).for_each(|_| scene.step(0.01).unwrap())).count_total, 0);
}

//! Viscoelastic layers on a wall under fluid at rest: rates of relaxation against the exact ones, orders, limits.

use elastic_solids::mesh::fitted_strip;
use elastic_solids::{Maxwell, NeoHookean, Solid};
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
    let mesh = fitted_strip(Vec2::new(0.0, -0.5 * HEIGHT), [8.0 * h, THICKNESS], h).unwrap();
    let [shear, relaxing] = case.moduli;
    let solid = match (shear > 0.0, case.springs) {
        (false, _) => Solid::fluid_like(mesh),
        (true, true) => Solid::springs(mesh, shear).unwrap(),
        (true, false) => Solid::hyperelastic(mesh, NeoHookean::new(shear, 2.0 * shear).unwrap()),
    };
    let solid = if relaxing > 0.0 {
        solid.with_maxwell(Maxwell::new(relaxing, case.time).unwrap()).unwrap()
    } else {
        solid
    };
    let low = |s: Vec2| s.y < -0.5 * HEIGHT + 1e-9;
    solid.pinned(low).unwrap().deformed(|s| s + Vec2::new(STRAIN * (s.y + 0.5 * HEIGHT), 0.0)).unwrap()
}

/// Shear of the layer over that at the start after the time 1, in `steps` steps.
fn sheared(case: &Case, h: f64, steps: usize) -> f64 {
    let grid = Grid::channel(8, (HEIGHT / h).round() as usize, h).unwrap();
    let solver = ChannelStokes::new(grid, VISCOSITY).unwrap();
    let mut scene = Scene::new(ImmersedBoundary::new(solver, AnyKernel::BSpline4));
    let handle = scene.add(layer(case, h));
    (0..steps).for_each(|_| scene.step(1.0 / steps as f64).unwrap());
    let solid = scene.body(handle).unwrap();
    let moved = |y: f64| {
        let row = solid.mesh().points().iter().zip(solid.displacements());
        let at = row.filter(|(s, _)| (s.y - y).abs() < 1e-9).map(|(_, moved)| moved.x).collect::<Vec<f64>>();
        at.iter().sum::<f64>() / at.len() as f64
    };
    moved(-0.5 * HEIGHT + THICKNESS) / (STRAIN * THICKNESS)
}

#[test]
fn probe() {
    for springs in [false, true] {
        for (moduli, time) in [([20.0, 60.0], 0.5), ([20.0, 60.0], 0.05), ([20.0, 60.0], 5.0), ([0.0, 80.0], 0.5)] {
            let case = Case { springs, moduli, time };
            print!("{springs} {moduli:?} {time} exact {:.5}:", exact(&case, 1.0));
            for h in [0.2, 0.1, 0.05] {
                print!(" {:+.2e}", sheared(&case, h, 100) - exact(&case, 1.0));
            }
            println!();
            let fine = sheared(&case, 0.1, 320);
            for steps in [10, 20, 40, 80] {
                print!(" {:+.2e}", sheared(&case, 0.1, steps) - fine);
            }
            println!();
        }
    }
    for time in [1e-3, 1e-6, 1e-30, 1e6, 1e30] {
        let case = Case { springs: false, moduli: [20.0, 60.0], time };
        println!("tau {time}: exact {} found {}", exact(&case, 1.0), sheared(&case, 0.1, 20));
    }
    for moduli in [[20.0, 0.0], [80.0, 0.0]] {
        let case = Case { springs: false, moduli, time: 1.0 };
        println!("elastic {moduli:?} {}", sheared(&case, 0.1, 20));
    }
}

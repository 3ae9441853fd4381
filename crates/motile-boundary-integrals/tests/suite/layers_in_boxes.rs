//! Layers next to a grid, for interfaces inside interfaces.

use std::f64::consts::TAU;

use ib_core::BSpline;
use motile_base::Vec2;
use motile_boundary_integrals::ImmersedLayers;
use motile_scene::{MarkerBody, MarkerKind, Scene, StepSize};
use stokes_grid::{Grid, PeriodicStokes};

/// A box of 3.2 by 3.2 with grid spacing 0.1.
fn solver(viscosity: f64) -> PeriodicStokes {
    let grid = Grid::periodic(32, 32, 0.1).expect("a grid");
    PeriodicStokes::new(grid, viscosity).expect("a solver")
}

fn circle(centre: Vec2, radius: f64) -> Vec<Vec2> {
    let count = (TAU * radius / 0.08).ceil().max(16.0);
    (0..count as usize)
        .map(|k| centre + radius * Vec2::new((TAU * k as f64 / count).cos(), (TAU * k as f64 / count).sin()))
        .collect()
}

/// An interface without tension that moves at `velocity` with no regard to the fluid.
fn ring(name: &str, centre: Vec2, radius: f64, viscosity_inside: Option<f64>, velocity: Vec2) -> MarkerBody {
    MarkerBody::new(name, circle(centre, radius), |_, _| {})
        .with_kind(MarkerKind::Interface { viscosity_inside })
        .with_motion(move |_, _, rates| rates.fill(velocity))
}

#[test]
fn an_interface_in_fluid_of_the_same_viscosity_is_solved() {
    let layers = || {
        let flow = ImmersedLayers::new(solver(10.0), BSpline::<4>, 16, 1e-6).unwrap();
        Scene::new(flow).with_step_size(StepSize::Fixed(0.05))
    };
    for outside in [None, Some(10.0)] {
        let mut scene = layers();
        scene.add(ring("outer", Vec2::ZERO, 1.0, outside, Vec2::ZERO));
        scene.add(ring("inner", Vec2::new(0.6, 0.0), 0.3, Some(50.0), Vec2::ZERO));
        scene.run(0.2).go().unwrap();
        // The distance from within.
        let gap = scene.system().minimum_gap().unwrap();
        assert!((gap - 0.1).abs() < 3e-4, "{gap}");
    }
    // Beside each other any viscosity will do.
    let mut scene = layers();
    scene.add(ring("left", Vec2::new(-0.7, 0.0), 0.5, Some(100.0), Vec2::ZERO));
    scene.add(ring("right", Vec2::new(0.7, 0.0), 0.5, Some(1.0), Vec2::ZERO));
    scene.run(0.1).go().unwrap();
}

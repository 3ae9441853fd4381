use active_interface::{ConstantTension, Curve};
use ib_core::{AnyKernel, ImmersedBoundary};
use motile_scene::Scene;
use stokes_grid::{Grid, PeriodicStokes};

use super::*;

/// The place where a mesh is folded is told: between the arms of a star, far from the origin.
#[test]
fn stars_are_too_bent() {
    let solver = PeriodicStokes::new(Grid::periodic(40, 40, 0.1).unwrap(), 1.0).unwrap();
    let mut scene = Scene::new(ImmersedBoundary::new(solver, AnyKernel::BSpline4));
    let centre = Vec2::new(10.0, -20.0);
    let mut refused = |arm: f64| {
        let star = Curve::fourier(1.0, &[0.0, 0.0, arm], &[]).unwrap().translated(centre);
        let markers = star.markers(96).unwrap();
        let tension = ConstantTension::new(1.0).unwrap();
        let droplet = ActiveDroplet::new(&markers, vec![1.0; 96], tension, 1.0).unwrap().with_open_number();
        let host = scene.add(droplet.clone());
        ParticlesInDroplet::new(&droplet, host, Exchange::new(1.0, 1.0).unwrap(), 0.5, |_| 1.0, 0.1).err()
    };
    assert!(refused(0.05).is_none());
    let Some(InteriorError::Folded { x, y }) = refused(0.4) else { panic!("it is not folded") };
    assert!((0.1..1.7).contains(&centre.distance(Vec2::new(x, y))), "{x} {y}");
}

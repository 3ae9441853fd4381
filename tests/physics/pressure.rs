//! The constant of the pressure.

use motile::base::FlowSample;
use motile::prelude::*;
use motile::setup::GridSolver;

/// Pressures inside the first droplet and next to both walls.
fn pressures(setup: &Setup, points: &[Vec2]) -> Vec<f64> {
    let mut scene = setup.build().expect("a valid scene").scene;
    let mut samples = vec![FlowSample::default(); points.len()];
    scene.system_mut().sample(points, &mut samples).expect("samples");
    samples.iter().map(|sample| sample.pressure).collect()
}

fn channel(method: Method, droplet: DropletSetup) -> Setup {
    let region = Region::Channel { length: 6.0, width: 6.0, drive: Drive::Gradient(-0.3) };
    Setup { region, method, viscosity: 1.0, droplets: vec![droplet], ..Setup::default() }
}

/// A round drop at rest: the pressure is its tension over its radius inside and zero outside, by every method.
#[test]
fn the_constant_is_the_same_for_every_method() {
    let drop = DropletSetup { centre: [0.3, 0.2], ..DropletSetup::passive(10.0) };
    let points = [Vec2::new(0.3, 0.2), Vec2::new(2.9, 2.8), Vec2::new(-2.0, -2.7)];
    let integral = Method::Integral(IntegralMethod { nodes: 64, elements: 256 });
    let spacing = |h: f64| Method::Grid(GridMethod::of_spacing(h));
    let projection = Method::Grid(GridMethod { solver: GridSolver::Projection, ..GridMethod::of_spacing(0.1) });
    let layers = Method::Layers(LayersMethod::of_spacing(0.1));
    for (method, tolerance) in [(integral, 1e-3), (layers, 1e-3), (spacing(0.1), 0.05), (projection, 0.05)] {
        let found = pressures(&channel(method, drop.clone()), &points);
        assert!((found[0] - 10.0).abs() < tolerance, "{method:?} {found:?}");
        assert!(found[1..].iter().all(|outside| outside.abs() < tolerance), "{method:?} {found:?}");
    }
}

/// A swimmer off the centre line that also is of another viscosity: layers next to a solid agree with integrals.
#[test]
fn the_constant_of_a_swimmer() {
    let points = [Vec2::new(0.3, 0.6), Vec2::new(-2.0, -2.5), Vec2::new(2.0, 2.5), Vec2::new(2.7, 0.1)];
    let at = |method: Method, viscosity: Option<f64>| {
        let droplet = DropletSetup { centre: [0.3, 0.6], angle: 0.7, viscosity, ..DropletSetup::active(-3.0) };
        pressures(&Setup { viscosity: 100.0, ..channel(method, droplet) }, &points)
    };
    let fine = Method::Integral(IntegralMethod { nodes: 96, elements: 384 });
    let exact = at(fine, None);
    let errors = [0.1, 0.05].map(|h| {
        let found = at(Method::Grid(GridMethod::of_spacing(h)), None);
        found.iter().zip(&exact).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max)
    });
    // The tension is some 200.
    assert!(errors[1] < 1.0 && errors[1] < errors[0], "{errors:?} {exact:?}");
    // The walls are the reference, whatever the viscosity inside.
    let other = at(fine, Some(300.0));
    let mean = |values: &[f64]| 0.5 * (values[1] + values[2]);
    assert!(mean(&other).abs() < 0.1 * other[0].abs() && mean(&exact).abs() < 0.1 * exact[0].abs(), "{other:?}");
}

/// The mean over both walls of a channel is zero, next to a droplet of any viscosity and off the middle.
#[test]
fn the_mean_over_the_walls_is_zero() {
    let places = |y: f64| (0..60).map(move |k| Vec2::new(-3.0 + 0.1 * f64::from(k), y));
    let points: Vec<Vec2> = places(-2.999).chain(places(2.999)).collect();
    for viscosity in [None, Some(30.0), Some(400.0)] {
        let droplet = DropletSetup { centre: [0.3, 0.6], angle: 0.7, viscosity, ..DropletSetup::active(-3.0) };
        let integral = Method::Integral(IntegralMethod { nodes: 96, elements: 384 });
        let setup = Setup { viscosity: 100.0, tolerance: Some(1e-10), ..channel(integral, droplet) };
        let found = pressures(&setup, &points);
        let [sum, most] = found.iter().fold([0.0_f64; 2], |[sum, most], p| [sum + p, most.max(p.abs())]);
        assert!((sum / 120.0).abs() < 1e-6 * most && most > 0.1, "{viscosity:?}: {} of {most}", sum / 120.0);
    }
}

//! The constant of the pressure.

use std::f64::consts::PI;

use motile::base::{FlowSample, TubeShape};
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

/// The flow of Poiseuille past a droplet: the report has the gradient of the flux far from the droplet, and samples are
/// without it, so that both together are the pressure there.
#[test]
fn tubes_have_the_pressure_gradient_of_poiseuille() {
    let radius = 1.6_f64;
    let [viscosity, flux] = [3.0, 0.7];
    let exact = -8.0 * viscosity * flux / (PI * radius.powi(4));
    let of = |drive, shape, length| {
        let region = Region::Tube { radius, shape, drive, length };
        let droplets = vec![DropletSetup::passive(10.0)];
        let method = Method::Integral(IntegralMethod { nodes: 48, elements: 96 });
        let mut scene = Setup { region, method, viscosity, droplets, ..Setup::default() }.build().unwrap().scene;
        let points = [-4.0, 4.0].map(|x| Vec2::new(x, 0.0));
        let mut samples = [FlowSample::default(); 2];
        scene.system_mut().sample(&points, &mut samples).unwrap();
        scene.system_mut().evaluate().unwrap();
        (scene.system().report().mean_pressure_gradient, samples[1].pressure - samples[0].pressure)
    };
    // A droplet adds a jump of the pressure, which does not depend on the length of the tube.
    let (infinite, jump) = of(Drive::Flux(flux), TubeShape::Straight, None);
    assert!((infinite[0] / exact - 1.0).abs() < 1e-12 && infinite[1] == 0.0, "{infinite:?} {exact}");
    let length = 12.0;
    let (mean, rest) = of(Drive::Flux(flux), TubeShape::Straight, Some(length));
    assert!((mean[0] - exact - jump / length).abs() < 1e-6 * exact.abs(), "{mean:?} {exact} {jump}");
    assert!((rest + mean[0] * 8.0 - jump - exact * 8.0).abs() < 1e-9, "{rest} {jump}");
    let (prescribed, _) = of(Drive::Gradient(-0.4), TubeShape::Straight, Some(length));
    assert!((prescribed[0] + 0.4).abs() < 1e-12, "{prescribed:?}");
    let (still, _) = of(Drive::ZeroFlux, TubeShape::Straight, None);
    assert_eq!(still, [0.0; 2]);

    // Where the wall is not straight there is none, and samples are the pressure: beyond the throat it falls by more
    // than in a straight tube of the same radius.
    let throat = TubeShape::Constriction { throat: 1.4, throat_length: 2.0, ramp: 2.0 };
    let (none, drop) = of(Drive::Flux(flux), throat, Some(20.0));
    assert!(none[0].is_nan(), "{none:?}");
    assert!(drop < jump + 8.0 * exact, "{drop} {jump}");
}

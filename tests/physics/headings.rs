//! Swimmers off the grid's axes: the grid neither turns them nor changes their speed.

use motile::base::{Drive, Region};
use motile::elastic_solids::ChannelShape;
use motile::scene::StepSize;
use motile::setup::{
    Built, DropletSetup, GridMethod, LayersMethod, Material, Method, Particles, Setup, SolidSetup, Start,
};
use motile_tests::validation::headings::{course, off_axis};
use motile_tests::validation::scene::{on_grid, without_grid};

/// Largest differences from another course, with their signs.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Deviation {
    /// Relative.
    speed: f64,
    /// Of the direction (radians).
    heading: f64,
}

/// Largest deviations from boundary integrals to t = 40, for some directions.
fn deviations(activity: f64, h: f64) -> Vec<Deviation> {
    let deviation = |angle| {
        let exact = off_axis(without_grid(64, 256).method, activity, angle);
        let exact = course(&Setup { step: StepSize::OfLimit(0.5), ..exact }, 10.0, 40.0).expect("a swimmer");
        let found = course(&off_axis(on_grid(h).method, activity, angle), 10.0, 40.0).expect("a swimmer");
        let largest = |values: &mut dyn Iterator<Item = f64>| {
            values.fold(0.0_f64, |most, value| if value.abs() > most.abs() { value } else { most })
        };
        Deviation {
            speed: largest(&mut found.speeds.iter().zip(&exact.speeds).map(|(a, b)| a / b - 1.0)),
            heading: largest(&mut found.headings.iter().zip(&exact.headings).map(|(a, b)| a - b)),
        }
    };
    [0.15, 0.4, 0.6].into_iter().map(deviation).collect()
}

#[test]
fn a_grid_does_not_turn_a_swimmer() {
    for activity in [-2.0, -3.0] {
        let (coarse, fine) = (deviations(activity, 0.1), deviations(activity, 0.05));
        for (coarse, fine) in coarse.iter().zip(&fine) {
            assert!(coarse.heading.abs() < 0.012 && coarse.speed.abs() < 6e-3, "{activity}: {coarse:?}");
            assert!(fine.heading.abs() < 0.004 && fine.speed.abs() < 2e-3, "{activity}: {fine:?}");
        }
    }
}

/// A round droplet with uniform particles below the threshold of swimming stays where it is. The grid moves its markers
/// by some 1e-8 all the same, in a direction of its own, which is no heading.
#[test]
fn a_droplet_at_rest_on_a_grid_has_no_direction() {
    let region = Region::Box { lengths: [6.0; 2] };
    let grid = |spacing| Method::Grid(GridMethod::of_spacing(spacing));
    let uncorrected = |spacing| Method::Grid(GridMethod::uncorrected(spacing));
    for (region, method, viscosity) in [
        (region, uncorrected(0.1), Some(1000.0)),
        (region, uncorrected(0.2), Some(1000.0)),
        (region, grid(0.1), None),
        (region, grid(0.2), None),
        (Region::Channel { length: 8.0, width: 4.0, drive: Drive::ZeroFlux }, grid(0.1), None),
        (
            Region::Channel { length: 8.0, width: 4.0, drive: Drive::ZeroFlux },
            Method::Layers(LayersMethod::of_spacing(0.1)),
            None,
        ),
    ] {
        let particles = Particles { activity: -0.2, start: Start::Uniform, ..Particles::default() };
        let droplet =
            DropletSetup { centre: [0.333, 0.017], viscosity, particles: Some(particles), ..DropletSetup::default() };
        let shape = ChannelShape::Straight { width: 3.4 };
        let layers = matches!(method, Method::Layers(_));
        let solids = SolidSetup::walls(&shape, &Material::Springs { shear: 187.5 });
        let solids = if layers { solids } else { Vec::new() };
        let setup = Setup { region, method, droplets: vec![droplet], solids, ..Setup::default() };
        let Built { mut scene, droplets, .. } = setup.build().unwrap();
        for until in [0.0, 0.6, 1.3] {
            scene.run(until).go().unwrap();
            let seen = scene.observe(droplets[0]).unwrap();
            println!("{method:?} {until}: {:e} {:e}", seen.speed(), seen.shape.deformation());
            assert_eq!(seen.heading(), None, "{method:?} {until}: {:e}", seen.speed());
            for name in ["heading_degrees", "beta", "beta_laboratory", "inclination_degrees"] {
                assert_eq!(seen.get(name), None, "{method:?} {until} {name}");
            }
        }
    }
    // Slow swimmers have a heading: just above the threshold, from a small perturbation.
    let particles = Particles { activity: -0.45, ..Particles::default() };
    let slow = DropletSetup { particles: Some(particles), ..DropletSetup::default() };
    let Built { mut scene, droplets, .. } =
        Setup { region, method: grid(0.1), droplets: vec![slow], ..Setup::default() }.build().unwrap();
    let seen = scene.observe(droplets[0]).unwrap();
    assert!(seen.heading().is_some_and(|heading| heading.abs() < 1e-3), "{:?}", seen.heading());
}

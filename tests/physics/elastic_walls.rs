//! Stiff elastic walls against rigid ones, without a grid.

use motile::active_interface::polygon_moments;
use motile::elastic_solids::ChannelShape;
use motile::elastic_solids::Moduli;
use motile::setup::{Built, DropletSetup, Material, Setup, SolidSetup};
use motile_tests::validation::scene::{by_layers, open_channel};

/// Where a droplet has swum to along a channel at t = 3.
fn place(setup: &Setup) -> f64 {
    let Built { mut scene, droplets, .. } = setup.build().expect("a scene");
    scene.run(3.0).go().expect("a run");
    polygon_moments(scene.body(droplets[0]).expect("its droplet").markers()).expect("a droplet").centroid.x
}

/// How far it swims between walls of springs of Cowley's k = 1e6, over how far it swims between rigid ones.
fn error(activity: f64, width: f64, h: f64) -> f64 {
    let droplets = vec![DropletSetup::active(activity)];
    let rigid = Setup { region: open_channel(6.0, width), droplets: droplets.clone(), ..Setup::default() };
    let shear = Moduli::from_thesis_spring_constant(1e6).expect("moduli").shear();
    let walls = SolidSetup::walls(&ChannelShape::Straight { width }, &Material::Springs { shear });
    // Walls as stiff as these are not compressed so that finer surfaces would fold.
    let solids = walls.into_iter().map(|wall| SolidSetup { finer_surface: Some(true), ..wall }).collect();
    place(&Setup { region: open_channel(6.0, width + 3.0), droplets, solids, ..by_layers(h) }) / place(&rigid) - 1.0
}

/// As far as the droplet swims in the narrow film at width 2, where the grid alone is 4 % off.
#[test]
fn layers_have_the_same_error_on_any_grid() {
    for (activity, softness) in [(-2.0, 0.01), (-4.0, 0.04)] {
        let errors = [0.125, 0.1].map(|h| error(activity, 2.0, h));
        println!("{activity} {errors:?}");
        assert!(errors[1].abs() < softness && (errors[0] - errors[1]).abs() < 3e-3, "{activity}: {errors:?}");
    }
}

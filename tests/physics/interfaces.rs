//! Scenes of interfaces alone: against exact rates and reference values, several droplets, the seam of a box.

use motile::setup::{Built, DropletSetup, Setup};
use motile_tests::validation::growth::{Mode, rate_in_plane_limit};
use motile_tests::validation::interfaces::{passing, relax};
use motile_tests::validation::scene::{open_channel, reference, without_grid};
use motile_tests::validation::swimmers::{steady, transient};

#[test]
fn ellipse_to_1e_7_and_second_order_in_time() {
    for ratio in [1, 10] {
        let [coarse, fine] = [0.01, 0.0025].map(|dt| relax(ratio, 64, 256, dt).unwrap());
        assert!(fine.aspect_ratio.abs() < 1e-7 && fine.tip.abs() < 1e-7, "ratio {ratio}: {fine:?}");
        let order = (coarse.aspect_ratio / fine.aspect_ratio).log2() / 2.0;
        assert!((order - 2.0).abs() < 0.02, "ratio {ratio}: order {order}");
        assert!(fine.area_change.abs() < 1e-8, "ratio {ratio}: {fine:?}");
    }
}

#[test]
fn growth_rates_to_1e_6() {
    for (inside, viscosity) in [(100.0, 100.0), (1000.0, 10.0), (10.0, 100.0)] {
        // At activity -1, and at the threshold (2.20), where the rate is zero.
        for activity in [-1.0, -0.002 * (inside + viscosity)] {
            let droplet = DropletSetup { viscosity: Some(inside), ..DropletSetup::active(activity) };
            let setup = Setup { viscosity, droplets: vec![droplet], ..Setup::default() };
            let theory = Mode::Concentration(1).theory(&setup).unwrap();
            let rate = rate_in_plane_limit(&setup, Mode::Concentration(1), 48, 384).unwrap();
            // A part in a million of the diffusion constant.
            assert!((rate - theory).abs() < 1e-7, "{inside}/{viscosity} {activity}: {rate} {theory}");
        }
    }
}

#[test]
fn transient_at_the_default() {
    let (error, time) = transient(&reference(Setup::default(), -1.0)).unwrap();
    assert!(error.abs() < 2e-4, "{error} at {time}");
}

#[test]
fn swimmer_between_walls_at_the_default() {
    let errors = steady(&Setup { region: open_channel(12.0, 3.0), ..Setup::default() }, 60.0).unwrap();
    assert!(errors.speed.abs() < 1e-3 && errors.aspect_ratio.abs() < 1e-4, "{errors:?}");
    assert!(errors.stresslet.abs() < 0.002 && errors.beta.abs() < 5e-3, "{errors:?}");
    assert!(errors.gap.unwrap().abs() < 4e-5 && errors.flux.unwrap().abs() < 1e-3, "{errors:?}");
}

/// Two droplets that pass closely, of equal viscosities and a hundred times as viscous as the exterior fluid.
#[test]
fn two_that_pass() {
    let thick = DropletSetup { viscosity: Some(1000.0), ..DropletSetup::active(-7.0) };
    let thick = Setup { viscosity: 10.0, droplets: vec![thick], ..without_grid(64, 256) };
    for (setup, offset, time) in [(without_grid(64, 256), EQUAL, 22.0), (thick, THICK, 26.0)] {
        let run = passing(&setup, offset, time).unwrap();
        assert!((0.03..0.07).contains(&run.gap), "{run:?}");
        assert!(run.area_change < 1e-5 && run.particle_change < 1e-12, "{run:?}");
        // A half turn about the middle exchanges them.
        assert!((run.centroids[0] + run.centroids[1]).length() < 1e-5, "{run:?}");
    }
}

#[test]
fn seams_do_not_show() {
    let [middle, corner] = [[0.0, 0.0], [2.9, 2.8]].map(|centre| {
        let droplet = DropletSetup { angle: 0.4, centre, ..DropletSetup::active(-4.0) };
        let setup = Setup { droplets: vec![droplet], ..without_grid(64, 256) };
        let Built { mut scene, droplets, .. } = setup.build().unwrap();
        scene.run(6.0).go().unwrap();
        let seen = scene.observe(droplets[0]).unwrap();
        (seen.centroid.x - centre[0], seen.centroid.y - centre[1], seen.speed())
    });
    assert!(corner.0 + 2.9 > 3.0 && corner.1 + 2.8 > 3.0, "{corner:?}");
    assert!((middle.0 - corner.0).abs() < 1e-7 && (middle.1 - corner.1).abs() < 1e-7, "{middle:?} {corner:?}");
    assert!((middle.2 - corner.2).abs() < 1e-7, "{middle:?} {corner:?}");
}

/// Distances of the lines on which two swimmers come towards each other, less two radii.
const EQUAL: f64 = 0.0;
const THICK: f64 = 0.14;

//! Scenes of interfaces alone: against exact rates and reference values, several droplets, the seam of a box.

use motile::Swimmer;
use motile_tests::validation::growth::Mode;
use motile_tests::validation::interfaces::{growth_rate_limit, passing, relax, steady_in_channel};
use motile_tests::validation::swimmers::{look, transient_without_grid};

#[test]
fn ellipse_to_1e_7_and_second_order_in_time() {
    for ratio in [1, 10] {
        let [coarse, fine] = [0.01, 0.0025].map(|dt| relax(ratio, 64, 256, dt).unwrap());
        assert!(fine.aspect_ratio.abs() < 1e-7 && fine.tip.abs() < 1e-7, "ratio {ratio}: {fine:?}");
        let order = (coarse.aspect_ratio / fine.aspect_ratio).log2() / 2.0;
        assert!((order - 2.0).abs() < 0.1, "ratio {ratio}: order {order}");
        assert!(fine.area_change.abs() < 1e-8, "ratio {ratio}: {fine:?}");
    }
}

#[test]
fn growth_rates_to_1e_6() {
    for (inside, viscosity) in [(100.0, 100.0), (1000.0, 10.0), (10.0, 100.0)] {
        // At activity -1, and at the threshold (2.20), where the rate is zero.
        for activity in [-1.0, -0.002 * (inside + viscosity)] {
            let base = Swimmer { activity, viscosity, viscosity_inside: Some(inside), nodes: 48, ..Swimmer::default() };
            let theory = Mode::Concentration(1).theory(&base);
            let rate = growth_rate_limit(&base, Mode::Concentration(1), 384).unwrap();
            assert!((rate - theory).abs() < 1e-6 * base.diffusion, "{inside}/{viscosity} {activity}: {rate} {theory}");
        }
    }
}

#[test]
fn transient_at_the_default() {
    let (error, time) = transient_without_grid(&Swimmer::default()).unwrap();
    assert!(error.abs() < 2e-4, "{error} at {time}");
}

#[test]
fn swimmer_between_walls_at_the_default() {
    let swimmer = Swimmer { lengths: [12.0, 3.0], ..Swimmer::default() };
    let errors = steady_in_channel(&swimmer, 60.0).unwrap();
    assert!(errors.speed.abs() < 1e-3 && errors.aspect_ratio.abs() < 1e-4, "{errors:?}");
    assert!(errors.stresslet.abs() < 5e-3 && errors.beta.abs() < 5e-3 && errors.gap.abs() < 1e-3, "{errors:?}");
}

/// Two droplets that pass closely, of equal viscosities and a hundred times as viscous as their surroundings.
#[test]
fn two_that_pass() {
    let coarse = Swimmer { nodes: 64, concentration_cells: 256, ..Swimmer::default() };
    let thick = Swimmer { activity: -7.0, viscosity: 10.0, viscosity_inside: Some(1000.0), ..coarse.clone() };
    for (swimmer, offset, time) in [(&coarse, EQUAL, 22.0), (&thick, THICK, 26.0)] {
        let run = passing(swimmer, offset, time).unwrap();
        assert!((0.03..0.07).contains(&run.gap), "{run:?}");
        assert!(run.area_change < 1e-5 && run.particle_change < 1e-12, "{run:?}");
        // A half turn about the middle exchanges them.
        assert!((run.centroids[0] + run.centroids[1]).norm() < 1e-5, "{run:?}");
    }
}

#[test]
fn seams_do_not_show() {
    let [middle, corner] = [[0.0, 0.0], [2.9, 2.8]].map(|offset| {
        let swimmer =
            Swimmer { activity: -4.0, angle: 0.4, offset, nodes: 64, concentration_cells: 256, ..Swimmer::default() };
        let (mut scene, droplet) = swimmer.build_without_grid().unwrap();
        scene.run(6.0).go().unwrap();
        let seen = look(&mut scene, droplet).unwrap();
        (seen.centroid.x - offset[0], seen.centroid.y - offset[1], seen.speed())
    });
    assert!(corner.0 + 2.9 > 3.0 && corner.1 + 2.8 > 3.0, "{corner:?}");
    assert!((middle.0 - corner.0).abs() < 1e-7 && (middle.1 - corner.1).abs() < 1e-7, "{middle:?} {corner:?}");
    assert!((middle.2 - corner.2).abs() < 1e-7, "{middle:?} {corner:?}");
}

/// Distances of the lines on which two swimmers come towards each other, less two radii.
const EQUAL: f64 = 0.0;
const THICK: f64 = 0.14;

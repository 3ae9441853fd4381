//! Channels with no-slip walls against boundary-integral values.

use motile::ib_core::BSpline;
use motile::setup::{DropletSetup, Setup};
use motile_tests::validation::scene::{on_grid, open_channel};
use motile_tests::validation::swimmers::{speeds, steady};
use motile_tests::validation::{Case, channel, order};

const SPACINGS: [f64; 3] = [0.1, 0.05, 0.025];

#[test]
fn point_forces_are_second_order() {
    for (name, drive) in channel::drives() {
        let errors: Vec<f64> =
            SPACINGS.iter().map(|&h| channel::point_forces(&BSpline::<4>, h, drive).unwrap()).collect();
        assert!((order(&SPACINGS, &errors) - 2.0).abs() < 0.01, "{name}: {errors:?}");
        assert!(errors[1] < 6e-3, "{name}: {errors:?}");
    }
}

#[test]
fn fixed_shapes_are_second_order() {
    let kernel = BSpline::<4>;
    for (name, drive) in channel::drives() {
        for (case, height) in
            [(Case::Circle, 0.0), (Case::Circle, 0.3), (Case::EllipseUniform, 0.0), (Case::EllipseGradient, 0.0)]
        {
            let rows = SPACINGS.map(|h| channel::fixed_shape(&kernel, true, h, drive, case, height).unwrap());
            let what = format!("{name}, {} at {height}: {rows:?}", case.name());
            let markers: Vec<f64> = rows.iter().map(|row| row.markers.maximum).collect();
            let field: Vec<f64> = rows.iter().map(|row| row.field).collect();
            assert!(order(&SPACINGS, &markers) > 1.8, "{what}");
            assert!(order(&SPACINGS, &field) > 1.8, "{what}");
            assert!(rows[1].markers.maximum < 3e-3 && rows[1].drive.abs() < 1e-3, "{what}");
            assert!(rows[1].wall_shear.abs() < 2e-3, "{what}");
        }
    }
}

/// Activity -1 is above the threshold in a box but not in a channel of its own width (Cowley section 3.1).
#[test]
fn a_weak_swimmer_comes_to_rest() {
    let droplets = vec![DropletSetup::active(-1.0)];
    let late = speeds(&Setup { region: open_channel(12.0, 2.0), droplets, ..on_grid(0.1) }, &[300.0]).unwrap();
    assert!(late[0] < 1e-4, "{late:?}");
}

/// The droplet as wide as the channel starts in contact with both walls and opens a film of 0.09 R0.
#[test]
fn steady_swimmers() {
    for (width, [speed, gap, flux], time) in [(2.0, [0.005, 0.003, 0.004], 120.0), (3.0, [0.002, 0.007, 0.008], 60.0)] {
        let errors = steady(&Setup { region: open_channel(12.0, width), ..on_grid(0.05) }, time).unwrap();
        assert!(errors.speed.abs() < speed, "{errors:?}");
        assert!(errors.gap.unwrap().abs() < gap && errors.flux.unwrap().abs() < flux, "{errors:?}");
        assert!(errors.area_change.abs() < 1e-5 && errors.particle_change.abs() < 1e-12, "{errors:?}");
    }
}

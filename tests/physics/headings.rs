//! Swimmers off the grid's axes: the grid neither turns them nor changes their speed.

use motile::scene::StepSize;
use motile::setup::Setup;
use motile_tests::validation::headings::{Deviation, course, off_axis};
use motile_tests::validation::scene::{on_grid, without_grid};

/// Largest deviations from boundary integrals to t = 40, for some directions.
fn deviations(activity: f64, h: f64) -> Vec<Deviation> {
    let deviation = |angle| {
        let exact = off_axis(without_grid(64, 256).method, activity, angle);
        let exact = course(&Setup { step: StepSize::OfLimit(0.5), ..exact }, 10.0, 40.0).expect("a swimmer");
        course(&off_axis(on_grid(h).method, activity, angle), 10.0, 40.0).expect("a swimmer").beyond(&exact)
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

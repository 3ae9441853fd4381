//! An ellipse relaxing under tension.

use motile_tests::validation::relaxation;

#[test]
fn aspect_ratio_and_area() {
    let coarse = relaxation::run(0.1, 0.04).unwrap();
    let fine = relaxation::run(0.05, 0.02).unwrap();
    assert!(coarse.aspect_ratio_error.abs() < 2e-4, "{coarse:?}");
    assert!(fine.aspect_ratio_error.abs() < 1e-4, "{fine:?}");
    assert!(fine.area_change.abs() < 1e-6, "{fine:?}");
}

/// The area changes only by the error of the time step, which is of second order or better.
#[test]
fn area_error_is_the_time_steps() {
    let [a, b] = [0.04, 0.02].map(|dt| relaxation::run(0.1, dt).unwrap().area_change.abs());
    assert!(b < a / 3.5, "{a:e} {b:e}");
}

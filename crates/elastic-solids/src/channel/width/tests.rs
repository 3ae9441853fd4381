use motile_base::InputError;

use super::*;

fn v(x: f64, y: f64) -> Vec2 {
    Vec2::new(x, y)
}

#[test]
fn extremes_lie_at_the_points_of_either_line() {
    // Lower side a tent at x = 1 of 4, upper side flat but for a dip at 2.6; the upper one runs left and starts
    // elsewhere.
    let lower = [v(0.0, 0.0), v(1.0, 0.5), v(2.0, 0.0), v(3.0, 0.0)];
    let upper = [v(6.6, 1.4), v(5.6, 2.0), v(4.0, 2.0), v(3.6, 2.0)];
    let width = vertical_width(&lower, &upper, 4.0).unwrap();
    assert!((width.minimum - 1.4).abs() < 1e-12 && (width.minimum_at - 2.6).abs() < 1e-12, "{width:?}");
    assert!((width.maximum - 2.0).abs() < 1e-12, "{width:?}");
    let width = vertical_width(&lower, &[v(0.3, 3.0)], 4.0).unwrap();
    assert!((width.minimum - 2.5).abs() < 1e-12 && (width.minimum_at - 1.0).abs() < 1e-12);
}

#[test]
fn an_overhang_counts_with_its_inner_side() {
    let lower = [v(0.0, 0.0), v(1.0, 0.0), v(0.8, 0.7), v(1.2, 0.7), v(1.1, 0.0), v(3.0, 0.0)];
    let width = vertical_width(&lower, &[v(0.0, 2.0), v(2.0, 2.0)], 4.0).unwrap();
    assert!((width.minimum - 1.3).abs() < 1e-12);
}

#[test]
fn bad_lines_are_refused() {
    assert!(matches!(vertical_width(&[], &[v(0.0, 0.0)], 1.0), Err(SolidError::Input(InputError::TooFew { .. }))));
    assert!(matches!(
        vertical_width(&[v(0.0, 0.0)], &[v(f64::NAN, 0.0)], 1.0),
        Err(SolidError::Input(InputError::EntryNotFinite { .. }))
    ));
    assert!(matches!(
        vertical_width(&[v(0.0, 0.0)], &[v(0.0, 1.0)], 0.0),
        Err(SolidError::Input(InputError::NotPositive { .. }))
    ));
}

use super::*;

#[test]
fn a_line_and_its_errors() {
    // y = 1 + 2 x with the residuals (1, -1, -1, 1)/10: variance 0.04/2, sum of squares of x about its mean 5.
    let (start, slope, rms) = line(&[0.0, 1.0, 2.0, 3.0], &[1.1, 2.9, 4.9, 7.1]).unwrap();
    assert!((start.value - 1.0).abs() < 1e-13 && (slope.value - 2.0).abs() < 1e-13);
    assert!((slope.error - (0.02_f64 / 5.0).sqrt()).abs() < 1e-13 && (rms - 0.1).abs() < 1e-13);
    assert!((start.error - (0.02_f64 * (0.25 + 2.25 / 5.0)).sqrt()).abs() < 1e-13);
    assert!(slope.differs_from_zero(30.0) && !slope.differs_from_zero(40.0));
}

#[test]
fn dependent_columns_have_no_solution() {
    assert!(line(&[1.0, 1.0, 1.0], &[0.0, 1.0, 2.0]).is_none());
    assert!(line(&[1.0], &[0.0]).is_none());
    assert!(line(&[0.0, 1.0, f64::NAN], &[0.0, 1.0, 2.0]).is_none());
    let (_, slope, _) = line(&[0.0, 1.0], &[0.0, 1.0]).unwrap();
    assert_eq!(slope.error, f64::INFINITY);
}

#[test]
fn smooth_residuals_count_less() {
    let wave: Vec<f64> = (0..1000).map(|i| (f64::from(i) * 0.01).sin()).collect();
    assert!(inflation(&wave) > 100.0);
    let alternating: Vec<f64> = (0..1000).map(|i| f64::from(i % 2) - 0.5).collect();
    assert_eq!(inflation(&alternating), 1.0);
    assert_eq!(inflation(&[0.0; 20]), 1.0);
}

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

#[test]
fn columns_that_are_nearly_dependent() {
    // Powers of 1 + t/10, of condition K = 1e5: the data are a cubic, then a cubic and a part that no column has.
    // Round-off may move residuals by K and coefficients by K^2 times as much.
    let t: Vec<f64> = (0..20).map(|i| f64::from(i) / 19.0).collect();
    let columns: Vec<Vec<f64>> = (0..4).map(|k| t.iter().map(|t| (1.0 + 0.1 * t).powi(k)).collect()).collect();
    let exact = [2.0, -1.0, 0.5, 3.0];
    let mut data: Vec<f64> =
        (0..20).map(|i| columns.iter().zip(exact).map(|(column, c)| c * column[i]).sum()).collect();
    let solution = Solution::new(columns.clone(), &data).unwrap();
    for (found, exact) in solution.coefficients.iter().zip(exact) {
        assert!((found - exact).abs() < 1e-8, "{solution:?}");
    }
    // Fifth differences of a quintic are orthogonal to cubics on even points: binomials with signs.
    for (value, weight) in data.iter_mut().zip([1.0, -5.0, 10.0, -10.0, 5.0, -1.0]) {
        *value += weight;
    }
    let solution = Solution::new(columns, &data).unwrap();
    for (found, exact) in solution.residuals.iter().zip([1.0, -5.0, 10.0, -10.0, 5.0, -1.0, 0.0, 0.0]) {
        assert!((found - exact).abs() < 1e-10, "{solution:?}");
    }
    assert!((solution.coefficients[3] - 3.0).abs() < 1e-6);
}

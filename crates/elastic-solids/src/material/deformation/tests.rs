use super::*;

#[test]
fn distortion_and_cofactor_are_what_they_say() {
    let a = Mat2::from_rows_array(&[1.3, 0.2, -0.4, 0.8]);
    let gradient = DeformationGradient::new(a).unwrap();
    let expected = (a * a.transpose()).diagonal().element_sum() - 2.0 * a.determinant();
    assert!((gradient.distortion() - expected).abs() < 1e-15);
    let cofactor = a.determinant() * a.inverse().transpose();
    assert!(gradient.cofactor().abs_diff_eq(cofactor, 5e-16));
}

#[test]
fn inversion_and_bad_numbers_are_refused() {
    for bad in [
        Mat2::from_rows_array(&[1.0, 0.0, 0.0, -1.0]),
        Mat2::from_rows_array(&[1.0, 1.0, 1.0, 1.0]),
        Mat2::from_rows_array(&[f64::NAN, 0.0, 0.0, 1.0]),
        Mat2::from_rows_array(&[f64::INFINITY, 0.0, 0.0, 1.0]),
    ] {
        assert!(matches!(DeformationGradient::new(bad), Err(SolidError::NotOrientationPreserving { .. })));
    }
}

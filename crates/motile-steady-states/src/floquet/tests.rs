use super::*;

/// `y' = (sin t + cos 2t - 1) y` grows by exp(2 - pi) over half a period, and a second equation that it drives follows;
/// errors are of third order, and what decays fast is gone.
#[test]
fn growth_over_half_a_period_is_of_third_order() {
    let matrix = |t: f64| {
        let rate = t.sin() + (2.0 * t).cos() - 1.0;
        DMatrix::from_row_slice(2, 2, &[rate, 0.0, (3.0 * t).sin(), rate])
    };
    let errors = [20, 40].map(|steps| {
        let flow = propagated(matrix, DMatrix::identity(2, 2), steps).unwrap();
        let grown = (2.0 - PI).exp();
        let exact = DMatrix::from_row_slice(2, 2, &[grown, 0.0, 2.0 / 3.0 * grown, grown]);
        (flow - exact).amax()
    });
    assert!(errors[1] < 5e-5 && ((errors[0] / errors[1]).log2() - 3.0).abs() < 0.2, "{errors:?}");
    let stiff = propagated(|_| DMatrix::from_element(1, 1, -1e9), DMatrix::identity(1, 1), 10).unwrap();
    assert!(stiff[(0, 0)].abs() < 1e-12);
}

use super::*;

#[test]
fn exact_for_cubics() {
    let times = [0.0, 0.3, 0.4, 1.0, 1.1, 2.0];
    let value = |t: f64| 1.0 - 2.0 * t + 0.5 * t * t * t;
    let slope = |t: f64| -2.0 + 1.5 * t * t;
    let exact = |t: f64| t - t * t + 0.125 * t.powi(4);
    let (y, d) = (times.map(value), times.map(slope));
    for integral in [cumulative_integral(&times, &y, None), cumulative_integral(&times, &y, Some(&d))] {
        for (t, sum) in times.iter().zip(&integral) {
            assert!((sum - exact(*t)).abs() < 1e-14, "{integral:?}");
        }
    }
    assert_eq!(cumulative_integral(&[1.0], &[1.0], None), [0.0]);
    assert_eq!(cumulative_integral(&[1.0, 3.0], &[1.0, 2.0], None), [0.0, 3.0]);
}

#[test]
fn fourth_order() {
    let errors: Vec<f64> = [40, 80]
        .iter()
        .map(|&count| {
            let times: Vec<f64> = (0..=count).map(|i| 5.0 * f64::from(i) / f64::from(count)).collect();
            let y: Vec<f64> = times.iter().map(|t| t.cos()).collect();
            let integral = cumulative_integral(&times, &y, None);
            times.iter().zip(&integral).map(|(t, sum)| (sum - t.sin()).abs()).fold(0.0, f64::max)
        })
        .collect();
    assert!((errors[0] / errors[1]).log2() > 3.8, "{errors:?}");
}

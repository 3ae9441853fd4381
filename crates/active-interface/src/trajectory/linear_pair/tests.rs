use super::*;
use approx::assert_relative_eq;

/// Solution of d/dt (y, q) = M (y, q) through its eigenvalues s +- i w (or s +- w): z(t) = e^(s t) (C + (M - s) S)
/// z(0).
fn solution(matrix: [[f64; 2]; 2], times: &[f64], start: [f64; 2]) -> (Vec<f64>, Vec<f64>) {
    let [[a, b], [c, d]] = matrix;
    let s = 0.5 * (a + d);
    let discriminant = 0.25 * (a - d) * (a - d) + b * c;
    let root = discriminant.abs().sqrt();
    times
        .iter()
        .map(|t| {
            let [cosine, sine] = if discriminant < 0.0 {
                [(root * t).cos(), (root * t).sin() / root]
            } else {
                [(root * t).cosh(), (root * t).sinh() / root]
            };
            let [y, q] = start;
            let e = (s * t).exp();
            (e * (cosine * y + sine * ((a - s) * y + b * q)), e * (cosine * q + sine * (c * y + (d - s) * q)))
        })
        .unzip()
}

#[test]
fn matrix_and_eigenvalues() {
    // A swimmer of speed 0.2 that turns back to the centre line: heading' = -0.01 y + 0.005 heading.
    let matrix = [[0.001, 0.2], [-0.01, 0.005]];
    let frequency = (0.002_f64 - 0.002 * 0.002).sqrt();
    let end = 1.3 * std::f64::consts::TAU / frequency;
    let errors = [40, 80].map(|count| {
        let times: Vec<f64> = (0..count).map(|i| end * f64::from(i) / f64::from(count - 1)).collect();
        let (y, q) = solution(matrix, &times, [0.01, 0.002]);
        let pair = fit_linear_pair(&times, &y, &q).unwrap();
        for (row, exact) in pair.matrix.iter().zip(&matrix) {
            assert_relative_eq!(row[..], exact[..], epsilon = 1e-5, max_relative = 1e-3);
        }
        assert_relative_eq!(pair.frequency.unwrap().value, frequency, max_relative = 1e-4);
        assert!(pair.residual < 1e-4);
        (pair.growth_rate.value - 0.003).abs() / 0.003
    });
    assert!(errors[0] < 1e-3 && (errors[0] / errors[1]).log2() > 3.5, "{errors:?}");
}

#[test]
fn real_eigenvalues() {
    let matrix = [[-0.3, 0.2], [0.1, -0.4]];
    let times: Vec<f64> = (0..200).map(|i| 0.05 * f64::from(i)).collect();
    let (y, q) = solution(matrix, &times, [0.01, -0.005]);
    let pair = fit_linear_pair(&times, &y, &q).unwrap();
    assert!(pair.frequency.is_none());
    assert_relative_eq!(pair.growth_rate.value, -0.2, max_relative = 1e-5);
}

#[test]
fn bad_input_is_refused() {
    let times: Vec<f64> = (0..10).map(f64::from).collect();
    let y: Vec<f64> = times.iter().map(|t| t.cos()).collect();
    let twice: Vec<f64> = y.iter().map(|y| 2.0 * y).collect();
    assert!(matches!(fit_linear_pair(&times, &y, &twice), Err(InterfaceError::NoFit { .. })));
    assert!(fit_linear_pair(&times, &y, &[0.0; 10]).is_err());
    assert!(fit_linear_pair(&times, &y, &y[..9]).is_err());
    assert!(fit_linear_pair(&[1.0; 10], &y, &y).is_err());
    assert!(fit_linear_pair(&times, &[f64::NAN; 10], &y).is_err());
    assert!(fit_linear_pair(&times[..5], &y[..5], &y[..5]).is_err());
}

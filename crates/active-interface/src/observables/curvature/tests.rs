use super::*;
use approx::assert_relative_eq;
use proptest::prelude::*;

fn fitted_curvature(points: &[Vec2]) -> Result<f64, InterfaceError> {
    super::fitted_curvature(points, &vec![1.0; points.len()])
}

fn arc(radius: f64, from: f64, to: f64, n: usize) -> Vec<Vec2> {
    (0..n)
        .map(|k| {
            let (s, c) = (from + (to - from) * k as f64 / (n - 1) as f64).sin_cos();
            Vec2::new(3.0 + radius * c, 1.0 + radius * s)
        })
        .collect()
}

#[test]
fn a_line_has_no_curvature() {
    let line: Vec<Vec2> = (0..20).map(|k| Vec2::new(f64::from(k), 2.0 * f64::from(k))).collect();
    assert!(fitted_curvature(&line).unwrap().abs() < 1e-13);
    assert!(fitted_curvature(&line[..2]).is_err());
    assert!(fitted_curvature(&[Vec2::ZERO; 5]).is_err());
    assert!(fitted_curvature(&[line[0], line[1], Vec2::new(f64::NAN, 0.0)]).is_err());
}

#[test]
fn the_fit_is_a_minimum() {
    // Points off a circle: no nearby circle has a smaller sum of squared distances.
    let points: Vec<Vec2> = arc(1.0, 0.2, 2.0, 40)
        .iter()
        .enumerate()
        .map(|(k, p)| p + Vec2::new(0.02 * (k as f64).sin(), 0.03 * (2.0 * k as f64).cos()))
        .collect();
    let kappa = fitted_curvature(&points).unwrap();
    // Minimise over the centre for each radius by Newton's method with numerical derivatives.
    let best = |radius: f64| {
        let cost = |c: Vec2| points.iter().map(|p| ((p - c).length() - radius).powi(2)).sum::<f64>();
        let mut c = Vec2::new(3.0, 1.0);
        for _ in 0..30 {
            let h = 1e-4;
            let (x, y) = (Vec2::new(h, 0.0), Vec2::new(0.0, h));
            let gradient = Vec2::new(cost(c + x) - cost(c - x), cost(c + y) - cost(c - y)) / (2.0 * h);
            let xx = (cost(c + x) + cost(c - x) - 2.0 * cost(c)) / (h * h);
            let yy = (cost(c + y) + cost(c - y) - 2.0 * cost(c)) / (h * h);
            let xy = (cost(c + x + y) + cost(c - x - y) - cost(c + x - y) - cost(c - x + y)) / (4.0 * h * h);
            let det = xx * yy - xy * xy;
            c -= Vec2::new(yy * gradient.x - xy * gradient.y, xx * gradient.y - xy * gradient.x) / det;
        }
        cost(c)
    };
    let radius = 1.0 / kappa;
    assert!(best(radius) < best(radius * 1.003) && best(radius) < best(radius * 0.997));
}

proptest! {
    #[test]
    fn circles_are_exact(
        radius in 0.01..100.0f64, from in -3.0..3.0f64, width in 0.1..5.0f64, n in 3usize..60, left in prop::bool::ANY,
    ) {
        let mut points = arc(radius, from, from + width, n);
        if !left {
            points.reverse();
        }
        let kappa = fitted_curvature(&points).unwrap();
        let sign = if left { 1.0 } else { -1.0 };
        // Round-off of the coordinates is magnified by the flatness of the arc.
        let tolerance = 1e-13 * (1.0 + 3.0 / radius) / (width * width).min(1.0) * 50.0;
        prop_assert!((kappa * radius * sign - 1.0).abs() < tolerance, "{} {}", kappa, sign / radius);
    }
}

#[test]
fn almost_a_full_turn() {
    assert_relative_eq!(fitted_curvature(&arc(2.0, 0.0, 6.0, 100)).unwrap(), 0.5, max_relative = 1e-12);
}

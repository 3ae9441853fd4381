use super::*;
use crate::{Point, evaluate};

fn coefficients(degree: usize) -> Vec<f64> {
    (0..count(degree)).map(|k| ((k * 7919 % 101) as f64 / 101.0 - 0.5) / (1.0 + k as f64)).collect()
}

#[test]
fn turned_functions_have_the_values_of_the_old_at_turned_points() {
    for (degree, angle) in [(1, 0.3), (7, 1.1), (13, 3.0), (20, -0.4), (48, 0.03)] {
        let f = coefficients(degree);
        let mut about_z = f.clone();
        turn_about_z(&mut about_z, 0.8).unwrap();
        let mut seen = vec![0.0; f.len()];
        Tilt::new(degree, angle).unwrap().apply(&about_z, &mut seen).unwrap();
        for (theta, phi) in [(0.0, 0.0), (0.4, 2.0), (1.9, -1.0), (3.0, 0.5)] {
            let point = Point { theta, phi };
            let [x, y, z] = point.direction();
            let (sin, cos) = angle.sin_cos();
            let turned = Point::towards([cos * x + sin * z, y, cos * z - sin * x]);
            let old = evaluate(&f, Point { phi: turned.phi + 0.8, ..turned }).unwrap();
            let new = evaluate(&seen, point).unwrap();
            assert!((old - new).abs() < 1e-13, "degree {degree} at {theta}: {old} and {new}");
        }
    }
}

#[test]
fn blocks_are_orthogonal_at_high_degree() {
    let tilt = Tilt::new(64, 1.234).unwrap();
    let block = tilt.cosines(64);
    for (i, a) in block.chunks_exact(65).enumerate() {
        for (j, b) in block.chunks_exact(65).enumerate() {
            let product: f64 = a.iter().zip(b).map(|(a, b)| a * b).sum();
            let exact = if i == j { 1.0 } else { 0.0 };
            assert!((product - exact).abs() < 1e-12, "{i} {j}: {product}");
        }
    }
    assert_eq!(tilt.sines(64).len(), 64 * 64);
    assert!(tilt.cosines(65).is_empty());
    assert!(matches!(Tilt::new(0, 1.0), Err(HarmonicsError::Degree { degree: 0 })));
    assert!(matches!(Tilt::new(3, f64::INFINITY), Err(HarmonicsError::Angle { .. })));
}

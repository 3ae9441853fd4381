use super::*;

#[test]
fn particles_stay_and_spacing_is_bounded() {
    let mut markers: Vec<Vec2> = (0..100)
        .map(|k| {
            let s = k as f64 / 100.0;
            let angle = std::f64::consts::TAU * (s + 0.12 * (std::f64::consts::TAU * s).sin());
            Vec2::new(angle.cos(), angle.sin())
        })
        .collect();
    let mut numbers: Vec<f64> = (0..100).map(|k| 1.0 + (k % 7) as f64).collect();
    let total: f64 = numbers.iter().sum();
    let target = std::f64::consts::TAU / 100.0;
    let (inserted, removed) = redistribute(&mut markers, &mut numbers, target, 8);
    assert!(inserted > 0 && removed > 0);
    assert_eq!(markers.len(), numbers.len());
    assert!((numbers.iter().sum::<f64>() - total).abs() < 1e-12 * total);
    for k in 0..markers.len() {
        let length = (markers[(k + 1) % markers.len()] - markers[k]).length();
        assert!(length < 1.6 * target, "{k}: {}", length / target);
        // The cubic keeps new markers on the circle.
        assert!((markers[k].length() - 1.0).abs() < 1e-4);
    }
}

#[test]
fn a_curve_is_not_reduced_below_the_minimum() {
    let mut markers: Vec<Vec2> =
        (0..10).map(|k| Vec2::new((0.6 * k as f64).cos(), (0.6 * k as f64).sin()) * 1e-3).collect();
    let mut numbers = vec![1.0; 10];
    redistribute(&mut markers, &mut numbers, 1.0, 8);
    assert_eq!(markers.len(), 8);
    assert!((numbers.iter().sum::<f64>() - 10.0).abs() < 1e-14);
}

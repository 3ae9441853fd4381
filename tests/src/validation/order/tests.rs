#[test]
fn power_laws() {
    let h = [0.1, 0.05, 0.025];
    let e: Vec<f64> = h.iter().map(|h| 3.0 * h * h).collect();
    assert!((super::order(&h, &e) - 2.0).abs() < 1e-12);
}

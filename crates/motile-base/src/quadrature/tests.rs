use super::gauss_legendre;

#[test]
fn powers_up_to_twice_the_points_are_exact() {
    for count in [1, 2, 5, 10, 24, 48, 200] {
        let integral = |power| gauss_legendre(count).iter().map(|(x, weight)| weight * x.powi(power)).sum::<f64>();
        for power in 0..2 * count as i32 {
            let exact = if power % 2 == 0 { 2.0 / f64::from(power + 1) } else { 0.0 };
            assert!((integral(power) - exact).abs() < 1e-13, "{count}, {power}");
        }
    }
    let next = gauss_legendre(5).iter().map(|(x, weight)| weight * x.powi(10)).sum::<f64>();
    assert!((next - 2.0 / 11.0).abs() > 1e-4, "{next}");
}

use super::*;

#[test]
fn the_pressure_is_minus_the_derivative_of_the_energy() {
    let repulsion = Repulsion::new(30.0, 0.2).unwrap();
    assert!((repulsion.pressure(0.1) - 6.0).abs() < 1e-13);
    let step = 1e-7;
    for gap in [-0.05, 0.003, 0.004, 0.0041, 0.01, 0.05, 0.1, 0.15, 0.199] {
        let slope = (repulsion.energy(gap - step) - repulsion.energy(gap + step)) / (2.0 * step);
        assert!((slope / repulsion.pressure(gap) - 1.0).abs() < 1e-5, "{gap}: {slope} {}", repulsion.pressure(gap));
        let rate = 0.25 * gap * (repulsion.pressure(gap - step) - repulsion.pressure(gap + step)) / (2.0 * step);
        assert!((4.0 * repulsion.rate(gap, 4.0) / repulsion.rate(gap, 1.0) - 1.0).abs() < 1e-15, "{gap}");
        assert!(gap < 0.0041 || (rate / repulsion.rate(gap, 1.0) - 1.0).abs() < 1e-4, "{gap}: {rate}");
    }
    assert_eq!([repulsion.pressure(0.2), repulsion.energy(0.3)], [0.0; 2]);
}

#[test]
fn what_is_no_repulsion_is_refused() {
    for bad in [0.0, -1.0, f64::NAN, f64::INFINITY] {
        assert!(Repulsion::new(bad, 0.1).is_err() && Repulsion::new(1.0, bad).is_err());
    }
}

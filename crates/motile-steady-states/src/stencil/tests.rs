use super::*;

/// The error of a smooth function falls with the order of the rule.
#[test]
fn errors_fall_with_the_order() {
    let rules = [(Stencil::CENTRAL, 6), (Stencil::FORWARD, 5), (Stencil::SHORT, 2), (Stencil::SHORT_FORWARD, 2)];
    for (stencil, order) in rules {
        let error = |step: f64| {
            let of = |place: f64| Ok(DVector::from_element(1, (0.7 + place).sin()));
            stencil.derivative(step, of).unwrap()[0] - 0.7_f64.cos()
        };
        let measured = (error(0.2) / error(0.1)).abs().log2();
        assert!((measured - f64::from(order)).abs() < 0.3, "{stencil:?}: {measured}");
        assert!(error(0.01).abs() < if order > 2 { 1e-10 } else { 1e-4 }, "{stencil:?}");
    }
}

use super::*;

#[test]
fn equilibria_stay_and_the_sum_is_kept() {
    let exchange = Exchange::new(0.3, 0.7).unwrap();
    let lengths = [0.5, 1.0, 0.75];
    let inside = exchange.concentration_at_rest(4.0).unwrap();
    let pool = Pool::new(exchange, 2.0 * inside, 2.0).unwrap();
    let rest = lengths.map(|length| 4.0 * length);
    assert!(pool.flux(&lengths, rest.iter().sum()).abs() < 1e-14);

    // A step of the implicit exchange alone, against the equations that it solves.
    let (factor, right) = (3.0, [1.0, 5.0, 2.0]);
    let (mut numbers, mut number) = (right, 7.0);
    pool.solve(factor, &lengths, &mut numbers, &mut number, |_, _| ());
    assert!((numbers.iter().sum::<f64>() + number - 15.0).abs() < 1e-14);
    let (mut residual, mut residual_inside) = (numbers, number);
    residual_inside += pool.add(-factor, &lengths, &numbers, number, &mut residual);
    for (left, right) in residual.iter().zip(right) {
        assert!((left - right).abs() < 1e-14, "{residual:?}");
    }
    assert!((residual_inside - 7.0).abs() < 1e-14);
}

#[test]
fn rates_and_numbers_are_checked() {
    assert!(Exchange::new(-1.0, 0.0).is_err() && Exchange::new(0.0, f64::NAN).is_err());
    assert_eq!(Exchange::new(0.0, 1.0).unwrap().concentration_at_rest(1.0), None);
    assert_eq!(Exchange::new(0.0, 0.0).unwrap().concentration_at_rest(1.0), Some(0.0));
    assert!(Pool::new(Exchange::new(1.0, 1.0).unwrap(), -1.0, 1.0).is_err());
}

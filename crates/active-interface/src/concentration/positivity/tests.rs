use super::*;
use proptest::prelude::*;

#[test]
fn borrows_from_the_neighbours_first() {
    let mut numbers = [5.0, 2.0, -1.0, 2.0, 5.0];
    let repair = repair_positivity(&mut numbers).unwrap();
    assert_eq!(numbers, [5.0, 1.5, 0.0, 1.5, 5.0]);
    assert_eq!(repair, Repair { segments: 1, moved: 1.0, furthest: 1 });
}

#[test]
fn then_from_further_out() {
    let mut numbers = [5.0, 0.5, -2.0, 0.5, 5.0, 7.0];
    let repair = repair_positivity(&mut numbers).unwrap();
    assert_eq!(numbers, [4.5, 0.0, 0.0, 0.0, 4.5, 7.0]);
    assert_eq!(repair.furthest, 2);
}

#[test]
fn nothing_to_do_and_nothing_to_take() {
    let mut numbers = [1.0, 0.0, 2.0];
    assert_eq!(repair_positivity(&mut numbers).unwrap(), Repair::default());
    assert!(matches!(repair_positivity(&mut [1.0, -2.0, 0.5]), Err(InterfaceError::NoParticles { .. })));
    assert!(repair_positivity(&mut [1.0, f64::NAN, 0.5]).is_err());
}

proptest! {
    #[test]
    fn conserves_and_leaves_nothing_negative(mut numbers in proptest::collection::vec(-1.0..2.0f64, 3..80)) {
        let before: f64 = numbers.iter().sum();
        prop_assume!(before > 1e-9);
        repair_positivity(&mut numbers).unwrap();
        prop_assert!(numbers.iter().all(|&n| n >= 0.0));
        prop_assert!((numbers.iter().sum::<f64>() - before).abs() < 1e-12);
    }
}

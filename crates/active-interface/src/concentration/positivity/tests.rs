use super::*;
use crate::error::refused;
use proptest::prelude::*;

fn repair(numbers: &mut [f64]) -> Result<Repair, InterfaceError> {
    let [mut missing, mut shares] = [vec![0.0; numbers.len()], vec![0.0; numbers.len()]];
    repair_positivity(numbers, [&mut missing, &mut shares])
}

#[test]
fn borrows_from_the_neighbours_first() {
    let mut numbers = [5.0, 2.0, -1.0, 2.0, 5.0];
    let repair = repair(&mut numbers).unwrap();
    assert_eq!(numbers, [5.0, 1.5, 0.0, 1.5, 5.0]);
    assert_eq!(repair, Repair { segments: 1, moved: 1.0, furthest: 1 });
}

#[test]
fn then_from_further_out() {
    let mut numbers = [5.0, 0.5, -2.0, 0.5, 5.0, 7.0];
    let repair = repair(&mut numbers).unwrap();
    assert_eq!(numbers, [4.5, 0.0, 0.0, 0.0, 4.5, 7.0]);
    assert_eq!(repair.furthest, 2);
}

#[test]
fn nothing_to_do_and_nothing_to_take() {
    let mut numbers = [1.0, 0.0, 2.0];
    assert_eq!(repair(&mut numbers).unwrap(), Repair::default());
    let error = repair(&mut [1.0, -2.0, 0.5]).unwrap_err();
    assert!(refused(&error, "the particle numbers add up to -0.5"), "{error}");
    assert!(repair(&mut [1.0, f64::NAN, 0.5]).is_err());
}

proptest! {
    #[test]
    fn conserves_and_leaves_nothing_negative(mut numbers in proptest::collection::vec(-1.0..2.0f64, 3..80)) {
        let before: f64 = numbers.iter().sum();
        prop_assume!(before > 1e-9);
        repair(&mut numbers).unwrap();
        prop_assert!(numbers.iter().all(|&n| n >= 0.0));
        prop_assert!((numbers.iter().sum::<f64>() - before).abs() < 1e-12);
    }

    #[test]
    fn mirror_images_stay_mirror_images(mut numbers in proptest::collection::vec(-1.0..1.5f64, 3..80)) {
        prop_assume!(numbers.iter().sum::<f64>() > 1e-9);
        let mut mirrored: Vec<f64> = numbers.iter().rev().copied().collect();
        prop_assert_eq!(repair(&mut numbers).unwrap().furthest, repair(&mut mirrored).unwrap().furthest);
        prop_assert!(numbers.iter().zip(mirrored.iter().rev()).all(|(a, b)| a == b));
    }
}

#[test]
fn repairs_of_a_run_add_up() {
    let mut sum = Repair { segments: 1, moved: 2.0, furthest: 3 };
    sum.accumulate(Repair { segments: 4, moved: 0.5, furthest: 2 });
    assert_eq!(sum, Repair { segments: 5, moved: 2.5, furthest: 3 });
}

/// The segment opposite, which is one and not two, gives what it is asked for once.
#[test]
fn the_opposite_segment_gives_once() {
    let mut numbers = [-1.0, 0.25, 3.0, 0.25];
    let repair = repair(&mut numbers).unwrap();
    assert_eq!(numbers, [0.0, 0.0, 2.5, 0.0]);
    assert_eq!(repair, Repair { segments: 1, moved: 1.0, furthest: 2 });
}

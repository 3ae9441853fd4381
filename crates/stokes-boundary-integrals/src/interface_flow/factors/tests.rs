use nalgebra::DVector;

use super::{DMatrix, DenseFactors};

#[test]
fn products_with_solutions_are_the_right_hand_sides() {
    for count in [1, 3, 4, 7, 30, 48, 131] {
        let entry = |i: usize, j: usize| (1.3 * (i * i + 3 * j + 1) as f64).sin() - if i == j + 1 { 2.0 } else { 0.0 };
        let matrix = DMatrix::from_fn(count, count, entry);
        let right = DVector::from_fn(count, |i, _| (i as f64).cos());
        let mut solution = right.clone();
        DenseFactors::new(matrix.clone()).solve(&mut solution);
        let error = (&matrix * &solution - &right).amax() / solution.amax();
        assert!(error < 1e-13, "{count}: {error:e}");
        let factors = DenseFactors::new(matrix.clone());
        let mut inverse = DMatrix::identity(count, count);
        factors.solve(&mut inverse);
        let error = (&matrix * &inverse - DMatrix::identity(count, count)).amax() / inverse.amax();
        assert!(factors.is_regular() && error < 1e-13, "{count}: {error:e}");
    }
}

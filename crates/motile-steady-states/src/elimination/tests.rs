use nalgebra::DMatrix;

use super::{BLOCK, Elimination};

/// Entries without order between -1 and 1.
fn matrix(rows: usize, columns: usize) -> DMatrix<f64> {
    DMatrix::from_fn(rows, columns, |i, j| (1.7 * (i * i) as f64 + 3.1 * (j * i) as f64 + 0.3 * j as f64).sin())
}

#[test]
fn solutions_are_exact_below_at_and_beyond_the_size_of_a_block() {
    for n in [1, BLOCK - 1, BLOCK, BLOCK + 1, 3 * BLOCK + 5] {
        let mut a = matrix(n, n);
        // A pivot has to be looked for.
        a[(0, 0)] = if n > 1 { 0.0 } else { 1.0 };
        let x = matrix(n, 3);
        let found = Elimination::new(a.clone()).solve(&a * &x).expect("a regular matrix");
        assert!((found - x).amax() < 1e-9, "{n}");
    }
}

#[test]
fn a_singular_matrix_has_no_solution() {
    let mut a = matrix(70, 70);
    a.fill_column(60, 0.0);
    assert!(Elimination::new(a).solve(matrix(70, 1)).is_none());
}

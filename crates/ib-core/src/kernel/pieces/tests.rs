use crate::{
    AnyKernel, Kernel,
    kernel::{MAX_SUPPORT, Role},
};

#[test]
fn polynomials_are_the_weights() {
    let mut with_pieces = 0;
    for kernel in AnyKernel::ALL {
        let Some(pieces) = kernel.pieces() else { continue };
        with_pieces += 1;
        for k in 0..200 {
            let r = 0.0731 * f64::from(k) - 3.0;
            let whole = (r + pieces.shift).floor();
            let t = r + pieces.shift - whole;
            let mut expected = [0.0; MAX_SUPPORT];
            let first = kernel.weights(Role::Normal, r, &mut expected);
            assert_eq!(first, whole as i64 - 1, "{} at {r}", kernel.name());
            for (i, expected) in expected[..kernel.support(Role::Normal)].iter().enumerate() {
                let weight: f64 = (0..4).map(|d| pieces.normal[d as usize][i] * t.powi(d)).sum();
                assert!((weight - expected).abs() < 1e-15, "{}: {weight} {expected}", kernel.name());
            }
            let first = kernel.weights(Role::Tangential, r - 0.5, &mut expected);
            assert_eq!(first, whole as i64 - 1, "{} at {r}", kernel.name());
            for (i, expected) in expected[..kernel.support(Role::Tangential)].iter().enumerate() {
                let weight: f64 = (0..3).map(|d| pieces.tangential[d as usize][i] * t.powi(d)).sum();
                assert!((weight - expected).abs() < 1e-15, "{}: {weight} {expected}", kernel.name());
            }
        }
    }
    assert_eq!(with_pieces, 2);
}

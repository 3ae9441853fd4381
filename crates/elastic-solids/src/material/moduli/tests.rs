use motile_base::InputError;

use super::*;

#[test]
fn conversions_agree() {
    let moduli = Moduli::new(3.0, 7.0).unwrap();
    let back = Moduli::from_young(moduli.young(), moduli.poisson()).unwrap();
    assert!((back.shear() - 3.0).abs() < 1e-14 && (back.bulk() - 7.0).abs() < 1e-14);
    // (4.17) in terms of the Lame coefficients.
    let lame = moduli.lame();
    assert!((moduli.poisson() - lame / (lame + 2.0 * 3.0)).abs() < 1e-15);
}

#[test]
fn the_thesis_springs() {
    let moduli = Moduli::from_thesis_spring_constant(1e4).unwrap();
    assert!((moduli.shear() - 93.75).abs() < 1e-12);
    assert!((moduli.poisson() - 1.0 / 3.0).abs() < 1e-15);
}

#[test]
fn bad_moduli_are_refused() {
    for bad in [0.0, -1.0, f64::NAN, f64::INFINITY] {
        assert!(matches!(Moduli::new(bad, 1.0), Err(SolidError::Input(InputError::NotPositive { .. }))));
        assert!(matches!(Moduli::new(1.0, bad), Err(SolidError::Input(InputError::NotPositive { .. }))));
        assert!(matches!(
            Moduli::from_thesis_spring_constant(bad),
            Err(SolidError::Input(InputError::NotPositive { .. }))
        ));
    }
    for bad in [-1.0, 1.0, 1.5, f64::NAN] {
        assert!(matches!(Moduli::from_young(1.0, bad), Err(SolidError::Input(InputError::OutOfRange { .. }))));
    }
}

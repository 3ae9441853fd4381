//! Properties that every energy must have.

use crate::error::refused;
use motile_base::Vec2;
use proptest::prelude::*;

use crate::check::stress_error;
use crate::material::{DeformationGradient, Mat2, MooneyRivlin, SaintVenantKirchhoff};
use crate::{EnergyDensity, NeoHookean};

const SHEAR: f64 = 1.3;
const BULK: f64 = 2.9;

fn energies() -> Vec<Box<dyn EnergyDensity>> {
    vec![
        Box::new(NeoHookean::new(SHEAR, BULK).unwrap()),
        Box::new(SaintVenantKirchhoff::new(SHEAR, BULK).unwrap()),
        Box::new(MooneyRivlin::new(SHEAR, BULK, 0.0).unwrap()),
        Box::new(MooneyRivlin::new(SHEAR, BULK, 0.35).unwrap()),
        Box::new(MooneyRivlin::new(SHEAR, BULK, 1.0).unwrap()),
    ]
}

/// The Frobenius norm.
fn norm(matrix: Mat2) -> f64 {
    matrix.x_axis.length().hypot(matrix.y_axis.length())
}

fn gradient(matrix: Mat2) -> DeformationGradient {
    DeformationGradient::new(matrix).unwrap()
}

prop_compose! {
    /// Principal stretches from 0.5 to 2 between two rotations: all deformations of that size.
    fn deformations()(first in 0.5..2.0, second in 0.5..2.0, before in -3.2..3.2, after in -3.2..3.2) -> Mat2 {
        Mat2::from_angle(after) * Mat2::from_diagonal(Vec2::new(first, second)) * Mat2::from_angle(before)
    }
}

proptest! {
    #[test]
    fn the_stress_is_the_derivative_of_the_energy(a in deformations()) {
        for energy in energies() {
            let scale = norm(energy.stress(&gradient(a))).max(1.0);
            let error = stress_error(energy.as_ref(), a, 5e-6).unwrap();
            prop_assert!(error < 1e-8 * scale, "{energy:?}: {error}");
        }
    }

    #[test]
    fn a_rotation_of_the_deformed_material_costs_nothing(a in deformations(), angle in -3.2..3.2) {
        let turned = Mat2::from_angle(angle) * a;
        for energy in energies() {
            let here = energy.energy(&gradient(a));
            prop_assert!((energy.energy(&gradient(turned)) - here).abs() < 1e-13 * (1.0 + here));
            let stress = Mat2::from_angle(angle) * energy.stress(&gradient(a));
            prop_assert!(norm(energy.stress(&gradient(turned)) - stress) < 1e-13 * (1.0 + norm(stress)));
        }
    }

    #[test]
    fn turning_the_reference_costs_nothing(a in deformations(), angle in -3.2..3.2) {
        for energy in energies() {
            let here = energy.energy(&gradient(a));
            prop_assert!((energy.energy(&gradient(a * Mat2::from_angle(angle))) - here).abs() < 1e-13 * (1.0 + here));
        }
    }

    #[test]
    fn the_reference_has_the_least_energy(a in deformations(), angle in -3.2..3.2) {
        for energy in energies() {
            prop_assert!(energy.energy(&gradient(a)) > -1e-15, "{energy:?}");
            let rest = gradient(Mat2::from_angle(angle));
            prop_assert!(energy.energy(&rest).abs() < 1e-15);
            prop_assert!(norm(energy.stress(&rest)) < 1e-14);
        }
    }

    #[test]
    fn cauchy_stress_is_symmetric(a in deformations()) {
        for energy in energies() {
            let stress = energy.cauchy_stress(&gradient(a));
            prop_assert!((stress.y_axis.x - stress.x_axis.y).abs() < 1e-13 * (1.0 + norm(stress)));
        }
    }
}

/// Small strains against linear elasticity; the error is of second order in the strain.
#[test]
fn small_strains_measure_the_moduli() {
    for energy in energies() {
        let moduli = energy.moduli();
        assert!((moduli.shear() - SHEAR).abs() < 1e-15 && (moduli.bulk() - BULK).abs() < 1e-15);
        let errors = [1e-2, 1e-3].map(|strain| {
            // Half the difference of opposite strains takes the quadratic part away.
            let response = |h: Mat2| {
                let plus = energy.stress(&gradient(Mat2::IDENTITY + h));
                let minus = energy.stress(&gradient(Mat2::IDENTITY - h));
                (plus - minus) / (2.0 * strain)
            };
            let shear = response(Mat2::from_rows_array(&[0.0, strain, 0.0, 0.0]));
            let stretch = response(strain * Mat2::from_diagonal(Vec2::new(1.0, -1.0)));
            let bulk = response(strain * Mat2::IDENTITY);
            let expected = 2.0 * BULK * Mat2::IDENTITY;
            norm(shear - Mat2::from_rows_array(&[0.0, SHEAR, SHEAR, 0.0]))
                + norm(stretch - 2.0 * SHEAR * Mat2::from_diagonal(Vec2::new(1.0, -1.0)))
                + norm(bulk - expected)
        });
        assert!(errors[0] < 1e-2 && errors[1] < 1e-4, "{energy:?}: {errors:?}");
        let order = (errors[0] / errors[1]).log10();
        assert!((order - 2.0).abs() < 2e-4, "{energy:?}: order {order}");
    }
}

#[test]
fn the_neo_hookean_energy_is_that_of_the_thesis() {
    let a = Mat2::from_rows_array(&[1.2, 0.3, -0.1, 0.9]);
    let (energy, gradient, jacobian) = (NeoHookean::new(SHEAR, BULK).unwrap(), gradient(a), a.determinant());
    // (4.8) with A A^T, and (4.15), as printed.
    let trace = (a * a.transpose()).trace();
    let expected = SHEAR / 2.0 * (trace / jacobian - 2.0) + BULK / 2.0 * (jacobian - 1.0).powi(2);
    assert!((energy.energy(&gradient) - expected).abs() < 1e-15);
    let inverse = a.inverse().transpose();
    let expected =
        SHEAR * (a / jacobian - trace * inverse / (2.0 * jacobian)) + BULK * (jacobian - 1.0) * jacobian * inverse;
    assert!(norm(energy.stress(&gradient) - expected) < 1e-15);
}

#[test]
fn distortion_and_cofactor_by_their_definitions() {
    let a = Mat2::from_rows_array(&[1.3, 0.2, -0.4, 0.8]);
    let gradient = DeformationGradient::new(a).unwrap();
    let expected = (a * a.transpose()).trace() - 2.0 * a.determinant();
    assert!((gradient.distortion() - expected).abs() < 1e-15);
    let cofactor = a.determinant() * a.inverse().transpose();
    let difference = (gradient.cofactor() - cofactor).to_cols_array();
    assert!(difference.iter().all(|entry| entry.abs() <= 5e-16));
}

#[test]
fn inversion_and_bad_numbers_are_refused() {
    for bad in [
        Mat2::from_rows_array(&[1.0, 0.0, 0.0, -1.0]),
        Mat2::from_rows_array(&[1.0, 1.0, 1.0, 1.0]),
        Mat2::from_rows_array(&[f64::NAN, 0.0, 0.0, 1.0]),
        Mat2::from_rows_array(&[f64::INFINITY, 0.0, 0.0, 1.0]),
    ] {
        let error = DeformationGradient::new(bad).unwrap_err();
        assert!(refused(&error, "inverts or flattens the material"), "{error}");
    }
}

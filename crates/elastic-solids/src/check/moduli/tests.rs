use motile_base::InputError;

use super::*;
use crate::forces::{Hyperelastic, Springs};
use crate::material::SaintVenantKirchhoff;
use crate::mesh::{equilateral_block, equilateral_strip};
use crate::{Interior, Mesher, NeoHookean, Outline};

const SHEAR: f64 = 93.75;

fn measured(mesh: &TriangleMesh, law: &dyn ElasticForces, inner: InnerPoints) -> MeasuredModuli {
    measured_moduli(mesh, law, 1e-3, inner).unwrap()
}

fn assert_close(found: MeasuredModuli, shear: f64, bulk: f64, tolerance: f64) {
    let errors = (found.shear / shear - 1.0, found.bulk / bulk - 1.0);
    assert!(errors.0.abs() < tolerance && errors.1.abs() < tolerance, "{errors:?}");
}

/// Unstructured meshes: a wall with turned seeds, and a disc.
fn unstructured() -> [TriangleMesh; 2] {
    let flat = |y: f64| Outline::flat(0.0, 4.0, y).unwrap();
    let wall = Interior::new([flat(0.0), flat(1.5)]).unwrap();
    let turned = Mesher::new(0.05).unwrap().turned(0.2).unwrap().mesh(&wall).unwrap();
    [turned, Outline::circle(Vec2::ZERO, 1.0).unwrap().mesh(0.06).unwrap()]
}

#[test]
fn springs_on_an_equilateral_lattice() {
    for mesh in
        [equilateral_strip(Vec2::ZERO, 20, 12, 0.05).unwrap(), equilateral_block(Vec2::ZERO, 12, 9, 0.05).unwrap()]
    {
        let law = Springs::new(&mesh, SHEAR).unwrap();
        for inner in [InnerPoints::Strained, InnerPoints::Relaxed] {
            assert_close(measured(&mesh, &law, inner), SHEAR, 2.0 * SHEAR, 1e-3);
        }
    }
}

#[test]
fn springs_on_unstructured_meshes() {
    for mesh in unstructured() {
        let law = Springs::new(&mesh, SHEAR).unwrap();
        for inner in [InnerPoints::Strained, InnerPoints::Relaxed] {
            let found = measured(&mesh, &law, inner);
            assert!((found.shear / SHEAR - 1.0).abs() < 0.006, "{inner:?} {found:?}");
            // The bulk modulus of a wall is the difference of this and the shear modulus, with both their
            // anisotropies.
            let stretch = found.shear + found.bulk;
            assert!((stretch / (3.0 * SHEAR) - 1.0).abs() < 0.02, "{inner:?} {found:?}");
            if mesh.period().is_none() {
                assert!((found.bulk / (2.0 * SHEAR) - 1.0).abs() < 0.002, "{inner:?} {found:?}");
            }
        }
        let [strained, relaxed] =
            [InnerPoints::Strained, InnerPoints::Relaxed].map(|inner| measured(&mesh, &law, inner));
        assert!(relaxed.shear < strained.shear);
    }
}

#[test]
fn hyperelastic_material_on_any_mesh() {
    for mesh in unstructured() {
        for inner in [InnerPoints::Strained, InnerPoints::Relaxed] {
            let law = Hyperelastic::new(&mesh, NeoHookean::new(SHEAR, 5.0 * SHEAR).unwrap());
            assert_close(measured(&mesh, &law, inner), SHEAR, 5.0 * SHEAR, 1e-3);
            let law = Hyperelastic::new(&mesh, SaintVenantKirchhoff::new(SHEAR, 5.0 * SHEAR).unwrap());
            assert_close(measured(&mesh, &law, inner), SHEAR, 5.0 * SHEAR, 1e-3);
        }
    }
}

/// Two layers in series: the compliances add up under shear, the stiffnesses would if the strain were uniform.
#[test]
fn layers_in_series_relax_to_the_mean_compliance() {
    let mesh = equilateral_strip(Vec2::ZERO, 10, 20, 0.05).unwrap();
    let middle = 10.0 * 0.05 * 0.75_f64.sqrt();
    let law =
        Hyperelastic::graded(
            &mesh,
            |s| {
                if s.y < middle { NeoHookean::new(1.0, 2.0) } else { NeoHookean::new(3.0, 2.0) }
            },
        );
    let law = law.unwrap();
    let strained = measured(&mesh, &law, InnerPoints::Strained);
    let relaxed = measured(&mesh, &law, InnerPoints::Relaxed);
    assert!((strained.shear - 2.0).abs() < 1e-12 && (relaxed.shear - 1.5).abs() < 2e-7, "{strained:?} {relaxed:?}");
}

#[test]
fn bad_strains_are_refused() {
    let mesh = equilateral_block(Vec2::ZERO, 3, 3, 1.0).unwrap();
    let law = Springs::new(&mesh, 1.0).unwrap();
    for strain in [0.0, -1e-3, 0.5, f64::NAN] {
        let found = measured_moduli(&mesh, &law, strain, InnerPoints::Strained);
        assert!(matches!(found, Err(SolidError::Input(InputError::OutOfRange { .. }))));
    }
    let other = equilateral_block(Vec2::ZERO, 4, 3, 1.0).unwrap();
    let found = measured_moduli(&other, &law, 1e-3, InnerPoints::Strained);
    assert!(matches!(found, Err(SolidError::Input(InputError::WrongLength { .. }))));
}

//! Moduli as a mesh shows them.

use ib_core::Vec2;

use crate::error::within;
use crate::forces::fits;
use crate::{ElasticForces, Mat2, SolidError, TriangleMesh};

/// Moduli measured on a mesh (force per length).
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct MeasuredModuli {
    /// Shear modulus.
    pub shear: f64,
    /// Bulk modulus.
    pub bulk: f64,
}

/// What the inner points do while the boundary is strained.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum InnerPoints {
    /// They follow the uniform strain: the sum over the triangles as they are.
    Strained,
    /// They relax to equilibrium: what a solid of this mesh feels like from outside. Never more than
    /// [`InnerPoints::Strained`].
    Relaxed,
}

/// Shear and bulk modulus of a mesh under the small uniform strain `strain` (dimensionless, 1e-6 to 0.1), with the
/// boundary displaced uniformly.
///
/// The energy density of the simple shear X = s + g (s_y, 0) is mu g^2/2, that of the dilation X = (1 + g) s is 2 kappa
/// g^2; the mean over g and -g is taken, so that the error is of second order in the strain. A periodic mesh cannot
/// dilate: there the stretch X = s + g (0, s_y), of energy density (mu + kappa) g^2/2, takes its place.
///
/// ```
/// use elastic_solids::*;
/// use ib_core::Vec2;
///
/// let disc = Outline::circle(Vec2::zeros(), 1.0)?.mesh(0.1)?;
/// let springs = Springs::new(&disc, 100.0)?;
/// let found = measured_moduli(&disc, &springs, 1e-3, InnerPoints::Relaxed)?;
/// println!("{:.1} and {:.1}", found.shear, found.bulk); // within 2 % of 100 and 200
/// assert!((found.shear - 100.0).abs() < 2.0 && (found.bulk - 200.0).abs() < 4.0);
/// # Ok::<(), SolidError>(())
/// ```
///
/// # Errors
/// Forces made for another mesh; a strain out of its range; a relaxation that does not converge, which only an unstable
/// material has.
pub fn measured_moduli<F: ElasticForces + ?Sized>(
    mesh: &TriangleMesh,
    law: &F,
    strain: f64,
    inner: InnerPoints,
) -> Result<MeasuredModuli, SolidError> {
    fits("the mesh of the forces", law.point_count(), mesh.points().len())?;
    within("the strain", strain, 1e-6, 0.1)?;
    let stiffness = |direction: Mat2| -> Result<f64, SolidError> {
        let mut sum = 0.0;
        for strain in [strain, -strain] {
            let mut positions: Vec<Vec2> = mesh.points().iter().map(|s| s + direction * s * strain).collect();
            if inner == InnerPoints::Relaxed {
                relax_inner(mesh, law, &mut positions)?;
            }
            sum += law.energy(&positions)?;
        }
        // Mean of the two energies, over half the strain squared.
        Ok(sum / (mesh.area() * strain * strain))
    };
    let shear = stiffness(Mat2::new(0.0, 1.0, 0.0, 0.0))?;
    let bulk = match mesh.period() {
        None => 0.25 * stiffness(Mat2::identity())?,
        Some(_) => stiffness(Mat2::new(0.0, 0.0, 0.0, 1.0))? - shear,
    };
    Ok(MeasuredModuli { shear, bulk })
}

/// Residual force over the force at the start at which the inner points are in equilibrium; the energy is exact to its
/// square.
const TOLERANCE: f64 = 1e-6;

/// Moves the points that are not on the boundary until the forces on them vanish, by nonlinear conjugate gradients
/// (Polak and Ribiere) with one secant step along each direction, which is exact for small strains.
fn relax_inner<F: ElasticForces + ?Sized>(
    mesh: &TriangleMesh,
    law: &F,
    positions: &mut [Vec2],
) -> Result<(), SolidError> {
    let mut inner = vec![true; positions.len()];
    for &point in mesh.boundary_loops().iter().flat_map(|boundary| &boundary.points) {
        inner[point] = false;
    }
    let residual = |positions: &[Vec2], forces: &mut Vec<Vec2>| -> Result<(), SolidError> {
        forces.fill(Vec2::zeros());
        law.add_forces(positions, forces)?;
        for (force, _) in forces.iter_mut().zip(&inner).filter(|(_, inner)| !**inner) {
            *force = Vec2::zeros();
        }
        Ok(())
    };
    let dot = |a: &[Vec2], b: &[Vec2]| a.iter().zip(b).map(|(a, b)| a.dot(b)).sum::<f64>();
    let count = positions.len();
    let mut forces = vec![Vec2::zeros(); count];
    // The size of forces to compare with: those that the boundary holds.
    law.add_forces(positions, &mut forces)?;
    let scale = dot(&forces, &forces);
    residual(positions, &mut forces)?;
    let (mut direction, mut before, mut trial) = (forces.clone(), forces.clone(), positions.to_vec());
    let mut squared = dot(&forces, &forces);
    for _ in 0..50 * count.max(20) {
        if squared <= TOLERANCE * TOLERANCE * scale {
            return Ok(());
        }
        // Curvature along the direction from a short way ahead.
        let reach = 1e-4 * mesh_step(mesh) / direction.iter().map(Vec2::norm).fold(0.0, f64::max);
        let slope = dot(&forces, &direction);
        for ((trial, place), step) in trial.iter_mut().zip(positions.iter()).zip(&direction) {
            *trial = place + step * reach;
        }
        before.copy_from_slice(&forces);
        residual(&trial, &mut forces)?;
        let curvature = (slope - dot(&forces, &direction)) / reach;
        if !(curvature > 0.0 && slope.is_finite()) {
            break;
        }
        for (place, step) in positions.iter_mut().zip(&direction) {
            *place += step * (slope / curvature);
        }
        residual(positions, &mut forces)?;
        let squared_before = squared;
        squared = dot(&forces, &forces);
        let keep = ((squared - dot(&forces, &before)) / squared_before).max(0.0);
        for (direction, force) in direction.iter_mut().zip(&forces) {
            *direction = force + *direction * keep;
        }
    }
    Err(SolidError::NotRelaxed { residual: (squared / scale).sqrt() })
}

fn mesh_step(mesh: &TriangleMesh) -> f64 {
    (mesh.area() / mesh.triangles().len() as f64).sqrt()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::{
        Hyperelastic, Mesher, NeoHookean, Outline, Region, SaintVenantKirchhoff, Springs, equilateral_block,
        equilateral_strip,
    };

    const SHEAR: f64 = 93.75;

    fn measured<F: ElasticForces>(mesh: &TriangleMesh, law: &F, inner: InnerPoints) -> MeasuredModuli {
        measured_moduli(mesh, law, 1e-3, inner).unwrap()
    }

    fn assert_close(found: MeasuredModuli, shear: f64, bulk: f64, tolerance: f64) {
        let errors = (found.shear / shear - 1.0, found.bulk / bulk - 1.0);
        assert!(errors.0.abs() < tolerance && errors.1.abs() < tolerance, "{errors:?}");
    }

    /// Unstructured meshes: a wall with turned seeds, and a disc.
    fn unstructured() -> [TriangleMesh; 2] {
        let flat = |y: f64| Outline::flat(0.0, 4.0, y).unwrap();
        let wall = Region::new([flat(0.0), flat(1.5)]).unwrap();
        let turned = Mesher::new(0.05).unwrap().turned(0.2).unwrap().mesh(&wall).unwrap();
        [turned, Outline::circle(Vec2::zeros(), 1.0).unwrap().mesh(0.06).unwrap()]
    }

    #[test]
    fn springs_on_an_equilateral_lattice() {
        for mesh in [
            equilateral_strip(Vec2::zeros(), 20, 12, 0.05).unwrap(),
            equilateral_block(Vec2::zeros(), 12, 9, 0.05).unwrap(),
        ] {
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
                assert!((found.shear / SHEAR - 1.0).abs() < 0.02, "{inner:?} {found:?}");
                // The bulk modulus of a wall is the difference of this and the shear modulus, with both their
                // anisotropies.
                let stretch = found.shear + found.bulk;
                assert!((stretch / (3.0 * SHEAR) - 1.0).abs() < 0.02, "{inner:?} {found:?}");
                if mesh.period().is_none() {
                    assert!((found.bulk / (2.0 * SHEAR) - 1.0).abs() < 0.01, "{inner:?} {found:?}");
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
        let mesh = equilateral_strip(Vec2::zeros(), 10, 20, 0.05).unwrap();
        let middle = 10.0 * 0.05 * 0.75_f64.sqrt();
        let law = Hyperelastic::graded(&mesh, |s| {
            if s.y < middle { NeoHookean::new(1.0, 2.0) } else { NeoHookean::new(3.0, 2.0) }
        });
        let law = law.unwrap();
        let strained = measured(&mesh, &law, InnerPoints::Strained);
        let relaxed = measured(&mesh, &law, InnerPoints::Relaxed);
        assert!((strained.shear - 2.0).abs() < 1e-3 && (relaxed.shear - 1.5).abs() < 1e-3, "{strained:?} {relaxed:?}");
    }

    #[test]
    fn bad_strains_are_refused() {
        let mesh = equilateral_block(Vec2::zeros(), 3, 3, 1.0).unwrap();
        let law = Springs::new(&mesh, 1.0).unwrap();
        for strain in [0.0, -1e-3, 0.5, f64::NAN] {
            let found = measured_moduli(&mesh, &law, strain, InnerPoints::Strained);
            assert!(matches!(found, Err(SolidError::OutOfRange { .. })));
        }
        let other = equilateral_block(Vec2::zeros(), 4, 3, 1.0).unwrap();
        let found = measured_moduli(&other, &law, 1e-3, InnerPoints::Strained);
        assert!(matches!(found, Err(SolidError::WrongLength { .. })));
    }
}

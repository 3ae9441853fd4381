use super::*;
use crate::forces::Springs;
use crate::mesh::equilateral_strip;

#[test]
fn what_is_not_finite_is_refused() {
    let mesh = equilateral_strip(Vec2::ZERO, 8, 4, 0.1).unwrap();
    let law = Springs::new(&mesh, 1.0).unwrap();
    let mut positions = mesh.points().to_vec();
    assert!(force_balance(&law, &positions).is_ok());
    positions[3].x = f64::NAN;
    assert!(force_balance(&law, &positions).is_err());
    assert!(force_balance(&law, &positions[1..]).is_err());
    assert!(patch_residual(&mesh, &law, Mat2::from_rows_array(&[1.0, f64::NAN, 0.0, 1.0])).is_err());
}

/// Opposite forces of a size on the first two points.
#[derive(Debug)]
struct Couple(Vec2);

impl ElasticForces for Couple {
    fn point_count(&self) -> usize {
        2
    }
    fn add_forces(&self, _: &[Vec2], forces: &mut [Vec2]) -> Result<(), SolidError> {
        forces[0] += self.0;
        forces[1] -= self.0;
        Ok(())
    }
    fn energy(&self, _: &[Vec2]) -> Result<f64, SolidError> {
        Ok(0.0)
    }
    fn stress(&self, _: usize, _: &Mat2) -> Option<Mat2> {
        None
    }
    fn stiffest(&self) -> crate::Moduli {
        crate::Moduli::springs_of_checked(1.0)
    }
}

/// The torque of a couple over its forces is half the arm, whatever their size.
#[test]
fn the_torque_of_a_couple_is_its_arm() {
    for size in [1e-3, 50.0] {
        let balance = force_balance(&Couple(Vec2::new(0.0, size)), &[Vec2::ZERO, Vec2::new(0.6, 0.2)]).unwrap();
        assert!(balance.sum == 0.0 && (balance.torque - 0.3).abs() < 1e-15, "{balance:?}");
    }
}

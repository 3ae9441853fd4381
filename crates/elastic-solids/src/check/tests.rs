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

use motile_base::Vec2;
use motile_scene::Body;

use crate::{Solid, mesh::equilateral_strip};

#[test]
fn forces_add_up_to_the_weight() {
    let mesh = equilateral_strip(Vec2::new(-1.0, -0.5), 10, 6, 0.2).unwrap();
    let (area, weight) = (mesh.area(), Vec2::new(0.2, -3.0));
    let mut solid = Solid::springs(mesh, 10.0).unwrap().with_body_force(weight).unwrap();
    solid.compute_forces().unwrap();
    let sum: Vec2 = solid.forces.iter().sum();
    assert!((sum - area * weight).length() < 1e-12 * area, "{sum} {area}");
    let names: Vec<(String, f64)> = solid.properties();
    assert!(names.iter().any(|(name, value)| name == "the body force along y" && *value == -3.0));
}

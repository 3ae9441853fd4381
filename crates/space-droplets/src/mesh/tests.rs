use crate::{ConstantTension, SpaceDroplet};

/// Triangles are closed and outward, and their area and volume converge with the second order.
#[test]
fn triangles_enclose_the_droplet() {
    let law = || ConstantTension::new(1.0).unwrap();
    let errors = [6, 12].map(|degree| {
        let spheroid = |s: [f64; 3]| [1.2 * s[0], s[1], 0.9 * s[2] + 0.1 * s[0]];
        let droplet = SpaceDroplet::shaped(degree, spheroid, [1.0, 1.0], law()).unwrap();
        let mut droplet = droplet.with_position([5.0, 0.0, -3.0]).unwrap();
        let seen = droplet.observe().unwrap();
        let mesh = droplet.mesh().unwrap();
        let (mut area, mut volume) = (0.0, 0.0);
        let mut edges = std::collections::HashMap::new();
        for corners in &mesh.triangles {
            let [a, b, c] = corners.map(|k| mesh.points[k]);
            let side = |from: [f64; 3], to: [f64; 3]| nalgebra::Vector3::from(to) - nalgebra::Vector3::from(from);
            let normal = side(a, b).cross(&side(a, c));
            area += 0.5 * normal.norm();
            volume += normal.dot(&side([5.0, 0.0, -3.0], a)) / 6.0;
            assert!(normal.dot(&side([5.0, 0.0, -3.0], a)) > 0.0);
            for k in 0..3 {
                *edges.entry((corners[k], corners[(k + 1) % 3])).or_insert(0) += 1;
            }
        }
        let smooth = droplet.smooth_mesh(30).unwrap();
        let far = |point: &[f64; 3]| (point[0] - 5.0).hypot(point[1]).hypot(point[2] + 3.0);
        let [coarse, fine] = [&mesh, &smooth].map(|mesh| mesh.points.iter().map(far).fold(0.0, f64::max));
        assert!(smooth.points.len() == 1802 && (fine / coarse - 1.0).abs() < 0.02 && droplet.smooth_mesh(3).is_err());
        // Each edge belongs to two triangles, once in each direction.
        assert!(edges.iter().all(|((a, b), count)| *count == 1 && edges.contains_key(&(*b, *a))));
        let lists = [mesh.concentrations.len(), mesh.tensions.len(), mesh.velocities.len()];
        assert!(lists.iter().all(|len| *len == mesh.points.len()) && mesh.tensions.iter().all(|t| *t == 1.0));
        [area / seen.area - 1.0, volume / seen.volume - 1.0].map(f64::abs)
    });
    for (coarse, fine) in errors[0].iter().zip(&errors[1]) {
        assert!(*fine < 0.01 && (3.0..4.6).contains(&(coarse / fine)), "{errors:?}");
    }
}

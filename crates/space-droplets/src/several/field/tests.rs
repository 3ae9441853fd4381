use crate::{ContractileTension, ExcludedVolume, SpaceDroplet, SpaceDroplets};

/// The flow of a sphere with a gradient of tension: a dipole outside, and `(2.5 - 1.5 r^2) U` along the axis inside.
#[test]
fn a_marangoni_sphere_has_its_flow_on_both_sides() {
    for ratio in [1.0, 5.0] {
        let law = ContractileTension::new(1.0, -0.5, ExcludedVolume::None, 1.0).unwrap();
        let axis = [0.6, 0.0, 0.8];
        let along = |s: [f64; 3]| s[0] * axis[0] + s[2] * axis[2];
        let sphere = SpaceDroplet::sphere(12, 1.0, [ratio, 1.0], law).unwrap();
        let sphere = sphere.with_particles(0.1, |s| 1.0 + along(s)).unwrap().with_position([3.0, 1.0, 0.0]).unwrap();
        let mut all = SpaceDroplets::new(vec![sphere]).unwrap();
        all.evaluate().unwrap();
        let speed = -1.0 / (3.0 * (2.0 + 3.0 * ratio));
        let radii = [0.0, 0.3, 0.9, 0.999, 1.001, 1.1, 2.0, 6.0];
        let place = |r: f64| [3.0 + r * axis[0], 1.0, r * axis[2]];
        let found = all.velocities_at(&radii.map(place), 1e-10).unwrap();
        for (r, u) in radii.into_iter().zip(found) {
            let exact = if r < 1.0 { (2.5 - 1.5 * r * r) * speed } else { speed / r.powi(3) };
            assert!((along(u) - exact).abs() < 1e-9 && u[1].abs() < 1e-9, "ratio {ratio}, r {r}: {u:?} {exact}");
        }
        // Across the axis, the dipole flows backwards.
        let beside = all.velocities_at(&[[3.0, 3.0, 0.0]], 1e-10).unwrap()[0];
        assert!((along(beside) + 0.5 * speed / 8.0).abs() < 1e-9, "{beside:?}");
    }
}

/// Far from a droplet, there is the imposed flow alone.
#[test]
fn the_imposed_flow_is_part_of_it() {
    let law = ContractileTension::new(1.0, 0.0, ExcludedVolume::None, 1.0).unwrap();
    let shear = [[0.0, 2.0, 0.0], [0.0; 3], [0.0; 3]];
    let droplet = SpaceDroplet::sphere(6, 1.0, [3.0, 1.0], law).unwrap().with_imposed_flow(shear).unwrap();
    let all = SpaceDroplets::new(vec![droplet]).unwrap();
    let [far, nothing] = [[1e4, 2e4, 0.0], [0.0; 3]];
    let found = all.velocities_at(&[far, nothing], 1e-3).unwrap();
    assert!((found[0][0] / 4e4 - 1.0).abs() < 1e-9 && found[1][0].abs() < 1e-9, "{found:?}");
    assert!(all.velocities_at(&[nothing], 1.0).is_err());
    assert!(
        all.velocities_at(&[[f64::NAN, 0.0, 0.0]], 1e-3).is_err() && all.velocities_at(&[], 1e-3).unwrap().is_empty()
    );
}

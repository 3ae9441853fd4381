use super::*;

fn body() -> RigidBody {
    // Markers crowd on one side, so that their mean is not the centroid.
    let at = |k: usize| {
        let angle = std::f64::consts::TAU * k as f64 / 200.0;
        Vec2::new(2.0, -1.0) + Vec2::new(1.5, 0.7) * Vec2::from_angle(angle + 0.4 * angle.sin())
    };
    RigidBody::new(&(0..200).rev().map(at).collect::<Vec<_>>()).unwrap()
}

fn view() -> FluidView {
    let domain = motile_scene::Domain { origin: [0.0; 2], periods: [None; 2].into(), walls: None };
    FluidView {
        domain,
        viscosity: 1.0,
        spacing: None,
        second_order: true,
        shape_modes: None,
        nodes: None,
        interface_stiffness: 1.0,
    }
}

#[test]
fn its_centre_is_that_of_its_area() {
    let body = body();
    assert!((body.centre() - Vec2::new(2.0, -1.0)).length() < 1e-4, "{:?}", body.centre());
    assert!((body.area() / (std::f64::consts::PI * 1.5 * 0.7) - 1.0).abs() < 1e-3);
    assert!((body.mean).length() > 0.1);
    // Its markers run counter-clockwise, though the points that were given do not.
    assert!(area_and_arm(&body.markers().collect::<Vec<_>>()).0 > 0.0);
}

#[test]
fn rates_are_those_of_the_rigid_motion_at_its_markers() {
    let mut body = body();
    body.read_state(&[3.0, 4.0, 0.7]).unwrap();
    let velocities: Vec<Vec2> =
        body.markers().map(|x| Vec2::new(0.3, -0.2) + 1.7 * (x - Vec2::new(3.0, 4.0)).perp()).collect();
    let mut rate = [0.0; 3];
    body.rate(&velocities, &mut rate);
    for (rate, exact) in rate.into_iter().zip([0.3, -0.2, 1.7]) {
        assert!((rate - exact).abs() < 1e-13, "{rate} {exact}");
    }
}

#[test]
fn its_forces_have_the_resultant_and_torque_of_its_load() {
    let mut body = body().with_load(Vec2::new(0.4, -1.3), 2.1).unwrap();
    body.read_state(&[3.0, 4.0, 0.7]).unwrap();
    let mut forces = vec![Vec2::ZERO; body.marker_count()];
    body.write_forces(&view(), &mut forces).unwrap();
    let total: Vec2 = forces.iter().sum();
    let torque: f64 = body.markers().zip(&forces).map(|(x, f)| (x - body.centre()).perp_dot(*f)).sum();
    assert!((total - Vec2::new(0.4, -1.3)).length() < 1e-13 && (torque - 2.1).abs() < 1e-12, "{total} {torque}");
}

#[test]
fn what_is_no_body_is_refused() {
    let error = RigidBody::new(&[Vec2::ZERO; 7]).unwrap_err().to_string();
    assert!(error.contains('7'), "{error}");
    let error = RigidBody::new(&[Vec2::ZERO; 9]).unwrap_err().to_string();
    assert!(error.contains("area"), "{error}");
    assert!(RigidBody::new(&[Vec2::splat(f64::NAN); 9]).is_err());
    assert!(body().with_load(Vec2::ZERO, f64::INFINITY).is_err());
    assert!(body().read_state(&[0.0, f64::NAN, 0.0]).is_err());
}

/// Warned of is a body whose nodes are so far apart that its sides are not resolved, with the number that does; bodies
/// of any shape that is round enough are not.
#[test]
fn slender_bodies_need_more_nodes() {
    let ellipse = |[a, b]: [f64; 2], count: usize| {
        let at = |k: usize| std::f64::consts::TAU * k as f64 / count as f64;
        let points: Vec<Vec2> = (0..count).map(|k| Vec2::new(a * at(k).cos(), b * at(k).sin())).collect();
        RigidBody::new(&points).unwrap().named("rod")
    };
    let look = |body: &RigidBody, nodes: usize| body.warnings(&FluidView { nodes: Some(nodes), ..view() });
    // The sides of an ellipse are 2 b apart where nodes are 2 pi a/nodes apart, for which 76 nodes do; towards its tips
    // it is a sixth less.
    for count in [200, 3000] {
        let rod = ellipse([1.0, 0.1], count);
        let [warning] = &look(&rod, 64)[..] else { panic!("no warning") };
        let needed: usize = (64..4096).find(|nodes| look(&rod, *nodes).is_empty()).unwrap();
        println!("{warning}");
        assert!((85..95).contains(&needed), "{needed}");
        assert!(warning.to_string().contains(&format!("use {needed} nodes instead of 64")), "{warning}");
        assert!((warning.excess - needed as f64 / 64.0).abs() < 0.02, "{}", warning.excess);
        assert!(look(&ellipse([1.0, 0.5], count), 24).is_empty() && look(&ellipse([1.0, 1.0], count), 8).is_empty());
    }
}

/// The forces of stresses are minus the transpose of the rates, and the prescribed motion has the rates that are taken
/// off, whether a load or the markers hold the body.
#[test]
fn what_holds_it_is_the_transpose_of_its_rates() {
    let held = body().moving(Vec2::new(0.3, -0.2), 1.7).unwrap();
    for mut body in [held.clone(), held.by_markers(0.05).unwrap()] {
        body.read_state(&[3.0, 4.0, 0.7]).unwrap();
        let moved: Vec<Vec2> =
            body.markers().map(|x| Vec2::new(0.3, -0.2) + 1.7 * (x - Vec2::new(3.0, 4.0)).perp()).collect();
        let mut rates = vec![0.0; body.stress_count()];
        body.write_rates(&moved, &mut rates);
        body.subtract_prescribed(&mut rates);
        assert!(rates.iter().all(|rate| rate.abs() < 1e-13), "{rates:?}");
        let wavy: Vec<Vec2> = (0..200).map(|k| Vec2::from_angle(0.37 * f64::from(k))).collect();
        let stresses: Vec<f64> = (0..rates.len()).map(|k| (0.7 * k as f64).cos()).collect();
        body.write_rates(&wavy, &mut rates);
        let mut forces = vec![Vec2::ZERO; 200];
        body.add_stress_forces(&stresses, &mut forces);
        let power: f64 = forces.iter().zip(&wavy).map(|(force, v)| force.dot(*v)).sum();
        let taken: f64 = rates.iter().zip(&stresses).map(|(rate, stress)| rate * stress).sum();
        assert!((power + taken).abs() < 1e-12 * taken.abs().max(1.0), "{power} {taken}");
        let mut rate = [0.0; 3];
        body.rate(&wavy, &mut rate);
        assert_eq!(rate, [0.3, -0.2, 1.7]);
        // A checkpoint has what holds the body.
        body.set_stresses(&stresses);
        let saved = body.save();
        body.set_stresses(&vec![0.0; stresses.len()]);
        body.load(&view(), &saved).unwrap();
        assert_eq!(body.stresses(), stresses);
    }
}

/// Markers behind the outline of a circle lie on a smaller circle.
#[test]
fn markers_lie_behind_the_outline() {
    let circle: Vec<Vec2> =
        (0..40).map(|k| 2.0 * Vec2::from_angle(f64::from(k) * std::f64::consts::PI / 20.0)).collect();
    let held = RigidBody::new(&circle).unwrap().held();
    let body = held.clone().by_markers(0.3).unwrap();
    assert!(body.markers().all(|marker| (marker.length() - 1.7).abs() < 1e-12));
    assert_eq!(body.kind(), MarkerKind::UnevenInterface { viscosity_inside: None });
    for inset in [-0.1, 2.1, f64::NAN] {
        let error = held.clone().by_markers(inset).unwrap_err().to_string();
        assert!(error.contains("inset"), "{error}");
    }
    let free = RigidBody::new(&circle).unwrap();
    assert_eq!(free.clone().by_markers(0.3).unwrap(), free);
}

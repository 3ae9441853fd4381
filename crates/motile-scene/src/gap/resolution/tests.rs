use super::*;

/// A polygon that follows a circle has its curvature at every side, and the lengths of its sides.
#[test]
fn polygons_have_the_curvature_of_their_circle() {
    let mut boundary = Boundary::default();
    for (radius, centre) in [(0.5, Vec2::ZERO), (2.0, Vec2::new(5.0, 0.0))] {
        let angle = |k: usize| std::f64::consts::TAU * k as f64 / 64.0;
        boundary.push_loop(&(0..64).map(|k| centre + radius * Vec2::from_angle(angle(k))).collect::<Vec<_>>());
    }
    for (side, radius) in [(0, 0.5), (30, 0.5), (63, 0.5), (64, 2.0), (127, 2.0)] {
        let [curvature, length] = boundary.local(side, 4);
        assert!((curvature * radius - 1.0).abs() < 1e-3, "{side}: {curvature}");
        assert!((length / (std::f64::consts::TAU * radius / 64.0) - 1.0).abs() < 1e-3, "{side}: {length}");
    }
}

/// For two circles the breadth is the c of bipolar coordinates: `sqrt(d^2 - R^2)` beside a plane at distance d.
#[test]
fn breadths_are_those_of_bipolar_coordinates() {
    for (radius, distance) in [(1.0, 1.01), (0.3, 1.7)] {
        let exact = f64::sqrt(distance * distance - radius * radius);
        assert!((breadth(distance - radius, 1.0 / radius) / exact - 1.0).abs() < 1e-12);
    }
    assert!(breadth(0.1, -0.5).is_infinite());
}

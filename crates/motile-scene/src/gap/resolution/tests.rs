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

/// Equally spaced corners of an ellipse of these half axes, along x and y, at that gap above the height -2.
fn ellipse(half_axes: [f64; 2], gap: f64, corners: usize) -> Boundary {
    let place = |t: f64| Vec2::new(half_axes[0] * t.cos(), half_axes[1] * t.sin() + half_axes[1] + gap - 2.0);
    let fine = 20_000;
    let mut lengths = vec![0.0];
    for k in 1..=fine {
        let at = |k: usize| place(std::f64::consts::TAU * k as f64 / fine as f64);
        lengths.push(lengths[k - 1] + at(k).distance(at(k - 1)));
    }
    let corner = |k: usize| {
        let length = lengths[fine] * k as f64 / corners as f64;
        let after = lengths.partition_point(|at| *at <= length).min(fine);
        let part = (length - lengths[after - 1]) / (lengths[after] - lengths[after - 1]);
        place(std::f64::consts::TAU * ((after - 1) as f64 + part) / fine as f64)
    };
    let mut boundary = Boundary::default();
    boundary.push_loop(&(0..corners).map(corner).collect::<Vec<_>>());
    boundary
}

/// Ellipses that a force pushes towards a wall at a gap of 0.02. The speeds of those that are told are 8.6, 1.3, 10 and
/// 3.2 % off, and a slender one along the wall with 80 nodes is 0.05 % off, against the speed with 240 nodes.
#[test]
fn slender_bodies_at_a_straight_wall_are_told_by_their_ends() {
    let droplet = MarkerKind::Interface { viscosity_inside: None };
    for (half_axes, nodes, told) in [
        ([0.8, 0.2], 40, true),
        ([0.8, 0.2], 56, true),
        ([0.8, 0.2], 80, false),
        ([0.2, 0.8], 56, true),
        ([0.2, 0.8], 80, true),
        ([0.2, 0.8], 192, false),
        ([0.4, 0.4], 72, false),
    ] {
        let body = ellipse(half_axes, 0.02, 8 * nodes);
        let surfaces = Surfaces::of([(body.clone(), MarkerKind::Rigid)]);
        let found = surfaces.coarse_straight(nodes, [-2.0, 2.0]);
        println!("{half_axes:?} {nodes}: {found:?}");
        assert_eq!(found.is_some(), told, "{half_axes:?} {nodes}: {found:?}");
        // As the gap at the upper wall, and not at all for a droplet or far away.
        let upper = surfaces.coarse_straight(nodes, [-8.0, 2.0 * half_axes[1] + 0.04 - 2.0]);
        assert_eq!(upper.is_some(), told, "{half_axes:?} {nodes}: {upper:?}");
        assert!(surfaces.coarse_straight(nodes, [-5.0, 5.0]).is_none());
        assert!(Surfaces::of([(body, droplet)]).coarse_straight(nodes, [-2.0, 2.0]).is_none());
    }
}

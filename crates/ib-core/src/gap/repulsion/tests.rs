use super::*;
use crate::Vec2;

fn circle(markers: &mut Markers, centre: Vec2) {
    let start = markers.len();
    markers.push_group(64, MarkerKind::Interface { viscosity_inside: None });
    for k in 0..64 {
        let angle = std::f64::consts::TAU * k as f64 / 64.0;
        markers.positions[start + k] = centre + Vec2::new(angle.cos(), angle.sin());
    }
}

#[test]
fn pushes_apart_across_a_period_without_a_resultant() {
    let mut markers = Markers::new();
    circle(&mut markers, Vec2::ZERO);
    circle(&mut markers, Vec2::new(-2.1, 0.0));
    let repulsion = Repulsion::new(3.0, 0.2).unwrap();
    let sums =
        |markers: &Markers| [0, 1].map(|k| markers.forces[markers.groups()[k].range.clone()].iter().sum::<Vec2>());
    repulsion.add(&mut markers, [None; 2]);
    let near = sums(&markers);
    assert!(near[0].x > 1e-4 && (near[0] + near[1]).length() < 1e-15);
    markers.forces.fill(Vec2::ZERO);
    for place in &mut markers.positions[64..] {
        place.x += 8.0;
    }
    repulsion.add(&mut markers, [Some(8.0), None]);
    assert!((sums(&markers)[0] - near[0]).length() < 1e-14);
    markers.forces.fill(Vec2::ZERO);
    repulsion.add(&mut markers, [None; 2]);
    assert_eq!(sums(&markers)[0], Vec2::ZERO);
}

/// Two squares of side 2 of which one corner each is within reach of the other: there a piece is as long as half the
/// diagonal.
#[test]
fn a_pair_is_pushed_apart_by_the_law() {
    for distance in [0.02, 0.1, 0.15, 0.19, 0.21] {
        let mut markers = Markers::new();
        for [x, y] in [[-2.0, -2.0], [0.0, distance]] {
            let start = markers.len();
            markers.push_group(4, MarkerKind::Interface { viscosity_inside: None });
            for (place, [u, v]) in markers.positions[start..].iter_mut().zip([[0., 0.], [2., 0.], [2., 2.], [0., 2.]]) {
                *place = Vec2::new(x + u, y + v);
            }
        }
        Repulsion::new(3.0, 0.2).unwrap().add(&mut markers, [None; 2]);
        let expected = 3.0 * 2.0 * (1.0 - distance / 0.2).max(0.0).powi(2);
        let force = markers.forces[2];
        assert!((force + Vec2::new(0.0, expected)).length() < 1e-14, "{distance}: {force} {expected}");
        assert_eq!(markers.forces[4], -force);
        assert_eq!(markers.forces.iter().filter(|force| **force != Vec2::ZERO).count() % 2, 0);
    }
}

#[test]
fn what_is_no_repulsion_is_refused() {
    for bad in [0.0, -1.0, f64::NAN, f64::INFINITY] {
        assert!(Repulsion::new(bad, 0.1).is_err() && Repulsion::new(1.0, bad).is_err());
    }
}

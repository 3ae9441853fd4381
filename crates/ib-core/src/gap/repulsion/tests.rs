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

#[test]
fn what_is_no_repulsion_is_refused() {
    for bad in [0.0, -1.0, f64::NAN, f64::INFINITY] {
        assert!(Repulsion::new(bad, 0.1).is_err() && Repulsion::new(1.0, bad).is_err());
    }
}

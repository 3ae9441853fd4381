use super::*;
use crate::{Curve, InitialConcentration};

#[test]
fn the_profile_starts_at_the_front() {
    let heading = 2.0;
    let centre = Vec2::new(1.0, -2.0);
    let markers = Curve::circle(1.0).unwrap().translated(centre).markers(90).unwrap();
    let numbers = InitialConcentration::polarised(100.0, heading).unwrap().particle_numbers(&markers).unwrap();
    let profile = concentration_profile(&markers, &numbers, &Frame::new(centre, heading).unwrap()).unwrap();
    assert!(profile.arc.windows(2).all(|pair| pair[0] < pair[1]));
    assert!(profile.arc[0] >= 0.0 && profile.arc[89] < profile.perimeter);
    for (arc, c) in profile.arc.iter().zip(&profile.concentration) {
        assert!((c - 100.0 * (1.0 - arc.cos())).abs() < 0.2, "{arc} {c}");
    }
    assert!(concentration_profile(&markers, &numbers[2..], &Frame::new(centre, 0.0).unwrap()).is_err());
}

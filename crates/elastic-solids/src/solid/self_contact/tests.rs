//! Surfaces that fold onto themselves.

use motile_scene::{Body as _, BodyError};

use super::*;
use crate::mesh::{equilateral_block, equilateral_strip};
use crate::solid::tests::fluid_view;
use crate::{NeoHookean, Outline, Solid};

fn end(solid: &Solid) -> Result<(), String> {
    match solid.clone().end_step(&fluid_view(), 0.1) {
        Ok(()) => Ok(()),
        Err(BodyError::Other(error)) => Err(error.to_string()),
        Err(error) => panic!("{error}"),
    }
}

fn solid(mesh: TriangleMesh) -> Solid {
    Solid::hyperelastic(mesh, NeoHookean::new(1.0, 2.0).unwrap())
}

/// A horseshoe whose ends come to overlap: no triangle of it is inverted.
#[test]
fn the_ends_of_a_bent_bar_that_meet_are_named() {
    let bar = solid(equilateral_block(Vec2::ZERO, 80, 6, 0.1).unwrap());
    let bent = |turn: f64| {
        let bent = bar.clone().deformed(|s| (1.5 + s.y) * Vec2::from_angle(-turn * s.x / 8.1)).unwrap();
        assert!(bent.smallest_jacobian().0 > 0.0);
        bent
    };
    assert_eq!(end(&bent(6.0)), Ok(()));
    let said = end(&bent(6.5)).unwrap_err();
    assert!(said.contains("crosses itself near (") && said.contains("surface elasticity"), "{said}");
    // For comparison with work that lets it.
    assert_eq!(end(&bent(6.5).allow_inversion()), Ok(()));
}

/// A fold of the upper surface of a periodic wall, over the seam too.
#[test]
fn a_fold_of_a_periodic_surface_is_named_wherever_it_is() {
    let wall = solid(equilateral_strip(Vec2::ZERO, 40, 10, 0.1).unwrap());
    let top = 0.1 * 10.0 * 0.75_f64.sqrt();
    for x in [0.5, 1.9, 2.0, 3.97] {
        let folded = |reach: f64| {
            let over = |s: Vec2| {
                let away = s.x - x - 4.0 * ((s.x - x) / 4.0).round();
                let depth = (top - s.y) / 0.3;
                // The two sides of a furrow, drawn over each other near the surface.
                let push = -reach * (away / 0.25) * (-(away / 0.25).powi(2)).exp() * (1.0 - depth).max(0.0);
                let sink = -0.6 * (-(away / 0.15).powi(2)).exp() * (1.0 - depth).max(0.0);
                s + Vec2::new(push, sink)
            };
            wall.clone().deformed(over).unwrap()
        };
        assert!(SelfContact::of(wall.mesh()).check(folded(0.0).positions()).is_ok());
        let error = SelfContact::of(wall.mesh()).check(folded(0.9).positions()).unwrap_err();
        let SolidError::SelfContact { place, .. } = error else { panic!("{error}") };
        let away = place.x - x - 4.0 * ((place.x - x) / 4.0).round();
        assert!(away.abs() < 0.4 && place.y > 0.0, "{x}: {place}");
    }
}

/// Round-off of a reference state whose outline touches itself at a point is no contact.
#[test]
fn outlines_that_touch_themselves_at_rest_are_left_out() {
    let [a, b] = [0.0, 1.0].map(|x| [Vec2::new(x, 0.0), Vec2::new(x + 1.0, 0.0), Vec2::new(x + 0.5, 1.0)]);
    let points = vec![a[0], a[1], a[2], b[1], b[2]];
    let mesh = TriangleMesh::new(points, vec![[0, 1, 2], [1, 3, 4]]).unwrap();
    assert_eq!(end(&solid(mesh)), Ok(()));
    let disc = Outline::circle(Vec2::ZERO, 1.0).unwrap().mesh(0.2).unwrap();
    assert_eq!(SelfContact::of(&disc).curves.len(), 1);
}

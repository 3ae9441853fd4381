use std::f64::consts::TAU;
use std::sync::LazyLock;

use proptest::prelude::*;

use super::*;
use crate::channel::Ratchet;
use crate::mesh::equilateral_strip;
use crate::{Mesher, NeoHookean, Outline, Solid};

/// A disc of radius 1.
static DISC: LazyLock<SurfaceGap> = LazyLock::new(|| {
    let mesh = Outline::circle(Vec2::zeros(), 1.0).unwrap().mesh(0.1).unwrap();
    let mut gap = SurfaceGap::new(None);
    gap.add(&Solid::hyperelastic(mesh, NeoHookean::new(1.0, 2.0).unwrap())).unwrap();
    gap.sort();
    gap
});

/// The walls of a ratchet.
static RATCHET: LazyLock<SurfaceGap> = LazyLock::new(|| {
    let shape = Ratchet { period: 12.0, width: 3.0, throat: 1.5, teeth: 3, rise: 0.7, sharp: false };
    let walls = shape.channel().unwrap().walls(-2.5, 2.5, &Mesher::new(0.1).unwrap()).unwrap();
    let mut gap = SurfaceGap::new(Some(12.0));
    for mesh in [walls.lower, walls.upper] {
        gap.add(&Solid::springs(mesh, 1.0).unwrap()).unwrap();
    }
    gap.sort();
    gap
});

proptest! {
    #[test]
    fn a_disc(x in -3.0..3.0f64, y in -3.0..3.0f64) {
        let exact = x.hypot(y) - 1.0;
        // The polygon lies inside the circle by up to its sagitta.
        let found = DISC.at(Vec2::new(x, y));
        prop_assert!(found >= exact - 1e-9 && found < exact + 2e-3, "{found} {exact}");
    }

    #[test]
    fn sorting_finds_the_nearest_of_all(x in -40.0..40.0f64, y in -1.5..1.5f64) {
        let point = Vec2::new(x, y);
        let mut all = Nearest { squared: f64::INFINITY, ..Nearest::default() };
        (0..RATCHET.sides.len()).for_each(|k| all.consider(&RATCHET.sides[k], RATCHET.image(point, k as u32)));
        prop_assert!((RATCHET.at(point).abs() - all.squared.sqrt()).abs() < 1e-12);
    }
}

#[test]
fn a_wall_over_its_seam() {
    let wall = Solid::springs(equilateral_strip(Vec2::zeros(), 20, 10, 0.1).unwrap(), 1.0).unwrap();
    let top = 0.75_f64.sqrt();
    let mut gap = SurfaceGap::new(Some(2.0));
    assert_eq!(gap.at(Vec2::zeros()), f64::INFINITY);
    gap.add(&wall).unwrap();
    gap.sort();
    for k in 0..200 {
        let x = -7.0 + 0.07 * f64::from(k);
        for height in [0.3, 0.01, -0.01, -0.3] {
            assert!((gap.at(Vec2::new(x, top + height)) - height).abs() < 1e-12, "{x} {height}");
            assert!((gap.at(Vec2::new(x, -height)) - height).abs() < 1e-12, "{x} {height}");
        }
    }
    // The smallest of a circle of markers above it.
    let circle: Vec<Vec2> =
        (0..360).map(|k| TAU * f64::from(k) / 360.0).map(|t| Vec2::new(5.0 + t.cos(), top + 1.2 + t.sin())).collect();
    let (least, marker) = gap.smallest(&circle).unwrap();
    assert!((least - 0.2).abs() < 1e-12 && marker == 270);
    assert!(gap.smallest(&[]).is_err() && gap.smallest(&[Vec2::new(f64::NAN, 0.0)]).is_err());
}

#[test]
fn it_follows_the_solid() {
    let wall = Solid::springs(equilateral_strip(Vec2::zeros(), 20, 10, 0.1).unwrap(), 1.0).unwrap();
    let moved = wall.deformed(|s| Vec2::new(s.x + 3.3, 2.0 * s.y)).unwrap();
    let mut gap = SurfaceGap::new(Some(2.0));
    for _ in 0..2 {
        gap.clear();
        gap.add(&moved).unwrap();
        gap.sort();
        let above = Vec2::new(0.4, 2.0 * 0.75_f64.sqrt() + 0.05);
        assert!((gap.at(above) - 0.05).abs() < 1e-12);
    }
}

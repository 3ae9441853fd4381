use super::*;
use proptest::prelude::*;

const PLANE: [Option<f64>; 2] = [None; 2];

fn square() -> Boundary {
    let corners = [(0.0, 0.0), (2.0, 0.0), (2.0, 2.0), (0.0, 2.0)].map(|(x, y)| Vec2::new(x, y));
    let mut boundary = Boundary::default();
    boundary.push_loop(&corners);
    boundary.sort();
    boundary
}

#[test]
fn distances_have_the_right_sign_at_sides_and_corners() {
    let square = square();
    for (x, y, expected) in [
        (1.0, -0.3, 0.3),
        (1.0, 0.3, -0.3),
        (2.3, 2.4, 0.5),
        (1.9, 1.8, -0.1),
        (-0.3, -0.4, 0.5),
        (0.1, 0.2, -0.1),
        (-30.0, -40.0, 50.0),
    ] {
        let found = square.distance(Vec2::new(x, y), PLANE);
        assert!((found - expected).abs() < 1e-12, "{x} {y}: {found} {expected}");
        let near = square.distance_within(Vec2::new(x, y), PLANE, 1.0);
        assert_eq!(near, (expected < 1.0).then_some(found));
    }
    assert!(square.distance(Vec2::new(f64::NAN, 0.0), PLANE).is_nan());
    let mut empty = Boundary::default();
    assert_eq!(empty.distance(Vec2::ZERO, PLANE), f64::INFINITY);
    empty.sort();
    assert_eq!(empty.distance(Vec2::ZERO, PLANE), f64::INFINITY);
    assert_eq!(empty.smallest(&[Vec2::ZERO], PLANE), None);
    assert_eq!(square.smallest(&[], PLANE), None);
}

#[test]
fn images_count() {
    let square = square();
    let periods = [Some(5.0), None];
    let found = square.distance(Vec2::new(-3.2, 1.0), periods);
    assert!((found + 0.2).abs() < 1e-12);
}

/// The wall below a zigzag surface along x of period 4, its sides on both sides of the seam.
fn wall() -> Boundary {
    let mut wall = Boundary::default();
    for k in 0..40 {
        let at = |k: i32| Vec2::new(5.0 - 0.1 * f64::from(k), if k % 2 == 0 { 1.0 } else { 1.2 });
        wall.push(at(k), at(k + 1));
    }
    wall.sort();
    wall
}

#[test]
fn a_surface_over_the_seam_of_a_period() {
    let wall = wall();
    for k in 0..200 {
        // Over a crest, and in a trough, whose sides rise by 0.2 over 0.1.
        let crest = -7.0 + 0.2 * f64::from(k) - 0.1;
        let periods = [Some(4.0), None];
        assert!((wall.distance(Vec2::new(crest, 1.5), periods) - 0.3).abs() < 1e-12);
        let trough = wall.distance(Vec2::new(crest + 0.1, 1.1), periods);
        assert!((trough - 0.1 * 0.2_f64.sqrt()).abs() < 1e-12, "{trough}");
        assert!(wall.distance(Vec2::new(crest, 0.5), periods) < -0.5);
    }
}

/// One side as long as the box, aslant, the point to its left: the nearest image of its middle is not that of the side.
#[test]
fn images_of_long_sides_count() {
    let mut side = Boundary::default();
    side.push(Vec2::new(0.0, 0.0), Vec2::new(3.8, 3.0));
    side.sort();
    let found = side.distance(Vec2::new(3.5, 0.0), [Some(4.0), None]);
    assert!((found + 0.5).abs() < 1e-12, "{found}");
}

proptest! {
    /// Interfaces beside, across and inside a square, of few and of many points.
    #[test]
    fn the_smallest_distance_is_that_of_all_points(
        x in -1.0..3.0f64,
        y in -1.0..3.0f64,
        radius in 0.01..2.0f64,
        squeeze in 0.1..1.0f64,
        count in 1usize..80,
        period in 5.0..8.0f64,
    ) {
        let square = square();
        let angle = |k: usize| std::f64::consts::TAU * k as f64 / count as f64;
        let points: Vec<Vec2> = (0..count)
            .map(|k| Vec2::new(x + radius * angle(k).cos(), y + squeeze * radius * angle(k).sin()))
            .collect();
        for periods in [PLANE, [Some(period), None]] {
            let all: Vec<f64> = points.iter().map(|point| square.distance(*point, periods)).collect();
            let least = all.iter().copied().fold(f64::INFINITY, f64::min);
            // Of points at one distance but for rounding any may be found.
            let (distance, found) = square.smallest(&points, periods).unwrap();
            prop_assert!((distance - least).abs() < 1e-14 && (all[found] - least).abs() < 1e-14);
        }
    }

    #[test]
    fn boxes_find_the_nearest_of_all(
        x in -9.0..9.0f64, y in -9.0..9.0f64, count in 3..200_usize, period in 3.0..5.0f64,
    ) {
        let corner = |k: usize| {
            let angle = std::f64::consts::TAU * k as f64 / count as f64;
            (1.0 + 0.3 * (5.0 * angle).sin()) * Vec2::new(angle.cos(), angle.sin())
        };
        let corners: Vec<Vec2> = (0..count).map(corner).collect();
        let mut star = Boundary::default();
        star.push_loop(&corners);
        star.sort();
        for periods in [PLANE, [Some(period), None], [Some(period), Some(4.0)]] {
            let point = Vec2::new(x, y);
            let mut all = Nearest { squared: f64::INFINITY, height: 0.0, side: 0, part: 0.0, away: Vec2::ZERO };
            let images = |k: usize| if periods[k].is_some() { -4..=4 } else { 0..=0 };
            for (i, j) in images(0).flat_map(|i| images(1).map(move |j| (i, j))) {
                let image = point + Vec2::new(f64::from(i) * periods[0].unwrap_or(0.0), f64::from(j) * 4.0);
                star.sides.iter().enumerate().for_each(|(k, side)| all.look(k, side, image, PLANE.into()));
            }
            let found = star.distance(point, periods);
            let nearest = star.nearest_within(point, periods, 100.0).unwrap();
            prop_assert!((nearest.away.length() - found.abs()).abs() < 1e-12);
            prop_assert!((found - all.squared.sqrt().copysign(all.height)).abs() < 1e-12, "{found} {all:?}");
        }
    }
}

/// Neighbours of a box whose rows are displaced by the tilt: each pair of opposite ones once.
#[test]
fn images_of_a_tilted_box_are_its_eight_neighbours() {
    let periods = Periods { lengths: [Some(3.0), Some(2.0)], tilt: 0.5 };
    let found: Vec<Vec2> = shifts(periods, true).into_iter().flatten().collect();
    let of = |rows: f64, columns: f64| Vec2::new(3.0 * columns + 0.5 * rows, 2.0 * rows);
    assert_eq!(found, [of(0.0, 1.0), of(1.0, 0.0), of(1.0, 1.0), of(-1.0, 1.0)]);
    let along = Periods { lengths: [Some(3.0), None], tilt: 0.0 };
    assert_eq!(shifts(along, true), [Some(of(0.0, 1.0)), None, None, None]);
    assert_eq!(shifts(periods, false), [Some(Vec2::ZERO), None, None, None]);
}

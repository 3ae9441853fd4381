//! Uniformity, exact areas, what is refused, and work.

use crate::error::{numbers, refused as is_refused};
use motile_base::{InputError, Vec2};
use proptest::prelude::*;

use super::*;
use crate::Outline;

fn v(x: f64, y: f64) -> Vec2 {
    Vec2::new(x, y)
}

#[test]
fn polygons_are_filled_exactly() {
    let l_shape = [v(0.0, 0.0), v(3.0, 0.0), v(3.0, 1.0), v(1.0, 1.0), v(1.0, 2.5), v(0.0, 2.5)];
    for angle in [0.0, 0.4] {
        let outline = Outline::polygon(&l_shape).unwrap().rotated(angle, v(1.0, 2.0)).unwrap();
        let mesh = outline.mesh(0.1).unwrap();
        assert!((mesh.area() - 4.5).abs() < 1e-12);
        let quality = mesh.quality();
        assert!(quality.edge_deviation < 0.1 && quality.smallest_angle > 30.0, "{quality}");
        assert!((quality.mean_edge - 0.1).abs() < 0.004);
    }
}

#[test]
fn a_disc_and_a_ring_converge_to_their_area() {
    let circle = |radius: f64| Outline::circle(v(0.3, 0.1), radius).unwrap();
    // A polygon of chords h lacks pi h^2/6 of the area of its circle, whatever the radius.
    let lacking = |spacing: f64| std::f64::consts::PI * spacing * spacing / 6.0;
    let errors = [0.1, 0.05].map(|spacing| {
        let disc = circle(1.0).mesh(spacing).unwrap();
        let error = std::f64::consts::PI - disc.area();
        assert!((error / lacking(spacing) - 1.0).abs() < 0.008, "{error}");
        let ring = Interior::new([circle(1.0), circle(0.4)]).unwrap().mesh(spacing).unwrap();
        assert_eq!(ring.boundary_loops().len(), 2);
        assert!((ring.area() - std::f64::consts::PI * (1.0 - 0.16)).abs() < 0.1 * lacking(spacing));
        error
    });
    let order = (errors[0] / errors[1]).log2();
    assert!((order - 2.0).abs() < 0.006, "{errors:?}, order {order}");
    let disc = circle(1.0).mesh(0.05).unwrap();
    let quality = disc.quality();
    assert!(quality.edge_deviation < 0.04 && quality.smallest_angle > 35.0, "{quality}");
}

#[test]
fn a_straight_wall_is_a_lattice_unless_its_seeds_are_turned() {
    let flat = |y| Outline::flat(-3.0, 6.0, y).unwrap();
    for height in [1.0, 1.07, 1.1] {
        let region = Interior::new([flat(0.0), flat(height)]).unwrap();
        let quality = region.mesh(0.1).unwrap().quality();
        assert!(quality.edge_deviation < 0.02 && quality.smallest_angle > 57.0, "{quality}");
        let turned = Mesher::new(0.1).unwrap().turned(0.2).unwrap().mesh(&region).unwrap();
        assert!((turned.area() - 6.0 * height).abs() < 1e-12);
        let quality = turned.quality();
        assert!(quality.edge_deviation > 0.03 && quality.smallest_angle > 28.0, "{quality}");
    }
}

#[test]
fn several_parts_and_islands_in_holes() {
    let circle = |x: f64, radius: f64| Outline::circle(v(x, 0.0), radius).unwrap();
    let region = Interior::new([circle(0.0, 1.0), circle(0.0, 0.6), circle(0.0, 0.3), circle(3.0, 0.5)]).unwrap();
    let mesh = region.mesh(0.05).unwrap();
    assert_eq!(mesh.boundary_loops().len(), 4);
    let expected = std::f64::consts::PI * (1.0 - 0.36 + 0.09 + 0.25);
    assert!((mesh.area() - expected).abs() < 0.01);
}

#[test]
fn a_hole_in_a_periodic_wall_may_lie_anywhere() {
    let flat = |y| Outline::flat(-1.5, 3.0, y).unwrap();
    for x in [0.2, -1.5, 1.45, 31.4, -100.0] {
        let hole = |radius: f64| Outline::circle(v(x, 0.55), radius).unwrap();
        let mesh = Interior::new([flat(0.0), flat(1.1), hole(0.3)]).unwrap().mesh(0.06).unwrap();
        let mut advances: Vec<i32> = mesh.boundary_loops().iter().map(|l| l.periods).collect();
        advances.sort_unstable();
        assert_eq!(advances, [-1, 0, 1]);
        let expected = 3.3 - std::f64::consts::PI * 0.09;
        assert!((mesh.area() - expected).abs() < 5e-3, "at {x}: {}", mesh.area());
        assert!(mesh.quality().smallest_angle > 28.0);
        let refused =
            |radius: f64| Interior::new([flat(0.0), flat(1.1), hole(radius)]).unwrap().mesh(0.06).unwrap_err();
        assert!(is_refused(&refused(0.02), "is too small for the mesh"));
        assert!(is_refused(&refused(0.51), "is too thin for the mesh"));
    }
}

#[test]
fn outlines_that_make_no_mesh_are_refused() {
    const CROSSING: &str = "outlines cross or touch near (";
    let circle = |x: f64, radius: f64| Outline::circle(v(x, 0.0), radius).unwrap();
    let refused =
        |outlines: Vec<Outline>, spacing: f64| Interior::new(outlines).and_then(|r| r.mesh(spacing)).unwrap_err();
    let bow_tie = Outline::polygon(&[v(0.0, 0.0), v(1.0, 1.0), v(1.0, 0.0), v(0.0, 1.0)]).unwrap();
    let bow_tie = refused(vec![bow_tie], 0.1);
    assert!(is_refused(&bow_tie, CROSSING), "{bow_tie}");
    let [x, y] = numbers(&bow_tie)[..] else { panic!("{bow_tie}") };
    assert!((v(x, y) - v(0.5, 0.5)).length() < 1e-12);
    let spike = Outline::polygon(&[v(0.0, 0.0), v(1.0, 0.0), v(1.0, 1.0), v(1.0, 0.5), v(0.0, 0.5)]).unwrap();
    assert!(is_refused(&refused(vec![spike], 0.1), CROSSING));
    let twice = refused(vec![circle(0.0, 1.0), circle(0.5, 1.0)], 0.1);
    assert!(is_refused(&twice, CROSSING));
    let same = refused(vec![circle(0.0, 1.0), circle(0.0, 1.0)], 0.1);
    assert!(is_refused(&same, CROSSING));
    let hole = refused(vec![circle(0.0, 1.0), circle(0.0, 0.04)], 0.1);
    assert!(is_refused(&hole, "is too small for the mesh: it is 0.0"), "{hole}");
    assert!((numbers(&hole)[2] - 0.08).abs() < 9e-4, "{hole}");
    let ring = refused(vec![circle(0.0, 1.0), circle(0.0, 0.93)], 0.1);
    assert!(is_refused(&ring, "is too thin for the mesh: it is 0.0"), "{ring}");
    assert!((numbers(&ring)[2] - 0.07).abs() < 1e-12, "{ring}");
    let thin = "is too thin for the mesh";
    assert!(is_refused(&refused(vec![circle(0.0, 0.04)], 0.1), thin));
    // A dumbbell whose bar is thinner than the spacing, by one outline alone.
    let bar = |t: f64| {
        let c = (std::f64::consts::TAU * t).cos();
        v(2.0 * c, (0.03 + 0.5 * c * c) * (std::f64::consts::TAU * t).sin())
    };
    let dumbbell = Outline::closed(bar).unwrap();
    assert!(is_refused(&refused(vec![dumbbell.clone()], 0.1), thin));
    assert!(dumbbell.mesh(0.04).is_ok());
    let flat = |y: f64| Outline::flat(0.0, 1.0, y).unwrap();
    assert!(is_refused(&refused(vec![flat(0.0)], 0.1), "the number of periodic outlines is odd: 1"));
    assert!(is_refused(&refused(vec![flat(0.0), flat(0.05)], 0.1), thin));
    assert!(matches!(refused(vec![flat(0.0), flat(1.0)], 0.3), SolidError::Input(InputError::OutOfRange { .. })));
    let other = Outline::flat(0.0, 2.0, 1.0).unwrap();
    assert!(is_refused(&refused(vec![flat(0.0), other], 0.1), "outlines have different periods: 1 and 2"));
    assert!(matches!(refused(vec![], 0.1), SolidError::Input(InputError::TooFew { .. })));
    assert!(matches!(refused(vec![circle(0.0, 1.0)], f64::NAN), SolidError::Input(InputError::NotPositive { .. })));
    assert!(matches!(refused(vec![circle(0.0, 1.0)], 1e-7), SolidError::Input(InputError::OutOfRange { .. })));
}

/// The work, which is what the time follows: meshes of many points are made once, the even ones of small meshes chosen
/// among at most a dozen.
#[test]
fn work_is_a_given_number_of_moves_of_each_point() {
    let flat = Outline::flat(-6.0, 12.0, -2.5).unwrap();
    let profile = Outline::profile(-6.0, 12.0, |x| -1.0 + 0.4 * (std::f64::consts::PI * x / 3.0).cos()).unwrap();
    let region = Interior::new([flat, profile]).unwrap();
    let (mesh, moves) = Mesher::new(0.046).unwrap().mesh_counting(&region).unwrap();
    assert!(mesh.points().len() > 10_000, "{}", mesh.points().len());
    assert_eq!(moves, SWEEPS * mesh.points().len());
    let disc = Interior::new([Outline::circle(v(0.0, 0.0), 1.0).unwrap()]).unwrap();
    let (mesh, moves) = Mesher::new(0.1).unwrap().mesh_counting(&disc).unwrap();
    let tries = moves as f64 / (SWEEPS * mesh.points().len()) as f64;
    assert!((tries - 12.0).abs() < 0.2, "{tries}");
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(40))]

    /// Smooth closed outlines of random shape and place: the boundary points slide along the outline, the mesh
    /// fills their polygon, and is even.
    #[test]
    fn random_outlines(
        modes in prop::collection::vec((-0.06..0.06_f64, -0.06..0.06_f64), 4),
        x in -50.0..50.0_f64, y in -50.0..50.0_f64, size in 0.5..20.0_f64,
    ) {
        let radius = move |angle: f64| {
            let wave = |(k, (a, b)): (usize, &(f64, f64))| {
                let phase = (k + 2) as f64 * angle;
                a * phase.cos() + b * phase.sin()
            };
            size * (1.0 + modes.iter().enumerate().map(wave).sum::<f64>())
        };
        let around = radius.clone();
        let shape = move |t: f64| {
            let angle = std::f64::consts::TAU * t;
            v(x + around(angle) * angle.cos(), y + around(angle) * angle.sin())
        };
        let outline = Outline::closed(shape).unwrap();
        let spacing = size / 8.0;
        let mesh = outline.mesh(spacing).unwrap();
        let polygon = mesh.raw_polygon(&mesh.boundary_loops()[0], mesh.points());
        for point in &polygon {
            let arm = point - v(x, y);
            prop_assert!((arm.length() - radius(arm.y.atan2(arm.x))).abs() < 1e-12 * (1.0 + x.abs() + y.abs()) * size);
        }
        let area: f64 = (0..polygon.len()).map(|k| 0.5 * polygon[k].perp_dot(polygon[(k + 1) % polygon.len()])).sum();
        prop_assert!((mesh.area() - area).abs() < 1e-10 * (1.0 + x.abs() + y.abs()) * size * size);
        let quality = mesh.quality();
        prop_assert!(quality.smallest_angle > 30.0 && quality.edge_deviation < 0.08, "{quality}");
    }
}

/// A mesh has no unit of its own.
#[test]
fn meshes_of_any_size_are_alike() {
    let of = |unit: f64| Outline::rectangle(Vec2::ZERO, unit * Vec2::new(1.0, 0.1)).unwrap().mesh(0.1 * unit).unwrap();
    let count = of(1.0).triangles().len();
    for unit in [1e-5, 1e5] {
        let mesh = of(unit);
        assert_eq!(mesh.triangles().len(), count, "{unit}");
        assert!((mesh.area() / (0.1 * unit * unit) - 1.0).abs() < 1e-9, "{unit}");
    }
}

/// Edges that cross are no boundary, though a triangulation could leave one of them out.
#[test]
fn edges_that_cross_are_refused() {
    let corners = || [(0.0, 0.0), (1.0, 0.0), (1.0, 1.0), (0.0, 1.0)].map(|(x, y)| spade::Point2::new(x, y)).to_vec();
    let sides = [[0, 1], [1, 2], [2, 3], [3, 0]];
    assert!(triangulation::build(corners(), sides.to_vec()).is_ok());
    let error = triangulation::build(corners(), vec![[0, 2], [1, 3]]).unwrap_err();
    assert!(is_refused(&error, "the triangulation failed: boundary edges cross"), "{error}");
}

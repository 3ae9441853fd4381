use super::*;

fn square() -> Boundary {
    let corners = [(0.0, 0.0), (2.0, 0.0), (2.0, 2.0), (0.0, 2.0)].map(|(x, y)| Vec2::new(x, y));
    let mut boundary = Boundary::default();
    boundary.push_loop(&corners);
    boundary.finish();
    boundary
}

#[test]
fn distances_have_the_right_sign_at_sides_and_corners() {
    let square = square();
    let at = |x: f64, y: f64| square.distance(Vec2::new(x, y), [None; 2], 1.0);
    for (x, y, expected) in
        [(1.0, -0.3, 0.3), (1.0, 0.3, -0.3), (2.3, 2.4, 0.5), (1.9, 1.8, -0.1), (-0.3, -0.4, 0.5), (0.1, 0.2, -0.1)]
    {
        let found = at(x, y).unwrap();
        assert!((found - expected).abs() < 1e-12, "{x} {y}: {found} {expected}");
    }
    assert_eq!(at(1.0, -1.5), None);
}

#[test]
fn images_count() {
    let square = square();
    let periods = [Some(5.0), None];
    let found = square.distance(Vec2::new(-3.2, 1.0), periods, 1.0).unwrap();
    assert!((found + 0.2).abs() < 1e-12);
    let other = square.clone();
    assert!(other.is_near(&square, Vec2::new(2.5, 0.0), periods, 0.6));
    assert!(!other.is_near(&square, Vec2::new(2.5, 0.0), periods, 0.4));
    assert!(!other.is_near(&square, Vec2::new(0.0, 2.5), periods, 0.4));
}

use super::*;

#[test]
fn areas_and_centroids_of_triangles_and_squares() {
    let square = [(1.0, 1.0), (3.0, 1.0), (3.0, 3.0), (1.0, 3.0)].map(Vec2::from);
    assert_eq!(area_and_arm(&square), (4.0, Vec2::ONE));
    let triangle = [(0.0, 3.0), (6.0, 0.0), (0.0, 0.0)].map(Vec2::from);
    let (area, arm) = area_and_arm(&triangle);
    assert_eq!(area, -9.0);
    assert!(arm.distance(Vec2::new(2.0, -2.0)) < 1e-15, "{arm}");
    assert!(area_and_arm(&[]).1.x.is_nan());
}

#[test]
fn a_point_is_within_whatever_the_order() {
    let bent = [(0.0, 0.0), (4.0, 0.0), (4.0, 4.0), (2.0, 1.0), (0.0, 4.0)].map(Vec2::from);
    let mut reversed = bent;
    reversed.reverse();
    for polygon in [bent, reversed] {
        assert!(contains(&polygon, Vec2::new(0.5, 2.0)) && contains(&polygon, Vec2::new(2.0, 0.5)));
        assert!(!contains(&polygon, Vec2::new(2.0, 2.0)) && !contains(&polygon, Vec2::new(-0.1, 1.0)));
    }
    assert!(!contains(&[], Vec2::ZERO));
}

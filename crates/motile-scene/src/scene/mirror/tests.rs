use super::*;

/// Each marker has an image of its own: of two that are in one place the second has none where there is but one image.
#[test]
fn every_marker_has_an_image_of_its_own() {
    let places = |list: &[[f64; 2]]| list.iter().copied().map(Vec2::from).collect::<Vec<_>>();
    let one = places(&[[0.0, 1.0], [1.0, 2.0], [2.0, 0.5]]);
    assert_eq!(images(&one, &places(&[[2.0, -0.5], [0.0, -1.0], [1.0, -2.0]])), Ok(vec![1, 2, 0]));
    let twice = places(&[[0.0, 1.0], [0.0, 1.0], [2.0, 0.5]]);
    assert!(images(&twice, &places(&[[0.0, -1.0], [1.0, -1.0], [2.0, -0.5]])).is_err());
    let (distance, place) = images(&one, &places(&[[2.0, -0.5], [0.0, -1.0], [1.0, -2.25]])).unwrap_err();
    assert_eq!((distance, place), (0.25, Vec2::new(1.0, 2.0)));
    assert!(images(&one, &one[..2]).is_err());
}

use super::*;

#[test]
fn dashes_cover_their_share_of_a_bent_path() {
    let path = [[0.0, 0.0], [10.0, 0.0], [10.0, 24.0]];
    let pieces = dashes(&path, [3.0, 2.0]);
    let length: f64 =
        pieces.iter().flat_map(|p| p.windows(2)).map(|w| (w[1][0] - w[0][0]).hypot(w[1][1] - w[0][1])).sum();
    assert!((length - 21.0).abs() < 1e-9, "{length}");
    assert_eq!(pieces.len(), 7);
}

use super::*;

#[test]
fn every_marker_comes_once() {
    for count in [0, 1, 7, 8, 9, 63, 64, 65, 130, 1000] {
        let mut order: Vec<usize> = spreading_order(count, STRIDE).collect();
        order.sort_unstable();
        assert!(order.into_iter().eq(0..count), "{count}");
    }
    assert!(spreading_order(65, STRIDE).take(10).eq([0, 8, 16, 24, 32, 40, 48, 56, 1, 9]));
    assert!(spreading_order(130, 1).eq(0..130));
}

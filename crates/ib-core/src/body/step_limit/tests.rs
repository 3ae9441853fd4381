use super::*;

#[test]
fn the_eight_shortest_are_kept() {
    let mut limits = StepLimits::none();
    assert!(limits.is_empty());
    for k in 0..12 {
        limits.push(StepLimit::decay(f64::from((5 * k) % 12), "a rate"));
    }
    let mut kept: Vec<f64> = limits.into_iter().map(|limit| limit.dt).collect();
    kept.sort_by(f64::total_cmp);
    assert_eq!(kept, [0.0, 1.0, 2.0, 3.0, 4.0, 5.0, 6.0, 7.0]);
}

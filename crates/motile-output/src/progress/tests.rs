use super::*;

#[test]
fn the_time_left_follows_from_the_pace() {
    let text = state(15.0, 60.0, 3000, 0.1386, 20.0);
    assert_eq!(text, "t = 15.00 of 60  speed 0.1386  150 steps/s  1:00 left");
    assert!(state(0.0, 60.0, 0, f64::NAN, 0.0).ends_with("? left"));
    assert_eq!(clock(3723.4), "1:02:03");
}

#[test]
fn hidden_progress_says_nothing() {
    let mut progress = Progress::new(1.0, true);
    progress.update(0.5, 10, 0.1);
    assert!(progress.shown.is_none());
    progress.finish();
}

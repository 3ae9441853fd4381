use super::*;

#[test]
fn the_time_left_follows_from_the_pace() {
    assert_eq!(left(20.0, 0.25), "1:00");
    assert_eq!(left(3723.4, 0.5), "1:02:03");
    assert_eq!((left(3.0, 0.0).as_str(), left(3.0, f64::NAN).as_str()), ("?", "?"));
}

#[test]
fn hidden_progress_asks_for_no_state() {
    let mut progress = Progress::new(true);
    progress.due = progress.started;
    progress.update(0.5, || unreachable!("nobody sees it"));
    assert!(progress.finish() >= 0.0);
}

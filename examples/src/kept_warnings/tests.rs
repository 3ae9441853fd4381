use super::*;

fn kept(time: f64, excess: f64, cause: &str) -> Kept {
    Kept { time, excess, body: "cell".into(), cause: cause.into(), message: "0.1 + 0.2, above 0.3: less".into() }
}

#[test]
fn warnings_from_before_a_checkpoint_are_told_after_it() {
    let checkpoint = std::env::temp_dir().join(format!("motile-kept-{}", std::process::id()));
    let before = [kept(0.1 + 0.2, 1.0 / 3.0, "films"), kept(2.0, 1e-300, "edges")];
    std::fs::write(beside(&checkpoint), before.iter().map(Kept::line).collect::<String>()).unwrap();
    let progress = RunProgress::new(1.0, true);
    let resumed = KeptWarnings::new(progress, Some(&checkpoint), Some((&checkpoint, 10)));
    assert_eq!(resumed.worst(), before);
    assert_eq!(resumed.texts()[0], "t = 0.300: cell: films: 0.1 + 0.2, above 0.3: less");
    resumed.keep().unwrap();
    assert_eq!(std::fs::read_to_string(beside(&checkpoint)).unwrap().lines().count(), 2);
    // A run from the start forgets them.
    let fresh = KeptWarnings::new(RunProgress::new(1.0, true), None, Some((&checkpoint, 10)));
    fresh.keep().unwrap();
    assert_eq!(std::fs::read_to_string(beside(&checkpoint)).unwrap(), "");
    std::fs::remove_file(beside(&checkpoint)).unwrap();
}

use super::*;

fn end(x: impl Fn(f64) -> f64) -> (Verdict, f64) {
    let mut passage = Passage::new(3.0);
    for k in 0..2000 {
        let time = 0.1 * f64::from(k);
        passage.follow(time, x(time));
        if passage.verdict() != Verdict::Undecided {
            break;
        }
    }
    (passage.verdict(), passage.time())
}

#[test]
fn verdicts() {
    assert_eq!(end(|t| -6.0 + 0.1 * t).0, Verdict::Passed);
    let (verdict, time) = end(|t| -6.0 + 0.1 * t.min(60.0 - t));
    assert!(verdict == Verdict::TurnedBack && (time - 40.0).abs() < 0.2, "{verdict:?} {time}");
    let (verdict, time) = end(|t| -3.0 - 3.0 * (-0.2 * t).exp());
    assert!(verdict == Verdict::Stuck && (time - 65.0).abs() < 0.5, "{verdict:?} {time}");
    assert_eq!(end(|t| -6.0 + 0.01 * t).0, Verdict::Undecided);
}

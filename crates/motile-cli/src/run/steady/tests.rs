use super::*;

fn run(end: f64, speed: impl Fn(f64) -> f64) -> Steadiness {
    let points: Vec<_> = (0..=600).map(|k| f64::from(k) / 600.0 * end).map(|t| (t, speed(t))).collect();
    // Of a droplet of another radius speeds are as much larger, at a diffusion constant larger by the square.
    let scaled: Vec<_> = points.iter().map(|(t, speed)| (*t, 1e-4 * speed)).collect();
    let (seen, small) = (Steadiness::of(&points, 0.1, 1.0), Steadiness::of(&scaled, 1e-9, 1e-4));
    assert_eq!((seen.since, seen.at_rest), (small.since, small.at_rest));
    seen
}

#[test]
fn an_exponential_approach_is_steady_when_it_comes_close() {
    // 0.1 (1 - exp(-t/2)) is within 0.1 % for t > 2 ln(1000) = 13.8.
    let steady = run(60.0, |t| 0.1 * (1.0 - (-0.5 * t).exp()));
    let since = steady.since.unwrap();
    assert!((since - 13.8).abs() < 0.2, "{since}");
    assert!((steady.final_speed - 0.1).abs() < 1e-6 && steady.deviation < 1e-6);
}

#[test]
fn what_has_not_settled_or_not_lasted_is_not_steady() {
    assert_eq!(run(60.0, |t| 0.1 + 0.01 * t.sin()).since, None);
    assert_eq!(run(15.0, |t| 0.1 * (1.0 - (-0.5 * t).exp())).since, None);
    assert_eq!(run(1.0, |_| 0.1).since, None);
    assert_eq!(Steadiness::of(&[], 0.1, 1.0).since, None);
    assert_eq!(run(60.0, |_| f64::NAN).since, None);
}

#[test]
fn rest_is_steady() {
    let resting = run(200.0, |t| 1e-2 * (-0.2 * t).exp());
    let since = resting.since.unwrap();
    assert!((since - 46.0).abs() < 2.0 && resting.at_rest && resting.criterion().contains("at rest"), "{resting:?}");
    // What swims at a constant speed is not at rest, and what passes through the threshold is neither.
    assert!(!run(60.0, |_| 0.1).at_rest);
    let slowing = run(60.0, |t| 1.05e-6 * (1.0 + 3.0 * (-0.05 * t).exp()));
    assert!(slowing.since.is_none() && !slowing.at_rest, "{slowing:?}");
}

/// A droplet that is slow because it has only begun to move is not at rest, but one whose speed is round-off is.
#[test]
fn what_starts_to_move_is_not_at_rest() {
    let starting = run(200.0, |t| 1e-9 * (0.03 * t).exp());
    assert!(starting.final_speed < 1e-6 && !starting.at_rest && starting.since.is_none(), "{starting:?}");
    assert!(run(200.0, |t| 1e-16 * (1.0 + (7.0 * t).sin())).at_rest);
}

use super::*;

fn alternating(count: i32, height: impl Fn(f64) -> f64) -> Swings {
    let turn = |k: i32| {
        let time = 2.0 + f64::from(k) * 5.0;
        let sign = if k % 2 == 0 { 1.0 } else { -1.0 };
        Extremum { time, height: sign * height(time), is_maximum: k % 2 == 0 }
    };
    Swings::new((0..count).map(turn).collect())
}

#[test]
fn exponential_growth() {
    for rate in [-0.3, -0.01, 0.02, 0.2] {
        let tail = alternating(8, |t| (rate * t).exp()).tail().unwrap();
        assert_eq!(tail.start, 0);
        assert!((tail.growth_rate.value - rate).abs() < 1e-12 && tail.growth_rate.error < 1e-12, "{tail:?}");
        assert!((tail.period.value - 10.0).abs() < 1e-12 && tail.period.error < 1e-12);
    }
    assert!(alternating(3, |_| 1.0).tail().is_none() && alternating(0, |_| 1.0).tail().is_none());
    assert!(alternating(4, |_| 1.0).tail().is_some());
}

#[test]
fn saturation_leaves_a_tail() {
    let tail = alternating(40, |t| 1.0 / (1.0 + (-0.1 * (t - 60.0)).exp())).tail().unwrap();
    // From about 1 - e^-4 on.
    assert!((15..25).contains(&tail.start), "{tail:?}");
    assert!((10.0 * tail.growth_rate.value).abs() < 2e-3, "{tail:?}");
}

#[test]
fn amplitudes_that_waver() {
    assert_eq!(alternating(40, |t| 2.0 + (0.05 * t).sin()).wavering(), 3);
    assert_eq!(alternating(40, |t| 2.0 + 0.1 * (0.05 * t).sin()).wavering(), 0);
    assert_eq!(alternating(40, |t| t * (-0.05 * t).exp()).wavering(), 1);
}

#[test]
fn unequal_rise_and_fall() {
    let turn = |k: i32| Extremum {
        time: 5.0 * f64::from(k) + if k % 2 == 0 { 0.0 } else { 2.0 },
        height: if k % 2 == 0 { 1.5 } else { -0.5 },
        is_maximum: k % 2 == 0,
    };
    let swings = Swings::new((0..6).map(turn).collect());
    let tail = swings.tail().unwrap();
    assert!((tail.period.value - 10.0).abs() < 1e-12 && tail.growth_rate.value.abs() < 1e-12);
    assert!(swings.amplitudes.iter().all(|a| *a == 1.0) && swings.midlines.iter().all(|m| *m == 0.5));
}

use super::*;
use crate::{StepCause, StepLimit};

/// Errors C(t) dt^3 with C jumping by a factor of 1000: the length follows within a few attempts, with few
/// rejections.
#[test]
fn steps_follow_the_error() {
    let mut control = StepControl { next: 1e-3, ..StepControl::default() };
    let (mut time, mut rejected, mut steps) = (0.0, 0, 0);
    while time < 10.0 {
        let constant = if (4.0..5.0).contains(&time) { 1e6 } else { 1e3 };
        let dt = control.next;
        if control.judge(dt, constant * dt.powi(3)) {
            time += dt;
            steps += 1;
        } else {
            rejected += 1;
        }
    }
    // 0.1 and 0.01 are the lengths of error one.
    assert!(rejected <= 6, "{rejected}");
    assert!((190..300).contains(&steps), "{steps}");
}

#[test]
fn a_failure_shortens_and_a_recovery_is_slow() {
    let mut control = StepControl::default();
    control.retreat(1.0);
    assert_eq!(control.next, 0.25);
    assert!(control.judge(0.25, 1e-9));
    assert_eq!(control.next, 0.25);
    assert!(control.judge(0.25, 1e-9));
    assert!(control.next > 0.25);
    assert!(!control.judge(1.0, f64::INFINITY) && control.next < 1.0);
}

/// A mode that decays at the rate 2/dt is stable to the end of an interval of stability, with a stabiliser or without.
#[test]
fn bounds_follow_the_interval_of_stability() {
    let decay = StepLimit::decay(0.1, "a decay");
    let stabilised = StepLimit { dt: 1.0, cause: StepCause::Stabilised { bare: 0.1 }, ..decay };
    for interval in [2.0, 30.0] {
        assert_eq!(decay.for_interval(interval, false) * decay.decay_rate(), interval);
        assert_eq!(stabilised.for_interval(interval, false) * stabilised.decay_rate(), interval);
        assert_eq!(stabilised.for_interval(interval, true), 1.0);
    }
}

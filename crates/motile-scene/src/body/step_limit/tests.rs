use super::*;

/// A bound on decay grows with the integrator's interval of stability, a stabilised one without its stabiliser, and
/// bounds on transport and accuracy with neither; these do not decay.
#[test]
fn bounds_follow_from_their_cause() {
    let of = |cause: StepCause| StepLimit { dt: 0.1, reason: "a reason", cause };
    for (cause, bare, stabilised, rate) in [
        (StepCause::Decay, 1.0, 1.0, 20.0),
        (StepCause::Stabilised { bare: 0.04 }, 0.4, 0.1, 50.0),
        (StepCause::Transport, 0.1, 0.1, 0.0),
        (StepCause::Accuracy, 0.1, 0.1, 0.0),
    ] {
        let limit = of(cause);
        let found = [limit.for_interval(20.0, false), limit.for_interval(20.0, true), limit.decay_rate()];
        let wanted = [bare, stabilised, rate];
        assert!(found.iter().zip(wanted).all(|(found, wanted)| (found - wanted).abs() < 1e-13), "{cause:?}: {found:?}");
    }
}

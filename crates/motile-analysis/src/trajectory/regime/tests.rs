use super::*;

#[test]
fn names() {
    assert_eq!(Regime::SteadyOscillation.to_string(), "steady oscillation");
    let short = Regime::Undecided(Doubt::TooShort { periods: 0.62 });
    assert_eq!(short.to_string(), "undecided: only 0.6 periods");
    assert_eq!(Regime::Undecided(Doubt::TooFewSamples { found: 3 }).to_string(), "undecided: only 3 samples");
}

#[test]
fn criteria() {
    let unit = RegimeCriteria::default();
    assert!(unit.check().is_ok());
    assert_eq!(RegimeCriteria::scaled(1.0, 0.1).unwrap(), unit);
    let small = RegimeCriteria::scaled(1e-5, 2e-6).unwrap();
    assert!((small.centre / 1e-11 - 1.0).abs() < 1e-14 && (small.rest / 2e-8 - 1.0).abs() < 1e-14);
    assert!((small.travel / 1e-4 - 1.0).abs() < 1e-14);
    assert!(RegimeCriteria::scaled(0.0, 0.1).is_err() && RegimeCriteria::scaled(1.0, f64::NAN).is_err());
    for transient in [-0.1, 1.0, f64::NAN] {
        assert!(RegimeCriteria { transient, ..unit }.check().is_err());
    }
    for bad in [0.0, f64::NAN, f64::INFINITY] {
        assert!(RegimeCriteria { centre: bad, ..unit }.check().is_err());
        assert!(RegimeCriteria { rest: bad, ..unit }.check().is_err());
        assert!(RegimeCriteria { hysteresis: bad, ..unit }.check().is_err());
        assert!(RegimeCriteria { steady: bad, ..unit }.check().is_err());
        assert!(RegimeCriteria { travel: bad, ..unit }.check().is_err());
        assert!(RegimeCriteria { linear: bad, ..unit }.check().is_err());
    }
}

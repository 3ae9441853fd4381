use super::*;

#[test]
fn time_steps() {
    assert_eq!(time_step("auto"), Ok(StepSize::OfLimit(0.5)));
    assert_eq!(time_step("1e-3"), Ok(StepSize::Fixed(1e-3)));
    assert_eq!(time_step("adaptive"), Ok(StepSize::default()));
    assert_eq!(time_step("adaptive:0.01"), Ok(StepSize::Adaptive { tolerance: 0.01 }));
    for text in ["0", "-1", "nan", "inf", "automatic", "", "adaptive:", "adaptive:1", "adaptive:0", "adaptive1e-3"] {
        assert!(time_step(text).is_err(), "{text}");
    }
}

#[test]
fn pairs() {
    assert_eq!(pair("-0.5,1e-2"), Ok([-0.5, 0.01]));
    assert_eq!(pair("1, 2"), Ok([1.0, 2.0]));
    for text in ["1", "1,", ",1", "1,2,3", "1;2", "nan,0", ""] {
        assert!(pair(text).is_err(), "{text}");
    }
}

#[test]
fn what_is_wrong_with_a_pair_is_told() {
    assert_eq!(pair("1e51,0").unwrap_err(), "the first number must be a number from -1e50 to 1e50");
    assert_eq!(pair("0,x").unwrap_err(), "the second number must be a number from -1e50 to 1e50");
    assert_eq!(pair("1e8").unwrap_err(), "must be two numbers with a comma between them");
}

/// Ranges that are announced are those that a description takes.
#[test]
fn ranges_of_counts() {
    use motile::setup::{Method, Setup};
    for (text, taken) in [("15", false), ("16", true), ("4096", true), ("4097", false)] {
        assert_eq!(nodes(text).is_ok(), taken, "{text}");
        let [nodes, elements] = [text.parse().unwrap(), 16_384];
        let setup = Setup { method: Method::Integral(IntegralMethod { nodes, elements }), ..Setup::default() };
        assert_eq!(setup.check().is_ok(), taken, "{text}");
    }
    for (text, taken) in [("72", true), ("1000000", true), ("1000001", false)] {
        assert_eq!(elements(text).is_ok(), taken, "{text}");
        let [nodes, elements] = [72, text.parse().unwrap()];
        let setup = Setup { method: Method::Integral(IntegralMethod { nodes, elements }), ..Setup::default() };
        assert_eq!(setup.check().is_ok(), taken, "{text}");
    }
    assert_eq!(nodes("5000").unwrap_err(), "must be a whole number from 16 to 4096");
}

#[test]
fn signs_and_sizes() {
    assert_eq!(finite("-2"), Ok(-2.0));
    assert_eq!(finite("0.5"), Ok(0.5));
    assert!(finite("inf").is_err() && finite("-1e51").is_err() && finite("-1e7").is_ok());
    assert!(
        positive("0").is_err()
            && positive("1e51").is_err()
            && positive("1e7").is_ok()
            && positive("NaN").is_err()
            && positive("x").is_err()
    );
    assert!(not_negative("-1e-9").is_err() && not_negative("0").is_ok());
}

#[test]
fn numbers_come_back() {
    // Mantissas that need all digits, over all magnitudes of both signs.
    for k in -3000..3000 {
        let value = f64::from(k).signum() * (f64::from(k) * 4.6e-3).exp() * 0.999_999_7;
        assert_eq!(finite(&value.to_string()), Ok(value));
        assert_eq!(positive(&value.to_string()).is_ok(), value > 0.0);
    }
}

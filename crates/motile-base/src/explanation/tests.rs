use super::*;
use crate::InputError;

#[derive(thiserror::Error)]
enum Run {
    #[error("at time 2 the flow could not be computed")]
    Flow(#[source] InputError),
    #[error(transparent)]
    Same(#[from] InputError),
}
crate::debug_as_explanation!(Run);

#[test]
fn a_program_that_returns_an_error_prints_a_sentence() {
    let cause = InputError::NotPositive { name: "the viscosity", value: -1.0 };
    let sentence = "the viscosity is -1. Use a positive finite number";
    let returned: Box<dyn Error> = Run::Flow(cause.clone()).into();
    assert_eq!(format!("{returned:?}"), format!("at time 2 the flow could not be computed: {sentence}"));
    // A transparent error says what its cause says, once.
    let returned: Box<dyn Error> = Run::Same(cause).into();
    assert_eq!(format!("{returned:?}"), sentence);
    assert_eq!(explanation(&*returned), sentence);
}

/// An error whose text has more after its cause.
#[derive(Debug, thiserror::Error)]
#[error("{0} (no shorter steps avoid it)")]
struct Around(#[source] InputError);

#[test]
fn a_cause_is_told_once() {
    let error = Around(InputError::NotPositive { name: "the viscosity", value: -1.0 });
    let once = "the viscosity is -1. Use a positive finite number (no shorter steps avoid it)";
    assert_eq!(explanation(&error), once);
}

#[test]
fn numbers_have_as_many_digits_as_it_takes() {
    // Six at most by themselves, without zeros at the end, powers of ten where they are far from one.
    let alone = [0.1 + 0.2, 1.0 / 3.0, 2.0, -0.0, 123_456.7, 6.682_742e-4, 2e-12 / 3.0, 7e22 / 3.0, f64::NAN];
    let texts = ["0.3", "0.333333", "2", "-0", "123457", "6.68274e-4", "6.66667e-13", "2.33333e22", "NaN"];
    assert_eq!(alone.map(told), texts);
    // Three beside another one, more where these are the same, and the whole of two neighbours.
    assert_eq!(told_apart([6.682_742_181_3e-4, 6.682_736_994e-4]), ["6.682742e-4", "6.682737e-4"]);
    assert_eq!(told_apart([1e-3 / 3.0, 1e-6]), ["3.33e-4", "1e-6"]);
    assert_eq!(told_apart([1.0, 1.0 + f64::EPSILON]), ["1", "1.0000000000000002"]);
}

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
    let sentence = "the viscosity is -1: give a positive finite number";
    let returned: Box<dyn Error> = Run::Flow(cause.clone()).into();
    assert_eq!(format!("{returned:?}"), format!("at time 2 the flow could not be computed: {sentence}"));
    // A transparent error says what its cause says, once.
    let returned: Box<dyn Error> = Run::Same(cause).into();
    assert_eq!(format!("{returned:?}"), sentence);
    assert_eq!(explanation(&*returned), sentence);
}

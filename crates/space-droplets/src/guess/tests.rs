use super::*;

/// States on a curve in five dimensions, and velocities that are a smooth function of the state.
fn state(t: f64) -> [f64; 5] {
    [1.0, t, t.sin(), (2.0 * t).cos(), t * t]
}

fn velocities(state: [f64; 5]) -> [f64; 2] {
    [state[1].exp() * state[3], state[2] - 0.5 * state[4] * state[0]]
}

/// Returns the error of a guess after five times, for the present time h.
fn error(h: f64) -> f64 {
    let mut guess = Guess::default();
    let mut out = [1.0; 2];
    for t in [-5.0, -4.0, -3.0, -1.9, -1.0] {
        guess.write(state(t * h).into_iter(), &mut out);
        guess.keep(&velocities(state(t * h)));
    }
    guess.write(state(h).into_iter(), &mut out);
    let exact = velocities(state(h));
    (out[0] - exact[0]).hypot(out[1] - exact[1])
}

#[test]
fn guesses_are_of_high_order() {
    let errors = [0.08, 0.04, 0.02].map(error);
    let order = (errors[1] / errors[2]).log2();
    assert!(order > 3.7 && errors[2] < 1e-4, "{order} {errors:?}");
}

#[test]
fn states_that_repeat_give_the_same_velocities_and_others_start_from_rest() {
    let (mut guess, mut out) = (Guess::default(), [1.0; 2]);
    for _ in 0..7 {
        guess.write(state(0.3).into_iter(), &mut out);
        guess.keep(&[2.0, 3.0]);
    }
    guess.write(state(0.3).into_iter(), &mut out);
    assert_eq!((out, guess.len()), ([2.0, 3.0], KEPT));
    let saved: Vec<f64> = guess.save().collect();
    let mut other = Guess::default();
    other.load([5, 2], &saved);
    assert_eq!((other.len(), other.save().collect::<Vec<f64>>()), (KEPT, saved));
    guess.write([1.0; 4].into_iter(), &mut out);
    assert_eq!((out, guess.len()), ([0.0; 2], 0));
    guess.write(state(0.3).into_iter(), &mut out);
    guess.keep(&[2.0, 3.0]);
    guess.forget();
    guess.write(state(0.3).into_iter(), &mut out);
    assert_eq!(out, [0.0; 2]);
}

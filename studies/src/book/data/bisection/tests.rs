use anyhow::bail;

use super::Bisection;

#[test]
fn the_boundary_is_within_the_difference_that_is_left() {
    let search = Bisection { entries: Vec::new(), between: [0.4, 1.6], relative: 0.02, passed: 3.0 };
    for boundary in [0.41, 0.777, 1.2, 1.59] {
        let run = |value: f64| Ok([if value > boundary { 4.0 } else { 1.0 }, 2.0]);
        let [turns, passes, runs, seconds] = search.halve(run).expect("a boundary");
        let (low, high) = (if turns.is_nan() { 0.4 } else { turns }, if passes.is_nan() { 1.6 } else { passes });
        assert!(low <= boundary && boundary <= high && high - low <= 0.02 * high, "{boundary}: {low} to {high}");
        assert!(runs <= 8.0 && seconds == 2.0 * runs, "{runs} runs");
    }
    // What passes nowhere has no value at which it does; an error is one.
    assert!(search.halve(|_| Ok([0.0, 1.0])).expect("none")[1].is_nan());
    assert!(search.halve(|_| Ok([4.0, 1.0])).expect("none")[0].is_nan());
    assert!(search.halve(|_| bail!("a droplet at a wall")).is_err());
    assert!(Bisection { between: [1.6, 0.4], ..search }.halve(|_| Ok([0.0, 1.0])).is_err());
}

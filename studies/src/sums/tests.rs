use std::time::Duration;

use motile_timing::{Turns, median};

/// Of what times the tables: its package has no tests, because they would need all that its benchmarks need.
#[test]
fn ratios_are_those_of_the_work() {
    let work = |count: u64| {
        move || {
            std::hint::black_box((0..count).map(|k| k ^ (k >> 3)).fold(0, u64::wrapping_add));
        }
    };
    let (mut one, mut four) = (work(200_000), work(800_000));
    let turns = Turns::measure(Duration::from_millis(200), &mut [&mut one, &mut four]);
    // Four times the work; how near the ratio comes depends on what else the machine does.
    assert!(turns.ratio(1) > 2.0 && turns.ratio(1) < 8.0, "{}", turns.ratio(1));
    assert!(median(&mut []).is_nan() && median(&mut [3.0, 1.0, 2.0]) == 2.0);
}

//! The quick version of all hard cases. `cargo run --release -p studies -- hard_cases` runs the long one.

use motile_tests::hard_cases::{Ending, Extent, Trial, cases};

/// Runs all trials of these cases; after a failure the state must be one that can be looked at.
fn run(numbers: &[usize]) {
    let mut complaints = Vec::new();
    for trial in cases().iter().filter(|trial| numbers.contains(&trial.number)) {
        let mut evaluated = None;
        let outcome = trial.run(Extent::Quick, &mut |system| evaluated = Some(system.evaluate().is_ok()));
        match outcome {
            Err(error) => complaints.push(format!("{trial:?} could not be made: {error}")),
            Ok(outcome) => {
                let Trial { name, way, .. } = trial;
                println!(
                    "{name} | {way} | {:?} | t = {:.3}, {} steps, {} rejected, {:.2} s | {:e} {:e}",
                    outcome.ending,
                    outcome.time,
                    outcome.steps,
                    outcome.rejected,
                    outcome.seconds,
                    outcome.drift.area,
                    outcome.drift.particles
                );
                complaints.extend(trial.complaint(&outcome));
                if evaluated != Some(true) {
                    complaints.push(format!("{trial:?} was left in a state whose flow cannot be computed"));
                }
                assert_eq!(outcome.explanation.is_none(), outcome.ending == Ending::Finished);
            }
        }
    }
    assert!(complaints.is_empty(), "{}", complaints.join("\n"));
}

#[test]
fn strong_activity_and_collapse() {
    run(&[1, 3]);
}

#[test]
fn viscosity_ratios() {
    run(&[2]);
}

#[test]
fn stiff_walls() {
    run(&[4]);
}

#[test]
fn coarse_and_narrow() {
    run(&[5, 6, 7, 8]);
}

#[test]
fn far_and_long() {
    run(&[9, 10]);
}

#[test]
fn odd_starts() {
    run(&[11, 12, 19]);
}

#[test]
fn two_droplets() {
    run(&[13]);
}

#[test]
fn steps_too_large() {
    run(&[14]);
}

#[test]
fn odd_meshes_and_grids() {
    run(&[15, 16]);
}

#[test]
fn walls_and_net_forces() {
    run(&[17, 18]);
}

#[test]
fn other_units() {
    run(&[21]);
}

#[test]
fn every_case_is_there() {
    let all = cases();
    for number in (1..=21).filter(|&number| number != 20) {
        assert!(all.iter().any(|trial| trial.number == number), "case {number}");
    }
}

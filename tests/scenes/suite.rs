//! The quick version of all hard cases.
//!
//! `UPDATE=1 cargo test --release -p motile-tests --test scenes the_table -- --nocapture` runs the long version and
//! writes `docs/tables/hard-cases.csv`.

use std::fs;

use motile_tests::validation::Table;

use crate::hard_cases::{Ending, Extent, Outcome, Trial, cases};

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

const TABLE: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/../docs/tables/hard-cases.csv");
const COMMAND: &str = "UPDATE=1 cargo test --release -p motile-tests --test scenes the_table";

/// The table of the documents has the long version of every trial, and each ended as it should. With the variable
/// UPDATE, the test runs them and writes the table.
#[test]
fn the_table_has_every_trial() {
    if std::env::var_os("UPDATE").is_some() {
        fs::write(TABLE, long_version()).unwrap();
    }
    let mut table = csv::ReaderBuilder::new().comment(Some(b'#')).from_path(TABLE).unwrap();
    let rows: Vec<csv::StringRecord> = table.records().map(Result::unwrap).collect();
    let all = cases();
    assert_eq!(rows.len(), all.len());
    for (row, trial) in rows.iter().zip(all) {
        let Trial { number, name, way, expected, .. } = &trial;
        assert_eq!([&row[0], &row[1], &row[2]], [number.to_string(), (*name).to_owned(), way.to_string()]);
        assert!(expected.iter().any(|ending| format!("{ending:?}") == row[3]), "{trial:?}: {row:?}");
    }
}

/// The table of the long version, and how it is made.
fn long_version() -> String {
    let mut table = Table::new(
        "How hard cases end",
        "case | what is hard | method | outcome | time | steps | rejected | area | particles | seconds",
    );
    for trial in cases() {
        let outcome = trial.run(Extent::Long, &mut |_| ()).expect("a scene");
        println!("{trial:?}: {outcome:?}");
        let Trial { number, name, way, .. } = trial;
        let Outcome { ending, time, steps, rejected, drift, seconds, .. } = outcome;
        table.row(format_args!(
            "{number} | {name} | {way} | {ending:?} | {time:.4} | {steps} | {rejected} | {:+.1e} | {:+.1e} | \
             {seconds:.1}",
            drift.area, drift.particles
        ));
    }
    format!("# {COMMAND}\n{}", table.csv())
}

//! Instructions of kernels and steps, counted by valgrind: the same on a busy machine as on an idle one.
//!
//! `cargo run --release --features rayon -p studies -- instructions`, with `RAYON_NUM_THREADS=1`, compares each with
//! `studies/instructions.csv` and fails where one has become more than 5 % more, or fewer: then `--write` renews the
//! table. The ignored test of this file does the same. Counts depend on the compiler and on the processor's instruction
//! set; the table names the compiler that it was made with.

use std::{env, fs, process::Command};

use anyhow::{Context, Result, ensure};
use clap::Args;
use motile_timing::WORKS;

const TABLE: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/instructions.csv");
/// Largest relative difference from the table.
const TOLERANCE: f64 = 0.05;
/// Variable with the number of the work to do, for the program under valgrind.
const WORK: &str = "STUDIES_WORK";
/// Arguments of the program under valgrind: this command, or the test that counts.
const CHILD: &[&str] = if cfg!(test) {
    &["--ignored", "--exact", "--test-threads=1", "instructions::tests::counts_are_those_of_the_table"]
} else {
    &["instructions"]
};
/// Counts the instructions of kernels and steps.
#[derive(Debug, Args)]
pub(crate) struct Flags {
    /// Write the table instead of comparing with it
    #[arg(long)]
    write: bool,
}

/// Instructions of the work with this number, by valgrind.
fn instructions(number: usize) -> Result<u64> {
    let run = Command::new("valgrind")
        .args([
            "--tool=callgrind",
            "--callgrind-out-file=/dev/null",
            "--toggle-collect=motile_timing::counted::counted*",
        ])
        .arg(env::current_exe()?)
        .args(CHILD)
        .env(WORK, number.to_string())
        .output()
        .context("valgrind counts the instructions: install it")?;
    let said = String::from_utf8_lossy(&run.stderr);
    let collected = said.lines().find_map(|line| line.split_once("Collected :")?.1.trim().parse().ok());
    collected.filter(|_| run.status.success()).with_context(|| format!("valgrind counted nothing: {said}"))
}

pub(crate) fn run(flags: &Flags) -> Result<()> {
    if let Ok(number) = env::var(WORK) {
        return WORKS.get(number.parse::<usize>()?).context("there is no such work")?.1();
    }
    let compiler = Command::new("rustc").arg("--version").output()?.stdout;
    let mut table = format!("# {}work;instructions\n", String::from_utf8_lossy(&compiler));
    let known = fs::read_to_string(TABLE).unwrap_or_default();
    let mut changed = Vec::new();
    for (number, (name, _)) in WORKS.iter().enumerate() {
        let now = instructions(number)?;
        let mut rows = known.lines().filter_map(|line| line.split_once(';'));
        let before = rows.find(|row| row.0 == *name).and_then(|row| row.1.parse::<f64>().ok());
        let change = before.map_or(f64::INFINITY, |before| now as f64 / before - 1.0);
        motile_cli::run::say(format_args!("{name:<46} {now:>12} {:>+8.2} %", 100.0 * change));
        if change.abs() > TOLERANCE {
            changed.push(*name);
        }
        table += &format!("{name};{now}\n");
    }
    if flags.write {
        return Ok(fs::write(TABLE, table)?);
    }
    ensure!(
        changed.is_empty(),
        "more than 5 % from {TABLE}: {}: cure it, or renew the table by --write",
        changed.join("; ")
    );
    Ok(())
}

#[cfg(test)]
mod tests;

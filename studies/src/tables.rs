//! Tables of measurements as files, and the pages that show parts of them.
//!
//! A study writes `docs/tables/NAME.csv` (`--write`) with the command that made it and the names of a few rows that
//! take little time, its witnesses. `studies -- witnesses` finds those again, and fails if the file shows other digits;
//! `studies -- all --write` makes every table and figure again. A page shows rows and columns of a table between two
//! comments,
//!
//! ```text
//! <!-- table NAME | columns: h, error in % as error | where: kind = Box or Channel; h = 0.1 -->
//! <!-- end of table -->
//! ```
//!
//! (the first of which may go over several lines), which [`crate::pages`] fills.

mod rows;
mod witnesses;

use std::fs;
use std::path::{Path, PathBuf};

use anyhow::{Context, Result, ensure};
use clap::Args;
use motile_cli::run::say;
use motile_tests::validation::Table;

pub(crate) use rows::{Measure, Once, all_wanted, note, program, took};
pub(crate) use witnesses::{AllFlags, WitnessFlags, all, witnesses};

/// Lines of a file before its table: the command that made it, then the names of its witnesses.
const COMMAND: &str = "# ";
const WITNESSES: &str = "witness: ";

pub(crate) fn root() -> &'static Path {
    Path::new(concat!(env!("CARGO_MANIFEST_DIR"), "/.."))
}

/// The flags of the studies whose tables stand in docs/tables.
#[derive(Debug, Clone, Copy, Args)]
pub(crate) struct Keep {
    /// Write the tables to docs/tables
    #[arg(long)]
    write: bool,
    /// Fail if the tables are not those of docs/tables
    #[arg(long, conflicts_with = "write")]
    check: bool,
}

impl Keep {
    /// True if tables are written.
    pub(crate) fn writes(self) -> bool {
        self.write
    }

    /// Prints the tables that `studies -- COMMAND` has made, and writes or compares them if the flags say so.
    ///
    /// # Errors
    /// A file whose title, columns or rows are others, or that cannot be written.
    pub(crate) fn tables(self, name: &str, command: &str, found: &[Table]) -> Result<()> {
        // Of a few rows there is no table.
        if !all_wanted() {
            return witnesses::compare(found);
        }
        found.iter().for_each(say);
        for (k, table) in found.iter().enumerate() {
            let path = file(name, k);
            if self.write {
                let made = format!("{COMMAND}cargo run --release -p studies -- {command} --write\n");
                let chosen = witnesses::choose(table);
                let chosen = chosen.iter().map(|row| format!("{COMMAND}{WITNESSES}{row}\n"));
                fs::write(&path, made + &chosen.collect::<String>() + &table.csv())
                    .with_context(|| path.display().to_string())?;
            } else if self.check {
                let kept = fs::read_to_string(&path).with_context(|| path.display().to_string())?;
                let same = kept.ends_with(&table.csv());
                ensure!(same, "{} has other values than are found now: run the study with --write", path.display());
            }
        }
        Ok(())
    }
}

/// Where the table number `k` (from 0) of a study is.
pub(crate) fn file(name: &str, k: usize) -> PathBuf {
    let number = if k == 0 { String::new() } else { format!("-{}", k + 1) };
    root().join(format!("docs/tables/{name}{number}.csv"))
}

pub(crate) fn name(path: &Path) -> String {
    path.file_stem().unwrap_or_default().to_string_lossy().into_owned()
}

/// Files of a directory with an extension, in order.
pub(crate) fn files(directory: &str, extension: &str) -> Result<Vec<PathBuf>> {
    let entries = fs::read_dir(root().join(directory))?.map(|entry| Ok(entry?.path()));
    let mut paths: Vec<PathBuf> = entries.collect::<Result<_>>()?;
    paths.retain(|path| path.extension().is_some_and(|found| found == extension));
    paths.sort();
    Ok(paths)
}

/// All pages of docs and its folders, and README.md.
pub(crate) fn pages_of() -> Result<Vec<PathBuf>> {
    let mut paths = vec![root().join("README.md")];
    let mut folders = vec!["docs".to_owned()];
    while let Some(folder) = folders.pop() {
        paths.extend(files(&folder, "md")?);
        for entry in fs::read_dir(root().join(&folder))? {
            let entry = entry?;
            let name = entry.file_name().to_string_lossy().into_owned();
            // The site that mdBook makes.
            if entry.file_type()?.is_dir() && name != "build" {
                folders.push(format!("{folder}/{name}"));
            }
        }
    }
    paths.sort();
    Ok(paths)
}

/// The text of a comment that begins with `first` and may go on in the lines after it.
pub(crate) fn comment<'a>(first: &str, mut lines: impl Iterator<Item = &'a str>) -> Result<String> {
    let mut text = first.to_owned();
    while !text.ends_with("-->") {
        let more = lines.next().with_context(|| format!("no '-->' after: {first}"))?;
        text = format!("{text} {}", more.trim());
    }
    Ok(text.trim_end_matches("-->").trim().to_owned())
}

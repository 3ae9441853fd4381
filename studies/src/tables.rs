//! Tables of measurements as files, and the pages that show parts of them.
//!
//! A study writes `docs/tables/NAME.csv` (`--write`) with the command that made it, the commit it was made at and the
//! paths it depends on. A page shows rows and columns of it between two comments,
//!
//! ```text
//! <!-- table NAME | columns: h, error in % as error | where: kind = Box or Channel; h = 0.1 -->
//! <!-- end of table -->
//! ```
//!
//! (the first of which may go over several lines), which [`crate::pages`] fills. `studies -- stale` lists the
//! files whose code has changed since they were made, and the tables that still stand in their page, marked by
//!
//! ```text
//! <!-- measured at COMMIT | COMMAND | depends on: PATH PATH -->
//! ```

use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

use anyhow::{Context, Result, bail, ensure};
use clap::Args;
use motile_cli::run::say;
use motile_tests::validation::Table;

/// Sources that every run of a droplet depends on.
const RUNS: [&str; 8] = [
    "crates/motile-base",
    "crates/stokes-grid",
    "crates/stokes-boundary-integrals",
    "crates/motile-scene",
    "crates/ib-core",
    "crates/motile-boundary-integrals",
    "crates/active-interface",
    "crates/motile/src/setup",
];
/// Head of files before their table.
const COMMIT: &str = "# commit: ";
const INPUTS: &str = "# depends on: ";
const COMMAND: &str = "# ";
/// Tables that stand in pages.
const MEASURED: &str = "<!-- measured at ";

pub(crate) fn root() -> &'static Path {
    Path::new(concat!(env!("CARGO_MANIFEST_DIR"), "/.."))
}

fn git(arguments: &[&str]) -> Result<String> {
    let done = Command::new("git").current_dir(root()).args(arguments).output().context("running git")?;
    ensure!(done.status.success(), "git {}: {}", arguments.join(" "), String::from_utf8_lossy(&done.stderr).trim());
    Ok(String::from_utf8_lossy(&done.stdout).trim().to_owned())
}

/// The flag of the studies whose tables stand in docs/tables.
#[derive(Debug, Clone, Copy, Args)]
pub(crate) struct Keep {
    /// Write the tables to docs/tables, with the commit and what they depend on
    #[arg(long)]
    write: bool,
}

impl Keep {
    /// Prints the tables that `studies -- COMMAND` has made, and writes them where that was asked for.
    ///
    /// # Errors
    /// Those of [`write()`].
    pub(crate) fn tables(self, name: &str, command: &str, inputs: &[&str], found: &[Table]) -> Result<()> {
        found.iter().for_each(say);
        if self.write { write(name, command, inputs, found) } else { Ok(()) }
    }
}

/// The commit that last changed `inputs` or what every run depends on.
///
/// # Errors
/// Changes of them that are not committed, or that this program was built before.
pub(crate) fn commit(inputs: &[&str]) -> Result<String> {
    let inputs = &[&RUNS, inputs].concat()[..];
    let changed = git(&[&["status", "--porcelain", "--"], inputs].concat())?;
    ensure!(changed.is_empty(), "commit first, so that tables can tell what made them:\n{changed}");
    let built = fs::metadata(std::env::current_exe()?)?.modified()?;
    for path in git(&[&["ls-files", "--"], inputs].concat())?.lines() {
        let changed = fs::metadata(root().join(path))?.modified()?;
        ensure!(changed <= built, "build again: {path} was changed after this program was built");
    }
    git(&[&["log", "-1", "--format=%h", "--"], inputs].concat())
}

/// Writes the tables that `studies -- COMMAND --write` has made from `inputs` and what every run depends on to
/// docs/tables, as NAME.csv, NAME-2.csv ...
///
/// # Errors
/// Those of [`commit`]; files that cannot be written.
pub(crate) fn write(name: &str, command: &str, inputs: &[&str], found: &[Table]) -> Result<()> {
    let (commit, inputs) = (commit(inputs)?, [&RUNS, inputs].concat().join(" "));
    for (k, table) in found.iter().enumerate() {
        let made =
            format!("# cargo run --release -p studies -- {command} --write\n{COMMIT}{commit}\n{INPUTS}{inputs}\n");
        fs::write(file(name, k), made + &table.csv())?;
    }
    Ok(())
}

/// True if the files have the tables that were made now.
///
/// # Errors
/// A file whose title, columns or rows are others.
pub(crate) fn check(name: &str, found: &[Table]) -> Result<()> {
    for (k, table) in found.iter().enumerate() {
        let path = file(name, k);
        let kept = fs::read_to_string(&path).with_context(|| path.display().to_string())?;
        let same = kept.ends_with(&table.csv());
        ensure!(same, "{} has other values than are found now: run the study with --write", path.display());
    }
    Ok(())
}

/// Where the table number `k` (from 0) of a study is.
pub(crate) fn file(name: &str, k: usize) -> PathBuf {
    let number = if k == 0 { String::new() } else { format!("-{}", k + 1) };
    root().join(format!("docs/tables/{name}{number}.csv"))
}

/// Commits since `commit` that changed more than comments and tests of what a table depends on; `None` where the
/// history has no such commit.
fn changes(commit: &str, inputs: &str) -> Result<Option<usize>> {
    if git(&["cat-file", "-e", &format!("{commit}^{{commit}}")]).is_err() {
        return Ok(None);
    }
    let (range, code) = (format!("{commit}..HEAD"), "-G^[[:space:]]*[^/[:space:]]");
    let mut arguments = vec!["log", "--format=%h", code, &range, "--"];
    arguments.extend(inputs.split_whitespace());
    arguments.push(":(exclude)*tests.rs");
    Ok(Some(git(&arguments)?.lines().count()))
}

/// Lists the tables that are older than the last change of what they measure.
pub(crate) fn stale() -> Result<()> {
    let mut tables: Vec<[String; 4]> = Vec::new();
    for path in files("docs/tables", "csv")? {
        let text = fs::read_to_string(&path)?;
        let stated = |what: &str| {
            let line = text.lines().find_map(|line| line.strip_prefix(what));
            line.map(str::to_owned).with_context(|| format!("{} has no line '{what}...'", path.display()))
        };
        tables.push([name(&path), stated(COMMIT)?, stated(INPUTS)?, stated(COMMAND)?]);
    }
    for path in pages_of()? {
        let text = fs::read_to_string(&path)?;
        let mut heading = "";
        let mut lines = text.lines();
        while let Some(line) = lines.next() {
            heading = line.strip_prefix('#').map_or(heading, |title| title.trim_start_matches('#').trim());
            let Some(rest) = line.strip_prefix(MEASURED) else { continue };
            let whole = comment(rest, &mut lines)?;
            let parts: Vec<&str> = whole.split('|').map(str::trim).collect();
            let [commit, command, inputs] = parts[..] else { bail!("{}: not understood: {line}", path.display()) };
            let inputs = inputs.trim_start_matches("depends on:");
            tables.push([
                format!("{}, {heading}", name(&path)),
                commit.to_owned(),
                inputs.to_owned(),
                command.to_owned(),
            ]);
        }
    }
    for [name, commit, inputs, command] in tables {
        match changes(&commit, &inputs)? {
            Some(0) => {}
            Some(count) => say(format_args!("{name}: {count} changes since {commit}; {command}")),
            None => say(format_args!("{name}: made at {commit}, which is not in the history; {command}")),
        }
    }
    Ok(())
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

//! Witnesses: a few rows of each table that take little time, found again and compared with what the file shows.

use std::fs;
use std::path::{Path, PathBuf};

use anyhow::{Context, Result, bail, ensure};
use clap::{Args, Parser};
use motile_cli::run::say;
use motile_tests::validation::Table;

use super::rows::{self, program};
use super::{WITNESSES, files, root};

/// Most rows of a table that are witnesses, and the longest that they take together (seconds).
const MOST: usize = 3;
const LONGEST: f64 = 1.0;
/// The longest that a table's only witness takes (seconds); a table without faster rows has none.
const ONLY: f64 = 8.0;
/// Columns of times, which differ between two runs of a program.
const TIMED: [&str; 10] = [
    "seconds",
    "seconds per time",
    "pairs per time",
    "FFT pairs a unit of time",
    "ms",
    "over the plane's",
    "two threads",
    "front",
    "preset",
    "MB",
];
/// Numbers below this are round-off, which differs between two machines.
const ROUND_OFF: f64 = 1e-11;

/// Finds the witnesses of all tables and figures again, and compares them with the files.
#[derive(Debug, Args)]
pub(crate) struct WitnessFlags {
    /// Only tables whose name begins with this, or figures, such as "figure 3." for chapter 3
    #[arg(long)]
    only: Option<String>,
    /// Also runs of figures that take longer than a change should wait for
    #[arg(long)]
    slow: bool,
    /// Make the first rows of tables without witnesses their witnesses, if the file shows what is found now
    #[arg(long)]
    choose: bool,
}

/// Runs every study whose table is in docs/tables, and makes all figures of the reproduction report; goes on if it was
/// stopped.
#[derive(Debug, Args)]
pub(crate) struct AllFlags {
    /// Write tables, figures and pages. Without it, tables are compared with those in docs/tables
    #[arg(long)]
    write: bool,
    /// Only commands that begin with this, such as "validation"
    #[arg(long)]
    only: Option<String>,
    /// Leave out the figures of the reproduction report
    #[arg(long)]
    tables: bool,
}

/// A file of docs/tables.
#[derive(Debug)]
struct Kept {
    path: PathBuf,
    /// The words behind `studies --`.
    command: Vec<String>,
    title: String,
    header: Vec<String>,
    rows: Vec<Vec<String>>,
    /// Names of the rows that are witnesses.
    witnesses: Vec<String>,
}

impl Kept {
    fn read(path: &Path) -> Result<Option<Self>> {
        let read = || -> Result<Option<Self>> {
            let text = fs::read_to_string(path)?;
            let comments: Vec<&str> = text.lines().map_while(|line| line.strip_prefix("# ")).collect();
            let command = comments.first().context("the file does not begin with the command that made it")?;
            // Tables that tests write are checked by those tests.
            let Some((_, command)) = command.split_once("-p studies -- ") else { return Ok(None) };
            let witnesses = comments.iter().filter_map(|line| line.strip_prefix(WITNESSES));
            let mut table = csv::ReaderBuilder::new().comment(Some(b'#')).from_reader(text.as_bytes());
            let cells = |record: &csv::StringRecord| record.iter().map(str::to_owned).collect();
            Ok(Some(Self {
                path: path.to_owned(),
                command: command.split_whitespace().map(str::to_owned).collect(),
                title: (*comments.last().context("the file has no title")?).to_owned(),
                header: cells(table.headers()?),
                rows: table.records().map(|record| Ok(cells(&record?))).collect::<Result<_>>()?,
                witnesses: witnesses.map(str::to_owned).collect(),
            }))
        };
        read().with_context(|| path.display().to_string())
    }

    fn all() -> Result<Vec<Self>> {
        let paths = files("docs/tables", "csv")?;
        let kept = paths.iter().map(|path| Self::read(path));
        Ok(kept.collect::<Result<Vec<_>>>()?.into_iter().flatten().collect())
    }

    /// Columns that are compared.
    fn compared(&self) -> Vec<bool> {
        self.header.iter().map(|name| !TIMED.contains(&name.as_str())).collect()
    }

    /// The kept row of a name.
    fn row(&self, name: &str) -> Option<&Vec<String>> {
        let first = Table::cells(name);
        self.rows.iter().find(|row| row.starts_with(&first))
    }

    /// Compares rows that were found with those in the file.
    fn compare(&self, found: &Table) -> Result<usize> {
        let compared = self.compared();
        for row in found.rows() {
            let names = rows::names(found.title());
            let name = names.iter().find(|name| row.starts_with(&Table::cells(name)));
            let name = name.with_context(|| format!("{row:?} has no name"))?;
            let kept = self.row(name).with_context(|| format!("the file has no row {name}"))?;
            for (((cell, other), column), compared) in kept.iter().zip(row).zip(&self.header).zip(&compared) {
                ensure!(
                    !compared || same(cell, other),
                    "row '{name}', column '{column}': the file shows {cell}, and the program finds {other}"
                );
            }
        }
        Ok(found.rows().len())
    }
}

/// Names of the witnesses of a table that was just found: those of its rows that took least time, and that hold
/// numbers.
pub(super) fn choose(table: &Table) -> Vec<String> {
    let mut all: Vec<(f64, String)> = rows::names(table.title())
        .into_iter()
        .filter(|name| table.has_row(name))
        .filter_map(|name| Some((rows::seconds(table.title(), &name)?, name)))
        .collect();
    all.sort_by(|a, b| a.0.total_cmp(&b.0));
    let mut spent = 0.0;
    let mut chosen = Vec::new();
    for (seconds, name) in all.into_iter().take(MOST) {
        spent += seconds;
        if spent < LONGEST || (chosen.is_empty() && spent < ONLY) {
            chosen.push(name);
        }
    }
    chosen
}

/// True if two cells say the same: equal words, and numbers that differ by at most one in the last digit shown.
fn same(a: &str, b: &str) -> bool {
    let (a, b) = (pieces(a), pieces(b));
    a.len() == b.len() && a.iter().zip(&b).all(|(a, b)| a == b || close(a, b))
}

/// Numbers and the words between them.
fn pieces(text: &str) -> Vec<String> {
    let mut pieces: Vec<String> = Vec::new();
    let (mut last_is_number, mut before) = (false, ' ');
    for c in text.chars() {
        let exponent = last_is_number && (c == 'e' || (before == 'e' && "+-".contains(c)));
        let number = c.is_ascii_digit() || c == '.' || exponent || "+-".contains(c);
        match pieces.last_mut() {
            Some(piece) if number == last_is_number => piece.push(c),
            _ => pieces.push(c.to_string()),
        }
        (last_is_number, before) = (number, c);
    }
    pieces
}

fn close(a: &str, b: &str) -> bool {
    let (Ok(x), Ok(y)) = (a.parse::<f64>(), b.parse::<f64>()) else { return false };
    if x.abs() < ROUND_OFF {
        return y.abs() < 10.0 * ROUND_OFF;
    }
    let (digits, exponent) = a.split_once('e').unwrap_or((a, "0"));
    let places = digits.split_once('.').map_or(0, |(_, decimals)| decimals.len() as i32);
    // Whole numbers, such as numbers of steps, are the same.
    if places == 0 && exponent == "0" {
        return x == y;
    }
    let unit = 10_f64.powi(exponent.parse::<i32>().unwrap_or(0) - places);
    (x - y).abs() < 1.5 * unit
}

/// Compares tables of which a few rows were found with their files.
///
/// # Errors
/// Files that show other values.
pub(super) fn compare(found: &[Table]) -> Result<()> {
    let all = Kept::all()?;
    let mut failures = Vec::new();
    for table in found.iter().filter(|table| !table.rows().is_empty()) {
        let kept = all.iter().find(|kept| kept.title == table.title());
        let compared = kept.context("no file of docs/tables has this title").and_then(|kept| compare_one(kept, table));
        if let Err(failure) = compared {
            failures.push(format!("'{}': {failure:#}", table.title()));
        }
    }
    ensure!(failures.is_empty(), "{}", failures.join("\n"));
    Ok(())
}

fn compare_one(kept: &Kept, table: &Table) -> Result<()> {
    let file = kept.path.file_name().unwrap_or_default().to_string_lossy();
    let count = kept
        .compare(table)
        .with_context(|| format!("{file} is not current; make it again: studies -- {}", kept.command.join(" ")))?;
    say(format_args!("{file}: {count} of {} rows are as before", kept.rows.len()));
    if rows::are_chosen() && kept.witnesses.is_empty() {
        let chosen = choose(table);
        ensure!(!chosen.is_empty(), "{file}: the first row takes too long for a witness");
        let text = fs::read_to_string(&kept.path)?;
        let (command, rest) = text.split_once('\n').unwrap_or((&text, ""));
        let chosen: String = chosen.iter().map(|row| format!("# {WITNESSES}{row}\n")).collect();
        fs::write(&kept.path, format!("{command}\n{chosen}{rest}"))?;
    }
    Ok(())
}

/// Commands without repetition, in order.
fn commands(kept: &[Kept], only: impl Fn(&Kept) -> bool) -> Vec<Vec<String>> {
    let mut commands: Vec<Vec<String>> = Vec::new();
    for kept in kept.iter().filter(|kept| only(kept)) {
        if !commands.contains(&kept.command) {
            commands.push(kept.command.clone());
        }
    }
    commands
}

pub(crate) fn witnesses(flags: &WitnessFlags) -> Result<()> {
    let all = Kept::all()?;
    let name = |kept: &Kept| kept.path.file_name().unwrap_or_default().to_string_lossy().into_owned();
    let wanted = |kept: &Kept| flags.only.as_ref().is_none_or(|only| name(kept).starts_with(only.as_str()));
    let mut failures = Vec::new();
    for command in commands(&all, |kept| wanted(kept) && kept.witnesses.is_empty() == flags.choose) {
        let own = all.iter().filter(|kept| kept.command == command && wanted(kept));
        let names = own.flat_map(|kept| kept.witnesses.iter().map(|row| [kept.title.clone(), row.clone()]));
        match flags.choose {
            true => rows::want_first(MOST, LONGEST),
            false => rows::want_only(names.collect()),
        }
        // One that fails does not keep the others from being compared.
        if let Err(failure) = run(&command) {
            failures.push(format!("{failure:#}"));
        }
    }
    let without = all.iter().filter(|kept| wanted(kept) && kept.witnesses.is_empty()).map(name);
    let without: Vec<String> = without.collect();
    if !without.is_empty() {
        say(format_args!("No row is fast enough to be found again here: {}", without.join(", ")));
    }
    let figure = flags.only.as_deref().map(|only| only.trim_start_matches("figure "));
    let compared = match flags.choose {
        true => crate::book::witnesses::choose(figure),
        false => crate::book::witnesses::witnesses(flags.slow, figure),
    };
    failures.extend(compared.err().map(|failure| format!("{failure:#}")));
    ensure!(failures.is_empty(), "{}", failures.join("\n"));
    Ok(())
}

pub(crate) fn all(flags: &AllFlags) -> Result<()> {
    let folder = root().join("out/studies");
    motile_cli::run::make_directory(&folder)?;
    let wanted = |command: &str| flags.only.as_ref().is_none_or(|only| command.starts_with(only.as_str()));
    let mut failures = Vec::new();
    for mut command in commands(&Kept::all()?, |_| true) {
        let words = command.join(" ");
        // IB2d is not here.
        if !wanted(&words) || words.contains("FOLDER") {
            continue;
        }
        let slug = words.trim_end_matches(" --write").replace(|c: char| !c.is_alphanumeric(), "_");
        let done = folder.join(format!("{slug}.done"));
        if fs::read_to_string(&done).is_ok_and(|text| program().is_ok_and(|program| text == program)) {
            continue;
        }
        say(format_args!("\n== studies -- {words}"));
        if !flags.write {
            command.retain(|word| word != "--write");
            command.push("--check".to_owned());
        }
        rows::keep_in(&folder.join(format!("{slug}.tsv")))?;
        match run(&command) {
            Ok(()) => fs::write(&done, program()?)?,
            Err(failure) => failures.push(format!("{words}: {failure:#}")),
        }
    }
    if !flags.tables && flags.only.is_none() {
        let write = if flags.write { "--write" } else { "--quiet" };
        if let Err(failure) = run(&["figures".to_owned(), write.to_owned()]) {
            failures.push(format!("figures: {failure:#}"));
        }
    }
    ensure!(failures.is_empty(), "{}", failures.join("\n"));
    Ok(())
}

/// Runs a study in this program.
fn run(command: &[String]) -> Result<()> {
    let words = std::iter::once("studies".to_owned()).chain(command.iter().cloned());
    match crate::Flags::try_parse_from(words) {
        Ok(flags) => crate::run(&flags),
        Err(error) => bail!("{}: {error}", command.join(" ")),
    }
}

#[cfg(test)]
mod tests;

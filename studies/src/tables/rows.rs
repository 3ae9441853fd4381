//! Rows of tables: how they are found, kept as they are found, and found again as witnesses.
//!
//! A study adds each row by [`Measure::measure`]: the cells that name the row, and a closure that finds the others. So
//! a study can go on after it was stopped, and a few rows can be found again without the rest.

use std::cell::{Cell, OnceCell, RefCell};
use std::collections::BTreeMap;
use std::fmt::Display;
use std::fs::{self, OpenOptions};
use std::hash::{DefaultHasher, Hash, Hasher};
use std::io::Write;
use std::path::{Path, PathBuf};
use std::time::Instant;

use anyhow::{Context, Result, ensure};
use motile_cli::run::say;
use motile_tests::validation::Table;

/// Separator of the parts of a row in a file.
const TAB: char = '\t';

/// Names of a table and of a row in it.
type Name = [String; 2];

/// Cells of a row, and how long it took to find them (seconds).
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Found {
    pub(super) cells: String,
    pub(super) seconds: f64,
}

/// Rows that have been found in this run of the program or, of a study that goes on, before.
#[derive(Debug, Default)]
struct Rows {
    found: BTreeMap<Name, Found>,
    /// Where they are kept.
    path: Option<PathBuf>,
    wanted: Wanted,
}

/// The rows that are wanted.
#[derive(Debug, Default)]
enum Wanted {
    #[default]
    All,
    Only(Vec<Name>),
    /// The first rows of each table, so many at most, and no more after so many seconds.
    First(usize, f64),
}

thread_local! {
    /// Seconds that what other rows found saved this one.
    static SHARED: Cell<f64> = const { Cell::new(0.0) };
    static ROWS: RefCell<Rows> = RefCell::default();
}

/// Adds rows to a table.
pub(crate) trait Measure {
    /// Adds the row whose first cells are `name` and whose others `find` finds, cells separated by ` | `, if the row is
    /// wanted and was not found before.
    ///
    /// # Errors
    /// The errors of `find`; a row with this name exists.
    fn measure(&mut self, name: impl Display, find: impl FnOnce() -> Result<String>) -> Result<()>;
}

impl Measure for Table {
    fn measure(&mut self, name: impl Display, find: impl FnOnce() -> Result<String>) -> Result<()> {
        let name: Name = [self.title().to_owned(), name.to_string()];
        if !ROWS.with_borrow(|rows| rows.wants(&name)) {
            return Ok(());
        }
        ensure!(!self.has_row(&name[1]), "the table {:?} has two rows that are named {}", name[0], name[1]);
        let known = ROWS.with_borrow(|rows| rows.found.get(&name).cloned());
        let found = match known {
            Some(found) => found,
            None => {
                let started = Instant::now();
                SHARED.set(0.0);
                let cells = find()?;
                let found = Found { cells, seconds: started.elapsed().as_secs_f64() + SHARED.get() };
                ROWS.with_borrow_mut(|rows| rows.keep(name.clone(), &found))?;
                found
            }
        };
        self.row(format_args!("{} | {}", name[1], found.cells));
        Ok(())
    }
}

impl Rows {
    fn wants(&self, name: &Name) -> bool {
        match &self.wanted {
            Wanted::All => true,
            Wanted::Only(only) => only.contains(name),
            Wanted::First(most, longest) => {
                let own = self.found.iter().filter(|(other, _)| other[0] == name[0]);
                let seconds: Vec<f64> = own.map(|(_, found)| found.seconds).collect();
                seconds.len() < *most && seconds.iter().sum::<f64>() < *longest
            }
        }
    }

    fn keep(&mut self, name: Name, found: &Found) -> Result<()> {
        if let Some(path) = &self.path {
            say(format_args!("{} | {}", name[1], found.cells));
            let mut file = OpenOptions::new().create(true).append(true).open(path)?;
            writeln!(file, "{}{TAB}{}{TAB}{:.3}{TAB}{}", name[0], name[1], found.seconds, found.cells)
                .with_context(|| path.display().to_string())?;
        }
        self.found.insert(name, found.clone());
        Ok(())
    }
}

/// True if all rows are wanted, so that rows can be added that follow from others.
pub(crate) fn all_wanted() -> bool {
    ROWS.with_borrow(|rows| matches!(rows.wanted, Wanted::All))
}

/// How long it took to find a row (seconds); nothing if it was not found by [`Measure::measure`].
pub(super) fn seconds(table: &str, row: &str) -> Option<f64> {
    let name = [table.to_owned(), row.to_owned()];
    ROWS.with_borrow(|rows| rows.found.get(&name).map(|found| found.seconds))
}

/// Notes how long it took to find a row that is added by other means than [`Measure::measure`] (seconds).
pub(crate) fn took(table: &Table, row: &str, seconds: f64) {
    let name = [table.title().to_owned(), row.to_owned()];
    ROWS.with_borrow_mut(|rows| rows.found.insert(name, Found { cells: String::new(), seconds }));
}

/// Finds something that a row needs that is added by other means than [`Measure::measure`], and notes how long it took.
///
/// # Errors
/// The errors of `find`.
pub(crate) fn note<T>(table: &Table, row: &str, find: impl FnOnce() -> Result<T>) -> Result<T> {
    let started = Instant::now();
    SHARED.set(0.0);
    let found = find()?;
    took(table, row, started.elapsed().as_secs_f64() + SHARED.get());
    Ok(found)
}

/// Names of the rows of a table that were found.
pub(super) fn names(table: &str) -> Vec<String> {
    ROWS.with_borrow(|rows| rows.found.keys().filter(|name| name[0] == table).map(|name| name[1].clone()).collect())
}

/// From now on only these rows are wanted, each given by the title of its table and its name.
pub(super) fn want_only(only: Vec<Name>) {
    ROWS.set(Rows { wanted: Wanted::Only(only), ..Rows::default() });
}

/// From now on only the first rows of each table are wanted, at most so many, and no more after so many seconds.
pub(super) fn want_first(most: usize, seconds: f64) {
    ROWS.set(Rows { wanted: Wanted::First(most, seconds), ..Rows::default() });
}

/// True if the rows that were found are compared with those of another time.
pub(super) fn are_chosen() -> bool {
    ROWS.with_borrow(|rows| matches!(rows.wanted, Wanted::First(..)))
}

/// From now on all rows are wanted and are kept in a file. Rows that this program found before are in it already.
///
/// # Errors
/// A file that cannot be read or written.
pub(super) fn keep_in(path: &Path) -> Result<()> {
    let mut rows = Rows { path: Some(path.to_owned()), ..Rows::default() };
    let program = program()?;
    let text = fs::read_to_string(path).unwrap_or_default();
    let mut lines = text.lines();
    if lines.next() == Some(&program) {
        for line in lines {
            let parts: Vec<&str> = line.splitn(4, TAB).collect();
            // The last line of a program that was stopped may be half a line.
            let [table, name, seconds, cells] = parts[..] else { continue };
            let found = Found { cells: cells.to_owned(), seconds: seconds.parse()? };
            rows.found.insert([table.to_owned(), name.to_owned()], found);
        }
    } else {
        if let Some(folder) = path.parent() {
            motile_cli::run::make_directory(folder)?;
        }
        fs::write(path, program + "\n").with_context(|| path.display().to_string())?;
    }
    ROWS.set(rows);
    Ok(())
}

/// A number that another build of this program does not have.
pub(crate) fn program() -> Result<String> {
    let path = std::env::current_exe()?;
    let mut hasher = DefaultHasher::new();
    fs::read(&path).with_context(|| path.display().to_string())?.hash(&mut hasher);
    Ok(format!("{:016x}", hasher.finish()))
}

/// What several rows need, found when the first of them asks for it.
#[derive(Debug)]
pub(crate) struct Once<T>(OnceCell<(T, f64)>);

impl<T> Once<T> {
    pub(crate) fn new() -> Self {
        Self(OnceCell::new())
    }

    /// What `find` finds, the first time. Each row that asks counts the time that this took as its own, because it
    /// takes that time if the row is found alone.
    ///
    /// # Errors
    /// The errors of `find`.
    pub(crate) fn get(&self, find: impl FnOnce() -> Result<T>) -> Result<&T> {
        if let Some((found, seconds)) = self.0.get() {
            SHARED.set(SHARED.get() + seconds);
            return Ok(found);
        }
        let started = Instant::now();
        let found = find()?;
        Ok(&self.0.get_or_init(|| (found, started.elapsed().as_secs_f64())).0)
    }
}

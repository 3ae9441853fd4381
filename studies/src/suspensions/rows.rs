//! Rows of tables that are kept in a file as they are found.

use std::collections::BTreeMap;
use std::fs::{self, OpenOptions};
use std::io::Write;
use std::path::{Path, PathBuf};

use anyhow::{Context, Result};
use motile_cli::run::say;

/// Separator of the name of a row from its values, and of these from one another.
const TAB: char = '\t';

/// Rows by their names.
#[derive(Debug, Default)]
pub(super) struct Rows {
    path: Option<PathBuf>,
    found: BTreeMap<String, Vec<String>>,
}

impl Rows {
    /// The rows of a file, which need not be there yet; without one nothing is kept.
    pub(super) fn open(path: Option<&Path>) -> Result<Self> {
        let mut rows = Self { path: path.map(Path::to_owned), ..Self::default() };
        let Some(path) = path.filter(|path| path.exists()) else { return Ok(rows) };
        for line in fs::read_to_string(path).with_context(|| path.display().to_string())?.lines() {
            let mut parts = line.split(TAB).map(str::to_owned);
            let name = parts.next().unwrap_or_default();
            rows.found.insert(name, parts.collect());
        }
        Ok(rows)
    }

    /// The row of that name, which `make` finds if it is not there.
    pub(super) fn row(&mut self, name: &str, make: impl FnOnce() -> Result<Vec<String>>) -> Result<Vec<String>> {
        if let Some(row) = self.found.get(name) {
            return Ok(row.clone());
        }
        let row = make()?;
        say(row.join("  "));
        if let Some(path) = &self.path {
            let mut file = OpenOptions::new().create(true).append(true).open(path)?;
            let line: String = [name].into_iter().chain(row.iter().map(String::as_str)).collect::<Vec<_>>().join("\t");
            writeln!(file, "{line}").with_context(|| path.display().to_string())?;
        }
        self.found.insert(name.to_owned(), row.clone());
        Ok(row)
    }
}

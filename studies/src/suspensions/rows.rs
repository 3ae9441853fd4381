//! Rows of tables that are kept in a file as they are found.

use std::collections::BTreeMap;
use std::fs::{self, OpenOptions};
use std::io::Write;
use std::path::{Path, PathBuf};

use anyhow::{Context, Result};
use motile_cli::run::say;

/// Separator of the name of a row from its cells.
const TAB: char = '\t';

/// Rows of a [`motile_tests::validation::Table`] by their names.
#[derive(Debug, Default)]
pub(super) struct Rows {
    path: Option<PathBuf>,
    found: BTreeMap<String, String>,
}

impl Rows {
    /// The rows of a file, which need not be there yet; without one nothing is kept.
    pub(super) fn open(path: Option<&Path>) -> Result<Self> {
        let mut rows = Self { path: path.map(Path::to_owned), ..Self::default() };
        let Some(path) = path.filter(|path| path.exists()) else { return Ok(rows) };
        for line in fs::read_to_string(path).with_context(|| path.display().to_string())?.lines() {
            let (name, row) = line.split_once(TAB).unwrap_or((line, ""));
            rows.found.insert(name.to_owned(), row.to_owned());
        }
        Ok(rows)
    }

    /// The row of that name, which `make` finds if it is not there.
    pub(super) fn row(&mut self, name: &str, make: impl FnOnce() -> Result<String>) -> Result<String> {
        if let Some(row) = self.found.get(name) {
            return Ok(row.clone());
        }
        let row = make()?;
        say(&row);
        if let Some(path) = &self.path {
            let mut file = OpenOptions::new().create(true).append(true).open(path)?;
            writeln!(file, "{name}{TAB}{row}").with_context(|| path.display().to_string())?;
        }
        self.found.insert(name.to_owned(), row.clone());
        Ok(row)
    }
}

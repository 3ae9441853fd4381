//! What was measured over time, as a table in memory and as a CSV file.

use std::{fs::File, path::Path};

use anyhow::{Context, Result, ensure};

/// Rows of named numbers, written to a CSV file as they come and kept for plots.
#[derive(Debug)]
pub struct Trajectory {
    names: Vec<String>,
    rows: Vec<Vec<f64>>,
    file: csv::Writer<File>,
}

impl Trajectory {
    /// Opens the file and writes its header.
    ///
    /// # Errors
    /// No names, the same name twice, or a file that cannot be written.
    pub fn create(path: &Path, names: &[&str]) -> Result<Self> {
        let different = names.iter().enumerate().all(|(k, name)| !names[..k].contains(name));
        ensure!(!names.is_empty() && different, "columns {names:?} are not distinct names");
        let open = || -> Result<csv::Writer<File>> {
            let mut file = csv::Writer::from_path(path)?;
            file.write_record(names)?;
            Ok(file)
        };
        let file = open().with_context(|| format!("writing {}", path.display()))?;
        Ok(Self { names: names.iter().map(ToString::to_string).collect(), rows: Vec::new(), file })
    }

    /// Adds a row, in the order of the names. Numbers that are not finite become empty fields of the file.
    ///
    /// # Errors
    /// The wrong number of values, or a file that cannot be written.
    pub fn push(&mut self, row: &[f64]) -> Result<()> {
        ensure!(row.len() == self.names.len(), "{} values for {} columns", row.len(), self.names.len());
        let field = |v: &f64| if v.is_finite() { v.to_string() } else { String::new() };
        self.file.write_record(row.iter().map(field)).context("writing a row of the trajectory")?;
        self.rows.push(row.to_vec());
        Ok(())
    }

    /// Number of rows.
    #[must_use]
    pub fn len(&self) -> usize {
        self.rows.len()
    }

    /// Whether there are no rows yet.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.rows.is_empty()
    }

    /// The points of column `y` over column `x`, for plots.
    ///
    /// # Errors
    /// A name that is not among the columns.
    pub fn curve(&self, x: &str, y: &str) -> Result<Vec<(f64, f64)>> {
        let (x, y) = (self.index(x)?, self.index(y)?);
        Ok(self.rows.iter().map(|row| (row[x], row[y])).collect())
    }

    /// The values of a column.
    ///
    /// # Errors
    /// A name that is not among the columns.
    pub fn column(&self, name: &str) -> Result<Vec<f64>> {
        let index = self.index(name)?;
        Ok(self.rows.iter().map(|row| row[index]).collect())
    }

    fn index(&self, name: &str) -> Result<usize> {
        let found = self.names.iter().position(|n| n == name);
        found.with_context(|| format!("no column {name:?} among {:?}", self.names))
    }

    /// Makes sure that all rows are in the file.
    ///
    /// # Errors
    /// A file that cannot be written.
    pub fn flush(&mut self) -> Result<()> {
        self.file.flush().context("writing the trajectory")
    }
}

#[cfg(test)]
mod tests;

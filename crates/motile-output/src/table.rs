//! What was measured over time, as a table in memory and as a CSV file.

use std::{
    fs::File,
    io::{self, LineWriter, Write as _},
    path::{Path, PathBuf},
};

use crate::Error;

/// Rows of named numbers, written to a CSV file as they come, each at once, and kept for plots.
///
/// ```
/// use motile_output::CsvTable;
///
/// let path = std::env::temp_dir().join("decay.csv");
/// let mut table = CsvTable::create(&path, &["time", "value"])?;
/// table.push(&[0.0, 1.0])?;
/// table.push(&[1.0, f64::NAN])?;
/// table.flush()?;
/// assert_eq!(std::fs::read_to_string(&path).unwrap(), "time,value\n0,1\n1,\n");
/// # std::fs::remove_file(&path).unwrap();
/// # Ok::<(), motile_output::Error>(())
/// ```
#[derive(Debug)]
pub struct CsvTable {
    names: Vec<String>,
    rows: Vec<Vec<f64>>,
    file: LineWriter<File>,
    path: PathBuf,
}

impl CsvTable {
    /// Opens the file and writes its header.
    ///
    /// # Errors
    /// [`Error::Name`]: an empty name, one given twice, or one with a comma, a quotation mark or the end of a line.
    /// [`Error::Write`].
    pub fn create(path: impl AsRef<Path>, names: &[&str]) -> Result<Self, Error> {
        for (k, name) in names.iter().enumerate() {
            if name.is_empty() || name.contains([',', '"', '\n', '\r']) || names[..k].contains(name) {
                return Err(Error::Name { name: (*name).to_string(), what: "a column" });
            }
        }
        let path = path.as_ref().to_path_buf();
        let open = || -> io::Result<LineWriter<File>> {
            let mut file = LineWriter::new(File::create(&path)?);
            writeln!(file, "{}", names.join(","))?;
            Ok(file)
        };
        let file = open().map_err(Error::writing(&path))?;
        Ok(Self { names: names.iter().map(ToString::to_string).collect(), rows: Vec::new(), file, path })
    }

    /// As [`CsvTable::create`], but goes on with the rows of the file whose first value is at most `from`, if it is a
    /// table of the same columns: for what is resumed.
    ///
    /// # Errors
    /// As [`CsvTable::create`].
    pub fn resume(path: impl AsRef<Path>, names: &[&str], from: f64) -> Result<Self, Error> {
        let text = std::fs::read_to_string(&path).unwrap_or_default();
        let mut lines = text.lines();
        let same = lines.next() == Some(names.join(",").as_str());
        let number = |field: &str| field.parse().unwrap_or(f64::NAN);
        let rows = lines.map(|line| line.split(',').map(number).collect::<Vec<f64>>());
        let mut table = Self::create(path, names)?;
        for row in rows.filter(|row| same && row.len() == names.len() && row[0] <= from) {
            table.push(&row)?;
        }
        Ok(table)
    }

    /// Adds a row, in the order of the names. Numbers that are not finite become empty fields of the file.
    ///
    /// # Errors
    /// [`Error::Count`], [`Error::Write`].
    pub fn push(&mut self, row: &[f64]) -> Result<(), Error> {
        Error::check_count("values of a row", row.len(), self.names.len())?;
        let field = |v: &f64| if v.is_finite() { v.to_string() } else { String::new() };
        let fields: Vec<String> = row.iter().map(field).collect();
        writeln!(self.file, "{}", fields.join(",")).map_err(Error::writing(&self.path))?;
        self.rows.push(row.to_vec());
        Ok(())
    }

    /// The rows so far.
    #[must_use]
    pub fn rows(&self) -> &[Vec<f64>] {
        &self.rows
    }

    /// The points of column `y` over column `x`, for plots.
    ///
    /// # Errors
    /// [`Error::Column`].
    pub fn curve(&self, x: &str, y: &str) -> Result<Vec<(f64, f64)>, Error> {
        let index = |name: &str| {
            let missing = || Error::Column { name: name.to_string(), known: self.names.clone() };
            self.names.iter().position(|n| n == name).ok_or_else(missing)
        };
        let (x, y) = (index(x)?, index(y)?);
        Ok(self.rows.iter().map(|row| (row[x], row[y])).collect())
    }

    /// Makes sure that all rows are in the file.
    ///
    /// # Errors
    /// [`Error::Write`].
    pub fn flush(&mut self) -> Result<(), Error> {
        self.file.flush().map_err(Error::writing(&self.path))
    }
}

#[cfg(test)]
mod tests;

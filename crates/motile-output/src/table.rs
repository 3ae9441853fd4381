//! Tables of numbers, in memory and as CSV files.

use std::{
    fs::File,
    io::{self, LineWriter, Write as _},
    path::{Path, PathBuf},
};

use motile::scene::{Hydrodynamics, System};

use crate::OutputError;

/// Table of named columns of numbers: each row is written to a CSV file at once, and kept for plots.
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
/// # Ok::<(), motile_output::OutputError>(())
/// ```
#[derive(Debug)]
pub struct CsvTable {
    names: Vec<String>,
    rows: Vec<Vec<f64>>,
    file: LineWriter<File>,
    path: PathBuf,
    kept: Option<Kept>,
    origin: String,
}

/// Record of the rows in the system whose run the table is of, which checkpoints hold.
#[derive(Debug)]
struct Kept {
    name: String,
    /// Time from which the run was resumed, whose state has a row or was not due for one.
    from: Option<f64>,
}

impl CsvTable {
    /// Creates a table with a new file, which gets the header.
    ///
    /// # Errors
    /// Returns [`OutputError::Name`] for an empty name, one given twice, or one with a comma, a quotation mark or the
    /// end of a line. [`OutputError::Write`].
    pub fn create(path: impl AsRef<Path>, names: &[&str]) -> Result<Self, OutputError> {
        Self::with_origin(path, names, "")
    }

    /// Creates a table as [`CsvTable::create`] does. The file holds the origin of the results ([`System::origin`]) in
    /// the first row of a last column `origin`, unless the origin is empty. Commas of the origin become semicolons, so
    /// that programs can read the table that do not know quoted fields.
    ///
    /// # Errors
    /// Returns the errors of [`CsvTable::create`].
    pub fn with_origin(path: impl AsRef<Path>, names: &[&str], origin: &str) -> Result<Self, OutputError> {
        for (k, name) in names.iter().enumerate() {
            if name.is_empty() || name.contains([',', '"', '\n', '\r']) || names[..k].contains(name) {
                return Err(OutputError::Name { name: (*name).to_string(), what: "a column" });
            }
        }
        let path = path.as_ref().to_path_buf();
        let open = || -> io::Result<LineWriter<File>> {
            let mut file = LineWriter::new(File::create(&path)?);
            writeln!(file, "{}{}", names.join(","), if origin.is_empty() { "" } else { ",origin" })?;
            Ok(file)
        };
        let file = open().map_err(OutputError::writing(&path))?;
        let (names, origin) = (names.iter().map(ToString::to_string).collect(), origin.to_owned());
        Ok(Self { names, rows: Vec::new(), file, path, kept: None, origin })
    }

    /// Creates a table as by [`CsvTable::create`], with the rows that the file has if it is a table of the same
    /// columns. The file gets the origin that [`CsvTable::with_origin`] writes.
    ///
    /// # Errors
    /// Returns the errors of [`CsvTable::create`].
    pub fn resume(path: impl AsRef<Path>, names: &[&str], origin: &str) -> Result<Self, OutputError> {
        let text = std::fs::read_to_string(&path).unwrap_or_default();
        let mut lines = text.lines();
        let head = names.join(",");
        let same = lines.next().is_some_and(|line| line.strip_suffix(",origin").unwrap_or(line) == head);
        let number = |field: &str| field.parse().unwrap_or(f64::NAN);
        let rows = lines.map(|line| line.split(',').take(names.len()).map(number).collect::<Vec<f64>>());
        let mut table = Self::with_origin(path, names, origin)?;
        for row in rows.filter(|row| same && row.len() == names.len()) {
            table.push(&row)?;
        }
        Ok(table)
    }

    /// Creates a table as by [`CsvTable::create`] for a run of `system`, the first column being the time. The system
    /// keeps the rows as the record `name`, and so do checkpoints. The table of a resumed run begins with the rows so
    /// far, and the others follow as if the run had not been interrupted. A last column `origin` holds the origin of
    /// the results ([`System::origin`]) in its first row, unless it is empty.
    ///
    /// # Errors
    /// Returns the errors of [`CsvTable::create`].
    pub fn of_run<H: Hydrodynamics>(
        path: impl AsRef<Path>,
        names: &[&str],
        system: &mut System<H>,
        name: &str,
    ) -> Result<Self, OutputError> {
        let (time, origin) = (system.time(), system.origin().to_owned());
        let record = system.record_mut(name);
        let mut table = Self::with_origin(path, names, &origin)?;
        if time > 0.0 && record.texts == table.names {
            for row in record.numbers.chunks_exact(names.len()).filter(|row| row[0] <= time) {
                table.push(row)?;
            }
        }
        record.texts.clone_from(&table.names);
        record.numbers = table.rows.concat();
        table.kept = Some(Kept { name: name.to_owned(), from: (!table.rows.is_empty()).then_some(time) });
        Ok(table)
    }

    /// Adds a row for the present state of the system, unless the run was resumed from that state, which has its row or
    /// was not due for one.
    ///
    /// # Errors
    /// Returns the errors of [`CsvTable::push`].
    pub fn push_state<H: Hydrodynamics>(&mut self, system: &mut System<H>, row: &[f64]) -> Result<(), OutputError> {
        self.push_rows(system, &[row])
    }

    /// Adds rows for the present state of the system, as [`CsvTable::push_state`] adds one.
    ///
    /// # Errors
    /// Returns the errors of [`CsvTable::push`].
    pub(crate) fn push_rows<H: Hydrodynamics>(
        &mut self,
        system: &mut System<H>,
        rows: &[impl AsRef<[f64]>],
    ) -> Result<(), OutputError> {
        let width = self.names.len();
        if let Some(Kept { name, from }) = &self.kept {
            let counts = rows.iter().map(|row| row.as_ref().len());
            counts.into_iter().try_for_each(|count| OutputError::check_count("values of a row", count, width))?;
            if from.is_some_and(|from| from >= system.time()) {
                return Ok(());
            }
            let (time, kept) = (system.time(), &mut system.record_mut(name).numbers);
            // Another table may be of the same run.
            if kept.chunks_exact(width).last().is_none_or(|last| last[0] < time) {
                rows.iter().for_each(|row| kept.extend(row.as_ref()));
            }
        }
        rows.iter().try_for_each(|row| self.push(row.as_ref()))
    }

    /// Adds a row, in the order of the columns. Numbers that are not finite become empty fields of the file.
    ///
    /// # Errors
    /// Returns [`OutputError::Count`], [`OutputError::Write`].
    pub fn push(&mut self, row: &[f64]) -> Result<(), OutputError> {
        OutputError::check_count("values of a row", row.len(), self.names.len())?;
        // Without what has a meaning in such files: not all programs that read them know quoted fields.
        let origin = match (self.origin.as_str(), self.rows.len()) {
            ("", _) => String::new(),
            (text, 0) => format!(",{}", text.replace(',', ";").replace('"', "'").replace('#', " ")),
            _ => ",".to_owned(),
        };
        writeln!(self.file, "{}{origin}", Self::line(row)).map_err(OutputError::writing(&self.path))?;
        self.rows.push(row.to_vec());
        Ok(())
    }

    /// Returns a row from values by the names of their columns; not a number in the others.
    ///
    /// # Errors
    /// Returns [`OutputError::Column`] for a name that is not a column.
    pub(crate) fn row<'a>(&self, values: impl Iterator<Item = (&'a str, f64)>) -> Result<Vec<f64>, OutputError> {
        let mut row = vec![f64::NAN; self.names.len()];
        for (name, value) in values {
            row[self.index(name)?] = value;
        }
        Ok(row)
    }

    /// Returns the number of a column.
    fn index(&self, name: &str) -> Result<usize, OutputError> {
        let missing = || OutputError::Column { name: name.to_string(), known: self.names.clone() };
        self.names.iter().position(|n| n == name).ok_or_else(missing)
    }

    /// Returns the line of a file for a row, without its end. Numbers that are not finite become empty fields.
    #[must_use]
    pub fn line(row: &[f64]) -> String {
        let field = |v: &f64| if v.is_finite() { v.to_string() } else { String::new() };
        row.iter().map(field).collect::<Vec<String>>().join(",")
    }

    /// Returns the origin of the results that the file holds; empty if it holds none.
    #[must_use]
    pub fn origin(&self) -> &str {
        &self.origin
    }

    /// Returns the rows so far.
    #[must_use]
    pub fn rows(&self) -> &[Vec<f64>] {
        &self.rows
    }

    /// Returns the points of column `y` over column `x`, for plots.
    ///
    /// # Errors
    /// Returns [`OutputError::Column`] for a table without one of the columns.
    pub fn curve(&self, x: &str, y: &str) -> Result<Vec<(f64, f64)>, OutputError> {
        let (x, y) = (self.index(x)?, self.index(y)?);
        Ok(self.rows.iter().map(|row| (row[x], row[y])).collect())
    }

    /// Writes all rows that are still buffered to the file.
    ///
    /// # Errors
    /// Returns [`OutputError::Write`] if the file cannot be written.
    pub fn flush(&mut self) -> Result<(), OutputError> {
        self.file.flush().map_err(OutputError::writing(&self.path))
    }
}

#[cfg(test)]
mod tests;

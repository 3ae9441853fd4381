//! Reference values, from `tests/reference`, whose README says where they come from.

use anyhow::{Context, anyhow};

use crate::validation::StudyError;

/// The rows of a reference file.
#[derive(Debug, Clone)]
pub struct Reference {
    header: csv::StringRecord,
    rows: Vec<csv::StringRecord>,
}

impl Reference {
    /// Reads a file by its name without `.csv`.
    ///
    /// # Errors
    /// No such file, or one that is not CSV.
    pub fn read(name: &str) -> Result<Self, StudyError> {
        let path = format!("{}/reference/{name}.csv", env!("CARGO_MANIFEST_DIR"));
        let mut reader = csv::Reader::from_path(&path).context(path)?;
        Ok(Self { header: reader.headers()?.clone(), rows: reader.records().collect::<Result<_, _>>()? })
    }

    /// Keeps the rows whose column `name` reads `value`.
    #[must_use]
    pub fn select(mut self, name: &str, value: &str) -> Self {
        let column = self.header.iter().position(|h| h == name);
        self.rows.retain(|row| column.and_then(|c| row.get(c)) == Some(value));
        self
    }

    /// Its rows, each alone.
    pub fn rows(&self) -> impl Iterator<Item = Self> + '_ {
        self.rows.iter().map(|row| Self { header: self.header.clone(), rows: vec![row.clone()] })
    }

    /// The numbers of a column.
    ///
    /// # Errors
    /// No such column, or one that does not hold numbers.
    pub fn column(&self, name: &str) -> Result<Vec<f64>, StudyError> {
        let missing = || anyhow!("no numbers in column {name}");
        let index = self.header.iter().position(|h| h == name).ok_or_else(missing)?;
        self.rows.iter().map(|row| row.get(index).and_then(|v| v.trim().parse().ok()).ok_or_else(missing)).collect()
    }

    /// The number of a column in the first row.
    ///
    /// # Errors
    /// As [`Reference::column`], and no rows.
    pub fn value(&self, name: &str) -> Result<f64, StudyError> {
        let first = self.column(name)?.first().copied();
        first.with_context(|| format!("no rows with {name}"))
    }
}

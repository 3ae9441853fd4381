//! Tables of measurements.

use std::fmt;

/// A table with a title.
///
/// ```
/// use motile_tests::validation::Table;
///
/// let mut table = Table::new("Errors", "h | error in %");
/// table.row(format_args!("{} | {:.2}, of the mean", 0.1, 0.134));
/// assert_eq!(table.csv(), "# Errors\nh,error in %\n0.1,\"0.13, of the mean\"\n");
/// ```
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Table {
    title: String,
    header: Vec<String>,
    rows: Vec<Vec<String>>,
}

impl Table {
    /// An empty table, its columns separated by ` | `.
    #[must_use]
    pub fn new(title: &str, columns: &str) -> Self {
        Self { title: title.to_owned(), header: Self::cells(columns), rows: Vec::new() }
    }

    /// Adds a row, its cells separated by ` | `.
    pub fn row(&mut self, text: fmt::Arguments<'_>) {
        self.rows.push(Self::cells(&text.to_string()));
    }

    /// Adds a row from its cells.
    pub fn push<S: Into<String>>(&mut self, row: impl IntoIterator<Item = S>) {
        self.rows.push(row.into_iter().map(Into::into).collect());
    }

    /// Returns the title.
    #[must_use]
    pub fn title(&self) -> &str {
        &self.title
    }

    /// Returns the rows in their order, each with its cells.
    #[must_use]
    pub fn rows(&self) -> &[Vec<String>] {
        &self.rows
    }

    /// Returns true if a row begins with these cells, separated by ` | `.
    #[must_use]
    pub fn has_row(&self, name: &str) -> bool {
        let first = Self::cells(name);
        self.rows.iter().any(|row| row.starts_with(&first))
    }

    /// Splits a text at ` | ` into cells.
    #[must_use]
    pub fn cells(text: &str) -> Vec<String> {
        text.split(" | ").map(|cell| cell.trim().to_owned()).collect()
    }

    /// The table as CSV, its title in a comment.
    #[must_use]
    pub fn csv(&self) -> String {
        let field = |text: &String| match text.contains([',', '"']) {
            true => format!("\"{}\"", text.replace('"', "\"\"")),
            false => text.clone(),
        };
        let line = |row: &Vec<String>| row.iter().map(field).collect::<Vec<_>>().join(",") + "\n";
        let rows: String = std::iter::once(&self.header).chain(&self.rows).map(line).collect();
        format!("# {}\n{rows}", self.title)
    }
}

impl fmt::Display for Table {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        writeln!(f, "{}", self.title)?;
        std::iter::once(&self.header).chain(&self.rows).try_for_each(|row| writeln!(f, "{}", row.join(" | ")))
    }
}

//! Tables of measurements, in Markdown and as CSV.

use std::fmt;

/// A table with a title, printed as Markdown.
///
/// ```
/// use motile_tests::validation::Table;
///
/// let mut table = Table::new("Errors", &["h", "error in %"]);
/// table.push(["0.1", "0.13, of the mean"]);
/// assert_eq!(table.csv(), "# Errors\nh,error in %\n0.1,\"0.13, of the mean\"\n");
/// ```
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Table {
    title: String,
    header: Vec<String>,
    rows: Vec<Vec<String>>,
}

impl Table {
    /// An empty table.
    #[must_use]
    pub fn new(title: &str, header: &[&str]) -> Self {
        Self { title: title.to_owned(), header: header.iter().map(ToString::to_string).collect(), rows: Vec::new() }
    }

    /// Adds a row.
    pub fn push<S: Into<String>>(&mut self, row: impl IntoIterator<Item = S>) {
        self.rows.push(row.into_iter().map(Into::into).collect());
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
        writeln!(f, "### {}\n", self.title)?;
        writeln!(f, "| {} |", self.header.join(" | "))?;
        writeln!(f, "|{}", "---|".repeat(self.header.len()))?;
        for row in &self.rows {
            writeln!(f, "| {} |", row.join(" | "))?;
        }
        Ok(())
    }
}

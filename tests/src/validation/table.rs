//! Tables of measurements, in Markdown and as CSV.

use std::fmt;

/// A table with a title, printed as Markdown: what stands behind a colon in the title is a sentence below the heading.
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
        let (heading, values) = self.title.split_once(": ").unwrap_or((&self.title, ""));
        writeln!(f, "### {heading}\n")?;
        let mut letters = values.chars();
        if let Some(first) = letters.next() {
            writeln!(f, "{}\n", wrapped(&format!("{}{}.", first.to_uppercase(), letters.as_str())))?;
        }
        writeln!(f, "| {} |", self.header.join(" | "))?;
        writeln!(f, "|{}", "---|".repeat(self.header.len()))?;
        for row in &self.rows {
            writeln!(f, "| {} |", row.join(" | "))?;
        }
        Ok(())
    }
}

/// A text in lines of at most 120 columns.
fn wrapped(text: &str) -> String {
    let mut lines = String::new();
    let mut column = 0;
    for word in text.split(' ') {
        let length = word.chars().count();
        let separator = if column == 0 {
            ""
        } else if column + 1 + length > 120 {
            "\n"
        } else {
            " "
        };
        column = if separator == " " { column + 1 + length } else { length };
        lines += separator;
        lines += word;
    }
    lines
}

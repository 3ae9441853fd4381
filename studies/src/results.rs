//! The results of many runs as a table.

use std::path::Path;

use anyhow::{Context, Result};
use motile_examples::Summary;
use serde_json::Value;

/// Writes a table of results, one a row, to a CSV file; the columns are those of the first. Lists and objects are
/// written as in `summary.json`, `null` as nothing.
///
/// # Errors
/// The file cannot be written.
pub(crate) fn write_results(path: &Path, results: &[Summary]) -> Result<()> {
    let names: Vec<&String> = results.first().map(|first| first.values().keys().collect()).unwrap_or_default();
    let field = |summary: &Summary, name: &str| match summary.values().get(name) {
        None | Some(Value::Null) => String::new(),
        Some(Value::String(text)) => text.clone(),
        Some(value) => value.to_string(),
    };
    let write = || -> Result<()> {
        let mut file = csv::Writer::from_path(path)?;
        file.write_record(&names)?;
        for summary in results {
            file.write_record(names.iter().map(|name| field(summary, name)))?;
        }
        Ok(file.flush()?)
    };
    write().with_context(|| format!("writing {}", path.display()))
}

#[cfg(test)]
mod tests;

//! Results of a run, as a JSON file and as a table of text.

use std::{collections::HashMap, fmt::Write as _, fs, path::Path};

use anyhow::{Context, Result};
use serde_json::{Map, Value};

/// Entry of a written summary with the version of the program.
pub(crate) const VERSION_KEY: &str = "motile_version";

/// Entry of a written summary with the origin of its results; the table leaves it out.
pub(crate) const ORIGIN_KEY: &str = "origin";

/// Named results in the order they are put in, written as `summary.json` and printed as a table.
///
/// ```
/// use motile_cli::run::Summary;
///
/// let mut summary = Summary::default();
/// summary.put("speed", 0.138_612_3, "of the centroid (length/time)");
/// summary.put("beta", f64::NAN, "B2/|B1|");
/// assert_eq!(summary.json(), "{\n  \"speed\": 0.1386123,\n  \"beta\": null\n}\n");
/// assert!(summary.table().contains("speed  0.138612     of the centroid (length/time)"));
/// ```
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Summary {
    values: Map<String, Value>,
    about: HashMap<String, String>,
}

impl Summary {
    /// Adds a result, or replaces the one of this name: a number (`null` if it is not finite), integer, flag, text,
    /// list or `serde_json::json!` value, and a few words about it for the table.
    pub fn put(&mut self, name: &str, value: impl Into<Value>, about: &str) {
        self.values.insert(name.to_string(), value.into());
        self.about.insert(name.to_string(), about.into());
    }

    /// Returns the results by name.
    #[must_use]
    pub fn values(&self) -> &Map<String, Value> {
        &self.values
    }

    /// Returns the text of `summary.json`.
    #[must_use]
    pub fn json(&self) -> String {
        // `{:#}` of a JSON value is its indented form.
        format!("{:#}\n", Value::Object(self.values.clone()))
    }

    /// Returns the table of the results: names, values to six figures, remarks.
    #[must_use]
    pub fn table(&self) -> String {
        let shown_rows = self.values.iter().filter(|(name, _)| *name != ORIGIN_KEY);
        let rows = || shown_rows.clone().map(|(name, value)| (name, shown(value), self.about.get(name)));
        let names = rows().map(|(name, ..)| name.chars().count()).max().unwrap_or(0);
        // A long value, such as a list, would push all remarks to the right.
        let values = rows().map(|(_, value, _)| value.chars().count()).max().unwrap_or(0).min(14);
        let mut table = String::new();
        for (name, value, about) in rows() {
            let about = about.map_or("", String::as_str);
            let line = format!("  {name:<names$}  {value:<values$}  {about}");
            // Writing to a string cannot fail.
            let _ = writeln!(table, "{}", line.trim_end());
        }
        table
    }

    /// Returns the version of the program that wrote a summary. It is `None` for one that was not read from a file, or
    /// of a time before versions were written.
    #[must_use]
    pub fn version(&self) -> Option<&str> {
        self.values.get(VERSION_KEY).and_then(Value::as_str)
    }

    /// Writes `summary.json`, with the version of the program ([`motile::VERSION`]) at its end. The file appears only
    /// when it is complete, so that its presence means a finished run.
    ///
    /// # Errors
    /// Returns an error for a file that cannot be written.
    pub fn write(&self, path: &Path) -> Result<()> {
        let partial = path.with_extension("json.part");
        let mut whole = self.clone();
        whole.put(VERSION_KEY, motile::VERSION, "");
        fs::write(&partial, whole.json())
            .and_then(|()| fs::rename(&partial, path))
            .with_context(|| format!("writing {}", path.display()))
    }

    /// Returns the results from the `summary.json` of a finished run; `None` if the file does not exist.
    ///
    /// # Errors
    /// Returns an error for a file that cannot be read or does not hold a JSON object.
    pub fn read(path: &Path) -> Result<Option<Self>> {
        if !path.exists() {
            return Ok(None);
        }
        let read = || -> Result<Map<String, Value>> { Ok(serde_json::from_str(&fs::read_to_string(path)?)?) };
        let values = read().with_context(|| format!("reading {}", path.display()))?;
        Ok(Some(Self { values, about: HashMap::new() }))
    }

    /// Returns the number among the results; not a number if there is none of that name.
    #[must_use]
    pub fn number(&self, name: &str) -> f64 {
        self.values.get(name).and_then(Value::as_f64).unwrap_or(f64::NAN)
    }
}

/// Returns the value as text for the table.
fn shown(value: &Value) -> String {
    match value {
        Value::Null => "not defined".into(),
        Value::Bool(flag) => if *flag { "yes" } else { "no" }.into(),
        Value::String(text) => text.clone(),
        Value::Number(number) => match number.as_f64() {
            Some(v) if !number.is_f64() => format!("{v}"),
            Some(v) => six_figures(v),
            None => number.to_string(),
        },
        Value::Array(items) => items.iter().map(shown).collect::<Vec<_>>().join(", "),
        Value::Object(map) => map.iter().map(|(k, v)| format!("{k}: {}", shown(v))).collect::<Vec<_>>().join(", "),
    }
}

/// Returns the number to six significant figures.
fn six_figures(value: f64) -> String {
    let magnitude = if value == 0.0 { 0 } else { value.abs().log10().floor() as i32 };
    if !(-4..9).contains(&magnitude) {
        return format!("{value:.5e}");
    }
    let text = format!("{value:.*}", (5 - magnitude).max(0) as usize);
    if text.contains('.') { text.trim_end_matches('0').trim_end_matches('.').to_string() } else { text }
}

/// Writes the results of several runs to a CSV file, a row for each, with the names of the first as columns. Lists and
/// objects are written as in `summary.json`, `null` as an empty field.
///
/// # Errors
/// Returns an error for a file that cannot be written.
pub fn write_results(path: &Path, results: &[Summary]) -> Result<()> {
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

/// Creates a directory and those above it.
///
/// # Errors
/// Returns an error for a directory that cannot be created.
pub fn make_directory(path: &Path) -> Result<()> {
    fs::create_dir_all(path).with_context(|| format!("making {}", path.display()))
}

#[cfg(test)]
mod tests;

//! Pages that show parts of tables and scenes.
//!
//! `studies -- pages` fills what stands between two comments of a page: a part of a table ([`crate::tables`]), or the
//! animation and the text of a scene in `examples/scenes`, after
//!
//! ```text
//! <!-- scene NAME -->
//! <!-- end of scene -->
//! ```
//!
//! `studies -- pages --check` and a test compare. The page of all keys of a scene is written too
//! ([`crate::scene_keys`]).

use std::fs;

use anyhow::{Context, Result, bail, ensure};
use clap::Args;
use motile_cli::run::say;

use crate::tables::{comment, file, name, pages_of};

/// Tables that stand in pages.
const BEGIN: &str = "<!-- table ";
const END: &str = "<!-- end of table -->";
const SCENE: &str = "<!-- scene ";
const END_OF_SCENE: &str = "<!-- end of scene -->";

/// Fills the tables of the pages from docs/tables, writes the page of keys and the pages of the book, checks links and
/// formulas.
#[derive(Debug, Args)]
pub(crate) struct PagesFlags {
    /// Change nothing; fail if a page shows something else than the files have
    #[arg(long)]
    pub(crate) check: bool,
}

pub(crate) fn pages(flags: &PagesFlags) -> Result<()> {
    for path in pages_of()? {
        let text = fs::read_to_string(&path)?;
        let filled = filled(&text, &|name| Ok(fs::read_to_string(file(name, 0))?))
            .and_then(|text| with_scenes(&text, &|name| crate::animations::text(name)))
            .with_context(|| path.display().to_string())?;
        if filled == text {
            continue;
        }
        ensure!(!flags.check, "{}: its tables are not those of docs/tables: run `studies -- pages`", path.display());
        fs::write(&path, filled)?;
        say(format_args!("{} is updated", name(&path)));
    }
    crate::scene_keys::page(flags.check)?;
    crate::book::pages(flags.check)?;
    crate::site::check()
}

/// A page with its tables filled from the files that `read` gives by name.
fn filled(page: &str, read: &dyn Fn(&str) -> Result<String>) -> Result<String> {
    let mut out = String::new();
    let mut lines = page.lines();
    while let Some(line) = lines.next() {
        out.push_str(line);
        out.push('\n');
        let Some(first) = line.strip_prefix(BEGIN) else { continue };
        let request = comment(
            first,
            lines.by_ref().inspect(|more| {
                out.push_str(more);
                out.push('\n');
            }),
        )?;
        ensure!(lines.any(|line| line == END), "no '{END}' after: {line}");
        out.push_str(&shown(&request, read).with_context(|| line.to_owned())?);
        out.push_str(END);
        out.push('\n');
    }
    Ok(out)
}

/// A page with its scenes filled with what `read` gives by name.
fn with_scenes(page: &str, read: &dyn Fn(&str) -> Result<String>) -> Result<String> {
    let mut out = String::new();
    let mut rest = page;
    while let Some((before, after)) = rest.split_once(SCENE) {
        let (name, after) = after.split_once(" -->").with_context(|| format!("no '-->' after: {SCENE}"))?;
        let (_, after) = after.split_once(END_OF_SCENE).with_context(|| format!("no end of the scene {name}"))?;
        out += &format!("{before}{SCENE}{name} -->\n{}{END_OF_SCENE}", read(name)?);
        rest = after;
    }
    Ok(out + rest)
}

/// A part of a file as Markdown: `NAME | columns: A, B as C | where: D = x or y; E = z`.
fn shown(request: &str, read: &dyn Fn(&str) -> Result<String>) -> Result<String> {
    let mut parts = request.split('|').map(str::trim);
    let text = read(parts.next().unwrap_or_default())?;
    let mut table = csv::ReaderBuilder::new().comment(Some(b'#')).flexible(true).from_reader(text.as_bytes());
    let header = table.headers()?.clone();
    let column =
        |name: &str| header.iter().position(|found| found == name).with_context(|| format!("no column {name}"));
    let (mut columns, mut wanted) = (Vec::new(), Vec::new());
    for part in parts {
        if let Some(list) = part.strip_prefix("columns:") {
            for entry in list.split(',').map(str::trim) {
                let (of, title) = entry.split_once(" as ").unwrap_or((entry, entry));
                columns.push((column(of)?, title.to_owned()));
            }
        } else if let Some(list) = part.strip_prefix("where:") {
            for condition in list.split(';') {
                let (of, values) = condition.split_once('=').context("a condition without '='")?;
                wanted.push((column(of.trim())?, values.split(" or ").map(str::trim).collect::<Vec<_>>()));
            }
        } else {
            bail!("neither 'columns:' nor 'where:': {part}");
        }
    }
    if columns.is_empty() {
        columns = header.iter().map(str::to_owned).enumerate().collect();
    }
    let titles: Vec<&str> = columns.iter().map(|(_, title)| title.as_str()).collect();
    let mut out = format!("| {} |\n|{}\n", titles.join(" | "), "---|".repeat(titles.len()));
    let mut count = 0;
    for row in table.records() {
        let row = row?;
        let value = |k: usize| row.get(k).unwrap_or_default();
        if wanted.iter().all(|(k, values)| values.contains(&value(*k))) {
            let values: Vec<&str> = columns.iter().map(|(k, _)| value(*k)).collect();
            out.push_str(&format!("| {} |\n", values.join(" | ")));
            count += 1;
        }
    }
    ensure!(count > 0, "no row is so");
    Ok(out)
}

#[cfg(test)]
mod tests;

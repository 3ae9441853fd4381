//! The pages of the book, written from the files of the figures and from what was kept of those that were made.

use std::fmt::Write as _;
use std::fs;
use std::path::{Path, PathBuf};

use anyhow::{Context, Result, bail};

use super::data::Source;
use super::figure::{Figure, Judged};
use super::{ENVIRONMENT, Kept, chapter_of, definitions, different, numbers, read, said_by, verdict};
use crate::tables;

/// Widest line of prose.
const WIDEST: usize = 120;
const CHAPTERS: [(&str, &str); 6] = [
    ("2", "Active droplets and contrasts of viscosity"),
    ("3", "Rigid channels"),
    ("4", "Deformable walls"),
    ("5", "Geometries and nuclei"),
    ("B", "Extinction of a birth-death process"),
    (ENVIRONMENT, "The environment"),
];

const FRONT: &str = "Every figure of Cowley's thesis ([bibliography](../theory.md#bibliography)) with results, beside \
                     what converged results say. All of it is written by `cargo run --release -p studies -- figures \
                     --write` from the files in `studies/book`; `figure 3.9` makes one figure, `figures --chapter 3` \
                     a chapter; with `--quick` runs are fewer, shorter and coarser, and decide nothing. A figure that \
                     was not computed says so; a verdict whose numbers came out otherwise than it needs is shown as \
                     open, with the number. Every verdict but 'cannot tell' and 'no claim' rests on ranges that the \
                     number of the contrary statement is outside of; a test refuses one without. Where older numbers \
                     were known when a range was stated, as in chapter 4 and parts of chapter 3, it was chosen from \
                     the claim.";

const SECOND: &str = "What the surroundings do to a cell: questions that the thesis leaves open (its sections 5.2.2 \
                      and 5.2.3), made as the figures are, with `figures --chapter E`. Each has a statement that could \
                      be false, with ranges stated before the data, and an answer.";

pub(super) fn folder() -> PathBuf {
    Path::new(tables::root()).join("docs/book")
}

pub(super) fn kept_file(number: &str) -> PathBuf {
    folder().join(format!("figures/{number}.json"))
}

fn kept(number: &str) -> Result<Option<Kept>> {
    let path = kept_file(number);
    if !path.exists() {
        return Ok(None);
    }
    serde_json::from_str(&fs::read_to_string(&path)?).with_context(|| path.display().to_string())
}

/// Writes all pages.
pub(super) fn write() -> Result<()> {
    fs::create_dir_all(folder())?;
    for (name, text) in all()? {
        fs::write(folder().join(name), text)?;
    }
    Ok(())
}

/// The names of all pages and their texts.
pub(super) fn all() -> Result<Vec<(String, String)>> {
    let (numbers, definitions) = (numbers()?, definitions()?);
    let mut front = format!("# The book\n\n{}\n", wrapped(FRONT));
    let mut pages = Vec::new();
    let mut counts: Vec<(String, usize)> = Vec::new();
    let mut table = String::from("| figure | statement | verdict | evidence |\n|---|---|---|---|\n");
    let mut answers = String::from("| question | verdict | answer |\n|---|---|---|\n");
    for chapter in different(numbers.iter().map(|number| chapter_of(number).to_owned()).collect()) {
        let title = CHAPTERS.iter().find(|(number, _)| *number == chapter).map_or("", |(_, title)| title);
        let name = format!("chapter-{chapter}.md");
        let mut page = format!(
            "# Chapter {chapter}: {title}\n\nWritten by `studies -- figures --write`: [the book](README.md).\n"
        );
        let second = chapter == ENVIRONMENT;
        if second {
            page += &format!("\n{}\nANSWERS", wrapped(SECOND));
        }
        page += &told(numbers.iter().filter(|number| chapter_of(number) == chapter))?;
        for number in numbers.iter().filter(|number| chapter_of(number) == chapter) {
            let figure = read(number)?;
            if let Some(lack) = figure.lacks() {
                bail!("figure {number}: {lack}");
            }
            let kept = kept(number)?;
            let checks = figure.found(&definitions, kept.as_ref().map_or(&[], |kept| &kept.checks))?;
            let judged = figure.judged(&checks);
            let verdict = verdict(&figure, Some(&judged));
            let decisive = judged.iter().find(|check| !check.range().is_empty()).or(judged.first());
            let evidence = decisive.map_or_else(String::new, |check| {
                format!("{}: {}", check.name, check.text.as_deref().unwrap_or("not found yet"))
            });
            let anchor = format!("figure-{}", number.to_lowercase().replace('.', ""));
            let cell = |text: &str| text.split_whitespace().collect::<Vec<_>>().join(" ").replace('|', "\\|");
            page += &section(number, &figure, &verdict, &judged, kept.as_ref())?;
            let link = format!("[{number}]({name}#{anchor})");
            if second {
                let (title, why) = (cell(&figure.title), cell(&figure.why));
                let _ = writeln!(answers, "| {link} {title} | {} | {why} |", cell(&verdict));
                continue;
            }
            let _ = writeln!(table, "| {link} | {} | {} | {} |", cell(&figure.title), cell(&verdict), cell(&evidence));
            let kind = if verdict.starts_with("open") { "open" } else { &verdict };
            match counts.iter_mut().find(|(name, _)| name == kind) {
                Some((_, count)) => *count += 1,
                None => counts.push((kind.to_owned(), 1)),
            }
        }
        pages.push((name, page.replacen("ANSWERS", &answers, usize::from(second))));
    }
    counts.sort_by_key(|(_, count)| std::cmp::Reverse(*count));
    let words: Vec<String> = counts.iter().map(|(name, count)| format!("{count} {name}")).collect();
    let count: usize = counts.iter().map(|(_, count)| count).sum();
    front += &wrapped(&format!("{count} figures: {}.", words.join(", ")));
    front += "\n![Speed over the activity in channels](figures/3.4.svg)\n\n";
    front += &table;
    front += &format!("\n## The environment\n\n{}\n{answers}", wrapped(SECOND));
    pages.insert(0, ("README.md".to_owned(), front));
    Ok(pages)
}

/// Description of the data of a chapter's figures, once for all of them.
fn told<'a>(numbers: impl Iterator<Item = &'a String>) -> Result<String> {
    let mut names: Vec<String> = Vec::new();
    for number in numbers {
        for name in read(number)?.data {
            if !names.contains(&name) {
                names.push(name);
            }
        }
    }
    let mut text = String::from("\n## Data\n\n");
    for name in &names {
        text += &wrapped(&format!("* **{name}**: {}", Source::read(name)?.told()));
    }
    Ok(if names.is_empty() { String::new() } else { text })
}

fn section(number: &str, figure: &Figure, verdict: &str, judged: &[Judged], kept: Option<&Kept>) -> Result<String> {
    let mut text = format!("\n## Figure {number}\n\n{}", wrapped(&figure.title));
    text += "\n";
    text += &wrapped(&format!("**{}:** {}", said_by(number), figure.says));
    if let Some(kept) = kept {
        text += "\n";
        text += &wrapped(&format!("**Found** from the data {}, at {}:", figure.data.join(", "), kept.commit));
        if !judged.is_empty() {
            text += "\n";
        }
        for check in judged {
            let (found, outside) = match check.text.as_deref() {
                None => ("not found yet", ""),
                Some("") => ("nothing to measure", ""),
                Some(found) => (found, if check.stands { "" } else { ": it does not" }),
            };
            text += &wrapped(&format!("* {}: {found}{}{outside}", check.name, check.range()));
        }
        if kept.left_out > 0 {
            let _ = writeln!(text, "\nRuns that failed and are left out: {} of {}.", kept.left_out, kept.runs);
            if !kept.failures.is_empty() {
                text += "\n";
            }
            for failure in &kept.failures {
                // The run, and the last of its reasons.
                let (run, why) = failure.split_once(": ").unwrap_or(("", failure));
                let last = why.rsplit_once("ended because ").map_or(why, |(_, last)| last);
                text += &wrapped(&format!("* {run}: {last}"));
            }
        }
    }
    text += "\n";
    text += &wrapped(&format!("**Verdict: {verdict}.** {}", figure.why));
    if folder().join(format!("figures/{number}.svg")).exists() {
        let _ = write!(text, "\n![Figure {number}](figures/{number}.svg)\n");
    }
    if let Some(picture) = &figure.picture {
        let _ = write!(text, "\n![Figure {number}](../{picture})\n");
    }
    let own = format!("figure {number}");
    let command = figure.command.clone().unwrap_or_else(|| format!("cargo run --release -p studies -- {own}"));
    let mut last = format!("`{command}`");
    if let Some(seconds) = figure.processor.filter(|_| kept.is_some()) {
        last += &format!(" ({seconds:.0} s of processor time)");
    } else if let Some(seconds) = kept.map(|kept| kept.seconds).filter(|seconds| *seconds > 1.0) {
        last += &format!(" ({seconds:.0} s of computation)");
    }
    for page in &figure.see {
        last += &format!(", [{page}](../{page})");
    }
    text += "\n";
    text += &wrapped(&(last + "."));
    Ok(text)
}

/// A paragraph in lines that are not too long.
fn wrapped(text: &str) -> String {
    let mut out = String::new();
    let mut width = 0;
    for word in text.split_whitespace() {
        let length = word.chars().count();
        if width > 0 && width + 1 + length > WIDEST {
            out.push('\n');
            width = 0;
        } else if width > 0 {
            out.push(' ');
            width += 1;
        }
        out += word;
        width += length;
    }
    out + "\n"
}

//! Texts with their marks filled.

use anyhow::{Context, Result, bail, ensure};

use super::{Entry, MOST_WORDS, WIDEST, cell, section, wrapped, wrapped_to};
use crate::book::different;

const BEGIN: &str = "{{";
const END: &str = "}}";
/// Marks of what is said next to a number, and the words that it follows there.
const BESIDE: [(&str, &str); 4] =
    [("of", "of "), ("pairs", "of all "), ("p", "p = "), ("bounds", "lost runs on either side ")];

/// A page from its text; paragraphs with numbers in them are wrapped again.
pub(super) fn page(text: &str, entries: &[Entry]) -> Result<String> {
    let mut out = Vec::new();
    for block in text.trim_end().split("\n\n") {
        if !block.contains(BEGIN) {
            out.push(block.to_owned());
            continue;
        }
        let listed = block.starts_with("* ");
        let prose = !(block.starts_with('|') || block.starts_with("```"));
        let block = with_marks(block, &|mark| value(mark, entries))?;
        // What one mark makes alone is laid out already.
        let alone = block.contains("\n\n") || block.starts_with(['|', '!', '#', '<']);
        out.push(match (prose && !alone, listed) {
            (true, true) => block.split("\n* ").map(item).collect::<Vec<_>>().join("\n"),
            (true, false) => wrapped(&block).trim_end().to_owned(),
            (false, _) => block.trim_end().to_owned(),
        });
    }
    Ok(out.join("\n\n") + "\n")
}

/// An item of a list, its lines after the first indented.
fn item(text: &str) -> String {
    let text = text.strip_prefix("* ").unwrap_or(text);
    format!("* {}", wrapped_to(text, WIDEST - 2).trim_end().replace('\n', "\n  "))
}

/// A text with what `value` gives in place of each mark.
pub(super) fn with_marks(text: &str, value: &dyn Fn(&str) -> Result<String>) -> Result<String> {
    let mut out = String::new();
    let mut rest = text;
    while let Some((before, after)) = rest.split_once(BEGIN) {
        let (mark, after) = after.split_once(END).with_context(|| format!("no '{END}' after: {after:.60}"))?;
        out += before;
        out += value(mark.trim()).with_context(|| format!("{BEGIN}{mark}{END}"))?.trim_end();
        rest = after;
    }
    Ok(out + rest)
}

/// A text with its marks filled, and not laid out.
pub(super) fn text(text: &str, entries: &[Entry]) -> Result<String> {
    with_marks(text, &|mark| value(mark, entries))
}

fn value(mark: &str, entries: &[Entry]) -> Result<String> {
    let of = |number: &str| {
        let found = entries.iter().find(|entry| entry.number == number);
        found.with_context(|| format!("there is no figure {number}"))
    };
    let (first, rest) = mark.split_once([' ', '|']).unwrap_or((mark, ""));
    match first {
        "figure" => Ok(of(rest.trim())?.shown()),
        "verdicts" => verdicts(entries.iter().filter(|entry| !entry.is_question()), entries),
        "questions" => verdicts(entries.iter().filter(|entry| entry.is_question()), entries),
        "failed" => {
            let entry = of(rest.trim())?;
            let kept = entry.kept.as_ref().with_context(|| format!("figure {} was not made yet", entry.number))?;
            Ok(format!("{} of {}", kept.failed(), kept.runs))
        }
        "missed" => {
            let [missed, ranges] = of(rest.trim())?.missed();
            Ok(format!("{missed} of {ranges}"))
        }
        "counts" => Ok(counts(entries)),
        "costs" => costs(of_chapter(entries, rest)),
        "sections" => {
            let sections = of_chapter(entries, rest).map(|entry| section(entry, entries));
            Ok(sections.collect::<Result<Vec<_>>>()?.join("\n"))
        }
        _ => number(of(first)?, mark),
    }
}

/// A table of the processor time of each figure's data and of its runs that failed.
fn costs<'a>(entries: impl Iterator<Item = &'a Entry>) -> Result<String> {
    let mut rows = [String::from("| |"), String::from("|---|"), String::from("| processor time (s) |")];
    let mut failed = String::from("| failed runs |");
    for entry in entries {
        let kept = entry.kept.as_ref().with_context(|| format!("figure {} was not made yet", entry.number))?;
        let seconds = entry.figure.processor.with_context(|| format!("figure {} has no `processor`", entry.number))?;
        rows[0] += &format!(" {} |", entry.number);
        rows[1] += "---|";
        rows[2] += &format!(" {seconds:.0} |");
        failed += &format!(" {} of {} |", kept.failed(), kept.runs);
    }
    Ok(rows.join("\n") + "\n" + &failed)
}

fn of_chapter<'a>(entries: &'a [Entry], chapter: &'a str) -> impl Iterator<Item = &'a Entry> {
    entries.iter().filter(move |entry| entry.chapter() == chapter.trim())
}

/// The number that a mark `3.4 | NAME | GROUP | %` stands for.
fn number(entry: &Entry, mark: &str) -> Result<String> {
    let mut parts = mark.split(" | ").map(str::trim).skip(1);
    let name = parts.next().context("no name of a check")?;
    let (mut group, mut percent, mut error, mut value_too) = (None, false, false, true);
    let mut said = None;
    for part in parts {
        if let Some((_, words)) = BESIDE.iter().find(|(mark, _)| *mark == part) {
            said = Some(*words);
            continue;
        }
        match part {
            "%" => percent = true,
            "±" => error = true,
            "error" => (error, value_too) = (true, false),
            _ => group = Some(part),
        }
    }
    let found = entry.judged.iter().find(|check| check.name == name);
    let found = found.with_context(|| format!("figure {} has no check '{name}'", entry.number))?;
    let results = found.results();
    let result = match group {
        Some(group) => results.iter().find(|result| result.group.as_deref() == Some(group)),
        None if results.len() == 1 => results.first(),
        None => bail!("'{name}' has {} numbers: name a group", results.len()),
    };
    let result = result.with_context(|| format!("'{name}' found nothing there: {:?}", found.text))?;
    if let Some(words) = said {
        let text = result.beside.split(", ").find_map(|part| Some(part.split_once(words)?.1));
        let text = text.with_context(|| format!("'{name}' says no '{words}': {}", result.beside))?;
        return Ok(text.parse().map_or_else(|_| text.to_owned(), short));
    }
    let value: f64 = result.value.parse().with_context(|| result.value.clone())?;
    ensure!(value.is_finite(), "'{name}' is not a number");
    let factor = if percent { 100.0 } else { 1.0 };
    let mut text = short(factor * value);
    if error {
        let errors = ["standard error ", "standard deviation ", "largest residual "];
        let beside = errors.iter().find_map(|word| result.beside.strip_prefix(word));
        let beside = beside.with_context(|| format!("'{name}' has no error: {}", result.beside))?;
        let beside: f64 = beside.split([' ', ',']).next().unwrap_or(beside).parse()?;
        let beside = factor * beside;
        text = if value_too { format!("{text} ± {}", plain_number(beside, 1)) } else { short(beside) };
    }
    Ok(if percent { text + " %" } else { text })
}

/// A number with three significant digits, or four close to 1; a whole one as it is.
fn short(value: f64) -> String {
    if value.fract() == 0.0 && value.abs() < 1e6 {
        return value.to_string().replace('-', "−");
    }
    plain_number(value, if (0.99..1.0).contains(&value.abs()) { 4 } else { 3 })
}

fn plain_number(value: f64, digits: i32) -> String {
    if value == 0.0 {
        return "0".to_owned();
    }
    let power = value.abs().log10().floor() as i32;
    let step = 10_f64.powi(digits - 1 - power);
    let rounded = (value * step).round() / step;
    // A number such as 9.996 becomes one with another power.
    let power = rounded.abs().log10().floor() as i32;
    let text = match power {
        -4..=5 => format!("{rounded:.*}", (digits - 1 - power).max(0) as usize),
        _ => format!("{rounded:e}"),
    };
    text.replace('-', "−")
}

/// A line of each figure: its statement, the verdict and what it rests on.
fn verdicts<'a>(which: impl Iterator<Item = &'a Entry>, entries: &[Entry]) -> Result<String> {
    let mut table = String::from("| figure | statement | verdict | finding |\n|---|---|---|---|\n");
    for entry in which {
        let figure = &entry.figure;
        let finding = text(&figure.finding, entries).with_context(|| format!("finding of figure {}", entry.number))?;
        for text in [&figure.claim, &finding] {
            let words = text.split_whitespace().count();
            ensure!((1..=MOST_WORDS).contains(&words), "figure {}: {words} words in '{text}'", entry.number);
        }
        let name =
            figure.place.as_ref().map_or_else(|| entry.number.clone(), |place| place.replace("Section", "section"));
        let link = format!("[{name}]({})", place(entry));
        table += &format!("| {link} | {} | {} | {} |\n", cell(&figure.claim), entry.kind(), cell(&finding));
    }
    Ok(table)
}

/// The page of a figure and its place there.
fn place(entry: &Entry) -> String {
    format!("{}#{}", entry.page, entry.anchor())
}

/// How many figures of the thesis have each verdict.
fn counts(entries: &[Entry]) -> String {
    let kinds = |entry: &Entry| entry.kind().to_owned();
    let mut all: Vec<String> = entries.iter().filter(|entry| !entry.is_question()).map(kinds).collect();
    all.sort();
    let count = |kind: &String| all.iter().filter(|other| *other == kind).count();
    let mut counted: Vec<(usize, String)> =
        different(all.clone()).into_iter().map(|kind| (count(&kind), kind)).collect();
    counted.sort_by(|a, b| b.0.cmp(&a.0).then_with(|| a.1.cmp(&b.1)));
    let words: Vec<String> = counted.iter().map(|(count, kind)| format!("{count} {kind}")).collect();
    format!("{} figures and claims: {}.", all.len(), words.join(", "))
}

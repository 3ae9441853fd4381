//! Tables of all checks with their ranges, of statements, of data and of runs that failed.

use anyhow::Result;

use super::Entry;
use crate::book::data::Source;
use crate::book::different;

/// All tables by their names below docs/book.
pub(super) fn all(entries: &[Entry]) -> Result<Vec<(String, String)>> {
    let mut sheets = Vec::new();
    for chapter in different(entries.iter().map(|entry| entry.chapter().to_owned()).collect()) {
        let of_chapter = entries.iter().filter(|entry| entry.chapter() == chapter);
        sheets.push((format!("checks/chapter-{chapter}.csv"), checks(of_chapter)?));
    }
    sheets.push(("checks/verdicts.csv".to_owned(), verdicts(entries)?));
    sheets.push(("checks/data.csv".to_owned(), data(entries)?));
    sheets.push(("checks/failures.csv".to_owned(), failures(entries)?));
    Ok(sheets)
}

fn sheet(header: &[&str], rows: impl IntoIterator<Item = Vec<String>>) -> Result<String> {
    let mut writer = csv::Writer::from_writer(Vec::new());
    writer.write_record(header)?;
    for row in rows {
        writer.write_record(row.iter().map(|cell| cell.split_whitespace().collect::<Vec<_>>().join(" ")))?;
    }
    Ok(String::from_utf8(writer.into_inner()?)?)
}

/// A line of each number: what was found, the range in which the verdict stands, and the number of the contrary.
fn checks<'a>(entries: impl Iterator<Item = &'a Entry>) -> Result<String> {
    let header = ["figure", "check", "group", "found", "note", "from", "to", "contrary", "stands"];
    let mut rows = Vec::new();
    for entry in entries {
        for check in &entry.judged {
            let number = |value: Option<f64>| value.map(|value| value.to_string()).unwrap_or_default();
            let [from, to] = check.within.map_or([None; 2], |range| range.map(Some));
            let stands = check.within.map_or("", |_| if check.stands { "yes" } else { "no" });
            let mut results = check.results();
            if results.is_empty() {
                results.push(crate::book::figure::Single { value: "nothing".to_owned(), ..Default::default() });
            }
            for result in results {
                let limits = [from, to, check.opposite].map(number);
                let own = [entry.number.clone(), check.name.clone(), result.group.unwrap_or_default(), result.value];
                let rest = [vec![result.beside], limits.to_vec(), vec![stands.to_owned()]].concat();
                rows.push([own.to_vec(), rest].concat());
            }
        }
    }
    sheet(&header, rows)
}

/// A line of each figure: the statement in full, the verdict and its reasons.
fn verdicts(entries: &[Entry]) -> Result<String> {
    let row = |entry: &Entry| -> Result<Vec<String>> {
        let figure = &entry.figure;
        let texts = [&entry.number, &figure.title, &figure.says, &entry.verdict, &entry.why(entries)?];
        let command = figure.command.clone().unwrap_or_else(|| format!("studies -- figure {}", entry.number));
        Ok(texts.into_iter().cloned().chain([command]).collect())
    };
    let rows = entries.iter().map(row).collect::<Result<Vec<_>>>()?;
    sheet(&["figure", "title", "statement", "verdict", "reasons", "command"], rows)
}

/// A line of each figure's data.
fn data(entries: &[Entry]) -> Result<String> {
    let mut rows = Vec::new();
    for entry in entries {
        let kept = |of: fn(&super::Kept) -> String| entry.kept.as_ref().map(of).unwrap_or_default();
        let (runs, failed) = (kept(|kept| kept.runs.to_string()), kept(|kept| kept.failed().to_string()));
        let seconds = kept(|kept| format!("{:.0}", kept.seconds));
        for name in &entry.figure.data {
            let about = Source::read(name)?.told();
            rows.push(vec![entry.number.clone(), name.clone(), about, runs.clone(), failed.clone(), seconds.clone()]);
        }
    }
    sheet(&["figure", "data", "description", "runs of the figure", "failed", "seconds"], rows)
}

/// A line of each run that failed and is left out.
fn failures(entries: &[Entry]) -> Result<String> {
    let of = |entry: &Entry| -> Vec<Vec<String>> {
        let failures = entry.kept.iter().flat_map(|kept| &kept.failures);
        let row = |failure: &String| {
            // The run, and the last of its reasons.
            let (run, why) = failure.split_once(": ").unwrap_or(("", failure));
            let last = why.rsplit_once("ended because ").map_or(why, |(_, last)| last);
            vec![entry.number.clone(), run.to_owned(), last.to_owned()]
        };
        failures.map(row).collect()
    };
    sheet(&["figure", "run", "reason"], entries.iter().flat_map(of))
}

//! The pages of the report, and the tables with all of its checks.
//!
//! A page is written from a text in `studies/book/chapters`, in which `{{figure 3.4}}` stands for a picture with its
//! caption, `{{3.4 | NAME}}` for the number that the check NAME of figure 3.4 found, `{{3.4 | NAME | GROUP}}` for the
//! number of one of its groups. Behind them, `| %` stands for percent, `| ±` for the number with its error, and
//! `| error` for the error alone; `| of`, `| pairs`, `| p` and `| bounds` for what stands next to the number. There are
//! also `{{failed 4.19}}`, `{{missed E.5}}` for the ranges that its numbers are outside of, `{{verdicts}}`,
//! `{{questions}}`, `{{counts}}`, `{{sections}}` and `{{costs}}` for what the machinery knows of all figures. The
//! reasons of a figure may have marks too. Everything else that is known of the checks is in `docs/book/checks`.

mod filled;
mod sheets;

use std::fs;
use std::path::{Path, PathBuf};

use anyhow::{Context, Result, bail, ensure};

use super::figure::{Figure, Judged};
use super::{ENVIRONMENT, Kept, chapter_of, definitions, directory, numbers, read, verdict};
use crate::tables;

/// Widest line of prose.
const WIDEST: usize = 120;
/// Largest text of a chapter of the thesis and of the chapter on the environment (bytes).
const LARGEST: usize = 8192;
const LARGEST_ENVIRONMENT: usize = 15 * 1024;
/// Most words of a cell of a table.
pub(super) const MOST_WORDS: usize = 12;

pub(super) fn folder() -> PathBuf {
    Path::new(tables::root()).join("docs/book")
}

pub(super) fn kept_file(number: &str) -> PathBuf {
    folder().join(format!("figures/{number}.json"))
}

/// The record of a figure that was made.
pub(super) fn kept(number: &str) -> Result<Option<Kept>> {
    let path = kept_file(number);
    if !path.exists() {
        return Ok(None);
    }
    serde_json::from_str(&fs::read_to_string(&path)?).with_context(|| path.display().to_string())
}

/// A figure with all that is known of it.
struct Entry {
    number: String,
    figure: Figure,
    kept: Option<Kept>,
    judged: Vec<Judged>,
    verdict: String,
    /// The page that shows it.
    page: String,
}

impl Entry {
    fn of(number: &str) -> Result<Self> {
        let figure = read(number)?;
        if let Some(lack) = figure.lacks() {
            bail!("figure {number}: {lack}");
        }
        let kept = kept(number)?;
        let checks = figure.found(&definitions()?, kept.as_ref().map_or(&[], |kept| &kept.checks))?;
        let judged = figure.judged(&checks);
        Self::judged(number, figure, kept, judged)
    }

    fn judged(number: &str, figure: Figure, kept: Option<Kept>, judged: Vec<Judged>) -> Result<Self> {
        let verdict = verdict(&figure, Some(&judged));
        let page = page_of(number)?;
        Ok(Self { number: number.to_owned(), figure, kept, judged, verdict, page })
    }

    fn chapter(&self) -> &str {
        chapter_of(&self.number)
    }

    fn is_question(&self) -> bool {
        self.chapter() == ENVIRONMENT
    }

    /// The verdict in a word or two.
    fn kind(&self) -> &str {
        if self.verdict.starts_with("open") { "open" } else { &self.verdict }
    }

    /// How many numbers have to be in a range, and how many of these are not.
    fn missed(&self) -> [usize; 2] {
        let ranges = || self.judged.iter().filter(|check| check.within.is_some());
        [ranges().filter(|check| !check.stands).count(), ranges().count()]
    }

    /// The reasons of the verdict, with their marks filled.
    fn why(&self, entries: &[Self]) -> Result<String> {
        filled::text(&self.figure.why, entries).with_context(|| format!("reasons of figure {}", self.number))
    }

    /// What a page calls it.
    fn name(&self) -> String {
        if let Some(place) = &self.figure.place {
            return place.clone();
        }
        match self.number.matches('.').count() {
            1 if self.is_question() => self.number.clone(),
            1 => format!("Figure {}", self.number),
            _ => format!("Section {}", self.number),
        }
    }

    /// Where a page has it.
    fn anchor(&self) -> String {
        // A section such as 3.1.1 is not figure 3.11.
        let kind = if self.number.matches('.').count() == 1 { "figure" } else { "section" };
        format!("{kind}-{}", self.number.to_lowercase().replace('.', ""))
    }

    /// Its pictures, by their paths from the page.
    fn pictures(&self) -> Vec<String> {
        let own = format!("figures/{}.svg", self.number);
        let drawn = folder().join(&own).exists().then_some(own);
        drawn.into_iter().chain(self.figure.picture.as_ref().map(|picture| format!("../{picture}"))).collect()
    }

    /// The picture and its caption, with the axes, across first, and the meaning of colours and panels.
    fn shown(&self) -> String {
        let (first, rest) = self.kind().split_at(1);
        let verdict = first.to_uppercase() + rest;
        let caption = format!("**{}.** {}.{} *{verdict}.*", self.name(), self.figure.title, self.explained());
        format!("<a id=\"{}\"></a>\n", self.anchor()) + &self.images() + &wrapped(&caption)
    }

    fn images(&self) -> String {
        self.pictures().iter().fold(String::new(), |text, picture| text + &format!("![{}]({picture})\n\n", self.name()))
    }

    /// What axes, colours and panels of its picture mean.
    fn explained(&self) -> String {
        let axes = self.figure.axes().replace(" (across)", "").replace(" (up)", "");
        let axes = if axes.is_empty() { axes } else { format!(" Axes: {axes}.") };
        let legend = &self.figure.legend;
        if legend.is_empty() { axes } else { format!("{axes} {legend}") }
    }
}

/// The name of the page whose text has the mark of a figure, or of the page of its chapter.
fn page_of(number: &str) -> Result<String> {
    let mark = format!("{{{{figure {number}}}}}");
    for path in tables::files("studies/book/chapters", "md")? {
        if fs::read_to_string(&path)?.contains(&mark) {
            return Ok(path.file_name().context("a name")?.to_string_lossy().into_owned());
        }
    }
    Ok(format!("chapter-{}.md", chapter_of(number)))
}

/// The reasons of a verdict on what was found of a figure; marks of other figures stay as they are.
pub(super) fn reasons(number: &str, kept: Kept) -> Result<String> {
    let figure = read(number)?;
    let judged = figure.judged(&kept.checks);
    let entry = Entry::judged(number, figure, Some(kept), judged)?;
    Ok(entry.why(std::slice::from_ref(&entry)).unwrap_or_else(|_| entry.figure.why.clone()))
}

/// Writes all pages.
pub(super) fn write() -> Result<()> {
    for (name, text) in all()? {
        let path = folder().join(name);
        fs::create_dir_all(path.parent().context("a folder of the page")?)?;
        fs::write(path, text)?;
    }
    Ok(())
}

/// The names of all pages and tables, and their texts.
pub(super) fn all() -> Result<Vec<(String, String)>> {
    let entries = numbers()?.iter().map(|number| Entry::of(number)).collect::<Result<Vec<_>>>()?;
    let mut anchors: Vec<String> = entries.iter().map(Entry::anchor).collect();
    anchors.sort();
    if let Some(twice) = anchors.windows(2).find(|pair| pair[0] == pair[1]) {
        bail!("two figures have the anchor {}", twice[0]);
    }
    let mut texts = Vec::new();
    for path in tables::files("studies/book/chapters", "md")? {
        let name = path.file_name().context("a name")?.to_string_lossy().into_owned();
        texts.push((name, fs::read_to_string(&path)?));
    }
    texts.sort();
    for entry in &entries {
        let mark = format!("{{{{figure {}}}}}", entry.number);
        let shown = entry.is_question() || texts.iter().any(|(_, text)| text.contains(&mark));
        ensure!(shown, "figure {} is in no text of {}/chapters", entry.number, directory().display());
        let explained = !entry.figure.legend.is_empty();
        ensure!(explained, "figure {} has no `legend`, which says what colours and panels mean", entry.number);
        let asked = !entry.is_question() || !entry.figure.asks.is_empty();
        ensure!(asked, "figure {} has no `asks`, the claims of its statement that ranges test", entry.number);
    }
    let mut pages = Vec::new();
    for (name, text) in &texts {
        let page = filled::page(text, &entries).with_context(|| name.clone())?;
        let most = if name.contains(ENVIRONMENT) { LARGEST_ENVIRONMENT } else { LARGEST };
        let fits = !name.starts_with("chapter-") || page.len() <= most;
        ensure!(fits, "{name} has {} bytes, more than {most}", page.len());
        pages.push((name.clone(), page));
    }
    pages.extend(sheets::all(&entries)?);
    Ok(pages)
}

/// A text with its marks filled from all figures.
#[cfg(test)]
pub(super) fn filled_with_all(text: &str) -> Result<String> {
    let entries = numbers()?.iter().map(|number| Entry::of(number)).collect::<Result<Vec<_>>>()?;
    filled::page(text, &entries)
}

/// A question of the second part with its answer.
fn section(entry: &Entry, entries: &[Entry]) -> Result<String> {
    let figure = &entry.figure;
    let mut text = format!("<a id=\"{}\"></a>\n\n## {} {}\n\n", entry.anchor(), entry.number, figure.title);
    text += &wrapped(&format!("**Statement:** {}", figure.asks));
    text += "\n";
    let [missed, ranges] = entry.missed();
    let ranges = if missed == 0 { String::new() } else { format!(" ({missed} of {ranges} ranges missed)") };
    let open = figure.open.as_ref().map_or_else(String::new, |open| format!(" **Open:** {open}"));
    let verdict = format!("**Verdict: {}{ranges}.** {}{open}", entry.verdict, entry.why(entries)?);
    text += &(wrapped(&verdict) + "\n" + &entry.images());
    Ok(text + &wrapped(&format!("**{}.**{}", entry.name(), entry.explained())))
}

/// A paragraph in lines that are not too long.
fn wrapped(text: &str) -> String {
    wrapped_to(text, WIDEST)
}

fn wrapped_to(text: &str, widest: usize) -> String {
    let mut out = String::new();
    let mut width = 0;
    for word in text.split_whitespace() {
        let length = word.chars().count();
        if width > 0 && width + 1 + length > widest {
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

/// The text of a cell of a table.
fn cell(text: &str) -> String {
    text.split_whitespace().collect::<Vec<_>>().join(" ").replace('|', "\\|")
}

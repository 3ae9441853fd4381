//! The reproduction report: claims of Cowley's thesis next to converged results, and questions that it leaves open.
//!
//! `cargo run --release -p studies -- figure 3.9` makes the figure from what `studies/book/3.9.toml` says: its data
//! (`studies/book/data`: runs of a plan, shapes of runs at some times, steady states of a plan, tables of
//! `docs/tables`; what exists is not made again), and the curves and numbers that its verdict rests on, as expressions
//! of the columns. It prints them and writes CSV, SVG and PNG to `out/book/`. `--quick` has fewer, shorter and coarser
//! runs, which the ranges of verdicts are not for: it shows that a figure can be made, and decides and keeps nothing.
//! `figures --chapter 3` makes the figures of a chapter. `--write` keeps what `docs/book/` shows and writes its pages
//! and tables from the texts in `studies/book/chapters`; `--write --pictures` makes only what panels show, and
//! `--write --add` only data that are new in the figure's file. Checks of `points` are found from the points in
//! `docs/book/figures` whenever the pages are written (`studies -- pages`).

mod data;
mod expression;
mod figure;
mod pages;
pub(crate) mod statistics;
pub(crate) mod witnesses;

use std::collections::BTreeMap;
use std::fs;
use std::path::{Path, PathBuf};

use anyhow::{Context, Result, bail, ensure};
use clap::Args;
use motile_cli::run::{explained, say};
use motile_output::plot::Figure as Picture;
use serde::{Deserialize, Serialize};

use crate::tables;
use data::{Data, POINTS, Source};
use expression::Definitions;
use figure::{Checked, Figure, Judged, Verdict};

/// Makes a figure of the book.
#[derive(Debug, Args)]
pub(crate) struct FigureFlags {
    /// Its number, such as 3.9 or B.1
    number: String,
    #[command(flatten)]
    common: Common,
}

/// Makes the figures of a chapter of the book, or of all.
#[derive(Debug, Args)]
pub(crate) struct FiguresFlags {
    /// The chapter, 2 to 5, B or E; without it all of them
    #[arg(long)]
    chapter: Option<String>,
    #[command(flatten)]
    common: Common,
}

#[derive(Debug, Args)]
struct Common {
    /// Fewer, shorter and coarser runs, which decide nothing
    #[arg(long)]
    quick: bool,
    /// Keep numbers and picture in docs/book, and write its pages
    #[arg(long, conflicts_with = "quick")]
    write: bool,
    /// Make only what panels show, and keep the numbers that were found before
    #[arg(long, requires = "write")]
    pictures: bool,
    /// Make only data that the figure was made without, and keep the points and numbers of its other data
    #[arg(long, requires = "write", conflicts_with = "pictures")]
    add: bool,
    /// Runs at a time; without it as many as there are processors
    #[arg(long, value_parser = clap::value_parser!(u16).range(1..=1024))]
    threads: Option<u16>,
    /// Show no progress
    #[arg(long)]
    quiet: bool,
    /// Directory of the runs and figures
    #[arg(long, value_name = "DIRECTORY", default_value = "out/book")]
    out: PathBuf,
}

/// How data are made.
#[derive(Debug, Clone)]
struct Making {
    quick: bool,
    threads: usize,
    quiet: bool,
    out: PathBuf,
}

impl Making {
    fn kind(&self) -> &'static str {
        if self.quick { "quick" } else { "full" }
    }
}

/// Record of a figure that was made, in `docs/book/figures`.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
struct Kept {
    runs: usize,
    left_out: usize,
    /// Those that ended in an error, each with it.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    failures: Vec<String>,
    seconds: f64,
    data: Vec<String>,
    checks: Vec<Checked>,
}

impl Kept {
    /// How many of its runs ended in an error. A point of a bisection without a boundary is left out, but no run.
    fn failed(&self) -> usize {
        let points = self.failures.iter().filter(|failure| failure.contains(NO_BOUNDARY)).count();
        self.left_out - points.min(self.left_out)
    }
}

/// Words of a point of a bisection that is left out.
const NO_BOUNDARY: &str = "no boundary between";

/// Where the files of the figures are.
fn directory() -> PathBuf {
    Path::new(tables::root()).join("studies/book")
}

pub(crate) fn figure(flags: &FigureFlags) -> Result<()> {
    make(std::slice::from_ref(&flags.number), &flags.common)
}

pub(crate) fn figures(flags: &FiguresFlags) -> Result<()> {
    let mut numbers = numbers()?;
    if let Some(chapter) = &flags.chapter {
        let all: Vec<String> = numbers.iter().map(|number| chapter_of(number).to_owned()).collect();
        numbers.retain(|number| chapter_of(number) == chapter);
        ensure!(!numbers.is_empty(), "there is no chapter {chapter}. Use one of {}", different(all).join(", "));
    }
    make(&numbers, &flags.common)
}

/// Writes the pages of the book from what is kept of its figures, or checks that they are so.
///
/// # Errors
/// Pages that are otherwise, files that cannot be read or written.
pub(crate) fn pages(check: bool) -> Result<()> {
    if !check {
        return pages::write();
    }
    for (name, text) in pages::all()? {
        let same = fs::read_to_string(pages::folder().join(&name)).is_ok_and(|found| found == text);
        ensure!(same, "docs/book/{name} is otherwise than its figures: run `studies -- pages`");
    }
    Ok(())
}

/// The second part of the book, of questions that the thesis leaves open.
const ENVIRONMENT: &str = "E";

/// Whose statement a figure's is.
fn said_by(number: &str) -> &'static str {
    if chapter_of(number) == ENVIRONMENT { "Statement" } else { "Cowley" }
}

fn different(mut list: Vec<String>) -> Vec<String> {
    list.dedup();
    list
}

fn chapter_of(number: &str) -> &str {
    number.split('.').next().unwrap_or(number)
}

/// The numbers of all figures, in order.
fn numbers() -> Result<Vec<String>> {
    let entries = fs::read_dir(directory())?.map(|entry| Ok(entry?.path()));
    let paths = entries.collect::<Result<Vec<_>>>()?;
    let named = paths.iter().filter(|path| path.extension().is_some_and(|extension| extension == "toml"));
    let stem = |path: &PathBuf| path.file_stem().map(|stem| stem.to_string_lossy().into_owned());
    let mut numbers: Vec<String> = named.filter_map(stem).filter(|name| name.contains('.')).collect();
    numbers.sort_by_key(|number| {
        let (chapter, place) = number.split_once('.').unwrap_or((number, ""));
        // A section such as 3.1.1 comes before the figures of its chapter.
        let place: Vec<u32> = place.split('.').filter_map(|part| part.parse().ok()).collect();
        (chapter.to_owned(), if place.len() == 1 { place[0] } else { 0 }, place)
    });
    Ok(numbers)
}

fn read(number: &str) -> Result<Figure> {
    let path = directory().join(format!("{number}.toml"));
    if !numbers()?.iter().any(|known| known == number) {
        bail!("there is no figure {number}. Use one of {}", numbers()?.join(", "));
    }
    let read = || -> Result<Figure> {
        let mut figure: Figure = toml::from_str(&fs::read_to_string(&path)?)?;
        number.clone_into(&mut figure.number);
        Ok(figure)
    };
    read().with_context(|| path.display().to_string())
}

/// Meaning of names in all figures.
fn definitions() -> Result<Definitions> {
    let path = directory().join("definitions.toml");
    let read = || -> Result<Definitions> { Ok(toml::from_str(&fs::read_to_string(&path)?)?) };
    read().with_context(|| path.display().to_string())
}

fn make(numbers: &[String], common: &Common) -> Result<()> {
    let processors = || std::thread::available_parallelism().map_or(1, std::num::NonZero::get);
    let threads = common.threads.map_or_else(processors, usize::from);
    let making = Making { quick: common.quick, threads, quiet: common.quiet, out: common.out.clone() };
    let mut made = BTreeMap::new();
    let mut failures = Vec::new();
    for number in numbers {
        if let Some(reason) = without_quick(number, &making)? {
            ensure!(numbers.len() > 1, "figure {number} has no quick version, because {reason}: leave --quick out");
            say(format_args!("\nFigure {number}: left out, because {reason}"));
            continue;
        }
        // One that fails does not keep the others from being made.
        if let Err(failure) = one(number, &making, &mut made, common) {
            let which = if numbers.len() > 1 { format!("figure {number}: ") } else { String::new() };
            failures.push(which + &explained(&failure));
        }
    }
    if common.write {
        pages::write()?;
    }
    ensure!(failures.is_empty(), "{}", failures.join("\n"));
    Ok(())
}

/// Reason for which a figure has no quick version, if one is wanted.
fn without_quick(number: &str, making: &Making) -> Result<Option<String>> {
    if !making.quick {
        return Ok(None);
    }
    for name in read(number)?.data {
        if Source::read(&name)?.is_bisection() {
            return Ok(Some(format!("short runs show no boundary of the data {name}")));
        }
    }
    Ok(None)
}

fn one(number: &str, making: &Making, made: &mut BTreeMap<String, Data>, common: &Common) -> Result<()> {
    let (figure, definitions) = (read(number)?, definitions()?);
    say(format_args!("\nFigure {number}: {}\n{}: {}", figure.title, said_by(number), figure.says));
    let before = common.add.then(|| pages::kept(number)).transpose()?.flatten();
    let points_before = if before.is_some() { witnesses::kept(number)? } else { Vec::new() };
    // Data that the figure was made with are known by their descriptions.
    let is_new = |name: &String| -> Result<bool> {
        let Some(before) = &before else { return Ok(true) };
        Ok(!before.data.contains(&Source::read(name)?.about))
    };
    let mut own = Vec::new();
    for name in figure.data.iter().filter(|name| !common.pictures || figure.shows(name)) {
        if !is_new(name)? {
            continue;
        }
        own.push(name.clone());
        if !made.contains_key(name) {
            made.insert(name.clone(), Source::read(name)?.rows(name, making)?);
        }
    }
    if figure.data.is_empty() {
        let command = figure.command.as_deref().unwrap_or("not computed yet");
        say(format_args!("No data of its own: {command}"));
        return Ok(());
    }
    ensure!(!(own.is_empty() && common.add), "figure {number} was made with all of its data: leave --add out");
    let mut given: BTreeMap<String, Data> =
        own.iter().filter_map(|name| Some((name.clone(), made.get(name)?.clone()))).collect();
    let (plots, points) = figure.panels(&definitions, &given, &points_before, making.quick)?;
    given.insert(POINTS.to_owned(), Data::in_points(&points));
    for name in figure.others() {
        given.insert(name.to_owned(), Data::of_points(name, number)?);
    }
    let left_out = figure.panel_count() - plots.len();
    if left_out > 0 {
        say(format_args!("{left_out} of {} panels left out, for which there are no points.", figure.panel_count()));
    }
    let columns = plots.len().min(2);
    let picture = plots.into_iter().fold(Picture::new(columns), Picture::panel);
    if columns > 0 {
        picture.write(&making.out, number)?;
        fs::write(making.out.join(format!("{number}.csv")), &points)?;
    }
    let folder = pages::folder().join("figures");
    if common.write && columns > 0 {
        fs::create_dir_all(&folder)?;
        fs::write(folder.join(format!("{number}.svg")), picture.svg()?)?;
        fs::write(folder.join(format!("{number}.csv")), &points)?;
    }
    if common.pictures {
        return Ok(());
    }
    let found = figure.checks(&definitions, &given, before.as_ref().map_or(&[], |before| &before.checks))?;
    for check in &found {
        say(format_args!("  {}: {}", check.name, check.text));
    }
    let mut kept = Kept { checks: found, ..before.unwrap_or_default() };
    for data in own.iter().filter_map(|name| given.get(name)) {
        kept.runs += data.wanted;
        kept.left_out += data.failures.len();
        kept.failures.extend(data.failures.clone());
        kept.seconds += data.seconds;
        kept.data.push(data.about.clone());
    }
    if making.quick {
        let empty: Vec<&str> =
            kept.checks.iter().filter(|check| check.is_empty()).map(|check| check.name.as_str()).collect();
        let all = kept.checks.len();
        // A figure without numbers is none.
        ensure!(all == 0 || empty.len() < all, "the quick runs leave all of its numbers empty: leave --quick out");
        if !empty.is_empty() {
            let (count, names) = (empty.len(), empty.join("; "));
            say(format_args!("Leave --quick out for {count} of {all} numbers: the quick runs do not give {names}."));
        }
    }
    if making.quick && kept.runs > 0 {
        say(format_args!("Fewer and shorter runs than the ranges are for: they decide nothing."));
    } else {
        let judged = figure.judged(&kept.checks);
        let why = pages::reasons(number, kept.clone())?;
        say(format_args!("Verdict: {}. {why}", verdict(&figure, Some(&judged))));
    }
    say(format_args!("{} runs, {:.0} s of computation; {}", kept.runs, kept.seconds, making.out.display()));
    if common.write {
        fs::create_dir_all(&folder)?;
        fs::write(pages::kept_file(number), serde_json::to_string_pretty(&kept)? + "\n")?;
    }
    Ok(())
}

/// The verdict as it stands after what was found.
fn verdict(figure: &Figure, judged: Option<&[Judged]>) -> String {
    let needs = figure.number_of_data() > 0;
    let unknown = judged.is_none_or(|judged| judged.iter().any(|check| check.text.is_none()));
    let fails = judged.and_then(|judged| judged.iter().find(|check| !check.stands));
    let second = chapter_of(&figure.number) == ENVIRONMENT;
    match (figure.verdict, fails) {
        (None, _) if second && !unknown => {
            let followed = Figure::followed(judged.unwrap_or_default());
            let part = followed == Verdict::Confirmed && figure.open.is_some();
            if part { Verdict::ConfirmedInPart } else { followed }.name().to_owned()
        }
        (None, _) => "not computed yet".to_owned(),
        _ if needs && unknown => "not computed yet".to_owned(),
        (Some(_), Some(check)) => {
            format!("open: {} is {}", check.name, check.text.as_deref().unwrap_or("not known"))
        }
        (Some(verdict), None) => verdict.name().to_owned(),
    }
}

#[cfg(test)]
mod tests;

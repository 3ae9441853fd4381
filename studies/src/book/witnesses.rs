//! Witnesses of the figures of the report: single runs that are made again, and whose points are compared with those
//! that the figure shows.
//!
//! `docs/book/checks/witnesses.csv` lists them: a figure, one of its data, the label of a run, how many points of the
//! figure this run makes, and how long it takes.

use std::collections::BTreeMap;
use std::fs;
use std::path::{Path, PathBuf};
use std::time::Instant;

use anyhow::{Context, Result, ensure};
use motile_cli::run::say;
use serde::{Deserialize, Serialize};

use super::data::{Data, Source};
use super::expression::Row;
use super::figure::{Figure, Point};
use super::{Making, definitions, numbers, pages, read};

/// Largest difference of a coordinate of a point over the largest of its panel: numbers that other processors find
/// differ in the last digits.
const CLOSE: f64 = 1e-4;
/// Longest run that is made at every change (seconds), and longest that is a witness at all.
const SHORT: f64 = 2.0;
const LONGEST: f64 = 20.0;

/// A line of the file.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
struct Witness {
    figure: String,
    data: String,
    run: String,
    points: usize,
    seconds: f64,
}

/// Rows of runs that were made, by the names of their data and their labels, and how long each took (seconds).
#[derive(Debug)]
struct Runs {
    making: Making,
    found: BTreeMap<[String; 2], Option<(Row, f64)>>,
}

impl Runs {
    fn new() -> Self {
        let out = std::env::temp_dir().join(format!("motile-witnesses-{}", std::process::id()));
        Self { making: Making { quick: false, threads: 1, quiet: true, out }, found: BTreeMap::new() }
    }

    fn row(&mut self, source: &Source, name: &str, label: &str) -> Result<Option<(Row, f64)>> {
        let key = [name.to_owned(), label.to_owned()];
        if let Some(found) = self.found.get(&key) {
            return Ok(found.clone());
        }
        let started = Instant::now();
        let row = source.row(name, &self.making, label)?;
        let found = row.map(|row| (row, started.elapsed().as_secs_f64()));
        self.found.insert(key, found.clone());
        Ok(found)
    }
}

impl Drop for Runs {
    fn drop(&mut self) {
        // A folder that stays is in nobody's way.
        fs::remove_dir_all(&self.making.out).ok();
    }
}

fn file() -> PathBuf {
    pages::folder().join("checks/witnesses.csv")
}

fn listed() -> Result<Vec<Witness>> {
    let path = file();
    if !path.exists() {
        return Ok(Vec::new());
    }
    let read = || -> Result<Vec<Witness>> {
        let mut table = csv::Reader::from_path(&path)?;
        table.deserialize().map(|witness| Ok(witness?)).collect()
    };
    read().with_context(|| path.display().to_string())
}

/// Points of a figure that one row of its data makes.
fn points_of(figure: &Figure, name: &str, row: Row) -> Result<Vec<Point>> {
    let mut data: BTreeMap<String, Data> = figure.data.iter().map(|name| (name.clone(), Data::default())).collect();
    data.insert(name.to_owned(), Data { rows: vec![row], ..Data::default() });
    figure.points(&definitions()?, &data)
}

/// How many of the points are among those that are shown.
fn shown(found: &[Point], shown: &[Point]) -> usize {
    let is = |a: &Point, b: &Point| {
        let own = || shown.iter().filter(|other| other.panel == b.panel);
        let size = |of: fn(&Point) -> f64| own().map(|point| of(point).abs()).fold(0.0, f64::max);
        let close = |of: fn(&Point) -> f64| (of(a) - of(b)).abs() <= CLOSE * size(of);
        (a.panel, &a.curve, &a.group) == (b.panel, &b.curve, &b.group) && close(|p| p.x) && close(|p| p.y)
    };
    found.iter().filter(|point| shown.iter().any(|other| is(point, other))).count()
}

/// The points that are kept with a figure.
pub(super) fn kept(number: &str) -> Result<Vec<Point>> {
    let path = pages::folder().join(format!("figures/{number}.csv"));
    let text = fs::read_to_string(&path).with_context(|| path.display().to_string())?;
    Ok(text.lines().skip(1).filter_map(Point::read).collect())
}

/// Makes the witnesses again, all or only those that take little time, and compares them with the figures.
///
/// # Errors
/// Figures that show other points.
pub(crate) fn witnesses(all: bool, only: Option<&str>) -> Result<()> {
    let (mut runs, mut failures) = (Runs::new(), Vec::new());
    for witness in listed()?.iter().filter(|witness| all || witness.seconds < SHORT) {
        let Witness { figure: number, data, run, points, .. } = witness;
        if only.is_some_and(|only| !number.starts_with(only)) {
            continue;
        }
        let mut compare = || -> Result<()> {
            let source = Source::read(data)?;
            let (row, _) = runs.row(&source, data, run)?.with_context(|| format!("the run {run} fails or is gone"))?;
            let found = shown(&points_of(&read(number)?, data, row)?, &kept(number)?);
            // Streamlines may be cut elsewhere.
            ensure!(10 * found >= 9 * points, "of its {points} points in the figure, the program finds {found}");
            Ok(())
        };
        match compare() {
            Ok(()) => say(format_args!("figure {number}: {points} points of {data}, {run}, are as before")),
            Err(failure) => failures.push(format!(
                "figure {number} is not current; make it again: studies -- figure {number} --write ({data}, {run}: \
                 {failure:#})"
            )),
        }
    }
    ensure!(failures.is_empty(), "{}", failures.join("\n"));
    Ok(())
}

/// Makes one run of each data of figures without witnesses, the first or, with the figure, the fastest, and lists those
/// whose points the figure shows.
///
/// # Errors
/// A file that cannot be written. Figures that do not show the points are told.
pub(crate) fn choose(only: Option<&str>) -> Result<()> {
    let (mut runs, mut list) = (Runs::new(), listed()?);
    for number in numbers()?.iter().filter(|number| only.is_none_or(|only| number.starts_with(only))) {
        let figure = read(number)?;
        for name in figure.data.iter().filter(|name| figure.shows(name)) {
            let source = Source::read(name)?;
            let known = list.iter().any(|witness| witness.figure == *number && witness.data == *name);
            if known || source.is_bisection() || !likely_short(number)? {
                continue;
            }
            let Some(label) = source.trials(name, &runs.making)?.first().map(|trial| trial.label.clone()) else {
                continue;
            };
            let Some((row, seconds)) = runs.row(&source, name, &label)? else { continue };
            let found = points_of(&figure, name, row)?;
            let points = shown(&found, &kept(number)?);
            say(format_args!("{number}, {name}, {label}: {points} of {} points, {seconds:.1} s", found.len()));
            if points > 0 && seconds < LONGEST {
                let seconds = (seconds * 10.0).round() / 10.0;
                let (figure, data) = (number.clone(), name.clone());
                list.push(Witness { figure, data, run: label, points, seconds });
                write(&list)?;
            }
        }
    }
    Ok(())
}

/// True if the runs of a figure took little time on average.
fn likely_short(number: &str) -> Result<bool> {
    let path = pages::kept_file(number);
    let Ok(text) = fs::read_to_string(&path) else { return Ok(false) };
    let kept: super::Kept = serde_json::from_str(&text).with_context(|| path.display().to_string())?;
    Ok(kept.seconds < 2.0 * LONGEST * kept.runs.max(1) as f64)
}

fn write(list: &[Witness]) -> Result<()> {
    let path: &Path = &file();
    let mut table = csv::Writer::from_path(path).with_context(|| path.display().to_string())?;
    list.iter().try_for_each(|witness| table.serialize(witness))?;
    Ok(table.flush()?)
}

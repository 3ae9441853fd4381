//! The tables.

use motile_tests::validation::Table;

use motile_cli::run::Summary;

use crate::tables::took;
use crate::work_precision::cost::UNIT;
use crate::work_precision::front::{Point, cheapest, expense, front};
use crate::work_precision::settings::Settings;
use crate::work_precision::studies::Study;

/// Errors that the tables are made for.
const TARGETS: [f64; 3] = [0.01, 0.003, 0.001];
/// Methods that are compared.
const FAMILIES: [&str; 3] = ["boundary integrals", "grid, corrected", "thesis"];

/// The points on the front of each scene and the presets; the cheapest settings for given errors, and what Cowley's
/// scheme costs in comparison.
pub(crate) fn tables(points: &[Point]) -> Vec<Table> {
    let mut table = empty();
    for study in Study::all() {
        let own: Vec<Point> = points.iter().filter(|point| point.study == study).cloned().collect();
        section(&mut table, study, &own);
    }
    vec![table, summary(points)]
}

/// The first table without its rows.
pub(crate) fn empty() -> Table {
    let title = format!(
        "Error and cost: settings than which nothing is both cheaper and more accurate (front), and the presets; one \
         pair is one forward and one inverse real FFT of {UNIT} x {UNIT} values, one thread"
    );
    let columns = "scene | settings | method | error in % | pairs per time | seconds per time | steps per time | \
        front | preset";
    Table::new(&title, columns)
}

/// First cells of a row.
pub(crate) fn name(study: Study, settings: &Settings) -> String {
    format!("{} | {} | {}", study.title(), settings.label(), settings.family())
}

/// The other cells of a row.
pub(crate) fn cells(point: &Summary, front: &str, preset: &str) -> String {
    let (error, [pairs, seconds, steps]) = (
        per_cent(point.number("error")),
        ["pairs_per_time", "seconds_per_time", "steps_per_time"].map(|name| point.number(name)),
    );
    format!("{error} | {pairs:.1} | {seconds:.2e} | {steps:.1} | {front} | {preset}")
}

fn per_cent(value: f64) -> String {
    let value = 100.0 * value;
    if value.abs() < 0.095 { format!("{value:.1e}") } else { format!("{value:.2}") }
}

/// Two digits, which is what factors of costs are good to.
fn rounded(value: f64) -> String {
    if value < 100.0 { format!("{value:.0}") } else { format!("{value:.1e}") }
}

/// The front of a scene and the presets.
fn section(table: &mut Table, study: Study, points: &[Point]) {
    let front = front(points);
    let on_front = |point: &Point| front.iter().any(|other| std::ptr::eq(*other, point));
    let mut shown: Vec<&Point> =
        points.iter().filter(|point| on_front(point) || point.settings.is_preset().is_some()).collect();
    shown.sort_by(|a, b| a.pairs().total_cmp(&b.pairs()));
    for point in shown {
        let (name, front) = (name(study, &point.settings), if on_front(point) { "yes" } else { "no" });
        let preset = point.settings.is_preset().unwrap_or_default();
        table.row(format_args!("{name} | {}", cells(&point.summary, front, preset)));
        took(table, &name, point.summary.number("seconds"));
    }
}

/// The cheapest settings for given errors, and what the scheme of Cowley costs in comparison.
fn summary(points: &[Point]) -> Table {
    let mut table = Table::new(
        "The cheapest settings whose error and that of all refinements is at most the target; cost in pairs per time \
         and, in brackets, the factor by which the scheme of Cowley costs more for the same error (about: extrapolated \
         from its finest grids)",
        "scene | method | 1 % | 0.3 % | 0.1 %",
    );
    for study in Study::all() {
        for family in FAMILIES {
            let of = |family: &str| -> Vec<&Point> {
                points.iter().filter(|point| point.study == study && point.settings.family() == family).collect()
            };
            let own = of(family);
            if own.is_empty() {
                continue;
            }
            let thesis = of("thesis");
            let cells = TARGETS.map(|target| {
                let Some(point) = cheapest(&own, target) else {
                    let further = expense(&own, target).and_then(|found| Some((found.pairs, found.extrapolated?)));
                    return further.map_or("not reached".to_owned(), |(pairs, (h, order))| {
                        format!("about {pairs:.1e} at h = {h:.1e} (order {order:.1})")
                    });
                };
                let factor = expense(&thesis, target)
                    .filter(|_| family != "thesis")
                    .map(|other| {
                        let sign = if other.extrapolated.is_some() { "about " } else { "" };
                        format!(" ({sign}{})", rounded(other.pairs / point.pairs()))
                    })
                    .unwrap_or_default();
                format!("{}: {:.1}{factor}", point.settings.label(), point.pairs())
            });
            table.push([study.title().to_owned(), family.to_owned()].into_iter().chain(cells));
        }
    }
    table
}

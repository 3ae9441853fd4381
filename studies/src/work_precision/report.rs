//! The Markdown page.

use std::fmt::Write as _;

use motile_timing::median;

use crate::work_precision::cost::UNIT;
use crate::work_precision::front::{Point, cheapest, expense, front};
use crate::work_precision::studies::Study;

/// Errors that the tables are made for.
const TARGETS: [f64; 3] = [0.01, 0.003, 0.001];
/// Methods that are compared.
const FAMILIES: [&str; 4] = ["boundary integrals", "grid, corrected", "grid, arithmetic", "thesis"];

/// Where and by what the page was made.
#[derive(Debug)]
pub(crate) struct Circumstances {
    pub(crate) machine: String,
    pub(crate) commit: String,
    pub(crate) command: String,
}

/// The page for all points; pictures beside it are in `pictures`.
pub(crate) fn page(points: &[Point], circumstances: &Circumstances, pictures: &str) -> String {
    let mut pairs: Vec<f64> = points.iter().map(|point| point.summary.number("pair_us")).collect();
    let pair = median(&mut pairs);
    let mut page = String::new();
    // Writing to a string cannot fail.
    let _ = writeln!(
        page,
        "# Speed against error\n\nMade by `{}`.\n\n{}, commit {}, one thread. The unit of cost is one real transform \
         of {UNIT} x {UNIT} values there and back, done plainly with realfft by turns with the steps; here it takes \
         {pair:.0} us (median). Seconds are medians over the steps of a run, or the mean processor time where that is \
         less. A point is on the front, marked *, if no other one of its scene is both cheaper and more accurate. All \
         points are in `points.csv`.\n",
        circumstances.command, circumstances.machine, circumstances.commit
    );
    let _ = writeln!(page, "{}", summary(points));
    for study in Study::ALL {
        let own: Vec<Point> = points.iter().filter(|point| point.study == study).cloned().collect();
        if !own.is_empty() {
            let _ = writeln!(page, "## {}\n\n{}\n", study.title(), study.about());
            let _ = writeln!(page, "![Cost and error]({pictures}{}.svg)\n", study.name());
            let _ = writeln!(page, "{}", section(&own));
        }
    }
    page
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
fn section(points: &[Point]) -> String {
    let front = front(points);
    let on_front = |point: &Point| front.iter().any(|other| std::ptr::eq(*other, point));
    let mut shown: Vec<&Point> =
        points.iter().filter(|point| on_front(point) || point.settings.is_preset().is_some()).collect();
    shown.sort_by(|a, b| a.pairs().total_cmp(&b.pairs()));
    let mut text = String::from(
        "| | settings | method | error, % | pairs per time | seconds per time | steps per time |\n\
         |---|---|---|---|---|---|---|\n",
    );
    for point in shown {
        let preset = point.settings.is_preset().map(|name| format!(" **{name}**")).unwrap_or_default();
        let _ = writeln!(
            text,
            "| {}{preset} | {} | {} | {} | {:.1} | {:.2e} | {:.1} |",
            if on_front(point) { "*" } else { "" },
            point.settings.label(),
            point.settings.family(),
            per_cent(point.summary.number("error")),
            point.pairs(),
            point.summary.number("seconds_per_time"),
            point.summary.number("steps_per_time"),
        );
    }
    text
}

/// The cheapest settings for given errors, and what the thesis' method costs in comparison.
fn summary(points: &[Point]) -> String {
    let mut text = String::from(
        "## The coarsest settings\n\nThe cheapest settings whose error, and that of all refinements tried, is at most \
         the target; cost in pairs per time and, in brackets, the factor by which the thesis' method costs more for \
         the same error. \"About\": nothing so accurate was run; extrapolated from the finest grid and the next one \
         about twice as coarse, error and cost as powers of h.\n\n\
         | scene | method | 1 % | 0.3 % | 0.1 % |\n|---|---|---|---|---|\n",
    );
    for study in Study::ALL {
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
            let _ = writeln!(text, "| {} | {family} | {} |", study.title(), cells.join(" | "));
        }
    }
    text
}

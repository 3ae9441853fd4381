//! A figure of the book: what its file says, and what comes of its data.

use std::collections::{BTreeMap, BTreeSet};

use anyhow::{Context, Result, bail, ensure};
use motile_output::plot::{AxisScale, Marker, Plot, SERIES_COLOURS, Series};
use serde::{Deserialize, Serialize};

use super::data::{Data, POINTS, Source};
use super::expression::{Definitions, Expression, Row};
use super::statistics::{Measure, mean, same, shown};
use super::{ENVIRONMENT, chapter_of};

/// Longest list `name_*`.
const MOST_POINTS: usize = 20_000;

/// Verdict of the converged results on a statement of the thesis.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Deserialize)]
pub(super) enum Verdict {
    #[serde(rename = "confirmed")]
    Confirmed,
    #[serde(rename = "confirmed in part")]
    ConfirmedInPart,
    #[serde(rename = "discretisation")]
    Discretisation,
    #[serde(rename = "refuted")]
    Refuted,
    #[serde(rename = "undecided")]
    Undecided,
    /// The figure shows something that could not be otherwise.
    #[serde(rename = "no claim")]
    NoClaim,
}

impl Verdict {
    pub(super) fn name(self) -> &'static str {
        match self {
            Self::Confirmed => "confirmed",
            Self::ConfirmedInPart => "confirmed in part",
            Self::Discretisation => "discretisation",
            Self::Refuted => "refuted",
            Self::Undecided => "undecided",
            Self::NoClaim => "no claim",
        }
    }

    /// True if it says something of the statement, so that a number has to be able to speak against it.
    pub(super) fn decides(self) -> bool {
        !matches!(self, Self::Undecided | Self::NoClaim)
    }
}

/// A file of `studies/book`.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields, rename_all = "kebab-case")]
pub(super) struct Figure {
    /// Its number, which is not in the file.
    #[serde(skip)]
    pub(super) number: String,
    pub(super) title: String,
    /// What colours and panels of its picture mean, in a sentence.
    #[serde(default)]
    pub(super) legend: String,
    /// What the thesis calls the place of the statement, where its number is not that, such as "Section B.1".
    #[serde(default)]
    pub(super) place: Option<String>,
    /// The statement and what was found, each in a few words, for tables; marks in the finding stand for numbers.
    #[serde(default)]
    pub(super) claim: String,
    #[serde(default)]
    pub(super) finding: String,
    /// Its axes in words, where those of its panels are too long.
    axes: Option<String>,
    /// The claims of `says` that ranges test, in short, of a question of the second part.
    #[serde(default)]
    pub(super) asks: String,
    /// Statement of the thesis, in its words or close to them; of a question of the second part the one to be tested.
    pub(super) says: String,
    /// Of a figure of the thesis; that of a question of the second part follows from its numbers.
    pub(super) verdict: Option<Verdict>,
    pub(super) why: String,
    /// Parts of the statement that its data do not decide, so that it is confirmed in part at most.
    pub(super) open: Option<String>,
    /// Names of files of `studies/book/data`.
    #[serde(default)]
    pub(super) data: Vec<String>,
    /// A command that makes it, where that is not `figure`.
    pub(super) command: Option<String>,
    /// Processor time that its data took (seconds), where the clock's is not said as the machine was busy.
    pub(super) processor: Option<f64>,
    /// A picture under docs.
    pub(super) picture: Option<String>,
    /// Names of expressions.
    #[serde(default)]
    define: Definitions,
    /// Names of numbers that other figures found.
    #[serde(default)]
    known: BTreeMap<String, Known>,
    #[serde(default)]
    panel: Vec<Panel>,
    #[serde(default)]
    check: Vec<Check>,
}

/// The y of the point of another figure's curve whose x is the group of a row, 0 where there is none.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields, rename_all = "kebab-case")]
struct Known {
    figure: String,
    /// Label of the curve, and its group where there are several.
    curve: String,
    group: Option<f64>,
}

impl Known {
    fn expression(&self) -> Result<String> {
        let points = Data::of_points(&format!("{POINTS}-{}", self.figure), &self.figure)?;
        let wanted = |row: &&Row| {
            let group = self.group.is_none_or(|group| row.get("group").is_some_and(|found| same(*found, group)));
            group && row.contains_key(&super::data::plain(&self.curve))
        };
        let term = |row: &Row| Some(format!("(group == {}) * {}", row.get("x")?, row.get("y")?));
        let terms: Vec<String> = points.rows.iter().filter(wanted).filter_map(term).collect();
        ensure!(!terms.is_empty(), "figure {} has no points of the curve '{}'", self.figure, self.curve);
        Ok(format!("({})", terms.join(" + ")))
    }
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields, rename_all = "kebab-case")]
struct Panel {
    #[serde(default)]
    title: String,
    x: String,
    y: String,
    #[serde(default)]
    logarithmic: bool,
    /// The axis of y too.
    #[serde(default)]
    logarithmic_y: bool,
    /// Lists of points are closed curves in the plane.
    #[serde(default)]
    shapes: bool,
    curve: Vec<Curve>,
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields, rename_all = "kebab-case")]
struct Curve {
    #[serde(flatten)]
    points: Points,
    /// With `{}` for the value of the group.
    #[serde(default)]
    label: String,
    #[serde(default)]
    line: bool,
    #[serde(default)]
    dashed: bool,
}

/// Points of one or several groups.
#[derive(Debug, Deserialize)]
#[serde(rename_all = "kebab-case")]
struct Points {
    /// Which data; the first if nothing is said.
    data: Option<String>,
    /// Expressions: one, or several points of each row; `name_*` is `name_0`, `name_1` ..., and `name_*_*` several such
    /// lists, each a line of its own.
    x: Several,
    y: Several,
    /// Error of y, shown as a bar where it is of one row.
    error: Option<String>,
    by: Option<String>,
    #[serde(rename = "where")]
    wanted: Option<String>,
}

#[derive(Debug, Clone, Deserialize)]
#[serde(untagged)]
enum Several {
    One(String),
    List(Vec<String>),
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields, rename_all = "kebab-case")]
struct Check {
    name: String,
    measure: Measure,
    #[serde(flatten)]
    points: Points,
    /// Where the number is for the verdict to stand, stated before it is found.
    within: Option<[f64; 2]>,
    /// The number if the contrary of the verdict were so: outside of the range.
    opposite: Option<f64>,
    /// Of a share, the number of runs with those that were lost.
    runs: Option<usize>,
}

/// A number that was found, as it is kept.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub(super) struct Checked {
    pub(super) name: String,
    pub(super) text: String,
}

impl Checked {
    /// True if nothing was found.
    pub(super) fn is_empty(&self) -> bool {
        self.text.is_empty() || self.values().all(f64::is_nan)
    }

    /// The numbers in the text, without what is said beside them.
    fn values(&self) -> impl Iterator<Item = f64> + '_ {
        let number = |part: &str| {
            let part = part.split(" (").next().unwrap_or(part);
            part.rsplit(": ").next().unwrap_or(part).trim().parse().unwrap_or(f64::NAN)
        };
        self.text.split("; ").map(number)
    }
}

/// A check of a figure with what was found; nothing where that is not known.
#[derive(Debug)]
pub(super) struct Judged {
    pub(super) name: String,
    pub(super) text: Option<String>,
    pub(super) within: Option<[f64; 2]>,
    pub(super) opposite: Option<f64>,
    /// True if the verdict can stand.
    pub(super) stands: bool,
    /// Of shares, the number of runs with those that were lost.
    runs: Option<usize>,
}

/// One of the numbers that a check found.
#[derive(Debug, Default)]
pub(super) struct Single {
    pub(super) group: Option<String>,
    pub(super) value: String,
    /// What is said beside it, such as its error.
    pub(super) beside: String,
}

impl Judged {
    /// The numbers that were found, each of its group.
    pub(super) fn results(&self) -> Vec<Single> {
        let single = |part: &str| {
            let (value, beside) = part.split_once(" (").unwrap_or((part, ""));
            let (group, value) = value.split_once(": ").map_or((None, value), |(group, value)| (Some(group), value));
            let mut beside = beside.strip_suffix(')').unwrap_or(beside).to_owned();
            beside += &self.bounds(value, &beside).unwrap_or_default();
            Single { group: group.map(str::to_owned), value: value.to_owned(), beside }
        };
        let text = self.text.as_deref().filter(|text| !text.is_empty());
        text.map(|text| text.split("; ").map(single).collect()).unwrap_or_default()
    }

    /// The shares if all runs that were lost had gone one way or the other.
    fn bounds(&self, share: &str, beside: &str) -> Option<String> {
        let found: f64 = beside.strip_prefix("of ")?.split(',').next()?.parse().ok()?;
        let (all, share) = (self.runs? as f64, share.parse::<f64>().ok()?);
        let (yes, lost) = ((share * found).round(), all - found);
        let [low, high] = [yes / all, (yes + lost) / all].map(shown);
        Some(format!(", with the {lost} lost runs on either side {low} to {high}"))
    }

    /// True for a number that the contrary of a statement would make another.
    fn decides(&self) -> bool {
        self.opposite.is_some()
    }
}

/// A point of a figure, as it is kept.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Point {
    pub(super) panel: usize,
    /// Label of its curve.
    pub(super) curve: String,
    pub(super) group: String,
    pub(super) x: f64,
    pub(super) y: f64,
    pub(super) deviation: f64,
}

impl Point {
    /// Of a line of the file, in which labels may have commas.
    pub(super) fn read(line: &str) -> Option<Self> {
        let (panel, rest) = line.split_once(',')?;
        let mut parts = rest.rsplitn(5, ',');
        let mut next = || parts.next();
        let (deviation, y, x, group, curve) = (next()?, next()?, next()?, next()?, next()?);
        let number = |text: &str| text.parse().ok();
        Some(Self {
            panel: panel.parse().ok()?,
            curve: curve.to_owned(),
            group: group.to_owned(),
            x: number(x)?,
            y: number(y)?,
            deviation: number(deviation).unwrap_or(f64::NAN),
        })
    }
}

/// Points of a group in the order of x, with the standard deviations of those that are means.
type Group = (f64, Vec<(f64, f64, f64)>);

impl Figure {
    pub(super) fn number_of_data(&self) -> usize {
        self.data.len()
    }

    /// Names of its checks with their ranges and the numbers of their contraries.
    #[cfg(test)]
    pub(super) fn ranges(&self) -> impl Iterator<Item = (&str, Option<[f64; 2]>, Option<f64>)> {
        self.check.iter().map(|check| (check.name.as_str(), check.within, check.opposite))
    }

    /// The axes of its panels, in words.
    pub(super) fn axes(&self) -> String {
        if let Some(axes) = &self.axes {
            return axes.clone();
        }
        let of = |axis: fn(&Panel) -> &String| {
            let mut all: Vec<String> = Vec::new();
            for panel in &self.panel {
                let plain =
                    axis(panel).replace("R_{0}", "R0").replace("c_{0}", "c0").replace("_{", "_").replace('}', "");
                if !all.contains(&plain) {
                    all.push(plain);
                }
            }
            all.join(", ")
        };
        if self.panel.is_empty() {
            return String::new();
        }
        format!("{} (across), {} (up)", of(|panel| &panel.x), of(|panel| &panel.y))
    }

    /// True for data that a panel shows.
    pub(super) fn shows(&self, name: &str) -> bool {
        let curves = || self.panel.iter().flat_map(|panel| &panel.curve);
        curves().any(|curve| curve.points.data.as_ref().or(self.data.first()).is_some_and(|data| data == name))
    }

    /// All that is found, or a sentence about what is wrong in its file. What was found `before` stays where its data
    /// are not there.
    pub(super) fn checks(
        &self,
        common: &Definitions,
        data: &BTreeMap<String, Data>,
        before: &[Checked],
    ) -> Result<Vec<Checked>> {
        let definitions = self.definitions(common)?;
        let found = |check: &Check| {
            let is_there = check.points.data.as_ref().or(self.data.first()).is_some_and(|name| data.contains_key(name));
            match before.iter().find(|one| one.name == check.name).filter(|_| !is_there) {
                Some(before) => Ok(before.clone()),
                None => self.checked(check, &definitions, data).context(check.name.clone()),
            }
        };
        self.check.iter().map(found).collect()
    }

    fn checked(&self, check: &Check, definitions: &Definitions, data: &BTreeMap<String, Data>) -> Result<Checked> {
        let mut texts = Vec::new();
        for (group, points) in self.groups(&check.points, definitions, data)? {
            // Every point for itself: scatter is part of what is found.
            let pairs: Vec<(f64, f64)> = points.iter().map(|(x, y, _)| (*x, *y)).collect();
            let (value, beside) = check.measure.of(&pairs);
            let of = if group.is_nan() { String::new() } else { format!("{}: ", shown(group)) };
            let beside = if beside.is_empty() { beside } else { format!(" ({beside})") };
            texts.push(format!("{of}{}{beside}", shown(value)));
        }
        Ok(Checked { name: check.name.clone(), text: texts.join("; ") })
    }

    /// Names of points of other figures that its checks are of.
    pub(super) fn others(&self) -> impl Iterator<Item = &str> {
        let names = self.check.iter().filter_map(|check| check.points.data.as_deref());
        names.filter(|name| name.starts_with("points-"))
    }

    /// Kept results of checks of runs, and checks that need none found anew: of points that are kept, of tables, of
    /// lists of numbers.
    pub(super) fn found(&self, common: &Definitions, kept: &[Checked]) -> Result<Vec<Checked>> {
        let definitions = self.definitions(common)?;
        let mut found = Vec::new();
        let mut left: Vec<&Checked> = kept.iter().collect();
        for check in &self.check {
            let name = check.points.data.as_ref().or(self.data.first()).context("a figure without data")?;
            let points = Data::is_of_points(name).then(|| Data::of_points(name, &self.number)).transpose()?;
            let data = match points {
                Some(points) => Some(points),
                None => Source::read(name)?.kept()?,
            };
            let place = left.iter().position(|one| one.name == check.name);
            let kept = place.map(|place| left.remove(place).clone());
            match data {
                Some(data) => {
                    let data = BTreeMap::from([(name.clone(), data)]);
                    found.push(self.checked(check, &definitions, &data).context(check.name.clone())?);
                }
                None => found.extend(kept),
            }
        }
        Ok(found)
    }

    /// Every check with what was found, and whether the verdict can stand with it.
    pub(super) fn judged(&self, found: &[Checked]) -> Vec<Judged> {
        let mut left: Vec<&Checked> = found.iter().collect();
        let judged = |check: &Check| -> Judged {
            let place = left.iter().position(|one| one.name == check.name);
            let found = place.map(|place| left.remove(place));
            let holds = |value: f64| check.within.is_none_or(|[low, high]| (low..=high).contains(&value));
            // Nothing to measure is no confirmation.
            let stands = found.is_some_and(|found| !found.text.is_empty() && found.values().all(holds));
            Judged {
                name: check.name.clone(),
                text: found.map(|found| found.text.clone()),
                within: check.within,
                opposite: check.opposite,
                stands: stands || check.within.is_none(),
                runs: check.runs,
            }
        };
        self.check.iter().map(judged).collect()
    }

    /// The verdict that follows from the numbers: of the statement if all of the numbers that decide are in their
    /// ranges, against it if none is; none at all if an error is larger than stated.
    pub(super) fn followed(judged: &[Judged]) -> Verdict {
        let deciding: Vec<bool> = judged.iter().filter(|check| check.decides()).map(|check| check.stands).collect();
        let resolved = judged.iter().all(|check| check.decides() || check.stands);
        match deciding.iter().filter(|stands| **stands).count() {
            _ if !resolved || deciding.is_empty() => Verdict::Undecided,
            0 => Verdict::Refuted,
            count if count == deciding.len() => Verdict::Confirmed,
            _ => Verdict::ConfirmedInPart,
        }
    }

    /// A sentence about a verdict without a number that could speak against it.
    pub(super) fn lacks(&self) -> Option<String> {
        let outside = |check: &Check| match (check.within, check.opposite) {
            (Some([low, high]), Some(opposite)) => Some(!(low..=high).contains(&opposite)),
            (None, Some(_)) => Some(false),
            _ => None,
        };
        let opposites: Vec<bool> = self.check.iter().filter_map(outside).collect();
        if opposites.iter().any(|outside| !outside) {
            return Some("the contrary of a statement is within the range for it".to_owned());
        }
        let second = chapter_of(&self.number) == ENVIRONMENT;
        if second && self.verdict.is_some() {
            return Some("a verdict beforehand, where it follows from the numbers".to_owned());
        }
        let decides = second || self.verdict.is_some_and(Verdict::decides);
        (decides && opposites.is_empty())
            .then(|| "no range that the contrary of the statement is outside of".to_owned())
    }

    fn definitions(&self, common: &Definitions) -> Result<Definitions> {
        let mut all: Definitions = common.clone();
        all.extend(self.define.clone());
        for (name, known) in &self.known {
            all.insert(name.clone(), known.expression().with_context(|| name.clone())?);
        }
        Ok(all)
    }

    /// Number of panels.
    pub(super) fn panel_count(&self) -> usize {
        self.panel.len()
    }

    /// Panels and, as text, the points in them. Curves whose data are not there have the points of `before`. Without
    /// points, a panel is left out of a quick version, and an error otherwise.
    pub(super) fn panels(
        &self,
        common: &Definitions,
        data: &BTreeMap<String, Data>,
        before: &[Point],
        quick: bool,
    ) -> Result<(Vec<Plot>, String)> {
        let definitions = self.definitions(common)?;
        let mut table = String::from("panel,curve,group,x,y,deviation\n");
        let mut plots = Vec::new();
        for (k, panel) in self.panel.iter().enumerate() {
            let scale = |log| if log { AxisScale::Logarithmic } else { AxisScale::Linear };
            let mut plot = Plot::new(&panel.title)
                .x_axis(&panel.x, scale(panel.logarithmic))
                .y_axis(&panel.y, scale(panel.logarithmic_y));
            if panel.shapes {
                plot = plot.equal_units();
            }
            let mut colours: Vec<f64> = Vec::new();
            for curve in &panel.curve {
                let name = curve.points.data.as_ref().or(self.data.first());
                let groups = match name.filter(|name| data.contains_key(*name)) {
                    None if !before.is_empty() && !panel.shapes => of_before(before, k + 1, &curve.label),
                    _ => self.groups(&curve.points, &definitions, data).with_context(|| panel.title.clone())?,
                };
                for (group, points) in groups {
                    // The same groups of another curve of a panel have the same colour.
                    let known = colours.iter().position(|other| same(*other, group));
                    let own = known.unwrap_or(colours.len());
                    colours.extend(known.is_none().then_some(group));
                    let label = curve.label.replace("{}", &shown(group).replace('-', "−"));
                    let colour = SERIES_COLOURS[own % SERIES_COLOURS.len()];
                    let points = if panel.shapes { points } else { means(&points) };
                    for (x, y, deviation) in points.iter().filter(|(x, ..)| x.is_finite()) {
                        table += &format!("{},{},{},{x},{y},{deviation}\n", k + 1, curve.label, shown(group));
                    }
                    let closed = panel.shapes && points.iter().all(|(x, ..)| x.is_finite());
                    let again = points.first().filter(|_| closed);
                    let line = points.iter().chain(again).map(|(x, y, _)| (*x, *y));
                    let series = match (curve.line, curve.dashed) {
                        (_, true) => Series::line(&label, line).dashed(),
                        (true, false) => Series::line(&label, line),
                        (false, false) => Series::points(&label, line).marker(Marker::Disc),
                    };
                    plot = plot.series(series.colour(colour));
                    let bars = points.iter().filter(|(.., deviation)| *deviation > 0.0);
                    let bars: Vec<_> =
                        bars.flat_map(|(x, y, d)| [(*x, y - d), (*x, y + d), (f64::NAN, f64::NAN)]).collect();
                    if !bars.is_empty() {
                        plot = plot.series(Series::line("", bars).colour(colour));
                    }
                }
            }
            // A source may have nothing, as a bisection without a boundary.
            let of = |curve: &Curve| curve.points.data.as_ref().or(self.data.first()).and_then(|name| data.get(name));
            let without = panel.curve.iter().all(|curve| of(curve).is_some_and(|data| data.rows.is_empty()));
            ensure!(!colours.is_empty() || without || quick, "panel '{}': no points", panel.title);
            plots.extend((!colours.is_empty()).then_some(plot));
        }
        Ok((plots, table))
    }

    /// The points of all panels that the data make, without curves of which the data have no column.
    pub(super) fn points(&self, common: &Definitions, data: &BTreeMap<String, Data>) -> Result<Vec<Point>> {
        let definitions = self.definitions(common)?;
        let mut all = Vec::new();
        for (k, panel) in self.panel.iter().enumerate() {
            for curve in &panel.curve {
                for (group, points) in self.groups(&curve.points, &definitions, data).unwrap_or_default() {
                    let (panel, label, group) = (k + 1, &curve.label, shown(group));
                    let points = points.into_iter().filter(|(x, ..)| x.is_finite());
                    all.extend(points.map(|(x, y, deviation)| {
                        let (curve, group) = (label.clone(), group.clone());
                        Point { panel, curve, group, x, y, deviation }
                    }));
                }
            }
        }
        Ok(all)
    }

    fn groups(&self, points: &Points, definitions: &Definitions, data: &BTreeMap<String, Data>) -> Result<Vec<Group>> {
        let name = points.data.as_ref().or(self.data.first()).context("a figure without data")?;
        let listed = self.data.contains(name) || Data::is_of_points(name);
        ensure!(listed, "data {name} is not among those of the figure: {}", self.data.join(", "));
        let rows = &data.get(name).with_context(|| format!("no data {name}"))?.rows;
        let known: BTreeSet<&str> = rows.iter().flat_map(|row| row.keys().map(String::as_str)).collect();
        let parse = |text: &str| -> Result<Expression> {
            let found = Expression::parse(text, definitions)?;
            // Without rows nothing is known; a word in a table's column need not be there.
            let word = |name: &str| {
                let stem = name.rsplit_once('_').filter(|_| name.starts_with("t_"));
                stem.is_some_and(|(stem, _)| known.iter().any(|n| n.starts_with(&format!("{stem}_"))))
            };
            let missing = found.names().into_iter().find(|n| !known.contains(n) && !word(n));
            if let (Some(name), false) = (missing, rows.is_empty()) {
                let near: Vec<&str> = known.iter().copied().filter(|n| n.contains(name)).take(8).collect();
                bail!("expression '{text}': no column {name}, of {}; near: {}", known.len(), near.join(", "));
            }
            Ok(found)
        };
        let several = |which: &Several| -> Result<Vec<Expression>> {
            let texts = match which {
                Several::List(list) => list.clone(),
                Several::One(text) => {
                    let list = |stem: String| {
                        let names = (0..MOST_POINTS).map(move |k| format!("{stem}{k}"));
                        names.take_while(|name| known.contains(name.as_str()))
                    };
                    match (text.strip_suffix("*_*"), text.strip_suffix('*')) {
                        (Some(stem), _) => {
                            let lists = (0..MOST_POINTS).map(|k| list(format!("{stem}{k}_")).collect::<Vec<_>>());
                            let lists = lists.take_while(|list| !list.is_empty());
                            lists.flat_map(|list| list.into_iter().chain(["0/0".to_owned()])).collect()
                        }
                        (None, Some(stem)) => list(stem.to_owned()).collect(),
                        (None, None) => vec![text.clone()],
                    }
                }
            };
            texts.iter().map(|text| parse(text)).collect()
        };
        let (x, y) = (several(&points.x)?, several(&points.y)?);
        ensure!(x.len() == y.len(), "{} places and {} values. Use equally many", x.len(), y.len());
        let is_list = matches!(&points.x, Several::One(text) if text.ends_with('*'));
        let has_ends = matches!(&points.x, Several::One(text) if text.ends_with("*_*"));
        let by = points.by.as_deref().map(&parse).transpose()?;
        let error = points.error.as_deref().map(&parse).transpose()?;
        let wanted = points.wanted.as_deref().map(&parse).transpose()?;
        let mut groups: Vec<Group> = Vec::new();
        let is_wanted = |row: &&Row| wanted.as_ref().is_none_or(|wanted| wanted.value(row) == 1.0);
        for row in rows.iter().filter(is_wanted) {
            let group = by.as_ref().map_or(f64::NAN, |by| by.value(row));
            let error = error.as_ref().map_or(0.0, |error| error.value(row));
            let values = x.iter().zip(&y).map(|(x, y)| (x.value(row), y.value(row), error));
            let values: Vec<_> = values.filter(|(x, y, _)| has_ends || x.is_finite() && y.is_finite()).collect();
            match groups.iter_mut().find(|(other, _)| same(*other, group) || other.is_nan() && group.is_nan()) {
                Some((_, points)) => points.extend(values),
                None => groups.push((group, values)),
            }
        }
        groups.retain(|(_, points)| !points.is_empty());
        groups.sort_by(|a, b| a.0.total_cmp(&b.0));
        if !is_list {
            groups.iter_mut().for_each(|(_, points)| points.sort_by(|a, b| a.0.total_cmp(&b.0)));
        }
        Ok(groups)
    }
}

/// The groups of a curve in points that were made before.
fn of_before(before: &[Point], panel: usize, label: &str) -> Vec<Group> {
    let mut groups: Vec<(&str, Group)> = Vec::new();
    for point in before.iter().filter(|point| point.panel == panel && point.curve == label) {
        let place = (point.x, point.y, point.deviation);
        match groups.iter_mut().find(|(name, _)| *name == point.group) {
            Some((_, (_, points))) => points.push(place),
            None => groups.push((&point.group, (point.group.parse().unwrap_or(f64::NAN), vec![place]))),
        }
    }
    groups.into_iter().map(|(_, group)| group).collect()
}

/// Points that follow each other at the same x as one, with its standard deviation; of a single one with its error.
fn means(points: &[(f64, f64, f64)]) -> Vec<(f64, f64, f64)> {
    let of = |group: &[(f64, f64, f64)]| {
        let (y, deviation) = mean(group.iter().map(|p| p.1));
        (group[0].0, y, if group.len() == 1 { group[0].2 } else { deviation })
    };
    points.chunk_by(|a, b| same(a.0, b.0)).map(of).collect()
}

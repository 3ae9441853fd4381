//! Data of the figures of the book: runs of a plan, steady states of a plan, tables of `docs/tables`.

use std::path::{Path, PathBuf};

use anyhow::{Context, Result, bail, ensure};
use motile::active_interface::observables::VelocityFrame;
use motile::active_interface::theory::SquirmerFlow;
use motile::base::{FlowSample, Region, Vec2};
use motile::scene::SceneError;
use motile::scene::checkpoint::Checkpoint;
use motile::setup::{Built, Setup};
use motile_cli::run::{Summary, explained, make_directory, say};
use motile_output::{Raster, Samples};
use motile_steady_states::{BranchEnd, Continuation, Parameter, SpecialKind, SpecialPoint, SteadyState};
use serde::Deserialize;
use serde_json::Value;
use toml::Table;

mod bisection;
mod frames;

use super::Making;
use super::expression::Row;
use super::figure::Point;
use crate::tables;
use bisection::Bisection;
use frames::Frames;
use motile_cli::sweep::{Plan, RunPool, State, Trial};

/// Where on a swimmer's axis the flow is looked at: distances from the interface (length), each that times the last.
const NEAREST: f64 = 0.01;
const APART: f64 = 1.1;
const FARTHEST: f64 = 50.0;
/// The square around a swimmer with streamlines in it, its cells, the distance of the lines (length), and which of
/// their points are kept.
const FIELD: f64 = 6.0;
const FIELD_CELLS: usize = 120;
const LINES_APART: f64 = 0.5;
const POINT_OF_LINE: usize = 3;
/// Points of a circle.
const CIRCLE: usize = 96;
/// How far from a droplet's ends in a channel the pressure is looked at, over the channel's width or the droplet's.
const BESIDE: f64 = 0.1;
/// Largest step along a branch that leads to a state, the norm as of [`Continuation`].
const LARGEST_STEP: f64 = 0.2;
/// Most points of a branch to a fold, and the largest relative change of the speed by a step without a branch.
const MOST_POINTS: usize = 30;
const MOST_CHANGE: f64 = 0.3;
/// Longest text that becomes a name.
const LONGEST: usize = 40;

/// A file of `studies/book/data`.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields, rename_all = "kebab-case")]
pub(super) struct Source {
    /// Description in words.
    pub(super) about: String,
    /// A plan as those of [`motile_cli::sweep`], its scene in it.
    #[serde(default)]
    plan: Option<Table>,
    /// Changes with `--quick`.
    #[serde(default)]
    quick: Table,
    /// Steady states of the plan's points rather than runs.
    #[serde(default)]
    steady: bool,
    /// Those that are found at another value of a parameter and followed along it.
    #[serde(default)]
    follow: Option<Follow>,
    /// With streamlines around them, in the frame of the laboratory.
    #[serde(default)]
    streamlines: bool,
    /// With the pressure ahead of the first droplet of runs at their ends, less that behind it.
    #[serde(default)]
    pressures: bool,
    /// Of each point of the plan the boundary between two outcomes.
    #[serde(default)]
    bisect: Option<Bisection>,
    /// Shapes at some times of each run rather than its usual results.
    #[serde(default)]
    frames: Option<Frames>,
    /// Flow of squirmers with these B2 (and B1 = 1) in the frame of the laboratory.
    #[serde(default)]
    squirmers: Vec<f64>,
    /// Data whose plan this is, with changes.
    #[serde(default)]
    of: Option<String>,
    #[serde(default)]
    change: Table,
    /// A scheme that the plan's scene starts from.
    #[serde(default)]
    preset: Option<Preset>,
    /// Or a table of `docs/tables`.
    #[serde(default)]
    table: Option<String>,
    /// Or lists of numbers.
    #[serde(default)]
    numbers: std::collections::BTreeMap<String, Vec<f64>>,
}

/// Value of a parameter from which a branch leads to the state of each point.
#[derive(Debug, Clone, Deserialize)]
#[serde(deny_unknown_fields, rename_all = "kebab-case")]
struct Follow {
    /// Name among [`Parameter::NAMES`].
    parameter: String,
    from: f64,
    /// Values at which the branch is looked at, the scene's own the last one: what it is there rather than the state at
    /// its end.
    #[serde(default)]
    at: Vec<f64>,
}

impl Follow {
    /// The branch of a description up to its value, or to the first fold before: where it ends, speeds and films at the
    /// values that it reaches, and the value and the speed of the fold. A branch that is lost without one says so.
    fn branch(&self, setup: &Setup) -> Result<Summary> {
        let (parameter, to) = self.goal(setup)?;
        let mut summary = Summary::default();
        let mut lists = ["branch_at", "branch_speed", "branch_film"].map(|name| (name, Vec::new()));
        let mut state = SteadyState::find(&parameter.with(setup, self.from)?)?;
        let (mut last, mut speed, mut lost) = (self.from, state.measured()?.speed, false);
        for at in self.at.iter().copied() {
            // In one step where the swimmer changes little by it.
            let next = state.at(parameter, at).ok();
            let found = next.and_then(|next| Some((next.measured().ok()?.speed, next)));
            match found.filter(|(found, _)| (found / speed - 1.0).abs() < MOST_CHANGE) {
                Some((found, next)) => (last, speed, state) = (at, found, next),
                None => {
                    let is_fold = |special: &SpecialPoint| special.kind == SpecialKind::Fold;
                    let range = Continuation::new(parameter, last, to);
                    let along = Continuation { largest_step: LARGEST_STEP, most_points: MOST_POINTS, ..range };
                    let branch = along.follow(&state, |_, special| !special.iter().any(is_fold))?;
                    if let Some(fold) = branch.special.iter().find(|special| is_fold(special)) {
                        summary.put("fold", fold.value, "");
                        summary.put("fold_speed", fold.critical.state.measured()?.speed, "");
                        last = fold.value;
                    } else {
                        lost = true;
                        say(format_args!("the branch in {} is lost at {last}: {}", self.parameter, branch.end));
                    }
                    break;
                }
            }
            let film = narrowness(&state)?[0].unwrap_or(f64::NAN);
            lists.iter_mut().zip([at, speed, film]).for_each(|((_, list), value)| list.push(value));
        }
        summary.put("branch_end", last, "");
        summary.put("lost", lost, "");
        for (name, list) in lists {
            summary.put(name, list, "");
        }
        Ok(summary)
    }

    /// The parameter and its value in a description.
    fn goal(&self, setup: &Setup) -> Result<(Parameter, f64)> {
        let known = Parameter::NAMES.iter().find(|(name, _)| *name == self.parameter);
        let parameter = known.with_context(|| format!("no parameter is named {}", self.parameter))?.1;
        let to = parameter.get(setup).with_context(|| format!("the scene has no parameter {}", self.parameter))?;
        Ok((parameter, to))
    }

    /// The state of a description, at the end of the branch.
    fn state(&self, setup: &Setup) -> Result<SteadyState> {
        let (parameter, to) = self.goal(setup)?;
        let start = SteadyState::find(&parameter.with(setup, self.from)?)?;
        if to == self.from {
            return Ok(start);
        }
        let along = Continuation { largest_step: LARGEST_STEP, ..Continuation::new(parameter, self.from, to) };
        let mut branch = along.follow(&start, |_, _| true)?;
        match branch.end {
            BranchEnd::Range => Ok(branch.points.pop().context("a branch without points")?.state),
            end => bail!("the branch in {} does not lead from {} to {to}: {end}", self.parameter, self.from),
        }
    }
}

#[derive(Debug, Clone, Copy, Deserialize)]
#[serde(rename_all = "kebab-case")]
enum Preset {
    Thesis,
}

/// Rows of one source, and what they took.
#[derive(Debug, Clone, Default)]
pub(super) struct Data {
    pub(super) about: String,
    pub(super) rows: Vec<Row>,
    /// Runs that were wanted; 0 of a table.
    pub(super) wanted: usize,
    /// Seconds of computation.
    pub(super) seconds: f64,
    /// Runs that ended in an error, each with it.
    pub(super) failures: Vec<String>,
}

/// The name of the points of a figure's own panels, and what names of those of another one begin with.
pub(super) const POINTS: &str = "points";

impl Data {
    /// True for the name of points that are kept with a figure.
    pub(super) fn is_of_points(name: &str) -> bool {
        name == POINTS || name.starts_with("points-")
    }

    /// The points that are kept with the figure `own`, or with 3.4 if the name is points-3.4.
    pub(super) fn of_points(name: &str, own: &str) -> Result<Self> {
        let number = name.strip_prefix("points-").unwrap_or(own);
        let path = super::pages::folder().join(format!("figures/{number}.csv"));
        let text = std::fs::read_to_string(&path).with_context(|| path.display().to_string())?;
        Ok(Self::in_points(&text))
    }

    /// Rows with panel, group, x, y and deviation, and a name of the curve's label that is 1.
    pub(super) fn in_points(text: &str) -> Self {
        let row = |line: &str| -> Option<Row> {
            let Point { panel, curve, group, x, y, deviation } = Point::read(line)?;
            let numbers = [("panel", panel as f64), ("x", x), ("y", y), ("deviation", deviation)];
            let mut row: Row = numbers.map(|(name, value)| (name.to_owned(), value)).into();
            row.extend(group.parse().ok().map(|group| ("group".to_owned(), group)));
            row.insert("labelled".to_owned(), f64::from(u8::from(!curve.is_empty())));
            row.insert(plain(&curve), 1.0);
            Some(row)
        };
        let rows = text.lines().skip(1).filter_map(row).collect();
        Self { rows, ..Self::default() }
    }
}

impl Source {
    /// Description, time to which its runs go and their resolution.
    pub(super) fn told(&self) -> String {
        let Some(plan) = &self.plan else { return self.about.clone() };
        let number = |path: &[&str]| {
            let (last, tables) = path.split_last()?;
            let inner = tables.iter().try_fold(plan, |table, key| table.get(*key)?.as_table())?;
            inner.get(*last).map(ToString::to_string)
        };
        let mut words = Vec::new();
        words.extend(number(&["time"]).filter(|_| !self.steady).map(|time| format!("to t = {time}")));
        words.extend(number(&["scene", "method", "integral", "nodes"]).map(|nodes| format!("{nodes} nodes")));
        for method in ["layers", "grid"] {
            words.extend(number(&["scene", "method", method, "spacing"]).map(|h| format!("h = {h}")));
        }
        if words.is_empty() { self.about.clone() } else { format!("{} ({})", self.about, words.join(", ")) }
    }

    pub(super) fn read(name: &str) -> Result<Self> {
        let path = super::directory().join("data").join(format!("{name}.toml"));
        let read = || -> Result<Self> { Ok(toml::from_str(&std::fs::read_to_string(&path)?)?) };
        let mut source = read().with_context(|| path.display().to_string())?;
        let kinds = [source.plan.is_some(), source.table.is_some(), !source.numbers.is_empty()];
        let others = [source.of.is_some(), !source.squirmers.is_empty()];
        let one = kinds.into_iter().chain(others).filter(|given| *given).count() == 1;
        ensure!(one, "{}: give a plan, a table, numbers, squirmers or other data", path.display());
        if let Some(other) = &source.of {
            let mut plan = Self::read(other)?.plan.with_context(|| format!("data {other} have no plan"))?;
            merge(&mut plan, &source.change);
            source.plan = Some(plan);
        }
        Ok(source)
    }

    /// The runs of its plan.
    pub(super) fn trials(&self, name: &str, making: &Making) -> Result<Vec<Trial>> {
        let Some(plan) = self.whole_plan(making)? else { return Ok(Vec::new()) };
        Plan::of(plan).and_then(|plan| plan.trials(&folder(name, making))).with_context(|| format!("data {name}"))
    }

    /// True for boundaries between outcomes of runs, which short runs do not show.
    pub(super) fn is_bisection(&self) -> bool {
        self.bisect.is_some()
    }

    /// Its plan with what a preset and `--quick` change.
    fn whole_plan(&self, making: &Making) -> Result<Option<Table>> {
        let Some(plan) = &self.plan else { return Ok(None) };
        let mut plan = plan.clone();
        if let Some(Preset::Thesis) = self.preset {
            let mut scene: Table = toml::from_str(&Setup::thesis().to_toml()?)?;
            // A region of another kind takes its place.
            if plan.get("scene").and_then(|scene| scene.get("region")).is_some() {
                scene.remove("region");
            }
            let mut whole = Table::from_iter([("scene".to_owned(), scene.into())]);
            merge(&mut whole, &plan);
            plan = whole;
        }
        if making.quick {
            merge(&mut plan, &self.quick);
        }
        if self.steady {
            plan.entry("time").or_insert(toml::Value::Float(1.0));
        }
        Ok(Some(plan))
    }

    /// Its rows if they take no runs: those of a table or of lists of numbers.
    pub(super) fn kept(&self) -> Result<Option<Data>> {
        let rows = match &self.table {
            Some(table) => of_table(table)?,
            None if self.plan.is_some() => return Ok(None),
            None if !self.squirmers.is_empty() => {
                self.squirmers.iter().map(|b2| squirmer(*b2)).collect::<Result<Vec<_>>>()?
            }
            None => {
                let count = self.numbers.values().map(Vec::len).max().unwrap_or(0);
                let row = |k: usize| -> Row {
                    self.numbers.iter().filter_map(|(name, list)| Some((name.clone(), *list.get(k)?))).collect()
                };
                (0..count).map(row).collect()
            }
        };
        Ok(Some(Data { about: self.about.clone(), rows, ..Data::default() }))
    }

    /// Its rows; runs that are not there are made. Failures are told and leave rows out.
    pub(super) fn rows(&self, name: &str, making: &Making) -> Result<Data> {
        if let Some(kept) = self.kept()? {
            return Ok(kept);
        }
        let mut data = Data { about: self.about.clone(), ..Data::default() };
        let trials = self.trials(name, making)?;
        match &self.bisect {
            Some(bisection) => bisection.rows(self, name, making, &trials, &mut data)?,
            None => {
                let rows = self.made(name, making, trials, &mut data)?;
                data.rows = rows.into_iter().flatten().collect();
            }
        }
        Ok(data)
    }

    /// The row of the run of that label, nothing if it fails or is not there.
    pub(super) fn row(&self, name: &str, making: &Making, label: &str) -> Result<Option<Row>> {
        let trials = self.trials(name, making)?.into_iter().filter(|trial| trial.label == label).collect();
        Ok(self.made(name, making, trials, &mut Data::default())?.into_iter().flatten().next())
    }

    /// A row of each run, nothing of those that failed; what they took and failures are added to the data. Runs that
    /// are not there are made.
    fn made(&self, name: &str, making: &Making, trials: Vec<Trial>, data: &mut Data) -> Result<Vec<Option<Row>>> {
        data.wanted += trials.len();
        let labels: Vec<String> = trials.iter().map(|trial| trial.label.clone()).collect();
        let folder = folder(name, making);
        make_directory(&folder)?;
        let mut failed = Vec::new();
        for trial in &trials {
            // What was made from another plan is not taken for this one.
            make_directory(&trial.folder)?;
            trial.keep_scene()?;
            trial.discard_others()?;
            if let State::Failed(failure) = trial.state() {
                failed.push(format!("{}: {failure}", trial.label));
            }
        }
        let trials = trials.into_iter().filter(|trial| !matches!(trial.state(), State::Failed(_))).collect();
        let pool = RunPool::new(&folder, making.threads, making.quiet)?;
        let steady = |trial: &Trial| {
            let started = std::time::Instant::now();
            let setup = &trial.setup;
            let mut summary = match &self.follow {
                Some(follow) if !follow.at.is_empty() => follow.branch(setup)?,
                Some(follow) => steady(&follow.state(setup)?, self.streamlines)?,
                None => steady(&SteadyState::find(setup)?, self.streamlines)?,
            };
            summary.put("seconds", started.elapsed().as_secs_f64(), "");
            Ok(summary)
        };
        let make = |trial: &Trial| match &self.frames {
            Some(frames) => trial.keep(|trial| frames.summary(trial)),
            None if self.steady => trial.keep(steady),
            None => trial.run(),
        };
        let (done, failures) = pool.study(trials, |trial| format!("{}/summary", trial.label), make);
        // What was stopped has not failed, and a figure without it would be another one.
        let stopped = |failure: &&anyhow::Error| matches!(failure.downcast_ref(), Some(SceneError::Stopped { .. }));
        let stopped = failures.iter().filter(stopped).count();
        ensure!(stopped == 0, "data {name}: {stopped} runs were stopped; the same command goes on");
        failed.extend(failures.iter().map(explained));
        for failure in &failed {
            say(format_args!("{name}: left out: {failure}"));
        }
        data.failures.extend(failed);
        data.seconds +=
            done.iter().map(|(_, summary)| summary.number("seconds")).filter(|s| s.is_finite()).sum::<f64>();
        let row = |(trial, summary): &(Trial, Summary)| -> Result<Row> {
            let mut row = Row::new();
            flatten("", &serde_json::to_value(&trial.setup)?, &mut row);
            flatten("", &Value::Object(summary.values().clone()), &mut row);
            if !self.steady && self.frames.is_none() {
                let found = means(&track(trial, "x")?, trial.setup.region.lengths()[0]);
                row.extend(["mean_speed", "late_speed"].map(str::to_owned).into_iter().zip(found));
                let heights = track(trial, "y")?.into_iter().map(|(_, y)| y);
                let aside = heights.fold(0.0, |most: f64, y| if y.abs() > most.abs() { y } else { most });
                row.insert("aside".to_owned(), aside);
            }
            if self.pressures {
                row.insert("pressure_ahead".to_owned(), pressure_ahead(trial)?);
            }
            Ok(row)
        };
        let mut rows = vec![None; labels.len()];
        for pair in &done {
            if let Some(place) = labels.iter().position(|label| *label == pair.0.label) {
                rows[place] = Some(row(pair)?);
            }
        }
        Ok(rows)
    }
}

/// Folder of the runs of a source.
fn folder(name: &str, making: &Making) -> PathBuf {
    making.out.join("data").join(format!("{name}-{}", making.kind()))
}

/// A coordinate of a run's first droplet over the time.
fn track(trial: &Trial, axis: &str) -> Result<Vec<(f64, f64)>> {
    let path = trial.folder.join("trajectory.csv");
    let read = || -> Result<Vec<(f64, f64)>> {
        let mut table = csv::ReaderBuilder::new().comment(Some(b'#')).from_path(&path)?;
        let headers = table.headers()?.clone();
        let place = |name: &str| headers.iter().position(|header| header == name).with_context(|| name.to_owned());
        let (time, x) = (place("time")?, place(axis)?);
        let number = |row: &csv::StringRecord, place: usize| -> Result<f64> { Ok(row[place].parse()?) };
        let point = |row: csv::StringRecord| Ok((number(&row, time)?, number(&row, x)?));
        table.records().map(|row| row.map_err(Into::into).and_then(point)).collect()
    };
    read().with_context(|| path.display().to_string())
}

/// Mean velocities along x of a track (length per time): over its last `distance`, not a number if it is shorter, and
/// over the second half of its time.
fn means(track: &[(f64, f64)], distance: f64) -> [f64; 2] {
    let Some((end, x)) = track.last() else { return [f64::NAN; 2] };
    let half = track.iter().find(|(time, _)| *time >= 0.5 * end);
    let late = half.map_or(f64::NAN, |(time, place)| (x - place) / (end - time));
    [crate::track::mean_speed(track, distance).unwrap_or(f64::NAN), late]
}

/// Least distance of a swimmer from the walls of a straight channel (length), and the pressure a tenth of its width
/// ahead of the droplet less that behind it (force per length); nothing elsewhere.
fn narrowness(state: &SteadyState) -> Result<[Option<f64>; 2]> {
    let Region::Channel { width, .. } = state.setup().region else { return Ok([None; 2]) };
    let places = &state.profile().positions;
    let highest = places.iter().map(|place| place.y.abs()).fold(0.0, f64::max);
    let pressures: Vec<f64> =
        state.sample(&beside(places, BESIDE * width))?.iter().map(|sample| sample.pressure).collect();
    Ok([Some(0.5 * width - highest), Some(pressures[0] - pressures[1])])
}

/// Points on the x axis at this distance ahead of and behind an outline.
fn beside(outline: &[Vec2], distance: f64) -> [Vec2; 2] {
    let ends = |[low, high]: [f64; 2], place: &Vec2| [low.min(place.x), high.max(place.x)];
    let [low, high] = outline.iter().fold([f64::INFINITY, f64::NEG_INFINITY], ends);
    [high + distance, low - distance].map(|x| Vec2::new(x, 0.0))
}

/// The pressure ahead of a run's first droplet at its end less that behind it (force per length), a tenth of the
/// droplet's height from it.
fn pressure_ahead(trial: &Trial) -> Result<f64> {
    let Built { mut scene, droplets, .. } = trial.setup.build()?;
    scene.resume(&Checkpoint::read(&trial.folder.join("checkpoint"))?)?;
    let droplet = *droplets.first().context("a pressure ahead of no droplet")?;
    let outline = scene.body(droplet)?.markers();
    let height = 2.0 * outline.iter().map(|place| place.y.abs()).fold(0.0, f64::max);
    let points = beside(outline, BESIDE * height);
    let mut samples = [FlowSample::default(); 2];
    scene.system_mut().sample(&points, &mut samples)?;
    Ok(samples[0].pressure - samples[1].pressure)
}

/// Where on the axis of a swimmer, ahead of it and behind it, the fluid is at rest: the least distance from the
/// interface (length), as far as fluid of its own is; nothing where it is nowhere.
fn stagnation(state: &SteadyState) -> Result<[Option<f64>; 2]> {
    let heading = state.velocity().try_normalize().unwrap_or_default();
    let along = |x: &Vec2| x.dot(heading);
    let places = state.profile().positions.iter().map(along);
    let [rear, front] = places.fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], x| [low.min(x), high.max(x)]);
    let centre = state.measured()?.centroid;
    let free = state.setup().region.lengths()[0] - (front - rear);
    let reach = (0.5 * free).min(FARTHEST);
    let distances: Vec<f64> =
        std::iter::successors(Some(NEAREST), |d| Some(d * APART)).take_while(|d| *d < reach).collect();
    let side = |start: f64, sign: f64| -> Result<Option<f64>> {
        let points: Vec<Vec2> =
            distances.iter().map(|d| centre + (start + sign * d - along(&centre)) * heading).collect();
        let speeds: Vec<f64> = state.sample(&points)?.iter().map(|sample| along(&sample.velocity)).collect();
        let pairs = distances.windows(2).zip(speeds.windows(2));
        let mut crossings = pairs.filter(|(_, u)| u[0] * u[1] <= 0.0);
        Ok(crossings.next().map(|(d, u)| d[0] + (d[1] - d[0]) * u[0] / (u[0] - u[1])))
    };
    Ok([side(front, 1.0)?, side(rear, -1.0)?])
}

/// Streamlines around a swimmer, from its centroid, to a thousandth of its radius (length).
fn streamlines(state: &SteadyState) -> Result<[Vec<Vec<f64>>; 2]> {
    lines_around(state.measured()?.centroid, |points| {
        Ok(state.sample(points)?.into_iter().map(|sample| sample.velocity).collect())
    })
}

/// Streamlines around a centre, from there, of the velocities that `flow` gives, to a thousandth of a radius (length).
fn lines_around(centre: Vec2, flow: impl FnOnce(&[Vec2]) -> Result<Vec<Vec2>>) -> Result<[Vec<Vec<f64>>; 2]> {
    let corner = centre - Vec2::splat(0.5 * FIELD);
    let raster = Raster::new(corner.into(), [FIELD; 2], [FIELD_CELLS; 2], [false; 2])?;
    let velocities = flow(&raster.points())?;
    let lines = motile_output::streamlines(&Samples::new(raster, velocities)?, LINES_APART, centre)?;
    let every = |line: &[Vec2]| -> Vec<Vec2> {
        let last = line.last().copied();
        line.iter().copied().step_by(POINT_OF_LINE).chain(last).map(|x| ((x - centre) * 1e3).round() * 1e-3).collect()
    };
    let lines: Vec<Vec<Vec2>> = lines.iter().map(|line| every(line)).collect();
    let component = |of: fn(&Vec2) -> f64| lines.iter().map(|line| line.iter().map(of).collect()).collect();
    Ok([component(|x| x.x), component(|x| x.y)])
}

/// Streamlines of a squirmer of radius 1 with B1 = 1, and its outline.
fn squirmer(b2: f64) -> Result<Row> {
    let flow = SquirmerFlow::new(1.0, 1.0, b2)?;
    let velocity = |x: &Vec2| flow.velocity(*x, VelocityFrame::Laboratory);
    let lines = lines_around(Vec2::ZERO, |points| Ok(points.iter().map(velocity).collect()))?;
    let mut row = Row::from([("b2".to_owned(), b2)]);
    for (name, list) in ["streamlines_x", "streamlines_y"].into_iter().zip(lines) {
        flatten(name, &serde_json::to_value(list)?, &mut row);
    }
    let angles = (0..CIRCLE).map(|k| std::f64::consts::TAU * k as f64 / CIRCLE as f64);
    for (k, angle) in angles.enumerate() {
        row.insert(format!("outline_x_{k}"), angle.cos());
        row.insert(format!("outline_y_{k}"), angle.sin());
    }
    Ok(row)
}

/// All that is known of a steady swimmer.
fn steady(state: &SteadyState, lines: bool) -> Result<Summary> {
    let mut summary = Summary::default();
    for (name, value) in state.observables()?.entries() {
        summary.put(name, value, "");
    }
    let seen = state.measured()?;
    let leading = state.spectrum()?.leading().map(|mode| mode.value).unwrap_or_default();
    for (name, value) in [
        ("speed", seen.speed),
        ("velocity_x", state.velocity().x),
        ("stresslet_xx", seen.stresslet),
        ("aspect_ratio_moments", seen.aspect_ratio),
        ("least_curvature", seen.least_curvature),
        ("growth_rate", leading.re),
        ("frequency", leading.im),
        ("last_modes", state.tail()),
    ] {
        summary.put(name, value, "");
    }
    for (name, distance) in ["stagnation_ahead", "stagnation_behind"].into_iter().zip(stagnation(state)?) {
        summary.put(name, distance, "");
    }
    for (name, value) in ["film", "pressure_ahead"].into_iter().zip(narrowness(state)?) {
        summary.put(name, value, "");
    }
    if lines {
        for (name, list) in ["streamlines_x", "streamlines_y"].into_iter().zip(streamlines(state)?) {
            summary.put(name, list, "");
        }
    }
    let (x, y): (Vec<f64>, Vec<f64>) =
        state.profile().positions.iter().map(|x| *x - seen.centroid).map(|x| (x.x, x.y)).unzip();
    let (arc, concentration) = state.profile().concentrations()?;
    for (name, list) in [("outline_x", x), ("outline_y", y), ("arc", arc), ("concentration", concentration)] {
        summary.put(name, list, "");
    }
    Ok(summary)
}

/// Puts entries in place of those of a table, in tables within tables and, by their places, in lists of tables; a
/// `list` of points is another one.
fn merge(table: &mut Table, other: &Table) {
    for (key, value) in other {
        match (table.get_mut(key), value) {
            (Some(toml::Value::Table(inner)), toml::Value::Table(more)) => merge(inner, more),
            (Some(toml::Value::Array(list)), toml::Value::Array(more))
                if key != "list" && list.iter().all(toml::Value::is_table) =>
            {
                for (k, value) in more.iter().enumerate() {
                    match (list.get_mut(k), value) {
                        (Some(toml::Value::Table(inner)), toml::Value::Table(more)) => merge(inner, more),
                        _ => list.push(value.clone()),
                    }
                }
            }
            _ => {
                table.insert(key.clone(), value.clone());
            }
        }
    }
}

/// A name of letters, digits and underscores.
pub(super) fn plain(text: &str) -> String {
    let kept = text.replace(|c: char| !c.is_alphanumeric(), "_");
    kept.split('_').filter(|part| !part.is_empty()).collect::<Vec<_>>().join("_")
}

/// The numbers of a value by their paths, `.` being `_`; a text `b` at `a` is 1 at `a_b`.
fn flatten(path: &str, value: &Value, row: &mut Row) {
    let below = |key: &str| if path.is_empty() { plain(key) } else { format!("{path}_{}", plain(key)) };
    match value {
        Value::Object(map) => map.iter().for_each(|(key, value)| flatten(&below(key), value, row)),
        Value::Array(list) => {
            list.iter().enumerate().for_each(|(k, value)| flatten(&below(&k.to_string()), value, row));
        }
        Value::Number(number) => {
            row.insert(path.to_owned(), number.as_f64().unwrap_or(f64::NAN));
        }
        Value::Bool(flag) => {
            row.insert(path.to_owned(), f64::from(u8::from(*flag)));
        }
        Value::String(text) if text.len() <= LONGEST => {
            row.insert(below(text), 1.0);
        }
        Value::String(_) | Value::Null => {}
    }
}

/// The rows of a table of `docs/tables`, its columns with `t_` before their names: in each cell the number that it
/// begins with and, as of a text, what it says.
fn of_table(name: &str) -> Result<Vec<Row>> {
    let path = Path::new(tables::root()).join(format!("docs/tables/{name}.csv"));
    let read = || -> Result<Vec<Row>> {
        let mut table = csv::ReaderBuilder::new().comment(Some(b'#')).flexible(true).from_path(&path)?;
        let name = |title: &str| format!("t_{}", plain(title));
        let header: Vec<String> = table.headers()?.iter().map(name).collect();
        let mut rows = Vec::new();
        for record in table.records() {
            let mut row = Row::new();
            for (name, cell) in header.iter().zip(record?.iter()) {
                let end = cell.find(|c: char| !(c.is_ascii_digit() || "+-.e".contains(c))).unwrap_or(cell.len());
                match cell[..end].parse() {
                    Ok(number) => {
                        row.entry(name.clone()).or_insert(number);
                    }
                    Err(_) => flatten(name, &Value::String(cell.to_owned()), &mut row),
                }
            }
            rows.push(row);
        }
        Ok(rows)
    };
    read().with_context(|| path.display().to_string())
}

#[cfg(test)]
mod tests;

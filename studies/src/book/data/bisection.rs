//! Boundaries between two outcomes of runs, by bisection of an entry of their scenes.

use anyhow::{Context, Result, ensure};
use motile_cli::sweep::{Plan, Trial};
use serde::Deserialize;
use toml::{Table, Value};

use super::{Data, Source, flatten, folder, track};
use crate::book::expression::{Definitions, Expression, Row};
use crate::book::{Making, NO_BOUNDARY};

/// Most rounds of a bisection: 2^-20 of the way between the first ends.
const ROUNDS: usize = 20;

/// How often ends of points of their own move on while both have one outcome.
const MOVES: usize = 3;

/// Bisection of one number that some entries of a scene share.
///
/// Each point of the plan ends as one row: that of the run nearest to the boundary with the outcome of the second end,
/// with `boundary`, the middle between the last two values, and `boundary_error`, half their distance. Both values are
/// of runs whose outcome is known. A run that ends in an error is told as all failures are. Its outcome is known if it
/// has come to the second one (`furthest_x`, all other columns being those of its scene). Otherwise it could still have
/// come to it: the bisection of its point ends there.
#[derive(Debug, Clone, Deserialize)]
#[serde(deny_unknown_fields, rename_all = "kebab-case")]
pub(super) struct Bisection {
    /// Entries by their paths in the scene file.
    entries: Vec<String>,
    /// Ends with different outcomes.
    between: Ends,
    /// Half the distance of the last two values, relative to their middle.
    within: f64,
    /// Expression of a run's columns that is not 0 at the second end, and 0 at the first.
    outcome: String,
    /// Runs that end in an error before the second outcome count as those of the first one, so that the boundary is a
    /// bound on one side only.
    #[serde(default)]
    one_sided: bool,
}

/// Ends of all points, or of each. If both ends of a point have one outcome, those of each move on.
#[derive(Debug, Clone, Deserialize)]
#[serde(untagged)]
enum Ends {
    All([f64; 2]),
    Each(Vec<[f64; 2]>),
}

impl Ends {
    fn of(&self, point: usize) -> Option<[f64; 2]> {
        match self {
            Self::All(ends) => Some(*ends),
            Self::Each(list) => list.get(point).copied(),
        }
    }

    fn moves(&self) -> usize {
        match self {
            Self::All(_) => 0,
            Self::Each(_) => MOVES,
        }
    }
}

/// A run and its outcome, if that is known.
#[derive(Clone)]
struct Run {
    row: Option<Row>,
    outcome: Option<bool>,
}

/// Values with different outcomes of one point, and the row of the second.
#[derive(Clone)]
struct Bracket {
    values: [f64; 2],
    row: Option<Row>,
    /// Nothing is known of the middle between its values.
    stuck: bool,
}

impl Bracket {
    fn middle(&self) -> f64 {
        0.5 * (self.values[0] + self.values[1])
    }

    fn error(&self) -> f64 {
        0.5 * (self.values[0] - self.values[1]).abs()
    }
}

impl Bisection {
    /// Adds the rows of all points to the data, with the runs that they took.
    pub(super) fn rows(
        &self,
        source: &Source,
        name: &str,
        making: &Making,
        points: &[Trial],
        data: &mut Data,
    ) -> Result<()> {
        let ends: Option<Vec<[f64; 2]>> = (0..points.len()).map(|point| self.between.of(point)).collect();
        let mut ends = ends.with_context(|| format!("data {name}: ends of each point"))?;
        let positive = ends.iter().flatten().all(|value| *value > 0.0);
        ensure!(self.within > 0.0 && positive, "data {name}: numbers above 0");
        let plan = source.whole_plan(making)?.with_context(|| format!("data {name}: a bisection without a plan"))?;
        let outcome = Expression::parse(&self.outcome, &Definitions::new())?;
        let mut run = |asked: &[(usize, f64)]| -> Result<Vec<Run>> {
            let trials = asked.iter().map(|(k, value)| self.trial(&plan, name, making, (*k, &points[*k]), *value));
            let trials: Vec<Trial> = trials.collect::<Result<_>>()?;
            let rows = source.made(name, making, trials.clone(), data)?;
            let judged = |(row, trial): (Option<Row>, &Trial)| -> Result<Run> {
                let finished = row.is_some();
                let row = row.map_or_else(|| Self::ended(trial), |row| Ok(Some(row)))?;
                let second = row.as_ref().is_some_and(|row| outcome.value(row) != 0.0);
                Ok(Run { row, outcome: (finished || second || self.one_sided).then_some(second) })
            };
            rows.into_iter().zip(&trials).map(judged).collect()
        };

        let mut brackets: Vec<Option<Bracket>> = vec![None; points.len()];
        let mut found: Vec<[Option<Run>; 2]> = vec![[None, None]; points.len()];
        let mut open: Vec<usize> = (0..points.len()).collect();
        for round in 0..=self.between.moves() {
            let places: Vec<(usize, usize)> = open.iter().flat_map(|k| [(*k, 0), (*k, 1)]).collect();
            let places: Vec<(usize, usize)> =
                places.into_iter().filter(|(k, side)| found[*k][*side].is_none()).collect();
            let asked: Vec<(usize, f64)> = places.iter().map(|(k, side)| (*k, ends[*k][*side])).collect();
            for ((k, side), run) in places.into_iter().zip(run(&asked)?) {
                found[k][side] = Some(run);
            }
            let last = round == self.between.moves();
            open.retain(|k| {
                let [first, second] = &mut found[*k];
                let [low, high] = ends[*k];
                match [&*first, &*second].map(|run| run.as_ref().and_then(|run| run.outcome)) {
                    [Some(false), Some(true)] => {
                        let row = second.take().and_then(|run| run.row);
                        brackets[*k] = Some(Bracket { values: ends[*k], row, stuck: false });
                        false
                    }
                    [Some(true), Some(true)] if !last => {
                        ends[*k] = [2.0 * low - high, low];
                        *second = first.take();
                        ends[*k][0] > 0.0
                    }
                    [Some(false), Some(false)] if !last => {
                        ends[*k] = [high, 2.0 * high - low];
                        *first = second.take();
                        true
                    }
                    _ => false,
                }
            });
        }
        for _ in 0..ROUNDS {
            let wide = |bracket: &Bracket| !bracket.stuck && bracket.error() > self.within * bracket.middle();
            let open = brackets.iter().enumerate().filter_map(|(k, bracket)| Some((k, bracket.as_ref()?)));
            let asked: Vec<(usize, f64)> =
                open.filter(|(_, bracket)| wide(bracket)).map(|(k, bracket)| (k, bracket.middle())).collect();
            for ((k, value), run) in asked.iter().zip(run(&asked)?) {
                let Some(bracket) = &mut brackets[*k] else { continue };
                match run.outcome {
                    Some(second) => {
                        bracket.values[usize::from(second)] = *value;
                        bracket.row = if second { run.row } else { bracket.row.take() };
                    }
                    None => bracket.stuck = true,
                }
            }
        }
        for ((point, bracket), ends) in points.iter().zip(brackets).zip(&ends) {
            let Some(bracket) = bracket else {
                data.failures.push(format!("{}: {NO_BOUNDARY} {ends:?}", point.label));
                continue;
            };
            let mut row = bracket.row.clone().unwrap_or_default();
            row.insert("boundary".to_owned(), bracket.middle());
            row.insert("boundary_error".to_owned(), bracket.error());
            data.rows.push(row);
        }
        Ok(())
    }

    /// Row of a run that ended in an error; nothing of one without a record.
    fn ended(trial: &Trial) -> Result<Option<Row>> {
        let Ok(track) = track(trial, "x") else { return Ok(None) };
        let mut row = Row::new();
        flatten("", &serde_json::to_value(&trial.setup)?, &mut row);
        row.insert("furthest_x".to_owned(), track.iter().map(|(_, x)| *x).fold(f64::NAN, f64::max));
        Ok(Some(row))
    }

    /// The run of a point of the plan at a value.
    fn trial(
        &self,
        plan: &Table,
        name: &str,
        making: &Making,
        (number, point): (usize, &Trial),
        value: f64,
    ) -> Result<Trial> {
        let mut entries = Table::new();
        for (path, own) in &point.values {
            entries.insert(path.clone(), Value::try_from(own)?);
        }
        entries.extend(self.entries.iter().map(|path| (path.clone(), Value::Float(value))));
        let mut plan = plan.clone();
        for axes in ["grid", "zip", "seeds"] {
            plan.remove(axes);
        }
        plan.insert("list".to_owned(), Value::Array(vec![Value::Table(entries)]));
        let own = format!("{number:03}-{value}");
        let mut trials = Plan::of(plan)?.trials(&folder(name, making).join(&own))?;
        let mut trial = trials.pop().context("a plan without a run")?;
        trial.label = own;
        Ok(trial)
    }
}

#[cfg(test)]
mod tests;

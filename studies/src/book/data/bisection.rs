//! Boundaries between two outcomes of runs, by bisection of an entry of their scenes.

use anyhow::{Context, Result, ensure};
use motile_cli::sweep::{Plan, Trial};
use serde::Deserialize;
use toml::{Table, Value};

use super::{Data, Source, flatten, folder, track};
use crate::book::Making;
use crate::book::expression::{Definitions, Expression, Row};

/// Most rounds of a bisection: 2^-20 of the way between the first ends.
const ROUNDS: usize = 20;

/// Bisection of one number that some entries of a scene share.
///
/// Each point of the plan ends as one row: that of the run nearest to the boundary with the outcome of the second end,
/// with `boundary`, the middle between the last two values, and `boundary_error`, half their distance. A run that ends
/// in an error is judged by what it came to (`furthest_x`, all other columns being those of its scene), and is told as
/// all failures are.
#[derive(Debug, Clone, Deserialize)]
#[serde(deny_unknown_fields, rename_all = "kebab-case")]
pub(super) struct Bisection {
    /// Entries by their paths in the scene file.
    entries: Vec<String>,
    /// Ends with different outcomes.
    between: [f64; 2],
    /// Half the distance of the last two values, relative to their middle.
    within: f64,
    /// Expression of a run's columns that is not 0 at the second end, and 0 at the first.
    outcome: String,
}

/// Values with different outcomes of one point, and the row of the second.
struct Bracket {
    values: [f64; 2],
    row: Option<Row>,
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
        ensure!(self.within > 0.0 && self.between.iter().all(|value| *value > 0.0), "data {name}: numbers above 0");
        let plan = source.whole_plan(making)?.with_context(|| format!("data {name}: a bisection without a plan"))?;
        let outcome = Expression::parse(&self.outcome, &Definitions::new())?;
        let mut run = |asked: &[(usize, f64)]| -> Result<Vec<Option<Row>>> {
            let trials = asked.iter().map(|(k, value)| self.trial(&plan, name, making, (*k, &points[*k]), *value));
            let trials: Vec<Trial> = trials.collect::<Result<_>>()?;
            let rows = source.made(name, making, trials.clone(), data)?;
            let ended =
                |(row, trial): (Option<Row>, &Trial)| row.map_or_else(|| Self::ended(trial), |row| Ok(Some(row)));
            rows.into_iter().zip(&trials).map(ended).collect()
        };
        let holds = |row: &Option<Row>| row.as_ref().is_some_and(|row| outcome.value(row) != 0.0);

        let mut brackets: Vec<Option<Bracket>> = Vec::with_capacity(points.len());
        let first: Vec<(usize, f64)> = (0..points.len()).flat_map(|k| self.between.map(|value| (k, value))).collect();
        for pair in run(&first)?.chunks(2) {
            let two = !holds(&pair[0]) && holds(&pair[1]);
            brackets.push(two.then(|| Bracket { values: self.between, row: pair[1].clone() }));
        }
        for _ in 0..ROUNDS {
            let wide = |bracket: &Bracket| bracket.error() > self.within * bracket.middle();
            let open = brackets.iter().enumerate().filter_map(|(k, bracket)| Some((k, bracket.as_ref()?)));
            let asked: Vec<(usize, f64)> =
                open.filter(|(_, bracket)| wide(bracket)).map(|(k, bracket)| (k, bracket.middle())).collect();
            for ((k, value), row) in asked.iter().zip(run(&asked)?) {
                let Some(bracket) = &mut brackets[*k] else { continue };
                let side = usize::from(holds(&row));
                bracket.values[side] = *value;
                if side == 1 {
                    bracket.row = row;
                }
            }
        }
        for (point, bracket) in points.iter().zip(brackets) {
            let Some(bracket) = bracket else {
                data.failures.push(format!("{}: no boundary between {:?}", point.label, self.between));
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

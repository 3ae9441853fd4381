//! Speed of the droplet and width of the channel over the time of a run.

use std::error::Error;

use anyhow::Result;
use motile::active_interface::ActiveDroplet;
use motile::elastic_solids::{Solid, channel::width_between};
use motile::ib_core::{Handle, Hydrodynamics, Observer, System};
use motile_examples::Summary;
use serde_json::Value;

/// What is followed, besides the time, as it is called in the results of a run.
pub(crate) const FOLLOWED: [&str; 4] = ["speed", "aspect_ratio", "channel_width_min", "channel_width_max"];
/// Under which the results of a run hold its history.
const ENTRY: &str = "history";

/// Times and values of [`FOLLOWED`].
#[derive(Debug, Clone, PartialEq, Default)]
pub(crate) struct Rows(pub(crate) Vec<[f64; 5]>);

impl Rows {
    /// The history among the results of a run.
    pub(crate) fn of(summary: &Summary) -> Self {
        let rows = summary.values().get(ENTRY).and_then(Value::as_array);
        let row = |value: &Value| -> Option<[f64; 5]> {
            let numbers: Option<Vec<f64>> = value.as_array()?.iter().map(Value::as_f64).collect();
            numbers?.try_into().ok()
        };
        Self(rows.map_or_else(Vec::new, |rows| rows.iter().filter_map(row).collect()))
    }

    /// Value number `column` of [`FOLLOWED`] at a time, by linear interpolation; not a number outside the run.
    pub(crate) fn at(&self, time: f64, column: usize) -> f64 {
        let rows = &self.0;
        let after = rows.partition_point(|row| row[0] < time - 1e-9);
        let Some(last) = rows.get(after) else { return f64::NAN };
        let first = rows[after.saturating_sub(1)];
        let span = last[0] - first[0];
        let part = if span > 0.0 { ((time - first[0]) / span).clamp(0.0, 1.0) } else { 1.0 };
        first[column + 1] + part * (last[column + 1] - first[column + 1])
    }

    /// Largest and root mean square difference of a column from that of another run over the time of both.
    pub(crate) fn difference(&self, other: &Self, column: usize) -> (f64, f64) {
        let differences: Vec<f64> = self
            .0
            .iter()
            .map(|row| row[column + 1] - other.at(row[0], column))
            .filter(|difference| difference.is_finite())
            .collect();
        let largest = differences.iter().fold(0.0_f64, |most, d| most.max(d.abs()));
        let mean = differences.iter().map(|d| d * d).sum::<f64>() / differences.len() as f64;
        (largest, mean.sqrt())
    }
}

/// The results of a run without its history, for a table.
pub(crate) fn without(summary: &Summary) -> Summary {
    let mut rest = Summary::default();
    for (name, value) in summary.values().iter().filter(|(name, _)| *name != ENTRY) {
        rest.put(name, value.clone(), "");
    }
    rest
}

/// Follows a droplet and the walls of its channel.
#[derive(Debug)]
pub(crate) struct History {
    droplet: Handle<ActiveDroplet>,
    rows: Rows,
}

impl History {
    /// Of a droplet between the first two solids of its scene.
    pub(crate) fn new(droplet: Handle<ActiveDroplet>) -> Self {
        Self { droplet, rows: Rows::default() }
    }

    pub(crate) fn put(&self, summary: &mut Summary) {
        let rows: Vec<Value> = self.rows.0.iter().map(|row| row.map(six_figures).to_vec().into()).collect();
        summary.put(ENTRY, rows, "");
    }
}

/// Rounded, so that the files of the runs stay small.
fn six_figures(value: f64) -> f64 {
    (value * 1e7).round() / 1e7
}

impl<H: Hydrodynamics> Observer<H> for History {
    fn observe(&mut self, system: &mut System<H>) -> Result<(), Box<dyn Error + Send + Sync>> {
        let seen = system.observe(self.droplet)?;
        let walls: Vec<&Solid> = system.bodies().map(|(_, wall)| wall).collect();
        let [lower, upper, ..] = walls[..] else { return Err("a channel without walls".into()) };
        let width = width_between(lower, upper)?;
        self.rows.0.push([system.time(), seen.speed(), seen.aspect_ratio_moments, width.minimum, width.maximum]);
        Ok(())
    }
}

//! Plans of sweeps.

use std::collections::HashSet;
use std::path::{Path, PathBuf};

use anyhow::{Context, Result, anyhow, bail, ensure};
use serde::Deserialize;
use toml::{Table, Value};

use super::trial::Trial;
use crate::keys::{self, in_words, setup_of, table_in, text_of};

/// Most runs of a plan.
const MOST: usize = 1_000_000;
/// Longest name of a folder.
const LONGEST: usize = 120;
/// Relative amplitude of perturbed starts.
const AMPLITUDE: f64 = 0.05;

/// Plan of a sweep: a scene, the time to which it runs, and the values that its entries take.
///
/// ```toml
/// scene = "scene.toml"                  # a file beside the plan, or the scene itself as a table
/// time = 40.0
/// seeds = 3                             # perturbed starts with seeds 1 to 3, or a list of seeds
///
/// [grid]                                # every combination
/// "droplets.0.particles.activity" = [-1.0, -2.0, -4.0]
/// "region.channel.width" = { from = 2.1, to = 5.0, count = 5, spacing = "linear" }
///
/// [zip]                                 # the first of each list, the second of each ...
/// viscosity = [100.0, 10.0]
/// "droplets.0.viscosity" = [100.0, 1000.0]
///
/// [[list]]                              # one point after the other
/// "droplets.0.angle" = 0.5
/// ```
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields, rename_all = "kebab-case")]
pub struct Plan {
    time: f64,
    scene: SceneEntry,
    #[serde(default)]
    grid: Table,
    #[serde(default)]
    zip: Table,
    #[serde(default)]
    list: Vec<Table>,
    #[serde(default)]
    seeds: Option<Seeds>,
    /// Directory that files of the scene are relative to.
    #[serde(skip)]
    directory: PathBuf,
}

#[derive(Debug, Deserialize)]
#[serde(untagged)]
enum SceneEntry {
    File(PathBuf),
    Here(Table),
}

#[derive(Debug, Deserialize)]
#[serde(untagged)]
enum Seeds {
    Count(i64),
    List(Vec<i64>),
}

/// Values between two ends.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields, rename_all = "kebab-case")]
struct Range {
    from: f64,
    to: f64,
    count: usize,
    #[serde(default)]
    spacing: Spacing,
}

#[derive(Debug, Clone, Copy, PartialEq, Default, Deserialize)]
#[serde(rename_all = "kebab-case")]
enum Spacing {
    #[default]
    Linear,
    Logarithmic,
}

/// Entries, by their paths in the scene file, and their values.
type Point = Vec<(String, Value)>;

impl Plan {
    /// Creates a plan from a TOML file.
    ///
    /// # Errors
    /// Returns an error for a file that cannot be read or is not a plan.
    pub fn read(path: &Path) -> Result<Self> {
        let read = || -> Result<Self> {
            let text = text_of(path)?;
            let mut plan = Self::of(toml::from_str(&text)?)?;
            if let SceneEntry::File(file) = &plan.scene {
                let file = path.parent().unwrap_or(Path::new("")).join(file);
                let text = text_of(&file).with_context(|| format!("scene {}", file.display()))?;
                plan.scene = SceneEntry::Here(toml::from_str(&text)?);
                plan.directory = file.parent().unwrap_or(Path::new("")).to_owned();
            } else {
                plan.directory = path.parent().unwrap_or(Path::new("")).to_owned();
            }
            Ok(plan)
        };
        read().with_context(|| format!("plan {}", path.display()))
    }

    /// Creates a plan from a TOML table that contains its scene.
    ///
    /// # Errors
    /// Returns an error for a table that is not a plan.
    pub fn of(table: Table) -> Result<Self> {
        let plan: Self = table.try_into().map_err(|error: toml::de::Error| anyhow!(in_words(&error.to_string())))?;
        ensure!(
            plan.time.is_finite() && plan.time > 0.0,
            "time = {}: a run needs a positive duration. Use a finite number above 0",
            plan.time
        );
        Ok(plan)
    }

    /// Runs of the plan with their folders below `runs`, in the order of `list`, `zip`, `grid` and `seeds`, the last
    /// entry changing fastest.
    ///
    /// # Errors
    /// Returns an error for ranges that are not valid, lists in `zip` of different lengths, entries that the scene does
    /// not have, two equal runs, more than a million runs.
    pub fn trials(&self, runs: &Path) -> Result<Vec<Trial>> {
        let SceneEntry::Here(scene) = &self.scene else { bail!("the plan has no scene. Add the key `scene`") };
        // With all entries written out, and without those that there are not.
        let mut base = table_in(&scene.to_string(), &self.directory)?;
        let points = self.points(&mut base)?;
        let names = short_names(&points);
        let mut labels = HashSet::new();
        let mut trials = Vec::with_capacity(points.len());
        for (number, point) in points.into_iter().enumerate() {
            let mut table = base.clone();
            for (path, value) in &point {
                keys::set(&mut table, path, value.clone())?;
            }
            let shown: Vec<String> = point.iter().map(|(path, value)| format!("{path} = {value}")).collect();
            let setup = setup_of(&table).with_context(|| shown.join(", "))?;
            let label = label(&names, &point, number);
            ensure!(labels.insert(label.clone()), "{label} is there twice: {}", shown.join(", "));
            let values = point.into_iter().map(|(path, value)| Ok((path, serde_json::to_value(value)?)));
            let values = values.collect::<Result<_>>()?;
            trials.push(Trial { folder: runs.join(&label), label, values, setup, time: self.time });
        }
        Ok(trials)
    }

    fn points(&self, base: &mut Value) -> Result<Vec<Point>> {
        let lists: Vec<Point> = self.list.iter().map(|table| flat("", table, &|_| false)).collect();
        let mut points = if lists.is_empty() { vec![Point::new()] } else { lists };
        let mut zipped: Vec<Point> = Vec::new();
        for (path, values) in axes(&self.zip)? {
            zipped.resize(if zipped.is_empty() { values.len() } else { zipped.len() }, Point::new());
            let (count, wanted) = (values.len(), zipped.len());
            ensure!(
                count == wanted,
                "zip.{path} has {count} values, but the other lists in [zip] have {wanted}. Make the lists equally long"
            );
            zipped.iter_mut().zip(values).for_each(|(point, value)| point.push((path.clone(), value)));
        }
        if !zipped.is_empty() {
            points = product(&points, &zipped)?;
        }
        for (path, values) in axes(&self.grid)? {
            let axis: Vec<Point> = values.into_iter().map(|value| vec![(path.clone(), value)]).collect();
            points = product(&points, &axis)?;
        }
        if let Some(seeds) = &self.seeds {
            let seeds = match seeds {
                Seeds::Count(count) => (1..=*count).collect(),
                Seeds::List(list) => list.clone(),
            };
            ensure!(
                !seeds.is_empty(),
                "seeds is empty, so there is nothing to run. Use at least one seed, or remove the key"
            );
            let starts = perturbed(base);
            ensure!(
                !starts.is_empty(),
                "seeds has no effect, because the scene has no droplet with particles. Add particles, or remove the key"
            );
            let own = |seed: i64, k: usize| seed.saturating_mul(starts.len() as i64).saturating_sub(k as i64);
            let point = |seed: i64| -> Point {
                starts.iter().enumerate().map(|(k, path)| (path.clone(), Value::Integer(own(seed, k)))).collect()
            };
            let axis: Vec<Point> = seeds.into_iter().map(point).collect();
            points = product(&points, &axis)?;
        }
        Ok(points)
    }
}

/// Replaces the starts of all droplets with particles by perturbed ones, and returns the paths of their seeds.
fn perturbed(base: &mut Value) -> Vec<String> {
    let Some(Value::Array(droplets)) = base.get_mut("droplets") else { return Vec::new() };
    let mut paths = Vec::new();
    for (k, droplet) in droplets.iter_mut().enumerate() {
        let Some(Value::Table(particles)) = droplet.get_mut("particles") else { continue };
        if particles.get("start").and_then(|start| start.get("perturbed")).is_none() {
            let entries = [("amplitude".to_owned(), Value::Float(AMPLITUDE)), ("seed".to_owned(), Value::Integer(1))];
            let start = [("perturbed".to_owned(), Value::Table(entries.into_iter().collect()))];
            particles.insert("start".to_owned(), Value::Table(start.into_iter().collect()));
        }
        paths.push(format!("droplets.{k}.particles.start.perturbed.seed"));
    }
    paths
}

/// Returns all pairs of a point of `first` and one of `second`, joined.
fn product(first: &[Point], second: &[Point]) -> Result<Vec<Point>> {
    let count = first.len().saturating_mul(second.len());
    ensure!(count <= MOST, "the plan has {count} runs, but at most {MOST} are possible. Use shorter lists");
    Ok(first.iter().flat_map(|a| second.iter().map(|b| [a.clone(), b.clone()].concat())).collect())
}

/// Leaves of nested tables by their paths; a table for which `whole` holds is a leaf.
fn flat(above: &str, table: &Table, whole: &dyn Fn(&Table) -> bool) -> Point {
    let mut found = Point::new();
    for (key, value) in table {
        let path = if above.is_empty() { key.clone() } else { format!("{above}.{key}") };
        match value {
            Value::Table(inner) if !whole(inner) => found.extend(flat(&path, inner, whole)),
            leaf => found.push((path, leaf.clone())),
        }
    }
    found
}

/// Returns the lists of values by their paths.
fn axes(table: &Table) -> Result<Vec<(String, Vec<Value>)>> {
    let leaves = flat("", table, &|inner| inner.contains_key("from"));
    leaves.into_iter().map(|(path, value)| Ok((path.clone(), values(value).with_context(|| path)?))).collect()
}

fn values(value: Value) -> Result<Vec<Value>> {
    let range: Range = match value {
        Value::Array(list) if !list.is_empty() => return Ok(list),
        Value::Table(table) => table.try_into()?,
        other => bail!(
            "{other} is not a range of values. Use a list such as [1.0, 2.0], or {{ from = 1.0, to = 2.0, count = 5 }}"
        ),
    };
    let Range { from, to, count, spacing } = range;
    ensure!((1..=MOST).contains(&count), "count = {count} is out of range. Use a number from 1 to {MOST}");
    let logarithmic = spacing == Spacing::Logarithmic;
    ensure!(
        from.is_finite() && to.is_finite(),
        "the range from {from} to {to} has no finite ends. Use two finite numbers"
    );
    ensure!(
        !logarithmic || from * to > 0.0,
        "a logarithmic range cannot go from {from} to {to}. Use two ends of the same sign, neither of them 0"
    );
    let part = |k: usize| if count == 1 { 0.0 } else { k as f64 / (count - 1) as f64 };
    let at = |k: usize| match (k + 1 == count && count > 1, logarithmic) {
        (true, _) => to,
        (false, true) => from * (to / from).powf(part(k)),
        (false, false) => from + (to - from) * part(k),
    };
    Ok((0..count).map(|k| Value::Float(at(k))).collect())
}

/// Returns the short names of the paths: as many of their last parts as make them different.
fn short_names(points: &[Point]) -> Vec<(String, String)> {
    let mut paths: Vec<&str> = points.iter().flatten().map(|(path, _)| path.as_str()).collect();
    paths.sort_unstable();
    paths.dedup();
    let last = |path: &str, parts: usize| {
        let all: Vec<&str> = path.split('.').collect();
        all[all.len().saturating_sub(parts)..].join(".")
    };
    let short = |path: &&str| {
        let alone = |parts: &usize| paths.iter().filter(|other| last(other, *parts) == last(path, *parts)).count() == 1;
        let parts = (1..path.len()).find(alone).unwrap_or(path.len());
        ((*path).to_owned(), last(path, parts))
    };
    paths.iter().map(short).collect()
}

/// Returns the name of the folder of a run.
fn label(names: &[(String, String)], point: &Point, number: usize) -> String {
    let plain = |text: String| -> String {
        let kept = |c: char| if c.is_ascii_alphanumeric() || "+-.".contains(c) { c } else { '_' };
        text.chars().map(kept).collect()
    };
    let part = |(path, value): &(String, Value)| {
        let name = names.iter().find(|(whole, _)| whole == path).map_or(path.as_str(), |(_, short)| short);
        let value = match value {
            Value::Float(number) => number.to_string(),
            Value::String(text) => text.clone(),
            other => other.to_string(),
        };
        format!("{}={}", plain(name.to_owned()), plain(value))
    };
    let label = point.iter().map(part).collect::<Vec<_>>().join(",");
    match label.len() {
        0 => "run".to_owned(),
        1..=LONGEST => label,
        _ => format!("run-{:06}", number + 1),
    }
}

#[cfg(test)]
mod tests;

//! Values of command line flags: from text to numbers, or a reason why not.

use std::{fmt::Display, ops::RangeInclusive, path::Path, str::FromStr};

use anyhow::Context as _;
use clap::builder::{PossibleValue, PossibleValuesParser, TypedValueParser};
use motile::ib_core::{AnyKernel, Kernel};
use motile::scene::StepSize;
use motile::setup::{Distribution, IntegralMethod, Setup};
use motile_cli::keys::scene_of;

/// Automatic time steps, as a fraction of the stability limit.
const OF_LIMIT: f64 = 0.5;

/// The parser of a flag that takes one of a few values, each with its name and a word about it.
pub(crate) fn one_of<T: Copy + Send + Sync + 'static>(
    values: &'static [(&'static str, &'static str, T)],
) -> impl TypedValueParser<Value = T> {
    let names = values.iter().map(|&(name, about, _)| PossibleValue::new(name).help(about));
    PossibleValuesParser::new(names).try_map(|text| {
        let named = values.iter().find(|(name, ..)| *name == text);
        named.map(|&(.., value)| value).ok_or("is none of the names that there are")
    })
}

/// A time step: a number, `auto`, `adaptive` or `adaptive:TOLERANCE`.
///
/// # Errors
/// The rule that `text` breaks.
pub(crate) fn time_step(text: &str) -> Result<StepSize, String> {
    let number = |number: &str| number.parse().ok();
    let step = match (text, text.strip_prefix("adaptive:")) {
        ("auto", _) => Some(StepSize::OfLimit(OF_LIMIT)),
        ("adaptive", _) => Some(StepSize::default()),
        (_, Some(tolerance)) => number(tolerance).map(|tolerance| StepSize::Adaptive { tolerance }),
        _ => number(text).map(StepSize::Fixed),
    };
    let rule = "must be a number above 0, 'auto', 'adaptive' or 'adaptive:' and a tolerance of at most 0.5";
    step.filter(|step| step.check().is_ok()).ok_or_else(|| rule.to_owned())
}

/// Largest magnitude of a number, in any unit: that of the values of scene files.
const LARGEST: f64 = 1e50;

/// A number for which `valid` holds, or the rule it breaks.
fn number(text: &str, rule: &str, valid: impl Fn(f64) -> bool) -> Result<f64, String> {
    match text.trim().parse::<f64>() {
        Ok(number) if number.is_finite() && number.abs() <= LARGEST && valid(number) => Ok(number),
        _ => Err(rule.to_string()),
    }
}

/// A whole number in this range, or the rule that it breaks.
fn whole<T: FromStr + PartialOrd + Display>(text: &str, range: RangeInclusive<T>) -> Result<T, String> {
    let number = text.trim().parse().ok().filter(|number| range.contains(number));
    number.ok_or_else(|| format!("must be a whole number from {} to {}", range.start(), range.end()))
}

/// A number of magnitude up to 1e50.
///
/// # Errors
/// The rule that `text` breaks.
pub fn finite(text: &str) -> Result<f64, String> {
    number(text, "must be a number from -1e50 to 1e50", |_| true)
}

/// A number above zero, up to 1e50.
///
/// # Errors
/// The rule that `text` breaks.
pub fn positive(text: &str) -> Result<f64, String> {
    number(text, "must be a number above 0 and at most 1e50", |v| v > 0.0)
}

/// A number of nodes of boundary integrals.
///
/// # Errors
/// The rule that `text` breaks.
pub(crate) fn nodes(text: &str) -> Result<usize, String> {
    let [least, most] = IntegralMethod::NODES;
    whole(text, least..=most)
}

/// A number of elements of the concentration.
///
/// # Errors
/// The rule that `text` breaks.
pub(crate) fn elements(text: &str) -> Result<usize, String> {
    whole(text, IntegralMethod::NODES[0]..=IntegralMethod::MOST_ELEMENTS)
}

/// A number from zero to 1e50.
///
/// # Errors
/// The rule that `text` breaks.
pub fn not_negative(text: &str) -> Result<f64, String> {
    number(text, "must be a number from 0 to 1e50", |v| v >= 0.0)
}

/// Two numbers of magnitude up to 1e50 with a comma between them.
///
/// # Errors
/// The rule that `text` breaks.
pub fn pair(text: &str) -> Result<[f64; 2], String> {
    let (x, y) = text.split_once(',').ok_or("must be two numbers with a comma between them")?;
    let part = |name: &str, text: &str| finite(text).map_err(|rule| format!("the {name} number {rule}"));
    Ok([part("first", x)?, part("second", y)?])
}

/// A number, or the least and the largest one with a comma between them.
///
/// # Errors
/// The rule that `text` breaks.
pub fn distribution(text: &str) -> Result<Distribution, String> {
    if text.contains(',') { pair(text).map(Distribution::Between) } else { finite(text).map(Distribution::Value) }
}

/// The scene of a file.
///
/// # Errors
/// A file that cannot be read or describes no scene, or one in which nothing moves.
pub fn scene_file(path: &Path) -> anyhow::Result<Setup> {
    scene_of(path, &[]).context("--scene")
}

/// A regularised delta function by its name.
///
/// # Errors
/// The names that there are.
pub(crate) fn kernel(text: &str) -> Result<AnyKernel, String> {
    text.parse().map_err(|_| format!("must be one of {}", AnyKernel::ALL.map(|kernel| kernel.name()).join(", ")))
}

/// A whole number that is not negative.
///
/// # Errors
/// The rule that `text` breaks.
pub(crate) fn seed(text: &str) -> Result<u64, String> {
    whole(text, 0..=u64::MAX)
}

#[cfg(test)]
mod tests;

//! Values of command line flags: from text to numbers, or a reason why not.

use std::{fmt, str::FromStr};

use motile::ib_core::{AnyKernel, Kernel};

/// Largest error of an adaptive step unless something else is said.
const TOLERANCE: f64 = 1e-5;

/// The time step that is asked for.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum TimeStep {
    /// Half of what is stable.
    Auto,
    /// As long as accuracy and stability allow, with this largest error of a step.
    Adaptive(f64),
    /// This one (time).
    Fixed(f64),
}

impl FromStr for TimeStep {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        if text == "auto" {
            return Ok(Self::Auto);
        }
        let (kind, number) = match text.strip_prefix("adaptive") {
            Some("") => return Ok(Self::Adaptive(TOLERANCE)),
            Some(rest) => (Self::Adaptive as fn(f64) -> Self, rest.strip_prefix(':').unwrap_or("none")),
            None => (Self::Fixed as fn(f64) -> Self, text),
        };
        match number.parse::<f64>() {
            Ok(number) if number.is_finite() && number > 0.0 => match kind(number) {
                Self::Adaptive(tolerance) if tolerance >= 1.0 => Err("must have a tolerance below 1".into()),
                step => Ok(step),
            },
            _ => Err("must be a number above 0, 'auto', 'adaptive' or 'adaptive:' and a tolerance".into()),
        }
    }
}

impl fmt::Display for TimeStep {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Auto => f.write_str("auto"),
            Self::Adaptive(tolerance) => write!(f, "adaptive:{tolerance}"),
            Self::Fixed(step) => write!(f, "{step}"),
        }
    }
}

/// Largest magnitude of a number.
const LARGEST: f64 = 1e6;

/// A number for which `valid` holds, or the rule it breaks.
fn number(text: &str, rule: &str, valid: impl Fn(f64) -> bool) -> Result<f64, String> {
    match text.trim().parse::<f64>() {
        Ok(number) if number.is_finite() && number.abs() <= LARGEST && valid(number) => Ok(number),
        _ => Err(rule.to_string()),
    }
}

/// A number of magnitude up to a million.
///
/// # Errors
/// The rule that `text` breaks.
pub fn finite(text: &str) -> Result<f64, String> {
    number(text, "must be a number from -1e6 to 1e6", |_| true)
}

/// A number above zero, up to a million.
///
/// # Errors
/// The rule that `text` breaks.
pub fn positive(text: &str) -> Result<f64, String> {
    number(text, "must be a number above 0 and at most 1e6", |v| v > 0.0)
}

/// A count of nodes or cells.
///
/// # Errors
/// The rule that `text` breaks.
pub fn count(text: &str) -> Result<usize, String> {
    match text.trim().parse::<usize>() {
        Ok(count) if (16..=16384).contains(&count) => Ok(count),
        _ => Err("must be a whole number from 16 to 16384".into()),
    }
}

/// A number of steps.
///
/// # Errors
/// The rule that `text` breaks.
pub(crate) fn steps(text: &str) -> Result<usize, String> {
    match text.trim().parse::<usize>() {
        Ok(steps) if (1..=1_000_000_000).contains(&steps) => Ok(steps),
        _ => Err("must be a whole number from 1 to 1e9".into()),
    }
}

/// A number from zero to a million.
///
/// # Errors
/// The rule that `text` breaks.
pub fn not_negative(text: &str) -> Result<f64, String> {
    number(text, "must be a number from 0 to 1e6", |v| v >= 0.0)
}

/// A contractile activity: a number from minus a million to zero.
///
/// # Errors
/// The rule that `text` breaks.
pub fn activity(text: &str) -> Result<f64, String> {
    number(text, "must be a number from -1e6 to 0 (contractile activities are negative)", |v| v <= 0.0)
}

/// Two numbers of magnitude up to a million with a comma between them.
///
/// # Errors
/// The rule that `text` breaks.
pub fn pair(text: &str) -> Result<[f64; 2], String> {
    let numbers = text.split_once(',').and_then(|(x, y)| Some([finite(x).ok()?, finite(y).ok()?]));
    numbers.ok_or_else(|| "must be two numbers with a comma between them".to_string())
}

/// A regularised delta function by its name.
///
/// # Errors
/// The names that there are.
pub fn kernel(text: &str) -> Result<AnyKernel, String> {
    text.parse().map_err(|_| format!("must be one of {}", AnyKernel::ALL.map(|kernel| kernel.name()).join(", ")))
}

/// A whole number that is not negative.
///
/// # Errors
/// The rule that `text` breaks.
pub fn seed(text: &str) -> Result<u64, String> {
    text.trim().parse().map_err(|_| format!("must be a whole number from 0 to {}", u64::MAX))
}

#[cfg(test)]
mod tests;

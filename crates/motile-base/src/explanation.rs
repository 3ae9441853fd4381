//! Errors as sentences, and numbers in them.

use std::error::Error;

/// An error and its causes in one sentence; a cause that the text before it tells already is left out.
#[must_use]
pub fn explanation(error: &dyn Error) -> String {
    let mut told = error.to_string();
    let mut source = error.source();
    while let Some(cause) = source {
        let text = cause.to_string();
        if !told.ends_with(&text) {
            told = format!("{told}: {text}");
        }
        source = cause.source();
    }
    told
}

/// Two numbers as text of three digits, or of as many more as it takes to tell them apart.
///
/// ```
/// assert_eq!(motile_base::internal::told_apart([0.350_02, 0.35]), ["0.35002", "0.35"]);
/// assert_eq!(motile_base::internal::told_apart([1.01, 5.0]), ["1.01", "5"]);
/// ```
#[must_use]
pub fn told_apart(pair: [f64; 2]) -> [String; 2] {
    let mut texts = (2..17).map(|digits| pair.map(|value| rounded(digits, value)));
    texts.find(|[one, other]| one != other).unwrap_or_else(|| pair.map(|value| value.to_string()))
}

/// Text of a number that was computed, to six digits.
///
/// ```
/// assert_eq!(motile_base::internal::told(25.800_000_000_000_004), "25.8");
/// assert_eq!(motile_base::internal::told(6.682_742_181_3e-4), "6.68274e-4");
/// ```
#[must_use]
pub fn told(value: f64) -> String {
    rounded(5, value)
}

/// Text of a number with so many digits after the first, without zeros at their end.
fn rounded(digits: usize, value: f64) -> String {
    let Ok(short) = format!("{value:.digits$e}").parse::<f64>() else { return value.to_string() };
    let plain = value == 0.0 || (1e-3..1e6).contains(&value.abs());
    if plain { short.to_string() } else { format!("{short:e}") }
}

/// Text of a refusal: what is wrong, with the value if there is one, and what to do.
///
/// ```
/// use motile_base::internal::refusal;
///
/// let (what, remedy) = ("the grid is too small", "Use at least 4 cells in each direction");
/// let text = "the grid is too small: 3 x 8 cells. Use at least 4 cells in each direction";
/// assert_eq!(refusal(what, "3 x 8 cells", remedy), text);
/// assert_eq!(refusal("the walls are missing", "", "Add them"), "the walls are missing. Add them");
/// ```
#[must_use]
pub fn refusal(what: &str, value: &str, remedy: &str) -> String {
    let colon = if value.is_empty() { "" } else { ": " };
    format!("{what}{colon}{value}. {remedy}")
}

/// Implements `Debug` of errors as their explanation: what `fn main() -> Result<(), Box<dyn Error>>` prints is
/// the `Debug` of the error that it returns.
///
/// ```
/// #[derive(thiserror::Error)]
/// #[error("the radius is {0}: give a positive number")]
/// struct BadRadius(f64);
/// motile_base::debug_as_explanation!(BadRadius);
///
/// assert_eq!(format!("{:?}", BadRadius(-1.0)), "the radius is -1: give a positive number");
/// ```
#[macro_export]
macro_rules! debug_as_explanation {
    ($($error:ty),+ $(,)?) => {$(
        impl ::std::fmt::Debug for $error {
            fn fmt(&self, f: &mut ::std::fmt::Formatter<'_>) -> ::std::fmt::Result {
                f.write_str(&$crate::internal::explanation(self))
            }
        }
    )+};
}

#[cfg(test)]
mod tests;

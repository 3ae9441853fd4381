//! Errors as sentences, and numbers in them.

use std::error::Error;

/// Returns an error and its causes in one sentence; a cause that the text before it already contains is left out.
#[must_use]
pub fn explanation(error: &dyn Error) -> String {
    let mut told = error.to_string();
    let mut source = error.source();
    while let Some(cause) = source {
        let text = cause.to_string();
        if !told.contains(&text) {
            told = format!("{told}: {text}");
        }
        source = cause.source();
    }
    told
}

/// Returns two numbers as text of three digits, or of as many more as it takes to distinguish them.
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

/// Returns the text of a number that was computed, to six digits.
///
/// ```
/// assert_eq!(motile_base::internal::told(25.800_000_000_000_004), "25.8");
/// assert_eq!(motile_base::internal::told(6.682_742_181_3e-4), "6.68274e-4");
/// ```
#[must_use]
pub fn told(value: f64) -> String {
    rounded(5, value)
}

/// Returns the text of a number that was given: all its digits, with a power of ten if it is very large or small.
///
/// ```
/// use motile_base::internal::given;
///
/// assert_eq!([given(0.1), given(-12.0), given(1e300), given(2e-9)], ["0.1", "-12", "1e300", "2e-9"]);
/// ```
#[must_use]
pub fn given(value: f64) -> String {
    let plain = value == 0.0 || !value.is_finite() || (1e-5..1e9).contains(&value.abs());
    if plain { value.to_string() } else { format!("{value:e}") }
}

/// Returns the text of a number with so many decimals, or with a digit more than that where decimals would show fewer
/// than two digits of it: a file may be in any unit.
///
/// ```
/// use motile_base::internal::decimals;
///
/// assert_eq!([decimals(1, 60.0), decimals(4, -0.25), decimals(1, 0.0)], ["60.0", "-0.2500", "0.0"]);
/// assert_eq!([decimals(1, 2.345e-4), decimals(4, 1.234_567e-6), decimals(3, 1e9)], ["2.3e-4", "1.2346e-6", "1e9"]);
/// ```
#[must_use]
pub fn decimals(digits: usize, value: f64) -> String {
    let shown = value == 0.0 || (10.0_f64.powi(1 - digits as i32)..1e7).contains(&value.abs());
    if shown || digits == 1 && (0.1..1e7).contains(&value.abs()) {
        format!("{value:.digits$}")
    } else {
        rounded(digits, value)
    }
}

/// Returns the text of a place, `(x, y)` (length).
#[must_use]
pub fn place(x: f64, y: f64) -> String {
    // Round-off next to a coordinate is zero.
    let near = |value: f64, other: f64| if value.abs() < 1e-9 * other.abs() { 0.0 } else { value };
    format!("({}, {})", decimals(4, near(x, y)), decimals(4, near(y, x)))
}

/// Returns the text of a number with so many digits after the first, without zeros at their end.
fn rounded(digits: usize, value: f64) -> String {
    let Ok(short) = format!("{value:.digits$e}").parse::<f64>() else { return value.to_string() };
    let plain = value == 0.0 || (1e-3..1e6).contains(&value.abs());
    if plain { short.to_string() } else { format!("{short:e}") }
}

/// Implements `Debug` of errors as their explanation: what `fn main() -> Result<(), Box<dyn Error>>` prints is
/// the `Debug` of the error that it returns.
///
/// ```
/// #[derive(thiserror::Error)]
/// #[error("the radius is {0}. Use a positive number")]
/// struct BadRadius(f64);
/// motile_base::debug_as_explanation!(BadRadius);
///
/// assert_eq!(format!("{:?}", BadRadius(-1.0)), "the radius is -1. Use a positive number");
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

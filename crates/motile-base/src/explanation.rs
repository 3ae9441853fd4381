//! Errors as sentences.

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

/// Implements `Debug` of errors as their [`explanation()`]: what `fn main() -> Result<(), Box<dyn Error>>` prints is
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
                f.write_str(&$crate::explanation(self))
            }
        }
    )+};
}

#[cfg(test)]
mod tests;

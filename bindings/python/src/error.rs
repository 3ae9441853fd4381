//! Errors as one exception class, `motile.Error`.

use pyo3::prelude::*;
use pyo3::types::PyDict;

use motile::SetupError;
use motile::setup::Setup as Description;

/// The exception `motile.Error` with a message, and the key, value and remedy where they are known.
pub(crate) fn refused(message: &str, key: Option<String>, value: Option<String>, remedy: Option<String>) -> PyErr {
    Python::attach(|py| {
        let made = || -> PyResult<PyErr> {
            let keywords = PyDict::new(py);
            keywords.set_item("key", key)?;
            keywords.set_item("value", value)?;
            keywords.set_item("remedy", remedy)?;
            let class = py.import("motile._error")?.getattr("Error")?;
            Ok(PyErr::from_value(class.call((message,), Some(&keywords))?))
        };
        made().unwrap_or_else(|error| error)
    })
}

/// Object that no description holds, at a key.
pub(crate) fn unreadable(key: &str, object: &Bound<'_, PyAny>, remedy: &str) -> PyErr {
    let value = object.repr().map_or_else(|_| "an object".to_owned(), |text| text.to_string());
    refused(&format!("{key} = {value}: {remedy}"), Some(key.to_owned()), Some(value), Some(remedy.to_owned()))
}

/// Error of the library with nothing but its message.
pub(crate) fn failed(error: impl std::fmt::Display) -> PyErr {
    refused(&error.to_string(), None, None, None)
}

/// Error of a description, with the key in the names of Python.
pub(crate) fn of_setup(error: &SetupError) -> PyErr {
    let snake = |key: &String| key.replace('-', "_");
    match error {
        SetupError::Value { key, value, remedy } => {
            let key = snake(key);
            refused(&format!("{key} = {value}: {remedy}"), Some(key), Some(value.clone()), Some(remedy.clone()))
        }
        SetupError::Entry { key, .. } | SetupError::Overlap { key, .. } | SetupError::Touch { key, .. } => {
            refused(&error.to_string(), Some(snake(key)), None, None)
        }
        _ => failed(error),
    }
}

/// Error for a key of an earlier version in a description that cannot be read. It names the key that you give now.
pub(crate) fn of_earlier(entries: &toml::Value) -> Option<PyErr> {
    // The text of a table is a scene file; that of a value would stand within braces.
    match Description::from_toml(&entries.as_table()?.to_string()) {
        Err(SetupError::Value { key, value, remedy }) => {
            Some(of_setup(&SetupError::Value { key, value, remedy: snake_places(&remedy) }))
        }
        _ => None,
    }
}

/// Text in which places such as `solids.surface-elasticity` have the names of Python.
fn snake_places(text: &str) -> String {
    let place = |word: &str| word.trim_matches('.').contains('.');
    let words = text.split(' ').map(|word| if place(word) { word.replace('-', "_") } else { word.to_owned() });
    words.collect::<Vec<_>>().join(" ")
}

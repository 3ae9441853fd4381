//! Errors as one exception class, `motile.Error`.

use pyo3::prelude::*;
use pyo3::types::PyDict;

use motile::SetupError;

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

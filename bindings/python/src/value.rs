//! Python objects as TOML values and back, keys in `snake_case` on one side and in `kebab-case` on the other.

use pyo3::prelude::*;
use pyo3::types::{PyBool, PyDict, PyFloat, PyInt, PyList, PyString, PyTuple};
use toml::{Table, Value};

use crate::error::{refused, unreadable};

/// Deepest place of a description: lists can hold themselves, and no scene is so deep.
const DEEPEST: usize = 32;

/// Value of a Python object; none for `None`, which leaves a key out. Arrays and scalars of NumPy are lists and
/// numbers.
pub(crate) fn from_python(object: &Bound<'_, PyAny>, key: &str) -> PyResult<Option<Value>> {
    if object.is_none() {
        return Ok(None);
    }
    if key.matches(['.', '[']).count() > DEEPEST {
        let remedy = "no scene is so deep. Look for a list or dictionary that holds itself";
        return Err(refused(&format!("{key}: {remedy}"), Some(key.to_owned()), None, Some(remedy.to_owned())));
    }
    if let Ok(dict) = object.cast::<PyDict>() {
        let mut table = Table::new();
        for (name, entry) in dict.iter() {
            let name: String = name.extract().map_err(|_| unreadable(key, &name, "use keys as text"))?;
            let inner = if key.is_empty() { name.clone() } else { format!("{key}.{name}") };
            if let Some(value) = from_python(&entry, &inner)? {
                table.insert(name.replace('_', "-"), value);
            }
        }
        return Ok(Some(Value::Table(table)));
    }
    if object.is_instance_of::<PyList>() || object.is_instance_of::<PyTuple>() {
        let mut list = Vec::new();
        for (number, entry) in object.try_iter()?.enumerate() {
            let inner = format!("{key}[{number}]");
            let entry = entry?;
            let value = from_python(&entry, &inner)?;
            list.push(value.ok_or_else(|| unreadable(&inner, &entry, "use a value, or leave the entry out"))?);
        }
        return Ok(Some(Value::Array(list)));
    }
    // A truth value is a whole number too, so it comes first.
    if object.is_instance_of::<PyBool>() {
        return Ok(Some(Value::Boolean(object.extract()?)));
    }
    if object.is_instance_of::<PyInt>() {
        let number = object.extract().map_err(|_| unreadable(key, object, "use a number below 2^63"))?;
        return Ok(Some(Value::Integer(number)));
    }
    if object.is_instance_of::<PyFloat>() {
        return Ok(Some(Value::Float(object.extract()?)));
    }
    if let Ok(text) = object.cast::<PyString>() {
        return Ok(Some(Value::String(text.to_string())));
    }
    if object.hasattr("__fspath__")? {
        return Ok(Some(Value::String(object.call_method0("__fspath__")?.extract()?)));
    }
    if object.hasattr("tolist")? {
        return from_python(&object.call_method0("tolist")?, key);
    }
    Err(unreadable(key, object, "use a number, text, a truth value, a list, a dictionary or an array of numbers"))
}

/// Python object of a value.
pub(crate) fn to_python<'py>(py: Python<'py>, value: &Value) -> PyResult<Bound<'py, PyAny>> {
    Ok(match value {
        Value::Table(table) => {
            let dict = PyDict::new(py);
            for (name, value) in table {
                dict.set_item(name.replace('-', "_"), to_python(py, value)?)?;
            }
            dict.into_any()
        }
        Value::Array(list) => {
            PyList::new(py, list.iter().map(|value| to_python(py, value)).collect::<PyResult<Vec<_>>>()?)?.into_any()
        }
        Value::Boolean(truth) => PyBool::new(py, *truth).to_owned().into_any(),
        Value::Integer(number) => number.into_pyobject(py)?.into_any(),
        Value::Float(number) => number.into_pyobject(py)?.into_any(),
        Value::String(text) => text.into_pyobject(py)?.into_any(),
        Value::Datetime(date) => date.to_string().into_pyobject(py)?.into_any(),
    })
}

/// Description of a scene in a value.
pub(crate) fn described<T: serde::de::DeserializeOwned>(value: Value) -> PyResult<T> {
    serde_path_to_error::deserialize(value).map_err(|error| {
        let key = error.path().to_string().replace('-', "_");
        let inner = error.inner().to_string();
        let plain = [
            ("wanted exactly 1 element", "use exactly one entry, which names the kind"),
            ("invalid type: unit variant", "this kind has settings. Use a dictionary: {kind: {setting: value}}"),
        ];
        let plain = plain.into_iter().find(|(start, _)| inner.starts_with(start));
        let words = [
            ("unknown field", "unknown key"),
            ("unknown variant", "unknown choice"),
            ("missing field", "missing required key"),
            ("expected f64", "expected a number"),
            ("expected usize", "expected a whole number that is not negative"),
            ("expected u64", "expected a whole number that is not negative"),
            ("expected a sequence", "expected a list"),
            ("invalid type: ", ""),
            ("invalid value: ", ""),
        ];
        let inner = plain.map_or(inner, |(_, said)| said.to_owned());
        let inner = words.iter().fold(inner, |text, (name, words)| text.replace(name, words));
        // The first line says what is wrong, in the names of scene files; the others say where.
        let said = inner.trim().lines().next().unwrap_or_default().split('`').enumerate();
        let snake = |(number, part): (usize, &str)| if number % 2 == 1 { part.replace('-', "_") } else { part.into() };
        let said = said.map(snake).collect::<Vec<_>>().join("`");
        if key == "." {
            refused(&said, None, None, None)
        } else {
            refused(&format!("{key}: {said}"), Some(key), None, None)
        }
    })
}

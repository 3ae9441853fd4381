//! Descriptions of scenes.

use std::ops::Range;
use std::path::{Path, PathBuf};

use pyo3::prelude::*;
use pyo3::types::{PyDict, PyString, PyTuple, PyType};

use motile::setup::{OutlineReport, Setup as Description};
use toml::de::{DeTable, DeValue};
use toml::{Spanned, Table, Value};

use crate::error::{failed, of_earlier, of_setup, refused, unreadable};
use crate::scene::Scene;
use crate::value::{described, from_python, to_python};

/// A scene as data: what there is, where, and how it is computed.
///
/// Keywords are the keys of scene files with underscores (`least_gap`, `mirror_symmetric`); what is left out is as in
/// the default scene, one droplet of activity -2 in a box of 6 x 6. Lists and dictionaries are copied: a Setup does not
/// change.
#[pyclass(module = "motile", frozen, eq)]
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Setup {
    pub(crate) description: Description,
}

impl Setup {
    fn checked(value: &Value) -> PyResult<Self> {
        let description: Description = described(value.clone()).map_err(|error| of_earlier(value).unwrap_or(error))?;
        without_rest(value)?;
        description.check().map_err(|error| of_setup(&error))?;
        // Like lists, the contents of files are copied.
        let description = description.with_files(Path::new("")).map_err(|error| of_setup(&error))?;
        Ok(Self { description })
    }

    /// Error about an entry that is to be changed in place.
    fn keep(&self, py: Python<'_>, name: &str) -> PyResult<()> {
        self.__getattr__(py, name)?;
        let remedy = format!("Make another with setup.replace({name}=...)");
        Err(pyo3::exceptions::PyAttributeError::new_err(format!("a Setup cannot be changed. {remedy}")))
    }

    fn table(&self) -> PyResult<Table> {
        Table::try_from(&self.description).map_err(failed)
    }
}

/// Refuses lists of which entries are left over, such as three coordinates where two are expected. The reader of scene
/// files sees them; what else it refuses, such as numbers that no file can hold, is another's matter.
fn without_rest(value: &Value) -> PyResult<()> {
    let text = value.as_table().map_or_else(String::new, Table::to_string);
    let Some(error) = Description::read(&text).err().filter(|error| error.message().contains("this list has")) else {
        return Ok(());
    };
    let root = DeTable::parse(&text).map_err(failed)?;
    let place = error.span().unwrap_or_default();
    let key = root.get_ref().iter().find_map(|(name, value)| key_at(name.get_ref(), value, &place));
    let key = key.unwrap_or_default().replace('-', "_");
    Err(refused(&format!("{key}: {}", error.message()), Some(key), None, None))
}

/// Key of the list at a place of the text; none if it is not in this value.
fn key_at(key: &str, value: &Spanned<DeValue<'_>>, place: &Range<usize>) -> Option<String> {
    match value.get_ref() {
        DeValue::Array(_) if value.span() == *place => Some(key.to_owned()),
        DeValue::Array(list) => {
            list.iter().enumerate().find_map(|(number, value)| key_at(&format!("{key}[{number}]"), value, place))
        }
        DeValue::Table(table) => {
            table.iter().find_map(|(name, value)| key_at(&format!("{key}.{}", name.get_ref()), value, place))
        }
        _ => None,
    }
}

/// Table of the keywords of a call.
fn keywords(entries: Option<&Bound<'_, PyDict>>) -> PyResult<Table> {
    match entries.map(|entries| from_python(entries.as_any(), "")).transpose()?.flatten() {
        Some(Value::Table(table)) => Ok(table),
        _ => Ok(Table::new()),
    }
}

/// Entry of a list or table at a key.
fn entry<'v>(value: &'v mut Value, key: &str) -> Option<&'v mut Value> {
    match value {
        Value::Array(list) => list.get_mut(key.parse::<usize>().ok()?),
        Value::Table(table) => Some(table.entry(key.replace('_', "-")).or_insert(Value::Table(Table::new()))),
        _ => None,
    }
}

#[pymethods]
impl Setup {
    #[new]
    #[pyo3(signature = (**entries))]
    fn new(entries: Option<&Bound<'_, PyDict>>) -> PyResult<Self> {
        let given = keywords(entries)?;
        let mut table = Table::try_from(Description::default()).map_err(failed)?;
        table.extend(given);
        Self::checked(&Value::Table(table))
    }

    /// Setup of a dictionary of all entries. As in a scene file there are no bodies but those that it names.
    #[classmethod]
    fn from_dict(_class: &Bound<'_, PyType>, entries: &Bound<'_, PyDict>) -> PyResult<Self> {
        Self::checked(&Value::Table(keywords(Some(entries))?))
    }

    /// Setup of a scene file's text (TOML).
    #[classmethod]
    fn from_toml(_class: &Bound<'_, PyType>, text: &str) -> PyResult<Self> {
        Ok(Self { description: Description::from_toml(text).map_err(|error| of_setup(&error))? })
    }

    /// Setup of a scene file (TOML). Files of outlines and meshes that it names are relative to it.
    #[classmethod]
    fn from_file(_class: &Bound<'_, PyType>, path: &Bound<'_, PyAny>) -> PyResult<Self> {
        let path: PathBuf = path.extract()?;
        Ok(Self { description: Description::from_file(&path).map_err(|error| of_setup(&error))? })
    }

    /// Reports of the outlines of the setup, one dictionary each: by how much the shape differs from the polygon
    /// through the points. Lengths and areas are in the units of the setup.
    fn outlines<'py>(&self, py: Python<'py>) -> PyResult<Vec<Bound<'py, PyDict>>> {
        let reports = self.description.outlines().map_err(|error| of_setup(&error))?;
        let entry = |report: OutlineReport| {
            let dict = PyDict::new(py);
            dict.set_item("key", report.key.replace('-', "_"))?;
            dict.set_item("points", report.points)?;
            dict.set_item("repeated", report.repeated)?;
            dict.set_item("was_clockwise", report.was_clockwise)?;
            dict.set_item("distance", report.distance)?;
            dict.set_item("polygon_area", report.polygon_area)?;
            dict.set_item("area", report.area)?;
            dict.set_item("polygon_perimeter", report.polygon_perimeter)?;
            dict.set_item("perimeter", report.perimeter)?;
            dict.set_item("resolved_perimeter", report.resolved_perimeter)?;
            dict.set_item("centroid", report.centroid)?;
            dict.set_item("covered", report.covered)?;
            Ok(dict)
        };
        reports.into_iter().map(entry).collect()
    }

    /// Text of a scene file with all entries.
    fn to_toml(&self) -> PyResult<String> {
        self.description.to_toml().map_err(|error| of_setup(&error))
    }

    /// Dictionary of all entries.
    fn to_dict<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        to_python(py, &Value::Table(self.table()?))
    }

    /// Setup with some entries replaced: top-level keys as keywords, others by their places, as in
    /// `setup.replace({"droplets.0.particles.activity": -3}, viscosity=10)`.
    #[pyo3(signature = (places=None, /, **entries))]
    fn replace(&self, places: Option<&Bound<'_, PyDict>>, entries: Option<&Bound<'_, PyDict>>) -> PyResult<Self> {
        let mut whole = Value::Table(self.table()?);
        if let Value::Table(table) = &mut whole {
            for (name, _) in entries.into_iter().flatten() {
                table.remove(&name.extract::<String>()?.replace('_', "-"));
            }
            table.extend(keywords(entries)?);
        }
        for (place, object) in places.into_iter().flatten() {
            let place: String = place.extract().map_err(|_| unreadable("", &place, "use places as text"))?;
            let (above, last) = place.rsplit_once('.').unwrap_or(("", &place));
            let said = format!("{place}: the setup has no such place. Print the setup to see its entries");
            let missing = || refused(&said, Some(place.clone()), None, None);
            let mut at = &mut whole;
            for key in above.split('.').filter(|key| !key.is_empty()) {
                at = entry(at, key).ok_or_else(missing)?;
            }
            match (from_python(&object, &place)?, at) {
                (None, Value::Table(table)) => drop(table.remove(&last.replace('_', "-"))),
                (Some(value), at) => *entry(at, last).ok_or_else(missing)? = value,
                (None, _) => return Err(missing()),
            }
        }
        Self::checked(&whole)
    }

    /// Scene of the description. Warns of values that are legal but rarely meant.
    fn build<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        for hint in self.description.hints() {
            let (key, text) = hint.split_once(": ").unwrap_or(("", &hint));
            py.import("warnings")?.call_method1("warn", (format!("{}: {text}", key.replace('-', "_")),))?;
        }
        py.import("motile._scene")?.getattr("Scene")?.call1((Scene::new(py, &self.description)?,))
    }

    /// Number (hexadecimal) that tells descriptions of different physics, places or resolution apart, but not different
    /// time steps.
    #[getter]
    fn fingerprint(&self) -> String {
        self.description.fingerprint()
    }

    /// Entry at a top-level key, as a copy.
    fn __getattr__<'py>(&self, py: Python<'py>, name: &str) -> PyResult<Bound<'py, PyAny>> {
        let entries = self.to_dict(py)?.cast_into::<PyDict>()?;
        if let Some(value) = entries.get_item(name)? {
            return Ok(value);
        }
        // Entries that are none have no key in a scene file.
        let known = ["repulsion", "least_gap", "flow"];
        if known.contains(&name) {
            return Ok(py.None().into_bound(py));
        }
        Err(pyo3::exceptions::PyAttributeError::new_err(format!("a Setup has no key {name}")))
    }

    /// Refused, with what to do instead: a Setup does not change.
    fn __setattr__(&self, py: Python<'_>, name: &str, _value: &Bound<'_, PyAny>) -> PyResult<()> {
        self.keep(py, name)
    }

    /// Refused as well.
    fn __delattr__(&self, py: Python<'_>, name: &str) -> PyResult<()> {
        self.keep(py, name)
    }

    fn __dir__<'py>(slf: &Bound<'py, Self>) -> PyResult<Vec<String>> {
        let py = slf.py();
        let of_class: Vec<String> = py.get_type::<Self>().call_method0("mro")?.get_item(0)?.dir()?.extract()?;
        let keys = slf.get().to_dict(py)?.cast_into::<PyDict>()?.keys();
        Ok(of_class.into_iter().chain(keys.extract::<Vec<String>>()?).collect())
    }

    /// Bodies where they start and the text of the scene file, for notebooks.
    fn _repr_html_<'py>(slf: &Bound<'py, Self>) -> PyResult<Bound<'py, PyAny>> {
        slf.py().import("motile._html")?.call_method1("of_setup", (slf,))
    }

    fn __repr__(&self) -> PyResult<String> {
        Ok(format!("motile.Setup.from_toml(\"\"\"\n{}\"\"\")", self.to_toml()?))
    }

    fn __hash__(&self) -> u64 {
        u64::from_str_radix(&self.fingerprint(), 16).unwrap_or_default()
    }

    fn __reduce__<'py>(slf: &Bound<'py, Self>) -> PyResult<(Bound<'py, PyAny>, Bound<'py, PyTuple>)> {
        let py = slf.py();
        let text = PyString::new(py, &slf.get().to_toml()?);
        Ok((py.get_type::<Self>().getattr("from_toml")?, PyTuple::new(py, [text])?))
    }
}

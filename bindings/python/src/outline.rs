//! Points of outlines in files.

use std::path::PathBuf;

use numpy::{PyArray1, PyArray2, PyArrayMethods as _};
use pyo3::prelude::*;

use motile::base::{Vec2, positive};
use motile::outline_files::{Choice, OutlineError, OutlineFile, closed, smooth as smoothed};

use crate::error::refused;

/// Points (length) of the outline in a file, counter-clockwise, an array of shape (n, 2).
///
/// Files are tables (CSV), SVG, GeoJSON and regions of interest of ImageJ. `scale` is the length of the unit of the
/// file, such as the side of a pixel. `flip` is true if y runs downwards in the file; by default it is true for SVG and
/// ImageJ. `smooth` is the distance (length) by which a smooth curve may pass the points, for an outline that was
/// traced along pixels. `name` or `index` chooses one of several outlines.
#[pyfunction]
#[pyo3(signature = (path, *, scale=1.0, flip=None, smooth=None, name=None, index=None))]
pub(crate) fn read_outline<'py>(
    py: Python<'py>,
    path: PathBuf,
    scale: f64,
    flip: Option<bool>,
    smooth: Option<f64>,
    name: Option<String>,
    index: Option<usize>,
) -> PyResult<Bound<'py, PyArray2<f64>>> {
    if name.is_some() && index.is_some() {
        let remedy = "Give one of them";
        let message = format!("an outline is chosen by its name or by its index. {remedy}");
        return Err(refused(&message, Some("index".into()), None, Some(remedy.to_owned())));
    }
    let choice = name.map(Choice::Name).or(index.map(Choice::Index)).unwrap_or_default();
    let read = move || -> Result<Vec<Vec2>, OutlineError> {
        positive("scale", scale)?;
        let file = OutlineFile::read(&path)?;
        let up = if flip.unwrap_or(file.y_runs_down()) { -1.0 } else { 1.0 };
        let points = &file.choose(&choice)?.points;
        let points: Vec<Vec2> = points.iter().map(|point| Vec2::new(point.x, up * point.y) * scale).collect();
        match smooth {
            Some(distance) => Ok(smoothed(&points, None, distance)?.points),
            None => Ok(closed(&points)?.points),
        }
    };
    let points = py.detach(read).map_err(|error| refused(&error.to_string(), None, None, None))?;
    PyArray1::from_vec(py, points.iter().flat_map(|point| point.to_array()).collect()).reshape([points.len(), 2])
}

//! Polygons and lines in GeoJSON (RFC 7946), and lists of points.

use motile_base::Vec2;
use serde_json::Value;

use crate::error::quoted;
use crate::{Contour, OutlineError};

const REMEDY: &str = "Use GeoJSON with geometries of the type Polygon, MultiPolygon or LineString, or a list of points \
                      [[x, y], ...]";
/// Most bytes of a text, which takes several times as many in memory.
const MOST_BYTES: usize = 1 << 26;
/// Deepest collection within a collection.
const DEEPEST: usize = 16;

/// Returns the outlines of a text, and true if they are regions of a picture, in which y runs downwards.
pub(crate) fn read(text: &str) -> Result<(Vec<Contour>, bool), OutlineError> {
    if text.len() > MOST_BYTES {
        let problem = format!("it has {:.1e} bytes, more than {:.1e}", text.len() as f64, MOST_BYTES as f64);
        return Err(OutlineError::format("the file", problem, "Use fewer points, or CSV"));
    }
    let value: Value = serde_json::from_str(text).map_err(|error| {
        OutlineError::format(format!("line {}", error.line()), error.to_string(), "Save the file as GeoJSON")
    })?;
    let mut contours = Vec::new();
    add(&value, None, 0, &mut contours)?;
    Ok((contours, is_of_picture(&value, 0)))
}

/// Returns true for features of QuPath, which are regions of a picture: they have a type of object, or an id of one in
/// files of older versions.
fn is_of_picture(value: &Value, depth: usize) -> bool {
    let own = value.get("properties").is_some_and(|properties| properties.get("objectType").is_some());
    let id = value.get("id").and_then(Value::as_str).unwrap_or_default();
    let old = id.starts_with("Path") && id.ends_with("Object");
    let entries = value.as_array().or_else(|| value.get("features").and_then(Value::as_array));
    own || old || depth < DEEPEST && entries.is_some_and(|list| list.iter().any(|one| is_of_picture(one, depth + 1)))
}

/// Adds the outlines of an object.
fn add(value: &Value, name: Option<&str>, depth: usize, to: &mut Vec<Contour>) -> Result<(), OutlineError> {
    if depth > DEEPEST {
        return Err(OutlineError::format("the file", "its collections are nested too deeply", REMEDY));
    }
    // Some programs write a list of features without a collection around them.
    if let Value::Array(list) = value {
        let is_point = |entry: &Value| entry.as_array().is_some_and(|pair| pair.iter().all(Value::is_number));
        if !list.is_empty() && list.iter().all(is_point) {
            to.push(Contour { name: name.map(str::to_owned), points: points(value)?, closed: true });
            return Ok(());
        }
        return list.iter().try_for_each(|entry| add(entry, name, depth + 1, to));
    }
    let entry = |key: &str| value.get(key).unwrap_or(&Value::Null);
    let kind = entry("type").as_str().unwrap_or_default();
    match kind {
        "FeatureCollection" => add(entry("features"), name, depth + 1, to),
        "GeometryCollection" => add(entry("geometries"), name, depth + 1, to),
        "Feature" => {
            let own = entry("properties").get("name").and_then(Value::as_str).or_else(|| entry("id").as_str());
            // A feature without a place.
            if entry("geometry").is_null() {
                return Ok(());
            }
            add(entry("geometry"), own.or(name), depth + 1, to)
        }
        "Polygon" => polygon(entry("coordinates"), name, to),
        "MultiPolygon" => list(entry("coordinates"))?.iter().try_for_each(|one| polygon(one, name, to)),
        "LineString" => {
            to.push(Contour { name: name.map(str::to_owned), points: points(entry("coordinates"))?, closed: false });
            Ok(())
        }
        "MultiLineString" => list(entry("coordinates"))?.iter().try_for_each(|one| {
            to.push(Contour { name: name.map(str::to_owned), points: points(one)?, closed: false });
            Ok(())
        }),
        "" => {
            let keys = value.as_object().map(|object| object.keys().take(4).map(|key| quoted(key)).collect::<Vec<_>>());
            let what = match keys {
                Some(keys) if !keys.is_empty() => format!("the keys {} are not GeoJSON", keys.join(", ")),
                _ => "this is not GeoJSON".to_owned(),
            };
            Err(OutlineError::format("the file", what, REMEDY))
        }
        other => {
            let problem = format!("the type {:?} is not an outline", quoted(other));
            Err(OutlineError::format("the file", problem, REMEDY))
        }
    }
}

/// Adds the ring of a polygon.
fn polygon(rings: &Value, name: Option<&str>, to: &mut Vec<Contour>) -> Result<(), OutlineError> {
    let rings = list(rings)?;
    if rings.len() > 1 {
        let problem = format!("a polygon has {} holes", rings.len() - 1);
        let remedy = "Remove the holes, or save their rings as polygons of their own";
        return Err(OutlineError::format("the file", problem, remedy));
    }
    for ring in rings {
        to.push(Contour { name: name.map(str::to_owned), points: points(ring)?, closed: true });
    }
    Ok(())
}

fn list(value: &Value) -> Result<&[Value], OutlineError> {
    let missing = || OutlineError::format("the file", "a geometry has no list of coordinates", REMEDY);
    value.as_array().map(Vec::as_slice).ok_or_else(missing)
}

/// Returns the points of a list of positions.
fn points(value: &Value) -> Result<Vec<Vec2>, OutlineError> {
    let positions = list(value)?.iter().enumerate();
    let point = |(number, position): (usize, &Value)| {
        let at = |axis: usize| position.get(axis).and_then(Value::as_f64);
        at(0)
            .zip(at(1))
            .map(|(x, y)| Vec2::new(x, y))
            .ok_or_else(|| OutlineError::format(format!("position {number} of a geometry"), "it is not [x, y]", REMEDY))
    };
    positions.map(point).collect()
}

#[cfg(test)]
mod tests;

//! Several outlines below one another, which a column distinguishes.

use std::collections::BTreeMap;

use motile_base::Vec2;

use super::Row;
use super::columns::Columns;
use super::fields::Field;
use crate::error::quoted;
use crate::{Contour, OutlineError};

/// Names of columns whose values distinguish outlines.
const NAMES: [&str; 22] = [
    "cell",
    "cell_id",
    "cellid",
    "contour",
    "contour_id",
    "frame",
    "group",
    "id",
    "index",
    "label",
    "object",
    "object_id",
    "particle",
    "polygon",
    "roi",
    "shape",
    "slice",
    "t",
    "time",
    "track",
    "track_id",
    "z",
];
/// Fewest points of an outline.
const FEWEST: usize = 3;
/// Relative distance in z up to which points lie in one plane.
const FLAT: f64 = 1e-6;

/// Returns the outlines of the points of lines: one for each value of the columns that distinguish them, otherwise one.
pub(super) fn split(
    points: &[Vec2],
    rows: &[Row<'_>],
    header: Option<&[Field<'_>]>,
    columns: &Columns,
) -> Result<Vec<Contour>, OutlineError> {
    let whole = || vec![Contour { name: None, points: points.to_vec(), closed: true }];
    let Some(header) = header else { return Ok(whole()) };
    let mut of_outline = Vec::new();
    for (place, name) in header.iter().enumerate() {
        let (place, name) = (place + columns.shift, name.text.to_lowercase());
        if [columns.x, columns.y].contains(&place) || !NAMES.contains(&name.as_str()) {
            continue;
        }
        let mut counts: BTreeMap<&str, usize> = BTreeMap::new();
        for row in rows {
            *counts.entry(row.fields.get(place).map_or("", |field| field.text)).or_default() += 1;
        }
        if counts.len() > 1 && counts.values().all(|count| *count >= FEWEST) {
            of_outline.push(place);
        } else if name == "z" {
            check_plane(points, rows, place)?;
        }
    }
    if of_outline.is_empty() {
        return Ok(whole());
    }
    // In the order of their first points.
    let mut numbers: BTreeMap<String, usize> = BTreeMap::new();
    let mut contours: Vec<Contour> = Vec::new();
    for (row, point) in rows.iter().zip(points) {
        let values = of_outline.iter().map(|place| row.fields.get(*place).map_or("", |field| field.text));
        let name = values.collect::<Vec<_>>().join(" ");
        let number = *numbers.entry(name.clone()).or_insert(contours.len());
        if number == contours.len() {
            contours.push(Contour { name: Some(name), points: Vec::new(), closed: true });
        }
        contours[number].points.push(*point);
    }
    Ok(contours)
}

/// Refuses points of different heights.
fn check_plane(points: &[Vec2], rows: &[Row<'_>], place: usize) -> Result<(), OutlineError> {
    let far = Vec2::splat(f64::INFINITY);
    let [low, high] = points.iter().fold([far, -far], |[low, high], p| [low.min(*p), high.max(*p)]);
    let heights = rows.iter().filter_map(|row| Some((row, row.fields.get(place)?.number()?)));
    let Some((_, first)) = heights.clone().next() else { return Ok(()) };
    let limit = FLAT * (high - low).max_element();
    if let Some((row, height)) = heights.clone().find(|(_, height)| (height - first).abs() > limit) {
        let problem =
            format!("z is {height} in {:?} and {first} at first, so the outline is not flat", quoted(row.text));
        let remedy = "Remove the column z to use the view along z, or choose points of one z";
        return Err(OutlineError::format(row.place(), problem, remedy));
    }
    Ok(())
}

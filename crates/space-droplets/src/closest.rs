//! The point of a surface where a function of the place is smallest, such as the distance to a wall.

use std::f64::consts::PI;

use motile_base::internal::dot as sum_of_products;
use sphere_harmonics::{Harmonics, Point};

use crate::SpaceError;
use crate::surface::{Surface, dot};

/// Angle of differences. The place of the smallest value is off by its square times the square of the degree, and the
/// value itself by the square of that.
const ANGLE: f64 = 1e-3;
/// Angle of a step below which the value is exact to round-off.
const SMALL: f64 = 1e-6;
/// Most steps, and most searches from different starts.
const MOST_STEPS: usize = 40;
const MOST_STARTS: usize = 6;
/// Spacings of the grid between two starts.
const APART: f64 = 3.0;

/// Returns the spacing of the grid as an angle.
pub(crate) fn spacing(surface: &Surface) -> f64 {
    PI / surface.grid.colatitudes().len() as f64
}

/// Returns by how much (length) a smallest value can be below the smallest value at the points of the grid, if the
/// function changes at most as fast as the distance.
pub(crate) fn margin(surface: &Surface, reach: f64) -> f64 {
    reach * spacing(surface).powi(2)
}

/// Returns the smallest value of a function over a surface with these coefficients of its positions. Starts are points
/// of the grid with the function's values there; they are sorted in place.
pub(crate) fn smallest(
    positions: [&[f64]; 3],
    starts: &mut [(Point, f64)],
    (spacing, margin): (f64, f64),
    here: &mut Harmonics,
    mut function: impl FnMut([f64; 3]) -> Result<f64, SpaceError>,
) -> Result<f64, SpaceError> {
    starts.sort_by(|a, b| a.1.total_cmp(&b.1));
    let Some(&(_, lowest)) = starts.first() else { return Ok(f64::INFINITY) };
    let mut at = |direction: [f64; 3]| {
        here.place(Point::towards(direction))?;
        function(positions.map(|field| sum_of_products(here.values(), field)))
    };
    let (mut best, mut used) = (lowest, Vec::new());
    for &(point, _) in starts.iter().take_while(|(_, value)| *value <= lowest + margin) {
        let direction = point.direction();
        if used.iter().any(|other| dot(*other, direction) > (APART * spacing).cos()) {
            continue;
        }
        best = best.min(descend(direction, spacing, &mut at)?);
        used.push(direction);
        if used.len() == MOST_STARTS {
            break;
        }
    }
    Ok(best)
}

/// Returns the smallest value near a direction, by Newton steps of at most a trusted length.
fn descend(
    start: [f64; 3],
    spacing: f64,
    at: &mut impl FnMut([f64; 3]) -> Result<f64, SpaceError>,
) -> Result<f64, SpaceError> {
    let (mut direction, mut trusted) = (start, spacing);
    let mut value = at(direction)?;
    for _ in 0..MOST_STEPS {
        let frame = tangents(direction);
        let moved = |a: f64, b: f64| -> [f64; 3] {
            let there: [f64; 3] = std::array::from_fn(|i| direction[i] + a * frame[0][i] + b * frame[1][i]);
            let norm = dot(there, there).sqrt();
            there.map(|x| x / norm)
        };
        let mut by = |a: f64, b: f64| at(moved(ANGLE * a, ANGLE * b));
        let [right, left, up, down] = [by(1.0, 0.0)?, by(-1.0, 0.0)?, by(0.0, 1.0)?, by(0.0, -1.0)?];
        let diagonal = by(1.0, 1.0)? + by(-1.0, -1.0)?;
        let slope = [(right - left) / (2.0 * ANGLE), (up - down) / (2.0 * ANGLE)];
        let [xx, yy] = [right + left - 2.0 * value, up + down - 2.0 * value].map(|x| x / (ANGLE * ANGLE));
        let xy = 0.5 * ((diagonal - 2.0 * value) / (ANGLE * ANGLE) - xx - yy);
        let [a, b] = newton([xx, xy, yy], slope, trusted);
        let length = a.hypot(b);
        let there = moved(a, b);
        let next = at(there)?;
        if next < value {
            (direction, value) = (there, next);
            trusted = (2.0 * trusted).min(0.3);
        } else {
            trusted = 0.25 * length;
        }
        if length < SMALL || length.is_nan() {
            break;
        }
    }
    Ok(value)
}

/// Returns two unit vectors at right angles to a unit vector and to each other.
fn tangents(n: [f64; 3]) -> [[f64; 3]; 2] {
    let axis = if n[0].abs() < 0.6 { [1.0, 0.0, 0.0] } else { [0.0, 1.0, 0.0] };
    let along = dot(axis, n);
    let a: [f64; 3] = std::array::from_fn(|i| axis[i] - along * n[i]);
    let norm = dot(a, a).sqrt();
    let a = a.map(|x| x / norm);
    [a, [n[1] * a[2] - n[2] * a[1], n[2] * a[0] - n[0] * a[2], n[0] * a[1] - n[1] * a[0]]]
}

/// Returns the Newton step for second derivatives xx, xy and yy and first derivatives, downhill and of at most a
/// length.
fn newton([xx, xy, yy]: [f64; 3], slope: [f64; 2], most: f64) -> [f64; 2] {
    let steepness = slope[0].hypot(slope[1]);
    let lower = 0.5 * (xx + yy) - (0.25 * (xx - yy).powi(2) + xy * xy).sqrt();
    let shift = if lower > 0.0 { 0.0 } else { steepness / most - lower };
    let (xx, yy) = (xx + shift, yy + shift);
    let area = xx * yy - xy * xy;
    if area <= 0.0 || steepness == 0.0 {
        return [0.0; 2];
    }
    let [a, b] = [(xy * slope[1] - yy * slope[0]) / area, (xy * slope[0] - xx * slope[1]) / area];
    let factor = (most / a.hypot(b)).min(1.0);
    [factor * a, factor * b]
}

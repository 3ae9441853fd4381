//! Drawing of a state, as flat lists of numbers.

use motile::base::Vec2;
use motile_output::{OutputError, Samples, Snapshot, streamlines};

/// Distance of streamlines over the shorter side of the picture.
const APART: f64 = 0.055;

/// Shapes of a state: for each the kind, the number of points, then x, y (length) and the concentration (particles per
/// length, not a number without particles) of each. Kinds are 0 for a droplet, 1 for an open interface, 2 for the
/// filled area of a solid, 3 for a hole in the one before, 4 for a line of a surface.
#[must_use]
pub fn shapes(seen: &Snapshot) -> Vec<f32> {
    let mut list = Vec::new();
    let mut push = |kind: u8, points: &[Vec2], concentration: &[f64]| {
        list.extend([f32::from(kind), points.len() as f32]);
        for (k, point) in points.iter().enumerate() {
            let c = concentration.get(k).copied().unwrap_or(f64::NAN);
            list.extend([point.x as f32, point.y as f32, c as f32]);
        }
    };
    for solid in &seen.solids {
        for (number, outline) in solid.area.iter().enumerate() {
            push(if number == 0 { 2 } else { 3 }, outline, &[]);
        }
        for edge in &solid.edges {
            push(4, edge, &[]);
        }
    }
    for line in &seen.interfaces {
        push(1, &line.markers, &line.concentration);
    }
    for droplet in &seen.droplets {
        push(0, &droplet.markers, &droplet.concentration);
    }
    list
}

/// Derivative of the tension along a closed interface at its markers (force per length), from the tension (force) and
/// the length of each element. The element of a marker is the one that begins there.
#[must_use]
pub fn tension_gradient(tensions: &[f64], lengths: &[f64]) -> Vec<f32> {
    let count = tensions.len();
    let slope = |k: usize| {
        let before = (k + count - 1) % count;
        (tensions[k] - tensions[before]) / (0.5 * (lengths[k] + lengths[before]))
    };
    (0..count).map(|k| slope(k) as f32).collect()
}

/// Streamlines of a state: for each the number of points, then x and y (length) of each.
///
/// # Errors
/// None for a snapshot as it was taken.
pub fn lines(seen: &Snapshot, size: [f64; 2]) -> Result<Vec<f32>, OutputError> {
    let field = Samples::new(seen.raster, seen.velocity())?;
    let anchor = seen.droplets.first().map_or(Vec2::ZERO, |droplet| droplet.centroid);
    let found = streamlines(&field, APART * size[0].min(size[1]), anchor)?;
    let mut list = Vec::new();
    for line in found {
        list.push(line.len() as f32);
        list.extend(line.iter().flat_map(|point| point.to_array()).map(|value| value as f32));
    }
    Ok(list)
}

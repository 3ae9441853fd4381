//! Active region: the part of the interface that is crowded with particles.

use motile_base::{
    Vec2,
    internal::{all_finite, all_points_finite, at_least},
    same_length,
};

use super::curvature::fitted_curvature;
use crate::InterfaceError;
use crate::curve::polygon::edges;
use crate::error::all_positive;

/// Active region: the part of the interface from the steepest rise of the concentration to its steepest fall, in
/// counter-clockwise order (Cowley, section 2.3.4).
#[derive(Debug, Clone, Copy, PartialEq)]
#[non_exhaustive]
pub struct ActiveRegion {
    /// Arc length from marker 0 to the start, where dc/ds is largest (length).
    pub start: f64,
    /// Arc length from marker 0 to the end, where dc/ds is smallest (length).
    pub end: f64,
    /// Length of the region (length).
    pub length: f64,
    /// Active fraction: length of the region over the length of the whole interface (no dimension).
    pub fraction: f64,
}

/// Returns the active region of an interface with the segment lengths `lengths` (length) and the particle numbers
/// `numbers`, segment k from marker k to the next; `None` if the concentration is uniform to round-off.
///
/// dc/ds is taken at the markers, by a difference that is right to fourth order for averages over segments, and its
/// extrema are located between them on the polynomial through five values. Segments should be equally long, to a few
/// percent.
///
/// # Errors
/// Returns an error for slices of different length, fewer than eight segments, numbers that are not finite, lengths
/// that are not positive.
pub fn active_region(lengths: &[f64], numbers: &[f64]) -> Result<Option<ActiveRegion>, InterfaceError> {
    at_least("segments", lengths.len(), 8)?;
    same_length("numbers", lengths.len(), numbers.len())?;
    all_positive("the segment lengths", lengths)?;
    all_finite("the particle numbers", numbers)?;
    let m = lengths.len();
    let c: Vec<f64> = numbers.iter().zip(lengths).map(|(number, length)| number / length).collect();
    let difference = |k: usize| {
        let before = (k + m - 1) % m;
        (c[k] - c[before]) / (0.5 * (lengths[k] + lengths[before]))
    };
    // A difference of averages is the derivative smoothed twice over a segment, 1 + ds^2/12 d^2/ds^2: take that off.
    let slopes: Vec<f64> = (0..m)
        .map(|k| {
            let (before, here, after) = (difference((k + m - 1) % m), difference(k), difference((k + 1) % m));
            here - (before - 2.0 * here + after) / 12.0
        })
        .collect();
    let largest = c.iter().fold(0.0f64, |a, b| a.max(b.abs()));
    let perimeter: f64 = lengths.iter().sum();
    let steepest = |sign: f64| (0..m).max_by(|&i, &j| (sign * slopes[i]).total_cmp(&(sign * slopes[j]))).unwrap_or(0);
    let (rise, fall) = (steepest(1.0), steepest(-1.0));
    if (slopes[rise] - slopes[fall]) * perimeter <= 1e-9 * largest {
        return Ok(None);
    }
    let locate = |k: usize| {
        let offset = extremum(std::array::from_fn(|i| slopes[(k + m + i - 2) % m]));
        let at: f64 = lengths[..k].iter().sum();
        let along = if offset >= 0.0 { lengths[k] } else { lengths[(k + m - 1) % m] };
        (at + offset * along).rem_euclid(perimeter)
    };
    let (start, end) = (locate(rise), locate(fall));
    let span = (end - start).rem_euclid(perimeter);
    Ok(Some(ActiveRegion { start, end, length: span, fraction: span / perimeter }))
}

/// Returns the place of the extremum next to 0, between -1 and 1, of the polynomial through five values at -2, ..., 2.
fn extremum([a, b, c, d, e]: [f64; 5]) -> f64 {
    // f(x) = c + p x + q x^2 + r x^3 + s x^4
    let p = (a - 8.0 * b + 8.0 * d - e) / 12.0;
    let q = (-a + 16.0 * b - 30.0 * c + 16.0 * d - e) / 24.0;
    let r = (-a + 2.0 * b - 2.0 * d + e) / 12.0;
    let s = (a - 4.0 * b + 6.0 * c - 4.0 * d + e) / 24.0;
    let curvature = b - 2.0 * c + d;
    let parabola = if curvature == 0.0 { 0.0 } else { (0.5 * (b - d) / curvature).clamp(-0.5, 0.5) };
    let mut x = parabola;
    for _ in 0..20 {
        let slope = p + x * (2.0 * q + x * (3.0 * r + x * 4.0 * s));
        let bend = 2.0 * q + x * (6.0 * r + x * 12.0 * s);
        // Another kind of extremum, or none near: an edge too sharp for the polynomial.
        if bend * curvature <= 0.0 {
            return parabola;
        }
        let step = slope / bend;
        x -= step;
        if x.abs() > 1.0 {
            return parabola;
        }
        if step.abs() < 1e-14 {
            break;
        }
    }
    x
}

/// Returns the signed curvature (1/length) of the active region of an interface. It is the curvature of the circle
/// fitted to the region by least squares, positive where it bulges outwards, negative where it is dented (Cowley,
/// section 2.3.4).
///
/// Points of the region are weighted by arc length; its ends are interpolated between markers.
///
/// # Errors
/// Returns an error for fewer than eight markers, markers that are not finite, a region too short to fit a circle to.
pub fn active_curvature(markers: &[Vec2], region: &ActiveRegion) -> Result<f64, InterfaceError> {
    at_least("markers", markers.len(), 8)?;
    all_points_finite("the markers", markers)?;
    let m = markers.len();
    let mut arcs = vec![0.0; m + 1];
    for (k, (a, b)) in edges(markers).enumerate() {
        arcs[k + 1] = arcs[k] + (b - a).length();
    }
    let perimeter = arcs[m];
    if !(region.length > 0.0 && region.length <= perimeter && region.start.is_finite()) {
        return Err(InterfaceError::no_fit("a circle", 0));
    }
    let (start, end) = (region.start, region.start + region.length);
    let mut points = vec![interpolate(markers, &arcs, start)];
    let mut places = vec![start];
    let first = arcs[..m].partition_point(|&arc| arc <= start);
    for k in first..first + m {
        let arc = arcs[k % m] + if k >= m { perimeter } else { 0.0 };
        if arc >= end {
            break;
        }
        points.push(markers[k % m]);
        places.push(arc);
    }
    points.push(interpolate(markers, &arcs, end));
    places.push(end);
    let n = places.len();
    let weights: Vec<f64> = (0..n).map(|i| 0.5 * (places[(i + 1).min(n - 1)] - places[i.max(1) - 1])).collect();
    fitted_curvature(&points, &weights)
}

/// Returns the point at an arc length, on the cubic through the two markers on either side.
fn interpolate(markers: &[Vec2], arcs: &[f64], arc: f64) -> Vec2 {
    let m = markers.len();
    let arc = arc.rem_euclid(arcs[m]);
    let k = arcs[1..m].partition_point(|&a| a <= arc);
    let x = (arc - arcs[k]) / (arcs[k + 1] - arcs[k]);
    let at = |i: usize| markers[(k + m + i - 1) % m];
    at(0) * (-x * (x - 1.0) * (x - 2.0) / 6.0)
        + at(1) * ((x + 1.0) * (x - 1.0) * (x - 2.0) / 2.0)
        + at(2) * (-(x + 1.0) * x * (x - 2.0) / 2.0)
        + at(3) * ((x + 1.0) * x * (x - 1.0) / 6.0)
}

#[cfg(test)]
mod tests;

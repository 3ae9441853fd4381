//! The flow away from the markers, against boundary integrals.

use std::f64::consts::TAU;

use motile::ib_core::{FlowSample, Hydrodynamics, Markers, Vec2};
use motile::{AnyFlow, Region};

use super::{Droplet, exact, sharp};
use crate::validation::StudyError;

/// Errors of the flow away from the markers of a single droplet.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct FieldErrors {
    /// Velocity, relative to the fastest marker.
    pub velocity: f64,
    /// Velocity gradient, relative to the fastest marker over the unit of length.
    pub gradient: f64,
    /// Pressure, relative to the range of the sampled pressures.
    pub pressure: f64,
}

/// Largest errors of sampled flows at points around a droplet that are nearer to the interface than 3h, on
/// the inside and on the outside, and farther away, inside and outside.
///
/// # Errors
/// A spacing that does not divide the region; what the solvers can fail with.
pub fn field_errors(region: Region, droplet: &Droplet, h: f64) -> Result<[FieldErrors; 4], StudyError> {
    let mut points = Vec::new();
    for k in 0..40 {
        let t = TAU * (f64::from(k) + 0.37) / 40.0;
        let [a, b] = droplet.axes;
        let normal = Vec2::new(b * t.cos(), a * t.sin()).normalize();
        // The golden ratio spreads the distances over both sides.
        let fraction = (f64::from(k) * 0.618_033_988_75).fract();
        let distance = if k % 2 == 0 { 3.0 * h * (2.0 * fraction - 1.0) } else { 1.1 * fraction - 0.5 };
        points.push((droplet.point(t) + distance * normal, distance));
    }
    let places: Vec<Vec2> = points.iter().map(|(point, _)| *point).collect();
    let mut found = vec![FlowSample::default(); 40];
    let (exact, largest) = exact_samples(region, droplet, &places)?;
    let mut markers = Markers::new();
    droplet.push_even(0.5 * h, &mut markers)?;
    sample(sharp(region, h)?, &mut markers, &places, &mut found)?;
    // Pressures are known up to a constant.
    let count = points.len() as f64;
    let shift = found.iter().zip(&exact).map(|(a, b)| a.pressure - b.pressure).sum::<f64>() / count;
    let pressures = exact.iter().map(|sample| sample.pressure);
    let range = pressures.clone().fold(f64::MIN, f64::max) - pressures.fold(f64::MAX, f64::min);
    let mut errors = [FieldErrors::default(); 4];
    for (((_, distance), found), exact) in points.iter().zip(&found).zip(&exact) {
        let class = usize::from(distance.abs() > 3.0 * h) * 2 + usize::from(*distance > 0.0);
        let error = &mut errors[class];
        error.velocity = error.velocity.max((found.velocity - exact.velocity).length() / largest);
        for (found, exact) in found.gradient.iter().flatten().zip(exact.gradient.iter().flatten()) {
            error.gradient = error.gradient.max((found - exact).abs() / largest);
        }
        error.pressure = error.pressure.max((found.pressure - exact.pressure - shift).abs() / range);
    }
    Ok(errors)
}

/// The flow of a single droplet at points by boundary integrals, and its largest marker velocity.
fn exact_samples(region: Region, droplet: &Droplet, points: &[Vec2]) -> Result<(Vec<FlowSample>, f64), StudyError> {
    let mut samples = vec![FlowSample::default(); points.len()];
    let mut markers = Markers::new();
    droplet.push_exact(256, &mut markers);
    sample(exact(region, 256)?, &mut markers, points, &mut samples)?;
    Ok((samples, markers.velocities().iter().map(|v| v.length()).fold(0.0, f64::max)))
}

/// The velocities of the flow of a single droplet at points, by boundary integrals.
///
/// # Errors
/// What the solver can fail with.
pub fn exact_flow(region: Region, droplet: &Droplet, points: &[Vec2]) -> Result<Vec<Vec2>, StudyError> {
    Ok(exact_samples(region, droplet, points)?.0.into_iter().map(|sample| sample.velocity).collect())
}

fn sample(mut flow: AnyFlow, markers: &mut Markers, points: &[Vec2], out: &mut [FlowSample]) -> Result<(), StudyError> {
    flow.velocities(markers)?;
    flow.sample(markers, points, out)?;
    Ok(())
}

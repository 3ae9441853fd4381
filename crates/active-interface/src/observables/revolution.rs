//! Observables of bodies of revolution in three dimensions.

use std::f64::consts::PI;

use motile_base::Vec2;

use super::frame::{Frame, weighted_normals};
use super::polar::{Polar, PolarMarkers};
use super::{ForceMoments, InterfaceState, Observables, SquirmerFit};
use crate::InterfaceError;
use crate::curve::polygon::edges;

/// Numbers of particles that segments would have in the plane at the concentrations of halves of rings.
pub(super) fn numbers_in_plane(markers: &[Vec2], numbers: &[f64]) -> Vec<f64> {
    edges(markers).zip(numbers).map(|((a, b), number)| number / (0.5 * PI * (a.y + b.y).abs())).collect()
}

/// Replaces what differs in three dimensions: centroid, velocity, volume (as the area), area (as the perimeter),
/// particles, aspect ratio of the moments of the volume, moments of the forces, and squirmer coefficients, which are
/// the projections of u_theta on sin and sin cos in the sense of Legendre functions,
///
/// ```text
/// B1 = 3/4 INT u_theta sin^2 dtheta      B2 = 15/4 INT u_theta sin^2 cos dtheta
/// ```
///
/// Sums over halves of rings, of second order in the spacing of markers.
pub(super) fn observe_in_space(state: &InterfaceState<'_>, record: &mut Observables) -> Result<(), InterfaceError> {
    let InterfaceState { markers, forces, velocities, numbers, viscosities, .. } = *state;
    let rings = || markers.iter().zip(weighted_normals(markers)).map(|(x, n)| (*x, PI * x.y.abs() * n));
    let integral = |of: &dyn Fn(Vec2, Vec2) -> f64| -> f64 { rings().map(|(x, n)| of(x, n)).sum() };
    let volume = integral(&|x, n| x.dot(n) / 3.0);
    let centre = integral(&|x, n| 0.5 * x.x * x.x * n.x) / volume;
    let along = integral(&|x, n| (x.x - centre).powi(3) / 3.0 * n.x);
    let across = 0.5 * integral(&|x, n| 0.25 * x.y.powi(3) * n.y);
    let flux = rings().zip(velocities).map(|((x, n), u)| (x.x - centre) * u.dot(n));
    let velocity = flux.sum::<f64>() / volume;
    let ratio = along / across;
    if !(ratio > 0.0 && ratio.is_finite()) {
        return Err(InterfaceError::Crossed);
    }
    (record.centroid, record.velocity) = (Vec2::new(centre, 0.0), Vec2::new(velocity, 0.0));
    (record.area, record.perimeter) = (volume, integral(&|_, n| n.length()));
    record.aspect_ratio_moments = ratio.sqrt();
    record.particle_number = numbers.iter().sum();

    let factor = record.convention.factor(viscosities)?;
    let mut moments = ForceMoments { in_space: true, ..ForceMoments::default() };
    for (((x, n), f), u) in rings().zip(forces).zip(velocities) {
        moments.force[0] += f.x;
        moments.dipole[0][0] += f.x * (x.x - centre) + 2.0 * factor * u.x * n.x;
        moments.dipole[1][1] += 0.5 * (f.y * x.y + 2.0 * factor * u.y * n.y);
    }
    record.moments = moments;
    let frame = Frame::of_motion(record.centroid, record.velocity)?;
    let polar = PolarMarkers::new(markers, &frame);
    let fit = |drift: f64| {
        let mut fit = SquirmerFit::default();
        for ((Polar { direction, .. }, weight), u) in polar.weighted().zip(velocities) {
            let seen = frame.components(*u - Vec2::new(drift, 0.0));
            let part = weight * direction.perp_dot(seen) * direction.y * direction.y.abs();
            fit.b1 += 0.375 * part;
            fit.b2 += 1.875 * part * direction.x;
        }
        fit
    };
    (record.squirmer, record.squirmer_laboratory) = (fit(velocity), fit(0.0));
    Ok(())
}

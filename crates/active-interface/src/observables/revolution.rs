//! Observables of bodies of revolution in three dimensions.

use motile_base::{InputError, Vec2};

use motile_scene::{Enclosed, MomentEllipse};

use super::{ForceMoments, Frame, InterfaceState, Observables, SquirmerFit};
use crate::InterfaceError;
use crate::interface::geometry::{Geometry, Rings, outward};
use crate::interface::spectral::SpectralCurve;

/// Returns the geometry of the smooth surface whose meridian, with its mirror image, goes through these markers.
///
/// # Errors
/// Returns an error for more markers than a Fourier transform takes.
pub(super) fn surface(markers: &[Vec2]) -> Result<Geometry, InputError> {
    let (mut curve, mut geometry) = (SpectralCurve::new(markers.len())?, Geometry::default());
    curve.update(markers, 0.0, &mut geometry);
    curve.update_rings(markers, &mut geometry);
    Ok(geometry)
}

/// Replaces what differs in three dimensions: centroid, velocity, volume (as the area), area (as the perimeter),
/// particles, aspect ratio of the moments of the volume, moments of the forces, and squirmer coefficients, which are
/// the projections of u_theta on sin and sin cos in the sense of Legendre functions,
///
/// ```text
/// B1 = 3/4 INT u_theta sin^2 dtheta      B2 = 15/4 INT u_theta sin^2 cos dtheta
/// ```
///
/// Integrals over the smooth surface through the markers, as accurate as its series; the volume is the one that the
/// motion keeps.
pub(super) fn observe_in_space(
    state: &InterfaceState<'_>,
    surface: &Geometry,
    rest: f64,
    record: &mut Observables,
) -> Result<(), InterfaceError> {
    let InterfaceState { markers, forces, velocities, numbers, viscosities, .. } = *state;
    let Geometry { tangents, weights: lengths, rings, .. } = surface;
    // Relative to a marker on the axis, so that droplets that have travelled far lose no digits.
    let pole = Vec2::new(markers[0].x, 0.0);
    let parts = || {
        let normals = tangents.iter().zip(&rings.weights).map(|(tau, weight)| *weight * outward(*tau));
        markers.iter().map(move |x| *x - pole).zip(normals)
    };
    let integral = |of: &dyn Fn(Vec2, Vec2) -> f64| -> f64 { parts().map(|(x, n)| of(x, n)).sum() };
    let volume = surface.volume(markers);
    let centre = integral(&|x, n| 0.5 * x.x * x.x * n.x) / volume;
    let along = integral(&|x, n| (x.x - centre).powi(3) / 3.0 * n.x);
    let across = 0.5 * integral(&|x, n| 0.25 * x.y.powi(3) * n.y);
    let flux = parts().zip(velocities).map(|((x, n), u)| (x.x - centre) * u.dot(n));
    let velocity = flux.sum::<f64>() / volume;
    let ratio = along / across;
    if !(ratio > 0.0 && ratio.is_finite()) {
        return Err(InterfaceError::crossed());
    }
    (record.centroid, record.velocity) = (pole + Vec2::new(centre, 0.0), Vec2::new(velocity, 0.0));
    (record.relative_velocity, record.moves) = (record.velocity, velocity.abs() > rest);
    let moments = [along, 0.0, across].map(|moment| moment / volume);
    record.shape = MomentEllipse::of_moments(volume, record.centroid, moments, true);
    (record.area, record.perimeter) = (volume, surface.total_weight());
    record.aspect_ratio_moments = ratio.sqrt();
    record.particle_number = numbers.iter().sum();

    let mut moments = ForceMoments { in_space: true, ..ForceMoments::default() };
    let about = [pole.x, centre];
    moments.add_ring_sums([markers, forces, velocities], record.convention.factor(viscosities)?, surface, about);
    for Enclosed { positions, forces, velocities, viscosities, .. } in &state.enclosed {
        let (factor, inner) = (record.convention.factor(*viscosities)?, self::surface(positions)?);
        moments.add_ring_sums([positions, forces, velocities], factor, &inner, about);
    }
    record.stresslet_in_laboratory = moments.stresslet();
    record.moments = moments;
    let quadrature = Rings::quadrature(markers.len());
    let frame = Frame::of_motion(record.centroid, record.velocity, rest)?;
    let fit = |drift: f64| {
        let mut fit = SquirmerFit::default();
        for (k, (x, u)) in markers.iter().zip(velocities).enumerate() {
            let from = frame.coordinates(*x);
            let (distance, seen) = (from.length(), frame.components(*u - Vec2::new(drift, 0.0)));
            let direction = from / distance;
            let turn = quadrature[k] * lengths[k] * direction.perp_dot(frame.components(tangents[k])) / distance;
            let part = turn * direction.perp_dot(seen) * direction.y * direction.y.abs();
            fit.b1 += 0.375 * part;
            fit.b2 += 1.875 * part * direction.x;
        }
        fit
    };
    (record.squirmer, record.squirmer_laboratory) = (fit(velocity).beyond(rest), fit(0.0).beyond(rest));
    Ok(())
}

impl ForceMoments {
    /// Adds the sums over the markers of a surface, from their places, forces and velocities. `factor` is the factor of
    /// the viscous term (stress times time). Moments are about `centre` from `pole` along the axis (length).
    fn add_ring_sums(
        &mut self,
        [markers, forces, velocities]: [&[Vec2]; 3],
        factor: f64,
        surface: &Geometry,
        [pole, centre]: [f64; 2],
    ) {
        let normals = surface.tangents.iter().zip(&surface.rings.weights).map(|(tau, weight)| *weight * outward(*tau));
        let rows = markers.iter().zip(normals).zip(forces).zip(velocities).zip(Rings::quadrature(markers.len()));
        for ((((x, n), f), u), weight) in rows {
            self.force[0] += weight * f.x;
            self.dipole[0][0] += weight * f.x * (x.x - pole - centre) + 2.0 * factor * u.x * n.x;
            self.dipole[1][1] += 0.5 * (weight * f.y * x.y + 2.0 * factor * u.y * n.y);
        }
    }
}

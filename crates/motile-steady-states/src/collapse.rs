//! Particles that gather to a point, where no steady swimmer exists.

use motile::active_interface::Tension as _;
use motile::base::Region;
use motile::setup::{ExcludedVolume, Particles, Setup, Start};
use motile_base::internal::Refuse as _;

use crate::{Parameter, SteadyError};

/// Relative excess of the activity over the threshold up to which it counts as at the threshold.
const AT_THRESHOLD: f64 = 1e-6;

/// Returns the particles of a droplet that starts to swim and whose tension grows without bound, so that nothing keeps
/// the particles apart.
fn unbalanced(setup: &Setup) -> Option<Particles> {
    let droplet = setup.droplets.first()?;
    let particles = droplet.particles.filter(|particles| particles.start != Start::Uniform)?;
    let law = particles.law(droplet.tension).ok()?;
    law.plateau().is_none().then_some(particles)
}

/// Returns the error for a description of which it is known that it has no steady swimmer.
///
/// A droplet in the plane stays round, and without excluded volume its flow along the interface is
/// `v = -(|zeta|/(2 (eta_in + eta_ext))) SUM c_m sin(m theta)`. A steady state without flux obeys
/// `v = (D/R) d(ln c)/dtheta`. Both hold for `c = c0 (1 - r^2)/(1 + r^2 - 2 r cos theta)` with any r from 0 to 1, at
/// `|zeta| = 2 D (eta_in + eta_ext)/(R c0)` alone, the threshold of swimming. Above it, the particles gather to a
/// point.
pub(crate) fn refusal(setup: &Setup) -> Option<SteadyError> {
    let particles = unbalanced(setup)?;
    let droplet = setup.droplets.first()?;
    let exact = particles.excluded_volume == ExcludedVolume::None
        && setup.region == Region::Plane
        && setup.flow.is_none()
        && setup.rigid_bodies.is_empty()
        && particles.exchange.is_none()
        && droplet.cortex.is_none()
        && droplet.friction == 0.0;
    let radius = Parameter::Radius.get(setup)?;
    let viscosities = droplet.viscosity.unwrap_or(setup.viscosity) + setup.viscosity;
    let threshold = 2.0 * particles.diffusion * viscosities / (radius * particles.concentration);
    let above = -particles.activity > (1.0 + AT_THRESHOLD) * threshold;
    (exact && above).then(|| {
        SteadyError::refused(
            format!("no steady swimmer has the activity {}", particles.activity),
            format!("above the threshold {threshold} of its size, particles without excluded volume gather to a point"),
            "Use an excluded volume of a strength above |activity|, or give the interface a cortex",
        )
    })
}

/// Returns the tension at the mean concentration (force) if a positive activity makes it negative or zero. Waves of
/// such an interface grow faster the shorter they are.
fn compression(setup: &Setup) -> Option<f64> {
    let droplet = setup.droplets.first()?;
    let particles = droplet.particles?;
    let tension = particles.law(droplet.tension).ok()?.value(particles.concentration);
    (particles.activity > 0.0 && tension <= 0.0).then_some(tension)
}

/// Returns the error of a search, with the reason if the interface is under compression or particles gather to a point.
pub(crate) fn explained(setup: &Setup, error: SteadyError) -> SteadyError {
    match (compression(setup), unbalanced(setup), &error) {
        (Some(tension), ..) => SteadyError::refused(
            "no steady state was found",
            format!("the tension at the mean concentration is {tension}, so that short waves of the interface grow"),
            "Use a negative activity, so that particles raise the tension, or a larger tension",
        ),
        (_, Some(particles), SteadyError::NoConvergence { .. }) => SteadyError::refused(
            format!("no steady swimmer of the activity {} was found", particles.activity),
            "the excluded volume balances it at no concentration, so that particles gather to a point",
            "Use an excluded volume of a strength above |activity|, or a weaker activity",
        ),
        _ => error,
    }
}

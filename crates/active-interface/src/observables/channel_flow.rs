//! Pressure drop and fluxes in a channel with a droplet.

mod branches;

pub use branches::{BranchFlow, branch_flows};

use std::ops::{AddAssign, Mul};

use motile_base::{FlowSample, SolveReport, Vec2, finite, internal::gauss_legendre, positive};
use motile_scene::{BodyError, FlowError, FluidView, Handle, Hydrodynamics, SceneError, System};

use crate::curve::polygon::edges;
use crate::{
    ActiveDroplet, InterfaceError,
    curve::polygon_moments,
    observables::{InterfaceState, centroid_velocity},
};

/// Returns the pressure drop along a channel of the length `length` (length), from its left to its right end (force per
/// length in two dimensions). It is `-dp/dx * length` with the mean pressure gradient that an evaluation of the flow
/// reports.
///
/// It is positive where pressure drives the fluid to the right, and zero if the pressure is periodic, as in Cowley's
/// channel. In a closed channel (no net flux), a swimmer has to push against it.
///
/// # Errors
/// Returns an error for a length that is not positive and finite, a report whose gradient is not finite.
pub fn pressure_drop(report: &SolveReport, length: f64) -> Result<f64, InterfaceError> {
    let gradient = finite("the mean pressure gradient", report.mean_pressure_gradient[0])?;
    Ok(-gradient * positive("the length of the channel", length)?)
}

/// Returns the net flux through a channel (area per time). It is the integral of the velocity u along it from wall to
/// wall at `x` (length). In an incompressible fluid it does not depend on x, except for the error of the quadrature.
///
/// u is integrated exactly as it is sampled if there is a grid (linearly between the rows of the grid; the error is of
/// second order in h), by 16 Gauss points between one interface and the next if there is none.
///
/// # Errors
/// Returns an error for a fluid without walls, the errors of an evaluation and of sampling.
pub fn net_flux<H: Hydrodynamics>(system: &mut System<H>, x: f64) -> Result<f64, SceneError> {
    let (view, time) = (system.hydrodynamics().fluid_view(), system.time());
    let [bottom, top] = walls(&view, time)?;
    let line = Line::new(&view, &[bottom, top], &kinks(system, &view, x)?);
    let [flux] = line.integrals(system, x)?;
    Ok(flux)
}

/// Fluxes along a channel through the cross-section at the centroid of a droplet, by [`gap_flow`].
///
/// "Inside" is between the lowest and the highest point of the interface on the cross-section; the "gaps" are the rest,
/// below and above.
#[derive(Debug, Clone, Copy, PartialEq)]
#[non_exhaustive]
pub struct GapFlow {
    /// Velocity of the droplet along the channel (length per time); the velocity of the imposed flow at its centroid if
    /// the droplet is at rest in it to round-off.
    pub velocity: f64,
    /// Velocity of the droplet along the channel relative to the imposed flow at its centroid (length per time); zero
    /// if the droplet is at rest in it to round-off.
    pub relative_velocity: f64,
    /// Flux through the gap below and the one above, in the frame of the walls (area per time).
    pub gaps: [f64; 2],
    /// Flux inside the droplet, in the frame of the walls (area per time).
    pub inside: f64,
    /// Heights of the gaps (length).
    pub gap_heights: [f64; 2],
    /// Height of the droplet between them (length).
    pub droplet_height: f64,
}

impl GapFlow {
    /// Returns the net flux along the channel (area per time), through gaps and droplet together.
    #[must_use]
    pub fn net(&self) -> f64 {
        self.gaps[0] + self.inside + self.gaps[1]
    }

    /// Returns the fluxes through the gaps in the frame of the droplet (area per time): `q - V d` with the flux q in
    /// the frame of the walls, the velocity V of the droplet and the height d of the gap.
    #[must_use]
    pub fn relative_gaps(&self) -> [f64; 2] {
        [0, 1].map(|i| self.gaps[i] - self.velocity * self.gap_heights[i])
    }

    /// Returns the retrograde flow: flux of the fluid that passes the droplet backwards through both gaps, in the frame
    /// of the droplet (area per time). It is negative for a droplet that the fluid overtakes, and `None` for a droplet
    /// at rest. Backwards is against the motion of the droplet relative to the imposed flow at its centroid, so that it
    /// does not depend on the frame in which walls slide.
    ///
    /// In a steady state it is `|V| w - Q` at every cross-section, w the width of the channel and Q the net flux in the
    /// droplet's direction.
    #[must_use]
    pub fn retrograde(&self) -> Option<f64> {
        let relative: f64 = self.relative_gaps().iter().sum();
        (self.relative_velocity != 0.0).then(|| -self.relative_velocity.signum() * relative)
    }
}

/// Returns the fluxes along a channel through the vertical line at the centroid of a droplet: the velocity u along the
/// channel integrated below, inside and above it.
///
/// The line is close to the widest cross-section of a swimmer on the centre line. A gap that is closed has the height
/// zero. Other bodies on the line count as fluid. u is integrated as by [`net_flux`]; the error is of second order in h
/// as long as the gaps are some cells wide.
///
/// # Errors
/// Returns an error for a fluid without walls, a handle of another scene, the errors of an evaluation and of sampling.
pub fn gap_flow<H: Hydrodynamics>(
    system: &mut System<H>,
    droplet: Handle<ActiveDroplet>,
) -> Result<GapFlow, SceneError> {
    let (view, time) = (system.hydrodynamics().fluid_view(), system.time());
    let [bottom, top] = walls(&view, time)?;
    system.evaluate()?;
    let state = InterfaceState::of(system, droplet)?;
    let markers = state.markers;
    let moving = polygon_moments(markers).and_then(|area| {
        let drift = state.imposed.velocity_at(area.centroid).x;
        let velocity = centroid_velocity(markers, state.velocities)?.x;
        let relative = velocity - drift;
        let moves = relative.abs() > state.rest_speed()?;
        Ok((area.centroid.x, if moves { [velocity, relative] } else { [drift, 0.0] }))
    });
    let (x, [velocity, relative_velocity]) = moving.map_err(|source| named(system, droplet, source))?;
    let [low, high] = crossings(markers, x).map(|y| y.clamp(bottom, top));
    let line = Line::new(&view, &[bottom, low, high, top], &kinks(system, &view, x)?);
    let [below, inside, above] = line.integrals(system, x)?;
    Ok(GapFlow {
        velocity,
        relative_velocity,
        gaps: [below, above],
        inside,
        gap_heights: [low - bottom, top - high],
        droplet_height: high - low,
    })
}

fn named<H: Hydrodynamics>(system: &System<H>, droplet: Handle<ActiveDroplet>, source: InterfaceError) -> SceneError {
    match system.any_body(droplet) {
        Ok(body) => {
            let body = body.name().to_owned();
            SceneError::Body { time: system.time(), body, source: BodyError::from(source) }
        }
        Err(error) => error,
    }
}

fn walls(view: &FluidView, time: f64) -> Result<[f64; 2], SceneError> {
    let source =
        || FlowError::unsupported("the flux through a cross-section", "Put the droplet into a channel with walls");
    view.domain.walls.ok_or_else(|| SceneError::Flow { time, source: source() })
}

/// Returns the lowest and highest point of the polygon at `x`; infinite and exchanged where it does not reach there.
fn crossings(markers: &[Vec2], x: f64) -> [f64; 2] {
    edges(markers)
        .filter(|(a, b)| (a.x < x) != (b.x < x))
        .map(|(a, b)| a.y + (b.y - a.y) * (x - a.x) / (b.x - a.x))
        .fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], y| [low.min(y), high.max(y)])
}

/// Returns the heights of kinks of the velocity along the vertical line at `x`, in order: of the rows of a grid, half a
/// cell off the walls, between which it is linear, or of all interfaces if there is no grid.
fn kinks<H: Hydrodynamics>(system: &mut System<H>, view: &FluidView, x: f64) -> Result<Vec<f64>, SceneError> {
    let [bottom, top] = walls(view, system.time())?;
    if let Some(h) = view.spacing {
        return Ok((0..((top - bottom) / h).ceil() as usize).map(|j| bottom + (j as f64 + 0.5) * h).collect());
    }
    let (markers, periods) = (system.evaluate()?, view.domain.periods);
    let curves = markers.groups().iter().filter(|group| group.kind.is_curve());
    let sides = curves.flat_map(|group| edges(&markers.positions()[group.range.clone()]));
    let crossed = sides.filter_map(|(a, b)| {
        let (from, along) = (periods.wrap(Vec2::new(a.x - x, 0.0)).x, periods.wrap(b - a));
        ((from < 0.0) != (from + along.x < 0.0)).then(|| a.y - along.y * from / along.x)
    });
    let mut heights: Vec<f64> = crossed.collect();
    heights.sort_by(f64::total_cmp);
    Ok(heights)
}

/// Gauss points between two kinks if there is no grid.
const POINTS: usize = 16;
/// Fraction of the channel's width below which a kink is at the end of a section.
const AT_END: f64 = 1e-9;

/// Points on a vertical line, and their weights, section by section.
#[derive(Debug, Clone, PartialEq)]
struct Line {
    /// Height, weight, section.
    points: Vec<(f64, f64, usize)>,
}

impl Line {
    /// Gauss points of the sections between the heights `ends`, in each between the kinks: on a grid two, which
    /// are exact.
    fn new(view: &FluidView, ends: &[f64], kinks: &[f64]) -> Self {
        let mut points = Vec::new();
        let rule = gauss_legendre(if view.spacing.is_some() { 2 } else { POINTS });
        let apart = AT_END * (ends[ends.len() - 1] - ends[0]);
        for (section, pair) in ends.windows(2).enumerate() {
            let (from, to) = (pair[0], pair[1]);
            let within = kinks.iter().copied().filter(|&y| from + apart < y && y < to - apart);
            let mut start = from;
            for end in within.chain([to]) {
                let (middle, half) = (0.5 * (start + end), 0.5 * (end - start));
                points.extend(rule.iter().map(|(at, weight)| (middle + at * half, weight * half, section)));
                start = end;
            }
        }
        Self { points }
    }

    /// Returns the integrals of u over the N sections, at `x`.
    fn integrals<const N: usize, H: Hydrodynamics>(
        &self,
        system: &mut System<H>,
        x: f64,
    ) -> Result<[f64; N], SceneError> {
        self.integrals_of(system, x, |sample| sample.velocity.x)
    }

    /// Returns the integrals of some value of the flow over the N sections, at `x`.
    fn integrals_of<const N: usize, H: Hydrodynamics, T: Copy + Default + AddAssign + Mul<f64, Output = T>>(
        &self,
        system: &mut System<H>,
        x: f64,
        value: impl Fn(&FlowSample) -> T,
    ) -> Result<[T; N], SceneError> {
        let positions: Vec<Vec2> = self.points.iter().map(|&(y, _, _)| Vec2::new(x, y)).collect();
        let mut samples = vec![FlowSample::default(); positions.len()];
        system.sample(&positions, &mut samples)?;
        let mut integrals = [T::default(); N];
        for (&(_, weight, section), sample) in self.points.iter().zip(&samples) {
            integrals[section] += value(sample) * weight;
        }
        Ok(integrals)
    }
}

#[cfg(test)]
mod tests;

//! Flow through the branches of a channel that islands divide, and their hydraulic resistance.

use motile_base::{FlowSample, Vec2, boxes::Periods};
use motile_scene::{FlowError, Hydrodynamics, MarkerKind, SceneError, System, gap::SurfacePoint};

use super::{AT_END, Line, kinks, walls};

/// Flow through one branch of a channel between two cross-sections, by [`branch_flows`].
#[derive(Debug, Clone, Copy, PartialEq)]
#[non_exhaustive]
pub struct BranchFlow {
    /// Heights of the lower and the upper end of the branch at both cross-sections (length).
    pub openings: [[f64; 2]; 2],
    /// Flux to larger x, the mean over both cross-sections (area per time).
    pub flux: f64,
    /// Mean pressure at the first cross-section less the mean pressure at the second one (force per length).
    pub pressure_drop: f64,
}

impl BranchFlow {
    /// Returns the hydraulic resistance: the pressure drop over the flux (stress times time over length squared).
    /// It is `None` if nothing flows.
    ///
    /// In a straight branch of length L and width w it is `12 eta L/w^3` (Poiseuille's flow between plates). It is a
    /// property of the walls only as long as no droplet or soft wall between the cross-sections drives a flow.
    #[must_use]
    pub fn resistance(&self) -> Option<f64> {
        (self.flux != 0.0).then(|| self.pressure_drop / self.flux)
    }
}

/// Returns the flow through each branch of a channel between the vertical lines at two places x (length), from the
/// lowest branch to the highest.
///
/// Rigid walls, obstacles and elastic solids divide the lines into openings, and the k-th opening of the first line
/// belongs to the k-th opening of the second one. Choose both lines where the same islands divide the channel. Droplets
/// count as fluid. The pressure includes the mean pressure gradient along the channel.
///
/// # Errors
/// Returns an error for a fluid without walls, for lines with different numbers of openings, and the errors of an
/// evaluation and of sampling.
pub fn branch_flows<H: Hydrodynamics>(system: &mut System<H>, places: [f64; 2]) -> Result<Vec<BranchFlow>, SceneError> {
    let [first, second] = places.map(|x| openings(system, x));
    let [first, second] = [first?, second?];
    if first.len() != second.len() {
        let time = system.time();
        let (what, remedy) = (
            format!("the flow through branches of which {} start and {} end", first.len(), second.len()),
            "Put both cross-sections where the same islands divide the channel",
        );
        return Err(SceneError::Flow { time, source: FlowError::unsupported(&what, remedy) });
    }
    let gradient = system.report().mean_pressure_gradient[0];
    let pairs = first.into_iter().zip(second);
    pairs
        .map(|(from, to)| {
            let [start, end] = [(places[0], from), (places[1], to)].map(|(x, opening)| through(system, x, opening));
            let [start, end] = [start?, end?];
            Ok(BranchFlow {
                openings: [from, to],
                flux: 0.5 * (start[0] + end[0]),
                pressure_drop: start[1] / (from[1] - from[0])
                    - end[1] / (to[1] - to[0])
                    - gradient * (places[1] - places[0]),
            })
        })
        .collect()
}

/// Returns the integrals over an opening at `x` of the velocity along the channel and of the periodic part of the
/// pressure.
fn through<H: Hydrodynamics>(system: &mut System<H>, x: f64, opening: [f64; 2]) -> Result<[f64; 2], SceneError> {
    let view = system.hydrodynamics().fluid_view();
    let line = Line::new(&view, &opening, &kinks(system, &view, x)?);
    let [sums] = line.integrals_of(system, x, |sample: &FlowSample| Vec2::new(sample.velocity.x, sample.pressure))?;
    Ok([sums.x, sums.y])
}

/// Returns the heights between which the vertical line at `x` lies in fluid, from the lowest to the highest.
fn openings<H: Hydrodynamics>(system: &mut System<H>, x: f64) -> Result<Vec<[f64; 2]>, SceneError> {
    let (view, time) = (system.hydrodynamics().fluid_view(), system.time());
    let [bottom, top] = walls(&view, time)?;
    let periods = view.domain.periods;
    system.evaluate()?;
    let mut crossed = Vec::new();
    if let Some(boundary) = system.hydrodynamics().walls() {
        crossed.extend(boundary.sides().iter().filter_map(|&[a, b]| crossing(a, b, x, periods)));
    }
    let markers = system.markers();
    for group in markers.groups().iter().filter(|group| group.kind == MarkerKind::Points) {
        let positions = &markers.positions()[group.range.clone()];
        for curve in &group.surfaces {
            let places = curve.points.iter().map(|&(point, _)| match point {
                SurfacePoint::Marker(marker) => positions[marker],
                SurfacePoint::Fixed(place) => place,
            });
            let places: Vec<Vec2> = places.collect();
            let next = places.iter().cycle().skip(1);
            crossed.extend(
                places.iter().zip(next).filter_map(|(&a, &b)| crossing(a, a + periods.wrap(b - a), x, periods)),
            );
        }
    }
    crossed.sort_by(|a, b| a.0.total_cmp(&b.0));
    // The number of solids around a point of the line; where it starts is known from what the line leaves.
    let depths = crossed.iter().scan(0, |depth, &(_, step)| {
        *depth += step;
        Some(*depth)
    });
    let mut depth = -depths.fold(0, i32::min);
    let (mut open, mut from) = (Vec::new(), bottom);
    for (height, step) in crossed.into_iter().chain([(top, 1)]) {
        let height = height.clamp(bottom, top);
        if depth == 0 && height - from > AT_END * (top - bottom) {
            open.push([from, height]);
        }
        depth += step;
        from = height;
    }
    Ok(open)
}

/// Returns the height at which a side crosses the vertical line at `x`, and 1 if the body on its left begins there, -1
/// if it ends there, on the way up.
fn crossing(a: Vec2, b: Vec2, x: f64, periods: Periods) -> Option<(f64, i32)> {
    let (from, along) = (periods.wrap(Vec2::new(a.x - x, 0.0)).x, b - a);
    let crosses = (from < 0.0) != (from + along.x < 0.0);
    crosses.then(|| (a.y - along.y * from / along.x, if along.x > 0.0 { 1 } else { -1 }))
}

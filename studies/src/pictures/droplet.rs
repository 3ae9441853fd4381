//! The model: a steady swimmer with its particles, forces and flow.

use anyhow::{Context, Result};
use motile::base::Vec2;
use motile::prelude::*;
use motile_output::{Raster, Samples, streamlines};
use motile_steady_states::SteadyState;

use super::svg::{BLUE, Drawing, GREEN, GREY, INK, RED};

/// Half the side of the square that is seen (R0).
const HALF: f64 = 2.1;
const CELLS: usize = 84;
const LINES_APART: f64 = 0.42;
/// Which of the points of a streamline are drawn.
const POINT_OF_LINE: usize = 2;
/// Length of the arrow of the largest force (R0).
const LONGEST: f64 = 0.55;

/// The steady swimmer of activity -2 in unbounded fluid: streamlines at rest far away, concentration as the width of
/// the interface, forces on the fluid.
pub(super) fn picture() -> Result<String> {
    let method = Method::Integral(IntegralMethod { nodes: 72, elements: 288 });
    let setup = Setup { method, region: Region::Plane, ..Setup::default() };
    let state = SteadyState::find(&setup)?;
    let centre = state.measured()?.centroid;
    let heading = state.velocity().try_normalize().context("it does not swim")?;
    let raster = Raster::new((centre - Vec2::splat(HALF)).into(), [2.0 * HALF; 2], [CELLS; 2], [false; 2])?;
    let velocities = state.sample(&raster.points())?.into_iter().map(|sample| sample.velocity).collect();
    let mut drawing = Drawing::new(Vec2::splat(-HALF), Vec2::splat(2.0 * HALF), 130.0);
    for line in streamlines(&Samples::new(raster, velocities)?, LINES_APART, centre)? {
        let last = line.last().copied();
        let points: Vec<Vec2> = line.iter().copied().step_by(POINT_OF_LINE).chain(last).map(|x| x - centre).collect();
        drawing.line(&points, GREY, 0.9, false);
        if let [.., a, b] = points[..points.len() / 2 + 1] {
            drawing.arrow(a, b - a, GREY, 0.9);
        }
    }
    let profile = state.profile();
    let places: Vec<Vec2> = profile.positions.iter().map(|x| *x - centre).collect();
    let (_, concentration) = profile.concentrations()?;
    let largest = concentration.iter().copied().fold(0.0, f64::max);
    let n = places.len();
    for k in 0..n {
        let share = concentration[k * concentration.len() / n] / largest;
        drawing.line(&[places[k], places[(k + 1) % n]], RED, 1.5 + 7.0 * share, false);
    }
    // F = d(gamma tau)/ds by differences over the nodes; the uniform part only makes a pressure.
    let law = setup.droplets[0].particles.context("particles")?.law(setup.droplets[0].tension)?;
    let gamma = |k: usize| {
        use motile::active_interface::Tension;
        law.value(concentration[(k % n) * concentration.len() / n])
    };
    let mean = (0..n).map(gamma).sum::<f64>() / n as f64;
    let pull = |k: usize| (places[(k + 1) % n] - places[k % n]).normalize() * (gamma(k) - mean);
    let forces: Vec<Vec2> = (0..n).map(|k| pull(k) - pull(k + n - 1)).collect();
    let strongest = forces.iter().map(|f| f.length()).fold(0.0, f64::max);
    for (place, force) in places.iter().zip(&forces).step_by(3) {
        drawing.arrow(*place, *force * (LONGEST / strongest), BLUE, 1.4);
    }
    // Marangoni flow along the flanks, in the frame of the droplet.
    let velocity = state.velocity();
    for side in [1.0, -1.0] {
        let at = side * heading.perp();
        let nearest = places.iter().min_by(|a, b| (**a - at).length().total_cmp(&(**b - at).length()));
        let place = nearest.copied().context("markers")?;
        let flow = state.sample(&[place * 0.999 + centre])?[0].velocity - velocity;
        drawing.arrow(place * 1.09, flow.normalize() * 0.6, GREEN, 3.0);
    }
    drawing.arrow(Vec2::ZERO, heading * 0.6, INK, 3.0);
    drawing.line(&[Vec2::ZERO, Vec2::from_angle(0.9) * 0.97], INK, 0.9, true);
    drawing.line(&[Vec2::ZERO, Vec2::new(0.97, 0.0)], INK, 0.9, true);
    let arc: Vec<Vec2> = (0..10).map(|k| 0.28 * Vec2::from_angle(0.1 * f64::from(k))).collect();
    drawing.line(&arc, INK, 0.9, false);
    let (at, outward) = (Vec2::from_angle(0.9), Vec2::from_angle(0.9));
    drawing.arrow(at, outward * 0.5, INK, 1.6);
    drawing.arrow(at, outward.perp() * 0.5, INK, 1.6);
    for (place, text, colour) in [
        (at + outward * 0.62, "n", INK),
        (at + outward.perp() * 0.62, "τ", INK),
        (Vec2::new(0.36, 0.16), "θ", INK),
        (Vec2::new(0.45, -0.16), "v", INK),
        (Vec2::new(-1.56, 0.14), "particles c:", RED),
        (Vec2::new(-1.56, -0.12), "γ(c) is high", RED),
        (Vec2::new(0.0, 1.5), "Marangoni flow, to higher tension", GREEN),
        (Vec2::new(-1.05, -1.25), "F = d(γτ)/ds", BLUE),
        (Vec2::new(0.1, -0.45), "η_in", INK),
        (Vec2::new(1.7, -1.8), "η_ext", INK),
    ] {
        drawing.text(place, text, colour, 15.0);
    }
    Ok(drawing.finish())
}

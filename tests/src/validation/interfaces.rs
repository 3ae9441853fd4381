//! The relaxation of an ellipse, with the droplet that swimmers are made of.

use std::f64::consts::PI;

use motile::active_interface::{ActiveDroplet, Curve};
use motile::base::{Region, Vec2};
use motile::boundary_integrals::{BoundaryIntegral, PeriodicCalculus, Settings};
use motile::scene::{Scene, StepSize};

use crate::validation::{Reference, StudyError};

/// Errors of one run at t = 2.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct IntegralRelaxation {
    /// Aspect ratio from the area moments.
    pub aspect_ratio: f64,
    /// Position of the tip (length).
    pub tip: f64,
    /// Relative change of the area.
    pub area_change: f64,
}

/// Relaxes the ellipse (1.3 cos t, sin t / 1.3), tension 1, viscosity 1 outside and `ratio` (1 or 10) inside, in a 6 x
/// 6 box to t = 2, with `nodes` nodes, `markers` markers and steps `dt`.
///
/// # Errors
/// A ratio that is not in the table; what a run can fail with.
pub fn relax(ratio: u32, nodes: usize, markers: usize, dt: f64) -> Result<IntegralRelaxation, StudyError> {
    let reference = Reference::read("ellipse_relaxation_box6")?.select("eta_in", &ratio.to_string());
    let reference = reference.select("t", "2");
    let settings = Settings { nodes, tolerance: 1e-10, ..Settings::default() };
    let mut scene = Scene::new(BoundaryIntegral::new(Region::Box { lengths: [6.0, 6.0] }, 1.0, settings)?);
    let mut start = Curve::ellipse(1.3, 1.0 / 1.3)?.markers(markers)?;
    // A curve's markers are those of a polygon with its area, outside the curve by a common factor.
    let factor = start[0].x / 1.3;
    start.iter_mut().for_each(|marker| *marker /= factor);
    let droplet = ActiveDroplet::passive(&start, 1.0)?.with_viscosity_inside(f64::from(ratio))?;
    let droplet = scene.add(droplet);
    let area = moments(scene.body(droplet)?.markers())?[0];
    scene.run(2.0).step_size(StepSize::Fixed(dt)).go()?;
    let end = scene.body(droplet)?.markers();
    let [last, xx, yy] = moments(end)?;
    Ok(IntegralRelaxation {
        aspect_ratio: (xx / yy).sqrt() - reference.value("AR_moment")?,
        tip: end[0].x - reference.value("x_tip")?,
        area_change: last / area - 1.0,
    })
}

/// Area and second moments along x and y of the smooth curve through the markers, about the origin.
fn moments(markers: &[Vec2]) -> Result<[f64; 3], StudyError> {
    let mut slopes = vec![Vec2::ZERO; markers.len()];
    PeriodicCalculus::new(markers.len())?.derivative(markers, &mut slopes)?;
    let weight = 2.0 * PI / markers.len() as f64;
    let mut sums = [0.0; 3];
    for (x, t) in markers.iter().zip(&slopes) {
        sums[0] += weight * x.x * t.y;
        sums[1] += weight * x.x.powi(3) * t.y / 3.0;
        sums[2] -= weight * x.y.powi(3) * t.x / 3.0;
    }
    Ok(sums)
}

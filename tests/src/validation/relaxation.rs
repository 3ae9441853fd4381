//! The relaxation of an ellipse under tension, against boundary-integral values.

use motile::active_interface::{ActiveDroplet, Curve, polygon_moments};
use motile::ib_core::{BSpline, ImmersedBoundary};
use motile::scene::{Scene, StepSize};
use motile::stokes_grid::{Grid, PeriodicStokes};

use crate::validation::{Reference, StudyError};

/// Result of one run.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Relaxation {
    /// Error of the aspect ratio (from the area moments) at t = 2.
    pub aspect_ratio_error: f64,
    /// Relative change of the area.
    pub area_change: f64,
    /// Steps taken.
    pub steps: usize,
}

/// Relaxes the ellipse (1.3 cos t, sin t / 1.3), gamma = eta = 1, in a 6 x 6 box to t = 2.
///
/// # Errors
/// Those of a run.
pub fn run(h: f64, dt: f64) -> Result<Relaxation, StudyError> {
    let all = Reference::read("ellipse_relaxation_box6")?;
    let reference = all.select("eta_in", "1").select("t", "2");
    let expected = reference.value("AR_moment")?;
    let cells = (6.0 / h).round() as usize;
    let solver = PeriodicStokes::new(Grid::periodic(cells, cells, h)?, 1.0)?;
    let mut scene = Scene::new(ImmersedBoundary::new(solver, BSpline::<4>));
    let curve = Curve::ellipse(1.3, 1.0 / 1.3)?;
    let count = 2 * (curve.perimeter() / h).round() as usize;
    let droplet = scene.add(ActiveDroplet::passive(&curve.markers(count)?, 1.0)?);
    scene.run(2.0).step_size(StepSize::Fixed(dt)).go()?;
    let moments = polygon_moments(scene.body(droplet)?.markers())?;
    Ok(Relaxation {
        aspect_ratio_error: (moments.xx / moments.yy).sqrt() - expected,
        area_change: moments.area / scene.body(droplet)?.initial_area() - 1.0,
        steps: scene.steps(),
    })
}

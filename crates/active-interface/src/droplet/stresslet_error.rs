//! Error of the stresslet on a grid.

use std::f64::consts::TAU;

use motile_base::Vec2;
use motile_scene::FluidView;

use crate::ActiveDroplet;
use crate::curve::polygon::edges;
use crate::interface::grid_spacing;

/// Errors over gamma R, gamma the mean tension and R the radius, measured (`tests/physics/stresslets.rs`): of first
/// order in h/R with uncorrected velocities. With the correction of second order: in units of the squared number
/// `R max|V_t - W|/D` by which the concentration is carried against its diffusion, which sets how steep it is, more so
/// where a gap to an image is narrow, by R over half of it; beside walls in units of (R/gap)^3. Up to a largest value.
const UNCORRECTED: f64 = 1.7;
const STEEP: f64 = 0.007;
const BESIDE_IMAGES: f64 = 0.3;
const BESIDE_WALLS: f64 = 0.07;
const CORRECTED_MOST: f64 = 2.5;
/// Part of the stresslet that its error may be without a warning.
const TOLERATED: f64 = 0.01;
/// Stresslet over gamma R below which errors are compared with this instead: a stresslet that changes its sign has no
/// relative error then.
const SMALLEST: f64 = 0.05;

/// Stresslet of the tensions, and the error to be expected of it (both force times length).
#[derive(Debug, Clone, Copy)]
pub(super) struct StressletError {
    /// Magnitude `(S_xx^2 + S_xy^2)^(1/2)`.
    pub(super) magnitude: f64,
    /// Error of that.
    pub(super) error: f64,
    /// Error over the one that is tolerated.
    pub(super) excess: f64,
}

impl ActiveDroplet {
    /// Error of the stresslet on the grid of `view`; `None` without a grid, and for droplets without particles, whose
    /// shape and forces relax to none.
    ///
    /// The stresslet `-integral gamma (tt - 1/2) ds` is what remains of a mean tension that is an order of magnitude
    /// larger: its error is that of the shape times the mean tension, and speeds do not show it.
    pub(super) fn stresslet_error(&self, view: &FluidView) -> Option<StressletError> {
        let spacing = grid_spacing(view).filter(|_| self.interface.carries())?;
        let (tensions, lengths) = (self.tensions(), self.element_lengths());
        let perimeter = self.interface.geometry().perimeter;
        let radius = perimeter / TAU;
        let (mut mean, mut dipole) = (0.0, Vec2::ZERO);
        for (((a, b), tension), length) in edges(self.markers()).zip(tensions).zip(lengths) {
            let d = b - a;
            mean += tension * length / perimeter;
            dipole -= tension / length * Vec2::new(0.5 * (d.x * d.x - d.y * d.y), d.x * d.y);
        }
        let unit = mean * radius;
        let cells = spacing / radius;
        let part = if view.second_order {
            let markers = || self.markers().iter();
            let gap = view.domain.walls.map_or(f64::INFINITY, |[bottom, top]| {
                markers().fold(f64::INFINITY, |gap, x| gap.min(x.y - bottom).min(top - x.y))
            });
            let [wide, high] = [|x: &Vec2| x.x, |x: &Vec2| x.y].map(|along| {
                let extent = |way: f64| markers().map(|x| way * along(x)).fold(f64::NEG_INFINITY, f64::max);
                extent(1.0) + extent(-1.0)
            });
            let [x, y] = view.domain.periods.lengths;
            let to_image =
                |period: Option<f64>, extent: f64| period.map_or(f64::INFINITY, |period| 0.5 * (period - extent));
            let half = to_image(x, wide).min(to_image(y, high)).max(0.5 * spacing);
            let steepness = self.element_peclet() * lengths.len() as f64 / TAU;
            let open = STEEP * steepness * steepness * (1.0 + BESIDE_IMAGES * (radius / half).powf(1.5));
            let walls = BESIDE_WALLS * (radius / gap.max(spacing)).powi(3);
            (open + walls).min(CORRECTED_MOST) * cells * cells
        } else {
            UNCORRECTED * cells
        };
        let (magnitude, error) = (dipole.length(), part * unit);
        let tolerated = TOLERATED * magnitude.max(SMALLEST * unit);
        Some(StressletError { magnitude, error, excess: error / tolerated })
    }
}

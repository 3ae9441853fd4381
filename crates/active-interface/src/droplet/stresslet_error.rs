//! Error of the stresslet, on a grid and by boundary integrals.

use std::f64::consts::TAU;

use motile_base::Vec2;
use motile_scene::FluidView;
use num_complex::Complex64;

use crate::ActiveDroplet;
use crate::curve::polygon::edges;
use crate::interface::grid_spacing;

/// Errors over gamma R, gamma the mean tension and R the radius, measured (`tests/physics/stresslets.rs`): of first
/// order in h/R with uncorrected velocities. With the correction of second order: in units of the squared number `R
/// max|V_t - W|/D` by which the concentration is carried against its diffusion, which sets how steep it is. The number
/// is larger if a gap to an image is narrow, by R over half of it; next to walls in units of (R/gap)^3. Up to a largest
/// value.
const UNCORRECTED: f64 = 1.7;
const STEEP: f64 = 0.007;
const BESIDE_IMAGES: f64 = 0.3;
const BESIDE_WALLS: f64 = 0.07;
const CORRECTED_MOST: f64 = 2.5;
/// By boundary integrals: in units of the waves of the tension that the nodes cut off, over the mean tension and the
/// number of nodes, and of the number of [`STEEP`] over the square of the elements.
const OF_NODES: f64 = 4.0;
const OF_ELEMENTS: f64 = 1.5;
/// Waves of the tension that are looked at, from the shortest that nodes carry on.
const WAVES: usize = 8;
/// By layers next to solids: in units of the number of [`STEEP`] squared and of (h/R)^1.5, the order that was found
/// with gaps of 0.16 R to elastic walls.
const OF_SOLIDS: f64 = 0.004;
/// Fraction of the stresslet that its error may be without a warning.
const TOLERATED: f64 = 0.01;
/// Stresslet over gamma R below which errors are compared with this instead, on grids and without: a stresslet that
/// changes its sign has no relative error then. Without a grid, the reported error is up to five times too large in
/// wide regions.
const SMALLEST: [f64; 2] = [0.05, 0.1];

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
    /// Returns the error of the stresslet in the flow of `view`; `None` in three dimensions, and for droplets without
    /// particles, whose shape and forces relax to none.
    ///
    /// The stresslet `-integral gamma (tt - 1/2) ds` is what remains of a mean tension that is an order of magnitude
    /// larger: its error is the error of the shape times the mean tension, and speeds do not show it.
    pub(super) fn stresslet_error(&self, view: &FluidView) -> Option<StressletError> {
        if !self.interface.carries() || self.interface.is_axisymmetric() {
            return None;
        }
        let (tensions, lengths) = (self.tensions(), self.element_lengths());
        let perimeter = self.interface.geometry().perimeter;
        let radius = perimeter / TAU;
        let (mut mean, mut dipole) = (0.0, Vec2::ZERO);
        for (((a, b), tension), length) in edges(self.markers()).zip(tensions).zip(lengths) {
            let d = b - a;
            mean += tension.abs() * length / perimeter;
            dipole -= tension / length * Vec2::new(0.5 * (d.x * d.x - d.y * d.y), d.x * d.y);
        }
        let unit = mean * radius;
        let steepness = self.element_peclet() * lengths.len() as f64 / TAU;
        let part = match (grid_spacing(view), view.shape_modes) {
            (Some(spacing), _) => self.part_on_grid(view, spacing, radius, steepness),
            (None, Some(nodes)) => {
                let elements = lengths.len() as f64;
                let beside_solids = view.spacing.map_or(0.0, |spacing| OF_SOLIDS * (spacing / radius).powf(1.5));
                let of_shape = OF_NODES * cut_off(self.tensions(), nodes) / nodes as f64;
                let of_concentration = OF_ELEMENTS * steepness / (elements * elements);
                of_shape / mean + of_concentration + steepness * steepness * beside_solids
            }
            (None, None) => return None,
        };
        let (magnitude, error) = (dipole.length(), part * unit);
        let smallest = SMALLEST[usize::from(view.shape_modes.is_some())];
        let tolerated = TOLERATED * magnitude.max(smallest * unit);
        Some(StressletError { magnitude, error, excess: error / tolerated })
    }

    /// Returns the error over gamma R on a grid of that spacing.
    fn part_on_grid(&self, view: &FluidView, spacing: f64, radius: f64, steepness: f64) -> f64 {
        let cells = spacing / radius;
        if view.second_order {
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
            let open = STEEP * steepness * steepness * (1.0 + BESIDE_IMAGES * (radius / half).powf(1.5));
            let walls = BESIDE_WALLS * (radius / gap.max(spacing)).powi(3);
            (open + walls).min(CORRECTED_MOST) * cells * cells
        } else {
            UNCORRECTED * cells
        }
    }
}

/// Returns the root mean square of the amplitudes of the waves of values along an interface that so many nodes do not
/// carry.
fn cut_off(values: &[f64], nodes: usize) -> f64 {
    let count = values.len();
    let first = (nodes / 2).min(count / 2);
    let waves = first..(first + WAVES).min(count / 2 + 1);
    let square = |wave: usize| {
        let turn = Complex64::cis(TAU * wave as f64 / count as f64);
        let start = (Complex64::ZERO, Complex64::ONE);
        let (sum, _) = values.iter().fold(start, |(sum, at), &value| (sum + at * value, at * turn));
        (2.0 / count as f64).powi(2) * sum.norm_sqr()
    };
    let number = waves.len() as f64;
    (waves.map(square).sum::<f64>() / number).sqrt()
}

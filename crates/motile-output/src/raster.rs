//! Fields sampled at the centres of the cells of a rectangle.

use std::ops::{Add, Mul};

use motile::scene::{Hydrodynamics, System};

use crate::OutputError;
use motile::base::Vec2;

/// Largest number of cells in a direction.
const MOST_CELLS: usize = 4096;
/// Object of a spacing, for errors.
const CELLS_OF_A_WIDTH: &str = "a raster of cells of a width";
/// Largest number of cells in a direction of a raster that is made to fit a scene.
const MOST_OF_SCENE: f64 = 512.0;

/// Rectangle cut into `nx` x `ny` cells, at whose centres fields are sampled.
///
/// Entry (i, j) is number `j * nx + i` and lies at `origin + ((i + 1/2) dx, (j + 1/2) dy)`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Raster {
    pub(crate) origin: [f64; 2],
    pub(crate) size: [f64; 2],
    pub(crate) cells: [usize; 2],
    pub(crate) periodic: [bool; 2],
    /// Displacement along x of images above (length), where a shear moves them: fields are then not periodic in y.
    pub(crate) tilt: Option<f64>,
}

impl Raster {
    /// Creates a raster of `cells` = `[nx, ny]` cells over the rectangle of a lower left corner and a size (length),
    /// periodic in the directions marked.
    ///
    /// # Errors
    /// Returns [`OutputError::Size`] with no cells or more than 4096 in a direction, [`OutputError::Rectangle`] with
    /// one that is empty or not finite.
    pub fn new(origin: [f64; 2], size: [f64; 2], cells: [usize; 2], periodic: [bool; 2]) -> Result<Self, OutputError> {
        for count in cells {
            OutputError::check_size("a raster with a side (cells)", count as f64, 1.0, MOST_CELLS as f64)?;
        }
        let finite = origin.iter().all(|v| v.is_finite()) && size.iter().all(|v| v.is_finite() && *v > 0.0);
        if finite {
            Ok(Self { origin, size, cells, periodic, tilt: None })
        } else {
            Err(OutputError::Rectangle { corner: origin, size })
        }
    }

    /// Creates a raster over a scene that is bounded by walls or periodic, with cells of width `spacing` (length), or
    /// wider so that there are at most 512 in a direction.
    ///
    /// # Errors
    /// Returns [`OutputError::Unbounded`]; [`OutputError::Size`] with a spacing that is not positive.
    pub fn of<H: Hydrodynamics>(system: &System<H>, spacing: f64) -> Result<Self, OutputError> {
        OutputError::check_size(CELLS_OF_A_WIDTH, spacing, f64::MIN_POSITIVE, f64::INFINITY)?;
        let domain = system.hydrodynamics().fluid_view().domain;
        let [x, y] = domain.origin;
        let walls = domain.walls.map(|[below, above]| above - below);
        let (Some(width), Some(height)) = (domain.periods[0], domain.periods[1].or(walls)) else {
            return Err(OutputError::Unbounded);
        };
        let origin = [x, domain.walls.map_or(y, |[below, _]| below)];
        let coarsening = (width.max(height) / spacing / MOST_OF_SCENE).max(1.0);
        let cells = [width, height].map(|side| ((side / (spacing * coarsening)).round() as usize).max(1));
        let tilt = tilt(system);
        let periodic = [domain.periods[0].is_some(), domain.periods[1].is_some() && tilt.is_none()];
        Ok(Self { tilt, ..Self::new(origin, [width, height], cells, periodic)? })
    }

    /// These cells for the present state of a system: a shear displaces images during a run.
    pub(crate) fn in_state_of<H: Hydrodynamics>(self, system: &System<H>) -> Self {
        if self.tilt.is_none() && !self.periodic[1] {
            return self;
        }
        let tilt = tilt(system);
        Self { tilt, periodic: [self.periodic[0], tilt.is_none()], ..self }
    }

    /// Creates a raster over all bodies of a scene and a margin around them (length), with cells as [`Raster::of`] has:
    /// for unbounded fluid.
    ///
    /// # Errors
    /// Returns [`OutputError::Empty`] for a scene without bodies; [`OutputError::Size`] with a spacing that is not
    /// positive; [`OutputError::Rectangle`] with a margin that is not finite.
    pub fn around<H: Hydrodynamics>(system: &System<H>, margin: f64, spacing: f64) -> Result<Self, OutputError> {
        OutputError::check_size(CELLS_OF_A_WIDTH, spacing, f64::MIN_POSITIVE, f64::INFINITY)?;
        let markers = system.markers().positions();
        let first = *markers.first().ok_or(OutputError::Empty("a raster around a scene without bodies"))?;
        let [low, high] = markers.iter().fold([first; 2], |[low, high], place| [low.min(*place), high.max(*place)]);
        let size = (high - low + Vec2::splat(2.0 * margin)).to_array();
        let coarsening = (size[0].max(size[1]) / spacing / MOST_OF_SCENE).max(1.0);
        let cells = size.map(|side| ((side / (spacing * coarsening)).round() as usize).max(1));
        Self::new((low - Vec2::splat(margin)).to_array(), size, cells, [false; 2])
    }

    /// Returns the raster over the same rectangle with at most `most` cells in a direction.
    pub(crate) fn coarsened(self, most: usize) -> Self {
        let longest = self.cells[0].max(self.cells[1]);
        Self { cells: self.cells.map(|n| (n * most.min(longest) / longest).max(1)), ..self }
    }

    /// Returns the numbers of cells in x and y.
    #[must_use]
    pub fn cells(&self) -> [usize; 2] {
        self.cells
    }

    /// Returns the lower left corner (length).
    #[must_use]
    pub fn origin(&self) -> [f64; 2] {
        self.origin
    }

    /// Returns whether fields repeat in x and in y.
    #[must_use]
    pub fn periodic(&self) -> [bool; 2] {
        self.periodic
    }

    /// Returns the sides along x and y (length).
    #[must_use]
    pub fn size(&self) -> [f64; 2] {
        self.size
    }

    /// Returns the sample points (length), in the order of the samples.
    #[must_use]
    pub fn points(&self) -> Vec<Vec2> {
        let at =
            |k: usize, axis: usize| self.origin[axis] + (k as f64 + 0.5) * self.size[axis] / self.cells[axis] as f64;
        let row = |j: usize| (0..self.cells[0]).map(move |i| Vec2::new(at(i, 0), at(j, 1)));
        (0..self.cells[1]).flat_map(row).collect()
    }

    /// Returns true if fields are known: within the rectangle, in periodic directions everywhere.
    #[must_use]
    pub fn covers(&self, point: Vec2) -> bool {
        (0..2).all(|k| {
            let t = (point[k] - self.origin[k]) / self.size[k];
            t.is_finite() && (self.periodic[k] || (0.0..=1.0).contains(&t))
        })
    }

    /// Returns the entries of bilinear interpolation along an axis: the two neighbours, and the weight of the second.
    fn neighbours(&self, coordinate: f64, axis: usize) -> (usize, usize, f64) {
        let n = self.cells[axis];
        let t = (coordinate - self.origin[axis]) / self.size[axis] * n as f64 - 0.5;
        let t = if self.periodic[axis] { t.rem_euclid(n as f64) } else { t.clamp(0.0, (n - 1) as f64) };
        let first = (t as usize).min(n - 1);
        let second = if self.periodic[axis] { (first + 1) % n } else { (first + 1).min(n - 1) };
        (first, second, t - first as f64)
    }
}

/// Returns the displacement along x of images above (length), where a shear moves them.
fn tilt<H: Hydrodynamics>(system: &System<H>) -> Option<f64> {
    let hydrodynamics = system.hydrodynamics();
    let moves = !hydrodynamics.imposed().is_none() || hydrodynamics.strain() != 0.0;
    let periods = hydrodynamics.fluid_view().domain.periods;
    periods[1].filter(|_| moves).map(|_| periods.tilt)
}

/// Scalar (`f64`) or vector ([`Vec2`]) field sampled on a raster.
#[derive(Debug, Clone, PartialEq)]
pub struct Samples<T> {
    pub(crate) raster: Raster,
    pub(crate) values: Vec<T>,
}

impl<T: Copy + Mul<f64, Output = T> + Add<Output = T>> Samples<T> {
    /// Creates a field from samples in the order of [`Raster::points`].
    ///
    /// # Errors
    /// Returns [`OutputError::Count`] if there is not one value for each point.
    pub fn new(raster: Raster, values: Vec<T>) -> Result<Self, OutputError> {
        OutputError::check_count("samples on a raster", values.len(), raster.cells[0] * raster.cells[1])?;
        Ok(Self { raster, values })
    }

    /// Returns the value at a point (length) by bilinear interpolation; beyond a border that is not periodic, at the
    /// nearest point.
    #[must_use]
    pub fn at(&self, point: Vec2) -> T {
        let (i0, i1, s) = self.raster.neighbours(point.x, 0);
        let (j0, j1, t) = self.raster.neighbours(point.y, 1);
        let row = |j: usize| {
            let value = |i: usize| self.values[j * self.raster.cells[0] + i];
            value(i0) * (1.0 - s) + value(i1) * s
        };
        row(j0) * (1.0 - t) + row(j1) * t
    }
}

#[cfg(test)]
mod tests;

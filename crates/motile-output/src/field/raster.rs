//! Sampled fields: values at the centres of the cells of a rectangle.

use anyhow::{Result, ensure};

use crate::Vec2;

/// A rectangle cut into `nx` x `ny` cells, at whose centres fields are sampled: the pressure points of a grid, or any
/// other set of sample points for a flow known everywhere.
///
/// Entry (i, j) is number `j * nx + i` and lies at `origin + ((i + 1/2) dx, (j + 1/2) dy)`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Raster {
    origin: [f64; 2],
    size: [f64; 2],
    cells: [usize; 2],
    periodic: [bool; 2],
}

impl Raster {
    /// A raster of `cells` = `[nx, ny]` cells over the rectangle of the given lower left corner and size (length),
    /// periodic in the directions marked.
    ///
    /// # Errors
    /// No cells, more than 4096 in a direction, or a rectangle that is empty or not finite.
    pub fn new(origin: [f64; 2], size: [f64; 2], cells: [usize; 2], periodic: [bool; 2]) -> Result<Self> {
        ensure!(
            cells.iter().all(|n| (1..=4096).contains(n)),
            "a raster of {} x {} cells cannot be drawn: 1 to 4096 in each direction",
            cells[0],
            cells[1]
        );
        let finite = origin.iter().all(|v| v.is_finite()) && size.iter().all(|v| v.is_finite() && *v > 0.0);
        ensure!(finite, "a raster of size {size:?} at {origin:?} is empty or not finite");
        Ok(Self { origin, size, cells, periodic })
    }

    /// Lower left corner (length).
    #[must_use]
    pub fn origin(&self) -> [f64; 2] {
        self.origin
    }

    /// Width and height (length).
    #[must_use]
    pub fn size(&self) -> [f64; 2] {
        self.size
    }

    /// Cells in x and y.
    #[must_use]
    pub fn cells(&self) -> [usize; 2] {
        self.cells
    }

    /// Whether the fields repeat beyond the rectangle in x and in y.
    #[must_use]
    pub fn periodic(&self) -> [bool; 2] {
        self.periodic
    }

    /// Number of samples.
    #[must_use]
    pub fn len(&self) -> usize {
        self.cells[0] * self.cells[1]
    }

    /// Never: a raster has at least one cell.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        false
    }

    /// The sample points (length), in the order of the samples.
    #[must_use]
    pub fn points(&self) -> Vec<Vec2> {
        let at =
            |k: usize, axis: usize| self.origin[axis] + (k as f64 + 0.5) * self.size[axis] / self.cells[axis] as f64;
        let row = |j: usize| (0..self.cells[0]).map(move |i| Vec2::new(at(i, 0), at(j, 1)));
        (0..self.cells[1]).flat_map(row).collect()
    }

    /// Whether fields are known at `point` (length).
    #[must_use]
    pub fn covers(&self, point: Vec2) -> bool {
        (0..2).all(|k| {
            let t = (point[k] - self.origin[k]) / self.size[k];
            t.is_finite() && (self.periodic[k] || (0.0..=1.0).contains(&t))
        })
    }

    /// Where bilinear interpolation finds its values along an axis: the two entries, and the weight of the second.
    fn neighbours(&self, coordinate: f64, axis: usize) -> (usize, usize, f64) {
        let n = self.cells[axis];
        let t = (coordinate - self.origin[axis]) / self.size[axis] * n as f64 - 0.5;
        if self.periodic[axis] {
            let t = t.rem_euclid(n as f64);
            let first = (t as usize).min(n - 1);
            (first, if first + 1 == n { 0 } else { first + 1 }, t - first as f64)
        } else {
            let t = t.clamp(0.0, (n - 1) as f64);
            let first = (t as usize).min(n - 1);
            (first, (first + 1).min(n - 1), t - first as f64)
        }
    }

    /// The four entries around `point` and their bilinear weights; beyond a border that is not periodic, those of the
    /// nearest point.
    fn corners(&self, point: Vec2) -> [(usize, f64); 4] {
        let (i0, i1, s) = self.neighbours(point.x, 0);
        let (j0, j1, t) = self.neighbours(point.y, 1);
        let nx = self.cells[0];
        [
            (j0 * nx + i0, (1.0 - s) * (1.0 - t)),
            (j0 * nx + i1, s * (1.0 - t)),
            (j1 * nx + i0, (1.0 - s) * t),
            (j1 * nx + i1, s * t),
        ]
    }
}

/// A scalar sampled on a raster.
#[derive(Debug, Clone, PartialEq)]
pub struct ScalarSamples {
    raster: Raster,
    values: Vec<f64>,
}

impl ScalarSamples {
    /// Samples in the order of [`Raster::points`].
    ///
    /// # Errors
    /// The wrong number of values.
    pub fn new(raster: Raster, values: Vec<f64>) -> Result<Self> {
        ensure!(values.len() == raster.len(), "{} values for a raster of {}", values.len(), raster.len());
        Ok(Self { raster, values })
    }

    /// The raster.
    #[must_use]
    pub fn raster(&self) -> &Raster {
        &self.raster
    }

    /// The values.
    #[must_use]
    pub fn values(&self) -> &[f64] {
        &self.values
    }

    /// The bilinear interpolant at `point` (length).
    #[must_use]
    pub fn at(&self, point: Vec2) -> f64 {
        self.raster.corners(point).iter().map(|&(k, w)| w * self.values[k]).sum()
    }
}

/// A vector field sampled on a raster.
#[derive(Debug, Clone, PartialEq)]
pub struct VectorSamples {
    raster: Raster,
    values: Vec<Vec2>,
}

impl VectorSamples {
    /// Samples in the order of [`Raster::points`].
    ///
    /// # Errors
    /// The wrong number of values.
    pub fn new(raster: Raster, values: Vec<Vec2>) -> Result<Self> {
        ensure!(values.len() == raster.len(), "{} vectors for a raster of {}", values.len(), raster.len());
        Ok(Self { raster, values })
    }

    /// From the components on the faces of the cells, as a staggered grid has them: `x` at the left and `y` at the
    /// lower faces, the means of opposite faces are the samples. In a direction that is not periodic the components
    /// normal to it have one more row (`y`) or column (`x`).
    ///
    /// # Errors
    /// The wrong number of values.
    pub fn from_faces(raster: Raster, x: &[f64], y: &[f64]) -> Result<Self> {
        let [nx, ny] = raster.cells;
        let columns = if raster.periodic[0] { nx } else { nx + 1 };
        let rows = if raster.periodic[1] { ny } else { ny + 1 };
        ensure!(x.len() == columns * ny, "{} x components where {} are expected", x.len(), columns * ny);
        ensure!(y.len() == nx * rows, "{} y components where {} are expected", y.len(), nx * rows);
        let centre = |j: usize, i: usize| {
            let right = if i + 1 == columns { 0 } else { i + 1 };
            let above = if j + 1 == rows { 0 } else { j + 1 };
            Vec2::new(0.5 * (x[j * columns + i] + x[j * columns + right]), 0.5 * (y[j * nx + i] + y[above * nx + i]))
        };
        let values = (0..ny).flat_map(|j| (0..nx).map(move |i| (j, i))).map(|(j, i)| centre(j, i)).collect();
        Ok(Self { raster, values })
    }

    /// The raster.
    #[must_use]
    pub fn raster(&self) -> &Raster {
        &self.raster
    }

    /// The vectors.
    #[must_use]
    pub fn values(&self) -> &[Vec2] {
        &self.values
    }

    /// The field as seen by an observer who moves at `velocity`.
    #[must_use]
    pub fn seen_from(&self, velocity: Vec2) -> Self {
        Self { raster: self.raster, values: self.values.iter().map(|v| v - velocity).collect() }
    }

    /// The magnitudes.
    #[must_use]
    pub fn magnitude(&self) -> ScalarSamples {
        ScalarSamples { raster: self.raster, values: self.values.iter().map(Vec2::norm).collect() }
    }

    /// The bilinear interpolant at `point` (length).
    #[must_use]
    pub fn at(&self, point: Vec2) -> Vec2 {
        self.raster.corners(point).iter().map(|&(k, w)| self.values[k] * w).sum()
    }
}

#[cfg(test)]
mod tests;

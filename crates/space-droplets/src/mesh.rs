//! Surfaces as triangles, for files and pictures.

use sphere_harmonics::{Grid, count};

use crate::surface::at;
use crate::{SpaceDroplet, SpaceError};

/// The surface of a droplet as triangles, with the fields on it at their corners.
#[derive(Debug, Clone, PartialEq)]
pub struct SurfaceMesh {
    /// Corners in the laboratory (length): a pole, the rows of the fine grid, the other pole.
    pub points: Vec<[f64; 3]>,
    /// Numbers of the corners of the triangles, counter-clockwise as seen from outside.
    pub triangles: Vec<[usize; 3]>,
    /// Concentrations (particles per area); zero without particles.
    pub concentrations: Vec<f64>,
    /// Tensions (force per length).
    pub tensions: Vec<f64>,
    /// Velocities of the fluid in the laboratory (length per time).
    pub velocities: Vec<[f64; 3]>,
}

impl SpaceDroplet {
    /// Returns the surface as triangles between the points of the grid on which products are formed, which has 2 p + 1
    /// rows of 4 p + 2 points for the degree p. Its fields belong to the state that was evaluated last.
    ///
    /// ```
    /// use space_droplets::{ConstantTension, SpaceDroplet};
    ///
    /// let mut drop = SpaceDroplet::sphere(8, 2.0, [1.0, 1.0], ConstantTension::new(1.0)?)?;
    /// drop.evaluate()?;
    /// let mesh = drop.mesh()?;
    /// assert_eq!((mesh.points.len(), mesh.triangles.len()), (17 * 34 + 2, 2 * 17 * 34));
    /// assert!(mesh.points.iter().all(|[x, y, z]| ((x * x + y * y + z * z).sqrt() - 2.0).abs() < 1e-12));
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    ///
    /// # Errors
    /// Returns an error if the surface has values that are not finite.
    pub fn mesh(&self) -> Result<SurfaceMesh, SpaceError> {
        let Self { surface, flow, .. } = self;
        let size = [surface.grid.rows(), surface.grid.columns()];
        self.mesh_of(size, |k| (at(&surface.positions, k), at(&flow.values, k), flow.concentrations[k]))
    }

    /// Returns the surface as [`SpaceDroplet::mesh`] does, but with so many rows of twice as many points, for smooth
    /// pictures. Between the points of the grid, concentrations are sums of harmonics.
    ///
    /// # Errors
    /// Returns an error if there are not more rows than the degree, or if the surface has values that are not finite.
    pub fn smooth_mesh(&self, rows: usize) -> Result<SurfaceMesh, SpaceError> {
        let mut grid = Grid::new(self.degree, rows, 2 * rows)?;
        let n = count(self.degree);
        let mut values: [Vec<f64>; 7] = std::array::from_fn(|_| vec![0.0; grid.len()]);
        let fields = self.state[..3 * n].chunks_exact(n).chain(self.flow.velocities.chunks_exact(n));
        let fields = fields.chain(std::iter::once(self.flow.scalar_concentration.as_slice()));
        for (field, values) in fields.zip(&mut values) {
            grid.backward(field, values)?;
        }
        let [x, y, z, u, v, w, c] = &values;
        self.mesh_of([rows, 2 * rows], |k| ([x[k], y[k], z[k]], [u[k], v[k], w[k]], c[k]))
    }

    /// Returns the triangles between rows of points, of which a function gives position, velocity and concentration.
    fn mesh_of(
        &self,
        [rows, columns]: [usize; 2],
        value: impl Fn(usize) -> ([f64; 3], [f64; 3], f64),
    ) -> Result<SurfaceMesh, SpaceError> {
        let shift = &self.state[4 * count(self.degree)..];
        let poles = [self.at([0.0, 0.0, 1.0])?, self.at([0.0, 0.0, -1.0])?];
        let (mut points, mut velocities, mut concentrations) = (Vec::new(), Vec::new(), Vec::new());
        let all = std::iter::once(poles[0]).chain((0..rows * columns).map(value)).chain(std::iter::once(poles[1]));
        for (place, velocity, concentration) in all {
            points.push(std::array::from_fn(|i| place[i] + shift[i]));
            velocities.push(velocity);
            concentrations.push(concentration);
        }
        let mut tensions = vec![0.0; concentrations.len()];
        self.tension.values(&concentrations, &mut tensions);
        let corner = |row: usize, column: usize| 1 + row * columns + column % columns;
        let mut triangles = Vec::with_capacity(2 * rows * columns);
        for column in 0..columns {
            triangles.push([0, corner(0, column), corner(0, column + 1)]);
            for row in 1..rows {
                let [a, b] = [corner(row - 1, column), corner(row - 1, column + 1)];
                let [c, d] = [corner(row, column), corner(row, column + 1)];
                triangles.extend([[a, c, d], [a, d, b]]);
            }
            triangles.push([corner(rows - 1, column), points.len() - 1, corner(rows - 1, column + 1)]);
        }
        Ok(SurfaceMesh { points, triangles, concentrations, tensions, velocities })
    }
}

#[cfg(test)]
mod tests;

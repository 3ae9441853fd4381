//! Geometry of a surface on a fine grid of parameters.

use sphere_harmonics::{Grid, HarmonicsError};

use crate::layers::Vectors;

/// Positions, tangents, normal and metric of a surface `X(s)` over the unit sphere, on a grid that is fine enough for
/// products.
#[derive(Debug, Clone)]
pub(crate) struct Surface {
    pub(crate) grid: Grid,
    /// Weights of the grid's points.
    pub(crate) weights: Vec<f64>,
    pub(crate) positions: Vectors,
    /// The derivative by theta, and by phi over sin(theta).
    pub(crate) along_theta: Vectors,
    pub(crate) along_phi: Vectors,
    /// Their cross product: the outward normal times the area per area of the unit sphere.
    pub(crate) normals: Vectors,
    /// Area per area of the unit sphere.
    pub(crate) area: Vec<f64>,
    /// Scalar products of the derivatives: theta theta, theta phi, phi phi.
    pub(crate) metric: [Vec<f64>; 3],
}

/// Returns three lists of zeros.
pub(crate) fn vectors(len: usize) -> Vectors {
    [(); 3].map(|()| vec![0.0; len])
}

impl Surface {
    /// Creates the geometry of nothing for harmonics up to this degree.
    pub(crate) fn new(degree: usize) -> Result<Self, HarmonicsError> {
        let grid = Grid::new(degree, 2 * degree + 1, 4 * degree + 2)?;
        let len = grid.len();
        Ok(Self {
            weights: grid.weights().collect(),
            grid,
            positions: vectors(len),
            along_theta: vectors(len),
            along_phi: vectors(len),
            normals: vectors(len),
            area: vec![0.0; len],
            metric: vectors(len),
        })
    }

    /// Computes everything for these coefficients of the positions.
    pub(crate) fn update(&mut self, positions: [&[f64]; 3]) -> Result<(), HarmonicsError> {
        for (i, field) in positions.iter().enumerate() {
            self.grid.backward(field, &mut self.positions[i])?;
            self.grid.backward_theta(field, &mut self.along_theta[i])?;
            self.grid.backward_phi(field, &mut self.along_phi[i])?;
        }
        for k in 0..self.weights.len() {
            let (a, b) = (at(&self.along_theta, k), at(&self.along_phi, k));
            let normal = [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]];
            self.area[k] = dot(normal, normal).sqrt();
            self.metric[0][k] = dot(a, a);
            self.metric[1][k] = dot(a, b);
            self.metric[2][k] = dot(b, b);
            put(&mut self.normals, k, normal);
        }
        Ok(())
    }

    /// Returns the integral over the unit sphere of a function of the point's number.
    pub(crate) fn integral(&self, function: impl Fn(usize) -> f64) -> f64 {
        self.weights.iter().enumerate().map(|(k, weight)| weight * function(k)).sum()
    }

    /// Returns the volume.
    pub(crate) fn volume(&self) -> f64 {
        self.integral(|k| dot(at(&self.positions, k), at(&self.normals, k))) / 3.0
    }

    /// Returns the centroid of the volume.
    pub(crate) fn centroid(&self, volume: f64) -> [f64; 3] {
        std::array::from_fn(|i| self.integral(|k| self.positions[i][k].powi(2) * self.normals[i][k]) / (2.0 * volume))
    }

    /// Returns the components of the tangential part of `vector` along the two derivatives, with the inverse metric.
    #[inline(always)]
    pub(crate) fn contravariant(&self, k: usize, [theta, phi]: [f64; 2]) -> [f64; 2] {
        let [e, f, h] = at(&self.metric, k);
        let square = self.area[k] * self.area[k];
        [(h * theta - f * phi) / square, (e * phi - f * theta) / square]
    }
}

/// Returns the vector of a point.
#[inline(always)]
pub(crate) fn at(vectors: &Vectors, k: usize) -> [f64; 3] {
    [vectors[0][k], vectors[1][k], vectors[2][k]]
}

/// Sets the vector of a point.
#[inline(always)]
pub(crate) fn put(vectors: &mut Vectors, k: usize, vector: [f64; 3]) {
    for (list, value) in vectors.iter_mut().zip(vector) {
        list[k] = value;
    }
}

/// Returns the scalar product.
#[inline(always)]
pub(crate) fn dot(a: [f64; 3], b: [f64; 3]) -> f64 {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

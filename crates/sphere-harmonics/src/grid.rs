//! Transforms between coefficients and values on a grid.

use std::f64::consts::TAU;

use pulp::Arch;

use crate::error::{check_degree, same_length};
use crate::legendre::{Legendre, gauss_legendre, pair};
use crate::{HarmonicsError, Point, count};

/// Most rows and columns.
pub(crate) const MOST: usize = 4096;

/// Parts of the harmonics and of their gradient.
#[derive(Clone, Copy)]
enum Part {
    Value,
    Theta,
    Phi,
}

/// A grid of Gauss-Legendre colatitudes times uniform longitudes, with the transforms of functions of one degree.
///
/// Values are lists of rows, from north to south, each with the longitudes 0, 2 pi/n .. . With more than p rows and
/// 2p columns, [`Grid::forward`] of [`Grid::backward`] returns the coefficients to round-off, and sums with
/// [`Grid::weights`] integrate products of two functions of degree p exactly. No method allocates.
#[derive(Debug, Clone)]
pub struct Grid {
    degree: usize,
    theta: Vec<f64>,
    columns: usize,
    /// For each row, the weight of one of its points on the unit sphere.
    weights: Vec<f64>,
    /// For each pair (l, m), the values of all rows.
    tables: [Vec<f64>; 3],
    /// For each order m, the values of all columns.
    cosines: Vec<f64>,
    sines: Vec<f64>,
    /// Fourier coefficients, for each order and row.
    fourier: [Vec<f64>; 2],
    /// The other part of a divergence.
    spare: Vec<f64>,
}

impl Grid {
    /// Creates the smallest convenient grid for functions of this degree: `p + 1` rows and `2p + 2` columns.
    ///
    /// # Errors
    /// Returns an error if the degree is out of range.
    pub fn gauss(degree: usize) -> Result<Self, HarmonicsError> {
        Self::new(check_degree(degree)?, degree + 1, 2 * degree + 2)
    }

    /// Creates a grid for functions of this degree with more points, for example for products of functions.
    ///
    /// # Errors
    /// Returns an error if the degree is out of range, if there are fewer than `p + 1` rows or `2p + 1` columns, or if
    /// there are more than 4096 of either.
    pub fn new(degree: usize, rows: usize, columns: usize) -> Result<Self, HarmonicsError> {
        check_degree(degree)?;
        if rows <= degree || columns <= 2 * degree || rows.max(columns) > MOST {
            return Err(HarmonicsError::Grid { degree, rows, columns });
        }
        let rule = gauss_legendre(rows);
        let theta: Vec<f64> = rule.iter().map(|(x, _)| x.acos()).collect();
        let weights = rule.iter().map(|(_, weight)| weight * TAU / columns as f64).collect();
        let mut tables = [(); 3].map(|()| vec![0.0; (pair(degree, degree) + 1) * rows]);
        for (row, &theta) in theta.iter().enumerate() {
            let Legendre { value, theta, phi } = Legendre::new(degree, theta);
            for (table, values) in tables.iter_mut().zip([value, theta, phi]) {
                table[row..].iter_mut().step_by(rows).zip(values).for_each(|(entry, value)| *entry = value);
            }
        }
        let wave = |function: fn(f64) -> f64| {
            let angle = move |m: usize, j: usize| TAU * (m * j % columns) as f64 / columns as f64;
            (0..=degree).flat_map(|m| (0..columns).map(move |j| function(angle(m, j)))).collect::<Vec<f64>>()
        };
        let (cosines, sines) = (wave(f64::cos), wave(f64::sin));
        let fourier = [(); 2].map(|()| vec![0.0; (degree + 1) * rows]);
        let spare = vec![0.0; count(degree)];
        Ok(Self { degree, theta, columns, weights, tables, cosines, sines, fourier, spare })
    }

    /// Returns the degree p.
    #[must_use]
    pub fn degree(&self) -> usize {
        self.degree
    }

    /// Returns the number of coefficients, `(p + 1)^2`.
    #[must_use]
    pub fn coefficients(&self) -> usize {
        count(self.degree)
    }

    /// Returns the number of rows.
    #[must_use]
    pub fn rows(&self) -> usize {
        self.theta.len()
    }

    /// Returns the number of columns, the points of a row.
    #[must_use]
    pub fn columns(&self) -> usize {
        self.columns
    }

    /// Returns the colatitudes of the rows (radians).
    #[must_use]
    pub fn colatitudes(&self) -> &[f64] {
        &self.theta
    }

    /// Returns the number of points.
    #[must_use]
    pub fn len(&self) -> usize {
        self.rows() * self.columns
    }

    /// Returns false: every grid has points.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        false
    }

    /// Returns all points in the order of the values.
    pub fn points(&self) -> impl Iterator<Item = Point> + '_ {
        let step = TAU / self.columns as f64;
        let row = move |&theta: &f64| (0..self.columns).map(move |j| Point { theta, phi: j as f64 * step });
        self.theta.iter().flat_map(row)
    }

    /// Returns the weights of all points in the order of the values; they add up to 4 pi.
    pub fn weights(&self) -> impl Iterator<Item = f64> + '_ {
        self.weights.iter().flat_map(|&weight| std::iter::repeat_n(weight, self.columns))
    }

    /// Returns the integral of a function over the unit sphere from its values.
    ///
    /// # Errors
    /// Returns an error if the list has another length than [`Grid::len`].
    pub fn integral(&self, values: &[f64]) -> Result<f64, HarmonicsError> {
        same_length("values", self.len(), values.len())?;
        let rows = values.chunks_exact(self.columns).zip(&self.weights);
        Ok(rows.map(|(row, weight)| weight * row.iter().sum::<f64>()).sum())
    }

    /// Writes the values of the function with these coefficients.
    ///
    /// # Errors
    /// Returns an error if a list has another length than [`Grid::coefficients`] or [`Grid::len`].
    pub fn backward(&mut self, coefficients: &[f64], values: &mut [f64]) -> Result<(), HarmonicsError> {
        self.synthesise(Part::Value, coefficients, values)
    }

    /// Writes the derivatives by theta.
    ///
    /// # Errors
    /// Returns an error if a list has another length than [`Grid::coefficients`] or [`Grid::len`].
    pub fn backward_theta(&mut self, coefficients: &[f64], values: &mut [f64]) -> Result<(), HarmonicsError> {
        self.synthesise(Part::Theta, coefficients, values)
    }

    /// Writes the derivatives by phi over sin(theta).
    ///
    /// # Errors
    /// Returns an error if a list has another length than [`Grid::coefficients`] or [`Grid::len`].
    pub fn backward_phi(&mut self, coefficients: &[f64], values: &mut [f64]) -> Result<(), HarmonicsError> {
        self.synthesise(Part::Phi, coefficients, values)
    }

    /// Writes the integrals of a function times each harmonic.
    ///
    /// These are the coefficients of the function if its degree is at most the degree of the grid.
    ///
    /// # Errors
    /// Returns an error if a list has another length than [`Grid::len`] or [`Grid::coefficients`].
    pub fn forward(&mut self, values: &[f64], coefficients: &mut [f64]) -> Result<(), HarmonicsError> {
        self.analyse(Part::Value, values, coefficients)
    }

    /// Writes the integrals of a tangential field (its components along theta and phi) times the gradient of each
    /// harmonic: the coefficients of minus its divergence.
    ///
    /// # Errors
    /// Returns an error if a list has another length than [`Grid::len`] or [`Grid::coefficients`].
    pub fn forward_gradient(
        &mut self,
        [along_theta, along_phi]: [&[f64]; 2],
        coefficients: &mut [f64],
    ) -> Result<(), HarmonicsError> {
        self.analyse(Part::Theta, along_theta, coefficients)?;
        let mut spare = std::mem::take(&mut self.spare);
        let outcome = self.analyse(Part::Phi, along_phi, &mut spare);
        coefficients.iter_mut().zip(&spare).for_each(|(sum, part)| *sum += part);
        self.spare = spare;
        outcome
    }

    /// Legendre sums of each order, then Fourier sums of each row.
    fn synthesise(&mut self, part: Part, coefficients: &[f64], values: &mut [f64]) -> Result<(), HarmonicsError> {
        same_length("coefficients", self.coefficients(), coefficients.len())?;
        same_length("values", self.len(), values.len())?;
        let (rows, columns, degree) = (self.rows(), self.columns, self.degree);
        let table = &self.tables[part as usize];
        // The derivative of cos(m phi) is -m sin(m phi), of sin(m phi) m cos(m phi); the table has the factor m.
        let (waves, swap) = ([&self.cosines, &self.sines], matches!(part, Part::Phi));
        let [even, odd] = &mut self.fourier;
        Arch::new().dispatch(
            #[inline(always)]
            || {
                even.fill(0.0);
                odd.fill(0.0);
                for m in 0..=degree {
                    let (even, odd) = (&mut even[m * rows..][..rows], &mut odd[m * rows..][..rows]);
                    for l in m..=degree {
                        let (c, s) = (coefficients[l * l + l + m], coefficients[l * l + l - m]);
                        let (c, s) = if swap { (s, -c) } else { (c, s) };
                        let functions = &table[pair(l, m) * rows..][..rows];
                        for ((even, odd), value) in even.iter_mut().zip(&mut *odd).zip(functions) {
                            *even += c * value;
                            *odd += s * value;
                        }
                    }
                }
                for (row, values) in values.chunks_exact_mut(columns).enumerate() {
                    values.fill(even[row]);
                    for m in 1..=degree {
                        let (c, s) = (even[m * rows + row], odd[m * rows + row]);
                        let cosines = &waves[0][m * columns..][..columns];
                        let sines = &waves[1][m * columns..][..columns];
                        for ((value, cos), sin) in values.iter_mut().zip(cosines).zip(sines) {
                            *value += c * cos + s * sin;
                        }
                    }
                }
            },
        );
        Ok(())
    }

    /// Fourier sums of each row, then Legendre sums over the rows.
    fn analyse(&mut self, part: Part, values: &[f64], coefficients: &mut [f64]) -> Result<(), HarmonicsError> {
        same_length("values", self.len(), values.len())?;
        same_length("coefficients", self.coefficients(), coefficients.len())?;
        let (rows, columns, degree) = (self.rows(), self.columns, self.degree);
        let (table, swap) = (&self.tables[part as usize], matches!(part, Part::Phi));
        let (cosines, sines, weights) = (&self.cosines, &self.sines, &self.weights);
        let [even, odd] = &mut self.fourier;
        Arch::new().dispatch(
            #[inline(always)]
            || {
                for (row, values) in values.chunks_exact(columns).enumerate() {
                    for m in 0..=degree {
                        even[m * rows + row] = weights[row] * dot(values, &cosines[m * columns..][..columns]);
                        odd[m * rows + row] = weights[row] * dot(values, &sines[m * columns..][..columns]);
                    }
                }
                for m in 0..=degree {
                    let (even, odd) = (&even[m * rows..][..rows], &odd[m * rows..][..rows]);
                    for l in m..=degree {
                        let functions = &table[pair(l, m) * rows..][..rows];
                        let (c, s) = (dot(even, functions), dot(odd, functions));
                        // Order 0 has no sine: its place is the cosine's.
                        coefficients[l * l + l - m] = if swap { c } else { s };
                        coefficients[l * l + l + m] = if swap { -s } else { c };
                    }
                }
            },
        );
        Ok(())
    }
}

/// Scalar product in eight partial sums, which fill vector registers.
#[inline(always)]
fn dot(a: &[f64], b: &[f64]) -> f64 {
    let (a_chunks, a_rest) = a.as_chunks::<8>();
    let (b_chunks, b_rest) = b.as_chunks::<8>();
    let mut lanes = [0.0; 8];
    for (a, b) in a_chunks.iter().zip(b_chunks) {
        for lane in 0..8 {
            lanes[lane] += a[lane] * b[lane];
        }
    }
    lanes.iter().sum::<f64>() + a_rest.iter().zip(b_rest).map(|(a, b)| a * b).sum::<f64>()
}

#[cfg(test)]
mod tests;

//! Projection in a channel.

use std::f64::consts::PI;

use fourier::SineCosine;
use num_complex::Complex64;

use crate::channel::{Conditions, Poiseuille};
use crate::transform::{RowTransform, second_difference};
use crate::{CentreField, Grid, StaggeredField, StokesError, WallMotion, Work};

/// The projection method in a channel, exact in one pass by the wall values of u*. Lengths inside are in cells, phi is
/// phi / h.
#[derive(Debug, Clone)]
pub(crate) struct ChannelProjection {
    grid: Grid,
    viscosity: f64,
    pub(crate) conditions: Conditions,
    rows: RowTransform,
    across: SineCosine,
    poiseuille: Poiseuille,
    /// `(2 sin(pi n / (2 N)))^2`, n = 0..=N.
    across_symbol: Vec<f64>,
    /// `cos(pi n / (2 N))`: the weights of cosines in the first cell.
    first_cell: Vec<f64>,
    /// Column by column: B with no Laplacian and the wall values 1 below and 0 above.
    harmonic: Vec<f64>,
    /// Column by column: the cosine coefficients of Phi with the Laplacian B and no slope at the walls.
    potential: Vec<f64>,
    /// Column by column: reciprocals of the two eigenvalues of the 2 x 2 system, for sums and differences of the wall
    /// values.
    capacitance: Vec<[f64; 2]>,
    u_spectrum: Vec<Complex64>,
    v_spectrum: Vec<Complex64>,
    u_column: Vec<Complex64>,
    v_column: Vec<Complex64>,
    phi_column: Vec<Complex64>,
    mean_u: Vec<f64>,
}

/// What a column is wanted for.
#[derive(Clone, Copy, PartialEq)]
enum Goal {
    Velocity,
    Pressure,
}

impl ChannelProjection {
    pub(crate) fn new(grid: Grid, viscosity: f64) -> Result<Self, StokesError> {
        let (nx, n) = (grid.nx(), grid.ny());
        let rows = RowTransform::new(nx);
        let width = rows.width();
        let half_angle = |k: usize| 0.5 * PI * k as f64 / n as f64;
        let across_symbol: Vec<f64> = (0..=n).map(|k| (2.0 * half_angle(k).sin()).powi(2)).collect();
        let first_cell: Vec<f64> = (0..n).map(|k| half_angle(k).cos()).collect();
        let mut across = SineCosine::new(n);
        let (mut harmonic, mut potential, mut capacitance) = (Vec::new(), Vec::new(), Vec::new());
        let mut column = vec![Complex64::ZERO; n];
        for m in 0..width {
            let k2 = second_difference(m, nx);
            let decay = 2.0 * (0.5 * k2.sqrt()).asinh();
            for (j, value) in column.iter_mut().enumerate() {
                let (y, n) = (j as f64 + 0.5, n as f64);
                let b = if m == 0 {
                    1.0 - y / n
                } else {
                    // sinh((n - y) decay) / sinh(n decay), free of overflow.
                    (-y * decay).exp() * (-2.0 * (n - y) * decay).exp_m1()
                        / ((-2.0 * n * decay).exp_m1() * (0.5 * decay).cosh())
                };
                *value = Complex64::new(b, 0.0);
                harmonic.push(b);
            }
            across.analyse_cosines(&mut column)?;
            let (mut first, mut last) = (0.0, 0.0);
            for (k, value) in column.iter().enumerate() {
                let phi = if m == 0 { 0.0 } else { -value.re / (across_symbol[k] + k2) };
                potential.push(phi);
                first += phi * first_cell[k];
                last += phi * alternate(k) * first_cell[k];
            }
            capacitance.push([1.0 / (1.0 + k2 * (first + last)), 1.0 / (1.0 + k2 * (first - last))]);
        }
        let complex = |count: usize| vec![Complex64::ZERO; count];
        Ok(Self {
            grid,
            viscosity,
            conditions: Conditions::new(width),
            rows,
            across,
            poiseuille: Poiseuille::new(&grid, viscosity),
            across_symbol,
            first_cell,
            harmonic,
            potential,
            capacitance,
            u_spectrum: complex(width * n),
            v_spectrum: complex(width * (n - 1)),
            u_column: complex(n),
            v_column: complex(n - 1),
            phi_column: complex(n),
            mean_u: vec![0.0; n],
        })
    }

    pub(crate) fn set_walls(&mut self, walls: WallMotion) -> Result<(), StokesError> {
        self.conditions.set_walls(walls, &self.grid, &mut self.rows)
    }

    /// The velocity; gives the mean pressure gradient.
    pub(crate) fn solve(
        &mut self,
        force: &StaggeredField,
        velocity: &mut StaggeredField,
        work: &mut Work,
    ) -> Result<[f64; 2], StokesError> {
        let gradient = self.columns(force, Goal::Velocity, work)?;
        let (nx, n, width) = (self.grid.nx(), self.grid.ny(), self.rows.width());
        let (u, v) = velocity.components_mut();
        for (to, from) in u.chunks_exact_mut(nx).zip(self.u_spectrum.chunks_exact_mut(width)) {
            to.copy_from_slice(self.rows.inverse(from));
        }
        for (to, from) in v[nx..].chunks_exact_mut(nx).zip(self.v_spectrum.chunks_exact_mut(width)) {
            to.copy_from_slice(self.rows.inverse(from));
        }
        v[..nx].fill(0.0);
        v[n * nx..].fill(0.0);
        work.inverse_transforms += 2;
        Ok([gradient, 0.0])
    }

    /// `p = -eta lap phi`.
    pub(crate) fn pressure(
        &mut self,
        force: &StaggeredField,
        pressure: &mut CentreField,
        work: &mut Work,
    ) -> Result<(), StokesError> {
        self.columns(force, Goal::Pressure, work)?;
        let (nx, width) = (self.grid.nx(), self.rows.width());
        for (to, from) in pressure.values_mut().chunks_exact_mut(nx).zip(self.u_spectrum.chunks_exact_mut(width)) {
            to.copy_from_slice(self.rows.inverse(from));
        }
        work.inverse_transforms += 1;
        Ok(())
    }

    /// Everything between the transforms in x: leaves the spectra of u and v, or of p in place of u; gives the mean
    /// pressure gradient (of use with the velocity only).
    fn columns(&mut self, force: &StaggeredField, goal: Goal, work: &mut Work) -> Result<f64, StokesError> {
        let (nx, n, width) = (self.grid.nx(), self.grid.ny(), self.rows.width());
        // With this factor v* has the right units, and the transforms in x are normalised.
        let scale = self.grid.spacing().powi(2) / (self.viscosity * nx as f64);
        for (spectrum, values) in [(&mut self.u_spectrum, force.x()), (&mut self.v_spectrum, &force.y()[nx..n * nx])] {
            for (out, row) in spectrum.chunks_exact_mut(width).zip(values.chunks_exact(nx)) {
                let fill = |to: &mut [f64]| {
                    for (to, from) in to.iter_mut().zip(row) {
                        *to = scale * from;
                    }
                };
                self.rows.forward(fill, out);
            }
        }
        work.forward_transforms += 2;

        let mut gradient = 0.0;
        for m in 0..width {
            gather(&self.u_spectrum[m..], width, &mut self.u_column);
            gather(&self.v_spectrum[m..], width, &mut self.v_column);
            self.column(m, goal)?;
            if m == 0 && goal == Goal::Velocity {
                for (mean, value) in self.mean_u.iter_mut().zip(&self.u_column) {
                    *mean = value.re;
                }
                gradient = self.poiseuille.impose(self.conditions.drive, &mut self.mean_u);
                for (mean, value) in self.mean_u.iter().zip(&mut self.u_column) {
                    *value = Complex64::new(*mean, 0.0);
                }
            }
            scatter(&self.u_column, &mut self.u_spectrum[m..], width);
            scatter(&self.v_column, &mut self.v_spectrum[m..], width);
        }
        Ok(gradient)
    }

    /// One wave number: from the forces in `u_column` and `v_column` to the velocities, or to the pressure in
    /// `u_column`.
    fn column(&mut self, m: usize, goal: Goal) -> Result<(), StokesError> {
        let (nx, n) = (self.grid.nx(), self.grid.ny());
        let k2 = second_difference(m, nx);
        // The difference from u points to centres; minus its conjugate is the one from centres to u points.
        let theta = 2.0 * PI * m as f64 / nx as f64;
        let divergence = Complex64::from_polar(1.0, theta) - 1.0;
        let gradient = -divergence.conj();
        let (u, v, phi) = (&mut self.u_column, &mut self.v_column, &mut self.phi_column);
        let symbol = &self.across_symbol;

        // v*, with no wall values of u* yet.
        self.across.analyse_sines(u)?;
        for (u, symbol) in u.iter_mut().zip(&symbol[1..]) {
            *u /= symbol + k2;
        }
        self.across.synthesise_sines(u)?;
        self.across.analyse_node_sines(v)?;
        for (v, symbol) in v.iter_mut().zip(&symbol[1..]) {
            *v /= symbol + k2;
        }

        // phi, and its values next to the walls.
        phi.copy_from_slice(u);
        self.across.analyse_cosines(phi)?;
        let (mut first, mut last) = (Complex64::ZERO, Complex64::ZERO);
        for k in 0..n {
            let across = if k == 0 { Complex64::ZERO } else { symbol[k].sqrt() * v[k - 1] };
            let lap = symbol[k] + k2;
            phi[k] = if lap == 0.0 { Complex64::ZERO } else { -(divergence * phi[k] + across) / lap };
            first += phi[k] * self.first_cell[k];
            last += phi[k] * (alternate(k) * self.first_cell[k]);
        }

        // The wall values of u* for which u has those of the walls.
        let bottom = self.conditions.spectra[0][m] + gradient * first;
        let top = self.conditions.spectra[1][m] + gradient * last;
        let [of_sum, of_difference] = self.capacitance[m];
        let (sum, difference) = ((bottom + top) * of_sum, (bottom - top) * of_difference);
        let (bottom, top) = (0.5 * (sum + difference), 0.5 * (sum - difference));
        let potential = &self.potential[m * n..(m + 1) * n];
        let harmonic = &self.harmonic[m * n..(m + 1) * n];
        for (k, phi) in phi.iter_mut().enumerate() {
            *phi += divergence * (bottom + top * alternate(k)) * potential[k];
        }

        match goal {
            Goal::Velocity => {
                for (k, v) in v.iter_mut().enumerate() {
                    *v += symbol[k + 1].sqrt() * phi[k + 1];
                }
                self.across.synthesise_node_sines(v)?;
                self.across.synthesise_cosines(phi)?;
                for (j, u) in u.iter_mut().enumerate() {
                    *u += bottom * harmonic[j] + top * harmonic[n - 1 - j] - gradient * phi[j];
                }
            }
            Goal::Pressure => {
                let stress = self.viscosity / self.grid.spacing();
                for ((u, phi), symbol) in u.iter_mut().zip(phi.iter()).zip(symbol) {
                    *u = stress * (symbol + k2) * phi;
                }
                self.across.synthesise_cosines(u)?;
            }
        }
        Ok(())
    }
}

/// (-1)^k.
fn alternate(k: usize) -> f64 {
    if k.is_multiple_of(2) { 1.0 } else { -1.0 }
}

fn gather(rows: &[Complex64], width: usize, column: &mut [Complex64]) {
    for (value, from) in column.iter_mut().zip(rows.iter().step_by(width)) {
        *value = *from;
    }
}

fn scatter(column: &[Complex64], rows: &mut [Complex64], width: usize) {
    for (value, to) in column.iter().zip(rows.iter_mut().step_by(width)) {
        *to = *value;
    }
}

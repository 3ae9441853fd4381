//! The projection method in a channel.

use std::f64::consts::PI;

use motile_base::{Drive, internal::sum};
use num_complex::Complex64;

use super::across::Across;
use super::lagged::LaggedWalls;
use super::wall_response::WallResponse;
use crate::channel::MeanFlow;
use crate::transform::{RowTransform, second_difference};
use crate::{CentreField, Grid, StaggeredField, StokesError, Wall, WallMotion, WallTreatment, Work};

/// The projection method in a channel: transforms along x, and for each wave number the transforms of [`Across`].
///
/// First the intermediate velocity is zero on the walls, and its projection slips along them with the velocity
/// `k phi`. Whatever the intermediate velocity is on the walls adds a Stokes flow between moving walls, which
/// [`WallResponse`] has in closed form: exact walls are those that take the slip away.
#[derive(Debug, Clone)]
pub(crate) struct ChannelProjection {
    grid: Grid,
    viscosity: f64,
    pub(crate) drive: Drive,
    pub(crate) walls: WallMotion,
    pub(crate) treatment: WallTreatment,
    pub(crate) lagged: LaggedWalls,
    /// Fourier coefficients of the velocities of the bottom and the top wall.
    wall_spectra: [Vec<Complex64>; 2],
    rows: RowTransform,
    across: Across,
    /// Responses to the walls at the wave numbers 1, 2, ...
    responses: Vec<WallResponse>,
    mean: MeanFlow,
    mean_u: Vec<f64>,
    /// Real and imaginary part of one wave number.
    parts: [Part; 2],
    u: Vec<Complex64>,
    v: Vec<Complex64>,
}

/// Unknowns of one part of a wave number.
#[derive(Debug, Clone)]
struct Part {
    u: Vec<f64>,
    v: Vec<f64>,
}

/// Result that is wanted of a force.
#[derive(Debug, Clone, Copy, PartialEq)]
enum Goal {
    Velocity,
    Intermediate,
    Potential,
    Pressure,
}

/// Intermediate velocity of the walls, and the change of the velocity there that it makes, at the bottom and the top.
#[derive(Debug, Clone, Copy)]
struct WallValues {
    intermediate: [f64; 2],
    change: [f64; 2],
}

impl ChannelProjection {
    pub(crate) fn new(grid: Grid, viscosity: f64) -> Result<Self, StokesError> {
        let (nx, n) = (grid.nx(), grid.ny());
        let rows = RowTransform::new(nx)?;
        let width = rows.width();
        let spectrum = |count: usize| vec![Complex64::ZERO; count];
        Ok(Self {
            grid,
            viscosity,
            drive: Drive::default(),
            walls: WallMotion::AT_REST,
            treatment: WallTreatment::default(),
            lagged: LaggedWalls::new(width, n),
            wall_spectra: [spectrum(width), spectrum(width)],
            rows,
            across: Across::new(n)?,
            responses: (1..width).map(|m| WallResponse::new(second_difference(m, nx), n)).collect(),
            mean: MeanFlow::new(&grid, viscosity, 0.0, [1.0; 2]),
            mean_u: vec![0.0; n],
            parts: [0, 1].map(|_| Part { u: vec![0.0; n], v: vec![0.0; n - 1] }),
            u: spectrum(width * n),
            v: spectrum(width * (n - 1)),
        })
    }

    pub(crate) fn grid(&self) -> &Grid {
        &self.grid
    }

    pub(crate) fn set_walls(&mut self, walls: WallMotion) -> Result<(), StokesError> {
        walls.check(&self.grid)?;
        if walls.slip() != [0.0; 2] {
            return Err(StokesError::no_slip_only());
        }
        let before = self.wall_spectra.clone();
        for (wall, spectrum) in [Wall::Bottom, Wall::Top].into_iter().zip(&mut self.wall_spectra) {
            walls.spectrum(wall, &mut self.rows, spectrum);
        }
        // Only the gradient of the potential lags, so that the next solution has the new velocities.
        let (Self { wall_spectra: [bottom, top], lagged, grid, .. }, [old_bottom, old_top]) = (&mut *self, before);
        let changes = bottom.iter().zip(old_bottom).zip(top.iter().zip(old_top));
        for (m, ((bottom, old_bottom), (top, old_top))) in changes.enumerate() {
            let turn = shift(m, grid.nx());
            let [bottom, top] = [turn * (bottom - old_bottom), turn * (top - old_top)];
            lagged.move_next(m, 0, [bottom.re, top.re]);
            lagged.move_next(m, 1, [bottom.im, top.im]);
        }
        self.walls = walls;
        Ok(())
    }

    /// Computes the velocity; returns the mean pressure gradient.
    pub(crate) fn solve(
        &mut self,
        force: &StaggeredField,
        velocity: &mut StaggeredField,
        work: &mut Work,
    ) -> Result<[f64; 2], StokesError> {
        let gradient = self.columns(force, Goal::Velocity, work);
        self.write_vectors(velocity, work)?;
        if self.treatment == WallTreatment::Lagged {
            if !self.lagged.is_finite() {
                return Err(StokesError::overflow("the intermediate velocity at the walls"));
            }
            self.lagged.advance();
        }
        Ok([gradient, 0.0])
    }

    pub(crate) fn intermediate_velocity(
        &mut self,
        force: &StaggeredField,
        out: &mut StaggeredField,
        work: &mut Work,
    ) -> Result<(), StokesError> {
        self.columns(force, Goal::Intermediate, work);
        self.write_vectors(out, work)
    }

    pub(crate) fn potential(&mut self, force: &StaggeredField, out: &mut CentreField, work: &mut Work) {
        self.columns(force, Goal::Potential, work);
        self.write_scalars(out, work);
    }

    pub(crate) fn pressure(&mut self, force: &StaggeredField, out: &mut CentreField, work: &mut Work) {
        self.columns(force, Goal::Pressure, work);
        self.write_scalars(out, work);
    }

    /// Writes the velocity by which the last solution slips along a wall.
    pub(crate) fn slip(&mut self, wall: Wall, out: &mut [f64]) {
        let (width, nx) = (self.rows.width(), self.grid.nx());
        for m in 0..width {
            let [re, im] = [0, 1].map(|part| self.lagged.slip(m, part)[usize::from(wall == Wall::Top)]);
            self.u[m] = Complex64::new(re, im) * shift(m, nx).conj();
        }
        out.copy_from_slice(self.rows.inverse(&mut self.u[..width]));
    }

    /// Transforms spectra of `u` and `v` back.
    fn write_vectors(&mut self, out: &mut StaggeredField, work: &mut Work) -> Result<(), StokesError> {
        let (nx, n, width) = (self.grid.nx(), self.grid.ny(), self.rows.width());
        let (u, v) = out.components_mut();
        for (to, from) in u.chunks_exact_mut(nx).zip(self.u.chunks_exact_mut(width)) {
            let row = self.rows.inverse(from);
            // An overflow anywhere reaches every value along x and, by the transforms across, every row.
            if !row[0].is_finite() {
                return Err(StokesError::overflow("the velocity"));
            }
            to.copy_from_slice(row);
        }
        for (to, from) in v[nx..].chunks_exact_mut(nx).zip(self.v.chunks_exact_mut(width)) {
            to.copy_from_slice(self.rows.inverse(from));
        }
        v[..nx].fill(0.0);
        v[n * nx..].fill(0.0);
        work.inverse_transforms += 2;
        Ok(())
    }

    /// Transforms the spectrum that is left in `u` back.
    fn write_scalars(&mut self, out: &mut CentreField, work: &mut Work) {
        let (nx, width) = (self.grid.nx(), self.rows.width());
        for (to, from) in out.values_mut().chunks_exact_mut(nx).zip(self.u.chunks_exact_mut(width)) {
            to.copy_from_slice(self.rows.inverse(from));
        }
        work.inverse_transforms += 1;
    }

    /// Transforms the force along x, over the viscosity and in units of the cell.
    fn transform_force(&mut self, force: &StaggeredField) {
        let (nx, n, width) = (self.grid.nx(), self.grid.ny(), self.rows.width());
        // The transforms in x are normalised by this as well.
        let scale = self.grid.spacing().powi(2) / (self.viscosity * nx as f64);
        for (spectrum, values) in [(&mut self.u, force.x()), (&mut self.v, &force.y()[nx..n * nx])] {
            for (out, row) in spectrum.chunks_exact_mut(width).zip(values.chunks_exact(nx)) {
                let fill = |to: &mut [f64]| to.iter_mut().zip(row).for_each(|(to, from)| *to = scale * from);
                self.rows.forward(fill, out);
            }
        }
        for (mean, row) in self.mean_u.iter_mut().zip(force.x().chunks_exact(nx)) {
            *mean = sum(row) / nx as f64;
        }
    }

    /// Does everything between the transforms along x; returns the mean pressure gradient.
    ///
    /// This leaves the spectra of vectors in `u` and `v`, or the spectrum of a scalar in `u`.
    fn columns(&mut self, force: &StaggeredField, goal: Goal, work: &mut Work) -> f64 {
        self.transform_force(force);
        let vectors = matches!(goal, Goal::Velocity | Goal::Intermediate);
        for m in 0..self.rows.width() {
            self.across.set_wave(second_difference(m, self.grid.nx()).sqrt());
            self.gather(m);
            (0..2).for_each(|part| self.column(m, part, goal));
            self.scatter(m, vectors);
        }
        work.forward_transforms += 2;
        work.sine_cosine_transforms += if goal == Goal::Potential { 5 } else { 6 };
        if vectors { self.impose_mean(goal) } else { 0.0 }
    }

    /// Replaces what is left of the wave number 0 by the mean flow, whose mean pressure gradient is returned.
    fn impose_mean(&mut self, goal: Goal) -> f64 {
        let walls = [Wall::Bottom, Wall::Top].map(|wall| self.walls.mean(wall));
        let gradient = self.mean.solve(self.drive, walls, &mut self.mean_u);
        let width = self.rows.width();
        for (mean, value) in self.mean_u.iter().zip(self.u.iter_mut().step_by(width)) {
            *value = Complex64::new(*mean, 0.0);
        }
        if goal == Goal::Velocity {
            self.v.iter_mut().step_by(width).for_each(|value| *value = Complex64::ZERO);
        }
        gradient
    }

    /// Copies a column of the spectra to the two parts.
    fn gather(&mut self, m: usize) {
        let (width, turn) = (self.rows.width(), shift(m, self.grid.nx()));
        let [re, im] = &mut self.parts;
        for ((re, im), value) in re.u.iter_mut().zip(&mut im.u).zip(self.u[m..].iter().step_by(width)) {
            let value = turn * value;
            (*re, *im) = (value.re, value.im);
        }
        for ((re, im), value) in re.v.iter_mut().zip(&mut im.v).zip(self.v[m..].iter().step_by(width)) {
            (*re, *im) = (value.re, value.im);
        }
    }

    /// Copies the two parts back; a scalar, which lies at the centres already, comes from `u`.
    fn scatter(&mut self, m: usize, vectors: bool) {
        let width = self.rows.width();
        let turn = if vectors { shift(m, self.grid.nx()).conj() } else { Complex64::ONE };
        let [re, im] = &self.parts;
        for (value, (re, im)) in self.u[m..].iter_mut().step_by(width).zip(re.u.iter().zip(&im.u)) {
            *value = turn * Complex64::new(*re, *im);
        }
        for (value, (re, im)) in self.v[m..].iter_mut().step_by(width).zip(re.v.iter().zip(&im.v)) {
            *value = Complex64::new(*re, *im);
        }
    }

    /// Computes one part of a wave number from its forces.
    fn column(&mut self, m: usize, part: usize, goal: Goal) {
        let parts = &mut self.parts[part];
        self.across.swap(&mut parts.u, &mut parts.v);
        self.across.diffuse();
        self.across.project();
        match goal {
            Goal::Velocity => self.across.correct_v(),
            Goal::Pressure => self.across.laplacian_into_u(),
            Goal::Intermediate | Goal::Potential => (),
        }
        self.across.finish_phi();
        let values = self.wall_values(m, part, goal);
        match goal {
            Goal::Velocity => self.finish_velocity(m, values),
            Goal::Intermediate => self.finish_intermediate(m, values),
            Goal::Potential => self.finish_potential(m, values),
            Goal::Pressure => self.finish_pressure(m, values),
        }
        let parts = &mut self.parts[part];
        self.across.swap(&mut parts.u, &mut parts.v);
    }

    fn finish_velocity(&mut self, m: usize, values: WallValues) {
        let k = self.across.k();
        self.across.finish_v();
        let Across { u, v, phi, .. } = &mut self.across;
        u.iter_mut().zip(phi).for_each(|(u, phi)| *u += k * *phi);
        let Some(response) = response(&self.responses, m) else { return };
        // The flow of the walls, whose y velocities follow from continuity.
        let mut above = 0.0;
        for (j, by_walls) in by_walls(&response.velocity, values.change).enumerate() {
            u[j] += by_walls;
            above -= k * by_walls;
            if let Some(v) = v.get_mut(j) {
                *v += above;
            }
        }
    }

    fn finish_intermediate(&mut self, m: usize, values: WallValues) {
        self.across.finish_v();
        let Some(response) = response(&self.responses, m) else { return };
        let walls = by_walls(&response.harmonic, values.intermediate);
        self.across.u.iter_mut().zip(walls).for_each(|(u, walls)| *u += walls);
    }

    fn finish_potential(&mut self, m: usize, values: WallValues) {
        let (k, h) = (self.across.k(), self.grid.spacing());
        let Across { u, phi, .. } = &mut self.across;
        u.iter_mut().zip(phi).for_each(|(u, phi)| *u = h * *phi);
        let Some(response) = response(&self.responses, m) else { return };
        let velocity = by_walls(&response.velocity, values.change);
        let intermediate = by_walls(&response.harmonic, values.intermediate);
        for ((phi, velocity), intermediate) in u.iter_mut().zip(velocity).zip(intermediate) {
            *phi += h * (velocity - intermediate) / k;
        }
    }

    fn finish_pressure(&mut self, m: usize, values: WallValues) {
        let (k, stress, u) = (self.across.k(), self.viscosity / self.grid.spacing(), &mut self.across.u);
        if let Some(response) = response(&self.responses, m) {
            let walls = by_walls(&response.harmonic, values.intermediate);
            u.iter_mut().zip(walls).for_each(|(p, walls)| *p -= k * walls);
        }
        u.iter_mut().for_each(|p| *p *= stress);
    }

    /// Returns the intermediate velocities on the walls of one part of a wave number, from the potential that there is
    /// with none.
    fn wall_values(&mut self, m: usize, part: usize, goal: Goal) -> WallValues {
        let Some(response) = response(&self.responses, m) else {
            return WallValues { intermediate: [0.0; 2], change: [0.0; 2] };
        };
        let (k, phi, n) = (self.across.k(), &self.across.phi, self.grid.ny());
        let turn = shift(m, self.grid.nx());
        let slip = [phi[0], phi[n - 1]].map(|phi| k * phi);
        let missing: [f64; 2] = std::array::from_fn(|wall| {
            let moved = turn * self.wall_spectra[wall][m];
            if part == 0 { moved.re - slip[wall] } else { moved.im - slip[wall] }
        });
        let exact = WallValues { intermediate: both(missing, response.slip, |a, b| a / b), change: missing };
        if self.treatment == WallTreatment::Exact {
            return exact;
        }
        let lagged = if goal == Goal::Velocity { self.lagged.next(m, part) } else { self.lagged.used(m, part) };
        let values = lagged.map_or(exact, |intermediate| WallValues {
            intermediate,
            change: both(intermediate, response.slip, |a, b| a * b),
        });
        if goal == Goal::Velocity {
            // That of the wall minus the slope of the whole potential.
            let coming = std::array::from_fn(|wall| values.intermediate[wall] + (missing[wall] - values.change[wall]));
            self.lagged.note(m, part, values.intermediate, coming);
        }
        values
    }
}

/// Returns the factor of x velocities by which they move to the centres and divergence and gradient become real, see
/// [`Across`].
fn shift(m: usize, nx: usize) -> Complex64 {
    let half_angle = PI * m as f64 / nx as f64;
    Complex64::new(-half_angle.sin(), half_angle.cos())
}

/// Applies an operation to the sum and to the difference of the values on both walls.
fn both([bottom, top]: [f64; 2], factors: [f64; 2], apply: impl Fn(f64, f64) -> f64) -> [f64; 2] {
    let (sum, difference) = (apply(bottom + top, factors[0]), apply(bottom - top, factors[1]));
    [0.5 * (sum + difference), 0.5 * (sum - difference)]
}

/// Returns the response at a wave number; there is none to the mean, which is the mean flow.
fn response(responses: &[WallResponse], m: usize) -> Option<&WallResponse> {
    responses.get(m.checked_sub(1)?)
}

/// Returns the contribution of the values on both walls to each row.
fn by_walls(response: &[f64], [bottom, top]: [f64; 2]) -> impl Iterator<Item = f64> {
    response.iter().zip(response.iter().rev()).map(move |(by_bottom, by_top)| bottom * by_bottom + top * by_top)
}

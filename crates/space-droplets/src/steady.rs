//! Steady swimmers by Newton's method, and how their disturbances grow.
//!
//! A steady state in general parameters is a family, because the parameters can slide. Star shapes, a radius for each
//! direction, have no such freedom: `(R_lm, m_lm)` are the unknowns here.

mod crowding;

use std::f64::consts::PI;

use motile_base::internal::Refuse;
use nalgebra::{DMatrix, DVector};
use num_complex::Complex64;
use sphere_harmonics::{Point, count, evaluate, index};

use crate::layers::Vectors;
use crate::surface::{at, dot, put, vectors};
use crate::{SpaceDroplet, SpaceError};
use crowding::Crowding;

/// Most iterations.
const MOST: usize = 60;
/// Residual, in units of the fastest rate, that counts as zero.
const TOLERANCE: f64 = 3e-12;
/// Residual below which an iteration that gains no more has reached round-off.
const ROUND_OFF: f64 = 1e-9;
/// Change of the unknowns for differences, in units of the radius and of the mean of the particles.
const STEP: f64 = 1e-6;
/// Disturbance for growth rates: its fourth power is what differences leave out.
const DISTURBANCE: f64 = 2e-4;
/// Multiples of the disturbance with the weights of their rates; by symmetry, rates of an order above 0 are odd.
const CENTRAL: [(f64, f64); 4] = [(1.0, 8.0 / 12.0), (-1.0, -8.0 / 12.0), (2.0, -1.0 / 12.0), (-2.0, 1.0 / 12.0)];
const ODD: [(f64, f64); 2] = [(1.0, 8.0 / 6.0), (2.0, -1.0 / 6.0)];
/// Largest relative change of an unknown in an iteration.
const LONGEST: f64 = 0.3;
/// Degree from which parameters crowd twice, in a wider band: a lower one does not see the edge well enough.
const FINE: usize = 20;
/// Widths of the crowded parameters, in units of the range of the concentration over its steepest slope, below this
/// degree and from it on (measured).
const WIDTHS: [f64; 2] = [0.45, 0.6];
/// Edges between these widths (radians) are crowded.
const WIDEST: f64 = 0.6;
const NARROWEST: f64 = 0.05;
/// Part of the width before, above which parameters crowd enough.
const SAME_WIDTH: f64 = 0.9;
/// Rise of the residual in an iteration that is still accepted.
const LARGEST_RISE: f64 = 3.0;
/// First time step of the iteration, in units of the time scale of the start.
const FIRST_STEP: f64 = 0.5;

/// A steady axisymmetric swimmer, which may be unstable.
///
/// ```
/// use space_droplets::{ContractileTension, SpaceDroplet, SteadyState};
///
/// let law = ContractileTension::thesis(10.0, -1.0, 2.0, 100.0)?;
/// let start = SpaceDroplet::sphere(10, 1.0, [100.0, 100.0], law)?;
/// let start = start.with_particles(0.1, |s| 100.0 * (1.0 + 0.9 * s[2]))?;
/// let mut swimmer = SteadyState::find(start)?;
/// let speed = swimmer.droplet_mut().observe()?.speed;
/// println!("speed {speed:.4}, exact 0.1261");
/// assert!((speed - 0.12608).abs() < 2e-4);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug)]
pub struct SteadyState {
    droplet: SpaceDroplet,
    /// Coefficients of the radius.
    radii: Vec<f64>,
    directions: Vectors,
    /// Solid angle of directions per solid angle of parameters.
    solid_angles: Vec<f64>,
    rates: Vec<f64>,
    iterations: usize,
}

impl SteadyState {
    /// Finds the steady state near `droplet`, which must be axisymmetric about z and have parameters along its radii,
    /// as in [`SpaceDroplet::sphere`]. Its number of particles and its volume stay. Far from a steady state,
    /// the iteration follows the run of the droplet in long implicit steps, so it also starts from rough guesses, such
    /// as a sphere with particles `c0 (1 + 0.9 cos theta)`. Below the threshold of swimming, it ends at the droplet at
    /// rest. Swimmers with a sharp edge of the particles are found once more with parameters that crowd at the edge.
    ///
    /// # Errors
    /// Returns an error for a droplet of another form or with an imposed flow, [`SpaceError::NoSteadyState`], or the
    /// errors of [`SpaceDroplet::evaluate`].
    pub fn find(droplet: SpaceDroplet) -> Result<Self, SpaceError> {
        let mut state = Self::of(droplet)?;
        state.droplet.layers.first_only = true;
        let outcome = state.iterate().and_then(|()| state.crowd());
        state.droplet.layers.first_only = false;
        outcome?;
        state.droplet.state[4 * count(state.droplet.degree)..].fill(0.0);
        state.droplet.flow.known = false;
        state.droplet.evaluate()?;
        Ok(state)
    }

    /// Takes the radii from the surface.
    fn of(mut droplet: SpaceDroplet) -> Result<Self, SpaceError> {
        let n = count(droplet.degree);
        let off_axis = |list: &[f64]| {
            let size = |(place, value): (usize, &f64)| {
                let l = place.isqrt();
                if place == index(l, 0) { 0.0 } else { value.abs() }
            };
            list.iter().enumerate().map(size).fold(0.0, f64::max)
        };
        let what = "a steady state cannot start from this droplet";
        let remedy = "Start from `SpaceDroplet::sphere` with particles that depend on z alone";
        let mut directions = vectors(droplet.surface.grid.len());
        for (k, point) in droplet.surface.grid.points().enumerate() {
            put(&mut directions, k, Point::direction(point));
        }
        droplet.update_surface()?;
        let surface = &mut droplet.surface;
        let mut values = vec![0.0; directions[0].len()];
        let mut across = 0.0_f64;
        for (k, radius) in values.iter_mut().enumerate() {
            let (x, e) = (at(&surface.positions, k), at(&directions, k));
            *radius = dot(x, e);
            across = across.max((dot(x, x) - *radius * *radius).abs());
        }
        let mut radii = vec![0.0; n];
        surface.grid.forward(&values, &mut radii)?;
        let m = &droplet.state[3 * n..4 * n];
        if across > 1e-6 * droplet.radius.powi(2) || off_axis(&radii) > 1e-6 * droplet.radius {
            return Err(SpaceError::refused(
                what,
                "its parameters are not along its radii, or it has no axis z",
                remedy,
            ));
        }
        if m[0].is_nan() || m[0] <= 0.0 || off_axis(m) > 1e-6 * m[0] {
            return Err(SpaceError::refused(what, "it has no particles, or they are not axisymmetric about z", remedy));
        }
        if droplet.gradient.iter().flatten().any(|&entry| entry != 0.0) {
            return Err(SpaceError::refused(what, "an imposed flow acts on it", "Use a droplet without one"));
        }
        if droplet.around.as_ref().is_some_and(|around| !around.surroundings.symmetric_about_z()) {
            let value = "its surroundings are not symmetric about the z axis";
            return Err(SpaceError::refused(what, value, "Use a tube along z, or no surroundings"));
        }
        let place = &droplet.state[4 * n..];
        if droplet.around.is_some() && place[0].hypot(place[1]) > 1e-6 * droplet.radius {
            let remedy = "Start from a droplet whose centroid is on the z axis";
            return Err(SpaceError::refused(what, "it is off the axis of its surroundings", remedy));
        }
        let solid_angles = vec![1.0; values.len()];
        Ok(Self { droplet, radii, directions, solid_angles, rates: vec![0.0; n], iterations: 0 })
    }

    /// Crowds the parameters at the edge of the particles, if they have one, and finds the state again. Then the edge
    /// is seen better, and the parameters crowd once more if it is narrower.
    fn crowd(&mut self) -> Result<(), SpaceError> {
        let mut before: Option<Crowding> = None;
        let times = if self.droplet.degree < FINE { 1 } else { 2 };
        for _ in 0..times {
            let Some(crowding) = self.edge(before.as_ref()) else { break };
            self.crowd_from(before.as_ref(), &crowding)?;
            before = Some(crowding);
        }
        Ok(())
    }

    /// Returns parameters that crowd at the edge of the particles, unless there is none or they do already.
    fn edge(&self, before: Option<&Crowding>) -> Option<Crowding> {
        let grid = &self.droplet.surface.grid;
        let values = |row: usize| self.droplet.flow.concentrations[row * grid.columns()];
        let colatitude = |&t: &f64| before.map_or(t, |before| before.colatitude(t).0);
        let theta: Vec<f64> = grid.colatitudes().iter().map(colatitude).collect();
        let (mut edge, mut steepest) = (0.0, 0.0_f64);
        let [mut least, mut most] = [values(0); 2];
        for row in 1..theta.len() {
            (least, most) = (least.min(values(row)), most.max(values(row)));
            let slope = ((values(row) - values(row - 1)) / (theta[row] - theta[row - 1])).abs();
            if slope > steepest {
                (edge, steepest) = (0.5 * (theta[row] + theta[row - 1]), slope);
            }
        }
        let width = WIDTHS[usize::from(self.droplet.degree >= FINE)] * (most - least) / steepest;
        if !(width > 0.0 && width < WIDEST && (0.5..PI - 0.5).contains(&edge)) {
            return None;
        }
        let width = width.max(NARROWEST);
        let narrower = before.is_none_or(|before| width < SAME_WIDTH * before.width());
        narrower.then(|| Crowding::new(edge, width))
    }

    /// Describes the droplet by other parameters and finds the state again.
    fn crowd_from(&mut self, before: Option<&Crowding>, crowding: &Crowding) -> Result<(), SpaceError> {
        let n = count(self.droplet.degree);
        let (radii, mut concentrations) = (self.radii.clone(), vec![0.0; n]);
        self.droplet.surface.grid.forward(&self.droplet.flow.concentrations, &mut concentrations)?;
        let surface = &mut self.droplet.surface;
        let points: Vec<Point> = surface.grid.points().collect();
        let columns = surface.grid.columns();
        let (mut radius, mut particles) = (vec![0.0; points.len()], vec![0.0; points.len()]);
        for (row, points) in points.chunks_exact(columns).enumerate() {
            let (theta, slope) = crowding.colatitude(points[0].theta);
            let solid_angle = theta.sin() / (slope * points[0].theta.sin());
            let here = Point { theta: before.map_or(theta, |before| before.parameter(theta).0), phi: 0.0 };
            let (r, c) = (evaluate(&radii, here)?, evaluate(&concentrations, here)?);
            for (column, point) in points.iter().enumerate() {
                let k = row * columns + column;
                put(&mut self.directions, k, Point { theta, ..*point }.direction());
                (radius[k], particles[k], self.solid_angles[k]) = (r, c, solid_angle);
            }
        }
        surface.grid.forward(&radius, &mut self.radii)?;
        self.evaluate(true)?;
        let Self { droplet, .. } = self;
        for (particles, area) in particles.iter_mut().zip(&droplet.surface.area) {
            *particles *= area;
        }
        let total = droplet.state[3 * n];
        droplet.surface.grid.forward(&particles, &mut droplet.state[3 * n..4 * n])?;
        let scale = total / droplet.state[3 * n];
        droplet.state[3 * n..4 * n].iter_mut().for_each(|value| *value *= scale);
        let before = self.iterations;
        let outcome = self.iterate();
        self.iterations += before;
        outcome
    }

    /// Returns the steady droplet.
    #[must_use]
    pub fn droplet(&self) -> &SpaceDroplet {
        &self.droplet
    }

    /// Returns the steady droplet, to observe it.
    pub fn droplet_mut(&mut self) -> &mut SpaceDroplet {
        &mut self.droplet
    }

    /// Returns the steady droplet, for example to start a run from it.
    #[must_use]
    pub fn into_droplet(self) -> SpaceDroplet {
        self.droplet
    }

    /// Returns the number of iterations.
    #[must_use]
    pub fn iterations(&self) -> usize {
        self.iterations
    }

    /// Returns the growth rates (1/time; the imaginary part is an angular frequency) of disturbances that are products
    /// of `cos(order phi)` and functions of theta, fastest first.
    ///
    /// Among them are zeros that say nothing about stability. In unbounded fluid, these are a translation for orders 0
    /// and 1, and a turn of the swimmer for order 1. In a tube, only the translation along it remains, for order 0.
    /// How far these are from zero shows how well the degree resolves the swimmer. If the particles have a sharp edge,
    /// modes lie close together and converge slowly: compare the rates of two degrees.
    ///
    /// # Errors
    /// Returns an error for an order above the degree, or the errors of [`SpaceDroplet::evaluate`].
    pub fn growth_rates(&mut self, order: usize) -> Result<Vec<Complex64>, SpaceError> {
        let degree = self.droplet.degree;
        if order > degree {
            let remedy = format!("Use an order from 0 to {degree}");
            return Err(SpaceError::refused("the order is above the degree", order.to_string(), remedy));
        }
        let (state, radii) = (self.droplet.state.clone(), self.radii.clone());
        self.droplet.layers.first_only = order == 0;
        let outcome = self.linearise(order, &state, &radii);
        self.droplet.layers.first_only = false;
        self.droplet.state.copy_from_slice(&state);
        self.radii = radii;
        self.droplet.flow.known = false;
        self.droplet.evaluate()?;
        let mut rates: Vec<Complex64> = outcome?.complex_eigenvalues().iter().copied().collect();
        rates.sort_by(|a, b| b.re.total_cmp(&a.re).then(b.im.total_cmp(&a.im)));
        Ok(rates)
    }

    /// Returns the derivatives of the rates of order `order`, in units of the radius and of the mean of the particles.
    fn linearise(&mut self, order: usize, state: &[f64], radii: &[f64]) -> Result<DMatrix<f64>, SpaceError> {
        let (degree, n) = (self.droplet.degree, count(self.droplet.degree));
        let least = order.max(1);
        let size = degree + 1 - least;
        let places: Vec<usize> = (least..=degree).map(|l| index(l, order as isize)).collect();
        let units = self.units();
        let mut matrix = DMatrix::zeros(2 * size, 2 * size);
        for column in 0..2 * size {
            let differences: &[(f64, f64)] = if order == 0 { &CENTRAL } else { &ODD };
            for &(multiple, weight) in differences {
                self.droplet.state.copy_from_slice(state);
                self.radii.copy_from_slice(radii);
                let (step, weight) = (multiple * DISTURBANCE, weight / DISTURBANCE);
                if column < size {
                    self.radii[places[column]] += step * units[0];
                } else {
                    self.droplet.state[3 * n + places[column - size]] += step * units[1];
                }
                self.evaluate(order == 0)?;
                for (row, &place) in places.iter().enumerate() {
                    matrix[(row, column)] += weight * self.rates[place] / units[0];
                    matrix[(row + size, column)] += weight * self.droplet.flow.rates[3 * n + place] / units[1];
                }
            }
        }
        Ok(matrix)
    }

    /// Units of the coefficients of radii and particles.
    fn units(&self) -> [f64; 2] {
        let n = count(self.droplet.degree);
        [self.droplet.radius * (4.0 * PI).sqrt(), self.droplet.state[3 * n]]
    }

    /// Computes the rates of the present radii and particles, the mean radius from the volume.
    fn evaluate(&mut self, restore: bool) -> Result<(), SpaceError> {
        let Self { droplet, radii, directions, solid_angles, rates, .. } = self;
        if restore {
            let mut values = vec![0.0; directions[0].len()];
            for _ in 0..8 {
                droplet.surface.grid.backward(radii, &mut values)?;
                let volume = droplet.surface.integral(|k| solid_angles[k] * values[k].powi(3)) / 3.0;
                let area = droplet.surface.integral(|k| solid_angles[k] * values[k].powi(2));
                let change = (volume - droplet.volume) / area;
                radii[0] -= change * (4.0 * PI).sqrt();
                if change.abs() < 1e-15 * droplet.radius {
                    break;
                }
            }
        }
        droplet.star_rates(directions, radii, rates)
    }

    /// Sets the unknowns: the radii and the particles of degree l = 1 .. p and order 0, in their units.
    fn set(&mut self, unknowns: &DVector<f64>) {
        let (degree, n, units) = (self.droplet.degree, count(self.droplet.degree), self.units());
        for l in 1..=degree {
            self.radii[index(l, 0)] = units[0] * unknowns[l - 1];
            self.droplet.state[3 * n + index(l, 0)] = units[1] * unknowns[degree + l - 1];
        }
    }

    /// Returns the residual: the rates of the unknowns, and the centroid in place of the translation.
    fn residual(&mut self, unknowns: &DVector<f64>, speed: f64) -> Result<DVector<f64>, SpaceError> {
        self.set(unknowns);
        self.evaluate(true)?;
        let (degree, n, units) = (self.droplet.degree, count(self.droplet.degree), self.units());
        let entry = |k: usize, _: usize| {
            if k == 0 {
                speed * self.droplet.surface.centroid(self.droplet.surface.volume())[2] / self.droplet.radius
            } else if k < degree {
                self.rates[index(k + 1, 0)] / units[0]
            } else {
                self.droplet.flow.rates[3 * n + index(k - degree + 1, 0)] / units[1]
            }
        };
        Ok(DVector::from_fn(2 * degree, entry))
    }

    /// Newton's method, with implicit time steps that become longer as the residual falls.
    fn iterate(&mut self) -> Result<(), SpaceError> {
        let (degree, n, units) = (self.droplet.degree, count(self.droplet.degree), self.units());
        let start = |k: usize, _: usize| {
            if k < degree {
                self.radii[index(k + 1, 0)] / units[0]
            } else {
                self.droplet.state[3 * n + index(k - degree + 1, 0)] / units[1]
            }
        };
        let mut unknowns = DVector::from_fn(2 * degree, start);
        // The rate scale of the centroid's condition and of convergence.
        let mut residual = self.residual(&unknowns, 1.0)?;
        let speed = self.droplet.rate_bound();
        residual[0] *= speed;
        let mut size = residual.amax();
        let mut step = FIRST_STEP / size.max(TOLERANCE * speed);
        let mut factors = None;
        for iteration in 1..=MOST {
            self.iterations = iteration;
            if size <= TOLERANCE * speed {
                self.set(&unknowns);
                return self.evaluate(true);
            }
            if factors.is_none() {
                let mut matrix = DMatrix::zeros(2 * degree, 2 * degree);
                for column in 0..2 * degree {
                    let mut moved = unknowns.clone();
                    moved[column] += STEP;
                    let change = (self.residual(&moved, speed)? - &residual) / -STEP;
                    matrix.set_column(column, &change);
                }
                for k in 1..2 * degree {
                    matrix[(k, k)] += 1.0 / step;
                }
                factors = Some(matrix.lu());
            }
            let solved = factors.as_ref().and_then(|factors| factors.solve(&residual));
            let Some(change) = solved.filter(|change| change.iter().all(|value| value.is_finite())) else { break };
            let moved = &unknowns + &change * (LONGEST / change.amax()).min(1.0);
            let found = self.residual(&moved, speed);
            match found {
                // Implicit steps may raise the residual, but not by much.
                Ok(found) if found.amax() < LARGEST_RISE * size => {
                    let before = std::mem::replace(&mut size, found.amax());
                    (unknowns, residual) = (moved, found);
                    if before < ROUND_OFF * speed && size > 0.5 * before {
                        self.set(&unknowns);
                        return self.evaluate(true);
                    }
                    step *= (before / size).clamp(0.5, 10.0) * 1.3;
                    if size > 0.1 * before {
                        factors = None;
                    }
                }
                _ => {
                    step *= 0.2;
                    factors = None;
                }
            }
        }
        Err(SpaceError::NoSteadyState { residual: size, iterations: self.iterations })
    }
}

#[cfg(test)]
mod tests;

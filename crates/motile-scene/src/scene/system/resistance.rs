//! Velocities of bodies whose forces depend on them.

use std::ops::Range;

use super::bodies::Bodies;
use crate::{FlowError, Hydrodynamics, Viscous};
use motile_base::{SolveReport, Vec2};

/// Part of the velocities, in the norm of the power of forces, by which stresses may miss them.
const TOLERANCE: f64 = 1e-8;
/// Part at which a solution is taken that comes no nearer, for flows that are iterated themselves.
const ACCEPTED: f64 = 1e-5;
/// Most iterations.
const MOST: usize = 400;
/// Iterations in which the residual has to fall by half once it could be accepted.
const PATIENCE: usize = 12;
/// Least size of the forces by which the response of the flow is measured, over all other forces: below it round-off of
/// the velocities would show.
const LEAST_FORCE: f64 = 1e-4;
/// Part of the velocities that forces could cause, if they did not cancel, up to which velocities are round-off.
const AT_REST: f64 = 1e-12;
/// Part of the sum of forces up to which their resultant is zero.
const ROUND_OFF: f64 = 1e-9;

/// Solves `(C + B M B^T) g = B V(F)` for the stresses g of [`Viscous`] bodies, V being the velocities of the flow for
/// given forces and `-B^T g` the forces of these stresses. V is affine in the forces, `V(F - f) = V(F) - M f` with a
/// symmetric and positive M, so that the matrix is symmetric and positive too. These are conjugate gradients with the
/// bodies' preconditioners. If motions are prescribed ([`Viscous::subtract_prescribed`]), they are taken off `B V(F)`.
#[derive(Debug, Default)]
pub(super) struct Resistance {
    /// All forces with the present stresses, and their change by the direction (force).
    forces: Vec<Vec2>,
    push: Vec<Vec2>,
    /// Velocities under these forces, and minus their change by the direction (length per time).
    found: Vec<Vec2>,
    change: Vec<Vec2>,
    compliances: Vec<f64>,
    stresses: Vec<f64>,
    residual: Vec<f64>,
    /// The residual after preconditioning.
    improved: Vec<f64>,
    direction: Vec<f64>,
    /// The matrix times the direction.
    image: Vec<f64>,
    balance: Balance,
}

/// The condition that stresses put no force on a fluid that nothing holds.
///
/// The flow of a force in the plane does not decay. Rates are then relative to a uniform velocity, the multiplier of
/// this condition: for example, the velocity of a substrate that floats.
#[derive(Debug, Default)]
struct Balance {
    /// Rates under uniform velocities along x and y, whose products with stresses are forces, and these rates after
    /// preconditioning; empty without the condition.
    rates: [Vec<f64>; 2],
    improved: [Vec<f64>; 2],
    /// Inverse of the products of both.
    inverse: [[f64; 2]; 2],
}

impl Balance {
    /// Prepares the condition for `count` stresses, with a list for the markers.
    fn update(&mut self, bodies: &mut Bodies, list: &mut [Vec2], count: usize, holds: bool) {
        let Self { rates, improved, inverse } = self;
        for ((rates, improved), unit) in rates.iter_mut().zip(&mut *improved).zip([Vec2::X, Vec2::Y]) {
            rates.clear();
            if holds {
                rates.resize(count, 0.0);
                list.fill(unit);
                write_rates(bodies, list, rates);
                improved.clone_from(rates);
                precondition(bodies, improved);
                list.fill(Vec2::ZERO);
                write_forces(bodies, improved, list);
                let all: f64 = list.iter().map(|force| force.length()).sum();
                // Where nothing resists a translation, rates are round-off.
                if dot(rates, improved) <= ROUND_OFF * all {
                    rates.clear();
                }
            }
        }
        let [[xx, xy], [yx, yy]] = [0, 1].map(|row| [0, 1].map(|column| dot(&rates[row], &improved[column])));
        let determinant = xx * yy - xy * yx;
        *inverse = if determinant > 0.0 {
            [[yy, -xy], [-yx, xx]].map(|row| row.map(|entry| entry / determinant))
        } else {
            [[0.0; 2]; 2]
        };
    }

    /// Takes the uniform velocity off rates, and with it the force off the stresses that preconditioning made of them.
    fn apply(&self, rates: &mut [f64], stresses: &mut [f64]) {
        let forces = [0, 1].map(|axis| dot(&self.rates[axis], stresses));
        for ((row, own), improved) in self.inverse.iter().zip(&self.rates).zip(&self.improved) {
            let share = row[0] * forces[0] + row[1] * forces[1];
            if share != 0.0 {
                rates.iter_mut().zip(own).for_each(|(rate, own)| *rate -= share * own);
                stresses.iter_mut().zip(improved).for_each(|(stress, improved)| *stress -= share * improved);
            }
        }
    }
}

/// Calls `act` with each viscous body, its markers, and its range of the stresses.
fn each(bodies: &mut Bodies, mut act: impl FnMut(&mut dyn Viscous, Range<usize>, Range<usize>)) {
    let Bodies { list, markers, .. } = bodies;
    let mut first = 0;
    for (body, group) in list.iter_mut().zip(markers.groups()) {
        if let Some(viscous) = body.as_viscous() {
            let next = first + viscous.stress_count();
            act(viscous, group.range.clone(), first..next);
            first = next;
        }
    }
}

/// Writes the rates of deformation of all bodies.
fn write_rates(bodies: &mut Bodies, velocities: &[Vec2], rates: &mut [f64]) {
    each(bodies, |body, markers, own| body.write_rates(&velocities[markers], &mut rates[own]));
}

/// Adds the forces of stresses of all bodies.
fn write_forces(bodies: &mut Bodies, stresses: &[f64], forces: &mut [Vec2]) {
    each(bodies, |body, markers, own| body.add_stress_forces(&stresses[own], &mut forces[markers]));
}

/// Preconditions rates of deformation of all bodies.
fn precondition(bodies: &mut Bodies, rates: &mut [f64]) {
    each(bodies, |body, _, own| body.precondition(&mut rates[own]));
}

/// Returns the refusal of a body that is held in the plane.
fn held_in_the_plane() -> FlowError {
    FlowError::unsupported(
        "a held body in the unbounded plane, where no steady flow around it exists because nothing takes up the force \
         on it (Stokes' paradox),",
        "Use a channel or a box, or let the body move freely",
    )
}

fn dot(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}

fn largest(forces: &[Vec2]) -> f64 {
    forces.iter().map(|force| force.length_squared()).fold(0.0, f64::max).sqrt()
}

impl Resistance {
    /// Makes the markers' forces and velocities fit each other.
    pub(super) fn solve<H: Hydrodynamics>(
        &mut self,
        flow: &mut H,
        bodies: &mut Bodies,
    ) -> Result<SolveReport, FlowError> {
        let mut report = flow.velocities(&mut bodies.markers)?;
        let mut count = 0;
        each(bodies, |_, _, own| count = own.end);
        if count == 0 {
            return Ok(report);
        }
        let view = flow.fluid_view();
        let unbounded =
            !flow.axisymmetric() && view.domain.walls.is_none() && view.domain.periods.iter().all(Option::is_none);
        // Markers on a substrate alone need no balance.
        let balanced = unbounded && view.shape_modes.is_some();
        let mut held = false;
        each(bodies, |body, _, _| held |= body.is_held());
        if balanced && held {
            return Err(held_in_the_plane());
        }
        self.begin(bodies, count, balanced);
        // Square of the size of the solution, in the norm of the power of its forces.
        let scale = self.improve(bodies);
        let noise = self.noise(bodies, view.viscosity, flow.axisymmetric());
        let scale = if scale <= noise { 0.0 } else { scale };
        let mut left = scale;
        // The latest stresses are near to the next ones, apart from their size.
        each(bodies, |body, _, own| self.direction[own].copy_from_slice(body.stresses()));
        // On the present shape they may add up to a force.
        self.balance.apply(&mut self.image, &mut self.direction);
        if scale > 0.0 && self.direction.iter().any(|stress| *stress != 0.0) {
            let length = self.measure(flow, bodies, 1.0)?;
            let step = dot(&self.direction, &self.residual) / length;
            if length > 0.0 && step.is_finite() {
                self.advance(step);
                left = self.improve(bodies);
            }
        }
        self.direction.copy_from_slice(&self.improved);
        // Square of the size of the direction in the same norm.
        let mut size = left;
        let (mut iterations, mut least, mut since) = (0, f64::INFINITY, 0);
        loop {
            let reached = if scale == 0.0 || left <= noise { 0.0 } else { (left / scale).sqrt() };
            if reached < 0.5 * least {
                (least, since) = (reached, 0);
            }
            let stuck = iterations >= MOST || since > PATIENCE;
            if reached <= TOLERANCE || (stuck && reached <= ACCEPTED) {
                report.residual = report.residual.max(reached);
                break;
            }
            if iterations >= MOST || reached.is_nan() {
                let what = "the velocities of bodies that resist them";
                return Err(FlowError::NoConvergence { what, iterations, residual: reached, tolerance: TOLERANCE });
            }
            (iterations, since) = (iterations + 1, since + 1);
            let length = self.measure(flow, bodies, (scale / size).sqrt())?;
            self.advance(left / length);
            let before = std::mem::replace(&mut left, self.improve(bodies));
            let kept = left / before;
            for (p, z) in self.direction.iter_mut().zip(&self.improved) {
                *p = *z + *p * kept;
            }
            size = left + kept * kept * size;
        }
        each(bodies, |body, _, own| body.set_stresses(&self.stresses[own]));
        if self.stresses.iter().any(|stress| *stress != 0.0) {
            let residual = report.residual;
            bodies.markers.forces.copy_from_slice(&self.forces);
            report = flow.velocities(&mut bodies.markers)?;
            report.residual = report.residual.max(residual);
        }
        Ok(report)
    }

    /// Starts with no stresses from the flow without them.
    fn begin(&mut self, bodies: &mut Bodies, count: usize, balanced: bool) {
        self.forces.clone_from(&bodies.markers.forces);
        self.found.clone_from(&bodies.markers.velocities);
        self.push.resize(self.forces.len(), Vec2::ZERO);
        self.change.resize(self.forces.len(), Vec2::ZERO);
        let Self { compliances, stresses, residual, improved, direction, image, .. } = self;
        for list in [&mut *compliances, stresses, residual, improved, direction, image] {
            list.resize(count, 0.0);
        }
        self.stresses.fill(0.0);
        each(bodies, |body, _, own| body.write_compliances(&mut self.compliances[own]));
        self.balance.update(bodies, &mut self.change, count, balanced);
        write_rates(bodies, &self.found, &mut self.residual);
        each(bodies, |body, _, own| body.subtract_prescribed(&mut self.residual[own]));
    }

    /// Returns the square of a size, in the norm of the power of forces, that is round-off. Around a droplet at rest,
    /// forces cancel, and velocities are round-off of the velocities that each of these forces causes.
    fn noise(&self, bodies: &Bodies, viscosity: f64, axisymmetric: bool) -> f64 {
        let force: f64 = self.forces.iter().map(|force| force.length()).sum();
        let fastest = largest(&self.found);
        // In the plane forces are lengths of lines times stresses.
        let size = if axisymmetric {
            bodies.markers.positions.iter().map(|place| place.y.abs()).fold(0.0, f64::max)
        } else {
            1.0
        };
        let noise = AT_REST * AT_REST * (force * force / (viscosity * size) + viscosity * size * fastest * fastest);
        if noise.is_finite() { noise } else { 0.0 }
    }

    /// Preconditions the residual, and returns the square of its size (power).
    fn improve(&mut self, bodies: &mut Bodies) -> f64 {
        self.improved.copy_from_slice(&self.residual);
        precondition(bodies, &mut self.improved);
        self.balance.apply(&mut self.residual, &mut self.improved);
        dot(&self.improved, &self.residual)
    }

    /// Computes the matrix times the direction, from the flow with `stretch` times the direction added to the stresses,
    /// and returns its product with the direction (power).
    fn measure<H: Hydrodynamics>(&mut self, flow: &mut H, bodies: &mut Bodies, stretch: f64) -> Result<f64, FlowError> {
        self.push.fill(Vec2::ZERO);
        write_forces(bodies, &self.direction, &mut self.push);
        let enough = LEAST_FORCE * largest(&self.forces) / largest(&self.push);
        let stretch = if enough.is_finite() { stretch.max(enough) } else { stretch };
        for ((force, now), push) in bodies.markers.forces.iter_mut().zip(&self.forces).zip(&self.push) {
            *force = *now + *push * stretch;
        }
        flow.velocities(&mut bodies.markers)?;
        for ((change, found), now) in self.change.iter_mut().zip(&self.found).zip(&bodies.markers.velocities) {
            *change = (*found - *now) / stretch;
        }
        write_rates(bodies, &self.change, &mut self.image);
        for ((image, p), compliance) in self.image.iter_mut().zip(&self.direction).zip(&self.compliances) {
            *image += compliance * p;
        }
        Ok(dot(&self.direction, &self.image))
    }

    /// Adds so much of the direction to the stresses.
    fn advance(&mut self, step: f64) {
        for ((stress, residual), (p, image)) in
            self.stresses.iter_mut().zip(&mut self.residual).zip(self.direction.iter().zip(&self.image))
        {
            *stress += step * p;
            *residual -= step * image;
        }
        for (force, push) in self.forces.iter_mut().zip(&self.push) {
            *force += step * *push;
        }
        for (found, change) in self.found.iter_mut().zip(&self.change) {
            *found -= step * *change;
        }
    }

    /// Writes the stresses of all bodies, which [`Resistance::restore`] takes back.
    pub(super) fn save(bodies: &mut Bodies) -> Vec<f64> {
        let mut stresses = Vec::new();
        each(bodies, |body, _, _| stresses.extend_from_slice(body.stresses()));
        stresses
    }

    /// Gives the bodies stresses that were found before at the same state, and the markers their forces.
    pub(super) fn restore(&mut self, bodies: &mut Bodies, stresses: &[f64]) {
        if stresses.len() != self.stresses.len() || stresses.is_empty() {
            return;
        }
        self.push.fill(Vec2::ZERO);
        for ((change, before), now) in self.direction.iter_mut().zip(&self.stresses).zip(stresses) {
            *change = *now - *before;
        }
        each(bodies, |body, markers, own| {
            body.add_stress_forces(&self.direction[own.clone()], &mut self.push[markers]);
            body.set_stresses(&stresses[own]);
        });
        bodies.markers.forces.iter_mut().zip(&self.push).for_each(|(force, push)| *force += *push);
    }
}

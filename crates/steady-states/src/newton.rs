//! Newton's method for steady states.

use nalgebra::DMatrix;

use crate::modes::Part;
use crate::state::{CROWDING, with_nodes};
use crate::system::{Along, Correction, Equations, Point, System};
use crate::{Parameter, Profile, SteadyError};

/// Iterations before giving up.
const MOST_ITERATIONS: usize = 30;
/// A correction of this size is the last one.
const SMALLEST: f64 = 3e-10;
/// Least part of a correction that is taken where the whole has no flow.
const LEAST_PART: f64 = 0.01;
/// Rates of this part of D/R^2, times the square of the nodes (they come from second derivatives), and lacks of area
/// and particles of this part of them, are none.
const NO_RATE: f64 = 1e-14;
const NO_LACK: f64 = 1e-11;
/// Rates beyond this part of D/R^2 are left where what is not solved for, the other symmetry, is not steady; the flow
/// of a mirror-symmetric droplet is so up to the error of its nodes.
const MOST_RATE: f64 = 0.1;
/// Corrections that shrink by this factor do with the matrix that there is.
const CONTRACTION: f64 = 0.1;
/// Largest correction of a coefficient that is taken whole.
const LARGEST: f64 = 0.3;
/// Largest offset from the base, over the radius, before another base is taken.
const FARTHEST: f64 = 0.15;
/// Last modes of this part of all are small enough on the way to a steady state.
pub(crate) const RESOLVED: f64 = 5e-4;
/// Last modes of this part of all lead nowhere.
const LOST: f64 = 0.1;
/// First step in time, in units of R^2/D.
const FIRST_STEP: f64 = 5e-3;
/// Steps in time before giving up.
const MOST_STEPS: usize = 80;
/// Largest change of a coefficient in a step, and growth of the rates.
const LARGEST_STEP: f64 = 0.35;
const GROWTH: f64 = 3.0;
/// A step changes the state by this much.
const USUAL_STEP: f64 = 0.15;

/// What an iteration needed and found.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub(crate) struct Outcome {
    pub(crate) iterations: usize,
    /// Largest rate of a coefficient (1/time).
    pub(crate) residual: f64,
    pub(crate) condition: f64,
}

/// What to do where no state is found.
pub(crate) const REMEDY: &str = "start from a run, from a neighbouring state or with more nodes";

impl System {
    /// Newton's method from a point, within a part; with an equation for the parameter also in that. The model is then
    /// that of the parameter found.
    pub(crate) fn newton(
        &mut self,
        point: &mut Point,
        part: Part,
        along: Option<&Along>,
    ) -> Result<Outcome, SteadyError> {
        let mut equations: Option<Equations> = None;
        let mut before = f64::INFINITY;
        let (mut residual, mut condition) = (f64::INFINITY, f64::NAN);
        for iteration in 1..=MOST_ITERATIONS {
            let rates = self.residual(point)?;
            residual = rates.amax();
            if !residual.is_finite() {
                break;
            }
            if iteration > 1 || along.is_none() {
                // At a branch point the equations are singular, and a state that is there already is one.
                let floor = NO_RATE * (self.model.nodes() as f64).powi(2) * self.model.diffusion_rate();
                if residual < floor && self.lack() < NO_LACK {
                    return Ok(Outcome { iterations: iteration - 1, residual, condition });
                }
            }
            let fresh = equations.is_none();
            let used = match equations.take() {
                Some(equations) => equations,
                None => {
                    let jacobian = self.rough_jacobian(point, part, &rates)?;
                    self.border(point, part, &jacobian, along)?
                }
            };
            if fresh {
                self.load(point)?;
            }
            condition = used.condition();
            let correction = self.correction(&used, &rates)?;
            let size = correction.state.amax().max(along.map_or(0.0, |along| {
                correction.parameter.abs() / along.parameter.get(&self.model.setup).unwrap_or(1.0).abs().max(0.01)
            }));
            if !fresh && size > CONTRACTION * before {
                before = f64::INFINITY;
                continue;
            }
            let mut part_of = (LARGEST / size).min(1.0);
            // A droplet beyond a wall has no flow: less of the correction then.
            while let Err(error) = self.corrected(point, &correction, part_of, along) {
                part_of *= 0.5;
                if part_of < LEAST_PART {
                    return Err(error);
                }
            }
            if size < SMALLEST {
                residual = self.residual(point)?.amax();
                if residual > MOST_RATE * self.model.diffusion_rate() {
                    return Err(SteadyError::NoConvergence { residual, iterations: iteration, remedy: REMEDY });
                }
                return Ok(Outcome { iterations: iteration, residual, condition });
            }
            if size < 1e-2 {
                equations = Some(used);
            }
            before = size;
        }
        Err(SteadyError::NoConvergence { residual, iterations: MOST_ITERATIONS, remedy: REMEDY })
    }

    /// Takes a part of a correction; on failure nothing has changed.
    fn corrected(
        &mut self,
        point: &mut Point,
        correction: &Correction,
        part_of: f64,
        along: Option<&Along>,
    ) -> Result<(), SteadyError> {
        let mut next = point.clone();
        next.state += part_of * &correction.state;
        for (frame, change) in next.frame.iter_mut().zip(correction.frame) {
            *frame += part_of * change;
        }
        let setup = self.model.setup.clone();
        let moved = match along {
            Some(along) => self.change(along.parameter, part_of * correction.parameter),
            None => Ok(()),
        };
        match moved.and_then(|()| self.load(&next)) {
            Ok(()) => *point = next,
            Err(error) => {
                *self = Self::new(&setup)?;
                return Err(error);
            }
        }
        Ok(())
    }

    /// Largest relative lack of area or particles of the loaded state.
    fn lack(&self) -> f64 {
        let (present, wanted) = (self.model.present(), self.model.conserved());
        present.iter().zip(wanted).map(|(a, b)| (a / b - 1.0).abs()).fold(0.0, f64::max)
    }

    /// Goes over to another value of a parameter.
    pub(crate) fn change(&mut self, parameter: Parameter, by: f64) -> Result<(), SteadyError> {
        let setup = &self.model.setup;
        let value = parameter.get(setup).unwrap_or(0.0) + by;
        let evaluations = self.model.evaluations;
        *self = Self::new(&parameter.with(setup, value)?)?;
        self.model.evaluations += evaluations;
        Ok(())
    }

    /// Size of the last modes over that of all, of shape or concentration.
    pub(crate) fn tail(&self, point: &Point) -> Result<f64, SteadyError> {
        Ok(self.profile(point).tails()?.into_iter().fold(0.0, |largest, (_, tail)| tail.max(largest)))
    }

    /// Whether the droplet is far from its base.
    pub(crate) fn is_far(&self, point: &Point) -> bool {
        let (offsets, _) = self.modes.synthesise(&point.state);
        offsets[..self.modes.nodes()].iter().any(|h| h.abs() > FARTHEST * self.model.radius)
    }

    /// The same droplet over itself, with nodes placed anew.
    pub(crate) fn rebased(&mut self, point: &Point) -> Result<Point, SteadyError> {
        let nodes = self.model.nodes();
        let profile = centred(self.profile(point).resampled(nodes, CROWDING)?)?;
        self.point(&profile, point.frame)
    }

    /// Goes towards a steady state by implicit steps in time, which grow as the rates fall, until one of the time R^2/D
    /// or more changes the state by less than `steady`; with more nodes, up to `most_nodes`, where they are needed on
    /// the way (none: the nodes stay).
    pub(crate) fn settle(
        &mut self,
        point: &mut Point,
        part: Part,
        most_nodes: usize,
        steady: f64,
    ) -> Result<usize, SteadyError> {
        let unit = 1.0 / self.model.diffusion_rate();
        let mut step = FIRST_STEP * unit;
        let mut rates = self.residual(point)?;
        let mut last = rates.amax();
        for count in 0..MOST_STEPS {
            let jacobian = self.rough_jacobian(point, part, &rates)?;
            loop {
                let damped = &jacobian - DMatrix::identity(jacobian.nrows(), jacobian.ncols()) / step;
                let equations = self.border(point, part, &damped, None)?;
                let correction = self.correction(&equations, &rates)?;
                let mut trial = point.clone();
                trial.state += &correction.state;
                for (frame, change) in trial.frame.iter_mut().zip(correction.frame) {
                    *frame += change;
                }
                let size = correction.state.amax();
                let found = if size < LARGEST_STEP {
                    self.residual(&trial).map(|rates| (rates, trial))
                } else {
                    Err(SteadyError::NoConvergence { residual: last, iterations: count, remedy: REMEDY })
                };
                match found {
                    Ok((next_rates, next)) if next_rates.amax().is_finite() && next_rates.amax() < GROWTH * last => {
                        let residual = next_rates.amax();
                        if size < steady && step > unit {
                            *point = self.rebased(&next)?;
                            return Ok(count + 1);
                        }
                        step *= (USUAL_STEP / size).clamp(0.5, 2.0);
                        (*point, rates, last) = (next, next_rates, residual);
                        if self.is_far(point) || (most_nodes > 0 && self.tail(point)? > RESOLVED) {
                            *point = self.rebased(point)?;
                            while self.tail(point)? > RESOLVED && self.model.nodes() < most_nodes {
                                let nodes = (self.model.nodes() / 8 * 10).min(most_nodes);
                                let profile = self.profile(point).resampled(nodes, CROWDING)?;
                                *self = Self::new(&with_nodes(&self.model.setup, nodes))?;
                                *point = self.point(&profile, point.frame)?;
                            }
                            let tail = self.tail(point)?;
                            if most_nodes > 0 && tail > LOST {
                                let nodes = self.model.nodes();
                                return Err(SteadyError::Unresolved { what: "droplet on its way", nodes, tail });
                            }
                            rates = self.residual(point)?;
                            last = rates.amax();
                        }
                        break;
                    }
                    _ if step > 1e-6 * unit => {
                        step *= 0.4;
                        self.load(point)?;
                    }
                    Err(error) => return Err(error),
                    Ok(_) => {
                        return Err(SteadyError::NoConvergence { residual: last, iterations: count, remedy: REMEDY });
                    }
                }
            }
        }
        Err(SteadyError::NoConvergence { residual: last, iterations: MOST_STEPS, remedy: REMEDY })
    }
}

/// The same droplet with its centroid at x = 0.
pub(crate) fn centred(mut profile: Profile) -> Result<Profile, SteadyError> {
    profile.shift(-profile.moments()?.centroid.x);
    Ok(profile)
}

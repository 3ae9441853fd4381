//! Change of a steady state with a parameter.

use motile_base::internal::Refuse as _;
use nalgebra::{DMatrix, DVector, Dyn, LU};

use crate::modes::Part;
use crate::stencil::Stencil;
use crate::system::{Correction, DIFFERENCE, Equations, Point, System};
use crate::{Parameter, SteadyError, SteadyState};

/// Change of the coefficients in a step of differences, in units of the radius and the mean density. The tension's
/// corner is a tenth of the mean density wide, so the error of sixth order is below round-off.
const AMPLITUDE: f64 = 1e-3;
/// Largest step of a parameter over its size.
const LARGEST: f64 = 0.01;
/// Farthest value of a parameter that differences use, over its size.
const REACH: f64 = 3.0 * LARGEST;
/// Parts of the usual steps that are tried if these fail.
const SHORTER: [f64; 2] = [0.1, 0.01];
/// Most corrections of a response, and their relative size below which the next one is round-off.
const MOST_CORRECTIONS: usize = 6;
const SMALL: f64 = 1e-6;

/// Derivative of a state by a parameter (per unit of the parameter).
#[derive(Debug, Clone)]
pub(crate) struct Response {
    pub(crate) parameter: Parameter,
    pub(crate) tangent: Tangent,
    /// Multiplier of the left null vector of singular equations; zero where equations are regular.
    pub(crate) multiplier: f64,
    /// Rule and step of the parameter for total derivatives.
    pub(crate) stencil: Stencil,
    pub(crate) step: f64,
}

/// Direction in the space of states and frames.
#[derive(Debug, Clone)]
pub(crate) struct Tangent {
    pub(crate) state: DVector<f64>,
    pub(crate) frame: [f64; 3],
}

impl Tangent {
    /// Returns the point at an amount of this direction.
    pub(crate) fn from(&self, point: &Point, amount: f64) -> Point {
        let mut moved = point.clone();
        moved.state += amount * &self.state;
        moved.frame.iter_mut().zip(self.frame).for_each(|(frame, change)| *frame += amount * change);
        moved
    }

    fn add(&mut self, correction: &Correction) {
        self.state += &correction.state;
        self.frame.iter_mut().zip(correction.frame).for_each(|(frame, change)| *frame += change);
    }
}

/// Equations of the steady state `G(y, p) = 0` at a state, factorised: rates of change of the coefficients, area and
/// number of particles, with the motion of the frame among the unknowns.
///
/// The response `dy/dp` solves `G_y dy/dp + G_p = 0`. It is found by corrections: the total derivative
/// `d/dp G(y + y' p, p)` is computed by differences of sixth order of G along `y'`, and a solve with the factors of
/// G_y takes it to zero. So the differences set the error, and not G_y.
pub(crate) struct Linearised {
    pub(crate) system: System,
    pub(crate) point: Point,
    equations: Equations,
    factors: LU<f64, Dyn, Dyn>,
    /// True if the equations are bordered by their null vectors.
    singular: bool,
    /// System that values of parameters are tried in: it keeps what the flow has computed for the region.
    spare: Option<System>,
}

impl Linearised {
    /// Linearises the equations about a state.
    pub(crate) fn new(state: &SteadyState) -> Result<Self, SteadyError> {
        let mut system = System::new(state.setup())?;
        let point = state.point().clone();
        let equations = system.equations(&point, state.part(), None)?;
        let factors = equations.matrix().clone().lu();
        Ok(Self { system, point, equations, factors, singular: false, spare: None })
    }

    /// Borders the equations by their null vectors, at a state where a disturbance of the same symmetry neither grows
    /// nor decays. Responses are then at right angles to it.
    pub(crate) fn border(&mut self) -> Result<(), SteadyError> {
        let matrix = self.equations.matrix();
        let n = matrix.nrows();
        let null = |matrix: &DMatrix<f64>| {
            let lu = matrix.clone().lu();
            let mut vector = DVector::from_fn(n, |k, _| 1.0 + 0.3 * (k as f64).sin());
            for _ in 0..4 {
                vector = lu
                    .solve(&vector)
                    .filter(|v| v.iter().all(|x| x.is_finite()))
                    .ok_or_else(|| SteadyError::singular("a critical point", "Use another number of nodes"))?;
                vector /= vector.norm();
            }
            Ok::<_, SteadyError>(vector)
        };
        let (right, left) = (null(matrix)?, null(&matrix.transpose())?);
        let unit = self.system.model.rate_unit();
        let mut whole = DMatrix::zeros(n + 1, n + 1);
        whole.view_mut((0, 0), (n, n)).copy_from(matrix);
        whole.view_mut((0, n), (n, 1)).copy_from(&(unit * left));
        whole.view_mut((n, 0), (1, n)).copy_from(&(unit * right.transpose()));
        (self.factors, self.singular) = (whole.lu(), true);
        Ok(())
    }

    /// Returns the part of the state space of the equations.
    pub(crate) fn part(&self) -> Part {
        self.equations.part()
    }

    /// Returns the slowest rate of disturbances with the symmetry of the state (1/time), by inverse iteration. At zero,
    /// the equations are singular. If the rate belongs to a complex pair, its absolute value is returned.
    pub(crate) fn slowest(&self) -> f64 {
        let rates = self.system.modes.part(self.part()).len();
        let mut vector = DVector::from_fn(self.factors.l().nrows(), |k, _| if k < rates { 1.0 } else { 0.0 });
        let mut rate = f64::NAN;
        for _ in 0..12 {
            vector /= vector.norm();
            let Some(next) = self.factors.solve(&vector) else { return 0.0 };
            let next = DVector::from_fn(next.len(), |k, _| if k < rates { next[k] } else { 0.0 });
            rate = 1.0 / next.dot(&vector);
            vector = next;
        }
        rate
    }

    /// Returns the response to a parameter. Steps of it are shortened if a value has no flow, such as a width at which
    /// the droplet would reach into a wall.
    pub(crate) fn response(&mut self, parameter: Parameter) -> Result<Response, SteadyError> {
        let mut outcome = self.response_with(parameter, 1.0);
        for shorter in SHORTER {
            if outcome.is_ok() {
                break;
            }
            outcome = self.response_with(parameter, shorter);
        }
        outcome
    }

    /// Returns the response to a parameter, from steps of the usual size times `part`.
    fn response_with(&mut self, parameter: Parameter, part: f64) -> Result<Response, SteadyError> {
        let setup = self.system.model.setup.clone();
        let (value, natural) = (parameter.get(&setup).unwrap_or(f64::NAN), part * parameter.scale(&setup));
        let allowed = |by: f64| parameter.with(&setup, value + by).is_ok_and(|setup| setup.check().is_ok());
        // A value far below its natural size allows no step of that size to the other side of zero.
        let below = allowed(-REACH * natural);
        let scale = if below || value == 0.0 || allowed(REACH * natural) { natural } else { part * value.abs() };
        let below = below || scale < natural;
        let stencil = if below { Stencil::CENTRAL } else { Stencil::FORWARD };
        let mut tangent = Tangent { state: DVector::zeros(self.point.state.len()), frame: [0.0; 3] };
        let mut step = if below { 0.1 } else { 0.03 } * LARGEST * scale;
        let (mut multiplier, mut before) = (0.0, f64::INFINITY);
        for _ in 0..MOST_CORRECTIONS {
            let response = Response { parameter, tangent: tangent.clone(), multiplier, stencil, step };
            let unit = self.system.model.rate_unit();
            let total = self.total(&response, |equations, system, point| {
                let rates = system.residual(point)?;
                Ok(equations.right(system, &rates, system.model.lacks(), unit))
            })?;
            let correction = self.solve(total)?;
            multiplier += if self.singular { correction[correction.len() - 1] } else { 0.0 };
            let correction = self.equations.correction(&self.system, &correction.rows(0, self.equations.len()).into());
            tangent.add(&correction);
            let (change, size) = (correction.state.amax(), tangent.state.amax());
            step = (AMPLITUDE / size).min(if below { LARGEST } else { 0.3 * LARGEST } * scale);
            if change <= SMALL * size || change >= before || size * scale < DIFFERENCE * DIFFERENCE {
                break;
            }
            before = change;
        }
        Ok(Response { parameter, tangent, multiplier, stencil, step })
    }

    /// Returns the total derivative by a parameter, along a response, of a function of system and point.
    pub(crate) fn total(
        &mut self,
        response: &Response,
        mut function: impl FnMut(&Equations, &mut System, &Point) -> Result<DVector<f64>, SteadyError>,
    ) -> Result<DVector<f64>, SteadyError> {
        let Response { parameter, tangent, stencil, step, .. } = response;
        let value = parameter.get(&self.system.model.setup).unwrap_or(f64::NAN);
        let mut system = Some(match self.spare.take() {
            Some(spare) => spare,
            None => self.system.moved(*parameter, 0.0)?,
        });
        let total = stencil.derivative(*step, |by| {
            let mut moved = system.take().ok_or_else(singular)?.retuned(*parameter, value + by)?;
            let found = function(&self.equations, &mut moved, &tangent.from(&self.point, by));
            system = Some(moved);
            found
        })?;
        self.spare = system.map(|system| system.retuned(*parameter, value)).transpose()?;
        Ok(total)
    }

    fn solve(&self, right: DVector<f64>) -> Result<DVector<f64>, SteadyError> {
        let right = if self.singular { right.push(0.0) } else { right };
        self.factors.solve(&right).filter(|x| x.iter().all(|value| value.is_finite())).ok_or_else(singular)
    }
}

/// Returns the error for a state whose derivatives are infinite.
pub(crate) fn singular() -> SteadyError {
    SteadyError::refused(
        "this state has no sensitivities",
        "its equations are singular, as at a fold or a branch point",
        "Change a parameter a little, or ask for the sensitivities of the critical point",
    )
}

//! The equations of a steady state, their derivative, and what makes them regular.

use motile::ib_core::Vec2;
use nalgebra::{DMatrix, DVector, Dyn, LU};

use crate::model::{Base, FrameMotion, Model};
use crate::modes::{Modes, Part};
use crate::{Parameter, Profile, SteadyError};

/// Relative change of a parameter for its derivative.
const PARAMETER_STEP: f64 = 1e-5;
/// A turning of less effect than this is none: the droplet is round.
const LEAST_TURN: f64 = 1e-7;

/// A state over a base curve, in a frame of its own.
#[derive(Debug, Clone)]
pub(crate) struct Point {
    pub(crate) base: Base,
    pub(crate) state: DVector<f64>,
    pub(crate) frame: FrameMotion,
}

/// An equation for the parameter besides those of the state: `along . (state, parameter) = 0` for a correction.
#[derive(Debug, Clone)]
pub(crate) struct Along {
    pub(crate) parameter: Parameter,
    /// Coefficients of the part, then that of the parameter.
    pub(crate) direction: DVector<f64>,
}

/// A correction of a point.
#[derive(Debug, Clone)]
pub(crate) struct Correction {
    pub(crate) state: DVector<f64>,
    pub(crate) frame: FrameMotion,
    pub(crate) parameter: f64,
}

/// Linear equations for a correction, factorised.
pub(crate) struct Equations {
    matrix: DMatrix<f64>,
    lu: LU<f64, Dyn, Dyn>,
    part: Part,
    motions: Vec<FrameMotion>,
}

/// The equations of a description.
#[derive(Debug)]
pub(crate) struct System {
    pub(crate) model: Model,
    pub(crate) modes: Modes,
}

impl System {
    pub(crate) fn new(setup: &motile::Setup) -> Result<Self, SteadyError> {
        let model = Model::new(setup)?;
        let scales = [model.radius, model.radius * model.concentration];
        let modes = Modes::new(model.nodes(), scales, model.nuclei())?;
        Ok(Self { model, modes })
    }

    /// A profile as a point over itself, its centre at x = 0, or over an earlier base.
    pub(crate) fn point(&mut self, profile: &Profile, frame: FrameMotion) -> Result<Point, SteadyError> {
        let base = Base::new(profile)?;
        let x = profile.nuclei.iter().map(|centre| centre.x);
        let y = profile.nuclei.iter().map(|centre| centre.y);
        let offsets: Vec<f64> = std::iter::repeat_n(0.0, profile.nodes()).chain(x).collect();
        let density: Vec<f64> = profile.density.iter().copied().chain(y).collect();
        let state = self.modes.analyse(&offsets, &density)?;
        Ok(Point { base, state, frame })
    }

    pub(crate) fn profile(&self, point: &Point) -> Profile {
        let (offsets, mut density) = self.modes.synthesise(&point.state);
        let shifted = point.base.positions.iter().zip(&point.base.normals).zip(&offsets);
        let positions: Vec<Vec2> = shifted.map(|((x, n), h)| *x + *h * *n).collect();
        let y = density.split_off(positions.len());
        let nuclei = offsets[positions.len()..].iter().zip(y).map(|(x, y)| Vec2::new(*x, y)).collect();
        Profile { positions, density, nuclei }
    }

    pub(crate) fn load(&mut self, point: &Point) -> Result<(), SteadyError> {
        let (offsets, density) = self.modes.synthesise(&point.state);
        self.model.load(&point.base, &offsets, &density)
    }

    /// Rates of all coefficients (1/time).
    pub(crate) fn residual(&mut self, point: &Point) -> Result<DVector<f64>, SteadyError> {
        self.load(point)?;
        let (h, m) = self.model.rates(&point.base, point.frame)?;
        self.modes.analyse(h, m)
    }

    /// Derivative of the rates of a part by the coefficients of it (1/time), by central differences.
    pub(crate) fn jacobian(&mut self, point: &Point, part: Part) -> Result<DMatrix<f64>, SteadyError> {
        self.differences(point, part, 1e-5, None)
    }

    /// The same by differences from the rates at the point, at half the cost: to six digits, which are enough on the
    /// way to a state.
    pub(crate) fn rough_jacobian(
        &mut self,
        point: &Point,
        part: Part,
        rates: &DVector<f64>,
    ) -> Result<DMatrix<f64>, SteadyError> {
        self.differences(point, part, 1e-6, Some(rates))
    }

    /// Differences over a step, which is less for short waves; with the rates at the point to one side.
    fn differences(
        &mut self,
        point: &Point,
        part: Part,
        step: f64,
        rates: Option<&DVector<f64>>,
    ) -> Result<DMatrix<f64>, SteadyError> {
        let range = self.modes.part(part);
        let (offsets, density) = self.modes.synthesise(&point.state);
        let mut jacobian = DMatrix::zeros(range.len(), range.len());
        for (column, index) in range.clone().enumerate() {
            let step = step / (1.0 + 0.1 * self.modes.wave(index) as f64);
            let mut side = |amount: f64| {
                let (mut h, mut m) = (offsets.clone(), density.clone());
                self.modes.perturb(index, amount, &mut h, &mut m);
                self.model.load(&point.base, &h, &m)?;
                let (h, m) = self.model.rates(&point.base, point.frame)?;
                self.modes.analyse(h, m)
            };
            let difference = match rates {
                Some(rates) => (side(step)? - rates) / step,
                None => (side(step)? - side(-step)?) / (2.0 * step),
            };
            jacobian.column_mut(column).copy_from(&difference.rows(range.start, range.len()));
        }
        Ok(jacobian)
    }

    /// Rigid motions that leave the equations as they are and concern a part.
    pub(crate) fn motions(&self, part: Part) -> Vec<FrameMotion> {
        let (plane, channel) = (self.model.in_plane(), self.model.in_channel());
        let all = [([1.0, 0.0, 0.0], false, true), ([0.0, 1.0, 0.0], true, !channel), ([0.0, 0.0, 1.0], true, plane)];
        let fits = |odd: bool| part == Part::Full || odd == (part == Part::Odd);
        all.into_iter().filter(|(_, odd, there)| *there && fits(*odd)).map(|(motion, ..)| motion).collect()
    }

    /// What motions do to the coefficients of a part of the loaded state; those without effect are left out.
    pub(crate) fn generators(
        &mut self,
        base: &Base,
        part: Part,
    ) -> Result<(Vec<FrameMotion>, Vec<DVector<f64>>), SteadyError> {
        let range = self.modes.part(part);
        let (mut motions, mut generators) = (Vec::new(), Vec::new());
        for motion in self.motions(part) {
            let (h, m) = self.model.rigid_rates(base, motion)?;
            let generator = self.modes.analyse(h, m)?.rows(range.start, range.len()).into_owned();
            if generator.norm() > LEAST_TURN {
                motions.push(motion);
                generators.push(generator);
            }
        }
        Ok((motions, generators))
    }

    /// Derivatives of area and number of particles, over their values for a circle, by the coefficients of a part of
    /// the loaded state.
    pub(crate) fn conserved_gradients(&mut self, base: &Base, part: Part) -> Result<[DVector<f64>; 2], SteadyError> {
        let range = self.modes.part(part);
        // The integral of a coefficient's function times the gradient at the nodes: half of its Fourier coefficient,
        // but for the mean.
        let area = self.model.area_gradient(base);
        let zeros = vec![0.0; area.len()];
        let mut gradient = self.modes.analyse(&area, &zeros)?;
        for (index, value) in gradient.iter_mut().enumerate() {
            *value *= if self.modes.wave(index) == 0 { 2.0 } else { 1.0 };
        }
        let mut number = DVector::zeros(self.modes.len());
        number[self.modes.index(true, false, 0)] = 1.0;
        Ok([gradient, number].map(|full| full.rows(range.start, range.len()).into_owned()))
    }

    /// Derivative of the rates by a parameter (1/time per its unit).
    fn parameter_derivative(&mut self, point: &Point, parameter: Parameter) -> Result<DVector<f64>, SteadyError> {
        let setup = self.model.setup.clone();
        let value = parameter.get(&setup).unwrap_or(0.0);
        let step = PARAMETER_STEP * value.abs().max(0.01);
        let rates = |value: f64| System::new(&parameter.with(&setup, value)?)?.residual(point);
        Ok((rates(value + step)? - rates(value - step)?) / (2.0 * step))
    }

    /// The equations for a correction at a point.
    pub(crate) fn equations(
        &mut self,
        point: &Point,
        part: Part,
        along: Option<&Along>,
    ) -> Result<Equations, SteadyError> {
        let jacobian = self.jacobian(point, part)?;
        self.border(point, part, &jacobian, along)
    }

    /// The same with a Jacobian that is there.
    pub(crate) fn border(
        &mut self,
        point: &Point,
        part: Part,
        jacobian: &DMatrix<f64>,
        along: Option<&Along>,
    ) -> Result<Equations, SteadyError> {
        let range = self.modes.part(part);
        self.load(point)?;
        let (motions, generators) = self.generators(&point.base, part)?;
        let conserved = self.conserved_gradients(&point.base, part)?;
        let (n, frames) = (range.len(), motions.len());
        let size = n + frames + 2 + usize::from(along.is_some());
        let mut matrix = DMatrix::zeros(size, size);
        matrix.view_mut((0, 0), (n, n)).copy_from(jacobian);
        for (k, generator) in generators.iter().enumerate() {
            matrix.view_mut((0, n + k), (n, 1)).copy_from(&-generator);
            matrix.view_mut((n + k, 0), (1, n)).copy_from(&generator.transpose());
        }
        // Sources that do nothing in a solution, since area and number are conserved.
        for (k, gradient) in conserved.iter().enumerate() {
            matrix[(self.modes.index(k == 1, false, 0), n + frames + k)] = 1.0;
            matrix.view_mut((n + frames + k, 0), (1, n)).copy_from(&gradient.transpose());
        }
        if let Some(Along { parameter, direction }) = along {
            let derivative = self.parameter_derivative(point, *parameter)?;
            matrix.view_mut((0, size - 1), (n, 1)).copy_from(&derivative.rows(range.start, n));
            matrix.view_mut((size - 1, 0), (1, n)).copy_from(&direction.rows(0, n).transpose());
            matrix[(size - 1, size - 1)] = direction[n];
            self.load(point)?;
        }
        Ok(Equations { lu: matrix.clone().lu(), matrix, part, motions })
    }

    /// The correction that takes the rates of a point to zero, or of the last equation to `excess`.
    pub(crate) fn correction(
        &mut self,
        equations: &Equations,
        residual: &DVector<f64>,
    ) -> Result<Correction, SteadyError> {
        let range = self.modes.part(equations.part);
        let mut right = DVector::zeros(equations.matrix.nrows());
        right.rows_mut(0, range.len()).copy_from(&-residual.rows(range.start, range.len()));
        let [area, number] = self.model.present();
        let conserved = self.model.conserved();
        let lacks = [1.0 - area / conserved[0], 1.0 - number / conserved[1]];
        for (k, lack) in lacks.into_iter().enumerate() {
            right[range.len() + equations.motions.len() + k] = lack;
        }
        equations.solve(&right).map(|solution| equations.correction(self, &solution))
    }
}

impl Equations {
    /// Solution for a right-hand side.
    pub(crate) fn solve(&self, right: &DVector<f64>) -> Result<DVector<f64>, SteadyError> {
        let singular = || SteadyError::Singular {
            what: "a steady state",
            remedy: "start from another state or go on from a neighbour",
        };
        self.lu.solve(right).filter(|x| x.iter().all(|value| value.is_finite())).ok_or_else(singular)
    }

    /// Number of equations.
    pub(crate) fn len(&self) -> usize {
        self.matrix.nrows()
    }

    /// A solution by what it is of.
    pub(crate) fn correction(&self, system: &System, solution: &DVector<f64>) -> Correction {
        let range = system.modes.part(self.part);
        let mut state = DVector::zeros(system.modes.len());
        state.rows_mut(range.start, range.len()).copy_from(&solution.rows(0, range.len()));
        let mut frame = [0.0; 3];
        for (k, motion) in self.motions.iter().enumerate() {
            for (total, part) in frame.iter_mut().zip(motion) {
                *total += part * solution[range.len() + k];
            }
        }
        let with_parameter = self.len() > range.len() + self.motions.len() + 2;
        let parameter = if with_parameter { solution[self.len() - 1] } else { 0.0 };
        Correction { state, frame, parameter }
    }

    /// Condition number in the 1-norm, rows being scaled to a largest entry of one; infinite if singular.
    pub(crate) fn condition(&self) -> f64 {
        let mut scaled = self.matrix.clone();
        for mut row in scaled.row_iter_mut() {
            let largest = row.amax();
            row /= largest;
        }
        let norm =
            |matrix: &DMatrix<f64>| matrix.column_iter().map(|c| c.iter().map(|v| v.abs()).sum()).fold(0.0, f64::max);
        let size = norm(&scaled);
        scaled.try_inverse().map_or(f64::INFINITY, |inverse| size * norm(&inverse))
    }
}

//! Equations of a steady state, their derivative, and the bordering that makes it regular.

use motile_base::Vec2;
use nalgebra::{DMatrix, DVector, Dyn, LU};

use crate::iteration::USUAL_CHANGE;
use crate::model::{Base, FrameMotion, Model};
use crate::modes::{Modes, Part};
use crate::profile::CROWDING;
use crate::stencil::Stencil;
use crate::{Parameter, Profile, SteadyError};

/// Relative step of central differences: the cube root of the round-off of rates (1e-15), where it and the truncation
/// leave an error of 1e-10.
pub(crate) const DIFFERENCE: f64 = 1e-5;
/// Step of differences of sixth order: the tension's corner is a tenth of the mean density wide.
const FINE_DIFFERENCE: f64 = 1e-3;
/// Derivatives of the coefficients below this are zero: turning a round droplet, or the area in antisymmetric shapes.
pub(crate) const NO_EFFECT: f64 = 1e-7;

/// State over a base curve, in a frame that moves.
#[derive(Debug, Clone)]
pub(crate) struct Point {
    pub(crate) base: Base,
    pub(crate) state: DVector<f64>,
    pub(crate) frame: FrameMotion,
}

impl Point {
    /// Returns the point after a fraction of a correction.
    pub(crate) fn corrected(&self, correction: &Correction, part: f64) -> Self {
        let mut next = self.clone();
        next.state += part * &correction.state;
        for (frame, change) in next.frame.iter_mut().zip(correction.frame) {
            *frame += part * change;
        }
        next
    }
}

/// Equation for a parameter in addition to the equations of the state: corrections are at right angles to a direction,
/// `direction . (state, parameter) = 0`.
#[derive(Debug, Clone)]
pub(crate) struct Along {
    pub(crate) parameter: Parameter,
    /// Component for each coefficient of the part, then the one for the parameter.
    pub(crate) direction: DVector<f64>,
}

/// Correction of state, frame and parameter.
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
    /// Number of conserved quantities.
    conserved: usize,
}

/// Equations of a description at its nodes.
#[derive(Debug)]
pub(crate) struct System {
    pub(crate) model: Model,
    pub(crate) modes: Modes,
    /// Derivatives of the number of particles that diffuse inside, over that on the circle at rest, by the coefficients
    /// of the part that the last Jacobian is of.
    by_diffusing: DVector<f64>,
}

impl System {
    pub(crate) fn new(setup: &motile::setup::Setup) -> Result<Self, SteadyError> {
        Self::of(Model::new(setup)?)
    }

    fn of(model: Model) -> Result<Self, SteadyError> {
        let scales = [model.radius, model.radius * model.concentration];
        let modes = Modes::new(model.nodes(), scales, model.nuclei())?;
        Ok(Self { model, modes, by_diffusing: DVector::zeros(0) })
    }

    /// Returns the system at another value of a parameter.
    pub(crate) fn moved(&self, parameter: Parameter, by: f64) -> Result<Self, SteadyError> {
        let setup = &self.model.setup;
        let mut moved = Self::new(&parameter.with(setup, parameter.get(setup).unwrap_or(0.0) + by)?)?;
        moved.model.adopt(&self.model);
        Ok(moved)
    }

    /// Returns this system at another value of a parameter ([`Model::retuned`]).
    pub(crate) fn retuned(self, parameter: Parameter, value: f64) -> Result<Self, SteadyError> {
        let setup = parameter.with(&self.model.setup, value)?;
        Self::of(self.model.retuned(&setup)?)
    }

    /// Returns the profile as a point over itself: offsets zero.
    pub(crate) fn point(&mut self, profile: &Profile, frame: FrameMotion) -> Result<Point, SteadyError> {
        let base = Base::new(profile)?;
        let x = profile.nuclei.iter().map(|centre| centre.x);
        let y = profile.nuclei.iter().map(|centre| centre.y);
        let offsets: Vec<f64> = std::iter::repeat_n(0.0, profile.nodes()).chain(x).collect();
        let density: Vec<f64> = profile.density.iter().copied().chain(y).collect();
        let state = self.modes.analyse(&offsets, &density)?;
        Ok(Point { base, state, frame })
    }

    /// Returns the droplet of a point.
    pub(crate) fn profile(&self, point: &Point) -> Profile {
        self.profile_over(&point.base, &point.state)
    }

    /// Returns the droplet of a state over a curve.
    pub(crate) fn profile_over(&self, base: &Base, state: &DVector<f64>) -> Profile {
        let (offsets, mut density) = self.modes.synthesise(state);
        let positions: Vec<Vec2> = base.displaced(&offsets).collect();
        let y = density.split_off(positions.len());
        let nuclei = offsets[positions.len()..].iter().zip(y).map(|(x, y)| Vec2::new(*x, y)).collect();
        Profile { positions, density, nuclei }
    }

    /// Returns the ratio of the last Fourier coefficients of a point to the largest, of shape or density.
    pub(crate) fn tail(&self, point: &Point) -> Result<f64, SteadyError> {
        Ok(self.profile(point).tails()?.into_iter().fold(0.0, |largest, (_, tail)| tail.max(largest)))
    }

    /// Returns true if offsets from the base are so large that nodes along its normals serve the droplet badly.
    pub(crate) fn is_far(&self, point: &Point) -> bool {
        let (offsets, _) = self.modes.synthesise(&point.state);
        offsets[..self.modes.nodes()].iter().any(|h| h.abs() > USUAL_CHANGE * self.model.radius)
    }

    /// Returns the droplet of a point as its own base, with redistributed nodes.
    pub(crate) fn rebased(&mut self, point: &Point) -> Result<Point, SteadyError> {
        let profile = self.profile(point).resampled(self.model.nodes(), CROWDING)?.centred()?;
        self.point(&profile, point.frame)
    }

    /// Takes over a point and solves for its flow.
    pub(crate) fn load(&mut self, point: &Point) -> Result<(), SteadyError> {
        let (offsets, density) = self.modes.synthesise(&point.state);
        self.model.load(&point.base, &offsets, &density)
    }

    /// Returns the rates of change of all coefficients at a point (1/time).
    pub(crate) fn residual(&mut self, point: &Point) -> Result<DVector<f64>, SteadyError> {
        self.load(point)?;
        let (h, m) = self.model.rates(&point.base, point.frame)?;
        self.modes.analyse(h, m)
    }

    /// Returns the derivatives of some rates of the state by their coefficients (1/time), by central
    /// differences.
    pub(crate) fn jacobian(&mut self, point: &Point, part: Part) -> Result<DMatrix<f64>, SteadyError> {
        self.differences(point, part, DIFFERENCE, None)
    }

    /// Returns the Jacobian by differences from the rates at the point, at half the cost: to six digits, enough on the
    /// way to a state.
    pub(crate) fn rough_jacobian(
        &mut self,
        point: &Point,
        part: Part,
        rates: &DVector<f64>,
    ) -> Result<DMatrix<f64>, SteadyError> {
        self.differences(point, part, 0.1 * DIFFERENCE, Some(rates))
    }

    /// Returns the Jacobian by differences, central or, given the rates at the point, one-sided. Steps fall with the
    /// wave number, since curvature and slope of a wave grow with it.
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
        self.by_diffusing = DVector::zeros(range.len());
        let inside = self.model.diffusing();
        if self.model.is_linearised() {
            self.load(point)?;
            self.model.linearise()?;
        }
        let filled = range.clone().enumerate().try_for_each(|(column, index)| {
            let step = step / (1.0 + 0.1 * self.modes.wave(index) as f64);
            let mut side = |amount: f64| {
                let (mut h, mut m) = (offsets.clone(), density.clone());
                self.modes.perturb(index, amount, &mut h, &mut m);
                self.model.load(&point.base, &h, &m)?;
                let (h, m) = self.model.rates(&point.base, point.frame)?;
                Ok::<_, SteadyError>((self.modes.analyse(h, m)?, self.model.diffusing()))
            };
            let ((above, more), (below, less), step) = match rates {
                Some(rates) => (side(step)?, (rates.clone(), inside), step),
                None => (side(step)?, side(-step)?, 2.0 * step),
            };
            let difference = (above - below) / step;
            self.by_diffusing[column] = (more - less) / step;
            jacobian.column_mut(column).copy_from(&difference.rows(range.start, range.len()));
            Ok(())
        });
        self.model.release();
        filled.map(|()| jacobian)
    }

    /// Returns the Jacobian by differences of sixth order, at three times the cost: for eigenvectors, whose error is
    /// the error of the Jacobian over the distance of eigenvalues.
    pub(crate) fn fine_jacobian(&mut self, point: &Point, part: Part) -> Result<DMatrix<f64>, SteadyError> {
        let range = self.modes.part(part);
        let (offsets, density) = self.modes.synthesise(&point.state);
        let mut jacobian = DMatrix::zeros(range.len(), range.len());
        if self.model.is_linearised() {
            self.load(point)?;
            self.model.linearise()?;
        }
        let filled = range.clone().enumerate().try_for_each(|(column, index)| {
            let step = FINE_DIFFERENCE / (1.0 + 0.1 * self.modes.wave(index) as f64);
            let derivative = Stencil::CENTRAL.derivative(step, |amount| {
                let (mut h, mut m) = (offsets.clone(), density.clone());
                self.modes.perturb(index, amount, &mut h, &mut m);
                self.model.load(&point.base, &h, &m)?;
                let (h, m) = self.model.rates(&point.base, point.frame)?;
                self.modes.analyse(h, m)
            })?;
            jacobian.column_mut(column).copy_from(&derivative.rows(range.start, range.len()));
            Ok(())
        });
        self.model.release();
        filled.map(|()| jacobian)
    }

    /// Returns the rigid motions of one part of the state that leave the equations as they are: shifts along the
    /// region, across it except in channels, and turns in the plane.
    pub(crate) fn motions(&self, part: Part) -> Vec<FrameMotion> {
        let (plane, channel) = (self.model.in_plane(), self.model.in_channel());
        // An imposed flow has no turns, and a curved profile no shifts across it; the shifts of a linear flow change
        // the velocity of the frame alone, so that the droplet stays where it is.
        let imposed = self.model.imposed();
        let across = !channel && imposed.bend == 0.0 && !self.model.is_axisymmetric();
        let turns = plane && imposed.is_none();
        let all = [([1.0, 0.0, 0.0], false, true), ([0.0, 1.0, 0.0], true, across), ([0.0, 0.0, 1.0], true, turns)];
        let fits = |odd: bool| part == Part::Full || odd == (part == Part::Odd);
        all.into_iter().filter(|(_, odd, there)| *there && fits(*odd)).map(|(motion, ..)| motion).collect()
    }

    /// Returns the rigid motions, by a radius or a radian in the unit of rates, and the derivatives of the coefficients
    /// of the loaded state by them (1/time). These are of the size of the rates in any units. It leaves out motions
    /// without effect, such as turns of a circle.
    pub(crate) fn generators(
        &mut self,
        base: &Base,
        part: Part,
    ) -> Result<(Vec<FrameMotion>, Vec<DVector<f64>>), SteadyError> {
        let range = self.modes.part(part);
        let (mut motions, mut generators) = (Vec::new(), Vec::new());
        let rate = self.model.rate_unit();
        let unit = [rate * self.model.radius, rate * self.model.radius, rate];
        for motion in self.motions(part) {
            let motion = std::array::from_fn(|k| unit[k] * motion[k]);
            let (h, m) = self.model.rigid_rates(base, motion)?;
            let generator = self.modes.analyse(h, m)?.rows(range.start, range.len()).into_owned();
            if generator.norm() > NO_EFFECT * rate {
                motions.push(motion);
                generators.push(generator);
            }
        }
        Ok((motions, generators))
    }

    /// Returns the derivatives of area or volume and of the number of particles, over their values for the droplet, by
    /// some coefficients of the loaded state.
    pub(crate) fn conserved_gradients(&mut self, base: &Base, part: Part) -> Result<Vec<DVector<f64>>, SteadyError> {
        let range = self.modes.part(part);
        let [radius, density] = self.modes.scales();
        let discs = self.model.nuclei();
        let mut of = |(by_offset, by_density): (Vec<f64>, Vec<f64>)| {
            // The sum of a coefficient's function times the derivatives at the nodes: half of its Fourier coefficient
            // times their number, but for the mean.
            let half = 0.5 * by_offset.len() as f64;
            let scaled = |values: Vec<f64>, scale: f64| -> Vec<f64> {
                values.into_iter().map(|value| half * scale * scale * value).chain(vec![0.0; discs]).collect()
            };
            let mut gradient = self.modes.analyse(&scaled(by_offset, radius), &scaled(by_density, density))?;
            for (index, value) in gradient.iter_mut().enumerate() {
                *value *= if self.modes.wave(index) == 0 { 2.0 } else { 1.0 };
            }
            Ok::<_, SteadyError>(gradient.rows(range.start, range.len()).into_owned())
        };
        let [size, number] = self.model.conserved_gradients(base);
        let mut gradients = vec![of(size)?];
        if self.model.keeps_number() {
            let mut number = of(number)?;
            if self.model.has_field() {
                number += &self.by_diffusing;
            }
            gradients.push(number);
        }
        Ok(gradients)
    }

    /// Returns the derivatives by a parameter of the rates (1/time over the parameter's unit) and of the area and the
    /// number of particles that the state lacks.
    fn parameter_derivative(
        &self,
        point: &Point,
        parameter: Parameter,
    ) -> Result<(DVector<f64>, [f64; 2]), SteadyError> {
        let setup = &self.model.setup;
        let step = DIFFERENCE * parameter.scale(setup);
        let all = Stencil::short(parameter, setup, step).derivative(step, |by| {
            let mut moved = self.moved(parameter, by)?;
            let rates = moved.residual(point)?;
            let [area, number] = moved.model.lacks();
            Ok(rates.push(area).push(number))
        })?;
        let n = all.len() - 2;
        Ok((all.rows(0, n).into_owned(), [all[n], all[n + 1]]))
    }

    /// Returns the derivatives of the rates of the loaded point (1/time) and of the number of particles that diffuse
    /// inside by a motion of the frame.
    fn frame_derivative(&mut self, point: &Point, motion: FrameMotion) -> Result<(DVector<f64>, f64), SteadyError> {
        let step = DIFFERENCE;
        let mut side = |amount: f64| {
            let frame = std::array::from_fn(|k| point.frame[k] + amount * motion[k]);
            let (h, m) = self.model.rates(&point.base, frame)?;
            Ok::<_, SteadyError>((self.modes.analyse(h, m)?, self.model.diffusing()))
        };
        let ((above, more), (below, less)) = (side(step)?, side(-step)?);
        Ok(((above - below) / (2.0 * step), (more - less) / (2.0 * step)))
    }

    /// Returns the linear equations for a correction at a point.
    pub(crate) fn equations(
        &mut self,
        point: &Point,
        part: Part,
        along: Option<&Along>,
    ) -> Result<Equations, SteadyError> {
        let jacobian = self.jacobian(point, part)?;
        self.border(point, part, &jacobian, along)
    }

    /// Returns the linear equations for a correction from a Jacobian: bordered by the rigid motions, which fix the
    /// frame's velocity, by area and number of particles, and by the equation for a parameter. Leaves the point loaded.
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
        let size = n + frames + conserved.len() + usize::from(along.is_some());
        // All unknowns and equations are in the units of the coefficients and their rates.
        let rate = self.model.rate_unit();
        let mut matrix = DMatrix::zeros(size, size);
        matrix.view_mut((0, 0), (n, n)).copy_from(jacobian);
        // Where nothing flows a disc may be anywhere, which the equations leave open: it stays where it is.
        if self.model.is_at_rest() {
            for (row, _) in range.clone().enumerate().filter(|(_, index)| self.modes.is_of_disc(*index)) {
                matrix.row_mut(row).fill(0.0);
                matrix[(row, row)] = rate;
            }
        }
        for (k, generator) in generators.iter().enumerate() {
            matrix.view_mut((0, n + k), (n, 1)).copy_from(&-generator);
            matrix.view_mut((n + k, 0), (1, n)).copy_from(&generator.transpose());
        }
        if self.model.has_field() {
            // What is carried along inside depends on the frame's velocity too.
            for (k, motion) in motions.iter().enumerate() {
                let (by_motion, diffusing) = self.frame_derivative(point, *motion)?;
                matrix.view_mut((0, n + k), (n, 1)).copy_from(&by_motion.rows(range.start, n));
                matrix[(n + frames + 1, n + k)] = diffusing * rate;
            }
            self.model.rates(&point.base, point.frame)?;
        }
        // Uniform sources of area and particles, which vanish in a solution since both are conserved.
        for (k, gradient) in conserved.iter().enumerate() {
            matrix[(self.modes.index(k == 1, false, 0), n + frames + k)] = rate;
            matrix.view_mut((n + frames + k, 0), (1, n)).copy_from(&(gradient.transpose() * rate));
        }
        if let Some(Along { parameter, direction }) = along {
            let (derivative, lacks) = self.parameter_derivative(point, *parameter)?;
            matrix.view_mut((0, size - 1), (n, 1)).copy_from(&derivative.rows(range.start, n));
            for (k, lack) in lacks.into_iter().enumerate().take(conserved.len()) {
                matrix[(n + frames + k, size - 1)] = -lack * rate;
            }
            matrix.view_mut((size - 1, 0), (1, n)).copy_from(&direction.rows(0, n).transpose());
            matrix[(size - 1, size - 1)] = direction[n];
        }
        Ok(Equations { lu: matrix.clone().lu(), matrix, part, motions, conserved: conserved.len() })
    }

    /// Returns the correction that takes the rates of the loaded point to zero, and area and particles to their values
    /// for the droplet.
    pub(crate) fn correction(&self, equations: &Equations, residual: &DVector<f64>) -> Result<Correction, SteadyError> {
        let right = equations.right(self, residual, self.model.lacks(), self.model.rate_unit());
        equations.solve(&right).map(|solution| equations.correction(self, &solution))
    }
}

impl Equations {
    /// Returns the solution for a right-hand side.
    pub(crate) fn solve(&self, right: &DVector<f64>) -> Result<DVector<f64>, SteadyError> {
        let singular =
            || SteadyError::singular("a steady state", "Start from another state, for example a neighbouring one");
        self.lu.solve(right).filter(|x| x.iter().all(|value| value.is_finite())).ok_or_else(singular)
    }

    /// Returns the part of the state space that the equations are of.
    pub(crate) fn part(&self) -> Part {
        self.part
    }

    /// Returns the matrix of the equations.
    pub(crate) fn matrix(&self) -> &DMatrix<f64> {
        &self.matrix
    }

    /// Returns the right-hand side that takes rates and lacks of area and particles to zero.
    pub(crate) fn right(&self, system: &System, rates: &DVector<f64>, lacks: [f64; 2], unit: f64) -> DVector<f64> {
        let range = system.modes.part(self.part);
        let mut right = DVector::zeros(self.len());
        right.rows_mut(0, range.len()).copy_from(&-rates.rows(range.start, range.len()));
        for (k, lack) in lacks.into_iter().enumerate().take(self.conserved) {
            right[range.len() + self.motions.len() + k] = lack * unit;
        }
        right
    }

    /// Returns the rate of turning that a unit change of each rate causes: the row of the inverse for turns.
    pub(crate) fn turning(&self, system: &System) -> Result<DVector<f64>, SteadyError> {
        let first = system.modes.part(self.part).len();
        let mut wanted = DVector::zeros(self.len());
        self.motions.iter().enumerate().for_each(|(k, motion)| wanted[first + k] = motion[2]);
        let row = self.matrix.transpose().lu().solve(&wanted).filter(|x| x.iter().all(|value| value.is_finite()));
        row.map(|row| -row)
            .ok_or_else(|| SteadyError::singular("the turns of a swimmer", "Use another number of nodes"))
    }

    /// Returns the number of equations.
    pub(crate) fn len(&self) -> usize {
        self.matrix.nrows()
    }

    /// Splits a solution vector into corrections of state, frame and parameter.
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
        let with_parameter = self.len() > range.len() + self.motions.len() + self.conserved;
        let parameter = if with_parameter { solution[self.len() - 1] } else { 0.0 };
        Correction { state, frame, parameter }
    }

    /// Returns the condition number in the 1-norm, rows being scaled to a largest entry of one; infinite if singular.
    pub(crate) fn condition(&self) -> f64 {
        let mut scaled = self.matrix.clone();
        for mut row in scaled.row_iter_mut() {
            let largest = row.amax();
            row /= largest;
        }
        let norm = |matrix: &DMatrix<f64>| matrix.column_iter().map(|c| c.lp_norm(1)).fold(0.0, f64::max);
        let size = norm(&scaled);
        scaled.try_inverse().map_or(f64::INFINITY, |inverse| size * norm(&inverse))
    }
}

//! Limit cycles: oscillations that branch off at a Hopf point of a straight swimmer in a channel.

use std::f64::consts::{PI, TAU};

use motile_base::Vec2;
use nalgebra::{DMatrix, DVector};
use num_complex::Complex64;

use crate::elimination::Elimination;
use crate::iteration::{CONTRACTION, LEAST_PART, REUSABLE, damped, in_steps};
use crate::model::{Base, FrameMotion};
use crate::modes::Part;
use crate::profile::CROWDING;
use crate::spectrum::complex;
use crate::stencil::Stencil;
use crate::system::{DIFFERENCE, Point, System};
use crate::{Critical, Parameter, Profile, SteadyError, Symmetry};

/// Newton iterations for a cycle: fewer than for a state, since each matrix has the rows of all instants, and a shorter
/// step along the branch is cheaper.
const MOST_ITERATIONS: usize = 15;
/// Correction that is the last one: far below the error of the series in time.
const SMALLEST_CORRECTION: f64 = 1e-8;
/// Tail of the series in time above which there are more instants, four more at once, up to a largest number.
const LONGEST_TAIL: f64 = 1e-3;
const MOST_INSTANTS: usize = 33;
/// Factor of a step along the branch after one that has converged.
const LONGER: f64 = 1.3;

/// Limit cycle: a swimmer that oscillates across a channel and is its own mirror image half a period later.
///
/// Shape and concentration are trigonometric polynomials in space and time. The equations hold at K instants over half
/// a period (Fourier collocation), more of them where the last harmonics ask for it. Space is as in
/// [`crate::SteadyState`], over a base curve that moves and turns with the droplet.
#[derive(Debug)]
#[doc(alias("Hopf bifurcation", "periodic orbit", "oscillation"))]
pub struct LimitCycle {
    pub(crate) system: System,
    /// Base curve at rest, its own mirror image.
    shape: Profile,
    /// Pose of the base curve at each instant: x, y (length) and angle (radians).
    poses: Vec<[f64; 3]>,
    /// Coefficients over the base curve at each instant.
    pub(crate) states: Vec<DVector<f64>>,
    /// Mean speed along the channel (length per time).
    speed: f64,
    /// Period over 2 pi (time).
    pub(crate) tau: f64,
}

/// Derivatives by the phase at K instants over half a period, as matrices: for quantities that return after half a
/// period, and for those that return with the opposite sign.
struct PhaseDerivative {
    matrices: [DMatrix<f64>; 2],
    /// Coefficients of a state that change their sign: the antisymmetric ones.
    odd: std::ops::Range<usize>,
}

impl PhaseDerivative {
    fn new(instants: usize, odd: std::ops::Range<usize>) -> Self {
        let full = |j: usize, k: usize| {
            if j == k {
                return 0.0;
            }
            let difference = PI * (j as f64 - k as f64) / instants as f64;
            let sign = if (j + k).is_multiple_of(2) { 0.5 } else { -0.5 };
            sign / (0.5 * difference).tan()
        };
        let matrix = |sign: f64| DMatrix::from_fn(instants, instants, |j, k| full(j, k) + sign * full(j, k + instants));
        Self { matrices: [matrix(1.0), matrix(-1.0)], odd }
    }

    /// Returns the weight of coefficient `index` at instant k in its derivative at instant j.
    fn weight(&self, index: usize, [j, k]: [usize; 2]) -> f64 {
        self.matrices[usize::from(self.odd.contains(&index))][(j, k)]
    }

    /// Returns the derivatives of poses: x returns after half a period, y and the angle change their sign.
    fn of_poses(&self, poses: &[[f64; 3]]) -> Vec<[f64; 3]> {
        let rate = |j: usize, axis: usize| -> f64 {
            let matrix = &self.matrices[usize::from(axis > 0)];
            poses.iter().enumerate().map(|(k, pose)| matrix[(j, k)] * pose[axis]).sum()
        };
        (0..poses.len()).map(|j| [rate(j, 0), rate(j, 1), rate(j, 2)]).collect()
    }
}

/// Equation for the parameter: corrections are at right angles to a direction of states and parameter.
struct Along {
    parameter: Parameter,
    direction: Vec<DVector<f64>>,
    change: f64,
}

impl LimitCycle {
    /// Creates a limit cycle near a Hopf point with swings of about an amplitude (length), at the value of the
    /// parameter where it has them. With an odd number of instants over half a period at first.
    ///
    /// # Errors
    /// Returns an error for a critical point that is no Hopf point of an antisymmetric mode; a droplet with a disc
    /// inside; an even number of instants; no convergence.
    pub fn from_hopf(
        hopf: &Critical,
        parameter: Parameter,
        amplitude: f64,
        instants: usize,
    ) -> Result<Self, SteadyError> {
        let Critical { state, mode } = hopf;
        if !state.profile().nuclei.is_empty() {
            return Err(SteadyError::unsupported(
                "the droplet has a rigid disc inside",
                "Leave it out, or follow the oscillation in a run",
            ));
        }
        if !state.setup().flow.is_none() {
            return Err(SteadyError::unsupported("the oscillation is in an imposed flow", "Follow it in a run"));
        }
        if mode.symmetry != Symmetry::Antisymmetric || mode.value.im <= 0.0 || instants.is_multiple_of(2) {
            return Err(SteadyError::unsupported(
                format!(
                    "no limit cycle is computed from a {:?} mode of frequency {} at {instants} instants",
                    mode.symmetry, mode.value.im
                ),
                "Start from a Hopf point whose mode is antisymmetric, and use an odd number of instants",
            ));
        }
        let mut system = System::new(state.setup())?;
        let odd = system.modes.part(Part::Odd);
        let vector = system.mode(state.point(), mode)?.rows(odd.start, odd.len()).into_owned();
        let (profile, speed) = (state.profile().clone(), state.velocity().x);
        let point = system.point(&profile, [speed, 0.0, 0.0])?;
        // The shift across and the turn that are parts of the mode move the base curve.
        system.load(&point)?;
        let mut rigid = DMatrix::zeros(odd.len(), 2);
        for (k, motion) in [[0.0, 1.0, 0.0], [0.0, 0.0, 1.0]].into_iter().enumerate() {
            let (h, m) = system.model.rigid_rates(&point.base, motion)?;
            rigid.set_column(k, &system.modes.analyse(h, m)?.rows(odd.start, odd.len()));
        }
        let singular = || SteadyError::singular("rigid motions", "Use more nodes");
        let normal = (rigid.transpose() * &rigid).try_inverse().ok_or_else(singular)? * rigid.transpose();
        let parts = complex(&normal) * &vector;
        let unit = amplitude / parts[0];
        let rest = &vector - complex(&rigid) * &parts;
        let turn = |j: usize| Complex64::cis(PI * j as f64 / instants as f64) * unit;
        let at = |vector: &DVector<Complex64>, j: usize| {
            let mut whole = DVector::zeros(system.modes.len());
            whole.rows_mut(odd.start, odd.len()).copy_from(&vector.map(|z| (z * turn(j)).re));
            whole
        };
        let direction: Vec<DVector<f64>> = (0..instants).map(|j| at(&vector, j)).collect();
        let states = (0..instants).map(|j| &point.state + at(&rest, j)).collect();
        let poses = (0..instants).map(|j| [0.0, (parts[0] * turn(j)).re, (parts[1] * turn(j)).re]).collect();
        let mut cycle = Self { system, shape: profile, poses, states, speed, tau: 1.0 / mode.value.im };
        cycle.newton(Some(&Along { parameter, direction, change: 0.0 }))?;
        cycle.settled()
    }

    /// Returns the branch of limit cycles from a Hopf point, by pseudo-arclength: the first two have about the given
    /// amplitude (length) and one and a half times that. `seen` is called with each, and the branch ends where it
    /// returns false.
    ///
    /// # Errors
    /// Returns the errors of [`LimitCycle::from_hopf`], and an error if there is no convergence with the shortest step,
    /// after `seen` had all cycles up to there.
    pub fn follow(
        hopf: &Critical,
        parameter: Parameter,
        amplitude: f64,
        instants: usize,
        mut seen: impl FnMut(&Self) -> bool,
    ) -> Result<(), SteadyError> {
        let mut before = Self::from_hopf(hopf, parameter, amplitude, instants)?;
        if !seen(&before) {
            return Ok(());
        }
        let mut last = Self::from_hopf(hopf, parameter, 1.5 * amplitude, instants)?;
        let mut factor = 1.0;
        while seen(&last) {
            let next = loop {
                match last.beyond(&before, parameter, factor) {
                    Ok(next) => break next,
                    Err(error) if factor < LEAST_PART => return Err(error),
                    Err(_) => factor *= 0.5,
                }
            };
            (before, last, factor) = (last, next, LONGER);
        }
        Ok(())
    }

    /// Returns the limit cycle at another value of a parameter, in steps as long as they converge.
    ///
    /// # Errors
    /// Returns an error for a description without this parameter; no convergence with the shortest step.
    pub fn at(&self, parameter: Parameter, value: f64) -> Result<Self, SteadyError> {
        let start = self.value(parameter);
        in_steps((self.copy(&self.system.model.setup)?, 0.0), 1.0, |last, part| {
            let setup = parameter.with(&self.system.model.setup, start + part * (value - start))?;
            let mut next = last.copy(&setup)?;
            next.newton(None)?;
            next.settled()
        })
    }

    /// Returns the next cycle of a branch, `factor` times as far from this one as this is from the one before
    /// (pseudo-arclength, so that folds are passed).
    fn beyond(&self, before: &Self, parameter: Parameter, factor: f64) -> Result<Self, SteadyError> {
        let change = self.value(parameter) - before.value(parameter);
        let ahead = self.value(parameter) + factor * change;
        let mut next = self.copy(&parameter.with(&self.system.model.setup, ahead)?)?;
        // Over the curves of this cycle.
        let mut before = before.with_instants(self.states.len())?;
        before.move_onto(&self.shape, &self.poses)?;
        let direction: Vec<DVector<f64>> = self.states.iter().zip(&before.states).map(|(a, b)| a - b).collect();
        for (state, way) in next.states.iter_mut().zip(&direction) {
            *state += factor * way;
        }
        next.speed += factor * (self.speed - before.speed);
        next.tau += factor * (self.tau - before.tau);
        next.newton(Some(&Along { parameter, direction, change }))?;
        next.settled()
    }

    /// Returns the cycle over base curves that follow it, at as many instants as it needs.
    fn settled(mut self) -> Result<Self, SteadyError> {
        self.refit()?;
        self.newton(None)?;
        while self.tail() > LONGEST_TAIL && self.states.len() < MOST_INSTANTS {
            self = self.with_instants(self.states.len() + 4)?;
            self.newton(None)?;
        }
        Ok(self)
    }

    /// Returns the cycle at another number of instants.
    fn with_instants(&self, count: usize) -> Result<Self, SteadyError> {
        let mut next = self.copy(&self.system.model.setup)?;
        let (own, odd) = (self.states.len(), self.system.modes.part(Part::Odd));
        let weights = |j: usize| (0..own).map(move |k| weights(PI * j as f64 / count as f64, k, own));
        let state = |j: usize| {
            let mut state = DVector::zeros(self.system.modes.len());
            for (other, [same, turned]) in self.states.iter().zip(weights(j)) {
                state.rows_mut(0, odd.start).axpy(same, &other.rows(0, odd.start), 1.0);
                state.rows_mut(odd.start, odd.len()).axpy(turned, &other.rows(odd.start, odd.len()), 1.0);
            }
            state
        };
        let pose = |j: usize| {
            self.poses.iter().zip(weights(j)).fold([0.0; 3], |[x, y, angle], (pose, [same, turned])| {
                [x + same * pose[0], y + turned * pose[1], angle + turned * pose[2]]
            })
        };
        (next.states, next.poses) = ((0..count).map(state).collect(), (0..count).map(pose).collect());
        Ok(next)
    }

    /// Returns the number of instants over half a period.
    #[must_use]
    pub fn instants(&self) -> usize {
        self.states.len()
    }

    /// Returns the tail of the series in time (no dimension), an error estimate. It is the last harmonics over the
    /// first, of the state over its base curve.
    #[must_use]
    pub fn tail(&self) -> f64 {
        let (count, odd) = (self.states.len(), self.system.modes.part(Part::Odd));
        // Quantities that return after half a period have even harmonics.
        let size = |m: usize| {
            let rows = if m.is_multiple_of(2) { 0..odd.start } else { odd.clone() };
            let mut sum = DVector::<Complex64>::zeros(rows.len());
            for (j, state) in self.states.iter().enumerate() {
                let turn = Complex64::cis(-PI * (m * j) as f64 / count as f64) / count as f64;
                sum += state.rows(rows.start, rows.len()).map(|value| value * turn);
            }
            sum.norm()
        };
        size(count - 1).max(size(count - 2)) / size(1).max(size(2))
    }

    /// Returns the cycle with another description, as a start.
    pub(crate) fn copy(&self, setup: &motile::setup::Setup) -> Result<Self, SteadyError> {
        let Self { shape, poses, states, speed, tau, .. } = self;
        let (shape, poses, states) = (shape.clone(), poses.clone(), states.clone());
        Ok(Self { system: System::new(setup)?, shape, poses, states, speed: *speed, tau: *tau })
    }

    /// Returns the value of a parameter of the description; not a number if it has no such parameter.
    #[must_use]
    pub fn value(&self, parameter: Parameter) -> f64 {
        parameter.get(&self.system.model.setup).unwrap_or(f64::NAN)
    }

    /// Returns the period (time).
    #[must_use]
    pub fn period(&self) -> f64 {
        TAU * self.tau
    }

    /// Returns the mean speed along the channel (length per time).
    #[must_use]
    pub fn mean_speed(&self) -> f64 {
        self.speed
    }

    /// Returns the largest distance of the centroid from the centre line (length).
    ///
    /// # Errors
    /// Returns an error for more nodes than a transform takes.
    pub fn amplitude(&self) -> Result<f64, SteadyError> {
        let heights = (0..self.poses.len()).map(|j| Ok(self.profile(j)?.moments()?.centroid.y));
        let heights = heights.collect::<Result<Vec<f64>, SteadyError>>()?;
        let count = heights.len();
        // Odd harmonics, from both halves of the period.
        let coefficient = |m: usize| {
            let terms = heights.iter().enumerate();
            terms.map(|(j, y)| y * Complex64::cis(-PI * (m * j) as f64 / count as f64)).sum::<Complex64>()
                / count as f64
        };
        let odd: Vec<(usize, Complex64)> = (1..count).step_by(2).map(|m| (m, coefficient(m))).collect();
        let height =
            |phase: f64| odd.iter().map(|(m, c)| 2.0 * (c * Complex64::cis(*m as f64 * phase)).re).sum::<f64>();
        // Beside a maximum by at most half a spacing of phases: an error of 1e-6.
        Ok((0..2000).map(|k| height(TAU * f64::from(k) / 2000.0).abs()).fold(0.0, f64::max))
    }

    /// Returns the base curve at an instant.
    fn base(&self, instant: usize) -> Result<Base, SteadyError> {
        let [x, y, angle] = self.poses[instant];
        Ok(Base::new(&self.shape)?.moved(Vec2::new(x, y), angle))
    }

    /// Returns the droplet at an instant, in the frame that moves with the mean speed.
    fn profile(&self, instant: usize) -> Result<Profile, SteadyError> {
        Ok(self.system.profile_over(&self.base(instant)?, &self.states[instant]))
    }

    fn derivative(&self) -> PhaseDerivative {
        PhaseDerivative::new(self.states.len(), self.system.modes.part(Part::Odd))
    }

    /// Returns the states at the instants, each over its base curve and in the frame of that curve.
    pub(crate) fn points(&self) -> Result<Vec<Point>, SteadyError> {
        let point = |(j, pose_rate)| -> Result<Point, SteadyError> {
            let [ux, uy, turn] = motion(pose_rate, self.poses[j]);
            let frame: FrameMotion = [self.speed + ux / self.tau, uy / self.tau, turn / self.tau];
            Ok(Point { base: self.base(j)?, state: self.states[j].clone(), frame })
        };
        self.derivative().of_poses(&self.poses).into_iter().enumerate().map(point).collect()
    }

    /// Returns the residual of the equations, dx/dphase - tau dx/dt instant after instant, and dx/dphase over tau: the
    /// rates of a solution, which are smoother than the rates of the equations before there is one.
    fn residual(&mut self) -> Result<(DVector<f64>, Vec<DVector<f64>>), SteadyError> {
        let (count, n) = (self.states.len(), self.system.modes.len());
        let derivative = self.derivative();
        let (mut residual, mut own) = (DVector::zeros(count * n), Vec::new());
        for (j, pose_rate) in derivative.of_poses(&self.poses).into_iter().enumerate() {
            let base = self.base(j)?;
            let (h, m) = self.system.modes.synthesise(&self.states[j]);
            self.system.model.load(&base, &h, &m)?;
            let (h, m) = self.system.model.rates(&base, [self.speed, 0.0, 0.0])?;
            let rate = self.system.modes.analyse(h, m)?;
            let (h, m) = self.system.model.rigid_rates(&base, motion(pose_rate, self.poses[j]))?;
            let mut moved = self.system.modes.analyse(h, m)?;
            for (k, state) in self.states.iter().enumerate() {
                for (index, value) in moved.iter_mut().enumerate() {
                    *value += derivative.weight(index, [j, k]) * state[index];
                }
            }
            residual.rows_mut(j * n, n).copy_from(&(&moved - self.tau * rate));
            own.push(moved / self.tau);
        }
        Ok((residual, own))
    }

    /// Returns the linearised equations, bordered by shifts along the channel and in time, area and number of
    /// particles; and what these two lack over all instants.
    fn matrix(&mut self) -> Result<(DMatrix<f64>, [f64; 2]), SteadyError> {
        let (count, n) = (self.states.len(), self.system.modes.len());
        let size = count * n;
        let mut matrix = DMatrix::zeros(size + 5, size + 5);
        let (derivative, points, (_, own), tau) = (self.derivative(), self.points()?, self.residual()?, self.tau);
        let (mut lacks, mut kept) = ([0.0; 2], 0);
        for (j, (point, own)) in points.into_iter().zip(&own).enumerate() {
            let jacobian = self.system.jacobian(&point, Part::Full)?;
            matrix.view_mut((j * n, j * n), (n, n)).copy_from(&(-tau * jacobian));
            for (k, index) in (0..count).flat_map(|k| (0..n).map(move |index| (k, index))) {
                matrix[(j * n + index, k * n + index)] += derivative.weight(index, [j, k]);
            }
            self.system.load(&point)?;
            let (h, m) = self.system.model.rigid_rates(&point.base, [1.0, 0.0, 0.0])?;
            let along = self.system.modes.analyse(h, m)?;
            let conserved = self.system.conserved_gradients(&point.base, Part::Full)?;
            kept = conserved.len();
            lacks.iter_mut().zip(self.system.model.lacks()).for_each(|(sum, lack)| *sum += lack);
            // Columns: speed, period over 2 pi, uniform sources of area and particles, which vanish in a solution.
            // Rows: shifts along the channel and in time, area, number of particles.
            matrix.view_mut((j * n, size), (n, 1)).copy_from(&(tau * &along));
            matrix.view_mut((j * n, size + 1), (n, 1)).copy_from(&-own);
            matrix.view_mut((size, j * n), (1, n)).copy_from(&along.transpose());
            matrix.view_mut((size + 1, j * n), (1, n)).copy_from(&own.transpose());
            for (k, gradient) in conserved.iter().enumerate() {
                matrix[(j * n + self.system.modes.index(k == 1, false, 0), size + 2 + k)] = 1.0;
                matrix.view_mut((size + 2 + k, j * n), (1, n)).copy_from(&gradient.transpose());
            }
        }
        // Nothing takes the place of a number that is not conserved.
        for unused in size + 2 + kept..size + 5 {
            matrix[(unused, unused)] = 1.0;
        }
        Ok((matrix, lacks))
    }

    /// Newton's method, with an equation for a parameter also for that.
    fn newton(&mut self, along: Option<&Along>) -> Result<(), SteadyError> {
        let size = self.states.len() * self.system.modes.len();
        let mut last = f64::INFINITY;
        let mut factors = None;
        let mut residual = self.residual()?.0;
        for _ in 0..MOST_ITERATIONS {
            let (factorised, lacks) = match factors.take() {
                Some(factors) => factors,
                None => self.factorised(along)?,
            };
            let mut right = DMatrix::zeros(size + 5, 1);
            right.rows_mut(0, size).copy_from(&-&residual);
            (right[size + 2], right[size + 3]) = (lacks[0], lacks[1]);
            let singular = || SteadyError::singular("a limit cycle", "Start from another amplitude");
            let correction = factorised.solve(right).ok_or_else(singular)?;
            let amount = correction.rows(0, size).amax();
            residual = damped(amount, |part| self.corrected(&correction, part, along))?;
            if amount < SMALLEST_CORRECTION {
                return Ok(());
            }
            if amount < REUSABLE && amount < CONTRACTION * last {
                // Area and particles are right already.
                factors = Some((factorised, [0.0; 2]));
            }
            last = amount;
        }
        Err(SteadyError::NoConvergence {
            residual: residual.amax() / self.tau,
            iterations: MOST_ITERATIONS,
            remedy: "Use a smaller step, more nodes or more instants",
        })
    }

    /// Returns the linear equations for a correction, factorised, and what area and number of particles lack.
    fn factorised(&mut self, along: Option<&Along>) -> Result<(Elimination, [f64; 2]), SteadyError> {
        let (mut matrix, lacks) = self.matrix()?;
        if let Some(Along { parameter, direction, change }) = along {
            let n = self.system.modes.len();
            let size = self.states.len() * n;
            let (setup, value) = (&self.system.model.setup, self.value(*parameter));
            let step = DIFFERENCE * parameter.scale(setup);
            let derivative = Stencil::short(*parameter, setup, step)
                .derivative(step, |by| Ok(self.copy(&parameter.with(setup, value + by)?)?.residual()?.0))?;
            matrix.view_mut((0, size + 4), (size, 1)).copy_from(&derivative);
            for (j, way) in direction.iter().enumerate() {
                matrix.view_mut((size + 4, j * n), (1, n)).copy_from(&way.transpose());
            }
            matrix[(size + 4, size + 4)] = *change;
        }
        Ok((Elimination::new(matrix), lacks))
    }

    /// Takes a fraction of a correction and finds the residual; on failure nothing has changed.
    fn corrected(
        &mut self,
        correction: &DMatrix<f64>,
        part: f64,
        along: Option<&Along>,
    ) -> Result<DVector<f64>, SteadyError> {
        let mut next = self.copy(&self.system.model.setup)?;
        let n = self.system.modes.len();
        let size = self.states.len() * n;
        for (j, state) in next.states.iter_mut().enumerate() {
            *state += part * correction.rows(j * n, n).column(0);
        }
        next.speed += part * correction[size];
        next.tau += part * correction[size + 1];
        if let Some(Along { parameter, .. }) = along {
            next.system = next.system.moved(*parameter, part * correction[size + 4])?;
        }
        let residual = next.residual()?.0;
        *self = next;
        Ok(residual)
    }

    /// Goes over to the mean shape as base curve, placed where the droplet is at each instant.
    fn refit(&mut self) -> Result<(), SteadyError> {
        let count = self.states.len();
        let even = self.system.modes.part(Part::Even);
        let mut mean = DVector::zeros(self.system.modes.len());
        for state in &self.states {
            let mut rows = mean.rows_mut(even.start, even.len());
            rows += state.rows(even.start, even.len()) / count as f64;
        }
        let mean = self.system.profile_over(&Base::new(&self.shape)?, &mean);
        let shape = mean.resampled(self.shape.nodes(), CROWDING)?.centred()?;
        let poses: Vec<[f64; 3]> = (0..count)
            .map(|j| {
                let profile = self.profile(j)?;
                let centroid = profile.moments()?.centroid;
                // The heading: particles gather at the rear.
                let offset = |(x, m): (&Vec2, &f64)| (centroid - *x) * *m;
                let ahead: Vec2 = profile.positions.iter().zip(&profile.density).map(offset).sum();
                Ok([centroid.x, centroid.y, ahead.y.atan2(ahead.x)])
            })
            .collect::<Result<_, SteadyError>>()?;
        self.move_onto(&shape, &poses)
    }

    /// Goes over to another base curve with other poses.
    fn move_onto(&mut self, shape: &Profile, poses: &[[f64; 3]]) -> Result<(), SteadyError> {
        let profiles = (0..self.states.len()).map(|j| self.profile(j)).collect::<Result<Vec<_>, _>>()?;
        (self.shape, self.poses) = (shape.clone(), poses.to_vec());
        for (j, profile) in profiles.iter().enumerate() {
            let base = self.base(j)?;
            let too_far = SteadyError::NoConvergence {
                residual: f64::NAN,
                iterations: 0,
                remedy: "Use smaller steps, because the limit cycle has changed too much",
            };
            let (offsets, density) = profile.over(&base.positions, &base.normals)?.ok_or(too_far)?;
            self.states[j] = self.system.modes.analyse(&offsets, &density)?;
        }
        Ok(())
    }
}

/// Returns the motion of a frame about the origin from the rate of a pose, which turns about its own place.
fn motion([x, y, turn]: [f64; 3], pose: [f64; 3]) -> FrameMotion {
    [x + turn * pose[1], y - turn * pose[0], turn]
}

/// Returns the weights of the instant `k` of `count` over half a period in the trigonometric interpolation at a phase:
/// for quantities that return after half a period, and for those that return with the opposite sign.
pub(crate) fn weights(phase: f64, k: usize, count: usize) -> [f64; 2] {
    let all = 2 * count;
    let at = |k: usize| {
        let angle = phase - PI * k as f64 / count as f64;
        let tangent = (0.5 * angle).tan();
        if tangent.abs() < 1e-12 { 1.0 } else { (0.5 * all as f64 * angle).sin() / (all as f64 * tangent) }
    };
    [at(k) + at(k + count), at(k) - at(k + count)]
}

//! Oscillations that come from a Hopf point of a straight swimmer in a channel.

use std::f64::consts::{PI, TAU};

use motile::ib_core::Vec2;
use nalgebra::{DMatrix, DVector};
use num_complex::Complex64;

use crate::elimination::Elimination;
use crate::floquet::weights;
use crate::model::{Base, FrameMotion};
use crate::modes::Part;
use crate::spectrum::eigenvector;
use crate::state::CROWDING;
use crate::system::{Point, System};
use crate::{Critical, Parameter, Profile, SteadyError, Symmetry};

/// Newton iterations for a cycle.
const MOST_ITERATIONS: usize = 15;
/// A correction of this size is the last one.
const SMALLEST: f64 = 1e-8;
/// Largest correction that is taken whole, and the least part of one where the whole has no flow.
const LARGEST: f64 = 0.5;
const LEAST_PART: f64 = 0.01;
/// Last harmonics in time beyond this part of the first ask for more instants, up to a number.
const LONGEST_TAIL: f64 = 1e-3;
const MOST_INSTANTS: usize = 33;

/// Growth of a step after one that has converged.
const LONGER: f64 = 1.3;
/// Least step over the one before.
const SHORTEST: f64 = 0.03;

/// An oscillation of a droplet across a channel: after half a period it is the mirror image of itself.
///
/// Shape and concentration are trigonometric polynomials in space and time. In time there are K instants over half a
/// period, at which the equations hold (Fourier collocation), more of them where the last harmonics ask for it; space
/// is as in [`crate::SteadyState`], over a curve that moves and turns with the droplet.
#[derive(Debug)]
pub struct LimitCycle {
    pub(crate) system: System,
    /// The curve at rest, its own mirror image.
    shape: Profile,
    /// Where it is at each instant: x, y (length) and angle (radians).
    poses: Vec<[f64; 3]>,
    pub(crate) states: Vec<DVector<f64>>,
    speed: f64,
    /// Period over 2 pi (time).
    pub(crate) tau: f64,
}

/// Derivatives of poses, states and so on at instants over half a period by the phase, for what is the same after half
/// a period and what has changed its sign.
fn derivatives(instants: usize) -> [DMatrix<f64>; 2] {
    let full = |j: usize, k: usize| {
        if j == k {
            return 0.0;
        }
        let difference = PI * (j as f64 - k as f64) / instants as f64;
        let sign = if (j + k).is_multiple_of(2) { 0.5 } else { -0.5 };
        sign / (0.5 * difference).tan()
    };
    [1.0, -1.0].map(|sign| DMatrix::from_fn(instants, instants, |j, k| full(j, k) + sign * full(j, k + instants)))
}

/// An equation for the parameter: the correction is at right angles to a direction.
struct Along {
    parameter: Parameter,
    direction: Vec<DVector<f64>>,
    change: f64,
}

impl LimitCycle {
    /// The oscillations near a Hopf point with swings of about an amplitude (length), at the value of the parameter
    /// that they have it at; K instants over half a period at first, odd.
    ///
    /// # Errors
    /// A point of other symmetry or without a frequency; no convergence.
    pub fn from_hopf(
        hopf: &Critical,
        parameter: Parameter,
        amplitude: f64,
        instants: usize,
    ) -> Result<Self, SteadyError> {
        let Critical { state, mode } = hopf;
        if !state.profile().nuclei.is_empty() {
            return Err(SteadyError::Unsupported {
                what: "the droplet has a nucleus".into(),
                remedy: "leave it out, or follow the oscillation in a run",
            });
        }
        if mode.symmetry != Symmetry::Antisymmetric || mode.value.im <= 0.0 || instants.is_multiple_of(2) {
            return Err(SteadyError::Unsupported {
                what: "this is not a Hopf point of swings across a channel, or the number of instants is even".into(),
                remedy: "give a Hopf point whose mode is antisymmetric, and an odd number",
            });
        }
        let mut system = System::new(state.setup())?;
        let reduced = system.reduced(state.point(), Part::Odd)?;
        let (_, vector) = eigenvector(&reduced.matrix, mode.value)?;
        let vector = reduced.basis.map(|v| Complex64::new(v, 0.0)) * vector;
        let odd = system.modes.part(Part::Odd);
        let (profile, speed) = (state.profile().clone(), state.velocity().x);
        let point = system.point(&profile, [speed, 0.0, 0.0])?;
        // What of the mode is a shift across and a turn moves the curve.
        system.load(&point)?;
        let mut rigid = DMatrix::zeros(odd.len(), 2);
        for (k, motion) in [[0.0, 1.0, 0.0], [0.0, 0.0, 1.0]].into_iter().enumerate() {
            let (h, m) = system.model.rigid_rates(&point.base, motion)?;
            rigid.set_column(k, &system.modes.analyse(h, m)?.rows(odd.start, odd.len()));
        }
        let singular = || SteadyError::Singular { what: "rigid motions", remedy: "give more nodes" };
        let normal = (rigid.transpose() * &rigid).try_inverse().ok_or_else(singular)? * rigid.transpose();
        let parts = normal.map(|v| Complex64::new(v, 0.0)) * &vector;
        let unit = amplitude / parts[0];
        let rest = &vector - rigid.map(|v| Complex64::new(v, 0.0)) * &parts;
        let at = |vector: &DVector<Complex64>, j: usize| {
            let turn = Complex64::cis(PI * j as f64 / instants as f64) * unit;
            let mut whole = DVector::zeros(system.modes.len());
            whole.rows_mut(odd.start, odd.len()).copy_from(&vector.map(|z| (z * turn).re));
            whole
        };
        let direction: Vec<DVector<f64>> = (0..instants).map(|j| at(&vector, j)).collect();
        let states = (0..instants).map(|j| &point.state + at(&rest, j)).collect();
        let poses = (0..instants).map(|j| {
            let turn = Complex64::cis(PI * j as f64 / instants as f64) * unit;
            [0.0, (parts[0] * turn).re, (parts[1] * turn).re]
        });
        let poses = poses.collect();
        let mut cycle = Self { system, shape: profile, poses, states, speed, tau: 1.0 / mode.value.im };
        cycle.newton(Some(&Along { parameter, direction, change: 0.0 }))?;
        cycle.settled()
    }

    /// Follows the branch of oscillations from a Hopf point, at first with two of about the amplitude (length) given
    /// and one and a half times that: `seen` is told each, and the branch ends where it says false.
    ///
    /// # Errors
    /// As [`LimitCycle::from_hopf`]; no convergence with the shortest step, after `seen` was told what could be
    /// reached.
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
                    Err(error) if factor < SHORTEST => return Err(error),
                    Err(_) => factor *= 0.5,
                }
            };
            (before, last, factor) = (last, next, LONGER);
        }
        Ok(())
    }

    /// The oscillation at another value of a parameter, in steps as long as they converge.
    ///
    /// # Errors
    /// No convergence with the shortest step.
    pub fn at(&self, parameter: Parameter, value: f64) -> Result<Self, SteadyError> {
        let (start, mut reached, mut part, mut step) = (self.value(parameter), None::<Self>, 0.0, 1.0);
        while part < 1.0 {
            let (last, ahead) = (reached.as_ref().unwrap_or(self), f64::min(part + step, 1.0));
            let setup = parameter.with(&self.system.model.setup, start + ahead * (value - start))?;
            let next = last.copy(&setup).and_then(|mut next| {
                next.newton(None)?;
                next.settled()
            });
            match next {
                Ok(next) => (reached, part) = (Some(next), ahead),
                Err(_) if step > SHORTEST => step *= 0.5,
                Err(error) => return Err(error),
            }
        }
        reached.map_or_else(|| self.copy(&self.system.model.setup), Ok)
    }

    /// The next oscillation of a branch, beyond this one as seen from another one before it: `factor` times as far
    /// (pseudo-arclength continuation, so that folds are passed).
    ///
    /// # Errors
    /// No convergence.
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

    /// The same cycle over the curves that serve it best, at as many instants as it needs.
    fn settled(mut self) -> Result<Self, SteadyError> {
        self.refit()?;
        self.newton(None)?;
        while self.tail() > LONGEST_TAIL && self.states.len() < MOST_INSTANTS {
            self = self.with_instants(self.states.len() + 4)?;
            self.newton(None)?;
        }
        Ok(self)
    }

    /// The same cycle at other instants.
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

    /// Instants over half a period.
    #[must_use]
    pub fn instants(&self) -> usize {
        self.states.len()
    }

    /// Size of the last harmonics in time over the first ones, of the state over its curve: an error estimate.
    #[must_use]
    pub fn tail(&self) -> f64 {
        let (count, odd) = (self.states.len(), self.system.modes.part(Part::Odd));
        // Even harmonics are in what is the same after half a period.
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

    pub(crate) fn copy(&self, setup: &motile::Setup) -> Result<Self, SteadyError> {
        let Self { shape, poses, states, speed, tau, .. } = self;
        let (shape, poses, states) = (shape.clone(), poses.clone(), states.clone());
        Ok(Self { system: System::new(setup)?, shape, poses, states, speed: *speed, tau: *tau })
    }

    /// Value of a parameter.
    #[must_use]
    pub fn value(&self, parameter: Parameter) -> f64 {
        parameter.get(&self.system.model.setup).unwrap_or(f64::NAN)
    }

    /// Period (time).
    #[must_use]
    pub fn period(&self) -> f64 {
        TAU * self.tau
    }

    /// Mean speed along the channel (length per time).
    #[must_use]
    pub fn mean_speed(&self) -> f64 {
        self.speed
    }

    /// Largest distance of the centroid from the centre line (length).
    ///
    /// # Errors
    /// A shape that is not finite.
    pub fn amplitude(&self) -> Result<f64, SteadyError> {
        let heights = (0..self.poses.len()).map(|j| Ok(self.lab_profile(j)?.moments()?.centroid.y));
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
        Ok((0..2000).map(|k| height(TAU * f64::from(k) / 2000.0).abs()).fold(0.0, f64::max))
    }

    fn base(&self, instant: usize) -> Result<Base, SteadyError> {
        let [x, y, angle] = self.poses[instant];
        let mut base = Base::new(&self.shape)?.moved(y, angle);
        base.positions.iter_mut().for_each(|position| position.x += x);
        Ok(base)
    }

    fn lab_profile(&self, instant: usize) -> Result<Profile, SteadyError> {
        let base = self.base(instant)?;
        let (offsets, density) = self.system.modes.synthesise(&self.states[instant]);
        let positions =
            base.positions.iter().zip(&base.normals).zip(&offsets).map(|((x, n), h)| *x + *h * *n).collect();
        Ok(Profile { positions, density, nuclei: Vec::new() })
    }

    /// Poses' derivatives by the phase.
    fn pose_rates(&self) -> Vec<[f64; 3]> {
        let count = self.poses.len();
        let [same, turned] = derivatives(count);
        let rate = |matrix: &DMatrix<f64>, j: usize, axis: usize| -> f64 {
            (0..count).map(|k| matrix[(j, k)] * self.poses[k][axis]).sum()
        };
        (0..count).map(|j| [rate(&same, j, 0), rate(&turned, j, 1), rate(&turned, j, 2)]).collect()
    }

    /// The droplet at each instant in the frame of the curve that it is over.
    pub(crate) fn points(&self) -> Result<Vec<Point>, SteadyError> {
        let point = |(j, pose_rate)| -> Result<Point, SteadyError> {
            let [ux, uy, turn] = motion(pose_rate, self.poses[j]);
            let frame: FrameMotion = [self.speed + ux / self.tau, uy / self.tau, turn / self.tau];
            Ok(Point { base: self.base(j)?, state: self.states[j].clone(), frame })
        };
        self.pose_rates().into_iter().enumerate().map(point).collect()
    }

    /// Derivatives of the states by the phase less their rates times the period over 2 pi, an instant after the other;
    /// and those derivatives over the period, which are the rates of a solution and smoother before there is one.
    fn residual(&mut self) -> Result<(DVector<f64>, Vec<DVector<f64>>), SteadyError> {
        let (count, n) = (self.states.len(), self.system.modes.len());
        let [same, turned] = derivatives(count);
        let odd = self.system.modes.part(Part::Odd);
        let rates = self.pose_rates();
        let (mut residual, mut own) = (DVector::zeros(count * n), Vec::new());
        for (j, pose_rate) in rates.into_iter().enumerate() {
            let base = self.base(j)?;
            let (h, m) = self.system.modes.synthesise(&self.states[j]);
            self.system.model.load(&base, &h, &m)?;
            let (h, m) = self.system.model.rates(&base, [self.speed, 0.0, 0.0])?;
            let rate = self.system.modes.analyse(h, m)?;
            let (h, m) = self.system.model.rigid_rates(&base, motion(pose_rate, self.poses[j]))?;
            let rigid = self.system.modes.analyse(h, m)?;
            let mut moved = rigid;
            for k in 0..count {
                for index in 0..n {
                    moved[index] +=
                        (if odd.contains(&index) { &turned } else { &same })[(j, k)] * self.states[k][index];
                }
            }
            residual.rows_mut(j * n, n).copy_from(&(&moved - self.tau * rate));
            own.push(moved / self.tau);
        }
        Ok((residual, own))
    }

    /// The linearised equations bordered by rigid motions, shifts in time and what is conserved, and what is conserved.
    fn matrix(&mut self) -> Result<(DMatrix<f64>, [f64; 2]), SteadyError> {
        let (count, n) = (self.states.len(), self.system.modes.len());
        let [same, turned] = derivatives(count);
        let odd = self.system.modes.part(Part::Odd);
        let size = count * n;
        let mut matrix = DMatrix::zeros(size + 5, size + 5);
        let (points, (_, own), tau) = (self.points()?, self.residual()?, self.tau);
        let mut lacks = [0.0; 2];
        for (j, (point, own)) in points.into_iter().zip(&own).enumerate() {
            let jacobian = self.system.jacobian(&point, Part::Full)?;
            matrix.view_mut((j * n, j * n), (n, n)).copy_from(&(-tau * jacobian));
            for k in 0..count {
                for index in 0..n {
                    matrix[(j * n + index, k * n + index)] +=
                        (if odd.contains(&index) { &turned } else { &same })[(j, k)];
                }
            }
            self.system.load(&point)?;
            let (h, m) = self.system.model.rigid_rates(&point.base, [1.0, 0.0, 0.0])?;
            let along = self.system.modes.analyse(h, m)?;
            let conserved = self.system.conserved_gradients(&point.base, Part::Full)?;
            let (present, wanted) = (self.system.model.present(), self.system.model.conserved());
            for (lack, (have, want)) in lacks.iter_mut().zip(present.iter().zip(wanted)) {
                *lack += 1.0 - have / want;
            }
            // Columns: speed, period over 2 pi, two sources that do nothing. Rows: shifts along the channel and in
            // time, area, number of particles.
            matrix.view_mut((j * n, size), (n, 1)).copy_from(&(tau * &along));
            matrix.view_mut((j * n, size + 1), (n, 1)).copy_from(&-own);
            matrix.view_mut((size, j * n), (1, n)).copy_from(&along.transpose());
            matrix.view_mut((size + 1, j * n), (1, n)).copy_from(&own.transpose());
            for (k, gradient) in conserved.iter().enumerate() {
                matrix[(j * n + self.system.modes.index(k == 1, false, 0), size + 2 + k)] = 1.0;
                matrix.view_mut((size + 2 + k, j * n), (1, n)).copy_from(&gradient.transpose());
            }
        }
        matrix[(size + 4, size + 4)] = 1.0;
        Ok((matrix, lacks))
    }

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
            let singular = SteadyError::Singular { what: "a cycle", remedy: "start from another amplitude" };
            let correction = factorised.solve(right).ok_or(singular)?;
            let amount = correction.rows(0, size).amax();
            let mut part = (LARGEST / amount).min(1.0);
            // A droplet beyond a wall has no flow: less of the correction then.
            residual = loop {
                match self.corrected(&correction, part, along) {
                    Ok(residual) => break residual,
                    Err(_) if part > LEAST_PART => part *= 0.5,
                    Err(error) => return Err(error),
                }
            };
            if amount < SMALLEST {
                return Ok(());
            }
            // The same matrix as long as it does; what is conserved is then right already.
            if amount < 1e-2 && amount < 0.3 * last {
                factors = Some((factorised, [0.0; 2]));
            }
            last = amount;
        }
        Err(SteadyError::NoConvergence {
            residual: last,
            iterations: MOST_ITERATIONS,
            remedy: "take a smaller step, more nodes or more instants",
        })
    }

    /// The linear equations for a correction, and what area and number of particles lack.
    fn factorised(&mut self, along: Option<&Along>) -> Result<(Elimination, [f64; 2]), SteadyError> {
        let (mut matrix, lacks) = self.matrix()?;
        if let Some(Along { parameter, direction, change }) = along {
            let n = self.system.modes.len();
            let size = self.states.len() * n;
            let value = self.value(*parameter);
            let step = 1e-5 * value.abs().max(0.01);
            let mut sides = Vec::new();
            for value in [value + step, value - step] {
                sides.push(self.copy(&parameter.with(&self.system.model.setup, value)?)?.residual()?.0);
            }
            let derivative = (&sides[0] - &sides[1]) / (2.0 * step);
            matrix.view_mut((0, size + 4), (size, 1)).copy_from(&derivative);
            for (j, way) in direction.iter().enumerate() {
                matrix.view_mut((size + 4, j * n), (1, n)).copy_from(&way.transpose());
            }
            matrix[(size + 4, size + 4)] = *change;
        }
        Ok((Elimination::new(matrix), lacks))
    }

    /// Takes a part of a correction and finds the residual; on failure nothing has changed.
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
            next.system.change(*parameter, part * correction[size + 4])?;
        }
        let residual = next.residual()?.0;
        *self = next;
        Ok(residual)
    }

    /// Goes over to the mean shape, where the droplet is at each instant.
    fn refit(&mut self) -> Result<(), SteadyError> {
        let count = self.states.len();
        let even = self.system.modes.part(Part::Even);
        let mut mean = DVector::zeros(self.system.modes.len());
        for state in &self.states {
            let mut rows = mean.rows_mut(even.start, even.len());
            rows += state.rows(even.start, even.len()) / count as f64;
        }
        let (offsets, density) = self.system.modes.synthesise(&mean);
        let base = Base::new(&self.shape)?;
        let positions =
            base.positions.iter().zip(&base.normals).zip(&offsets).map(|((x, n), h)| *x + *h * *n).collect();
        let nodes = self.shape.nodes();
        let shape =
            crate::newton::centred(Profile { positions, density, nuclei: Vec::new() }.resampled(nodes, CROWDING)?)?;
        let poses: Vec<[f64; 3]> = (0..count)
            .map(|j| {
                let profile = self.lab_profile(j)?;
                let centroid = profile.moments()?.centroid;
                // The particles are at the rear.
                let offset = |(x, m): (&Vec2, &f64)| (centroid - *x) * *m;
                let ahead: Vec2 = profile.positions.iter().zip(&profile.density).map(offset).sum();
                Ok([centroid.x, centroid.y, ahead.y.atan2(ahead.x)])
            })
            .collect::<Result<_, SteadyError>>()?;
        self.move_onto(&shape, &poses)
    }

    /// The same cycle over other curves.
    fn move_onto(&mut self, shape: &Profile, poses: &[[f64; 3]]) -> Result<(), SteadyError> {
        let profiles = (0..self.states.len()).map(|j| self.lab_profile(j)).collect::<Result<Vec<_>, _>>()?;
        (self.shape, self.poses) = (shape.clone(), poses.to_vec());
        for (j, profile) in profiles.iter().enumerate() {
            let base = self.base(j)?;
            let too_far = SteadyError::NoConvergence {
                residual: f64::NAN,
                iterations: 0,
                remedy: "take smaller steps: the cycle has changed too much",
            };
            let (offsets, density) = profile.over(&base.positions, &base.normals)?.ok_or(too_far)?;
            self.states[j] = self.system.modes.analyse(&offsets, &density)?;
        }
        Ok(())
    }
}

/// Motion of a frame about the origin from the rate of a pose, which turns about its own place.
fn motion([x, y, turn]: [f64; 3], pose: [f64; 3]) -> FrameMotion {
    [x + turn * pose[1], y - turn * pose[0], turn]
}

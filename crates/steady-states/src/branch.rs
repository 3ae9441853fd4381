//! Branches of steady states.

use std::fmt;

use nalgebra::DVector;

use crate::modes::Part;
use crate::newton::{Outcome, RESOLVED};
use crate::profile::{Fields, Profile};
use crate::spectrum::{Spectrum, Symmetry, eigenvector};
use crate::system::{Along, Point, System};
use crate::{Critical, Eigenmode, Parameter, SteadyError, SteadyState};

/// Steps below this part of the largest are given up.
const LEAST_STEP: f64 = 1e-4;
/// Amplitude of the critical mode with which a branch is entered, first of a few that are tried.
const AMPLITUDES: [f64; 3] = [0.05, 0.1, 0.02];
/// A frequency below this part of D/R^2 is none.
const LEAST_FREQUENCY: f64 = 1e-5;
/// Modes that stay below this part of D/R^2 are neutral.
const NEUTRAL: f64 = 1e-5;
/// Special points that differ by less (relatively, or in units of D/R and D/R^2) are the same.
const SAME: f64 = 1e-4;
/// Iterations after which the next step is longer.
const QUICK: usize = 6;
/// Halvings of a step in which a mode crosses zero growth, before secants.
const HALVINGS: usize = 6;
/// Secants for a fold.
const MOST_SECANTS: usize = 12;

/// What is special about a point of a branch.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum SpecialKind {
    /// The branch turns back.
    Fold,
    /// Another branch of steady states crosses.
    BranchPoint,
    /// A branch of oscillations begins.
    Hopf,
}

impl SpecialKind {
    /// Its name in files.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Fold => "fold",
            Self::BranchPoint => "branch point",
            Self::Hopf => "Hopf point",
        }
    }
}

/// A special point of a branch.
#[derive(Debug, Clone)]
pub struct SpecialPoint {
    /// What it is.
    pub kind: SpecialKind,
    /// The state and the mode.
    pub critical: Critical,
}

impl SpecialPoint {
    /// Whether another one has been found twice.
    fn is_same(&self, other: &Self, parameter: Parameter) -> bool {
        let at = |point: &Self| {
            let Critical { state, mode } = &point.critical;
            let value = parameter.get(state.setup()).unwrap_or(f64::NAN);
            (value, state.velocity().length() / state.diffusion_rate(), mode.value.im / state.diffusion_rate())
        };
        let ((a, u, f), (b, v, g)) = (at(self), at(other));
        let oscillates = |point: &Self| point.kind == SpecialKind::Hopf;
        oscillates(self) == oscillates(other)
            && self.critical.mode.symmetry == other.critical.mode.symmetry
            && (a - b).abs() < SAME * a.abs()
            && (u - v).abs() < SAME
            && (f - g).abs() < SAME
    }
}

/// A point of a branch.
#[derive(Debug, Clone)]
pub struct BranchPoint {
    /// Value of the parameter.
    pub value: f64,
    /// The state.
    pub state: SteadyState,
    /// Its spectrum.
    pub spectrum: Spectrum,
}

/// Why a branch ends.
#[derive(Debug)]
#[non_exhaustive]
pub enum BranchEnd {
    /// It has left the range of the parameter; the last point is at the end of the range.
    Range,
    /// The droplet has come to rest: what follows are the same droplets, swimming the other way.
    Rest,
    /// It has as many points as were wanted.
    MostPoints,
    /// The caller did not want more.
    Stopped,
    /// It could not be followed any further.
    Failed(SteadyError),
}

impl fmt::Display for BranchEnd {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Range => f.write_str("end of the range"),
            Self::Rest => f.write_str("the droplet is at rest"),
            Self::MostPoints => f.write_str("the largest number of points"),
            Self::Stopped => f.write_str("stopped"),
            Self::Failed(error) => error.fmt(f),
        }
    }
}

/// A branch of steady states in one parameter.
#[derive(Debug)]
pub struct Branch {
    /// The parameter.
    pub parameter: Parameter,
    /// Its points in order.
    pub points: Vec<BranchPoint>,
    /// Special points in the order of the branch.
    pub special: Vec<SpecialPoint>,
    /// Why it ends.
    pub end: BranchEnd,
}

/// How a branch is followed: pseudo-arclength continuation.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Continuation {
    /// The parameter.
    pub parameter: Parameter,
    /// Its range; the branch ends where it leaves this.
    pub range: [f64; 2],
    /// Direction of the parameter to start with: upwards or not.
    pub upwards: bool,
    /// Largest step, as a part of the range or a change of the largest Fourier coefficients over their unit.
    pub largest_step: f64,
    /// Most points.
    pub most_points: usize,
}

impl Continuation {
    /// From one value of a parameter to another.
    #[must_use]
    pub fn new(parameter: Parameter, from: f64, to: f64) -> Self {
        let range = [from.min(to), from.max(to)];
        Self { parameter, range, upwards: to > from, largest_step: 0.05, most_points: 400 }
    }

    fn scale(&self) -> f64 {
        self.range[1] - self.range[0]
    }

    /// Follows the branch of a state.
    ///
    /// `seen` is told each point and the special points before it; the branch ends where it says false.
    ///
    /// # Errors
    /// A description without the parameter; a range that is empty or does not hold the start; no convergence at the
    /// first step. Later failures end the branch: [`Branch::end`].
    pub fn follow(
        &self,
        start: &SteadyState,
        seen: impl FnMut(&BranchPoint, &[SpecialPoint]) -> bool,
    ) -> Result<Branch, SteadyError> {
        let mut follower = Follower::new(*self, start)?;
        let n = follower.size();
        let mut direction = DVector::zeros(n + 1);
        direction[n] = if self.upwards { 1.0 } else { -1.0 };
        follower.turn(&direction)?;
        follower.go(seen)
    }

    /// Follows the branch that crosses at a branch point, away from the one that the point was found on, in the
    /// direction of the mode or against it.
    ///
    /// # Errors
    /// As [`Continuation::follow`]; a point that is no branch point.
    pub fn switch(
        &self,
        point: &SpecialPoint,
        with_mode: bool,
        seen: impl FnMut(&BranchPoint, &[SpecialPoint]) -> bool,
    ) -> Result<Branch, SteadyError> {
        if point.kind != SpecialKind::BranchPoint {
            return Err(SteadyError::Unsupported {
                what: format!("a {} has no other branch of steady states", point.kind.name()),
                remedy: "give a branch point",
            });
        }
        let Critical { state, mode } = &point.critical;
        let enter = |amplitude: f64| self.enter(state, mode, if with_mode { amplitude } else { -amplitude });
        let [first, rest @ ..] = AMPLITUDES;
        rest.into_iter().fold(enter(first), |found, amplitude| found.or_else(|_| enter(amplitude)))?.go(seen)
    }

    /// The first point of the branch that a mode leads to.
    fn enter(&self, state: &SteadyState, mode: &Eigenmode, amplitude: f64) -> Result<Follower, SteadyError> {
        let mirror = state.is_mirror_symmetric() && mode.symmetry == Symmetry::Symmetric;
        let mut follower = Follower::new(*self, state)?;
        follower.part = if mirror { Part::Even } else { Part::Full };
        let own = mode.symmetry.part();
        let reduced = follower.system.reduced(state.point(), own)?;
        let (_, vector) = eigenvector(&reduced.matrix, mode.value)?;
        let vector = reduced.basis * vector.map(|z| z.re);
        let vector = &vector / vector.amax();
        let range = follower.system.modes.part(own);
        let mut whole = DVector::zeros(follower.system.modes.len());
        whole.rows_mut(range.start, range.len()).copy_from(&vector);
        let part = follower.system.modes.part(follower.part);
        let mut direction = DVector::zeros(part.len() + 1);
        direction.rows_mut(0, part.len()).copy_from(&whole.rows(part.start, part.len()));
        direction *= amplitude.signum() / direction.norm();
        follower.tangent = direction;
        follower.advance(amplitude.abs() * whole.norm())?;
        Ok(follower)
    }
}

/// A place that a branch has been at.
struct Place {
    point: Point,
    setup: motile::Setup,
    tangent: DVector<f64>,
}

/// A branch on its way.
struct Follower {
    settings: Continuation,
    system: System,
    point: Point,
    part: Part,
    /// Unit direction: coefficients of the part, then the parameter over its scale.
    tangent: DVector<f64>,
    outcome: Outcome,
}

impl Follower {
    fn new(settings: Continuation, start: &SteadyState) -> Result<Self, SteadyError> {
        settings.parameter.with(start.setup(), settings.range[0])?;
        let ([low, high], value) = (settings.range, settings.parameter.get(start.setup()).unwrap_or(f64::NAN));
        let slack = 1e-9 * (high - low);
        if !(high - low > 0.0 && high - low < f64::INFINITY && value >= low - slack && value <= high + slack) {
            return Err(SteadyError::Unsupported {
                what: format!("a branch from {} = {value} in the range {low} to {high}", settings.parameter.name()),
                remedy: "give a range of some length that the start lies in",
            });
        }
        let part = if start.is_mirror_symmetric() { Part::Even } else { Part::Full };
        let system = System::new(start.setup())?;
        let outcome = Outcome::default();
        Ok(Self { settings, system, point: start.point().clone(), part, tangent: DVector::zeros(0), outcome })
    }

    fn size(&self) -> usize {
        self.system.modes.part(self.part).len()
    }

    fn value(&self) -> f64 {
        self.settings.parameter.get(&self.system.model.setup).unwrap_or(f64::NAN)
    }

    fn along(&self, direction: &DVector<f64>) -> Along {
        let mut direction = direction.clone();
        let last = direction.len() - 1;
        direction[last] /= self.settings.scale();
        Along { parameter: self.settings.parameter, direction }
    }

    /// Finds the tangent that agrees with a direction.
    fn turn(&mut self, direction: &DVector<f64>) -> Result<(), SteadyError> {
        let equations = self.system.equations(&self.point, self.part, Some(&self.along(direction)))?;
        let mut right = DVector::zeros(equations.len());
        right[equations.len() - 1] = 1.0;
        let solution = equations.solve(&right)?;
        let n = self.size();
        let mut tangent = DVector::zeros(n + 1);
        tangent.rows_mut(0, n).copy_from(&solution.rows(0, n));
        tangent[n] = solution[solution.len() - 1] / self.settings.scale();
        self.tangent = &tangent / tangent.norm();
        Ok(())
    }

    /// A step along the tangent, and back to the branch at right angles to it; on failure nothing has changed.
    fn advance(&mut self, step: f64) -> Result<(), SteadyError> {
        let (point, setup) = (self.point.clone(), self.system.model.setup.clone());
        let outcome = self.try_advance(step);
        if outcome.is_err() {
            (self.point, self.system) = (point, System::new(&setup)?);
        }
        outcome
    }

    fn try_advance(&mut self, step: f64) -> Result<(), SteadyError> {
        let n = self.size();
        let range = self.system.modes.part(self.part);
        let mut rows = self.point.state.rows_mut(range.start, n);
        rows += step * self.tangent.rows(0, n);
        self.system.change(self.settings.parameter, step * self.tangent[n] * self.settings.scale())?;
        let along = self.along(&self.tangent.clone());
        self.outcome = self.system.newton(&mut self.point, self.part, Some(&along))?;
        Ok(())
    }

    fn state(&self) -> Result<SteadyState, SteadyError> {
        SteadyState::of(&self.system, self.point.clone(), self.outcome, self.part == Part::Even)
    }

    /// Takes the present droplet as its own base, its nodes where they serve it best.
    fn rebase(&mut self) -> Result<(), SteadyError> {
        let n = self.size();
        let range = self.system.modes.part(self.part);
        let profile = |system: &System, point: &Point, amount: f64, tangent: &DVector<f64>| {
            let mut point = point.clone();
            let mut rows = point.state.rows_mut(range.start, n);
            rows += amount * tangent.rows(0, n);
            system.profile(&point)
        };
        let ahead = profile(&self.system, &self.point, 1e-4, &self.tangent);
        let behind = profile(&self.system, &self.point, -1e-4, &self.tangent);
        let mut point = self.system.rebased(&self.point)?;
        self.outcome = self.system.newton(&mut point, self.part, None)?;
        // Both without the shift of the centre to x = 0, of which the tangent knows nothing.
        let shift = self.system.profile(&self.point).moments()?.centroid.x;
        let over = |profile: Profile| -> Result<Option<Fields>, SteadyError> {
            let mut profile = profile;
            profile.shift(-shift);
            profile.over(&point.base.positions, &point.base.normals)
        };
        let mut tangent = self.tangent.clone();
        if let (Some(ahead), Some(behind)) = (over(ahead)?, over(behind)?) {
            let difference = |a: &[f64], b: &[f64]| a.iter().zip(b).map(|(a, b)| (a - b) / 2e-4).collect::<Vec<_>>();
            let (h, m) = (difference(&ahead.0, &behind.0), difference(&ahead.1, &behind.1));
            let whole = self.system.modes.analyse(&h, &m)?;
            tangent.rows_mut(0, n).copy_from(&whole.rows(range.start, n));
        } else {
            tangent.rows_mut(0, n).fill(0.0);
        }
        self.point = point;
        self.turn(&tangent)
    }

    fn go(&mut self, mut seen: impl FnMut(&BranchPoint, &[SpecialPoint]) -> bool) -> Result<Branch, SteadyError> {
        let parameter = self.settings.parameter;
        let mut branch = Branch { parameter, points: Vec::new(), special: Vec::new(), end: BranchEnd::MostPoints };
        branch.end = match self.walk(&mut branch, &mut seen) {
            Err(error) if branch.points.len() < 2 => return Err(error),
            Err(error) => BranchEnd::Failed(error),
            Ok(end) => end,
        };
        Ok(branch)
    }

    /// Adds points to a branch until it ends.
    fn walk(
        &mut self,
        branch: &mut Branch,
        seen: &mut dyn FnMut(&BranchPoint, &[SpecialPoint]) -> bool,
    ) -> Result<BranchEnd, SteadyError> {
        let Continuation { parameter, range: [low, high], largest_step, most_points, .. } = self.settings;
        let mut step = 0.2 * largest_step;
        // Special points before the next one, and the end if it is the last.
        let (mut special, mut end) = (Vec::<SpecialPoint>::new(), None);
        loop {
            let (point, tangent, outcome) = (self.point.clone(), self.tangent.clone(), self.outcome);
            // Nodes that follow a droplet which they hardly resolve follow their own errors more and more.
            let (far, tail) = (self.system.is_far(&point), self.system.tail(&point)?.max(RESOLVED));
            let forward = tangent.as_slice().last().copied().unwrap_or(0.0);
            let good = self.rebase().and_then(|()| {
                let onward = self.tangent[self.size()] * forward >= 0.0;
                Ok(onward && (far || self.system.tail(&self.point)? < tail))
            });
            if !good.unwrap_or(false) {
                (self.point, self.tangent, self.outcome) = (point, tangent, outcome);
            }
            let state = self.state()?;
            let spectrum = self.system.spectrum(&self.point, self.part == Part::Even)?;
            let next = BranchPoint { value: self.value(), state, spectrum };
            if let (Some(last), None | Some(BranchEnd::Range)) = (branch.points.last(), &end) {
                for point in crossings(parameter, last, &next) {
                    if !branch.special.iter().chain(&special).any(|old| old.is_same(&point, parameter)) {
                        special.push(point);
                    }
                }
            }
            let goes_on = seen(&next, &special);
            branch.special.append(&mut special);
            branch.points.push(next);
            if let Some(end) = end {
                return Ok(end);
            }
            if !goes_on {
                return Ok(BranchEnd::Stopped);
            }
            if branch.points.len() >= most_points {
                return Ok(BranchEnd::MostPoints);
            }
            let before = Place { point: self.point.clone(), setup: self.setup(), tangent: self.tangent.clone() };
            while let Err(error) = self.advance(step) {
                if step < LEAST_STEP * largest_step {
                    return Err(error);
                }
                step *= 0.4;
            }
            let taken = step;
            if self.outcome.iterations <= QUICK {
                step = (1.5 * step).min(largest_step);
            }
            if !(low..=high).contains(&self.value()) && branch.points.len() > 1 {
                self.land(&before, if self.value() < low { low } else { high })?;
                end = Some(BranchEnd::Range);
                continue;
            }
            // The sign of the parameter's part of the tangent there says whether there was a fold.
            self.turn(&before.tangent)?;
            let slopes = [before.tangent[self.size()], self.tangent[self.size()]];
            if slopes[0] * slopes[1] < 0.0 && branch.points.len() > 1 {
                let after = Place { point: self.point.clone(), setup: self.setup(), tangent: self.tangent.clone() };
                let outcome = self.outcome;
                let fold = self.fold(&before, taken, slopes);
                if self.part == Part::Even && before.point.frame[0] * after.point.frame[0] < 0.0 {
                    // No fold, but the branch at rest, which this one joins.
                    special.push(SpecialPoint { kind: SpecialKind::BranchPoint, ..fold? });
                    end = Some(BranchEnd::Rest);
                    continue;
                }
                special.extend(fold.ok());
                self.outcome = outcome;
                self.go_to(&after)?;
            }
        }
    }

    fn setup(&self) -> motile::Setup {
        self.system.model.setup.clone()
    }

    fn go_to(&mut self, place: &Place) -> Result<(), SteadyError> {
        self.system = System::new(&place.setup)?;
        (self.point, self.tangent) = (place.point.clone(), place.tangent.clone());
        Ok(())
    }

    /// From beyond the range to the end of it.
    fn land(&mut self, before: &Place, goal: f64) -> Result<(), SteadyError> {
        let start = self.settings.parameter.get(&before.setup).unwrap_or(f64::NAN);
        let beyond = (self.value() - goal) / (self.value() - start);
        self.point.state = beyond * &before.point.state + (1.0 - beyond) * &self.point.state;
        self.system = System::new(&self.settings.parameter.with(&before.setup, goal)?)?;
        self.outcome = self.system.newton(&mut self.point, self.part, None)?;
        Ok(())
    }

    /// The fold within a step, by secants on the tangent's part of the parameter.
    fn fold(&mut self, before: &Place, step: f64, ends: [f64; 2]) -> Result<SpecialPoint, SteadyError> {
        let (mut low, mut high) = ((0.0, ends[0]), (step, ends[1]));
        for _ in 0..MOST_SECANTS {
            let middle = low.0 - low.1 * (high.0 - low.0) / (high.1 - low.1);
            self.go_to(before)?;
            self.try_advance(middle)?;
            self.turn(&before.tangent)?;
            let slope = self.tangent[self.size()];
            if slope.abs() < 1e-7 {
                break;
            }
            // Illinois' rule: the end that stays counts half.
            if slope * low.1 > 0.0 {
                low = (middle, slope);
                high.1 *= 0.5;
            } else {
                high = (middle, slope);
                low.1 *= 0.5;
            }
        }
        let state = self.state()?;
        let spectrum = self.system.spectrum(&self.point, self.part == Part::Even)?;
        let size = |mode: &&Eigenmode| mode.value.norm();
        let mode = spectrum.modes.iter().min_by(|a, b| size(a).total_cmp(&size(b))).cloned();
        let mode = mode.ok_or(SteadyError::Singular { what: "a fold", remedy: "give more nodes" })?;
        Ok(SpecialPoint { kind: SpecialKind::Fold, critical: Critical { state, mode } })
    }
}

/// The point between two others where mode k of a symmetry, in the order of their growth rates, crosses zero growth,
/// by halving and then by secants.
fn halved(
    parameter: Parameter,
    [before, after]: [&BranchPoint; 2],
    symmetry: Symmetry,
    (k, grows_before): (usize, bool),
) -> Option<Critical> {
    let [mut low, mut high] = [before.value, after.value];
    let mut state = before.state.clone();
    let mut nearest = None;
    for _ in 0..HALVINGS {
        let middle = 0.5 * (low + high);
        state = state.at(parameter, middle).ok()?;
        let spectrum = state.spectrum().ok()?;
        let mode = modes_of(&spectrum, symmetry).into_iter().nth(k)?;
        *(if (mode.value.re > before.spectrum.zero) == grows_before { &mut low } else { &mut high }) = middle;
        nearest = Some(mode);
    }
    state.critical(&nearest?, parameter).ok()
}

/// The modes of a symmetry; conjugate pairs count twice, so that one that parts into two real modes is no crossing.
fn modes_of(spectrum: &Spectrum, symmetry: Symmetry) -> Vec<Eigenmode> {
    let modes = spectrum.modes.iter().filter(|mode| mode.symmetry == symmetry);
    modes.flat_map(|mode| std::iter::repeat_n(mode.clone(), mode.multiplicity())).collect()
}

/// Modes that cross zero growth between two points.
fn crossings(parameter: Parameter, before: &BranchPoint, after: &BranchPoint) -> Vec<SpecialPoint> {
    let mut found = Vec::new();
    for symmetry in [Symmetry::Symmetric, Symmetry::Antisymmetric, Symmetry::None] {
        let [a, b] = [before, after].map(|point| modes_of(&point.spectrum, symmetry));
        let zero = before.spectrum.zero;
        let growing = |modes: &[Eigenmode]| modes.iter().filter(|mode| mode.value.re > zero).count();
        let [first, last] = [growing(&a), growing(&b)];
        let mut tried = Vec::new();
        for k in first.min(last)..first.max(last) {
            // From the end that is nearer to the crossing.
            let (Some(one), Some(other)) = (a.get(k), b.get(k)) else { continue };
            // A shift that changes nothing, such as that of a droplet at rest across a channel, has round-off only.
            if one.value.norm().max(other.value.norm()) < NEUTRAL * before.state.diffusion_rate() {
                continue;
            }
            let (state, mode) =
                if one.value.re.abs() < other.value.re.abs() { (&before.state, one) } else { (&after.state, other) };
            if tried.contains(&mode) {
                continue;
            }
            tried.push(mode);
            let near = |critical: &Critical| {
                let at = parameter.get(critical.state.setup()).unwrap_or(f64::NAN);
                let width = (after.value - before.value).abs();
                (at - before.value).abs() <= 1.5 * width && (at - after.value).abs() <= 1.5 * width
            };
            let direct = state.critical(mode, parameter).ok().filter(near);
            // Where another mode is nearer to zero at the ends than the one that crosses.
            let halved = || halved(parameter, [before, after], symmetry, (k, first > last)).filter(near);
            let Some(critical) = direct.or_else(halved) else { continue };
            let kind = if critical.mode.value.im < LEAST_FREQUENCY * critical.state.diffusion_rate() {
                SpecialKind::BranchPoint
            } else {
                SpecialKind::Hopf
            };
            found.push(SpecialPoint { kind, critical });
        }
    }
    found
}

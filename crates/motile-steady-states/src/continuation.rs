//! Pseudo-arclength continuation: steps along the tangent of a branch and corrections at right angles to it.

use motile_base::positive;
use nalgebra::DVector;

use crate::branch::{Branch, BranchEnd, BranchPoint, SpecialKind, SpecialPoint};
use crate::crossings::{crossings, is_same};
use crate::iteration::{MOST_ITERATIONS, Outcome, SHORTER};
use crate::modes::Part;
use crate::profile::{Fields, Profile, RESOLVED};
use crate::system::{Along, DIFFERENCE, NO_EFFECT, Point, System};
use crate::{Critical, Eigenmode, Parameter, SteadyError, SteadyState, Symmetry};

/// Part of the range of the parameter at which it is seen whether it breaks the mirror symmetry.
const ASIDE: f64 = 1e-3;
/// First step over the largest one, and the one below which a branch is given up.
const FIRST_STEP: f64 = 0.2;
const LEAST_STEP: f64 = 1e-4;
/// Factor of a step after a success within QUICK iterations, which Newton's method takes where the tangent predicts
/// well.
const LONGER: f64 = 1.5;
const QUICK: usize = 6;
/// Amplitudes of the critical mode at which the crossing branch is entered, tried in this order: the largest
/// coefficient in units of the radius and the mean density. Small enough for the branch to be straight, large enough
/// not to fall back onto the branch that it crosses.
const AMPLITUDES: [f64; 3] = [0.05, 0.1, 0.02];

/// Callback for points of a branch and the special points before them, false to stop.
type Seen<'a> = &'a mut dyn FnMut(&BranchPoint, &[SpecialPoint]) -> bool;

/// Settings of a continuation by pseudo-arclength: branches are followed around folds.
#[derive(Debug, Clone, Copy, PartialEq)]
#[doc(alias("bifurcation", "pseudo-arclength", "bifurcation diagram"))]
pub struct Continuation {
    /// Parameter along which the branch is followed.
    pub parameter: Parameter,
    /// Range of the parameter; the branch ends where it leaves it.
    pub range: [f64; 2],
    /// Direction of the parameter at the start: true for upwards.
    pub upwards: bool,
    /// Largest step (no dimension), the norm of the changes of the Fourier coefficients, in units of the radius and the
    /// mean density, and of the parameter over the length of its range.
    pub largest_step: f64,
    /// Largest number of points.
    pub most_points: usize,
}

impl Continuation {
    /// Creates a continuation from one value of a parameter to another, with a largest step of 0.05 and at most 400
    /// points.
    #[must_use]
    pub fn new(parameter: Parameter, from: f64, to: f64) -> Self {
        let range = [from.min(to), from.max(to)];
        Self { parameter, range, upwards: to > from, largest_step: 0.05, most_points: 400 }
    }

    /// Returns the branch through a state.
    ///
    /// It calls `seen` with each point and the special points before it. The branch ends when `seen` returns false.
    ///
    /// # Errors
    /// Returns an error for a description without the parameter; a range that is empty or does not hold the start; no
    /// convergence at the first step. Later failures end the branch: [`Branch::end`].
    pub fn follow(
        &self,
        start: &SteadyState,
        seen: impl FnMut(&BranchPoint, &[SpecialPoint]) -> bool,
    ) -> Result<Branch, SteadyError> {
        let part = if self.breaks_symmetry(start) { Part::Full } else { start.part() };
        let mut follower = Follower::new(*self, start, part)?;
        let n = follower.size();
        let mut direction = DVector::zeros(n + 1);
        direction[n] = if self.upwards { 1.0 } else { -1.0 };
        follower.turn(&direction)?;
        follower.go(seen)
    }

    /// Returns true if the parameter breaks the mirror symmetry of the start, as the slip length of one wall does.
    fn breaks_symmetry(&self, start: &SteadyState) -> bool {
        let Some(value) = self.parameter.get(start.setup()) else { return false };
        let [low, high] = self.range;
        let beside = [value - ASIDE * (high - low), value + ASIDE * (high - low)];
        beside.into_iter().filter(|value| (low..=high).contains(value)).any(|value| {
            let moved = self.parameter.with(start.setup(), value).and_then(|setup| System::new(&setup));
            moved.is_ok_and(|system| !system.model.is_mirror_symmetric())
        })
    }

    /// Returns the branch that crosses the one of a branch point there, in the direction of the critical mode or
    /// against it.
    ///
    /// # Errors
    /// Returns the errors of [`Continuation::follow`], and an error for a special point that is not a branch point; for
    /// one at rest around a nucleus, which may rest anywhere, that leads to nothing else.
    pub fn switch(
        &self,
        point: &SpecialPoint,
        with_mode: bool,
        seen: impl FnMut(&BranchPoint, &[SpecialPoint]) -> bool,
    ) -> Result<Branch, SteadyError> {
        if point.kind != SpecialKind::BranchPoint {
            return Err(SteadyError::unsupported(
                format!("a {} has no other branch of steady states", point.kind.name()),
                "Start from a branch point",
            ));
        }
        let Critical { state, mode } = &point.critical;
        let enter = |amplitude: f64| self.enter(state, mode, if with_mode { amplitude } else { -amplitude });
        let [first, rest @ ..] = AMPLITUDES;
        let mut follower =
            rest.into_iter().fold(enter(first), |found, amplitude| found.or_else(|_| enter(amplitude)))?;
        follower.settle_nodes()?;
        let profile = follower.system.profile(&follower.point);
        if !profile.nuclei.is_empty() && profile.is_at_rest() {
            return Err(SteadyError::unsupported(
                "only droplets at rest with a nucleus elsewhere cross there, and no swimmers",
                "Find a swimmer (SteadyState::find; `motile steady` does unless --uniform is given) and follow it to \
                 the threshold",
            ));
        }
        follower.go(seen)
    }

    /// Returns the first point of the branch that a critical mode leads to, beyond an amplitude of it.
    fn enter(&self, state: &SteadyState, mode: &Eigenmode, amplitude: f64) -> Result<Follower, SteadyError> {
        let mirror = state.is_mirror_symmetric() && mode.symmetry == Symmetry::Symmetric;
        let mut follower = Follower::new(*self, state, if mirror { Part::Even } else { Part::Full })?;
        let whole = follower.system.mode(state.point(), mode)?.map(|z| z.re);
        let whole = &whole / whole.amax();
        let part = follower.system.modes.part(follower.part);
        let mut direction = DVector::zeros(part.len() + 1);
        direction.rows_mut(0, part.len()).copy_from(&whole.rows(part.start, part.len()));
        direction *= amplitude.signum() / direction.norm();
        follower.tangent = direction;
        follower.advance(amplitude.abs() * whole.norm())?;
        Ok(follower)
    }
}

/// Place on a branch.
struct Place {
    point: Point,
    setup: motile::setup::Setup,
    tangent: DVector<f64>,
}

/// Branch on its way.
struct Follower {
    settings: Continuation,
    system: System,
    point: Point,
    part: Part,
    /// Unit tangent: coefficients of the part, then the parameter over the length of its range.
    tangent: DVector<f64>,
    outcome: Outcome,
}

impl Follower {
    fn new(settings: Continuation, start: &SteadyState, part: Part) -> Result<Self, SteadyError> {
        positive("the largest step of a branch", settings.largest_step)?;
        settings.parameter.with(start.setup(), settings.range[0])?;
        let ([low, high], value) = (settings.range, settings.parameter.get(start.setup()).unwrap_or(f64::NAN));
        let slack = 1e-9 * (high - low);
        if !(high - low > 0.0 && high - low < f64::INFINITY && value >= low - slack && value <= high + slack) {
            return Err(SteadyError::unsupported(
                format!("no branch starts at {} = {value} in the range {low} to {high}", settings.parameter.name()),
                "Use a range of finite, positive length that contains the start",
            ));
        }
        let (system, point) = (System::new(start.setup())?, start.point().clone());
        Ok(Self { settings, system, point, part, tangent: DVector::zeros(0), outcome: Outcome::default() })
    }

    /// Returns the number of coefficients of the part.
    fn size(&self) -> usize {
        self.system.modes.part(self.part).len()
    }

    fn value(&self) -> f64 {
        self.settings.parameter.get(&self.system.model.setup).unwrap_or(f64::NAN)
    }

    /// Returns the length of the range of the parameter.
    fn scale(&self) -> f64 {
        self.settings.range[1] - self.settings.range[0]
    }

    fn along(&self, direction: &DVector<f64>) -> Along {
        let mut direction = direction.clone();
        let last = direction.len() - 1;
        direction[last] /= self.scale();
        Along { parameter: self.settings.parameter, direction }
    }

    /// Returns the point at an amount of a direction from here, at the same value of the parameter.
    fn displaced(&self, amount: f64, direction: &DVector<f64>) -> Point {
        let range = self.system.modes.part(self.part);
        let mut point = self.point.clone();
        let mut rows = point.state.rows_mut(range.start, range.len());
        rows += amount * direction.rows(0, range.len());
        point
    }

    /// Finds the tangent at the point, in the sense of a direction.
    fn turn(&mut self, direction: &DVector<f64>) -> Result<(), SteadyError> {
        let equations = self.system.equations(&self.point, self.part, Some(&self.along(direction)))?;
        let mut right = DVector::zeros(equations.len());
        right[equations.len() - 1] = 1.0;
        let solution = equations.solve(&right)?;
        let n = self.size();
        let mut tangent = DVector::zeros(n + 1);
        tangent.rows_mut(0, n).copy_from(&solution.rows(0, n));
        tangent[n] = solution[solution.len() - 1] / self.scale();
        self.tangent = &tangent / tangent.norm();
        Ok(())
    }

    /// Step along the tangent, and back to the branch at right angles to it; on failure nothing has changed.
    fn advance(&mut self, step: f64) -> Result<(), SteadyError> {
        let mut point = self.displaced(step, &self.tangent);
        let change = step * self.tangent[self.size()] * self.scale();
        let mut system = self.system.moved(self.settings.parameter, change)?;
        self.outcome = system.newton(&mut point, self.part, Some(&self.along(&self.tangent)))?;
        (self.point, self.system) = (point, system);
        Ok(())
    }

    /// Returns the branch to its end.
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
    fn walk(&mut self, branch: &mut Branch, seen: Seen<'_>) -> Result<BranchEnd, SteadyError> {
        let Continuation { range: [low, high], largest_step, most_points, .. } = self.settings;
        let mut step = FIRST_STEP * largest_step;
        // Special points before the next one, and the end if it is the last.
        let (mut special, mut end) = (Vec::<SpecialPoint>::new(), None);
        loop {
            self.settle_nodes()?;
            let goes_on =
                self.record(branch, std::mem::take(&mut special), !matches!(end, Some(BranchEnd::Rest)), seen)?;
            if let Some(end) = end {
                return Ok(end);
            }
            if !goes_on {
                return Ok(BranchEnd::Stopped);
            }
            if branch.points.len() >= most_points {
                return Ok(BranchEnd::MostPoints);
            }
            let before = self.place();
            while let Err(error) = self.advance(step) {
                if step < LEAST_STEP * largest_step {
                    return Err(error);
                }
                step *= SHORTER;
            }
            let taken = step;
            if self.outcome.iterations <= QUICK {
                step = (LONGER * step).min(largest_step);
            }
            let on_branch = branch.points.len() > 1;
            if !(low..=high).contains(&self.value()) && on_branch {
                self.land(&before, if self.value() < low { low } else { high })?;
                end = Some(BranchEnd::Range);
                continue;
            }
            // Between slopes of the parameter of opposite sign there is a fold.
            self.turn(&before.tangent)?;
            let slopes = [before.tangent[self.size()], self.tangent[self.size()]];
            if slopes[0] * slopes[1] < 0.0 && on_branch {
                let (after, outcome) = (self.place(), self.outcome);
                let fold = self.fold(&before, taken, slopes);
                let swims = self.system.model.imposed().is_none();
                if swims && self.part == Part::Even && before.point.frame[0] * after.point.frame[0] < 0.0 {
                    // The velocity has changed its sign: no fold, but the branch at rest, which this one joins.
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

    /// Takes the droplet as its own base with redistributed nodes if they resolve it better. Nodes that follow a
    /// droplet which they hardly resolve follow their own errors more and more.
    fn settle_nodes(&mut self) -> Result<(), SteadyError> {
        let (point, tangent, outcome) = (self.point.clone(), self.tangent.clone(), self.outcome);
        let (far, tail) = (self.system.is_far(&point), self.system.tail(&point)?.max(RESOLVED));
        let forward = tangent[self.size()];
        let better = self.rebase().and_then(|()| {
            let onward = self.tangent[self.size()] * forward >= 0.0;
            Ok(onward && (far || self.system.tail(&self.point)? < tail))
        });
        if !better.unwrap_or(false) {
            (self.point, self.tangent, self.outcome) = (point, tangent, outcome);
        }
        Ok(())
    }

    /// Takes the droplet as its own base, with redistributed nodes, and finds the tangent over it.
    fn rebase(&mut self) -> Result<(), SteadyError> {
        let range = self.system.modes.part(self.part);
        let [ahead, behind] =
            [DIFFERENCE, -DIFFERENCE].map(|amount| self.system.profile(&self.displaced(amount, &self.tangent)));
        let mut point = self.system.rebased(&self.point)?;
        self.outcome = self.system.newton(&mut point, self.part, None)?;
        // The new base is centred at x = 0; the tangent does not hold that shift.
        let shift = self.system.profile(&self.point).moments()?.centroid.x;
        let over = |mut profile: Profile| -> Result<Option<Fields>, SteadyError> {
            profile.shift(-shift);
            profile.over(&point.base.positions, &point.base.normals)
        };
        let mut tangent = self.tangent.clone();
        let mut rows = tangent.rows_mut(0, range.len());
        if let (Some((h, m)), Some((h_behind, m_behind))) = (over(ahead)?, over(behind)?) {
            let difference = |a: &[f64], b: &[f64]| -> Vec<f64> {
                a.iter().zip(b).map(|(a, b)| (a - b) / (2.0 * DIFFERENCE)).collect()
            };
            let whole = self.system.modes.analyse(&difference(&h, &h_behind), &difference(&m, &m_behind))?;
            rows.copy_from(&whole.rows(range.start, range.len()));
        } else {
            rows.fill(0.0);
        }
        self.point = point;
        self.turn(&tangent)
    }

    /// Adds the present point to a branch, with the special points before it; between points where modes cross zero
    /// growth these are `special` and the ones of `crossings`.
    fn record(
        &self,
        branch: &mut Branch,
        mut special: Vec<SpecialPoint>,
        with_crossings: bool,
        seen: Seen<'_>,
    ) -> Result<bool, SteadyError> {
        let (parameter, state) = (self.settings.parameter, self.state()?);
        let next = BranchPoint { value: self.value(), spectrum: state.spectrum()?, state };
        if let Some(last) = branch.points.last().filter(|_| with_crossings) {
            for point in crossings(parameter, last, &next) {
                if !branch.special.iter().chain(&special).any(|old| is_same(old, &point)) {
                    special.push(point);
                }
            }
        }
        let goes_on = seen(&next, &special);
        branch.special.append(&mut special);
        branch.points.push(next);
        Ok(goes_on)
    }

    fn state(&self) -> Result<SteadyState, SteadyError> {
        SteadyState::of(&self.system, self.point.clone(), self.outcome, self.part)
    }

    fn place(&self) -> Place {
        Place { point: self.point.clone(), setup: self.system.model.setup.clone(), tangent: self.tangent.clone() }
    }

    fn go_to(&mut self, place: &Place) -> Result<(), SteadyError> {
        self.system = System::new(&place.setup)?;
        (self.point, self.tangent) = (place.point.clone(), place.tangent.clone());
        Ok(())
    }

    /// Goes back from beyond the range of the parameter to its end.
    fn land(&mut self, before: &Place, goal: f64) -> Result<(), SteadyError> {
        let start = self.settings.parameter.get(&before.setup).unwrap_or(f64::NAN);
        let beyond = (self.value() - goal) / (self.value() - start);
        self.point.state = beyond * &before.point.state + (1.0 - beyond) * &self.point.state;
        self.system = System::new(&self.settings.parameter.with(&before.setup, goal)?)?;
        self.outcome = self.system.newton(&mut self.point, self.part, None)?;
        Ok(())
    }

    /// Returns the fold within a step, by the rule of false position (with Illinois' modification) on the slope of the
    /// parameter along the branch, from the slopes at both ends.
    fn fold(&mut self, before: &Place, step: f64, ends: [f64; 2]) -> Result<SpecialPoint, SteadyError> {
        let (mut low, mut high) = ((0.0, ends[0]), (step, ends[1]));
        for _ in 0..MOST_ITERATIONS {
            let middle = low.0 - low.1 * (high.0 - low.0) / (high.1 - low.1);
            self.go_to(before)?;
            self.advance(middle)?;
            self.turn(&before.tangent)?;
            let slope = self.tangent[self.size()];
            // The parameter is then right to the square of this.
            if slope.abs() < NO_EFFECT {
                break;
            }
            // The end that stays counts half.
            if slope * low.1 > 0.0 {
                low = (middle, slope);
                high.1 *= 0.5;
            } else {
                high = (middle, slope);
                low.1 *= 0.5;
            }
        }
        let state = self.state()?;
        let size = |mode: &Eigenmode| mode.value.norm();
        let mode = state.spectrum()?.modes.into_iter().min_by(|a, b| size(a).total_cmp(&size(b)));
        let mode = mode.ok_or_else(|| SteadyError::singular("a fold", "Use more nodes"))?;
        Ok(SpecialPoint::new(SpecialKind::Fold, Critical { state, mode }, self.settings.parameter))
    }
}

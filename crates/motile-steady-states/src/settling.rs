//! Steady states from a description: implicit steps in time, then Newton's method.

use std::f64::consts::TAU;

use motile::setup::{IntegralMethod, Method, Setup};
use motile_base::Vec2;
use motile_base::internal::Refuse as _;
use nalgebra::{DMatrix, DVector};

use crate::collapse;
use crate::iteration::{LARGEST_CHANGE, LEAST_PART, Outcome, SHORTER, USUAL_CHANGE, in_steps};
use crate::modes::Part;
use crate::profile::{CROWDING, RESOLVED};
use crate::spectrum::{Eigenmode, Symmetry};
use crate::system::{Point, System};
use crate::{Parameter, Profile, SteadyError, SteadyState};

/// Problem of a droplet that has come to a wall on the way.
const AT_WALL: &str = "on the way to a steady state, the droplet comes to a wall and stays there";
/// Distance from a wall, over the distance of the finest nodes on the way, below which the droplet touches it, and the
/// steps shorter than `R^2/D` after which it counts as stuck there.
const TOUCHING: f64 = 0.1;
const STUCK: usize = 3;
/// Number of nodes on the way to a state, and the most where the droplet on the way needs more.
const COARSE: usize = 64;
const FINEST: usize = 160;
/// Way of settling that is tried.
#[derive(Debug, Clone, Copy)]
struct Attempt {
    /// Most nodes on the way, or none to stay at the first ones.
    most_nodes: Option<usize>,
    /// Change of the coefficients in a time R^2/D below which Newton's method takes over.
    steady: f64,
    /// Fraction of the usual change of the coefficients in a step.
    part: f64,
}

/// Attempts, the quickest first, the last ones with shorter steps.
const ATTEMPTS: [Attempt; 4] = [
    Attempt { most_nodes: None, steady: 0.02, part: 1.0 },
    Attempt { most_nodes: Some(FINEST), steady: 0.02, part: 1.0 },
    Attempt { most_nodes: Some(FINEST), steady: 0.003, part: 1.0 },
    Attempt { most_nodes: Some(FINEST), steady: 0.003, part: 0.2 },
];
/// Fraction of the activity at which a state is looked for if there is none in reach at the whole.
const WEAKER: f64 = 0.5;
/// Largest relative change of the velocity by Newton's method: more is another state than the one settled to.
const SAME_VELOCITY: f64 = 0.3;
/// First step in time, in units of R^2/D: an implicit step longer than the time in which a disturbance grows would
/// reverse that disturbance, and with it the direction of swimming.
const FIRST_STEP: f64 = 5e-3;
/// Growth of the rates in a step that is still taken. Instabilities on the way grow by some e in a step, and rates of
/// short waves that grow more show a step too long for them.
const LARGEST_GROWTH: f64 = 3.0;
/// Speed over D/R of a droplet at rest, far above the error of nodes.
const AT_REST: f64 = 1e-3;
/// Speed over D/R of a droplet that may turn round in a long step.
const SLOW: f64 = 1e-2;
/// Steps in time before giving up, of the usual length; a droplet that settles takes about thirty.
const MOST_STEPS: usize = 80;

impl SteadyState {
    /// Finds the steady state that a description leads to, a swimmer or a drop in an imposed flow. It takes implicit
    /// steps in time from the start that the description gives, on few nodes, then Newton's method at the nodes asked
    /// for. A start that is its own mirror image at the x axis leads to a state that is, too. A start that swims does
    /// not lead to a droplet at rest that is unstable: this is tried again with shorter steps. If this fails, it is
    /// done at half the activity, and the activity then raised in steps. If particles diffuse inside, it starts from
    /// the state with a well-mixed inside, and if that is not near, from the description.
    ///
    /// # Errors
    /// Returns an error for a description of anything but one round droplet (with rigid discs inside, if any) by the
    /// method of boundary integrals; no convergence; a state that the nodes do not resolve. If the excluded volume does
    /// not balance the activity at any concentration, the particles gather to a point, and the error says so.
    pub fn find(setup: &Setup) -> Result<Self, SteadyError> {
        System::new(setup)?;
        match collapse::refusal(setup) {
            Some(error) => Err(error),
            None => Self::searched(setup).map_err(|error| collapse::explained(setup, error)),
        }
    }

    /// Finds the steady state.
    fn searched(setup: &Setup) -> Result<Self, SteadyError> {
        Self::settled(setup).or_else(|error| {
            if matches!(&error, SteadyError::Refused(refusal) if refusal.what == AT_WALL) {
                return Err(error);
            }
            let goal = Parameter::Activity.get(setup).unwrap_or(f64::NAN);
            let at = |part: f64| Parameter::Activity.with(setup, part * goal);
            let start = at(WEAKER).and_then(|setup| Self::settled(&setup)).map_err(|_| error)?;
            let found = in_steps((start, WEAKER), 0.5 * (1.0 - WEAKER), |last, part| {
                let missed = |_| {
                    let from = Parameter::Activity.get(last.setup()).unwrap_or(f64::NAN);
                    let remedy =
                        "Follow the branch from the first activity, because it may turn back or need more nodes";
                    SteadyError::not_found("a steady swimmer as the activity changes", [from, goal], remedy)
                };
                let frame = last.point().frame;
                Self::from_profile(&at(part)?, last.profile(), frame, last.part()).map_err(missed)
            })?;
            if found.is_left() { Err(at_rest()) } else { Ok(found) }
        })
    }

    /// Creates a state by steps in time and Newton's method, in a few attempts.
    fn settled(setup: &Setup) -> Result<Self, SteadyError> {
        let start = start(setup)?;
        let mirror = is_mirror(&start) && System::new(setup)?.model.is_mirror_symmetric();
        let part = if mirror { Part::Even } else { Part::Full };
        check_axis(setup, part)?;
        // A field inside costs a hundred times a well-mixed inside, whose state is near.
        if let Some(mixed) = well_mixed(setup) {
            let near = Self::settled(&mixed).and_then(|mixed| {
                let found = Self::from_profile(setup, mixed.profile(), mixed.point().frame, part)?;
                let change = found.velocity().distance(mixed.velocity());
                Ok((change < SAME_VELOCITY * mixed.velocity().length(), found))
            });
            if let Ok((true, found)) = near {
                return Ok(found);
            }
        }
        let mut failure = Outcome::default().failure();
        for attempt in ATTEMPTS {
            let mut settling = Settling::new(setup, &start, part, attempt)?;
            let swims = settling.swims();
            let found = settling.settle().and_then(|()| {
                let Settling { system, point, .. } = &settling;
                Self::from_profile(setup, &system.profile(point), point.frame, part)
            });
            let model = &settling.system.model;
            let unit = model.radius * model.rate_unit();
            let near = |a: f64, b: f64| (a - b).abs() < SAME_VELOCITY * (a.abs() + unit);
            match found {
                Ok(found) => {
                    let (ours, settled) = (found.point().frame, settling.point.frame);
                    if !(near(ours[0], settled[0]) && near(ours[1], settled[1])) {
                        failure = found.outcome().failure();
                    } else if swims && found.is_left() {
                        failure = at_rest();
                    } else {
                        return Ok(found);
                    }
                }
                // A state that runs away, to no numbers in the end.
                Err(SteadyError::Flow(_) | SteadyError::Input(_)) => failure = settling.failure(MOST_STEPS),
                // More attempts would take minutes.
                Err(SteadyError::Refused(refusal)) if refusal.what == AT_WALL => return Err(refusal.into()),
                Err(error) => failure = error,
            }
        }
        Err(failure)
    }

    /// Returns true for a droplet at rest, without an imposed flow, that a swimmer cannot have settled to: disturbances
    /// with its symmetry grow, as far as they are known.
    fn is_left(&self) -> bool {
        let (Ok(system), speed) = (System::new(self.setup()), self.velocity().length()) else { return false };
        if !system.model.imposed().is_none() || speed > AT_REST * self.diffusion_rate() * system.model.radius {
            return false;
        }
        let Ok(spectrum) = self.spectrum() else { return false };
        let own = |mode: &&Eigenmode| self.part() == Part::Full || mode.symmetry == Symmetry::Symmetric;
        spectrum.modes.iter().filter(own).any(|mode| mode.value.re > spectrum.zero)
    }
}

/// Returns the error of a search that has ended at a droplet at rest.
fn at_rest() -> SteadyError {
    SteadyError::unsupported(
        "the search for a swimmer ended at the droplet at rest, which is unstable, even with short steps",
        "Start from a run, or follow the branch of swimmers from a point where it is found",
    )
}

/// Way of a droplet to a steady state by implicit Euler steps, which grow as the rates fall.
struct Settling {
    system: System,
    point: Point,
    /// Part of the state that changes.
    part: Part,
    /// Rates of change of the coefficients at the point (1/time).
    rates: DVector<f64>,
    /// Next step in time (time).
    step: f64,
    attempt: Attempt,
    /// Short steps at a wall so far.
    at_wall: usize,
}

impl Settling {
    fn new(setup: &Setup, start: &Profile, part: Part, attempt: Attempt) -> Result<Self, SteadyError> {
        let mut system = System::new(&with_nodes(setup, COARSE))?;
        let profile = start.resampled(system.model.nodes(), 0.0)?.centred()?;
        profile.check_room(setup)?;
        let point = system.point(&profile, [0.0; 3])?;
        let rates = system.residual(&point)?;
        let step = FIRST_STEP / system.model.rate_unit();
        Ok(Self { system, point, part, rates, step, attempt, at_wall: 0 })
    }

    /// Returns true if the droplet moves by itself.
    fn swims(&self) -> bool {
        let model = &self.system.model;
        model.carries() && model.imposed().is_none() && !model.is_at_rest()
    }

    /// Steps until one of R^2/D or more changes all coefficients by less than the attempt has it.
    fn settle(&mut self) -> Result<(), SteadyError> {
        let Attempt { most_nodes, steady, part } = self.attempt;
        let most_steps = (MOST_STEPS as f64 / part) as usize;
        for _ in 0..most_steps {
            let change = self.advance()?;
            if change < steady && self.step * self.system.model.rate_unit() > 1.0 {
                self.point = self.system.rebased(&self.point)?;
                return Ok(());
            }
            self.stay_off_walls()?;
            self.step *= (part * USUAL_CHANGE / change).clamp(0.5, 2.0);
            let strained = most_nodes.is_some() && self.system.tail(&self.point)? > RESOLVED;
            if strained || self.system.is_far(&self.point) {
                self.rebase()?;
            }
        }
        Err(self.failure(most_steps))
    }

    /// Refuses a droplet that stays at a wall without becoming steady there.
    fn stay_off_walls(&mut self) -> Result<(), SteadyError> {
        let model = &self.system.model;
        let Some(film) = self.system.profile(&self.point).film(&model.setup) else { return Ok(()) };
        let touches = film < TOUCHING * TAU * model.radius / FINEST as f64;
        self.at_wall = if touches && self.step * model.rate_unit() < 1.0 { self.at_wall + 1 } else { 0 };
        if self.at_wall < STUCK {
            return Ok(());
        }
        let remedy = "Run the scene to see where the droplet goes. For a state with such a film, follow a branch to it";
        Err(SteadyError::refused(AT_WALL, format!("the film is {film:.1e} thick"), remedy))
    }

    /// Takes one step, shortened until it succeeds; returns the largest change of a coefficient.
    fn advance(&mut self) -> Result<f64, SteadyError> {
        let jacobian = self.system.rough_jacobian(&self.point, self.part, &self.rates)?;
        let shortest = LEAST_PART * FIRST_STEP / self.system.model.rate_unit();
        loop {
            match self.attempt(&jacobian) {
                Err(_) if self.step > shortest => self.step *= SHORTER,
                outcome => return outcome,
            }
        }
    }

    /// Solves (J - 1/dt) dx = -dx/dt, with the conserved quantities and the frame as in Newton's method, and goes
    /// there unless the change is too large, the rates grow too much, or a long step turns the swimmer round.
    fn attempt(&mut self, jacobian: &DMatrix<f64>) -> Result<f64, SteadyError> {
        let damped = jacobian - DMatrix::identity(jacobian.nrows(), jacobian.ncols()) / self.step;
        let equations = self.system.border(&self.point, self.part, &damped, None)?;
        let correction = self.system.correction(&equations, &self.rates)?;
        let change = correction.state.amax();
        if change > LARGEST_CHANGE {
            return Err(self.failure(1));
        }
        let next = self.point.corrected(&correction, 1.0);
        let [[x, y, _], [to_x, to_y, _]] = [self.point.frame, next.frame];
        let model = &self.system.model;
        let slow = (SLOW * model.rate_unit() * model.radius).powi(2);
        if model.carries() && x * to_x + y * to_y < -slow && self.step * model.rate_unit() > FIRST_STEP {
            return Err(self.failure(1));
        }
        let rates = self.system.residual(&next)?;
        if rates.iter().all(|rate| rate.abs() < LARGEST_GROWTH * self.rates.amax()) {
            (self.point, self.rates) = (next, rates);
            Ok(change)
        } else {
            Err(self.failure(1))
        }
    }

    /// Takes the droplet as its own base, with more nodes if it needs and may have them.
    fn rebase(&mut self) -> Result<(), SteadyError> {
        self.point = self.system.rebased(&self.point)?;
        if let Some(most) = self.attempt.most_nodes {
            let mut tail = self.system.tail(&self.point)?;
            while tail > RESOLVED && self.system.model.nodes() < most {
                let nodes = (self.system.model.nodes() / 8 * 10).min(most);
                let profile = self.system.profile(&self.point).resampled(nodes, CROWDING)?;
                self.system = System::new(&with_nodes(&self.system.model.setup, nodes))?;
                self.point = self.system.point(&profile, self.point.frame)?;
                tail = self.system.tail(&self.point)?;
            }
        }
        self.rates = self.system.residual(&self.point)?;
        Ok(())
    }

    fn failure(&self, iterations: usize) -> SteadyError {
        Outcome { iterations, residual: self.rates.amax(), ..Outcome::default() }.failure()
    }
}

/// Returns the description at another number of nodes.
fn with_nodes(setup: &Setup, nodes: usize) -> Setup {
    Setup { method: Method::Integral(IntegralMethod { nodes, elements: 4 * nodes }), ..setup.clone() }
}

/// Returns the description with particles that are well mixed inside, where they diffuse in this one.
fn well_mixed(setup: &Setup) -> Option<Setup> {
    let mut setup = setup.clone();
    setup.droplets.first_mut()?.particles.as_mut()?.exchange.as_mut()?.diffusion_inside.take()?;
    Some(setup)
}

/// Returns the droplet from which a run of a description starts, with its discs.
fn start(setup: &Setup) -> Result<Profile, SteadyError> {
    let nodes = System::new(setup)?.model.nodes();
    let fine = with_nodes(setup, nodes.max(2 * COARSE));
    let droplet = fine.droplet(&fine.droplets[0])?;
    let nuclei = setup.rigid_bodies.iter().map(|body| Vec2::from(body.centre)).collect();
    // Numbers over lengths, in three dimensions too: a density is one per length of a ring.
    let sizes = droplet.element_sizes().iter().zip(droplet.element_lengths());
    let mut numbers: Vec<f64> =
        droplet.particle_numbers().iter().zip(sizes).map(|(number, (size, length))| number * length / size).collect();
    // A droplet without particles has none on any segment.
    numbers.resize(droplet.markers().len(), 0.0);
    Ok(Profile::from_markers(droplet.markers(), &numbers)?.with_nuclei(nuclei))
}

/// Refuses a droplet off the axis, or that swims aside, in three dimensions.
pub(crate) fn check_axis(setup: &Setup, part: Part) -> Result<(), SteadyError> {
    if setup.region.is_axisymmetric() && part != Part::Even {
        return Err(SteadyError::unsupported(
            "the droplet is not axisymmetric about the x axis",
            "Put its centre on the axis and its heading along it, or use a two-dimensional region",
        ));
    }
    Ok(())
}

/// Returns true for a droplet that is its own mirror image at the x axis, to the six digits in which squeezed shapes
/// are.
fn is_mirror(profile: &Profile) -> bool {
    let other = profile.mirrored();
    let largest = profile.density.iter().fold(0.0, |a: f64, b| a.max(b.abs()));
    let places = |profile: &Profile| profile.positions.iter().chain(&profile.nuclei).copied().collect::<Vec<_>>();
    let size = profile.positions.iter().map(|place| place.distance(profile.positions[0])).fold(0.0, f64::max);
    places(profile).iter().zip(places(&other)).all(|(a, b)| a.distance(b) < 5e-7 * size)
        && profile.density.iter().zip(&other.density).all(|(a, b)| (a - b).abs() <= 1e-6 * largest)
}

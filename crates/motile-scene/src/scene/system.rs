//! Bodies in a fluid: the system of equations that an integrator advances.

mod bodies;
mod contacts;
mod findings;
mod gaps;
mod handles;
mod imposed;
mod interior_bodies;
mod parts;
mod resistance;
mod state;

use crate::{
    Body, Handle, Hydrodynamics, Markers, SceneError,
    body::{StepCause, StepInfo, StepLimit},
    gap::Boundary,
    hydrodynamics::FlowWork,
    saved_state::{Record, SavedState},
};
use bodies::Bodies;
use contacts::Contacts;
pub(crate) use findings::Findings;
use imposed::Background;
pub use imposed::Imposed;
pub(crate) use imposed::flow_properties;
use motile_base::{FlowSample, SolveReport, Vec2};
use resistance::Resistance;

/// Velocities at the same state by the same method differ by at most this fraction of the fastest one, on any machine,
/// and by this multiple of the residual where they are iterated.
const SAME_FLOW: f64 = 1e-9;
const REACHED: f64 = 10.0;

/// Knowledge of the present state of the bodies; each degree includes those before it.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
enum Known {
    /// A body may have been changed in any way.
    Nothing,
    /// The bodies belong to the groups of markers, and have another state.
    Bodies,
    /// The markers are where the bodies have them.
    Places,
    /// The surfaces are laid out.
    Surfaces,
    /// The gaps are found, and the bodies lie as they may.
    Apart,
    /// The markers hold the flow.
    Flow,
}

/// Time and steps since the start of a scene.
#[derive(Debug, Clone, Copy)]
struct Clock {
    /// Time (time).
    time: f64,
    steps: usize,
    /// The next step is the first since bodies were put in or changed: no step before it shows how fast they move,
    /// which bounds its length.
    first_step: bool,
}

impl Clock {
    /// Creates the time 0, before the first step.
    fn new() -> Self {
        Self { time: 0.0, steps: 0, first_step: true }
    }

    /// Counts a step of `dt` (time).
    fn advance(&mut self, dt: f64) {
        self.time += dt;
        self.steps += 1;
    }
}

/// The bodies of a scene, the fluid between them, and the time.
///
/// Integrators advance it, and observers measure it.
#[derive(Debug)]
pub struct System<H> {
    hydrodynamics: H,
    pub(super) bodies: Bodies,
    pub(super) contacts: Contacts,
    clock: Clock,
    pub(crate) findings: Findings,
    report: SolveReport,
    known: Known,
    background: Background,
    resistance: Resistance,
    origin: String,
}

impl<H: Hydrodynamics> System<H> {
    pub(crate) fn new(hydrodynamics: H) -> Self {
        Self {
            hydrodynamics,
            bodies: Bodies::new(),
            contacts: Contacts::default(),
            clock: Clock::new(),
            findings: Findings::default(),
            report: SolveReport::default(),
            known: Known::Nothing,
            background: Background::none(),
            resistance: Resistance::default(),
            origin: String::new(),
        }
    }

    /// Adds a body.
    pub(crate) fn push<B: Body>(&mut self, body: B) -> Handle<B> {
        let handle = self.bodies.push(body);
        self.clock.first_step = true;
        self.bodies.find_timed(self.clock.time);
        self.forget_flow();
        self.record_wall_gap();
        handle
    }

    /// Returns the time since the start (time).
    #[must_use]
    pub fn time(&self) -> f64 {
        self.clock.time
    }

    /// Returns the number of steps since the start.
    #[must_use]
    pub fn steps(&self) -> usize {
        self.clock.steps
    }

    /// Takes the round-off of summed steps off the time.
    pub(crate) fn set_time(&mut self, time: f64) -> Result<(), SceneError> {
        self.clock.time = time;
        self.set_flow_time()
    }

    /// Records that a step has ended and is accepted.
    pub(crate) fn commit(&mut self, dt: f64) {
        self.clock.advance(dt);
        if self.bodies.timed {
            // As a run that is resumed here.
            self.follow_clock();
        }
        self.bodies.list.iter_mut().for_each(|body| body.keep_step());
        self.record_wall_gap();
        self.record_gap();
    }

    /// Returns the method that computes the flow.
    #[must_use]
    pub fn hydrodynamics(&self) -> &H {
        &self.hydrodynamics
    }

    /// Returns the positions, forces and velocities of all markers as of the last evaluation; [`System::evaluate`]
    /// brings them to the present state.
    #[must_use]
    pub fn markers(&self) -> &Markers {
        &self.bodies.markers
    }

    /// Returns the iterations, residual and mean pressure gradient of the last evaluation.
    #[must_use]
    pub fn report(&self) -> &SolveReport {
        &self.report
    }

    /// Returns the work of all evaluations since the start, those before a checkpoint included ([`Hydrodynamics::work`]
    /// counts from where the program began, and all that looks at the flow).
    #[must_use]
    pub fn work(&self) -> FlowWork {
        self.findings.work
    }

    /// Returns the origin of the results: the version of motile, the fingerprint of the description and, in a run of
    /// the program `motile`, its command. Files of results carry this text. It is empty in a scene that you put
    /// together by hand.
    #[must_use]
    pub fn origin(&self) -> &str {
        &self.origin
    }

    /// Sets the origin of the results ([`System::origin`]), for example to add the name of your program. Ends of lines
    /// become spaces.
    pub fn set_origin(&mut self, origin: impl Into<String>) {
        self.origin = origin.into().replace(|c: char| c.is_control(), " ");
    }

    /// Returns the record that an observer keeps under a name; `None` if there is none.
    #[must_use]
    pub fn record(&self, name: &str) -> Option<&Record> {
        self.findings.records.get(name)
    }

    /// Returns the record that an observer keeps under a name, empty at first. Checkpoints hold it, so that what is
    /// measured over a run covers the whole run if the run continues from a checkpoint.
    pub fn record_mut(&mut self, name: &str) -> &mut Record {
        self.findings.records.entry(name.to_owned()).or_default()
    }

    /// Parameters of the scene besides its bodies and its domain, by their names.
    pub(crate) fn properties(&self) -> Vec<(String, f64)> {
        let view = self.hydrodynamics.fluid_view();
        let mut properties = vec![("the exterior viscosity", view.viscosity)];
        let nodes = view.shape_modes.map(|nodes| ("the number of nodes of an interface", nodes as f64));
        properties.extend(nodes);
        properties.extend(self.hydrodynamics.drive().map(|drive| {
            let gradient = ("the imposed pressure gradient", drive.gradient());
            drive.flux().map_or(gradient, |flux| ("the imposed flux", flux))
        }));
        properties.extend(self.hydrodynamics.walls().into_iter().flat_map(wall_properties));
        if let Some(repulsion) = &self.contacts.repulsion {
            properties.push(("the strength of the repulsion", repulsion.strength()));
            properties.push(("the range of the repulsion", repulsion.range()));
        }
        properties.into_iter().map(|(name, value)| (name.to_owned(), value)).collect()
    }

    /// Returns true if [`System::markers`] holds the flow of the present state.
    #[must_use]
    pub fn is_evaluated(&self) -> bool {
        self.known == Known::Flow
    }

    /// Returns true if bodies have been put in or changed since the last step.
    pub(crate) fn is_unmoved(&self) -> bool {
        self.clock.first_step
    }

    /// Takes over the state of a checkpoint.
    pub(crate) fn load<'a>(
        &mut self,
        mut bodies: impl Iterator<Item = &'a SavedState>,
        flow: &SavedState,
        time: f64,
        steps: usize,
    ) -> Result<(), SceneError> {
        self.known = Known::Nothing;
        // Later on bodies have saved how fast they move.
        self.clock = Clock { time, steps, first_step: steps == 0 };
        self.hydrodynamics.load(flow);
        self.set_flow_time()?;
        let view = self.hydrodynamics.fluid_view();
        self.bodies.try_each(time, |_, body, _| bodies.next().map_or(Ok(()), |saved| body.load(&view, saved)))?;
        self.find_gaps();
        Ok(())
    }

    /// Forgets how fast the bodies move: the next step is bounded like a first one.
    pub(crate) fn forget_motion(&mut self) {
        self.clock.first_step = true;
    }

    /// Takes over velocities that were computed at the present state, if they are those that are found here: another
    /// grid, kernel or treatment of surfaces has others.
    pub(crate) fn take_flow(
        &mut self,
        flow: &SavedState,
        velocities: impl ExactSizeIterator<Item = Vec2> + Clone,
        report: SolveReport,
    ) -> Result<(), SceneError> {
        if velocities.len() != self.bodies.markers.len() {
            let (found, expected) = (velocities.len(), self.bodies.markers.len());
            let problem = format!("it has the velocities of {found} markers, the scene has {expected}");
            return Err(SceneError::foreign_checkpoint(problem));
        }
        // For all that a flow makes of its markers, such as what it samples from. The velocities come out the same only
        // to the tolerance of its iterations, so those that were found take their place, and so does what the next
        // iteration starts from.
        self.hydrodynamics.rewind();
        let stresses = Resistance::save(&mut self.bodies);
        self.compute_flow()?;
        let here = &self.bodies.markers.velocities;
        let fastest = here.iter().map(|velocity| velocity.length()).fold(0.0, f64::max);
        let bound = fastest * (SAME_FLOW + REACHED * report.residual.max(self.report.residual));
        if here.iter().zip(velocities.clone()).all(|(here, there)| (here - there).length() <= bound) {
            self.hydrodynamics.load(flow);
            self.bodies.markers.velocities.iter_mut().zip(velocities).for_each(|(to, from)| *to = from);
            self.report = report;
            self.resistance.restore(&mut self.bodies, &stresses);
        }
        self.take_films();
        Ok(())
    }

    /// Computes forces and velocities at the present state, unless they are known already.
    ///
    /// # Errors
    /// Returns the errors of the bodies' forces and of the flow.
    pub fn evaluate(&mut self) -> Result<&Markers, SceneError> {
        if self.known != Known::Flow {
            self.check_bodies()?;
            self.compute_flow()?;
            self.take_films();
        }
        Ok(&self.bodies.markers)
    }

    /// Writes the flow at `points` in the present state; see [`Hydrodynamics::sample`]. Points beyond a wall are not
    /// refused: they get a continuation of the flow that means nothing.
    ///
    /// # Errors
    /// Returns the errors of [`System::evaluate`] and of the sampling.
    pub fn sample(&mut self, points: &[Vec2], out: &mut [FlowSample]) -> Result<(), SceneError> {
        self.evaluate()?;
        let time = self.clock.time;
        self.hydrodynamics.sample(&self.bodies.markers, points, out).map_err(|source| SceneError::Flow { time, source })
    }

    /// Returns the smallest of the bodies' stable time steps at the present state for the midpoint rule, with the
    /// body's name.
    #[must_use]
    pub fn step_limit(&self) -> Option<(StepLimit, &str)> {
        let mut least: Option<(StepLimit, &str)> = None;
        self.each_limit(&mut |limit, body| {
            if least.is_none_or(|(shortest, _)| limit.dt.total_cmp(&shortest.dt).is_lt()) {
                least = Some((limit, body));
            }
        });
        least
    }

    /// Reports to `each` all bounds on the time step at the present state, with the names of the bodies that set them.
    pub fn each_limit<'a>(&'a self, each: &mut dyn FnMut(StepLimit, &'a str)) {
        let view = self.hydrodynamics.fluid_view();
        let part = self.contacts.stabilised_part(&view);
        for (body, &outside) in self.bodies.list.iter().zip(&self.bodies.viscosity_around) {
            body.step_limits(&view.in_fluid(outside), &mut |limit| {
                let stabilised = matches!(limit.cause, StepCause::Stabilised { .. });
                each(if stabilised { StepLimit { dt: part * limit.dt, ..limit } } else { limit }, body.name());
            });
        }
        self.contacts.each_limit(&self.bodies, view.viscosity, each);
    }

    /// Forgets the flow: the bodies have another state.
    fn forget_flow(&mut self) {
        self.known = self.known.min(Known::Bodies);
    }

    /// Puts the markers where the bodies have them.
    fn place_markers(&mut self) {
        if self.known >= Known::Places {
            return;
        }
        self.bodies.place_markers(self.known > Known::Nothing);
        self.contacts.nearest_wall = None;
        self.known = Known::Places;
    }

    /// Lays out the surfaces of the bodies where they are.
    fn lay_out(&mut self) {
        self.place_markers();
        if self.known < Known::Surfaces {
            self.contacts.lay_out(&self.bodies, *self.hydrodynamics.fluid_view().domain.periods);
            self.known = Known::Surfaces;
        }
    }

    fn compute_flow(&mut self) -> Result<(), SceneError> {
        let (view, time) = (self.hydrodynamics.fluid_view(), self.clock.time);
        self.place_markers();
        self.bodies.write_forces(&view, time)?;
        if self.contacts.repulsion.is_some() {
            self.lay_out();
            self.contacts.push_apart(&mut self.bodies, &self.hydrodynamics);
        }
        let before = self.hydrodynamics.work();
        let found = self.resistance.solve(&mut self.hydrodynamics, &mut self.bodies);
        self.findings.work.add(before, self.hydrodynamics.work());
        self.report = found.map_err(|source| SceneError::Flow { time, source })?;
        Ok(())
    }

    /// Measures the films in the flow that the markers hold, which belongs to the present state.
    fn take_films(&mut self) {
        self.lay_out();
        self.contacts.measure_films(&self.bodies, &self.hydrodynamics);
        self.known = Known::Flow;
    }

    pub(crate) fn begin_step(&mut self, step: StepInfo) -> Result<(), SceneError> {
        self.bodies.begin_step(&self.hydrodynamics.fluid_view(), self.clock.time, step)
    }

    pub(crate) fn end_step(&mut self, dt: f64) -> Result<(), SceneError> {
        self.forget_flow();
        self.clock.first_step = false;
        self.bodies.end_step(&self.hydrodynamics.fluid_view(), self.clock.time, dt)
    }
}

/// Returns the numbers that distinguish walls: of sides, their length, and a mean that any displacement changes.
fn wall_properties(walls: &Boundary) -> [(&'static str, f64); 3] {
    let sides = walls.sides();
    let [count, length] = [sides.len() as f64, sides.iter().map(|[start, end]| start.distance(*end)).sum()];
    let reach = walls.corners().map(|place| place.x.abs().max(place.y.abs())).fold(0.0, f64::max);
    // From a point beyond all of them, so that no sum is a difference.
    let beyond = Vec2::new(-2.0 * reach, -3.0 * reach);
    let fourth = walls.corners().map(|place| place.distance(beyond).powi(4)).sum::<f64>() / count;
    [
        ("the number of sides of the walls", count),
        ("the length of the walls", length),
        ("the mean fourth power of the distance of the walls", fourth),
    ]
}

//! Bodies in a fluid: the system of equations that an integrator advances.

mod bodies;
mod forces;
mod gaps;
mod guests;
mod state;

use std::collections::BTreeMap;

use serde::{Deserialize, Serialize};

use super::SceneId;
use crate::{
    Body, BodyError, Handle, Hydrodynamics, Markers, SceneError, Warning,
    body::{StepCause, StepInfo, StepLimit},
    gap::{Films, Gap, Repulsion, Surfaces, Surroundings},
    hydrodynamics::FlowWork,
    saved_state::{Record, SavedState},
};
use forces::write_forces;
use motile_base::{Drive, FlowSample, SolveReport, Vec2};

/// Velocities at the same state by the same method differ by at most this part of the fastest one, on any machine, and
/// by this multiple of the residual where they are iterated.
const SAME_FLOW: f64 = 1e-9;
const REACHED: f64 = 10.0;

/// What was found over all steps of a scene, by counters and observers.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize)]
pub(crate) struct Findings {
    pub(crate) work: FlowWork,
    pub(crate) records: BTreeMap<String, Record>,
    pub(crate) warnings: Vec<(f64, Warning)>,
}

/// Knowledge of the bodies' present state; each step includes those before it.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
enum Known {
    /// A body may have been changed in any way.
    Nothing,
    /// The bodies are those of the groups of markers, and have another state.
    Bodies,
    /// The markers are where the bodies have them.
    Places,
    /// The surfaces are laid out.
    Surfaces,
    /// The markers hold the flow.
    Flow,
}

/// The bodies of a scene, the fluid between them, and the time.
///
/// Integrators advance it, observers look at it.
#[derive(Debug)]
pub struct System<H> {
    id: SceneId,
    hydrodynamics: H,
    bodies: Vec<Box<dyn Body>>,
    /// Bodies that fill others, each after the number of the body that it fills.
    guests: Vec<[usize; 2]>,
    /// Whether there is one that fills a body that is not here.
    stray_guest: bool,
    markers: Markers,
    time: f64,
    steps: usize,
    /// Of all evaluations since the start.
    work: FlowWork,
    /// What observers keep here, by name.
    records: BTreeMap<String, Record>,
    /// Of each body and cause the worst warning that was looked for, and its time.
    pub(super) worst_warnings: Vec<(f64, Warning)>,
    report: SolveReport,
    known: Known,
    /// Whether the bodies are known to lie as they may.
    apart: bool,
    /// Whether bodies have been put in or changed since the last step, so that what bounds a step by how fast they
    /// move is not known.
    unmoved: bool,
    minimum_wall_gap: Option<f64>,
    minimum_gap: Option<f64>,
    surfaces: Surfaces,
    films: Films,
    /// The time in which a film of the present state would close at its velocity, and of which body.
    closing: Option<(f64, usize)>,
    /// How fast a repulsion opens the films of the present state (1/time).
    opening: f64,
    /// The interface that each body lies in, the innermost one, and the viscosity there where that is not the exterior
    /// fluid's.
    enclosing: Vec<Option<usize>>,
    viscosity_around: Vec<Option<f64>>,
    /// The interfaces around the bodies before the last step.
    enclosing_before: Vec<Option<usize>>,
    /// The narrowest gap of the present state.
    narrowest: Option<Gap>,
    pub(crate) least_gap: Option<f64>,
    pub(crate) repulsion: Option<Repulsion>,
}

impl<H: Hydrodynamics> System<H> {
    pub(crate) fn new(hydrodynamics: H) -> Self {
        Self {
            id: SceneId::unique(),
            hydrodynamics,
            bodies: Vec::new(),
            guests: Vec::new(),
            stray_guest: false,
            markers: Markers::new(),
            time: 0.0,
            steps: 0,
            work: FlowWork::default(),
            records: BTreeMap::new(),
            worst_warnings: Vec::new(),
            report: SolveReport::default(),
            known: Known::Nothing,
            apart: false,
            unmoved: true,
            minimum_wall_gap: None,
            minimum_gap: None,
            surfaces: Surfaces::default(),
            films: Films::default(),
            closing: None,
            opening: 0.0,
            enclosing: Vec::new(),
            viscosity_around: Vec::new(),
            enclosing_before: Vec::new(),
            narrowest: None,
            least_gap: None,
            repulsion: None,
        }
    }

    pub(crate) fn push<B: Body>(&mut self, mut body: B) -> Handle<B> {
        self.unmoved = true;
        self.push_guest(&mut body);
        self.markers.push_body(body.marker_count(), body.kind(), body.surfaces());
        self.bodies.push(Box::new(body));
        self.enclosing.push(None);
        self.viscosity_around.push(None);
        self.forget_flow();
        self.apart = false;
        self.record_wall_gap();
        Handle::new(self.id, self.bodies.len() - 1)
    }

    /// Time since the start (time).
    #[must_use]
    pub fn time(&self) -> f64 {
        self.time
    }

    /// Steps since the start.
    #[must_use]
    pub fn steps(&self) -> usize {
        self.steps
    }

    /// Takes the round-off of summed steps off the time.
    pub(crate) fn set_time(&mut self, time: f64) {
        self.time = time;
    }

    /// A step is over and stays.
    pub(crate) fn commit(&mut self, dt: f64) {
        self.time += dt;
        self.steps += 1;
        self.bodies.iter_mut().for_each(|body| body.keep_step());
        self.record_wall_gap();
        self.record_gap();
    }

    /// What computes the flow.
    #[must_use]
    pub fn hydrodynamics(&self) -> &H {
        &self.hydrodynamics
    }

    /// Positions, forces and velocities of all markers as of the last evaluation; [`System::evaluate`] makes them those
    /// of the present state.
    #[must_use]
    pub fn markers(&self) -> &Markers {
        &self.markers
    }

    /// What the last evaluation needed and found.
    #[must_use]
    pub fn report(&self) -> &SolveReport {
        &self.report
    }

    /// Work of all evaluations since the start, those before a checkpoint included ([`Hydrodynamics::work`] counts from
    /// where the program began, and all that looks at the flow).
    #[must_use]
    pub fn work(&self) -> FlowWork {
        self.work
    }

    /// Record that an observer keeps under a name; `None` if there is none.
    #[must_use]
    pub fn record(&self, name: &str) -> Option<&Record> {
        self.records.get(name)
    }

    /// Record that an observer keeps under a name, empty at first. Checkpoints hold it, so that what is measured over a
    /// run is that of the whole run where this goes on from one.
    pub fn record_mut(&mut self, name: &str) -> &mut Record {
        self.records.entry(name.to_owned()).or_default()
    }

    /// All that observers have found: work, records and warnings.
    pub(crate) fn findings(&self) -> Findings {
        let (work, records, warnings) = (self.work, self.records.clone(), self.worst_warnings.clone());
        Findings { work, records, warnings }
    }

    /// Takes over the findings of a checkpoint.
    pub(crate) fn take_findings(&mut self, findings: &Findings) {
        let Findings { work, records, warnings } = findings.clone();
        (self.work, self.records, self.worst_warnings) = (work, records, warnings);
    }

    /// What the scene is made of, besides its bodies and its domain.
    pub(crate) fn properties(&self) -> Vec<(String, f64)> {
        let view = self.hydrodynamics.fluid_view();
        let mut properties = vec![("the exterior viscosity", view.viscosity)];
        let nodes = view.shape_modes.map(|nodes| ("the number of nodes of an interface", nodes as f64));
        properties.extend(nodes);
        properties.extend(self.hydrodynamics.drive().map(|drive| match drive {
            Drive::ZeroGradient => ("the imposed pressure gradient", 0.0),
            Drive::Gradient(gradient) => ("the imposed pressure gradient", gradient),
            Drive::ZeroFlux => ("the imposed flux", 0.0),
            Drive::Flux(flux) => ("the imposed flux", flux),
        }));
        if let Some(repulsion) = &self.repulsion {
            properties.push(("the strength of the repulsion", repulsion.strength()));
            properties.push(("the range of the repulsion", repulsion.range()));
        }
        properties.into_iter().map(|(name, value)| (name.to_owned(), value)).collect()
    }

    /// Whether [`System::markers`] holds the flow of the present state.
    #[must_use]
    pub fn is_evaluated(&self) -> bool {
        self.known == Known::Flow
    }

    /// Whether bodies have been put in or changed since the last step.
    pub(crate) fn is_unmoved(&self) -> bool {
        self.unmoved
    }

    /// Takes over the state of a checkpoint.
    pub(crate) fn load<'a>(
        &mut self,
        bodies: impl Iterator<Item = &'a SavedState>,
        flow: &SavedState,
        time: f64,
        steps: usize,
        [minimum_wall_gap, minimum_gap]: [Option<f64>; 2],
    ) -> Result<(), SceneError> {
        self.known = Known::Nothing;
        self.apart = false;
        // Later on bodies have saved it.
        self.unmoved = steps == 0;
        self.hydrodynamics.load(flow);
        let view = self.hydrodynamics.fluid_view();
        for (body, saved) in self.bodies.iter_mut().zip(bodies) {
            body.load(&view, saved).map_err(|source| body_error(time, body.as_ref(), source))?;
        }
        (self.time, self.steps) = (time, steps);
        (self.minimum_wall_gap, self.minimum_gap) = (minimum_wall_gap, minimum_gap);
        self.find_surroundings();
        Ok(())
    }

    /// Takes over velocities that were computed at the present state, if they are those that are found here: another
    /// grid, kernel or treatment of surfaces has others.
    pub(crate) fn take_flow(
        &mut self,
        flow: &SavedState,
        velocities: impl ExactSizeIterator<Item = Vec2> + Clone,
        report: SolveReport,
    ) -> Result<(), SceneError> {
        if velocities.len() != self.markers.len() {
            let (found, expected) = (velocities.len(), self.markers.len());
            let problem = format!("it has the velocities of {found} markers, the scene has {expected}");
            return Err(SceneError::ForeignCheckpoint { problem });
        }
        // For all that a flow makes of its markers, such as what it samples from. The velocities come out the same only
        // to the tolerance of its iterations, so those that were found take their place, and so does what the next
        // iteration starts from.
        self.compute_flow()?;
        let here = &self.markers.velocities;
        let fastest = here.iter().map(|velocity| velocity.length()).fold(0.0, f64::max);
        let bound = fastest * (SAME_FLOW + REACHED * report.residual.max(self.report.residual));
        if here.iter().zip(velocities.clone()).all(|(here, there)| (here - there).length() <= bound) {
            self.hydrodynamics.load(flow);
            self.markers.velocities.iter_mut().zip(velocities).for_each(|(to, from)| *to = from);
            self.report = report;
        }
        self.measure_films();
        self.known = Known::Flow;
        Ok(())
    }

    /// Computes forces and velocities at the present state, unless they are known already.
    ///
    /// # Errors
    /// Those of the bodies' forces and of the flow.
    pub fn evaluate(&mut self) -> Result<&Markers, SceneError> {
        if self.known != Known::Flow {
            self.check_bodies()?;
            self.compute_flow()?;
            self.measure_films();
            self.known = Known::Flow;
        }
        Ok(&self.markers)
    }

    /// The flow at `points` in the present state; see [`Hydrodynamics::sample`].
    ///
    /// # Errors
    /// Those of [`System::evaluate`] and of the sampling.
    pub fn sample(&mut self, points: &[Vec2], out: &mut [FlowSample]) -> Result<(), SceneError> {
        self.evaluate()?;
        let time = self.time;
        self.hydrodynamics.sample(&self.markers, points, out).map_err(|source| SceneError::Flow { time, source })
    }

    /// The smallest of the bodies' stable time steps at the present state for the midpoint rule, with the body's name.
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

    /// Tells `each` all bounds on the time step at the present state, with the names of the bodies that set them.
    pub fn each_limit<'a>(&'a self, each: &mut dyn FnMut(StepLimit, &'a str)) {
        let view = self.hydrodynamics.fluid_view();
        for (body, &outside) in self.bodies.iter().zip(&self.viscosity_around) {
            body.step_limits(&view.in_fluid(outside), &mut |limit| each(limit, body.name()));
        }
        if let Some((dt, body)) = self.closing {
            let cause = StepCause::Accuracy;
            each(StepLimit { dt, reason: "the closing of a film", cause }, self.bodies[body].name());
        }
        if let Some(repulsion) = &self.repulsion {
            let rate = self.opening.max(repulsion.usual_rate(view.viscosity));
            each(StepLimit::decay(2.0 / rate, "the repulsion"), "the interfaces");
        }
    }

    /// Makes the groups of markers fit the bodies, whose numbers of markers may have changed at the end of a step.
    fn fit_markers(&mut self) {
        let groups = self.markers.groups();
        let fits = self.known > Known::Nothing
            && groups.len() == self.bodies.len()
            && groups.iter().zip(&self.bodies).all(|(g, b)| g.range.len() == b.marker_count() && g.kind == b.kind());
        if !fits {
            self.markers.clear();
            for body in &self.bodies {
                self.markers.push_body(body.marker_count(), body.kind(), body.surfaces());
            }
            self.markers.set_outside(&self.viscosity_around);
        }
    }

    /// What is known of the flow is not of the bodies' present state any more.
    fn forget_flow(&mut self) {
        self.known = self.known.min(Known::Bodies);
    }

    /// Puts the markers where the bodies have them.
    fn place_markers(&mut self) {
        if self.known >= Known::Places {
            return;
        }
        self.fit_markers();
        self.update_hosts();
        let mut start = 0;
        for body in &self.bodies {
            let end = start + body.marker_count();
            body.write_markers(&mut self.markers.positions[start..end]);
            start = end;
        }
        self.known = Known::Places;
    }

    /// Lays out the surfaces of the bodies where they are.
    fn lay_out(&mut self) {
        self.place_markers();
        if self.known < Known::Surfaces {
            let [period, _] = self.hydrodynamics.fluid_view().domain.periods;
            self.surfaces.update(&self.markers, period.unwrap_or(0.0));
            self.known = Known::Surfaces;
        }
    }

    fn compute_flow(&mut self) -> Result<(), SceneError> {
        let (view, time) = (self.hydrodynamics.fluid_view(), self.time);
        self.place_markers();
        if let Some((index, source)) =
            write_forces(0, &mut self.bodies, &self.viscosity_around, &mut self.markers.forces, &view)
        {
            return Err(body_error(time, self.bodies[index].as_ref(), source));
        }
        self.add_guest_forces();
        if let Some(repulsion) = self.repulsion {
            self.lay_out();
            let (domain, walls) = (view.domain, self.hydrodynamics.walls());
            let surroundings = Surroundings { domain, walls, around: &self.enclosing };
            self.films.find(&self.surfaces, surroundings, repulsion.range());
            self.films.push_apart(&repulsion, &self.surfaces, &mut self.markers.forces);
        }
        let before = self.hydrodynamics.work();
        let found = self.hydrodynamics.velocities(&mut self.markers);
        self.work.add(before, self.hydrodynamics.work());
        self.report = found.map_err(|source| SceneError::Flow { time, source })?;
        Ok(())
    }

    pub(crate) fn begin_step(&mut self, step: StepInfo) -> Result<(), SceneError> {
        let (view, time) = (self.hydrodynamics.fluid_view(), self.time);
        for (body, &outside) in self.bodies.iter_mut().zip(&self.viscosity_around) {
            body.begin_step(&view.in_fluid(outside), step).map_err(|source| body_error(time, body.as_ref(), source))?;
        }
        Ok(())
    }

    pub(crate) fn end_step(&mut self, dt: f64) -> Result<(), SceneError> {
        let (view, time) = (self.hydrodynamics.fluid_view(), self.time);
        self.forget_flow();
        self.apart = false;
        self.unmoved = false;
        self.update_hosts();
        for index in 0..self.bodies.len() {
            self.update_host(index);
            let (body, outside) = (&mut self.bodies[index], self.viscosity_around[index]);
            body.end_step(&view.in_fluid(outside), dt).map_err(|source| body_error(time, body.as_ref(), source))?;
        }
        Ok(())
    }
}

fn body_error(time: f64, body: &dyn Body, source: BodyError) -> SceneError {
    SceneError::Body { time, body: body.name().to_owned(), source }
}

//! Bodies in a fluid: the system of equations that an integrator advances.

mod bodies;
mod forces;
mod gaps;
mod guests;
mod state;

pub use bodies::BodyFlow;

use stokes_grid::Drive;

use super::SceneId;
use crate::gap::{Films, Gap, Gaps, Surroundings};
use crate::{
    Body, BodyError, FlowSample, Handle, Hydrodynamics, Markers, Repulsion, SceneError, Vec2,
    body::{StepCause, StepInfo, StepLimit},
    checkpoint::SavedState,
    hydrodynamics::SolveReport,
};
use forces::write_forces;

/// Velocities at the same state by the same method differ by at most this part of the fastest one, on any machine, and
/// by this multiple of the residual where they are iterated.
const SAME_FLOW: f64 = 1e-9;
const REACHED: f64 = 10.0;

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
    report: SolveReport,
    /// Whether the markers hold the flow of the bodies' present state.
    current: bool,
    /// Whether the markers are where the bodies have them in their present state.
    placed: bool,
    /// Whether the bodies are known to lie as they may.
    apart: bool,
    /// Whether bodies have been put in or changed since the last step, so that what bounds a step by how fast they
    /// move is not known.
    unmoved: bool,
    minimum_wall_gap: Option<f64>,
    minimum_gap: Option<f64>,
    gaps: Gaps,
    films: Films,
    /// The time in which a film of the present state would close at its velocity, and of which body.
    closing: Option<(f64, usize)>,
    /// How fast a repulsion opens the films of the present state (1/time).
    opening: f64,
    /// The interface that each body lies in, the innermost one, and the viscosity there where that is not the exterior
    /// fluid's.
    around: Vec<Option<usize>>,
    outside: Vec<Option<f64>>,
    /// The interfaces around the bodies before the last step.
    before: Vec<Option<usize>>,
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
            report: SolveReport::default(),
            current: false,
            placed: false,
            apart: false,
            unmoved: true,
            minimum_wall_gap: None,
            minimum_gap: None,
            gaps: Gaps::default(),
            films: Films::default(),
            closing: None,
            opening: 0.0,
            around: Vec::new(),
            outside: Vec::new(),
            before: Vec::new(),
            narrowest: None,
            least_gap: None,
            repulsion: None,
        }
    }

    pub(crate) fn push<B: Body>(&mut self, mut body: B) -> Handle<B> {
        self.unmoved = true;
        self.push_guest(&mut body);
        self.markers.push_solid(body.marker_count(), body.kind(), body.surfaces());
        self.bodies.push(Box::new(body));
        self.around.push(None);
        self.outside.push(None);
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

    /// What the scene is made of, besides its bodies and its domain.
    pub(crate) fn properties(&self) -> Vec<(String, f64)> {
        let discretisation = self.hydrodynamics.discretisation();
        let mut properties = vec![("the exterior viscosity", discretisation.viscosity)];
        let nodes = discretisation.shape_modes.map(|nodes| ("the number of nodes of an interface", nodes as f64));
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
        self.current
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
        self.forget_flow();
        self.apart = false;
        // Later on bodies have saved it.
        self.unmoved = steps == 0;
        self.hydrodynamics.load(flow);
        let discretisation = self.hydrodynamics.discretisation();
        for (body, saved) in self.bodies.iter_mut().zip(bodies) {
            body.load(&discretisation, saved).map_err(|source| body_error(time, body.as_ref(), source))?;
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
        self.current = true;
        let here = &self.markers.velocities;
        let fastest = here.iter().map(|velocity| velocity.length()).fold(0.0, f64::max);
        let bound = fastest * (SAME_FLOW + REACHED * report.residual.max(self.report.residual));
        if here.iter().zip(velocities.clone()).all(|(here, there)| (here - there).length() <= bound) {
            self.hydrodynamics.load(flow);
            self.markers.velocities.iter_mut().zip(velocities).for_each(|(to, from)| *to = from);
            self.report = report;
        }
        self.measure_films();
        Ok(())
    }

    /// Computes forces and velocities at the present state, unless they are known already.
    ///
    /// # Errors
    /// Those of the bodies' forces and of the flow.
    pub fn evaluate(&mut self) -> Result<&Markers, SceneError> {
        if !self.current {
            self.check_bodies()?;
            self.compute_flow()?;
            self.measure_films();
            self.current = true;
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
        let discretisation = self.hydrodynamics.discretisation();
        for (body, &outside) in self.bodies.iter().zip(&self.outside) {
            body.step_limits(&discretisation.in_fluid(outside), &mut |limit| each(limit, body.name()));
        }
        if let Some((dt, body)) = self.closing {
            let cause = StepCause::Accuracy;
            each(StepLimit { dt, reason: "the closing of a film", cause }, self.bodies[body].name());
        }
        if let Some(repulsion) = &self.repulsion {
            let rate = self.opening.max(repulsion.usual_rate(discretisation.viscosity));
            each(StepLimit::decay(2.0 / rate, "the repulsion"), "the interfaces");
        }
    }

    /// The fastest decay that the bodies' limits tell of at the present state, without stabilisers (1/time).
    #[must_use]
    pub fn fastest_decay(&self) -> f64 {
        let mut fastest = 0.0_f64;
        self.each_limit(&mut |limit, _| fastest = fastest.max(limit.decay_rate()));
        fastest
    }

    /// Makes the groups of markers fit the bodies, whose numbers of markers may have changed at the end of a step.
    fn fit_markers(&mut self) {
        let groups = self.markers.groups();
        let fits = groups.len() == self.bodies.len()
            && groups.iter().zip(&self.bodies).all(|(g, b)| g.range.len() == b.marker_count() && g.kind == b.kind());
        if !fits {
            self.markers.clear();
            for body in &self.bodies {
                self.markers.push_solid(body.marker_count(), body.kind(), body.surfaces());
            }
            self.markers.set_outside(&self.outside);
        }
    }

    /// What is known of the flow is not of the bodies' present state any more.
    fn forget_flow(&mut self) {
        self.current = false;
        self.placed = false;
    }

    /// Puts the markers where the bodies have them.
    fn place_markers(&mut self) {
        if self.placed {
            return;
        }
        self.fit_markers();
        self.show_hosts();
        let mut start = 0;
        for body in &self.bodies {
            let end = start + body.marker_count();
            body.write_markers(&mut self.markers.positions[start..end]);
            start = end;
        }
        self.placed = true;
    }

    fn compute_flow(&mut self) -> Result<(), SceneError> {
        let (discretisation, time) = (self.hydrodynamics.discretisation(), self.time);
        self.place_markers();
        if let Some((index, source)) =
            write_forces(0, &mut self.bodies, &self.outside, &mut self.markers.forces, &discretisation)
        {
            return Err(body_error(time, self.bodies[index].as_ref(), source));
        }
        self.add_guest_forces();
        if let Some(repulsion) = &self.repulsion {
            let (domain, walls) = (discretisation.domain, self.hydrodynamics.walls());
            let surroundings = Surroundings { domain, walls, around: &self.around };
            self.films.find(&self.markers, surroundings, repulsion.range());
            self.films.push_apart(repulsion, &mut self.markers);
        }
        self.report =
            self.hydrodynamics.velocities(&mut self.markers).map_err(|source| SceneError::Flow { time, source })?;
        Ok(())
    }

    pub(crate) fn begin_step(&mut self, step: StepInfo) -> Result<(), SceneError> {
        let (discretisation, time) = (self.hydrodynamics.discretisation(), self.time);
        for (body, &outside) in self.bodies.iter_mut().zip(&self.outside) {
            body.begin_step(&discretisation.in_fluid(outside), step)
                .map_err(|source| body_error(time, body.as_ref(), source))?;
        }
        Ok(())
    }

    pub(crate) fn end_step(&mut self, dt: f64) -> Result<(), SceneError> {
        let (discretisation, time) = (self.hydrodynamics.discretisation(), self.time);
        self.forget_flow();
        self.apart = false;
        self.unmoved = false;
        self.show_hosts();
        for index in 0..self.bodies.len() {
            self.show_host(index);
            let (body, outside) = (&mut self.bodies[index], self.outside[index]);
            body.end_step(&discretisation.in_fluid(outside), dt)
                .map_err(|source| body_error(time, body.as_ref(), source))?;
        }
        Ok(())
    }
}

fn body_error(time: f64, body: &dyn Body, source: BodyError) -> SceneError {
    SceneError::Body { time, body: body.name().to_owned(), source }
}

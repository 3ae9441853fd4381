//! Bodies in a fluid: the system of equations that an integrator advances.

use std::any::Any;

use crate::contact::{ContactFinder, Gap};
use crate::{
    Body, BodyError, FlowReport, FlowSample, Hydrodynamics, MarkerKind, Markers, Medium, Record, Repulsion, SceneError,
    StepInfo, StepLimit, Vec2, wall_gap,
};

/// How deep a marker may be inside another body, in grid spacings: films that drain at rest come to this by the round-off of a grid.
const CONTACT: f64 = 0.25;

/// The bodies of a scene, the fluid between them, and the time.
///
/// Integrators advance it, observers look at it.
#[derive(Debug)]
pub struct System<H> {
    hydrodynamics: H,
    bodies: Vec<Box<dyn Body>>,
    markers: Markers,
    time: f64,
    steps: usize,
    report: FlowReport,
    /// Whether the markers hold the flow of the bodies' present state.
    current: bool,
    /// Marker positions of the present state, for the gap to the walls.
    positions: Vec<Vec2>,
    minimum_wall_gap: Option<f64>,
    minimum_gap: Option<f64>,
    contacts: ContactFinder,
    /// The narrowest gap of the present state.
    narrowest: Option<Gap>,
    pub(crate) least_gap: Option<f64>,
    pub(crate) repulsion: Option<Repulsion>,
}

impl<H: Hydrodynamics> System<H> {
    pub(crate) fn new(hydrodynamics: H) -> Self {
        Self {
            hydrodynamics,
            bodies: Vec::new(),
            markers: Markers::new(),
            time: 0.0,
            steps: 0,
            report: FlowReport::default(),
            current: false,
            positions: Vec::new(),
            minimum_wall_gap: None,
            minimum_gap: None,
            contacts: ContactFinder::default(),
            narrowest: None,
            least_gap: None,
            repulsion: None,
        }
    }

    pub(crate) fn push(&mut self, body: Box<dyn Body>) -> usize {
        self.markers.push_group(body.marker_count(), body.kind());
        self.bodies.push(body);
        self.current = false;
        self.record_wall_gap();
        self.bodies.len() - 1
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

    /// A step is over and stays.
    pub(crate) fn commit(&mut self, dt: f64) {
        self.time += dt;
        self.steps += 1;
        self.bodies.iter_mut().for_each(|body| body.keep_step());
        self.record_wall_gap();
        if let Some(Gap { width, .. }) = self.narrowest {
            self.minimum_gap = Some(self.minimum_gap.map_or(width, |least| least.min(width)));
        }
    }

    /// What computes the flow.
    #[must_use]
    pub fn hydrodynamics(&self) -> &H {
        &self.hydrodynamics
    }

    /// The bodies, in the order in which they were added.
    pub fn bodies(&self) -> impl Iterator<Item = &dyn Body> {
        self.bodies.iter().map(AsRef::as_ref)
    }

    /// The first body of type B, if there is one.
    #[must_use]
    pub fn find<B: Body>(&self) -> Option<&B> {
        self.bodies.iter().find_map(|body| (body.as_ref() as &dyn Any).downcast_ref())
    }

    pub(crate) fn body_at(&self, index: usize) -> &dyn Any {
        self.bodies[index].as_ref()
    }

    pub(crate) fn body_at_mut(&mut self, index: usize) -> &mut dyn Any {
        // Whoever holds the body mutably may change it.
        self.current = false;
        self.bodies[index].as_mut()
    }

    /// Positions, forces and velocities of all markers as of the last evaluation; [`System::evaluate`] makes them those
    /// of the present state.
    #[must_use]
    pub fn markers(&self) -> &Markers {
        &self.markers
    }

    /// What the last evaluation needed and found.
    #[must_use]
    pub fn report(&self) -> &FlowReport {
        &self.report
    }

    /// Whether [`System::markers`] holds the flow of the present state.
    #[must_use]
    pub fn is_evaluated(&self) -> bool {
        self.current
    }

    /// Takes over the state of a checkpoint.
    pub(crate) fn load<'a>(
        &mut self,
        bodies: impl Iterator<Item = &'a Record>,
        flow: &Record,
        time: f64,
        steps: usize,
        [minimum_wall_gap, minimum_gap]: [Option<f64>; 2],
    ) -> Result<(), SceneError> {
        self.current = false;
        self.hydrodynamics.load(flow);
        let medium = self.hydrodynamics.medium();
        for (body, record) in self.bodies.iter_mut().zip(bodies) {
            body.load(&medium, record).map_err(|source| body_error(time, body.as_ref(), source))?;
        }
        (self.time, self.steps) = (time, steps);
        (self.minimum_wall_gap, self.minimum_gap) = (minimum_wall_gap, minimum_gap);
        self.fit_markers();
        Ok(())
    }

    /// Takes over velocities that were computed at the present state, if there is one for each marker.
    pub(crate) fn take_flow(
        &mut self,
        flow: &Record,
        velocities: impl ExactSizeIterator<Item = Vec2>,
        report: FlowReport,
    ) -> Result<(), SceneError> {
        if velocities.len() != self.markers.len() {
            let (found, expected) = (velocities.len(), self.markers.len());
            let problem = format!("it has the velocities of {found} markers, the scene has {expected}");
            return Err(SceneError::ForeignCheckpoint { problem });
        }
        // For all that a flow makes of its markers, such as what it samples from. The velocities come out the same only to the tolerance of
        // its iterations, so those that were found take their place, and so does what the next iteration starts from.
        self.compute_flow()?;
        self.hydrodynamics.load(flow);
        self.markers.velocities.iter_mut().zip(velocities).for_each(|(to, from)| *to = from);
        self.report = report;
        self.current = true;
        Ok(())
    }

    /// Computes forces and velocities at the present state, unless they are known already.
    ///
    /// # Errors
    /// Those of the bodies' forces and of the flow.
    pub fn evaluate(&mut self) -> Result<&Markers, SceneError> {
        if !self.current {
            self.fit_markers();
            self.compute_flow()?;
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

    /// The smallest distance of an interface to a rigid wall at the present state (length; negative beyond a wall, see
    /// [`wall_gap`]); `None` without walls or interfaces. Solids ([`MarkerKind::Points`]) may stand on a wall and do not
    /// count. Needs no evaluation.
    pub fn wall_gap(&mut self) -> Option<f64> {
        let walls = self.hydrodynamics.medium().domain.walls?;
        let interfaces = || self.bodies.iter().filter(|body| body.kind() != MarkerKind::Points);
        self.positions.resize(interfaces().map(|body| body.marker_count()).sum(), Vec2::zeros());
        let mut start = 0;
        for body in interfaces() {
            let end = start + body.marker_count();
            body.write_markers(&mut self.positions[start..end]);
            start = end;
        }
        (start > 0).then(|| wall_gap(&self.positions, walls))
    }

    /// The smallest [`System::wall_gap`] since the start (length): over the states after each addition of a body and at the
    /// end of each step.
    #[must_use]
    pub fn minimum_wall_gap(&self) -> Option<f64> {
        self.minimum_wall_gap
    }

    /// The smallest gap between two interfaces, or one and its own image in a periodic domain, since the start (length), where it was
    /// small enough to be looked for; negative where they overlap.
    #[must_use]
    pub fn minimum_gap(&self) -> Option<f64> {
        self.minimum_gap
    }

    /// The largest distance of neighbouring markers of an interface (length).
    fn finest_markers(&self) -> f64 {
        let groups = self.markers.groups().iter().filter(|group| group.kind != MarkerKind::Points);
        groups
            .flat_map(|group| self.markers.positions[group.range.clone()].windows(2))
            .map(|pair| (pair[1] - pair[0]).norm())
            .fold(0.0, f64::max)
    }

    /// The repulsion between interfaces, if it is on.
    #[must_use]
    pub fn repulsion(&self) -> Option<&Repulsion> {
        self.repulsion.as_ref()
    }

    /// Looks at the gaps of the present state: interfaces must not be inside other bodies or their own images by more than a quarter of
    /// the grid spacing, and no gap narrower than the bound, if there is one.
    pub(crate) fn check_gaps(&mut self) -> Result<(), SceneError> {
        let Medium { domain, spacing, .. } = self.hydrodynamics.medium();
        // Without a grid the spacing of the markers that carry the flow.
        let scale = spacing.unwrap_or_else(|| self.finest_markers());
        self.narrowest = self.contacts.narrowest(&self.bodies, &domain, scale);
        let (time, allowed) = (self.time, CONTACT * scale);
        let name = |index: usize| self.bodies[index].name().to_owned();
        if let Some(Gap { body, marker, other, width }) = self.narrowest {
            if width < -allowed {
                let place = self.contacts.place(body, marker);
                let (body, other, [x, y]) = (name(body), name(other), [place.x, place.y]);
                return Err(SceneError::Crossing { time, body, marker, x, y, other, depth: -width, allowed });
            }
            if let Some(bound) = self.least_gap.filter(|&bound| width < bound) {
                return Err(SceneError::Gap { time, body: name(body), other: name(other), gap: width, bound });
            }
        }
        if let Some(bound) = self.least_gap
            && let Some(gap) = self.wall_gap().filter(|&gap| gap < bound)
        {
            let (body, other) = ("a body".to_owned(), "a wall".to_owned());
            return Err(SceneError::Gap { time, body, other, gap, bound });
        }
        Ok(())
    }

    fn record_wall_gap(&mut self) {
        if let Some(gap) = self.wall_gap() {
            self.minimum_wall_gap = Some(self.minimum_wall_gap.map_or(gap, |least| least.min(gap)));
        }
    }

    /// The smallest of the bodies' stable time steps at the present state for the midpoint rule, with the body's name.
    #[must_use]
    pub fn step_limit(&self) -> Option<(StepLimit, &str)> {
        self.limits().min_by(|a, b| a.0.dt.total_cmp(&b.0.dt))
    }

    /// All bounds on the time step at the present state, with the names of the bodies that set them.
    pub fn limits(&self) -> impl Iterator<Item = (StepLimit, &str)> {
        let medium = self.hydrodynamics.medium();
        let repulsion = self.repulsion.iter().map(move |repulsion| {
            (StepLimit::decay(repulsion.step_limit(medium.viscosity), "the repulsion"), "the interfaces")
        });
        self.bodies
            .iter()
            .flat_map(move |body| body.step_limits(&medium).into_iter().map(|limit| (limit, body.name())))
            .chain(repulsion)
    }

    /// The fastest decay that the bodies' limits tell of at the present state, without stabilisers (1/time).
    #[must_use]
    pub fn fastest_decay(&self) -> f64 {
        self.limits().map(|(limit, _)| limit.decay_rate()).fold(0.0, f64::max)
    }

    /// Writes the sizes of all bodies' entries of the state; see [`Body::write_scales`].
    pub fn write_scales(&self, scales: &mut [f64]) {
        let mut start = 0;
        for body in &self.bodies {
            let end = start + body.state_len();
            body.write_scales(&mut scales[start..end]);
            start = end;
        }
    }

    /// The largest over the bodies of the root mean square of `errors / scales`; both have the length of the state.
    pub(crate) fn error_norm(&self, errors: &[f64], scales: &[f64]) -> f64 {
        let (mut start, mut largest) = (0, 0.0_f64);
        for body in &self.bodies {
            let end = start + body.state_len();
            let sum: f64 = errors[start..end].iter().zip(&scales[start..end]).map(|(e, s)| (e / s).powi(2)).sum();
            let norm = (sum / (end - start).max(1) as f64).sqrt();
            // Not a number counts as too large.
            largest = if norm.is_nan() { f64::INFINITY } else { largest.max(norm) };
            start = end;
        }
        largest
    }

    /// Makes the groups of markers fit the bodies, whose numbers of markers may have changed at the end of a step.
    fn fit_markers(&mut self) {
        let groups = self.markers.groups();
        let fits = groups.len() == self.bodies.len()
            && groups.iter().zip(&self.bodies).all(|(g, b)| g.range.len() == b.marker_count() && g.kind == b.kind());
        if !fits {
            self.markers.clear();
            for body in &self.bodies {
                self.markers.push_group(body.marker_count(), body.kind());
            }
        }
    }

    fn compute_flow(&mut self) -> Result<(), SceneError> {
        let (medium, time) = (self.hydrodynamics.medium(), self.time);
        if let Some((index, source)) = self.write_forces(&medium) {
            return Err(body_error(time, self.bodies[index].as_ref(), source));
        }
        if let Some(repulsion) = &self.repulsion {
            repulsion.add(&mut self.markers, medium.domain.periods);
        }
        self.report =
            self.hydrodynamics.velocities(&mut self.markers).map_err(|source| SceneError::Flow { time, source })?;
        Ok(())
    }

    /// Writes markers and forces of the bodies, on several threads where that pays; the first body that fails, and why.
    fn write_forces(&mut self, medium: &Medium) -> Option<(usize, BodyError)> {
        let bodies = &mut self.bodies[..];
        let (positions, forces) = (&mut self.markers.positions[..], &mut self.markers.forces[..]);
        write_forces_of(0, bodies, positions, forces, medium)
    }

    /// Length of the state of all bodies.
    #[must_use]
    pub fn state_len(&self) -> usize {
        self.bodies.iter().map(|body| body.state_len()).sum()
    }

    /// Copies the state of all bodies to `state`, resizing it.
    pub fn write_state(&self, state: &mut Vec<f64>) {
        state.resize(self.state_len(), 0.0);
        let mut start = 0;
        for body in &self.bodies {
            let end = start + body.state_len();
            body.write_state(&mut state[start..end]);
            start = end;
        }
    }

    /// Gives the bodies a state whose parts have the lengths `lengths` (one a body).
    pub(crate) fn restore(&mut self, lengths: &[usize], state: &[f64]) -> Result<(), SceneError> {
        let mut start = 0;
        self.current = false;
        for (body, length) in self.bodies.iter_mut().zip(lengths) {
            body.read_state(&state[start..start + length])
                .map_err(|source| body_error(self.time, body.as_ref(), source))?;
            start += length;
        }
        Ok(())
    }

    pub(crate) fn write_lengths(&self, lengths: &mut Vec<usize>) {
        lengths.clear();
        lengths.extend(self.bodies.iter().map(|body| body.state_len()));
    }

    /// The explicit rate of change (unit of the state per time) of `state`, which the bodies take over.
    ///
    /// # Errors
    /// Those of the bodies and of the flow.
    pub fn rate(&mut self, state: &[f64], rate: &mut [f64]) -> Result<(), SceneError> {
        self.read_state(state)?;
        self.compute_flow()?;
        self.rate_here(rate);
        Ok(())
    }

    /// The explicit rate of change (unit of the state per time) at the present state, whose flow is computed only if it is not known yet.
    ///
    /// # Errors
    /// Those of the bodies and of the flow.
    pub fn present_rate(&mut self, rate: &mut [f64]) -> Result<(), SceneError> {
        self.evaluate()?;
        self.rate_here(rate);
        Ok(())
    }

    /// The rate of change at the present state, the implicit part with it; `state` is that state or one that differs from it by what the
    /// end of a step did.
    pub(crate) fn whole_rate(&mut self, state: &[f64], rate: &mut [f64]) -> Result<(), SceneError> {
        self.present_rate(rate)?;
        self.add_implicit(state, 1.0, rate);
        Ok(())
    }

    fn rate_here(&mut self, rate: &mut [f64]) {
        let mut start = 0;
        for (body, group) in self.bodies.iter_mut().zip(self.markers.groups()) {
            let end = start + body.state_len();
            body.rate(&self.markers.velocities[group.range.clone()], &mut rate[start..end]);
            start = end;
        }
    }

    /// Gives the bodies a state of their present lengths.
    ///
    /// # Errors
    /// A state that a body refuses.
    pub fn read_state(&mut self, state: &[f64]) -> Result<(), SceneError> {
        self.current = false;
        let time = self.time;
        let mut start = 0;
        for body in &mut self.bodies {
            let end = start + body.state_len();
            body.read_state(&state[start..end]).map_err(|source| body_error(time, body.as_ref(), source))?;
            start = end;
        }
        Ok(())
    }

    /// Adds `factor * L(state) state` to `out`; see [`Body::add_implicit`].
    pub fn add_implicit(&mut self, state: &[f64], factor: f64, out: &mut [f64]) {
        let mut start = 0;
        for body in &mut self.bodies {
            let end = start + body.state_len();
            body.add_implicit(&state[start..end], factor, &mut out[start..end]);
            start = end;
        }
    }

    /// Solves `y - factor L(state) y = state` in place; see [`Body::solve_implicit`].
    pub fn solve_implicit(&mut self, factor: f64, state: &mut [f64]) {
        let mut start = 0;
        for body in &mut self.bodies {
            let end = start + body.state_len();
            body.solve_implicit(factor, &mut state[start..end]);
            start = end;
        }
    }

    pub(crate) fn begin_step(&mut self, step: StepInfo) -> Result<(), SceneError> {
        let (medium, time) = (self.hydrodynamics.medium(), self.time);
        for body in &mut self.bodies {
            body.begin_step(&medium, step).map_err(|source| body_error(time, body.as_ref(), source))?;
        }
        Ok(())
    }

    pub(crate) fn end_step(&mut self, dt: f64) -> Result<(), SceneError> {
        let (medium, time) = (self.hydrodynamics.medium(), self.time);
        self.current = false;
        for body in &mut self.bodies {
            body.end_step(&medium, dt).map_err(|source| body_error(time, body.as_ref(), source))?;
        }
        Ok(())
    }
}

/// Markers from which a half of the bodies pays for a thread.
#[cfg(feature = "rayon")]
const LEAST_MARKERS: usize = 4000;

/// Writes markers and forces of `bodies`, the first of which has the number `first`.
fn write_forces_of(
    first: usize,
    bodies: &mut [Box<dyn Body>],
    positions: &mut [Vec2],
    forces: &mut [Vec2],
    medium: &Medium,
) -> Option<(usize, BodyError)> {
    #[cfg(feature = "rayon")]
    if bodies.len() > 1 && positions.len() >= 2 * LEAST_MARKERS {
        let middle = bodies.len() / 2;
        let (bodies, bodies_above) = bodies.split_at_mut(middle);
        let markers = bodies.iter().map(|body| body.marker_count()).sum();
        let (positions, positions_above) = positions.split_at_mut(markers);
        let (forces, forces_above) = forces.split_at_mut(markers);
        let (failed, failed_above) = rayon::join(
            || write_forces_of(first, bodies, positions, forces, medium),
            || write_forces_of(first + middle, bodies_above, positions_above, forces_above, medium),
        );
        return failed.or(failed_above);
    }
    let mut start = 0;
    for (index, body) in bodies.iter_mut().enumerate() {
        let range = start..start + body.marker_count();
        start = range.end;
        body.write_markers(&mut positions[range.clone()]);
        if let Err(source) = body.write_forces(medium, &mut forces[range]) {
            return Some((first + index, source));
        }
    }
    None
}

fn body_error(time: f64, body: &dyn Body, source: BodyError) -> SceneError {
    SceneError::Body { time, body: body.name().to_owned(), source }
}

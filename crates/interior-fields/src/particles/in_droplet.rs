//! Particles inside a droplet.

use active_interface::{ActiveDroplet, Exchange};
use ib_core::body::{Guest, StepInfo, StepLimit};
use ib_core::checkpoint::SavedState;
use ib_core::input::{not_negative, positive};
use ib_core::scene::BodyFlow;
use ib_core::{Body, BodyError, Discretisation, Handle, MarkerKind, Observe, Vec2, Warning};

use super::{cells::Cells, diffusion::Diffusion, positivity::fill_up, transport::Transport};
use crate::{InteriorError, filling::Filling};

/// Relative change of the number of particles at which a run ends.
const NUMBER_BOUND: f64 = 1e-8;
/// Passes in which negative numbers are filled up.
const PASSES: usize = 100;
/// Cell Peclet number above which upwind fluxes add to the diffusion.
const PECLET_LIMIT: f64 = 2.0;

/// What is seen of the particles inside a droplet at one time.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct InteriorObservables {
    /// Number of particles inside.
    pub number: f64,
    /// Number of particles on the interface.
    pub number_on: f64,
    /// Particles that bind to the interface less those that unbind (1/time).
    pub flux: f64,
    /// Least and largest density (particles per area).
    pub range: [f64; 2],
}

/// Particles inside a droplet that diffuse there, are carried along by the fluid and are exchanged with its interface,
/// a body of a scene ([`ib_core::body::Guest`]) without forces:
/// ```text
/// dC/dt + v.grad C = D_b lap C,   -D_b dC/dn = k_on C - k_off c = gain of c
/// ```
/// The unknowns are the numbers of particles in the cells around the nodes of a [`DiscMesh`](crate::DiscMesh) whose
/// boundary are the droplet's markers; a node's density is its number over the area of its cell. All fluxes leave one
/// cell or segment and enter another one, so particles are lost to round-off only. Diffusion is implicit, with the
/// mesh of the start of a step; what that misses is explicit, so that a step is of second order.
#[derive(Debug, Clone)]
pub struct ParticlesInDroplet {
    name: String,
    filling: Filling,
    exchange: Exchange,
    cells: Cells,
    /// With the mesh of the start of the step.
    diffusion: Diffusion,
    transport: Transport,
    numbers: Vec<f64>,
    change: Vec<f64>,
    initial_number: f64,
    /// Where the nodes were when the host was seen before, and how far they are from there.
    before: Vec<Vec2>,
    shift: Vec<Vec2>,
    /// Of the droplet's segments: lengths, particles, particles that bind less those that unbind (1/time).
    lengths: Vec<f64>,
    on: Vec<f64>,
    bound: Vec<f64>,
}

impl ParticlesInDroplet {
    /// Particles of that density (particles per area) and diffusion constant (length squared per time) in `droplet`,
    /// which is or will be the body `host` of the scene, on a mesh of that spacing (length) inside. The droplet is to
    /// be one whose particles come and go ([`ActiveDroplet::with_open_number`]).
    ///
    /// # Errors
    /// Densities that are negative or not finite, a diffusion constant that is not positive, a spacing that cannot be
    /// used, a droplet without particles or whose number of markers changes, or one so bent that the mesh folds.
    pub fn new(
        droplet: &ActiveDroplet,
        host: Handle<ActiveDroplet>,
        exchange: Exchange,
        diffusion: f64,
        density: impl Fn(Vec2) -> f64,
        spacing: f64,
    ) -> Result<Self, InteriorError> {
        positive("the diffusion constant inside", diffusion)?;
        let filling = Filling::new(droplet, host, spacing)?;
        if droplet.particle_numbers().is_empty() {
            return Err(InteriorError::NoParticles);
        }
        let nodes = &filling.nodes;
        let cells = Cells::new(filling.mesh.triangles().to_vec(), nodes);
        if let Some(place) = cells.folded {
            return Err(InteriorError::Folded { x: place.x, y: place.y });
        }
        let mut numbers = Vec::with_capacity(nodes.len());
        for (node, area) in nodes.iter().zip(&cells.areas) {
            let density = density(*node);
            not_negative("a density of particles inside", density)?;
            numbers.push(density * area);
        }
        let on = droplet.particle_numbers().to_vec();
        Ok(Self {
            name: format!("inside of {}", droplet.name()),
            exchange,
            diffusion: Diffusion::new(diffusion, &cells),
            transport: Transport::new(&cells)?,
            initial_number: numbers.iter().sum::<f64>() + on.iter().sum::<f64>(),
            numbers,
            before: nodes.clone(),
            shift: vec![Vec2::ZERO; nodes.len()],
            change: vec![0.0; nodes.len()],
            lengths: droplet.segment_lengths().to_vec(),
            bound: vec![0.0; on.len()],
            on,
            cells,
            filling,
        })
    }

    /// Where the nodes are (length), the droplet's markers first.
    #[must_use]
    pub fn nodes(&self) -> &[Vec2] {
        &self.filling.nodes
    }

    /// Triangles by the numbers of their nodes, counter-clockwise.
    #[must_use]
    pub fn triangles(&self) -> &[[usize; 3]] {
        self.filling.mesh.triangles()
    }

    /// Numbers of particles in the cells around the nodes.
    #[must_use]
    pub fn numbers(&self) -> &[f64] {
        &self.numbers
    }

    /// Densities at the nodes (particles per area).
    pub fn densities(&self) -> impl Iterator<Item = f64> {
        self.numbers.iter().zip(&self.cells.areas).map(|(number, area)| number / area)
    }

    /// What is seen of them at present; it does not depend on the flow.
    #[must_use]
    pub fn seen(&self) -> InteriorObservables {
        let number = self.numbers.iter().sum();
        let least = self.densities().fold(f64::INFINITY, f64::min);
        let largest = self.densities().fold(0.0, f64::max);
        let binding = |segment: usize| {
            let density = |node: usize| self.numbers[node] / self.cells.areas[node];
            0.5 * self.lengths[segment] * self.ends(segment).into_iter().map(density).sum::<f64>()
        };
        let flux = (0..self.on.len())
            .map(|k| self.exchange.binding() * binding(k) - self.exchange.unbinding() * self.on[k])
            .sum();
        InteriorObservables { number, number_on: self.on.iter().sum(), flux, range: [least, largest] }
    }

    /// The number of particles on the interface and inside at the start.
    #[must_use]
    pub fn initial_number(&self) -> f64 {
        self.initial_number
    }

    /// The droplet that they are in.
    #[must_use]
    pub fn droplet(&self) -> Handle<ActiveDroplet> {
        self.filling.host
    }

    /// Nodes at the ends of a segment.
    fn ends(&self, segment: usize) -> [usize; 2] {
        [segment, (segment + 1) % self.on.len()]
    }

    /// The largest cell Peclet number, speed relative to the mesh times the width of a cell over the diffusion
    /// constant.
    fn cell_peclet(&self) -> f64 {
        let speeds = self.filling.fluid.iter().zip(&self.filling.motion).map(|(fluid, motion)| fluid.distance(*motion));
        let widest = speeds.zip(&self.cells.areas).map(|(speed, area)| speed * area.sqrt()).fold(0.0, f64::max);
        widest / self.diffusion.constant
    }
}

impl Guest for ParticlesInDroplet {
    fn host(&self) -> Handle<dyn Body> {
        self.filling.host.into()
    }

    fn see(&mut self, host: &dyn Body) {
        self.before.copy_from_slice(&self.filling.nodes);
        if let Some(droplet) = self.filling.see(host, |droplet| !droplet.particle_numbers().is_empty()) {
            self.cells.move_to(&self.filling.nodes);
            self.on.copy_from_slice(droplet.particle_numbers());
            self.lengths.copy_from_slice(droplet.segment_lengths());
        }
    }

    fn add_host_forces(&self, _forces: &mut [Vec2]) {}

    fn see_motion(&mut self, host: &dyn Body, velocities: &[Vec2]) {
        self.filling.see_motion(host, velocities);
    }

    fn add_host_rate(&self, rate: &mut [f64]) {
        let numbers = rate.len() - self.bound.len();
        rate[numbers..].iter_mut().zip(&self.bound).for_each(|(rate, bound)| *rate += bound);
    }
}

impl Body for ParticlesInDroplet {
    fn name(&self) -> &str {
        &self.name
    }

    fn kind(&self) -> MarkerKind {
        MarkerKind::Points
    }

    fn marker_count(&self) -> usize {
        self.filling.inner_count()
    }

    fn write_markers(&self, positions: &mut [Vec2]) {
        positions.copy_from_slice(&self.filling.nodes[self.filling.inner()]);
    }

    fn write_forces(&mut self, _medium: &Discretisation, forces: &mut [Vec2]) -> Result<(), BodyError> {
        self.filling.check()?;
        if let Some(place) = self.cells.folded {
            return Err(InteriorError::Folded { x: place.x, y: place.y }.into());
        }
        let total = self.numbers.iter().sum::<f64>() + self.on.iter().sum::<f64>();
        let change = if self.initial_number > 0.0 { total / self.initial_number - 1.0 } else { 0.0 };
        if change.is_nan() || change.abs() > NUMBER_BOUND {
            return Err(BodyError::NotConserved { what: "the number of particles", change, bound: NUMBER_BOUND });
        }
        forces.fill(Vec2::ZERO);
        Ok(())
    }

    fn state_len(&self) -> usize {
        self.numbers.len()
    }

    fn write_state(&self, state: &mut [f64]) {
        state.copy_from_slice(&self.numbers);
    }

    fn read_state(&mut self, state: &[f64]) -> Result<(), BodyError> {
        if let Some(index) = state.iter().position(|value| !value.is_finite()) {
            return Err(BodyError::NonFinite { what: "particle number inside", index, value: state[index] });
        }
        self.numbers.copy_from_slice(state);
        Ok(())
    }

    fn rate(&mut self, velocities: &[Vec2], rate: &mut [f64]) {
        self.filling.set_flow(velocities);
        let Filling { nodes, fluid, motion, .. } = &self.filling;
        self.transport.set_motion(&self.cells, nodes, (fluid, motion));
        rate.fill(0.0);
        self.transport.add(&self.cells, &self.numbers, self.diffusion.constant, rate);
        // What the implicit part adds is subtracted here.
        self.diffusion.add(&self.cells.edges, &self.numbers, -1.0, rate);
        for segment in 0..self.bound.len() {
            let unbound = self.exchange.unbinding() * self.on[segment];
            let mut gain = -unbound;
            for node in self.ends(segment) {
                let density = self.numbers[node] / self.cells.areas[node];
                let binding = 0.5 * self.exchange.binding() * self.lengths[segment] * density;
                gain += binding;
                rate[node] += 0.5 * unbound - binding;
            }
            self.bound[segment] = gain;
        }
    }

    fn begin_step(&mut self, _medium: &Discretisation, _step: StepInfo) -> Result<(), BodyError> {
        self.diffusion.move_to(&self.cells);
        Ok(())
    }

    fn add_implicit(&mut self, state: &[f64], factor: f64, out: &mut [f64]) {
        self.diffusion.add(&self.cells.edges, state, factor, out);
    }

    fn solve_implicit(&mut self, factor: f64, state: &mut [f64]) {
        self.diffusion.solve(&self.cells.edges, factor, state);
    }

    fn end_step(&mut self, _medium: &Discretisation, _dt: f64) -> Result<(), BodyError> {
        // What the end of the host's step did to its markers, with the fluid at rest.
        let nodes = &self.filling.nodes;
        if self.before != *nodes {
            self.shift.iter_mut().zip(nodes).zip(&self.before).for_each(|((by, to), from)| *by = *to - *from);
            self.before.fill(Vec2::ZERO);
            let fastest = self.transport.fastest;
            self.transport.set_motion(&self.cells, nodes, (&self.before, &self.shift));
            self.transport.fastest = fastest;
            self.change.fill(0.0);
            self.transport.add(&self.cells, &self.numbers, 0.0, &mut self.change);
            self.numbers.iter_mut().zip(&self.change).for_each(|(number, change)| *number += change);
        }
        fill_up(&self.cells.edges, &mut self.numbers, PASSES);
        Ok(())
    }

    fn step_limits(&self, _medium: &Discretisation, limits: &mut dyn FnMut(StepLimit)) {
        let mut fastest = 0.0_f64;
        for (segment, length) in self.lengths.iter().enumerate() {
            for node in self.ends(segment) {
                fastest = fastest.max(length / self.cells.areas[node]);
            }
        }
        let rate = self.exchange.unbinding() + self.exchange.binding() * fastest;
        limits(StepLimit::decay(2.0 / rate, "the exchange of particles"));
        let dt = 1.0 / self.transport.fastest;
        limits(StepLimit {
            dt,
            reason: "the transport of particles inside",
            cause: ib_core::body::StepCause::Transport,
        });
    }

    fn warnings(&self, _medium: &Discretisation) -> Vec<Warning> {
        let peclet = self.cell_peclet();
        if peclet <= PECLET_LIMIT {
            return Vec::new();
        }
        let message = format!(
            "the cell Peclet number inside is {peclet:.2}, above {PECLET_LIMIT}: upwind fluxes add diffusion, give \
             the mesh inside a narrower spacing"
        );
        let cause = "particles inside not resolved";
        vec![Warning { body: self.name.clone(), cause, excess: peclet / PECLET_LIMIT, message }]
    }

    fn write_scales(&self, scales: &mut [f64]) {
        let mean = self.numbers.iter().sum::<f64>() / self.numbers.len() as f64;
        scales.fill(if mean > 0.0 { mean } else { 1.0 });
    }

    fn properties(&self) -> Vec<(String, f64)> {
        let named = [
            ("the rate of binding", self.exchange.binding()),
            ("the rate of unbinding", self.exchange.unbinding()),
            ("the diffusion constant inside", self.diffusion.constant),
            ("the number of nodes", self.filling.nodes.len() as f64),
        ];
        named.map(|(name, value)| (name.to_owned(), value)).to_vec()
    }

    fn save(&self) -> SavedState {
        SavedState { reals: [self.numbers.as_slice(), &[self.transport.fastest]].concat(), counts: Vec::new() }
    }

    fn load(&mut self, _medium: &Discretisation, saved: &SavedState) -> Result<(), BodyError> {
        let (numbers, fastest) = saved.reals_of(self.numbers.len() + 1)?.split_at(self.numbers.len());
        self.transport.fastest = fastest[0];
        self.read_state(numbers)
    }

    fn as_guest(&mut self) -> Option<&mut dyn Guest> {
        Some(self)
    }
}

impl Observe for ParticlesInDroplet {
    type Observables = InteriorObservables;

    fn observables(&self, _medium: &Discretisation, _flow: &BodyFlow<'_>) -> Result<InteriorObservables, BodyError> {
        Ok(self.seen())
    }
}

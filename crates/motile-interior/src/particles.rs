//! Particles inside a droplet that diffuse, are carried along by the fluid and are exchanged with the interface.

mod cells;
mod projection;
mod transport;

use std::f64::consts::TAU;

use active_interface::{ActiveDroplet, Exchange};
use motile_base::{Vec2, internal::told_apart, not_negative, positive};
use motile_scene::{
    Body, BodyError, BodyFlow, FluidView, Handle, InteriorBody, MarkerKind, Observe, StepInfo, StepLimit, Warning,
    checkpoint::SavedState,
};

use cells::Cells;
use transport::{Pace, Transport};

use crate::{
    InteriorError,
    filling::{Filling, in_droplet},
    laplacian::Laplacian,
};

/// Relative change of the number of particles beyond round-off, at which a run ends with an error.
const NUMBER_BOUND: f64 = 1e-8;
/// Most passes in which negative numbers are filled up, from the next cell in each.
const PASSES: usize = 100;
/// Element Peclet number above which central fluxes would oscillate, so that upwind ones add to the diffusion.
const PECLET_LIMIT: f64 = 2.0;
/// Residual of the implicit diffusion, relative to the right-hand side: far below the error of a step. No particle is
/// lost by it.
const TOLERANCE: f64 = 1e-10;
/// Growth of the mesh's spacing from ring to ring: fields inside vary no faster near the interface than elsewhere. With
/// 288 markers and a spacing of 0.11 radii speeds and numbers differ by 1e-5 from those with a growth of a quarter, in
/// two thirds of the time.
const GROWTH: f64 = 2.0;

/// Observables of the particles inside a droplet.
#[derive(Debug, Clone, Copy, PartialEq)]
#[non_exhaustive]
pub struct InteriorObservables {
    /// Number of particles inside.
    pub number: f64,
    /// Number of particles on the interface.
    pub number_on: f64,
    /// Rate at which particles bind to the interface less the rate at which they unbind (1/time).
    pub flux: f64,
    /// Smallest and largest density inside (particles per area).
    pub range: [f64; 2],
}

/// Particles inside a droplet that diffuse, are carried along by the fluid and are exchanged with the interface.
///
/// A body of a scene that causes no forces ([`motile_scene::InteriorBody`] of the droplet), with the density C
/// (particles per area), the concentration c on the interface and the rates of binding and unbinding of [`Exchange`]:
///
/// ```text
/// dC/dt + v.grad C = D_b lap C,   -D_b dC/dn = k_on C - k_off c, the gain of c
/// ```
///
/// The unknowns are the numbers of particles in the cells around the nodes of a [`DiscMesh`](crate::DiscMesh) whose
/// boundary nodes are the droplet's markers; a node's density is its number over the area of its cell. All fluxes leave
/// one cell or segment and enter another one, so particles are lost to round-off only. Diffusion is implicit, on the
/// mesh of the start of a step; what that misses is explicit, so a step is of second order.
#[derive(Debug, Clone)]
pub struct ParticlesInDroplet {
    name: String,
    filling: Filling,
    exchange: Exchange,
    cells: Cells,
    /// Diffusion constant (length squared per time), and diffusion on the mesh of the start of the step.
    constant: f64,
    diffusion: Laplacian,
    densities: Vec<f64>,
    transport: Transport,
    numbers: Vec<f64>,
    change: Vec<f64>,
    initial_number: f64,
    /// Positions of the nodes when the host was last updated, and their shifts since then (length).
    before: Vec<Vec2>,
    shift: Vec<Vec2>,
    /// For each segment of the droplet its length, particles, and gain of particles by exchange (1/time).
    lengths: Vec<f64>,
    on: Vec<f64>,
    bound: Vec<f64>,
    /// True if the droplet has got noise on its particles since.
    noisy: bool,
}

impl ParticlesInDroplet {
    /// Returns the particles in `droplet`, which is or will be the body `host` of the scene: with a diffusion constant
    /// (length squared per time), a density as a function of position (particles per area), on a mesh of a spacing
    /// (length). The number of particles on the droplet must be open to exchange ([`ActiveDroplet::with_open_number`]).
    ///
    /// # Errors
    /// Returns an error for:
    /// * densities that are negative or not finite,
    /// * a diffusion constant or spacing that is not positive,
    /// * a mesh of too many nodes,
    /// * a droplet without particles, with noise on them, with a number of markers that changes, or so bent that the
    ///   mesh folds.
    pub fn new(
        droplet: &ActiveDroplet,
        host: Handle<ActiveDroplet>,
        exchange: Exchange,
        diffusion: f64,
        density: impl Fn(Vec2) -> f64,
        spacing: f64,
    ) -> Result<Self, InteriorError> {
        positive("the diffusion constant inside", diffusion)?;
        let filling = Filling::new(droplet, host, spacing, GROWTH)?;
        if droplet.particle_numbers().is_empty() {
            return Err(InteriorError::no_particles());
        }
        if droplet.noise().is_some() {
            return Err(InteriorError::noisy());
        }
        let nodes = &filling.nodes;
        let cells = Cells::new(filling.mesh.triangles().to_vec(), nodes);
        if let Some(place) = cells.folded {
            return Err(InteriorError::Folded { x: place.x, y: place.y });
        }
        let count = nodes.len();
        let mut numbers = Vec::with_capacity(count);
        for (node, area) in nodes.iter().zip(&cells.areas) {
            let density = density(*node);
            not_negative("a density of particles inside", density)?;
            numbers.push(density * area);
        }
        let laplacian = Laplacian::new(cells.edges.clone(), count, 0, TOLERANCE);
        let laplacian = laplacian.with_factor(nodes, &cells.weights, &cells.areas)?;
        let on = droplet.particle_numbers().to_vec();
        Ok(Self {
            name: format!("inside of {}", droplet.name()),
            exchange,
            constant: diffusion,
            diffusion: laplacian,
            densities: vec![0.0; count],
            transport: Transport::new(&cells, nodes)?,
            initial_number: numbers.iter().sum::<f64>() + on.iter().sum::<f64>(),
            numbers,
            before: nodes.clone(),
            shift: vec![Vec2::ZERO; count],
            change: vec![0.0; count],
            lengths: droplet.element_lengths().to_vec(),
            bound: vec![0.0; on.len()],
            on,
            noisy: false,
            cells,
            filling,
        })
    }

    in_droplet!(mesh);

    /// Returns the numbers of particles in the cells around the nodes.
    #[must_use]
    pub fn numbers(&self) -> &[f64] {
        &self.numbers
    }

    /// Returns the densities at the nodes (particles per area).
    pub fn densities(&self) -> impl Iterator<Item = f64> {
        self.numbers.iter().zip(&self.cells.areas).map(|(number, area)| number / area)
    }

    /// Returns the observables in the present state; they do not depend on the flow.
    #[must_use]
    pub fn seen(&self) -> InteriorObservables {
        let number = self.numbers.iter().sum();
        let least = self.densities().fold(f64::INFINITY, f64::min);
        let largest = self.densities().fold(0.0, f64::max);
        let flux = (0..self.on.len())
            .map(|k| {
                self.ends(k).map(|end| self.binding(k, end)).iter().sum::<f64>()
                    - self.exchange.unbinding() * self.on[k]
            })
            .sum();
        InteriorObservables { number, number_on: self.on.iter().sum(), flux, range: [least, largest] }
    }

    /// Returns the number of particles on the interface and inside at the start.
    #[must_use]
    pub fn initial_number(&self) -> f64 {
        self.initial_number
    }

    /// Returns the nodes at the ends of a segment.
    fn ends(&self, segment: usize) -> [usize; 2] {
        [segment, (segment + 1) % self.on.len()]
    }

    /// Returns the rate at which particles bind to a segment from the cell of the node at one of its ends (1/time).
    fn binding(&self, segment: usize, end: usize) -> f64 {
        0.5 * self.exchange.binding() * self.lengths[segment] * self.numbers[end] / self.cells.areas[end]
    }

    /// Adds `factor` times the diffusion of numbers in the cells, on the mesh of the start of the step, to `out`
    /// (1/time).
    fn diffuse(&mut self, numbers: &[f64], factor: f64, out: &mut [f64]) {
        let densities = self.densities.iter_mut().zip(numbers).zip(&self.diffusion.masses);
        densities.for_each(|((density, number), area)| *density = number / area);
        let (image, _) = self.diffusion.stiffness(&self.densities);
        out.iter_mut().zip(image).for_each(|(out, image)| *out -= factor * self.constant * image);
    }

    /// Returns the largest element Peclet number: speed of the fluid relative to the mesh times the width of a cell
    /// over the diffusion constant.
    fn element_peclet(&self) -> f64 {
        let speeds = self.filling.fluid.iter().zip(&self.filling.motion).map(|(fluid, motion)| fluid.distance(*motion));
        let widest = speeds.zip(&self.cells.areas).map(|(speed, area)| speed * area.sqrt()).fold(0.0, f64::max);
        widest / self.constant
    }
}

impl InteriorBody for ParticlesInDroplet {
    in_droplet!(interior_body);

    fn update_host(&mut self, host: &dyn Body) {
        self.before.copy_from_slice(&self.filling.nodes);
        if let Some(droplet) = self.filling.update_host(host, |droplet| !droplet.particle_numbers().is_empty()) {
            self.cells.move_to(&self.filling.nodes);
            self.on.copy_from_slice(droplet.particle_numbers());
            self.lengths.copy_from_slice(droplet.element_lengths());
            self.noisy = droplet.noise().is_some();
        }
    }

    fn add_host_forces(&self, _forces: &mut [Vec2]) {}

    fn add_host_rate(&self, rate: &mut [f64]) {
        let numbers = rate.len() - self.bound.len();
        rate[numbers..].iter_mut().zip(&self.bound).for_each(|(rate, bound)| *rate += bound);
    }
}

impl Body for ParticlesInDroplet {
    in_droplet!(body);

    fn write_forces(&mut self, _view: &FluidView, forces: &mut [Vec2]) -> Result<(), BodyError> {
        self.filling.check()?;
        if self.noisy {
            return Err(InteriorError::noisy().into());
        }
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
        self.transport.add(&self.cells, &self.numbers, self.constant, rate);
        // The implicit part adds this again.
        let numbers = std::mem::take(&mut self.numbers);
        self.diffuse(&numbers, -1.0, rate);
        self.numbers = numbers;
        for segment in 0..self.bound.len() {
            let unbound = self.exchange.unbinding() * self.on[segment];
            let mut gain = -unbound;
            for node in self.ends(segment) {
                let binding = self.binding(segment, node);
                gain += binding;
                rate[node] += 0.5 * unbound - binding;
            }
            self.bound[segment] = gain;
        }
    }

    fn begin_step(&mut self, _view: &FluidView, _step: StepInfo) -> Result<(), BodyError> {
        self.diffusion.set(&self.cells.weights, &self.cells.areas);
        Ok(())
    }

    fn add_implicit(&mut self, state: &[f64], factor: f64, out: &mut [f64]) {
        self.diffuse(state, factor, out);
    }

    fn solve_implicit(&mut self, factor: f64, state: &mut [f64]) {
        let (densities, areas) = (&mut self.densities, &self.diffusion.masses);
        densities.iter_mut().zip(&*state).zip(areas).for_each(|((density, number), area)| *density = number / area);
        self.diffusion.solve(factor * self.constant, densities);
        // The change by fluxes, so that no particle is lost.
        let (image, _) = self.diffusion.stiffness(densities);
        state.iter_mut().zip(image).for_each(|(number, image)| *number -= factor * self.constant * image);
    }

    fn end_step(&mut self, _view: &FluidView, _dt: f64) -> Result<(), BodyError> {
        // Transport by what the end of the host's step did to its markers, with the fluid at rest.
        let nodes = &self.filling.nodes;
        if self.before != *nodes {
            self.shift.iter_mut().zip(nodes).zip(&self.before).for_each(|((by, to), from)| *by = *to - *from);
            self.before.fill(Vec2::ZERO);
            let pace = self.transport.pace;
            self.transport.set_motion(&self.cells, nodes, (&self.before, &self.shift));
            self.transport.pace = pace;
            self.change.fill(0.0);
            self.transport.add(&self.cells, &self.numbers, 0.0, &mut self.change);
            self.numbers.iter_mut().zip(&self.change).for_each(|(number, change)| *number += change);
        }
        self.cells.fill_up(&mut self.numbers, PASSES);
        Ok(())
    }

    fn step_limits(&self, _view: &FluidView, limits: &mut dyn FnMut(StepLimit)) {
        let mut fastest = 0.0_f64;
        for (segment, length) in self.lengths.iter().enumerate() {
            for node in self.ends(segment) {
                fastest = fastest.max(length / self.cells.areas[node]);
            }
        }
        // Diffusion, which is implicit, spreads what a cell at the interface loses before the cell is empty: on a
        // circle of radius R, k_on times the integral of C^2 along the interface is at most D times that of |grad C|^2
        // inside, plus (2 k_on/R + k_on^2/D) times that of C^2.
        let (binding, radius) = (self.exchange.binding(), self.lengths.iter().sum::<f64>() / TAU);
        let spread = binding * (2.0 / radius + binding / self.constant);
        let rate = self.exchange.unbinding() + spread.min(binding * fastest);
        limits(StepLimit::decay(2.0 / rate, "the exchange of particles"));
        let dt = self.transport.pace.longest_step(self.constant);
        limits(StepLimit {
            dt,
            reason: "the transport of particles inside",
            cause: motile_scene::StepCause::Transport,
        });
    }

    fn warnings(&self, _view: &FluidView) -> Vec<Warning> {
        let peclet = self.element_peclet();
        if peclet <= PECLET_LIMIT {
            return Vec::new();
        }
        let [text, limit] = told_apart([peclet, PECLET_LIMIT]);
        let message = format!(
            "the element Peclet number inside is {text}, above {limit}: upwind fluxes add diffusion. Use \
             a narrower mesh spacing inside"
        );
        let cause = "particles inside not resolved";
        vec![Warning { body: self.name.clone(), cause: cause.into(), excess: peclet / PECLET_LIMIT, message }]
    }

    fn write_scales(&self, scales: &mut [f64]) {
        let mean = self.numbers.iter().sum::<f64>() / self.numbers.len() as f64;
        scales.fill(if mean > 0.0 { mean } else { 1.0 });
    }

    fn properties(&self) -> Vec<(String, f64)> {
        let named = [
            ("the rate of binding", self.exchange.binding()),
            ("the rate of unbinding", self.exchange.unbinding()),
            ("the diffusion constant inside", self.constant),
            ("the number of nodes", self.filling.nodes.len() as f64),
        ];
        named.map(|(name, value)| (name.to_owned(), value)).to_vec()
    }

    fn save(&self) -> SavedState {
        let Pace { turnover, speed } = self.transport.pace;
        SavedState { reals: [self.numbers.as_slice(), &[turnover, speed]].concat(), counts: Vec::new() }
    }

    fn load(&mut self, _view: &FluidView, saved: &SavedState) -> Result<(), BodyError> {
        let (numbers, pace) = saved.reals_of(self.numbers.len() + 2)?.split_at(self.numbers.len());
        self.transport.pace = Pace { turnover: pace[0], speed: pace[1] };
        self.read_state(numbers)
    }
}

impl Observe for ParticlesInDroplet {
    type Observables = InteriorObservables;

    fn observables(&self, _view: &FluidView, _flow: &BodyFlow<'_>) -> Result<InteriorObservables, BodyError> {
        Ok(self.seen())
    }
}

#[cfg(test)]
mod tests;

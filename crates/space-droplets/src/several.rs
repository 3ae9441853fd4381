//! Several droplets in one fluid.

mod coupling;
mod field;
mod gaps;
mod repulsion;

use std::ops::Range;
use std::sync::{PoisonError, RwLock, RwLockReadGuard};

use motile_base::internal::{Refuse, at_least};
use motile_scene::{
    Repulsion, SceneError, StepSize,
    integrator::{Dynamics, Integrator},
};
use sphere_harmonics::{Point, count};
use stokes_boundary_integrals::internal::gmres::Gmres;

use crate::close::{Close, Work};
use crate::layers::Vectors;
use crate::reflections::Reflections;
use crate::run::{RunReport, Runs, advance};
use crate::surface::{at, dot, vectors};
use crate::surroundings::{Lent, Source, Surroundings, Targets, add_imposed, emptied, lists, lists_mut};
use crate::{SpaceDroplet, SpaceError};

/// Several droplets in one unbounded fluid, each at its position ([`SpaceDroplet::with_position`]).
///
/// The flow of a droplet at another one is a sum over a fine grid. At targets close to it, the polar rule about their
/// nearest point takes over, so the error does not grow in narrow gaps until the shapes themselves are not resolved.
/// Each droplet may have its own viscosity inside.
///
/// ```
/// use space_droplets::{ContractileTension, ExcludedVolume, SpaceDroplet, SpaceDroplets};
///
/// // Two droplets with a gradient of tension along x, 0.02 apart. The outer flow of each is a dipole, so each one
/// // moves with its own speed and the value of the other's dipole at its centre.
/// let law = || ContractileTension::new(1.0, -0.5, ExcludedVolume::None, 1.0);
/// let droplet = |x: f64| -> Result<SpaceDroplet, Box<dyn std::error::Error>> {
///     let droplet = SpaceDroplet::sphere(16, 1.0, [1.0, 1.0], law()?)?;
///     Ok(droplet.with_particles(0.1, |s| 1.0 + s[0])?.with_position([x, 0.0, 0.0])?)
/// };
/// let mut pair = SpaceDroplets::new(vec![droplet(0.0)?, droplet(2.02)?])?;
/// let speed = pair.observe(1)?.velocity[0];
/// let exact = -1.0 / 15.0 * (1.0 + 1.0 / 2.02_f64.powi(3));
/// println!("speed {speed:.9}, exact {exact:.9}");
/// assert!((speed - exact).abs() < 1e-8);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug)]
pub struct SpaceDroplets {
    droplets: Vec<SpaceDroplet>,
    repulsion: Option<Repulsion>,
    /// Sampled velocities use the same memory as runs.
    surroundings: Option<RwLock<Box<dyn Surroundings>>>,
    sources: Vec<Source>,
    lent: Lent,
    close: Vec<Close>,
    /// Flow that each droplet feels of the others.
    nears: Vec<Near>,
    /// For each droplet, its range of the velocities.
    parts: Vec<Range<usize>>,
    gmres: Gmres,
    pub(crate) reflections: Reflections,
    /// Velocities of all droplets.
    solution: Vec<f64>,
    right: Vec<f64>,
    time: f64,
    pub(crate) known: bool,
    /// The solution was taken from a saved state of the present one.
    solved: bool,
    /// The error of the last evaluation for an integrator.
    failure: Option<SpaceError>,
}

/// The double layer of a droplet at a node of another one that is close to it.
#[derive(Debug, Clone)]
struct Row {
    from: usize,
    node: usize,
    /// Shift to the periodic image that is close.
    image: Option<[f64; 3]>,
    row: Vec<[f64; 6]>,
}

/// Flow that a droplet feels of the others, and memory for it.
#[derive(Debug)]
struct Near {
    to: usize,
    /// Single layers of the others at the nodes.
    flow: Vectors,
    /// Rows of the double layers of others at nodes close to them, of which some are used.
    rows: Vec<Row>,
    used: usize,
    /// Double layers of the others at the nodes.
    doubles: Vectors,
    shifts: Vec<[f64; 3]>,
    /// Nodes close to one droplet, their places in its frame, the parameter nearest to them, and the flow before.
    close: Vec<(usize, [f64; 3], Point, [f64; 3])>,
    place: Vectors,
    velocity: Vectors,
    work: Work,
    outcome: Result<(), SpaceError>,
}

impl Near {
    fn new(to: usize, droplet: &SpaceDroplet) -> Result<Self, SpaceError> {
        let nodes = || vectors(droplet.nodes.len());
        Ok(Self {
            to,
            flow: nodes(),
            rows: Vec::new(),
            used: 0,
            doubles: nodes(),
            shifts: Vec::new(),
            close: Vec::new(),
            place: vectors(1),
            velocity: vectors(1),
            work: Work::new(droplet.degree)?,
            outcome: Ok(()),
        })
    }
}

impl SpaceDroplets {
    /// Puts droplets into one fluid.
    ///
    /// # Errors
    /// Returns an error if there is no droplet, if their viscosities outside or imposed flows differ, or if droplets
    /// overlap.
    pub fn new(droplets: Vec<SpaceDroplet>) -> Result<Self, SpaceError> {
        at_least("droplets", droplets.len(), 1)?;
        let first = &droplets[0];
        for (k, droplet) in droplets.iter().enumerate() {
            if droplet.around.is_some() {
                let what = format!("droplet {k} has surroundings of its own");
                let remedy = "Give them to all droplets with `SpaceDroplets::with_surroundings` instead";
                return Err(SpaceError::refused(what, "", remedy));
            }
            if droplet.viscosities[1] != first.viscosities[1] || droplet.gradient != first.gradient {
                let what = format!("droplet {k} is in another fluid or imposed flow than droplet 0");
                return Err(SpaceError::refused(what, "", "Give all droplets the same viscosity outside and flow"));
            }
        }
        let source = |droplet: &SpaceDroplet| {
            let (fine, n) = (droplet.surface.grid.len(), count(droplet.degree));
            Source { pushed: vectors(fine), pushes: vectors(n), ..Source::new(droplet) }
        };
        let sources = droplets.iter().map(source).collect();
        let close = droplets.iter().map(|droplet| Close::new(droplet.degree)).collect();
        let time = first.time;
        let nears =
            droplets.iter().enumerate().map(|(to, droplet)| Near::new(to, droplet)).collect::<Result<_, _>>()?;
        let (gmres, solution, right) = (Gmres::default(), Vec::new(), Vec::new());
        let mut start = 0;
        let part = |droplet: &SpaceDroplet| {
            start += droplet.flow.velocities.len();
            start - droplet.flow.velocities.len()..start
        };
        let parts = droplets.iter().map(part).collect();
        let mut all = Self {
            droplets,
            repulsion: None,
            surroundings: None,
            sources,
            lent: Lent::default(),
            close,
            nears,
            parts,
            gmres,
            reflections: Reflections::default(),
            solution,
            right,
            time,
            known: false,
            solved: false,
            failure: None,
        };
        all.evaluate()?;
        Ok(all)
    }

    /// Adds a repulsion between the droplets, for gaps that are not resolved or that would drain without end. Each
    /// surface is pushed by the pressure at its gap; forces on two droplets are opposite and have no torque together.
    #[must_use]
    pub fn with_repulsion(mut self, repulsion: Repulsion) -> Self {
        self.repulsion = Some(repulsion);
        self.known = false;
        self
    }

    /// Puts all droplets into surroundings, such as a [`crate::Slit`].
    ///
    /// # Errors
    /// Returns [`SpaceError::Wall`] if a droplet is not in the fluid.
    pub fn with_surroundings(mut self, surroundings: impl Surroundings + 'static) -> Result<Self, SpaceError> {
        for (k, source) in self.sources.iter().enumerate() {
            surroundings.check(self.time, k, lists(&source.places))?;
        }
        self.surroundings = Some(RwLock::new(Box::new(surroundings)));
        self.known = false;
        Ok(self)
    }

    /// Returns the surroundings, if there are any.
    pub(crate) fn surroundings(&self) -> Option<RwLockReadGuard<'_, Box<dyn Surroundings>>> {
        Some(self.surroundings.as_ref()?.read().unwrap_or_else(PoisonError::into_inner))
    }

    /// Adds the flow that the surroundings add, at the nodes of all droplets.
    fn surround(&mut self) -> Result<(), SpaceError> {
        for (k, source) in self.sources.iter().enumerate() {
            let Some(surroundings) = self.surroundings() else { return Ok(()) };
            surroundings.check(self.time, k, lists(&source.places))?;
        }
        let moving = self.guess();
        let Self { droplets, surroundings, sources, lent, .. } = self;
        let Some(surroundings) = surroundings else { return Ok(()) };
        let surroundings = surroundings.get_mut().unwrap_or_else(PoisonError::into_inner);
        for (source, droplet) in sources.iter().zip(&mut *droplets) {
            let external = &mut droplet.flow.external;
            add_imposed(&**surroundings, droplet.viscosities[1], &source.lab_nodes, external);
        }
        let (mut all, mut targets) =
            (emptied(std::mem::take(&mut lent.sources)), emptied(std::mem::take(&mut lent.targets)));
        all.extend(sources.iter().map(Source::forces));
        if moving {
            let contrasting = sources.iter().zip(&*droplets).filter(|(_, droplet)| droplet.contrast() != 0.0);
            all.extend(contrasting.map(|(source, _)| source.stresslets()));
        }
        let target = |(source, droplet)| {
            let (source, droplet): (&Source, &mut SpaceDroplet) = (source, droplet);
            Targets { places: lists(&source.lab_nodes), flow: lists_mut(&mut droplet.flow.external) }
        };
        targets.extend(sources.iter().zip(&mut *droplets).map(target));
        let outcome = surroundings.add_flow(&all, &mut targets);
        (lent.sources, lent.targets) = (emptied(all), emptied(targets));
        if moving {
            self.add_close_images(None);
        }
        outcome
    }

    /// Guesses the velocities of all droplets and takes them over for the surroundings. Returns false if the flow does
    /// not need them, or if they are zero.
    fn guess(&mut self) -> bool {
        if self.solved || self.droplets.iter().all(|droplet| droplet.contrast() == 0.0) {
            return false;
        }
        let mut solution = std::mem::take(&mut self.solution);
        solution.resize(self.parts.last().map_or(0, |part| part.end), 0.0);
        let state = self.droplets.iter().flat_map(SpaceDroplet::scaled_state);
        self.reflections.guess.write(state, &mut solution);
        self.load(&solution);
        self.solution = solution;
        self.solution.iter().any(|value| *value != 0.0)
    }

    /// Returns lines that show the surroundings in pictures ([`Surroundings::outline`]); none in unbounded fluid.
    #[must_use]
    pub fn outline(&self, middle: [f64; 3], reach: f64) -> Vec<Vec<[f64; 3]>> {
        self.surroundings().map(|around| around.outline(middle, reach)).unwrap_or_default()
    }

    /// Returns the droplets.
    #[must_use]
    pub fn droplets(&self) -> &[SpaceDroplet] {
        &self.droplets
    }

    /// Returns the time (time).
    #[must_use]
    pub fn time(&self) -> f64 {
        self.time
    }

    /// Returns all measurements of a droplet.
    ///
    /// # Errors
    /// Returns an error if there is no droplet of that number, or the errors of [`SpaceDroplets::evaluate`].
    pub fn observe(&mut self, droplet: usize) -> Result<crate::Observation, SpaceError> {
        self.evaluate()?;
        let most = self.droplets.len();
        let missing = || SpaceError::refused(format!("there is no droplet {droplet}"), "", format!("There are {most}"));
        let time = self.time;
        let droplet = self.droplets.get_mut(droplet).ok_or_else(missing)?;
        droplet.time = time;
        droplet.observe()
    }

    fn overlap(&self, one: usize, other: usize) -> SpaceError {
        if one == other {
            let what = format!("at time {} droplet {one} overlaps its periodic image", self.time);
            return SpaceError::refused(what, "", "Enlarge the box, shrink the droplet, or use shorter steps");
        }
        SpaceError::Overlap { time: self.time, first: one.min(other), second: one.max(other) }
    }

    /// Returns a place of the frame of one droplet in the frame of another.
    fn relative(&self, from: usize, to: usize, place: [f64; 3]) -> [f64; 3] {
        let (from, to) = (self.sources[from].position, self.sources[to].position);
        std::array::from_fn(|i| place[i] + from[i] - to[i])
    }

    /// Computes the flow and the rates of the present state, unless they are known.
    ///
    /// # Errors
    /// Returns [`SpaceError::Overlap`], or the errors of [`SpaceDroplet::evaluate`].
    pub fn evaluate(&mut self) -> Result<(), SpaceError> {
        if self.known {
            return Ok(());
        }
        for (droplet, source) in self.droplets.iter_mut().zip(&mut self.sources) {
            droplet.time = self.time;
            droplet.prepare()?;
            let n = count(droplet.degree);
            source.position.copy_from_slice(&droplet.state[4 * n..]);
            let square = |k: usize| dot(at(&droplet.surface.positions, k), at(&droplet.surface.positions, k));
            source.reach = (0..droplet.surface.weights.len()).map(square).fold(0.0, f64::max).sqrt();
        }
        if let Some(repulsion) = self.repulsion {
            self.repel(repulsion)?;
        }
        for (droplet, source) in self.droplets.iter_mut().zip(&mut self.sources) {
            source.update(droplet)?;
        }
        self.couple()?;
        self.surround()?;
        if (self.droplets.len() > 1 || self.surroundings.is_some())
            && self.droplets.iter().any(|droplet| droplet.viscosities[0] != droplet.viscosities[1])
        {
            self.solve()?;
        } else {
            for droplet in &mut self.droplets {
                droplet.finish()?;
            }
        }
        self.known = true;
        Ok(())
    }

    /// Advances all droplets to the time `until`, as [`SpaceDroplet::advance`] does for one.
    ///
    /// # Errors
    /// Returns the errors of [`SpaceDroplet::advance`], and [`SpaceError::Overlap`] unless shorter steps avoid it.
    pub fn advance(
        &mut self,
        until: f64,
        step_size: StepSize,
        integrator: &mut dyn Integrator,
        observe: impl FnMut(&Self),
    ) -> Result<RunReport, SpaceError> {
        advance(self, until, step_size, integrator, observe)
    }

    /// Centres all frames, restores the volumes, and returns the largest change of a volume over itself.
    pub(crate) fn restore(&mut self) -> Result<f64, SpaceError> {
        self.known = false;
        let mut largest = 0.0_f64;
        for droplet in &mut self.droplets {
            largest = largest.max(droplet.restore()?);
        }
        Ok(largest)
    }

    /// Takes over the velocities of the present state, which the next evaluation keeps, or starts its iterations from
    /// rest.
    pub(crate) fn start_from(&mut self, velocities: Option<&[f64]>) {
        self.solution.clear();
        self.reflections.forget();
        self.solved = velocities.is_some();
        let mut rest = velocities.unwrap_or_default();
        for droplet in &mut self.droplets {
            droplet.flow.solved = self.solved;
            let (own, others) = rest.split_at(rest.len().min(droplet.flow.velocities.len()));
            rest = others;
            droplet.flow.velocities.fill(0.0);
            droplet.flow.velocities[..own.len()].copy_from_slice(own);
            self.solution.extend_from_slice(&droplet.flow.velocities);
        }
    }

    /// Calls `work` with each droplet and its range of a list.
    pub(crate) fn parts(droplets: &[SpaceDroplet], mut work: impl FnMut(&SpaceDroplet, Range<usize>)) {
        let mut start = 0;
        for droplet in droplets {
            let end = start + droplet.state.len();
            work(droplet, start..end);
            start = end;
        }
    }
}

impl Runs for SpaceDroplets {
    fn time_mut(&mut self) -> &mut f64 {
        &mut self.time
    }

    fn update(&mut self) -> Result<(), SpaceError> {
        self.evaluate()
    }

    fn failure(&mut self) -> &mut Option<SpaceError> {
        &mut self.failure
    }

    fn write_rates(&self, rates: &mut Vec<f64>) {
        rates.clear();
        self.droplets.iter().for_each(|droplet| rates.extend_from_slice(&droplet.flow.rates));
    }

    fn fastest(&self) -> f64 {
        self.droplets.iter().map(SpaceDroplet::rate_bound).fold(0.0, f64::max)
    }

    fn finish_step(&mut self) -> Result<f64, SpaceError> {
        let largest = self.restore()?;
        self.evaluate()?;
        Ok(largest)
    }

    fn defect(&self, start: &[f64], before: &[f64], dt: f64) -> f64 {
        let mut largest = 0.0_f64;
        Self::parts(&self.droplets, |droplet, range| {
            largest = largest.max(droplet.defect_of(&start[range.clone()], &before[range], dt));
        });
        largest
    }
}

impl Dynamics for SpaceDroplets {
    fn state_len(&self) -> usize {
        self.droplets.iter().map(|droplet| droplet.state.len()).sum()
    }

    fn write_state(&self, state: &mut Vec<f64>) {
        state.clear();
        self.droplets.iter().for_each(|droplet| state.extend_from_slice(&droplet.state));
    }

    fn read_state(&mut self, state: &[f64]) -> Result<(), SceneError> {
        let mut start = 0;
        for droplet in &mut self.droplets {
            let end = start + droplet.state.len();
            droplet.read_state(&state[start..end])?;
            start = end;
        }
        self.known = false;
        self.solved = false;
        Ok(())
    }

    fn rate(&mut self, state: &[f64], rate: &mut [f64]) -> Result<(), SceneError> {
        self.read_state(state)?;
        self.present_rate(rate)
    }

    fn present_rate(&mut self, rate: &mut [f64]) -> Result<(), SceneError> {
        if let Err(error) = self.evaluate() {
            self.failure = Some(error.clone());
            return Err(error.into());
        }
        Self::parts(&self.droplets, |droplet, range| droplet.write_explicit(&mut rate[range]));
        Ok(())
    }

    fn add_implicit(&mut self, state: &[f64], factor: f64, out: &mut [f64]) {
        Self::parts(&self.droplets, |droplet, range| {
            droplet.add_diffusion(&state[range.clone()], factor, &mut out[range]);
        });
    }

    fn solve_implicit(&mut self, factor: f64, state: &mut [f64]) {
        Self::parts(&self.droplets, |droplet, range| droplet.solve_diffusion(factor, &mut state[range]));
    }

    fn write_scales(&self, scales: &mut [f64]) {
        Self::parts(&self.droplets, |droplet, range| droplet.write_scales(&mut scales[range]));
    }

    fn fastest_decay(&self) -> f64 {
        self.fastest()
    }
}

#[cfg(test)]
mod tests;

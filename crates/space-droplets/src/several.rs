//! Several droplets in one fluid.

mod coupling;
mod repulsion;

use motile_base::internal::{Refuse, at_least};
use motile_scene::{
    Repulsion, SceneError, StepSize,
    integrator::{Dynamics, Integrator},
};
use sphere_harmonics::count;
use stokes_boundary_integrals::internal::gmres::Gmres;

use crate::close::{Close, nearest, nearest_on_grid};
use crate::droplet::fields;
use crate::layers::Vectors;
use crate::run::{RunReport, Runs, advance};
use crate::surface::{Surface, at, dot, vectors};
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
    sources: Vec<Source>,
    close: Vec<Close>,
    /// For each droplet, the rows of the double layers of others at its nodes close to them.
    rows: Vec<Vec<Row>>,
    gmres: Gmres,
    /// Velocities of all droplets.
    solution: Vec<f64>,
    right: Vec<f64>,
    time: f64,
    known: bool,
}

/// The double layer of a droplet at a node of another one that is close to it.
#[derive(Debug, Clone)]
struct Row {
    from: usize,
    node: usize,
    row: Vec<[f64; 6]>,
}

/// A droplet as the others feel it, in the laboratory.
#[derive(Debug, Clone)]
struct Source {
    places: Vectors,
    forces: Vectors,
    /// Normals times area and weight, and velocities.
    normals: Vectors,
    velocities: Vectors,
    /// Nodes in the frame of the droplet, and what the double layers of others give there.
    nodes: Vectors,
    doubles: [Vectors; 2],
    position: [f64; 3],
    /// Largest distance of the surface from the origin of the frame.
    reach: f64,
    /// Forces of the repulsion per area of the unit sphere, on the fine grid and as coefficients.
    pushed: Vectors,
    pushes: Vectors,
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
            if droplet.viscosities[1] != first.viscosities[1] || droplet.gradient != first.gradient {
                let what = format!("droplet {k} is in another fluid or imposed flow than droplet 0");
                return Err(SpaceError::refused(what, "", "Give all droplets the same viscosity outside and flow"));
            }
        }
        let source = |droplet: &SpaceDroplet| {
            let (fine, n) = (droplet.surface.grid.len(), count(droplet.degree));
            let (fine, nodes) = (|| vectors(fine), || vectors(droplet.nodes.len()));
            Source {
                places: fine(),
                forces: fine(),
                normals: fine(),
                velocities: fine(),
                nodes: nodes(),
                doubles: [nodes(), nodes()],
                position: [0.0; 3],
                reach: 0.0,
                pushed: fine(),
                pushes: vectors(n),
            }
        };
        let sources = droplets.iter().map(source).collect();
        let close = droplets.iter().map(|droplet| Close::new(droplet.degree)).collect();
        let time = first.time;
        let rows = droplets.iter().map(|_| Vec::new()).collect();
        let (gmres, solution, right) = (Gmres::default(), Vec::new(), Vec::new());
        let mut all =
            Self { droplets, repulsion: None, sources, close, rows, gmres, solution, right, time, known: false };
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
        self.droplets.get_mut(droplet).ok_or_else(missing)?.observe()
    }

    /// Returns the smallest gap (length) between the surfaces of two droplets, from the points of the first's grid.
    ///
    /// # Errors
    /// Returns an error if there are no droplets of these two numbers, or the errors of [`SpaceDroplets::evaluate`].
    pub fn gap(&mut self, first: usize, second: usize) -> Result<f64, SpaceError> {
        self.evaluate()?;
        if first.max(second) >= self.droplets.len() || first == second {
            let what = format!("there are no two droplets {first} and {second}");
            return Err(SpaceError::refused(what, "", format!("Use two numbers below {}", self.droplets.len())));
        }
        let (here, other) = (&self.droplets[first], &self.droplets[second]);
        let relative = |k: usize| self.relative(first, second, at(&here.surface.positions, k));
        let distance = |k: usize| nearest_on_grid(&other.surface, relative(k));
        let (mut best, mut start) = (0, f64::INFINITY);
        for k in 0..here.surface.weights.len() {
            let found = distance(k).1;
            if found < start {
                (best, start) = (k, found);
            }
        }
        let positions = fields(&other.state, count(other.degree));
        Ok(nearest(positions, relative(best), distance(best).0)?.distance)
    }

    fn overlap(&self, one: usize, other: usize) -> SpaceError {
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
            let Surface { grid, weights, positions, normals, .. } = &mut droplet.surface;
            for (field, values) in droplet.flow.forces.iter().zip(&mut source.forces) {
                grid.backward(field, values)?;
                values.iter_mut().zip(&*weights).for_each(|(value, weight)| *value *= weight);
            }
            for ((places, positions), shift) in source.places.iter_mut().zip(&*positions).zip(source.position) {
                places.iter_mut().zip(positions).for_each(|(place, position)| *place = position + shift);
            }
            for (scaled, normals) in source.normals.iter_mut().zip(&*normals) {
                let products = normals.iter().zip(&*weights).map(|(normal, weight)| normal * weight);
                scaled.iter_mut().zip(products).for_each(|(scaled, product)| *scaled = product);
            }
            source.nodes.clone_from(&droplet.flow.at_nodes);
        }
        self.couple()?;
        if self.droplets.len() > 1
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

    /// Calls `work` with each droplet and its part of a list.
    fn parts(droplets: &[SpaceDroplet], mut work: impl FnMut(&SpaceDroplet, std::ops::Range<usize>)) {
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

    fn write_rates(&self, rates: &mut Vec<f64>) {
        rates.clear();
        self.droplets.iter().for_each(|droplet| rates.extend_from_slice(&droplet.flow.rates));
    }

    fn fastest(&self) -> f64 {
        self.droplets.iter().map(SpaceDroplet::rate_bound).fold(0.0, f64::max)
    }

    fn finish_step(&mut self) -> Result<f64, SpaceError> {
        let mut largest = 0.0_f64;
        for droplet in &mut self.droplets {
            largest = largest.max(droplet.restore()?);
        }
        self.known = false;
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
        Ok(())
    }

    fn rate(&mut self, state: &[f64], rate: &mut [f64]) -> Result<(), SceneError> {
        self.read_state(state)?;
        self.present_rate(rate)
    }

    fn present_rate(&mut self, rate: &mut [f64]) -> Result<(), SceneError> {
        self.evaluate()?;
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

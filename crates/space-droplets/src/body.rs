//! Droplets as a body of a scene of `motile-scene`, with its runs, steps, observers and checkpoints.

use std::f64::consts::PI;

use motile_base::internal::Refuse;
use motile_base::{FlowSample, SolveReport, Vec2, positive, same_length};
use motile_scene::checkpoint::SavedState;
use motile_scene::integrator::Dynamics;
use motile_scene::{
    Body, BodyError, BodyFlow, Domain, FlowError, FlowWork, FluidView, Hydrodynamics, MarkerKind, Markers, Observe,
    StepLimit, Warning,
};
use sphere_harmonics::count;

use crate::run::Runs;
use crate::{Observation, SpaceDroplets, SpaceError};

/// All droplets of a scene as one body, which has no markers: it computes the flow between them by itself.
///
/// Put it into a [`motile_scene::Scene`] with [`SpaceFluid`]. The scene then has the runs, adaptive steps, observers,
/// warnings and checkpoints of all scenes. A run that continues from a checkpoint is the same to the last bit.
///
/// ```
/// use motile_scene::{Scene, StepSize, integrator::RungeKuttaChebyshev};
/// use space_droplets::{ContractileTension, SpaceBody, SpaceDroplet, SpaceDroplets, SpaceFluid};
///
/// // Bare tension 10, activity -1, excluded volume 2, 100 particles per area, most of them at the rear.
/// let law = ContractileTension::thesis(10.0, -1.0, 2.0, 100.0)?;
/// let heading = [0.6, 0.0, 0.8];
/// let rear = |s: [f64; 3]| 100.0 * (1.0 - s[0] * heading[0] - s[2] * heading[2]);
/// let droplet = SpaceDroplet::sphere(8, 1.0, [100.0, 100.0], law)?.with_particles(0.1, rear)?;
/// let mut scene = Scene::new(SpaceFluid::new(100.0)?).advanced_by(RungeKuttaChebyshev::new());
/// let droplets = scene.add(SpaceBody::new(SpaceDroplets::new(vec![droplet])?, &["swimmer"])?);
/// scene.run(20.0).step_size(StepSize::Adaptive { tolerance: 1e-3 }).go()?;
/// let seen = &scene.observe(droplets)?[0];
/// println!("speed {:.3} along {:.2?}", seen.speed, seen.heading);
/// assert!((seen.speed - 0.126).abs() < 2e-3 && (seen.heading[2] - 0.8).abs() < 0.01);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug)]
pub struct SpaceBody {
    droplets: SpaceDroplets,
    names: Vec<String>,
}

impl SpaceBody {
    /// Makes a body of droplets. Their names appear in warnings.
    ///
    /// # Errors
    /// Returns an error if there are not as many names as droplets.
    pub fn new(droplets: SpaceDroplets, names: &[impl AsRef<str>]) -> Result<Self, SpaceError> {
        same_length("the names", droplets.droplets().len(), names.len())?;
        Ok(Self { droplets, names: names.iter().map(|name| name.as_ref().to_owned()).collect() })
    }

    /// Returns the droplets. Their flow is known if the scene has been evaluated.
    #[must_use]
    pub fn droplets(&self) -> &SpaceDroplets {
        &self.droplets
    }

    /// Returns the number of coefficients of velocities.
    fn velocities_len(&self) -> usize {
        self.droplets.droplets().iter().map(|droplet| droplet.flow.velocities.len()).sum()
    }

    /// Returns the names of the droplets.
    #[must_use]
    pub fn names(&self) -> &[String] {
        &self.names
    }
}

/// Returns an error of droplets as an error of a body. The scene names the time.
fn failure(error: &SpaceError) -> BodyError {
    let text = error.to_string();
    let untimed = text.strip_prefix("at time ").and_then(|rest| rest.split_once(' ')).map(|(_, rest)| rest.to_owned());
    BodyError::Other(untimed.unwrap_or(text).into())
}

impl Body for SpaceBody {
    fn name(&self) -> &str {
        if let [name] = self.names.as_slice() { name } else { "the droplets" }
    }

    fn kind(&self) -> MarkerKind {
        MarkerKind::Points
    }

    fn marker_count(&self) -> usize {
        0
    }

    fn write_markers(&self, _positions: &mut [Vec2]) {}

    fn write_forces(&mut self, _view: &FluidView, _forces: &mut [Vec2]) -> Result<(), BodyError> {
        self.droplets.evaluate().map_err(|error| failure(&error))
    }

    fn state_len(&self) -> usize {
        self.droplets.state_len()
    }

    fn write_state(&self, state: &mut [f64]) {
        SpaceDroplets::parts(self.droplets.droplets(), |droplet, range| {
            state[range].copy_from_slice(&droplet.state);
        });
    }

    fn read_state(&mut self, state: &[f64]) -> Result<(), BodyError> {
        if let Some(index) = state.iter().position(|value| !value.is_finite()) {
            return Err(BodyError::NonFinite { what: "coefficient", index, value: state[index] });
        }
        self.droplets.read_state(state).map_err(|error| failure(&error.into()))
    }

    fn rate(&mut self, _velocities: &[Vec2], rate: &mut [f64]) {
        SpaceDroplets::parts(self.droplets.droplets(), |droplet, range| droplet.write_explicit(&mut rate[range]));
    }

    fn add_implicit(&mut self, state: &[f64], factor: f64, out: &mut [f64]) {
        self.droplets.add_implicit(state, factor, out);
    }

    fn solve_implicit(&mut self, factor: f64, state: &mut [f64]) {
        self.droplets.solve_implicit(factor, state);
    }

    fn end_step(&mut self, _view: &FluidView, _dt: f64) -> Result<(), BodyError> {
        self.droplets.restore().map(|_| ()).map_err(|error| failure(&error))
    }

    fn step_limits(&self, _view: &FluidView, limits: &mut dyn FnMut(StepLimit)) {
        limits(StepLimit::decay(2.0 / self.droplets.fastest(), "tension, particles and shape"));
    }

    /// Returns the warnings of all droplets ([`crate::SpaceDroplet::warnings`]).
    fn warnings(&self, _view: &FluidView) -> Vec<Warning> {
        let of = |(droplet, name): (&crate::SpaceDroplet, &String)| {
            let name = name.clone();
            droplet.doubts().into_iter().map(move |(cause, excess, message)| {
                let body = name.clone();
                Warning { body, cause: cause.into(), excess, message }
            })
        };
        self.droplets.droplets().iter().zip(&self.names).flat_map(of).collect()
    }

    /// Writes the scales with which the root mean square of all coefficients is the mean over the surface of a droplet.
    fn write_scales(&self, scales: &mut [f64]) {
        let len = scales.len() as f64;
        SpaceDroplets::parts(self.droplets.droplets(), |droplet, range| {
            let scales = &mut scales[range];
            droplet.write_scales(scales);
            let mean = (4.0 * PI / len).sqrt();
            scales.iter_mut().take(3 * count(droplet.degree)).for_each(|scale| *scale *= mean);
            let particles = &mut scales[3 * count(droplet.degree)..4 * count(droplet.degree)];
            particles.iter_mut().for_each(|scale| *scale /= len.sqrt());
        });
    }

    fn properties(&self) -> Vec<(String, f64)> {
        let of = |(k, droplet): (usize, &crate::SpaceDroplet)| {
            let named = |name: &str, value: f64| (format!("{name} of droplet {k}"), value);
            [
                named("the degree", droplet.degree as f64),
                named("the volume", droplet.volume),
                named("the viscosity inside", droplet.viscosities[0]),
                named("the diffusivity", droplet.diffusivity),
            ]
        };
        let count = ("the number of droplets".to_owned(), self.names.len() as f64);
        let around = self.droplets.surroundings().map(|around| around.properties()).unwrap_or_default();
        let around = around.into_iter().map(|(name, value)| (name.to_owned(), value));
        std::iter::once(count).chain(self.droplets.droplets().iter().enumerate().flat_map(of)).chain(around).collect()
    }

    /// Returns the state, the velocities if they are known, and earlier states, because the iterations for two
    /// viscosities reach the same velocities to a tolerance only.
    fn save(&self) -> SavedState {
        let mut reals = vec![0.0; self.state_len()];
        self.write_state(&mut reals);
        let known = self.droplets.known;
        if known {
            self.droplets.droplets().iter().for_each(|droplet| reals.extend_from_slice(&droplet.flow.velocities));
        }
        let (count, earlier) = self.droplets.reflections.save(self.velocities_len());
        reals.extend(earlier);
        SavedState { reals, counts: vec![u64::from(known), count] }
    }

    fn load(&mut self, _view: &FluidView, saved: &SavedState) -> Result<(), BodyError> {
        let [known, count] = saved.counts_of()?;
        let (len, velocities) = (self.state_len(), self.velocities_len());
        let end = if known == 1 { len + velocities } else { len };
        let reals = saved.reals_of(saved.reals.len().max(end))?;
        self.read_state(&reals[..len])?;
        self.droplets.start_from((known == 1).then_some(&reals[len..end]));
        if !self.droplets.reflections.load([len, velocities], count, &reals[end..]) {
            return Err(saved.reals_of(end).err().map_or(BodyError::Other("of another body".into()), BodyError::from));
        }
        Ok(())
    }
}

impl Observe for SpaceBody {
    type Observables = Vec<Observation>;

    fn observables(&self, _view: &FluidView, _flow: &BodyFlow<'_>) -> Result<Vec<Observation>, BodyError> {
        Ok(self.droplets.droplets().iter().map(crate::SpaceDroplet::measured).collect())
    }
}

/// The fluid around a [`SpaceBody`], which computes its flow by itself: unbounded fluid of a viscosity.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SpaceFluid {
    viscosity: f64,
    evaluations: usize,
}

impl SpaceFluid {
    /// Makes the fluid from its viscosity (stress times time).
    ///
    /// # Errors
    /// Returns an error if the viscosity is not positive and finite.
    pub fn new(viscosity: f64) -> Result<Self, SpaceError> {
        Ok(Self { viscosity: positive("the viscosity outside", viscosity)?, evaluations: 0 })
    }
}

impl Hydrodynamics for SpaceFluid {
    fn fluid_view(&self) -> FluidView {
        let domain = Domain { origin: [0.0; 2], periods: [None; 2].into(), walls: None };
        let (viscosity, interface_stiffness) = (self.viscosity, 0.0);
        FluidView {
            domain,
            viscosity,
            spacing: None,
            second_order: true,
            shape_modes: None,
            nodes: None,
            interface_stiffness,
        }
    }

    fn velocities(&mut self, markers: &mut Markers) -> Result<SolveReport, FlowError> {
        self.evaluations += 1;
        if markers.is_empty() {
            return Ok(SolveReport::default());
        }
        let what = "a body with markers next to droplets in three dimensions";
        Err(FlowError::unsupported(what, "Use a scene of such droplets alone"))
    }

    /// Refuses points of a plane: [`SpaceDroplets::velocities_at`] gives velocities in three dimensions.
    ///
    /// # Errors
    /// Returns an error if there are points.
    fn sample(&mut self, _: &Markers, points: &[Vec2], _: &mut [FlowSample]) -> Result<(), FlowError> {
        if points.is_empty() {
            return Ok(());
        }
        Err(FlowError::refused(
            "points of a plane have no flow in three dimensions",
            "",
            "Use SpaceDroplets::velocities_at",
        ))
    }

    fn work(&self) -> FlowWork {
        FlowWork { evaluations: self.evaluations, ..FlowWork::default() }
    }
}

#[cfg(test)]
mod tests;

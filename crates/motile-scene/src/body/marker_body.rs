//! Write your own body in a few lines.

mod decay;

use std::cell::{Cell, RefCell};

use crate::{Body, BodyError, FluidView, MarkerKind, body::StepLimit, points, saved_state::SavedState};
use decay::Mobility;

pub use decay::fastest_decay;
use motile_base::{InputError, Vec2, internal::all_points_finite, not_negative};

/// Forces from positions, or rates from positions and velocities, marker by marker.
type ForceLaw = Box<dyn FnMut(&[Vec2], &mut [Vec2]) + Send>;
type Motion = Box<dyn FnMut(&[Vec2], &[Vec2], &mut [Vec2]) + Send>;

/// A body that is nothing but markers, a law for their forces on the fluid, and how they move (with the fluid by
/// default). Its state is the positions; what has more of a state implements [`Body`].
///
/// A fibre of springs that is tethered at one end:
///
/// ```
/// use motile_base::Vec2;
/// use motile_scene::{MarkerBody, Scene, Substrate};
///
/// let mut scene = Scene::new(Substrate::new(0.25)?);
///
/// let (stiffness, rest) = (20.0, 0.1);
/// let fibre = (0..20).map(|k| Vec2::new(0.12 * f64::from(k), 0.0)).collect();
/// let fibre = scene.add(
///     MarkerBody::new("fibre", fibre, move |positions, forces| {
///         forces[0] = -stiffness * positions[0];
///         for k in 1..positions.len() {
///             let spring = positions[k] - positions[k - 1];
///             let pull = stiffness * (spring.length() - rest) * spring.normalize();
///             forces[k] = -pull;
///             forces[k - 1] += pull;
///         }
///     }),
/// );
/// scene.run(5.0).go()?;
/// let end = scene.body(fibre)?.markers()[19];
/// println!("the fibre has shrunk to {:.3}", end.x);
/// assert!(end.x > 1.9 && end.x < 2.2);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[doc(alias("fibre", "fiber", "filament", "flagellum", "swimmer"))]
pub struct MarkerBody {
    name: String,
    kind: MarkerKind,
    positions: Vec<Vec2>,
    rates: Vec<Vec2>,
    forces: RefCell<ForceLaw>,
    motion: Option<Motion>,
    stiffness: Option<f64>,
    /// The fastest decay of displacements (1/time), once it is found.
    decay: Cell<Option<f64>>,
}

impl std::fmt::Debug for MarkerBody {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let Self { name, kind, positions, .. } = self;
        f.debug_struct("MarkerBody").field("name", name).field("kind", kind).field("positions", positions).finish()
    }
}

impl MarkerBody {
    /// Creates markers at `positions` (length) that `forces` gives the forces on the fluid (force; all zero before the
    /// call), and that move with the fluid.
    ///
    /// The fastest decay that the forces cause bounds the time step. It is found once, where the markers are when it is
    /// first asked for, in at most thirty calls of `forces`. It is the largest eigenvalue, by the power method, of the
    /// derivative of the forces times a mobility of `(ln(L/r) + 1)/(4 pi eta)` between markers at the distance r, L
    /// being the smallest width of the domain and r the grid spacing for a marker's own force. It is an estimate from
    /// above: the mobility of a point of radius a in a square box is `(ln(L/a) - 1.31)/(4 pi eta)` (Hasimoto 1959). A
    /// law that stiffens later, or depends on more than positions, needs [`MarkerBody::with_stiffness`]. If nothing
    /// decays and nothing else in the scene bounds the time step, runs need [`crate::StepSize::Fixed`] or
    /// [`crate::StepSize::Adaptive`].
    pub fn new(
        name: impl Into<String>,
        positions: Vec<Vec2>,
        forces: impl FnMut(&[Vec2], &mut [Vec2]) + Send + 'static,
    ) -> Self {
        let name = name.into();
        let forces: RefCell<ForceLaw> = RefCell::new(Box::new(forces));
        let (kind, rates, decay) = (MarkerKind::Points, Vec::new(), Cell::new(None));
        Self { name, kind, positions, rates, forces, motion: None, stiffness: None, decay }
    }

    /// Sets the kind of the markers (points otherwise).
    #[must_use]
    pub fn with_kind(mut self, kind: MarkerKind) -> Self {
        self.kind = kind;
        self
    }

    /// Sets how the markers move (with the fluid otherwise). From positions (length) and velocities of the fluid there
    /// (length per time) `motion` writes their velocities (length per time; before the call, the velocities of the
    /// fluid).
    #[must_use]
    pub fn with_motion(mut self, motion: impl FnMut(&[Vec2], &[Vec2], &mut [Vec2]) + Send + 'static) -> Self {
        self.motion = Some(Box::new(motion));
        self
    }

    /// States how stiff the forces are, in place of looking for the fastest decay. They change by at most `stiffness`
    /// (force per length) times a displacement, both as root sums of squares over the markers; zero for no bound on the
    /// time step.
    ///
    /// The fastest decay is then taken to be the decay of all N markers together as if each were tethered, `stiffness N
    /// (ln(L/r) + 1)/(4 pi eta)` with their radius of gyration r, or of one alone with the grid spacing for r,
    /// whichever is faster. Springs between markers allow much longer steps than that.
    ///
    /// # Errors
    /// Returns an error for a stiffness that is negative or not finite.
    pub fn with_stiffness(mut self, stiffness: f64) -> Result<Self, InputError> {
        self.stiffness = Some(not_negative("the stiffness", stiffness)?);
        self.decay.set(None);
        Ok(self)
    }

    /// Returns the positions of the markers (length).
    #[must_use]
    pub fn markers(&self) -> &[Vec2] {
        &self.positions
    }

    /// Returns the positions of the markers (length), to be changed between steps.
    pub fn markers_mut(&mut self) -> &mut [Vec2] {
        self.decay.set(None);
        &mut self.positions
    }

    /// Returns the fastest decay of displacements (1/time).
    fn decay_rate(&self, view: &FluidView) -> f64 {
        let found = self.decay.get().unwrap_or_else(|| {
            let mobility = Mobility::new(view, &self.positions);
            match self.stiffness {
                _ if self.positions.is_empty() => 0.0,
                Some(stiffness) => stiffness * mobility.largest(),
                None => mobility.fastest_decay(&mut *self.forces.borrow_mut()),
            }
        });
        self.decay.set(Some(found));
        found
    }
}

impl Body for MarkerBody {
    fn name(&self) -> &str {
        &self.name
    }

    fn kind(&self) -> MarkerKind {
        self.kind
    }

    fn marker_count(&self) -> usize {
        self.positions.len()
    }

    fn write_markers(&self, positions: &mut [Vec2]) {
        positions.copy_from_slice(&self.positions);
    }

    fn write_forces(&mut self, _view: &FluidView, forces: &mut [Vec2]) -> Result<(), BodyError> {
        forces.fill(Vec2::ZERO);
        (self.forces.get_mut())(&self.positions, forces);
        all_points_finite("the forces", forces).map_err(|error| BodyError::Other(error.into()))
    }

    fn state_len(&self) -> usize {
        2 * self.positions.len()
    }

    fn write_state(&self, state: &mut [f64]) {
        points::write(&self.positions, state);
    }

    fn read_state(&mut self, state: &[f64]) -> Result<(), BodyError> {
        points::read(state, &mut self.positions)
    }

    fn rate(&mut self, velocities: &[Vec2], rate: &mut [f64]) {
        self.rates.clear();
        self.rates.extend_from_slice(velocities);
        if let Some(motion) = &mut self.motion {
            motion(&self.positions, velocities, &mut self.rates);
        }
        points::write(&self.rates, rate);
    }

    fn mirror(&self, markers: &[usize], state: &[f64], image: &mut [f64]) -> bool {
        points::mirror(markers, state, image);
        true
    }

    fn translate(&self, by: Vec2, state: &mut [f64]) -> bool {
        points::translate(by, state);
        true
    }

    fn step_limits(&self, view: &FluidView, limits: &mut dyn FnMut(StepLimit)) {
        let rate = self.decay_rate(view);
        if rate > 0.0 {
            limits(StepLimit::decay(2.0 / rate, "the stiffness"));
        }
    }

    fn save(&self) -> SavedState {
        let len = self.state_len();
        let mut reals = vec![0.0; len + 1];
        self.write_state(&mut reals[..len]);
        reals[len] = self.decay.get().unwrap_or_default();
        SavedState { reals, counts: vec![u64::from(self.decay.get().is_some())] }
    }

    fn load(&mut self, _view: &FluidView, saved: &SavedState) -> Result<(), BodyError> {
        let [known] = saved.counts_of()?;
        let (state, decay) = saved.reals_of(self.state_len() + 1)?.split_at(self.state_len());
        self.read_state(state)?;
        self.decay.set((known > 0).then_some(decay[0]));
        Ok(())
    }
}

#[cfg(test)]
mod tests;

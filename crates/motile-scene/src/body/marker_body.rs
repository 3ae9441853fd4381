//! Bodies of one's own in a few lines.

use std::f64::consts::PI;

use crate::{Body, BodyError, FluidView, MarkerKind, body::StepLimit, points};
use motile_base::{InputError, Vec2, all_points_finite, not_negative};

/// Forces from positions, or rates from positions and velocities, marker by marker.
type ForceLaw = Box<dyn FnMut(&[Vec2], &mut [Vec2]) + Send>;
type Motion = Box<dyn FnMut(&[Vec2], &[Vec2], &mut [Vec2]) + Send>;

/// A body that is nothing but markers, a law for their forces on the fluid, and how they move (with the fluid unless
/// told otherwise). Its state is the positions; what has more of a state implements [`Body`].
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
///     })
///     .with_stiffness(4.0 * stiffness)?,
/// );
/// scene.run(5.0).go()?;
/// let end = scene.body(fibre)?.positions()[19];
/// println!("the fibre has shrunk to {:.3}", end.x);
/// assert!(end.x > 1.9 && end.x < 2.2);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub struct MarkerBody {
    name: String,
    kind: MarkerKind,
    positions: Vec<Vec2>,
    rates: Vec<Vec2>,
    forces: ForceLaw,
    motion: Option<Motion>,
    stiffness: Option<f64>,
}

impl std::fmt::Debug for MarkerBody {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let Self { name, kind, positions, .. } = self;
        f.debug_struct("MarkerBody").field("name", name).field("kind", kind).field("positions", positions).finish()
    }
}

impl MarkerBody {
    /// Markers at `positions` (length) that `forces` gives the forces on the fluid (force; all zero before the call),
    /// and that move with the fluid. Where nothing else in its scene bounds the time step, runs need
    /// [`MarkerBody::with_stiffness`], [`crate::StepSize::Fixed`] or [`crate::StepSize::Adaptive`].
    pub fn new(
        name: impl Into<String>,
        positions: Vec<Vec2>,
        forces: impl FnMut(&[Vec2], &mut [Vec2]) + Send + 'static,
    ) -> Self {
        let name = name.into();
        let forces = Box::new(forces);
        Self { name, kind: MarkerKind::Points, positions, rates: Vec::new(), forces, motion: None, stiffness: None }
    }

    /// Sets the kind of the markers (points otherwise).
    #[must_use]
    pub fn with_kind(mut self, kind: MarkerKind) -> Self {
        self.kind = kind;
        self
    }

    /// Sets how the markers move (with the fluid otherwise): from positions (length) and velocities of the fluid there
    /// (length per time) `motion` writes their velocities (length per time; those of the fluid before the call).
    #[must_use]
    pub fn with_motion(mut self, motion: impl FnMut(&[Vec2], &[Vec2], &mut [Vec2]) + Send + 'static) -> Self {
        self.motion = Some(Box::new(motion));
        self
    }

    /// Bounds the time step for forces that change by at most `stiffness` (force per length)
    /// times a displacement, both as root sums of squares over the markers: k for markers that are each tethered by a
    /// spring k, 4k for a chain of such springs.
    ///
    /// The fastest decay is taken to be that of all N markers together, `stiffness N (ln(L/r) + 1)/(4 pi eta)` with
    /// their radius of gyration r and the smallest width L of the domain, or that of one alone with the grid spacing
    /// for r, whichever is faster. It is an estimate from above: the mobility of a point of radius a in a square box
    /// is `(ln(L/a) - 1.31)/(4 pi eta)` (Hasimoto 1959).
    ///
    /// # Errors
    /// A stiffness that is negative or not finite.
    pub fn with_stiffness(mut self, stiffness: f64) -> Result<Self, InputError> {
        self.stiffness = Some(not_negative("the stiffness", stiffness)?);
        Ok(self)
    }

    /// Positions of the markers (length).
    #[must_use]
    pub fn positions(&self) -> &[Vec2] {
        &self.positions
    }

    /// Positions of the markers (length), to be changed between steps.
    pub fn positions_mut(&mut self) -> &mut [Vec2] {
        &mut self.positions
    }

    /// The fastest decay of displacements (1/time).
    fn decay_rate(&self, view: &FluidView, stiffness: f64) -> f64 {
        let count = self.positions.len() as f64;
        let centre = self.positions.iter().sum::<Vec2>() / count;
        let gyration = (self.positions.iter().map(|p| (p - centre).length_squared()).sum::<f64>() / count).sqrt();
        let [x, y] = view.domain.periods;
        let height = view.domain.walls.map(|[below, above]| above - below);
        let width = [x, y, height].into_iter().flatten().fold(f64::INFINITY, f64::min);
        let width = if width.is_finite() { width } else { gyration };
        let mobility = |radius: f64| ((width / radius).ln().max(0.0) + 1.0) / (4.0 * PI * view.viscosity);
        let finest = view.spacing.unwrap_or(gyration / count);
        let alone = if finest > 0.0 { mobility(finest) } else { 0.0 };
        stiffness * alone.max(count * mobility(gyration.max(finest)))
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
        (self.forces)(&self.positions, forces);
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

    fn step_limits(&self, view: &FluidView, limits: &mut dyn FnMut(StepLimit)) {
        if let Some(stiffness) = self.stiffness.filter(|stiffness| *stiffness > 0.0 && !self.positions.is_empty()) {
            limits(StepLimit::decay(2.0 / self.decay_rate(view, stiffness), "the stiffness"));
        }
    }
}

#[cfg(test)]
mod tests;

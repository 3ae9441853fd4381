//! The gap between interfaces and solids during a run.

use crate::{Body, Handle, Hydrodynamics, Observer, System};
use motile_base::{Vec2, internal::told_apart};

/// Name of the record of the smallest gap.
const RECORD: &str = "smallest gap to a solid";

/// Measures the gap between the interfaces of a system and all its solids, keeps the smallest one, and ends the run
/// where an interface enters a solid deeper than it may. Solids are all bodies that are not closed curves and have a
/// surface ([`Body::surfaces`]), whatever their types. Checkpoints hold the smallest gap.
///
/// ```no_run
/// # use motile_scene::{Hydrodynamics, Scene, SceneError};
/// # fn run<H: Hydrodynamics>(mut scene: Scene<H>) -> Result<(), SceneError> {
/// use motile_scene::{Every, gap::SolidGap};
///
/// let mut gap = SolidGap::new(0.25 * 0.1);
/// scene.run(0.5).observe(Every::Steps(1), &mut gap).go()?;
/// if let Some((least, time)) = gap.smallest() {
///     println!("smallest gap {least:.3} at t = {time}");
/// }
/// # Ok(())
/// # }
/// ```
#[derive(Debug, Clone)]
pub struct SolidGap {
    allowed: f64,
    present: Option<f64>,
    smallest: Option<(f64, f64)>,
}

/// An interface that has entered a solid.
#[derive(Clone, PartialEq, thiserror::Error)]
#[error(
    "marker {marker} of {interface} at ({x:.4}, {y:.4}) is {} inside a solid, more than {}. {}",
    told_apart([*depth, *allowed])[0], told_apart([*depth, *allowed])[1],
    if *at_start { "Move them apart" } else { "Use a smaller time step or a finer grid" }
)]
pub struct SolidEntered {
    /// Name of the interface.
    pub interface: String,
    /// True before the first step.
    pub at_start: bool,
    /// Number of the marker.
    pub marker: usize,
    /// Its x coordinate (length).
    pub x: f64,
    /// Its y coordinate (length).
    pub y: f64,
    /// How deep it is (length).
    pub depth: f64,
    /// Depth that is allowed (length).
    pub allowed: f64,
}

motile_base::debug_as_explanation!(SolidEntered);

impl SolidGap {
    /// Creates a watch that lets interfaces enter solids by `allowed` (length): the flow keeps surfaces apart to a
    /// quarter of a grid spacing.
    #[must_use]
    pub fn new(allowed: f64) -> Self {
        Self { allowed, present: None, smallest: None }
    }

    /// Returns the gap at the last look (length; negative inside a solid); `None` before the first and without solids.
    #[must_use]
    pub fn present(&self) -> Option<f64> {
        self.present
    }

    /// Returns the smallest gap so far (length) and when it was; in a run that continues from a checkpoint, also before
    /// the checkpoint.
    #[must_use]
    pub fn smallest(&self) -> Option<(f64, f64)> {
        self.smallest
    }

    /// Returns the smallest gap at the present state of a system, the interface, and its marker where it is; `None`
    /// without solids or interfaces.
    pub fn measure<H: Hydrodynamics>(&mut self, system: &System<H>) -> Option<NearestSolid> {
        let found = system.nearest_solid();
        self.present = found.map(|place| place.gap);
        found
    }
}

/// The place where an interface is nearest to a solid.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct NearestSolid {
    /// The gap (length); negative inside the solid.
    pub gap: f64,
    /// The interface.
    pub interface: Handle<dyn Body>,
    /// Number of its marker.
    pub marker: usize,
    /// Place of the marker (length).
    pub place: Vec2,
}

impl<H: Hydrodynamics> Observer<H> for SolidGap {
    /// # Errors
    /// Returns [`SolidEntered`] if an interface has entered a solid.
    fn observe(&mut self, system: &mut System<H>) -> Result<(), Box<dyn std::error::Error + Send + Sync>> {
        let Some(NearestSolid { gap, interface, marker, place }) = self.measure(system) else { return Ok(()) };
        let (time, kept) = (system.time(), &mut system.record_mut(RECORD).numbers);
        if let &[least, time] = kept.as_slice() {
            self.smallest = Some((least, time));
        }
        if self.smallest.is_none_or(|(least, _)| gap < least) {
            self.smallest = Some((gap, time));
            kept.clear();
            kept.extend([gap, time]);
        }
        if gap < -self.allowed {
            let interface = system.any_body(interface)?.name().to_owned();
            let (allowed, at_start) = (self.allowed, system.steps() == 0);
            return Err(
                SolidEntered { interface, at_start, marker, x: place.x, y: place.y, depth: -gap, allowed }.into()
            );
        }
        Ok(())
    }
}

//! The gap between a droplet and elastic solids during a run.

use active_interface::ActiveDroplet;
use elastic_solids::Solid;
use ib_core::{Body, Boundary, Hydrodynamics, Observer, System};

/// Measures the gap between the first droplet of a system and all its solids, keeps the smallest one, and
/// ends the run where the droplet enters a solid deeper than it may.
///
/// ```
/// use motile::elastic_solids::Moduli;
/// use motile::prelude::*;
///
/// let swimmer = Swimmer { lengths: [6.0, 2.4], spacing: 0.1, ..Swimmer::default() };
/// let channel = ElasticChannel::new(swimmer, Moduli::from_thesis_spring_constant(1e5)?);
/// let (mut scene, _, _) = channel.build()?;
/// let mut gap = motile::SolidGap::new(0.25 * 0.1).with_set_back(channel.set_back());
/// scene.run(0.5).observe(Every::Steps(1), &mut gap).go()?;
/// let (least, time) = gap.smallest().expect("a droplet between walls");
/// println!("smallest gap {least:.3} R0 at t = {time}");
/// assert!((least - 0.2).abs() < 0.02);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug, Clone)]
pub struct SolidGap {
    allowed: f64,
    set_back: f64,
    surfaces: Boundary,
    present: Option<f64>,
    smallest: Option<(f64, f64)>,
}

/// A droplet that has entered a solid.
#[derive(Debug, Clone, Copy, PartialEq, thiserror::Error)]
#[error(
    "marker {marker} of the droplet at ({x}, {y}) is {depth} inside a solid, more than {allowed}: use a smaller time \
     step or a finer grid"
)]
pub struct SolidEntered {
    /// Number of the marker.
    pub marker: usize,
    /// Its x coordinate (length).
    pub x: f64,
    /// Its y coordinate (length).
    pub y: f64,
    /// How deep it is (length).
    pub depth: f64,
    /// What is allowed (length).
    pub allowed: f64,
}

impl SolidGap {
    /// A watch that lets the droplet enter solids by `allowed` (length): the flow keeps surfaces apart to a quarter of
    /// a grid spacing.
    #[must_use]
    pub fn new(allowed: f64) -> Self {
        Self { allowed, set_back: 0.0, surfaces: Boundary::default(), present: None, smallest: None }
    }

    /// The same for solids that are meshed this far behind the surfaces where they stop the fluid (length, see
    /// [`crate::ElasticChannel::set_back`]): gaps are those from there.
    #[must_use]
    pub fn with_set_back(mut self, set_back: f64) -> Self {
        self.set_back = set_back;
        self
    }

    /// The gap at the last look (length; negative inside a solid); `None` before the first and without solids.
    #[must_use]
    pub fn present(&self) -> Option<f64> {
        self.present
    }

    /// The smallest gap so far (length) and when it was.
    #[must_use]
    pub fn smallest(&self) -> Option<(f64, f64)> {
        self.smallest
    }

    /// The gap at the present state of a system (length) and the marker where it is; `None` without solids or droplet.
    pub fn measure<H: Hydrodynamics>(&mut self, system: &System<H>) -> Option<(f64, usize)> {
        self.surfaces.clear();
        system.bodies::<Solid>().for_each(|(_, solid)| solid.write_boundary(&[], &mut self.surfaces));
        self.surfaces.sort();
        let (_, droplet) = system.bodies::<ActiveDroplet>().next()?;
        let periods = system.hydrodynamics().medium().domain.periods;
        let (gap, marker) = self.surfaces.smallest(droplet.markers(), periods)?;
        Some((gap - self.set_back, marker))
    }
}

impl<H: Hydrodynamics> Observer<H> for SolidGap {
    /// # Errors
    /// [`SolidEntered`].
    fn observe(&mut self, system: &mut System<H>) -> Result<(), Box<dyn std::error::Error + Send + Sync>> {
        let found = self.measure(system);
        self.present = found.map(|(gap, _)| gap);
        let Some((gap, marker)) = found else { return Ok(()) };
        if self.smallest.is_none_or(|(least, _)| gap < least) {
            self.smallest = Some((gap, system.time()));
        }
        if gap < -self.allowed
            && let Some((_, droplet)) = system.bodies::<ActiveDroplet>().next()
        {
            let place = droplet.markers()[marker];
            let (x, y, allowed) = (place.x, place.y, self.allowed);
            return Err(SolidEntered { marker, x, y, depth: -gap, allowed }.into());
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests;

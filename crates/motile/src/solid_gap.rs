//! The gap between a droplet and elastic solids during a run.

use active_interface::ActiveDroplet;
use elastic_solids::Solid;
use ib_core::{Body, Handle, Hydrodynamics, Observer, System, gap::Boundary};

/// Measures the gap between the droplets of a system and all its solids, keeps the smallest one, and
/// ends the run where the droplet enters a solid deeper than it may.
///
/// ```
/// use motile::prelude::*;
///
/// let setup = Setup {
///     region: Region::Channel { length: 6.0, width: 5.4, drive: Drive::ZeroGradient },
///     method: Method::Grid(GridMethod::of_spacing(0.1)),
///     solids: SolidSetup::walls(&ChannelShape::Straight { width: 2.4 }, &Material::Springs { shear: 1875.0 }),
///     ..Setup::default()
/// };
/// let Built { mut scene, .. } = setup.build()?;
/// let mut gap = motile::SolidGap::new(0.25 * 0.1).with_set_back(setup.set_back());
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
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[error(
    "marker {marker} of {droplet} at ({x}, {y}) is {depth} inside a solid, more than {allowed}: {}",
    if *at_start { "move them apart" } else { "use a smaller time step or a finer grid" }
)]
pub struct SolidEntered {
    /// Name of the droplet.
    pub droplet: String,
    /// Whether it was there before the first step.
    pub at_start: bool,
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
    /// [`crate::Setup::set_back`]): gaps are those from there.
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

    /// The smallest gap at the present state of a system (length), the droplet, and its marker where it is; `None` without
    /// solids or droplets.
    pub fn measure<H: Hydrodynamics>(&mut self, system: &System<H>) -> Option<NearestSolid> {
        self.surfaces.clear();
        system.bodies::<Solid>().for_each(|(_, solid)| solid.write_boundary(&[], &mut self.surfaces));
        self.surfaces.sort();
        let periods = system.hydrodynamics().medium().domain.periods;
        let nearest = system.bodies::<ActiveDroplet>().filter_map(|(droplet, body)| {
            let (gap, marker) = self.surfaces.smallest(body.markers(), periods)?;
            Some(NearestSolid { gap: gap - self.set_back, droplet, marker })
        });
        nearest.min_by(|a, b| a.gap.total_cmp(&b.gap))
    }
}

/// Where a droplet is nearest to a solid.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct NearestSolid {
    /// The gap (length); negative inside the solid.
    pub gap: f64,
    /// The droplet.
    pub droplet: Handle<ActiveDroplet>,
    /// Number of its marker.
    pub marker: usize,
}

impl<H: Hydrodynamics> Observer<H> for SolidGap {
    /// # Errors
    /// [`SolidEntered`].
    fn observe(&mut self, system: &mut System<H>) -> Result<(), Box<dyn std::error::Error + Send + Sync>> {
        let found = self.measure(system);
        self.present = found.map(|place| place.gap);
        let Some(NearestSolid { gap, droplet, marker }) = found else { return Ok(()) };
        if self.smallest.is_none_or(|(least, _)| gap < least) {
            self.smallest = Some((gap, system.time()));
        }
        if gap < -self.allowed {
            let body = system.body(droplet)?;
            let (place, droplet) = (body.markers()[marker], body.name().to_owned());
            let (x, y, allowed, at_start) = (place.x, place.y, self.allowed, system.steps() == 0);
            return Err(SolidEntered { droplet, at_start, marker, x, y, depth: -gap, allowed }.into());
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests;

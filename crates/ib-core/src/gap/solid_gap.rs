//! The gap between interfaces and solids during a run.

use crate::gap::Boundary;
use crate::{Body, Handle, Hydrodynamics, Observer, System, Vec2};

/// Measures the gap between the interfaces of a system and all its solids, keeps the smallest one, and ends the run
/// where an interface enters a solid deeper than it may. Solids are all bodies that are no interfaces and have a
/// boundary ([`Body::write_boundary`]), whatever their types.
///
/// ```no_run
/// # fn run<H: ib_core::Hydrodynamics>(mut scene: ib_core::Scene<H>) -> Result<(), ib_core::SceneError> {
/// use ib_core::{Every, gap::SolidGap};
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
    surfaces: Boundary,
    markers: Vec<Vec2>,
    present: Option<f64>,
    smallest: Option<(f64, f64)>,
}

/// An interface that has entered a solid.
#[derive(Clone, PartialEq, thiserror::Error)]
#[error(
    "marker {marker} of {interface} at ({x:.4}, {y:.4}) is {depth:.3e} inside a solid, more than {allowed:.3e}: {}",
    if *at_start { "move them apart" } else { "use a smaller time step or a finer grid" }
)]
pub struct SolidEntered {
    /// Name of the interface.
    pub interface: String,
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

input_checks::debug_as_explanation!(SolidEntered);

impl SolidGap {
    /// A watch that lets interfaces enter solids by `allowed` (length): the flow keeps surfaces apart to a quarter of
    /// a grid spacing.
    #[must_use]
    pub fn new(allowed: f64) -> Self {
        let (surfaces, markers) = (Boundary::default(), Vec::new());
        Self { allowed, surfaces, markers, present: None, smallest: None }
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

    /// The smallest gap at the present state of a system, the interface, and its marker where it is; `None` without
    /// solids or interfaces.
    pub fn measure<H: Hydrodynamics>(&mut self, system: &System<H>) -> Option<NearestSolid> {
        let Self { surfaces, markers, .. } = self;
        let place = |body: &dyn Body, markers: &mut Vec<Vec2>| {
            markers.resize(body.marker_count(), Vec2::ZERO);
            body.write_markers(markers);
        };
        surfaces.clear();
        for (_, solid) in system.all_bodies().filter(|(_, body)| !body.kind().is_interface()) {
            place(solid, markers);
            solid.write_boundary(markers, surfaces);
        }
        surfaces.sort();
        let periods = system.hydrodynamics().discretisation().domain.periods;
        let interfaces = system.all_bodies().filter(|(_, body)| body.kind().is_interface());
        let nearest = interfaces.filter_map(|(interface, body)| {
            place(body, markers);
            let (gap, marker) = surfaces.smallest(markers, periods)?;
            Some(NearestSolid { gap, interface, marker, place: markers[marker] })
        });
        nearest.min_by(|a, b| a.gap.total_cmp(&b.gap))
    }
}

/// Where an interface is nearest to a solid.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct NearestSolid {
    /// The gap (length); negative inside the solid.
    pub gap: f64,
    /// The interface.
    pub interface: Handle<dyn Body>,
    /// Number of its marker.
    pub marker: usize,
    /// Where the marker is (length).
    pub place: Vec2,
}

impl<H: Hydrodynamics> Observer<H> for SolidGap {
    /// # Errors
    /// [`SolidEntered`].
    fn observe(&mut self, system: &mut System<H>) -> Result<(), Box<dyn std::error::Error + Send + Sync>> {
        let found = self.measure(system);
        self.present = found.map(|place| place.gap);
        let Some(NearestSolid { gap, interface, marker, place }) = found else { return Ok(()) };
        if self.smallest.is_none_or(|(least, _)| gap < least) {
            self.smallest = Some((gap, system.time()));
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

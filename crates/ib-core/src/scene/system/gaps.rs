//! How near the bodies come to one another and to walls.

use super::System;
use crate::gap::Gap;
use crate::{Hydrodynamics, MarkerKind, Medium, Repulsion, SceneError, Vec2, wall_gap};

/// How deep a marker may be inside another body, in grid spacings: films that drain at rest come to this by the
/// round-off of a grid.
const CONTACT: f64 = 0.25;

impl<H: Hydrodynamics> System<H> {
    /// The smallest distance of an interface to a rigid wall at the present state (length; negative beyond a wall, see
    /// [`wall_gap`]); `None` without walls or interfaces. Solids ([`MarkerKind::Points`]) may stand on a wall and do
    /// not count. Needs no evaluation.
    pub fn wall_gap(&mut self) -> Option<f64> {
        let walls = self.hydrodynamics.medium().domain.walls?;
        let interfaces = || self.bodies.iter().filter(|body| body.kind() != MarkerKind::Points);
        self.positions.resize(interfaces().map(|body| body.marker_count()).sum(), Vec2::zeros());
        let mut start = 0;
        for body in interfaces() {
            let end = start + body.marker_count();
            body.write_markers(&mut self.positions[start..end]);
            start = end;
        }
        (start > 0).then(|| wall_gap(&self.positions, walls))
    }

    /// The smallest [`System::wall_gap`] since the start (length): over the states after each addition of a body and at
    /// the end of each step.
    #[must_use]
    pub fn minimum_wall_gap(&self) -> Option<f64> {
        self.minimum_wall_gap
    }

    /// The smallest gap between two interfaces, or one and its own image in a periodic domain, since the start
    /// (length), where it was small enough to be looked for; negative where they overlap.
    #[must_use]
    pub fn minimum_gap(&self) -> Option<f64> {
        self.minimum_gap
    }

    /// The largest distance of neighbouring markers of an interface (length).
    fn finest_markers(&self) -> f64 {
        let groups = self.markers.groups().iter().filter(|group| group.kind != MarkerKind::Points);
        groups
            .flat_map(|group| self.markers.positions[group.range.clone()].windows(2))
            .map(|pair| (pair[1] - pair[0]).norm())
            .fold(0.0, f64::max)
    }

    /// The repulsion between interfaces, if it is on.
    #[must_use]
    pub fn repulsion(&self) -> Option<&Repulsion> {
        self.repulsion.as_ref()
    }

    /// Looks at the gaps of the present state: interfaces must not be inside other bodies or their own images by more
    /// than a quarter of the grid spacing, and no gap narrower than the bound, if there is one.
    pub(crate) fn check_gaps(&mut self) -> Result<(), SceneError> {
        let Medium { domain, spacing, .. } = self.hydrodynamics.medium();
        // Without a grid the spacing of the markers that carry the flow.
        let scale = spacing.unwrap_or_else(|| self.finest_markers());
        self.narrowest = self.contacts.narrowest(&self.bodies, &domain, scale);
        let (time, allowed) = (self.time, CONTACT * scale);
        let name = |index: usize| self.bodies[index].name().to_owned();
        if let Some(Gap { body, marker, other, width }) = self.narrowest {
            if width < -allowed {
                let place = self.contacts.place(body, marker);
                let (body, other, [x, y]) = (name(body), name(other), [place.x, place.y]);
                return Err(SceneError::Crossing { time, body, marker, x, y, other, depth: -width, allowed });
            }
            if let Some(bound) = self.least_gap.filter(|&bound| width < bound) {
                return Err(SceneError::Gap { time, body: name(body), other: name(other), gap: width, bound });
            }
        }
        if let Some(bound) = self.least_gap
            && let Some(gap) = self.wall_gap().filter(|&gap| gap < bound)
        {
            let (body, other) = ("a body".to_owned(), "a wall".to_owned());
            return Err(SceneError::Gap { time, body, other, gap, bound });
        }
        Ok(())
    }

    pub(super) fn record_wall_gap(&mut self) {
        if let Some(gap) = self.wall_gap() {
            self.minimum_wall_gap = Some(self.minimum_wall_gap.map_or(gap, |least| least.min(gap)));
        }
    }
}

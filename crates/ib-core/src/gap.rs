//! Gaps between bodies, and what keeps them open.

mod boundary;
mod repulsion;
mod wall_gap;

pub use boundary::Boundary;
pub use repulsion::Repulsion;
pub use wall_gap::wall_gap;

use crate::{Body, Domain, MarkerKind, Vec2};

/// How far boundaries are looked for, in units of what a contact is measured in.
const REACH: f64 = 4.0;

/// The narrowest gap between a marker of an interface and the boundary of another body, or of its own image in a
/// periodic domain.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Gap {
    /// Number of the interface.
    pub(crate) body: usize,
    /// Number of its marker.
    pub(crate) marker: usize,
    /// Number of the other body.
    pub(crate) other: usize,
    /// The gap (length); negative where the marker is inside the other body.
    pub(crate) width: f64,
}

/// Looks for gaps; keeps its memory.
#[derive(Debug, Clone, Default)]
pub(crate) struct ContactFinder {
    boundaries: Vec<Boundary>,
    positions: Vec<Vec<Vec2>>,
}

impl ContactFinder {
    /// Where a marker of an interface was when gaps were looked for.
    pub(crate) fn place(&self, body: usize, marker: usize) -> Vec2 {
        self.positions[body][marker]
    }

    /// The narrowest gap of less than four times `scale` (length), if there is one.
    pub(crate) fn narrowest(&mut self, bodies: &[Box<dyn Body>], domain: &Domain, scale: f64) -> Option<Gap> {
        let is_interface = |body: &dyn Body| !matches!(body.kind(), MarkerKind::Points);
        if !bodies.iter().any(|body| is_interface(body.as_ref())) {
            return None;
        }
        self.boundaries.resize_with(bodies.len(), Boundary::default);
        self.positions.resize_with(bodies.len(), Vec::new);
        for ((body, boundary), positions) in bodies.iter().zip(&mut self.boundaries).zip(&mut self.positions) {
            boundary.clear();
            positions.resize(body.marker_count(), Vec2::zeros());
            body.write_markers(positions);
            body.write_boundary(boundary);
            boundary.finish();
        }
        let reach = REACH * scale;
        let mut narrowest: Option<Gap> = None;
        let mut note = |gap: Gap| {
            if narrowest.is_none_or(|least| gap.width < least.width) {
                narrowest = Some(gap);
            }
        };
        for (index, body) in bodies.iter().enumerate().filter(|(_, body)| is_interface(body.as_ref())) {
            for (other, boundary) in self.boundaries.iter().enumerate() {
                let periods = if other == index { [None; 2] } else { domain.periods };
                for shift in shifts(domain, other == index).into_iter().flatten() {
                    if !self.boundaries[index].is_near(boundary, shift, periods, reach) {
                        continue;
                    }
                    for (marker, place) in self.positions[index].iter().enumerate() {
                        if let Some(width) = boundary.distance(place + shift, periods, reach) {
                            note(Gap { body: index, marker, other, width });
                        }
                    }
                }
            }
            debug_assert_eq!(body.marker_count(), self.positions[index].len());
        }
        narrowest
    }
}

/// Displacements of an interface at which it is compared with a boundary: for one of another body its place (that
/// body's nearest image is looked for), for its own those of its images.
fn shifts(domain: &Domain, own: bool) -> [Option<Vec2>; 4] {
    if !own {
        return [Some(Vec2::zeros()), None, None, None];
    }
    let [x, y] = domain.periods;
    let both = x.zip(y);
    [
        x.map(|x| Vec2::new(x, 0.0)),
        y.map(|y| Vec2::new(0.0, y)),
        both.map(|(x, y)| Vec2::new(x, y)),
        both.map(|(x, y)| Vec2::new(x, -y)),
    ]
}

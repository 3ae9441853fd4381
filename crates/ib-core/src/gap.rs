//! Gaps between bodies, between bodies and walls, and what keeps them open.

mod between;
mod boundary;
mod repulsion;
mod solid_gap;
mod wall_gap;

pub(crate) use between::Outline;
pub use boundary::Boundary;
pub use repulsion::Repulsion;
pub use solid_gap::{NearestSolid, SolidEntered, SolidGap};
pub use wall_gap::wall_gap;

use crate::{Body, Domain, Markers, Vec2};

/// How far boundaries are looked for during steps, in units of what a contact is measured in.
const REACH: f64 = 4.0;
/// Markers of an interface that are asked whether they lie inside another one.
const ASKED: usize = 16;

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
    /// The gap (length); negative where the marker is inside the other body, or outside of the one that its interface
    /// lies in.
    pub(crate) width: f64,
}

/// The boundaries of all bodies; keeps its memory.
#[derive(Debug, Clone, Default)]
pub(crate) struct Gaps {
    boundaries: Vec<Boundary>,
}

impl Gaps {
    /// Looks at the bodies where they are now, with their markers.
    pub(crate) fn update(&mut self, bodies: &[Box<dyn Body>], markers: &Markers) {
        self.boundaries.resize_with(bodies.len(), Boundary::default);
        for ((body, boundary), group) in bodies.iter().zip(&mut self.boundaries).zip(markers.groups()) {
            boundary.clear();
            body.write_boundary(&markers.positions[group.range.clone()], boundary);
            boundary.sort();
        }
    }

    /// Whether an interface lies inside another one, or inside one of its images: most of its markers do.
    pub(crate) fn is_nested(&self, markers: &Markers, inner: usize, outer: usize, periods: [Option<f64>; 2]) -> bool {
        let group = |index: usize| &markers.groups()[index];
        if inner == outer || !(group(inner).kind.is_interface() && group(outer).kind.is_interface()) {
            return false;
        }
        let [Some(small), Some(large)] = [inner, outer].map(|index| self.boundaries[index].frame()) else {
            return false;
        };
        // A part of the inner one may have crossed.
        if !small.is_inside(&large, periods, 0.5 * small.size()) {
            return false;
        }
        let positions = &markers.positions[group(inner).range.clone()];
        let asked = positions.iter().step_by(positions.len().div_ceil(ASKED).max(1));
        let inside = |point: &&Vec2| self.boundaries[outer].distance(**point, periods) < 0.0;
        2 * asked.clone().filter(inside).count() > asked.count()
    }

    /// The narrowest gap of less than four times `scale` (length), if there is one.
    pub(crate) fn narrowest(&self, markers: &Markers, domain: &Domain, scale: f64) -> Option<Gap> {
        let reach = REACH * scale;
        let mut narrowest: Option<Gap> = None;
        let interfaces = markers.groups().iter().enumerate().filter(|(_, group)| group.kind.is_interface());
        for (body, group) in interfaces {
            let Some(frame) = self.boundaries[body].frame() else { continue };
            for (other, boundary) in self.boundaries.iter().enumerate() {
                let Some(large) = boundary.frame() else { continue };
                let periods = if other == body { [None; 2] } else { domain.periods };
                for shift in shifts(domain, other == body).into_iter().flatten() {
                    if !frame.moved(shift).is_near(&large, periods, reach) {
                        continue;
                    }
                    let sign = if self.is_nested(markers, body, other, periods) { -1.0 } else { 1.0 };
                    for (marker, place) in markers.positions[group.range.clone()].iter().enumerate() {
                        let distance = boundary.distance_within(place + shift, periods, reach);
                        if let Some(width) = distance.map(|distance| sign * distance)
                            && narrowest.is_none_or(|least| width < least.width)
                        {
                            narrowest = Some(Gap { body, marker, other, width });
                        }
                    }
                }
            }
        }
        narrowest
    }

    /// The deepest corner of a body other than an interface inside another such body: the numbers of both, the corner,
    /// and how deep it is (length). `None` where none is inside.
    pub(crate) fn deepest_overlap(
        &self,
        markers: &Markers,
        periods: [Option<f64>; 2],
    ) -> Option<(usize, usize, Vec2, f64)> {
        let mut deepest: Option<(usize, usize, Vec2, f64)> = None;
        let solids = || {
            let boundaries = self.boundaries.iter().enumerate();
            boundaries.filter(|(index, _)| !markers.groups()[*index].kind.is_interface())
        };
        for (body, boundary) in solids() {
            for (other, around) in solids().filter(|(other, _)| *other != body) {
                let (Some(frame), Some(large)) = (boundary.frame(), around.frame()) else { continue };
                if !frame.is_near(&large, periods, 0.0) {
                    continue;
                }
                for corner in boundary.corners() {
                    let depth = -around.distance(corner, periods);
                    if depth > deepest.map_or(0.0, |(.., depth)| depth) {
                        deepest = Some((body, other, corner, depth));
                    }
                }
            }
        }
        deepest
    }
}

/// Displacements of an interface at which it is compared with a boundary: for one of another body its place (that
/// body's nearest image is looked for), for its own those of its images.
fn shifts(domain: &Domain, own: bool) -> [Option<Vec2>; 4] {
    if !own {
        return [Some(Vec2::ZERO), None, None, None];
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

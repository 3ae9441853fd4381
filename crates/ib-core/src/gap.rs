//! Gaps between bodies, between bodies and walls, and what keeps them open.

mod between;
mod boundary;
mod films;
mod overlap;
mod repulsion;
mod solid_gap;
mod wall_gap;

pub(crate) use between::Outline;
pub use boundary::Boundary;
pub(crate) use films::{Films, Surroundings};
pub use overlap::Overlap;
pub use repulsion::Repulsion;
pub use solid_gap::{NearestSolid, SolidEntered, SolidGap};
pub use wall_gap::wall_gap;

use crate::{Body, Discretisation, Domain, MarkerKind, Markers, Vec2};

/// How far boundaries are looked for during steps, in units of what a contact is measured in.
pub(crate) const REACH: f64 = 4.0;

/// The narrowest gap between an interface and another body, or between an interface and its own image in a periodic
/// domain.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Gap {
    /// Number of the body whose corner it is measured from.
    pub(crate) body: usize,
    /// Where that corner is (length).
    pub(crate) place: Vec2,
    /// Number of the other body.
    pub(crate) other: usize,
    /// The gap (length); negative where the corner is inside the other body, or outside of the interface that its body
    /// lies in.
    pub(crate) width: f64,
}

/// The boundaries of all bodies, and what the bodies are; keeps its memory.
#[derive(Debug, Clone, Default)]
pub struct Gaps {
    boundaries: Vec<Boundary>,
    kinds: Vec<MarkerKind>,
}

impl Gaps {
    /// Bodies that are no part of a scene yet.
    #[must_use]
    pub fn of(bodies: impl IntoIterator<Item = (Boundary, MarkerKind)>) -> Self {
        let (mut boundaries, kinds): (Vec<Boundary>, _) = bodies.into_iter().unzip();
        boundaries.iter_mut().for_each(Boundary::sort);
        Self { boundaries, kinds }
    }

    /// Looks at the bodies where they are now, with their markers.
    pub(crate) fn update(&mut self, bodies: &[Box<dyn Body>], markers: &Markers) {
        self.boundaries.resize_with(bodies.len(), Boundary::default);
        self.kinds.clear();
        self.kinds.extend(markers.groups().iter().map(|group| group.kind));
        for ((body, boundary), group) in bodies.iter().zip(&mut self.boundaries).zip(markers.groups()) {
            boundary.clear();
            body.write_boundary(&markers.positions[group.range.clone()], boundary);
            boundary.sort();
        }
    }

    /// Two interfaces, or one and its own image, without fluid between them: the body, the other one and where
    /// (length).
    #[must_use]
    pub fn contact(&self, discretisation: &Discretisation) -> Option<(usize, usize, Vec2)> {
        let interfaces = |gap: &Gap| self.kinds[gap.body].is_interface() && self.kinds[gap.other].is_interface();
        let narrowest = self.narrowest_near(discretisation, 0.0).filter(interfaces);
        narrowest.filter(|gap| gap.width <= 0.0).map(|gap| (gap.body, gap.other, gap.place))
    }

    /// Whether a body lies inside an interface, or inside one of its images.
    fn lies_in(&self, inner: usize, outer: usize, periods: [Option<f64>; 2]) -> bool {
        let around = inner != outer && self.kinds[outer].holds_fluid();
        around && self.boundaries[inner].lies_in(&self.boundaries[outer], periods, 0.0)
    }

    /// The narrowest gap of those that are looked at during steps, below `bound` (length) or four times what contacts
    /// are measured in.
    pub(crate) fn narrowest_near(&self, discretisation: &Discretisation, bound: f64) -> Option<Gap> {
        self.narrowest(&discretisation.domain, bound.max(REACH * self.contact_scale(discretisation)))
    }

    /// The narrowest gap below `reach` (length), if there is one: from the corners of interfaces to all bodies, and
    /// from the corners of other bodies to interfaces.
    pub(crate) fn narrowest(&self, domain: &Domain, reach: f64) -> Option<Gap> {
        let mut narrowest: Option<Gap> = None;
        for (body, from) in self.boundaries.iter().enumerate() {
            let Some(frame) = from.frame() else { continue };
            for (other, boundary) in self.boundaries.iter().enumerate() {
                let Some(large) = boundary.frame() else { continue };
                if !(self.kinds[body].is_interface() || self.kinds[other].is_interface()) {
                    continue;
                }
                let periods = if other == body { [None; 2] } else { domain.periods };
                for shift in shifts(domain, other == body).into_iter().flatten() {
                    if !frame.moved(shift).is_near(&large, periods, reach) {
                        continue;
                    }
                    let sign = if self.lies_in(body, other, periods) { -1.0 } else { 1.0 };
                    for place in from.corners() {
                        let distance = boundary.distance_within(place + shift, periods, reach);
                        if let Some(width) = distance.map(|distance| sign * distance)
                            && narrowest.is_none_or(|least| width < least.width)
                        {
                            narrowest = Some(Gap { body, place, other, width });
                        }
                    }
                }
            }
        }
        narrowest
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

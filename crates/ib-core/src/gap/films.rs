//! The films between interfaces and what is close to them: forces that keep them open, and how fast they close.

use super::boundary::{Boundary, Nearest};
use super::{Repulsion, shifts};
use crate::{Domain, MarkerKind, Markers, Vec2};

/// A corner of a surface close to a side of another one.
#[derive(Debug, Clone, Copy)]
struct Contact {
    corner: usize,
    /// The corners at the ends of that side; `None` for a rigid wall.
    ends: Option<[usize; 2]>,
    /// How far along the side the nearest place is, from 0 to 1.
    part: f64,
    /// The gradient of the gap by the place of the corner.
    normal: Vec2,
    /// The gap (length), negative where they overlap.
    gap: f64,
}

/// The surface of a body: its corners and sides among those of all bodies, in the order of the boundary's sides.
#[derive(Debug, Clone, Default)]
struct Surface {
    boundary: Boundary,
    corners: [usize; 2],
    first_side: usize,
}

/// The surfaces of all bodies at one state, and where they are close to one another or to walls; keeps its memory.
///
/// Surfaces are the polygons of interfaces and those that markers of solids trace. Gaps are those of corners from
/// sides, measured both ways, of which each counts a half; at walls that of the corners alone, which is the whole.
#[derive(Debug, Clone, Default)]
pub(crate) struct Films {
    surfaces: Vec<Surface>,
    /// The marker of each corner, and half of the lengths of its two sides (length).
    markers: Vec<usize>,
    weights: Vec<f64>,
    sides: Vec<[usize; 2]>,
    contacts: Vec<Contact>,
    /// Energy per length at the corners (force).
    energies: Vec<f64>,
}

/// What is close in a scene: its region, its rigid walls of other shapes, and the interface that each body lies in.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Surroundings<'a> {
    pub(crate) domain: Domain,
    pub(crate) walls: Option<&'a Boundary>,
    pub(crate) around: &'a [Option<usize>],
}

impl Films {
    /// Finds where interfaces are closer than `reach` (length) to other surfaces.
    pub(crate) fn find(&mut self, markers: &Markers, surroundings: Surroundings<'_>, reach: f64) {
        self.place(markers, surroundings.domain.periods[0].unwrap_or(0.0));
        self.contacts.clear();
        for body in 0..self.surfaces.len() {
            for other in 0..self.surfaces.len() {
                let kinds = [body, other].map(|index| markers.groups()[index].kind);
                if kinds.iter().any(MarkerKind::is_interface) {
                    self.find_between(body, other, markers, surroundings, reach);
                }
            }
            if markers.groups()[body].kind.is_interface() {
                self.find_walls(body, markers, surroundings, reach);
            }
        }
    }

    /// Lays out the surfaces.
    fn place(&mut self, markers: &Markers, period: f64) {
        self.surfaces.resize_with(markers.groups().len(), Surface::default);
        self.markers.clear();
        self.sides.clear();
        for (surface, group) in self.surfaces.iter_mut().zip(markers.groups()) {
            surface.boundary.clear();
            surface.corners = [self.markers.len(); 2];
            surface.first_side = self.sides.len();
            let mut trace = |curve: &mut dyn Iterator<Item = (usize, i32)>, periods: i32| {
                let first = self.markers.len();
                let place =
                    |marker: usize, shift: i32| markers.positions[marker] + Vec2::new(f64::from(shift) * period, 0.0);
                let mut before: Option<Vec2> = None;
                let mut start = Vec2::ZERO;
                for (marker, shift) in curve {
                    let (here, corner) = (place(marker, shift), self.markers.len());
                    self.markers.push(marker);
                    match before {
                        Some(before) => {
                            surface.boundary.push(before, here);
                            self.sides.push([corner - 1, corner]);
                        }
                        None => start = here,
                    }
                    before = Some(here);
                }
                if let Some(last) = before {
                    surface.boundary.push(last, start + Vec2::new(f64::from(periods) * period, 0.0));
                    self.sides.push([self.markers.len() - 1, first]);
                }
            };
            if group.kind.is_interface() {
                trace(&mut group.range.clone().map(|marker| (marker, 0)), 0);
            }
            for curve in &group.surfaces {
                let absolute = |&(marker, shift): &(usize, i32)| (group.range.start + marker, shift);
                trace(&mut curve.markers.iter().map(absolute), curve.periods);
            }
            surface.corners[1] = self.markers.len();
            surface.boundary.sort();
        }
        self.weights.clear();
        self.weights.resize(self.markers.len(), 0.0);
        let lengths = self.surfaces.iter().flat_map(|surface| surface.boundary.sides());
        for (corners, [start, end]) in self.sides.iter().zip(lengths) {
            corners.iter().for_each(|&corner| self.weights[corner] += 0.5 * start.distance(*end));
        }
    }

    fn find_between(
        &mut self,
        body: usize,
        other: usize,
        markers: &Markers,
        Surroundings { domain, around, .. }: Surroundings<'_>,
        reach: f64,
    ) {
        let Self { surfaces, markers: corners, sides, contacts, .. } = self;
        let (from, to) = (&surfaces[body], &surfaces[other]);
        let [Some(frame), Some(large)] = [from, to].map(|surface| surface.boundary.frame()) else { return };
        let periods = if other == body { [None; 2] } else { domain.periods };
        let mut outer = std::iter::successors(around.get(body).copied().flatten(), |&outer| around[outer]);
        let sign = if outer.any(|outer| outer == other) { -1.0 } else { 1.0 };
        for shift in shifts(&domain, other == body).into_iter().flatten().flat_map(|shift| [shift, -shift]) {
            if !frame.moved(shift).is_near(&large, periods, reach) {
                continue;
            }
            let [first, end] = from.corners;
            for (corner, &marker) in corners[..end].iter().enumerate().skip(first) {
                let place = markers.positions[marker] + shift;
                let Some(found) = to.boundary.nearest_within(place, periods, reach) else { continue };
                let ends = Some(sides[to.first_side + found.side]);
                contacts.push(contact(corner, ends, &found, to.boundary.sides()[found.side], sign));
            }
            if shift == Vec2::ZERO {
                // There is one such place.
                return;
            }
        }
    }

    fn find_walls(
        &mut self,
        body: usize,
        markers: &Markers,
        Surroundings { domain, walls, .. }: Surroundings<'_>,
        reach: f64,
    ) {
        let Self { surfaces, markers: corners, contacts, .. } = self;
        let [first, end] = surfaces[body].corners;
        for (corner, &marker) in corners[..end].iter().enumerate().skip(first) {
            let place = markers.positions[marker];
            if let Some([below, above]) = domain.walls {
                for (gap, normal) in [(place.y - below, Vec2::Y), (above - place.y, -Vec2::Y)] {
                    if gap < reach {
                        contacts.push(Contact { corner, ends: None, part: 0.0, normal, gap });
                    }
                }
            }
            if let Some(walls) = walls
                && let Some(found) = walls.nearest_within(place, domain.periods, reach)
            {
                contacts.push(contact(corner, None, &found, walls.sides()[found.side], 1.0));
            }
        }
    }

    /// Adds the forces of a repulsion to those of the markers.
    pub(crate) fn push_apart(&mut self, repulsion: &Repulsion, markers: &mut Markers) {
        let Self { surfaces, markers: corners, weights, sides, contacts, energies } = self;
        energies.clear();
        energies.resize(corners.len(), 0.0);
        for contact in contacts.iter() {
            energies[contact.corner] += contact.share() * repulsion.energy(contact.gap);
            let force = contact.share() * weights[contact.corner] * repulsion.pressure(contact.gap) * contact.normal;
            markers.forces[corners[contact.corner]] += force;
            if let Some([start, end]) = contact.ends {
                markers.forces[corners[start]] -= (1.0 - contact.part) * force;
                markers.forces[corners[end]] -= contact.part * force;
            }
        }
        // Sides that grow take energy: a tension.
        let lengths = surfaces.iter().flat_map(|surface| surface.boundary.sides());
        for (&[start, end], [from, to]) in sides.iter().zip(lengths) {
            let tension = 0.5 * (energies[start] + energies[end]);
            if tension != 0.0 {
                let force = tension * (to - from).normalize_or_zero();
                markers.forces[corners[start]] += force;
                markers.forces[corners[end]] -= force;
            }
        }
    }

    /// The energy of a repulsion (force times length).
    #[cfg(test)]
    pub(crate) fn energy(&self, repulsion: &Repulsion) -> f64 {
        let each = |c: &Contact| c.share() * self.weights[c.corner] * repulsion.energy(c.gap);
        self.contacts.iter().map(each).sum()
    }

    /// The fastest relaxation of films under a repulsion (1/time), in fluid of viscosity eta: that of the gap, and, as
    /// `stiffness` (1/length) says, that of what it adds to the tension.
    pub(crate) fn relaxation(&self, repulsion: &Repulsion, viscosity: f64, stiffness: f64) -> f64 {
        let rate = |contact: &Contact| {
            let tension = contact.share() * repulsion.energy(contact.gap);
            repulsion.rate(contact.gap, viscosity) + stiffness * tension / viscosity
        };
        self.contacts.iter().map(rate).fold(0.0, f64::max)
    }

    /// The time in which the film that closes fastest would be gone at its present velocity (time), and the body whose
    /// corner it is measured from; gaps below `least` (length) count as that.
    pub(crate) fn closing(&self, markers: &Markers, least: f64) -> Option<(f64, usize)> {
        let velocity = |corner: usize| markers.velocities[self.markers[corner]];
        let times = self.contacts.iter().filter_map(|contact| {
            let other =
                contact.ends.map_or(Vec2::ZERO, |[start, end]| velocity(start).lerp(velocity(end), contact.part));
            let rate = (velocity(contact.corner) - other).dot(contact.normal);
            (rate < 0.0).then(|| (contact.gap.max(least) / -rate, contact.corner))
        });
        let (time, corner) = times.min_by(|a, b| a.0.total_cmp(&b.0))?;
        let body = self.surfaces.iter().position(|surface| corner < surface.corners[1]);
        body.map(|body| (time, body))
    }
}

impl Contact {
    /// What it counts for.
    fn share(&self) -> f64 {
        if self.ends.is_some() { 0.5 } else { 1.0 }
    }
}

/// A corner at a place found on a side; `sign` is -1 for what lies inside.
fn contact(corner: usize, ends: Option<[usize; 2]>, found: &Nearest, [from, to]: [Vec2; 2], sign: f64) -> Contact {
    let distance = found.distance();
    let outwards = Vec2::new(to.y - from.y, from.x - to.x).normalize_or_zero();
    let normal = if distance == 0.0 { outwards } else { found.away / distance };
    Contact { corner, ends, part: found.part, normal: sign * normal, gap: sign * distance }
}

#[cfg(test)]
mod tests;

//! The films between interfaces and what is close to them: forces that keep them open, and how fast they close.

use std::f64::consts::PI;

use super::boundary::{Boundary, Nearest, shifts};
use super::{Repulsion, Surfaces};
use crate::{Domain, threads};
use motile_base::{Vec2, boxes::Periods};

/// A corner of a surface close to a side of another one.
#[derive(Debug, Clone, Copy)]
pub(super) struct Contact {
    pub(super) corner: usize,
    /// The corners at the ends of that side; `None` for a rigid wall.
    pub(super) ends: Option<[usize; 2]>,
    /// How far along the side the nearest place is, from 0 to 1.
    pub(super) part: f64,
    /// The gradient of the gap by the place of the corner.
    pub(super) normal: Vec2,
    /// The gap (length), negative where they overlap.
    pub(super) gap: f64,
}

/// The places where the surfaces of bodies are close to one another or to walls; keeps its memory.
///
/// Gaps are measured from corners to sides, measured both ways, of which each counts a half; at walls from the corners
/// alone, which is the whole. Of what is fixed no force moves anything.
#[derive(Debug, Clone, Default)]
pub(crate) struct Films {
    /// Half of the lengths of the two sides of each corner (length), or of the halves of rings that they stand for
    /// (length squared).
    pub(super) weights: Vec<f64>,
    /// True for bodies of revolution about the x axis.
    axisymmetric: bool,
    /// Contacts of the corners of some bodies each, in the order of the bodies.
    pieces: Vec<Piece>,
    /// Energy per length at the corners (force).
    energies: Vec<f64>,
}

/// Contacts of the corners of some bodies.
#[derive(Debug, Clone, Default)]
struct Piece {
    contacts: Vec<Contact>,
    /// Bodies close to the one that is looked at.
    near: Vec<usize>,
}

/// Surroundings of the bodies: the region, its rigid walls of other shapes, and the interface that each body lies in.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Surroundings<'a> {
    pub(crate) domain: Domain,
    pub(crate) walls: Option<&'a Boundary>,
    pub(crate) around: &'a [Option<usize>],
    /// True where bodies are of revolution about the x axis ([`crate::Hydrodynamics::axisymmetric`]).
    pub(crate) axisymmetric: bool,
}

impl Films {
    /// Finds where interfaces are closer than `reach` (length) to other surfaces.
    pub(crate) fn find(&mut self, surfaces: &Surfaces, surroundings: Surroundings<'_>, reach: f64) {
        self.weights.clear();
        self.weights.resize(surfaces.corners.len(), 0.0);
        self.axisymmetric = surroundings.axisymmetric;
        for ((corner, next), side) in surfaces.sides() {
            let size = side[0].distance(side[1]) * if self.axisymmetric { half_circle(side).abs() } else { 1.0 };
            [corner, next].into_iter().for_each(|corner| self.weights[corner] += 0.5 * size);
        }
        let bodies = surfaces.kinds.len();
        let count = threads::pieces(surfaces.corners.len());
        self.pieces.resize_with(count, Piece::default);
        let len = bodies.div_ceil(count);
        threads::each(0, &mut self.pieces, surfaces.corners.len(), &|number, piece| {
            piece.contacts.clear();
            for body in (number * len..bodies).take(len) {
                piece.find(surfaces, body, surroundings, reach);
            }
        });
    }

    /// Returns all contacts.
    pub(super) fn contacts(&self) -> impl Iterator<Item = &Contact> {
        self.pieces.iter().flat_map(|piece| &piece.contacts)
    }

    /// Adds the forces of a repulsion to `forces`, the forces of the markers (force).
    pub(crate) fn push_apart(&mut self, repulsion: &Repulsion, surfaces: &Surfaces, forces: &mut [Vec2]) {
        let Self { weights, pieces, energies, axisymmetric } = self;
        energies.clear();
        energies.resize(weights.len(), 0.0);
        let mut push = |corner: usize, force: Vec2| {
            if let Some(marker) = surfaces.corners[corner].marker {
                forces[marker] += force;
            }
        };
        for contact in pieces.iter().flat_map(|piece| &piece.contacts) {
            energies[contact.corner] += contact.share() * repulsion.energy(contact.gap);
            let force = contact.share() * weights[contact.corner] * repulsion.pressure(contact.gap) * contact.normal;
            push(contact.corner, force);
            if let Some([start, end]) = contact.ends {
                push(start, -(1.0 - contact.part) * force);
                push(end, -contact.part * force);
            }
        }
        // Sides that grow take energy: a tension.
        for ((start, end), [from, to]) in surfaces.sides() {
            let tension = 0.5 * (energies[start] + energies[end]);
            if tension != 0.0 {
                let mut force = tension * (to - from).try_normalize().unwrap_or_default();
                if *axisymmetric {
                    let circle = half_circle([from, to]);
                    force *= circle.abs();
                    // Circles that grow take energy as well.
                    let hoop = 0.5 * PI * tension * from.distance(to) * circle.signum();
                    [start, end].into_iter().for_each(|corner| push(corner, Vec2::new(0.0, -hoop)));
                }
                push(start, force);
                push(end, -force);
            }
        }
    }

    /// Returns the energy of a repulsion (force times length).
    #[cfg(test)]
    pub(crate) fn energy(&self, repulsion: &Repulsion) -> f64 {
        let each = |c: &Contact| c.share() * self.weights[c.corner] * repulsion.energy(c.gap);
        self.contacts().map(each).sum()
    }

    /// Returns the fastest relaxation of films under a repulsion (1/time), in fluid of that viscosity (stress times
    /// time). It is the rate of the gap, and the rate of what it adds to the tension, which relaxes at `unit` (1/(force
    /// times time)) times it.
    pub(crate) fn relaxation(&self, repulsion: &Repulsion, viscosity: f64, unit: f64) -> f64 {
        let rate = |contact: &Contact| {
            let tension = contact.share() * repulsion.energy(contact.gap);
            repulsion.rate(contact.gap, viscosity) + unit * tension
        };
        self.contacts().map(rate).fold(0.0, f64::max)
    }

    /// Returns the time in which the film that closes fastest would be gone at the velocities of the markers (length
    /// per time), and the body whose corner it is measured from. Gaps below `least` (length) count as that.
    pub(crate) fn closing(&self, surfaces: &Surfaces, velocities: &[Vec2], least: f64) -> Option<(f64, usize)> {
        let velocity = |corner: usize| surfaces.corners[corner].marker.map_or(Vec2::ZERO, |marker| velocities[marker]);
        let times = self.contacts().filter_map(|contact| {
            let other =
                contact.ends.map_or(Vec2::ZERO, |[start, end]| velocity(start).lerp(velocity(end), contact.part));
            let rate = (velocity(contact.corner) - other).dot(contact.normal);
            (rate < 0.0).then(|| (contact.gap.max(least) / -rate, contact.corner))
        });
        let (time, corner) = times.min_by(|a, b| a.0.total_cmp(&b.0))?;
        Some((time, surfaces.firsts.partition_point(|&first| first <= corner).checked_sub(1)?))
    }

    /// Returns the narrowest film between fluid interfaces (length), if there is one.
    pub(crate) fn thinnest_between_fluids(&self, surfaces: &Surfaces) -> Option<f64> {
        let holds_fluid = |corner: usize| {
            let body = surfaces.firsts.partition_point(|&first| first <= corner).checked_sub(1);
            body.is_some_and(|body| surfaces.kinds[body].holds_fluid())
        };
        self.contacts().fold(None, |least: Option<f64>, contact| {
            let narrower = least.is_none_or(|least| contact.gap < least);
            let between = |[other, _]: [usize; 2]| holds_fluid(other) && holds_fluid(contact.corner);
            if narrower && contact.ends.is_some_and(between) { Some(contact.gap) } else { least }
        })
    }
}

impl Piece {
    /// Adds the contacts of the corners of a body.
    fn find(&mut self, surfaces: &Surfaces, body: usize, surroundings: Surroundings<'_>, reach: f64) {
        let (kind, Some(frame)) = (&surfaces.kinds[body], surfaces.boundaries[body].frame()) else { return };
        // Sums of forces are those of the order of the bodies.
        let mut near = std::mem::take(&mut self.near);
        near.clear();
        surfaces.each_near(&frame, surroundings.domain.periods, reach, &mut |other| near.push(other));
        near.sort_unstable();
        for &other in &near {
            if kind.is_curve() || surfaces.kinds[other].is_curve() {
                self.find_between(surfaces, [body, other], surroundings, reach);
            }
        }
        self.near = near;
        if kind.is_curve() {
            self.find_walls(surfaces, body, surroundings, reach);
        }
    }

    fn find_between(
        &mut self,
        surfaces: &Surfaces,
        [body, other]: [usize; 2],
        Surroundings { domain, around, .. }: Surroundings<'_>,
        reach: f64,
    ) {
        let [from, to] = [body, other].map(|index| &surfaces.boundaries[index]);
        let [Some(frame), Some(large)] = [from, to].map(Boundary::frame) else { return };
        if surfaces.kinds[other].advance().is_some() {
            let periods = [domain.periods[0], None].into();
            for (shift, sign) in surfaces.images_across(body, other, domain.periods) {
                if frame.moved(shift).is_near(&large, periods, reach) {
                    self.add_contacts(surfaces, [body, other], (shift, periods, sign), reach);
                }
            }
            return;
        }
        let periods = if other == body { Periods::default() } else { domain.periods };
        let mut outer = std::iter::successors(around.get(body).copied().flatten(), |&outer| around[outer]);
        let sign = if outer.any(|outer| outer == other) { -1.0 } else { 1.0 };
        for shift in shifts(domain.periods, other == body).into_iter().flatten().flat_map(|shift| [shift, -shift]) {
            if !frame.moved(shift).is_near(&large, periods, reach) {
                continue;
            }
            self.add_contacts(surfaces, [body, other], (shift, periods, sign), reach);
            if shift == Vec2::ZERO {
                // There is one such place.
                return;
            }
        }
    }

    /// Adds the contacts of the corners of a body, displaced, with the sides of another one.
    fn add_contacts(
        &mut self,
        surfaces: &Surfaces,
        [body, other]: [usize; 2],
        (shift, periods, sign): (Vec2, Periods, f64),
        reach: f64,
    ) {
        let to = &surfaces.boundaries[other];
        for (place, corner) in surfaces.boundaries[body].corners().zip(surfaces.firsts[body]..) {
            let Some(found) = to.nearest_within(place + shift, periods, reach) else { continue };
            let start = surfaces.firsts[other] + found.side;
            let ends = Some([start, surfaces.corners[start].next]);
            self.contacts.push(contact(corner, ends, &found, to.sides()[found.side], sign));
        }
    }

    fn find_walls(
        &mut self,
        surfaces: &Surfaces,
        body: usize,
        Surroundings { domain, walls, .. }: Surroundings<'_>,
        reach: f64,
    ) {
        for (place, corner) in surfaces.boundaries[body].corners().zip(surfaces.firsts[body]..) {
            if let Some([below, above]) = domain.walls {
                for (gap, normal) in [(place.y - below, Vec2::Y), (above - place.y, -Vec2::Y)] {
                    if gap < reach {
                        self.contacts.push(Contact { corner, ends: None, part: 0.0, normal, gap });
                    }
                }
            }
            if let Some(walls) = walls
                && let Some(found) = walls.nearest_within(place, domain.periods, reach)
            {
                self.contacts.push(contact(corner, None, &found, walls.sides()[found.side], 1.0));
            }
        }
    }
}

impl Surfaces {
    /// Returns the sides of all bodies that have corners: the corners at their ends, and where these are (length).
    fn sides(&self) -> impl Iterator<Item = ((usize, usize), [Vec2; 2])> {
        let corners = self.corners.iter().enumerate().map(|(start, corner)| (start, corner.next));
        corners.zip(self.boundaries.iter().flat_map(|boundary| boundary.sides().iter().copied()))
    }
}

impl Contact {
    /// Returns the part of its gap that a contact counts for: gaps between two surfaces are measured both ways.
    pub(super) fn share(&self) -> f64 {
        if self.ends.is_some() { 0.5 } else { 1.0 }
    }
}

/// Half of the circle that the middle of a side goes through about the x axis (length), negative below the axis.
fn half_circle([start, end]: [Vec2; 2]) -> f64 {
    0.5 * PI * (start.y + end.y)
}

/// Returns a corner at a place found on a side; `sign` is -1 for what lies inside.
fn contact(corner: usize, ends: Option<[usize; 2]>, found: &Nearest, [from, to]: [Vec2; 2], sign: f64) -> Contact {
    let distance = found.distance();
    let outwards = Vec2::new(to.y - from.y, from.x - to.x).try_normalize().unwrap_or_default();
    let normal = if distance == 0.0 { outwards } else { found.away / distance };
    Contact { corner, ends, part: found.part, normal: sign * normal, gap: sign * distance }
}

#[cfg(test)]
mod tests;

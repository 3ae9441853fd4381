//! The flow at the markers of one body, and the forces of the bodies inside it.

use motile_base::{
    ImposedFlow, Vec2,
    boxes::{Periods, nearest_image},
};

use super::{MarkerGroup, MarkerKind, Markers};
use crate::gap::Boundary;

/// The flow at the markers of one body: lists of as many entries as it has markers.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct BodyFlow<'a> {
    /// Positions (length), not wrapped into the box.
    pub positions: &'a [Vec2],
    /// Forces on the fluid (force, not force per length).
    pub forces: &'a [Vec2],
    /// Velocities of the fluid (length per time).
    pub velocities: &'a [Vec2],
    /// The imposed flow, which is part of all velocities.
    pub imposed: ImposedFlow,
    pub(crate) all: Everything<'a>,
    pub(crate) index: usize,
}

/// All markers of a scene, the innermost interface around each body, the exterior viscosity (stress times time) and the
/// periods (length).
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Everything<'a> {
    pub(crate) markers: &'a Markers,
    pub(crate) enclosing: &'a [Option<usize>],
    pub(crate) viscosity: f64,
    pub(crate) periods: Periods,
}

/// A body inside another one: its markers, lists of one length, and what they do to the fluid.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Enclosed {
    /// Positions (length), of the image that lies inside.
    pub positions: Vec<Vec2>,
    /// Forces on the fluid (force, not force per length).
    pub forces: Vec<Vec2>,
    /// Velocities of the fluid (length per time).
    pub velocities: Vec<Vec2>,
    /// Viscosities of the fluid inside the body and around it (stress times time).
    pub viscosities: [f64; 2],
    /// Force dipole (force times length) by which the flow keeps a rigid body rigid
    /// ([`Markers::rigid_dipole`]); `None` for other bodies.
    pub rigid_dipole: Option<[[f64; 2]; 2]>,
}

impl BodyFlow<'_> {
    /// Returns the bodies inside this one, at any depth: those that lie in its interface, those that fill it
    /// ([`crate::InteriorBody`]), and of bodies without a surface the markers that lie in it.
    #[must_use]
    pub fn enclosed(&self) -> Vec<Enclosed> {
        let Everything { markers, enclosing, viscosity, periods } = self.all;
        let centre = mean(self.positions);
        let groups = markers.groups();
        let inside = |body: usize| {
            let mut around = std::iter::successors(enclosing[body], |&outer| enclosing[outer]).take(groups.len());
            around.any(|outer| outer == self.index)
        };
        let image = |place: Vec2| centre + nearest_image(place - centre, periods);
        let of_group = |(body, group): (usize, &MarkerGroup)| {
            let range = group.range.clone();
            let [places, forces] = [markers.positions(), markers.forces()].map(|list| &list[range.clone()]);
            let (chosen, positions): (Vec<usize>, Vec<Vec2>) = if inside(body) {
                let middle = mean(places);
                (range.clone().collect(), places.iter().map(|place| *place + image(middle) - middle).collect())
            } else if group.surfaces.is_empty() && forces.iter().any(|force| *force != Vec2::ZERO) {
                let mut host = Boundary::default();
                host.push_loop(self.positions);
                host.sort();
                let images = range.zip(places.iter().map(|place| image(*place)));
                images.filter(|(_, place)| host.distance(*place, [None; 2]) < 0.0).unzip()
            } else {
                Default::default()
            };
            let of = |list: &[Vec2]| chosen.iter().map(|&marker| list[marker]).collect();
            let (forces, velocities) = (of(markers.forces()), of(markers.velocities()));
            let rigid_dipole = (group.kind == MarkerKind::Rigid).then(|| markers.rigid_dipole(body));
            let viscosities = group.viscosities(viscosity);
            (!chosen.is_empty()).then_some(Enclosed { positions, forces, velocities, viscosities, rigid_dipole })
        };
        groups.iter().enumerate().filter(|(body, _)| *body != self.index).filter_map(of_group).collect()
    }
}

fn mean(points: &[Vec2]) -> Vec2 {
    points.iter().sum::<Vec2>() / points.len().max(1) as f64
}

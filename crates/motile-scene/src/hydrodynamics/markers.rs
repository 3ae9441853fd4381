//! The markers of all bodies of a scene in flat arrays.

use std::ops::Range;

use crate::gap::SurfaceCurve;
use motile_base::{InputError, Vec2, internal::all_finite, positive, within};

/// Kind of a group of markers, which decides how the flow treats it.
#[derive(Debug, Clone, Copy, PartialEq)]
#[non_exhaustive]
pub enum MarkerKind {
    /// A closed fluid interface: markers in counter-clockwise order at equal spacing along the curve (to a few
    /// percent), the last one next to the first.
    Interface {
        /// Viscosity of the fluid inside (stress times time); `None` if it is the viscosity of the fluid outside.
        viscosity_inside: Option<f64>,
    },
    /// A closed curve whose markers are not equally spaced.
    UnevenInterface {
        /// Viscosity of the fluid inside (stress times time); `None` if it is the viscosity of the fluid outside.
        viscosity_inside: Option<f64>,
    },
    /// A fluid interface that is periodic along x, the inside to its left: markers at equally spaced parameters over
    /// one period.
    OpenInterface {
        /// Viscosity of the fluid inside (stress times time); `None` if it is the viscosity of the fluid outside.
        viscosity_inside: Option<f64>,
        /// Advance along x from the first marker to its next image (length): plus or minus the period of the region.
        advance: f64,
    },
    /// The closed outline of a rigid body that moves freely, markers in counter-clockwise order.
    Rigid,
    /// Points in no particular order, such as the points of an elastic solid.
    Points,
}

impl MarkerKind {
    /// Returns true for the markers of a curve, closed or periodic along x.
    #[must_use]
    pub fn is_curve(&self) -> bool {
        *self != Self::Points
    }

    /// Returns the surface of a body of this many markers, unless you say otherwise.
    pub(crate) fn surface(&self, count: usize) -> Vec<SurfaceCurve> {
        let periods = self.advance().map_or(0, |advance| if advance > 0.0 { 1 } else { -1 });
        if self.is_curve() { vec![SurfaceCurve::through(0..count, periods)] } else { Vec::new() }
    }

    /// Returns the advance along x over one period (length) of an interface that is periodic along x: positive where
    /// its inside is above. `None` for what is closed.
    #[must_use]
    pub fn advance(&self) -> Option<f64> {
        if let Self::OpenInterface { advance, .. } = self { Some(*advance) } else { None }
    }

    /// Returns the viscosity of the fluid inside (stress times time), where it is another one than outside.
    #[must_use]
    pub fn viscosity_inside(&self) -> Option<f64> {
        match self {
            Self::Interface { viscosity_inside }
            | Self::UnevenInterface { viscosity_inside }
            | Self::OpenInterface { viscosity_inside, .. } => *viscosity_inside,
            Self::Rigid | Self::Points => None,
        }
    }

    /// Returns true for the markers of a curve with fluid inside, in which other bodies may lie.
    #[must_use]
    pub fn holds_fluid(&self) -> bool {
        matches!(self, Self::Interface { .. } | Self::UnevenInterface { .. } | Self::OpenInterface { .. })
    }
}

/// The markers of one body within [`Markers`].
#[derive(Debug, Clone, PartialEq)]
pub struct MarkerGroup {
    /// Entries of the body in the flat arrays.
    pub range: Range<usize>,
    /// Kind of the markers.
    pub kind: MarkerKind,
    /// The surface of the body.
    pub surfaces: Vec<SurfaceCurve>,
    /// Viscosity of the fluid around them (stress times time) where they lie inside an interface; `None` if it is the
    /// viscosity of the exterior fluid.
    pub viscosity_outside: Option<f64>,
    /// Group of the interface that they fill, of points that do, if nothing else lies inside.
    pub host: Option<usize>,
}

impl MarkerGroup {
    /// Returns the curves of the surface that can carry layers: the curves that markers trace completely.
    pub fn layers(&self) -> impl Iterator<Item = &SurfaceCurve> {
        self.surfaces.iter().filter(|curve| curve.markers().count() == curve.points.len())
    }

    /// Returns the viscosities of the fluid inside and right outside of an interface (stress times time), if the
    /// viscosity of the exterior fluid is `exterior`.
    #[must_use]
    pub fn viscosities(&self, exterior: f64) -> [f64; 2] {
        let outside = self.viscosity_outside.unwrap_or(exterior);
        [self.kind.viscosity_inside().unwrap_or(outside), outside]
    }
}

/// Positions, forces and velocities of the markers of all bodies, body after body: lists as long as all groups
/// together.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Markers {
    /// Positions (length), not wrapped into the box.
    pub(crate) positions: Vec<Vec2>,
    /// Forces on the fluid (force, not force per length).
    pub(crate) forces: Vec<Vec2>,
    /// Velocities (length per time).
    pub(crate) velocities: Vec<Vec2>,
    pub(crate) groups: Vec<MarkerGroup>,
    /// See [`Markers::rigid_dipole`].
    rigid_dipoles: Vec<[[f64; 2]; 2]>,
}

impl Markers {
    /// Creates no markers.
    #[must_use]
    pub fn new() -> Self {
        Self::default()
    }

    /// Adds a group of `count` markers, with positions, forces and velocities zero.
    pub fn push_group(&mut self, count: usize, kind: MarkerKind) {
        self.push_body(count, kind, kind.surface(count));
    }

    /// Adds the markers of a body like [`Markers::push_group`], with its surface ([`crate::Body::surfaces`]).
    pub fn push_body(&mut self, count: usize, kind: MarkerKind, surfaces: Vec<SurfaceCurve>) {
        let start = self.positions.len();
        self.groups.push(MarkerGroup {
            range: start..start + count,
            kind,
            surfaces,
            viscosity_outside: None,
            host: None,
        });
        self.rigid_dipoles.push([[0.0; 2]; 2]);
        self.resize(start + count);
    }

    /// Says what fluid a group lies in: one of that viscosity (stress times time), or, `None`, the exterior fluid. A
    /// [`Scene`](crate::Scene) finds it out by itself.
    ///
    /// # Errors
    /// Returns an error for a viscosity that is not positive and finite, no group of that number.
    pub fn set_viscosity_outside(&mut self, group: usize, viscosity: Option<f64>) -> Result<(), InputError> {
        if let Some(viscosity) = viscosity {
            positive("the viscosity around a group of markers", viscosity)?;
        }
        let most = self.groups.len().saturating_sub(1);
        within("the number of a group of markers", group as f64, 0.0, most as f64)?;
        self.groups[group].viscosity_outside = viscosity;
        Ok(())
    }

    /// Returns the force dipole (force times length) by which the flow keeps the body of a group rigid, as of the last
    /// evaluation. It is zero if the forces at its markers are all that it puts on the fluid, and if there is no such
    /// group.
    #[must_use]
    pub fn rigid_dipole(&self, group: usize) -> [[f64; 2]; 2] {
        self.rigid_dipoles.get(group).copied().unwrap_or_default()
    }

    /// Sets [`Markers::rigid_dipole`]; a flow that constrains rigid bodies does so in
    /// [`Hydrodynamics::velocities`](crate::Hydrodynamics::velocities).
    ///
    /// # Errors
    /// Returns an error for a value that is not finite, no group of that number.
    pub fn set_rigid_dipole(&mut self, group: usize, dipole: [[f64; 2]; 2]) -> Result<(), InputError> {
        all_finite("the force dipole of a rigid body", dipole.as_flattened())?;
        let most = self.groups.len().saturating_sub(1);
        within("the number of a group of markers", group as f64, 0.0, most as f64)?;
        self.rigid_dipoles[group] = dipole;
        Ok(())
    }

    /// Sets viscosities outside ([`Markers::set_viscosity_outside`]) and hosts of all groups in their order.
    pub(crate) fn set_surroundings(&mut self, surroundings: impl Iterator<Item = (Option<f64>, Option<usize>)>) {
        for (group, (viscosity, host)) in self.groups.iter_mut().zip(surroundings) {
            (group.viscosity_outside, group.host) = (viscosity, host);
        }
    }

    /// Removes all groups, keeping the memory.
    pub fn clear(&mut self) {
        self.groups.clear();
        self.rigid_dipoles.clear();
        self.resize(0);
    }

    fn resize(&mut self, count: usize) {
        for array in [&mut self.positions, &mut self.forces, &mut self.velocities] {
            array.resize(count, Vec2::ZERO);
        }
    }

    /// Returns the positions (length), not wrapped into the box.
    #[must_use]
    pub fn positions(&self) -> &[Vec2] {
        &self.positions
    }

    /// Returns the positions (length), to be changed.
    pub fn positions_mut(&mut self) -> &mut [Vec2] {
        &mut self.positions
    }

    /// Returns the forces on the fluid (force, not force per length).
    #[must_use]
    pub fn forces(&self) -> &[Vec2] {
        &self.forces
    }

    /// Returns the forces on the fluid (force), to be changed.
    pub fn forces_mut(&mut self) -> &mut [Vec2] {
        &mut self.forces
    }

    /// Returns the velocities (length per time).
    #[must_use]
    pub fn velocities(&self) -> &[Vec2] {
        &self.velocities
    }

    /// Returns the velocities (length per time), to be changed.
    pub fn velocities_mut(&mut self) -> &mut [Vec2] {
        &mut self.velocities
    }

    /// Returns the positions, forces and velocities to be changed, at once.
    pub fn lists_mut(&mut self) -> [&mut [Vec2]; 3] {
        [&mut self.positions, &mut self.forces, &mut self.velocities]
    }

    /// Returns the groups, the positions (length), and the velocities (length per time) to be changed, at once.
    pub fn groups_and_lists(&mut self) -> (&[MarkerGroup], &[Vec2], &mut [Vec2]) {
        (&self.groups, &self.positions, &mut self.velocities)
    }

    /// Returns the groups, one per body.
    #[must_use]
    pub fn groups(&self) -> &[MarkerGroup] {
        &self.groups
    }

    /// Returns the number of markers.
    #[must_use]
    pub fn len(&self) -> usize {
        self.positions.len()
    }

    /// Returns true without markers.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.positions.is_empty()
    }
}

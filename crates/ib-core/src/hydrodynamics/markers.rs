//! The markers of all bodies of a scene in flat arrays.

use std::ops::Range;

use stokes_layers::Vec2;

/// What a group of markers is, as far as the flow is concerned.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum MarkerKind {
    /// A closed fluid interface: markers in counter-clockwise order at equal spacing along the curve (to a few per
    /// cent), the last one next to the first.
    Interface {
        /// Viscosity of the fluid inside (stress times time); `None` where it is that of the exterior fluid.
        viscosity_inside: Option<f64>,
    },
    /// A closed curve whose markers are not equally spaced.
    UnevenInterface {
        /// Viscosity of the fluid inside (stress times time); `None` where it is that of the exterior fluid.
        viscosity_inside: Option<f64>,
    },
    /// Points in no particular order, such as those of an elastic solid.
    Points,
}

impl MarkerKind {
    /// Whether the markers are those of a closed curve.
    #[must_use]
    pub fn is_interface(&self) -> bool {
        *self != Self::Points
    }

    /// Viscosity of the fluid inside (stress times time), where it is another one than outside.
    #[must_use]
    pub fn viscosity_inside(&self) -> Option<f64> {
        match self {
            Self::Interface { viscosity_inside } | Self::UnevenInterface { viscosity_inside } => *viscosity_inside,
            Self::Points => None,
        }
    }
}

/// The markers of one body within [`Markers`].
#[derive(Debug, Clone, PartialEq)]
pub struct MarkerGroup {
    /// Which entries of the flat arrays.
    pub range: Range<usize>,
    /// What they are.
    pub kind: MarkerKind,
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
    groups: Vec<MarkerGroup>,
}

impl Markers {
    /// No markers.
    #[must_use]
    pub fn new() -> Self {
        Self::default()
    }

    /// Adds a group of `count` markers, with positions, forces and velocities zero.
    pub fn push_group(&mut self, count: usize, kind: MarkerKind) {
        let start = self.positions.len();
        self.groups.push(MarkerGroup { range: start..start + count, kind });
        self.resize(start + count);
    }

    /// Removes all groups, keeping the memory.
    pub fn clear(&mut self) {
        self.groups.clear();
        self.resize(0);
    }

    fn resize(&mut self, count: usize) {
        for array in [&mut self.positions, &mut self.forces, &mut self.velocities] {
            array.resize(count, Vec2::ZERO);
        }
    }

    /// Positions (length), not wrapped into the box.
    #[must_use]
    pub fn positions(&self) -> &[Vec2] {
        &self.positions
    }

    /// The positions to be changed.
    pub fn positions_mut(&mut self) -> &mut [Vec2] {
        &mut self.positions
    }

    /// Forces on the fluid (force, not force per length).
    #[must_use]
    pub fn forces(&self) -> &[Vec2] {
        &self.forces
    }

    /// The forces to be changed.
    pub fn forces_mut(&mut self) -> &mut [Vec2] {
        &mut self.forces
    }

    /// Velocities (length per time).
    #[must_use]
    pub fn velocities(&self) -> &[Vec2] {
        &self.velocities
    }

    /// The velocities to be changed.
    pub fn velocities_mut(&mut self) -> &mut [Vec2] {
        &mut self.velocities
    }

    /// Positions, forces and velocities to be changed, at once.
    pub fn lists_mut(&mut self) -> [&mut [Vec2]; 3] {
        [&mut self.positions, &mut self.forces, &mut self.velocities]
    }

    /// The groups, one a body.
    #[must_use]
    pub fn groups(&self) -> &[MarkerGroup] {
        &self.groups
    }

    /// Number of markers.
    #[must_use]
    pub fn len(&self) -> usize {
        self.positions.len()
    }

    /// Whether there are none.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.positions.is_empty()
    }
}

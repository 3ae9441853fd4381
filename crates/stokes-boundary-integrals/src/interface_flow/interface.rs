//! Interfaces: outline, forces and the fluid or rigid body inside.

use motile_base::Vec2;

/// Interior of an interface.
#[derive(Debug, Clone, Copy, PartialEq)]
#[non_exhaustive]
pub enum Inside {
    /// Fluid.
    Fluid {
        /// Viscosity of the fluid (stress times time).
        viscosity: f64,
    },
    /// A rigid body that moves freely: the forces on its surface are all that act on it.
    Rigid,
}

/// An interface given by points of equally spaced parameters: point k of n belongs to the parameter 2 pi k/n.
#[derive(Debug, Clone, Copy)]
pub struct Interface<'a> {
    /// Points, counter-clockwise or with the inside on the left, at least as many as the settings have nodes (length).
    pub positions: &'a [Vec2],
    /// Advance of the interface in a turn of the parameter (length): zero for a closed one, plus or minus the period of
    /// the region along x for an open one.
    pub period: Vec2,
    /// Force on the fluid at each point (force): the force per length times the arc length that belongs to the point.
    pub forces: &'a [Vec2],
    /// Fluid or rigid body inside.
    pub inside: Inside,
    /// Viscosity of the fluid right outside (stress times time); it differs from the viscosity of the exterior fluid if
    /// the interface lies inside another one.
    pub viscosity_outside: f64,
}

impl<'a> Interface<'a> {
    /// Creates a closed interface between fluids of these viscosities inside and outside (stress times time).
    #[must_use]
    pub fn closed(positions: &'a [Vec2], forces: &'a [Vec2], [inside, outside]: [f64; 2]) -> Self {
        let inside = Inside::Fluid { viscosity: inside };
        Self { positions, period: Vec2::ZERO, forces, inside, viscosity_outside: outside }
    }

    /// Creates the surface of a rigid body in fluid of that viscosity (stress times time).
    #[must_use]
    pub fn rigid(positions: &'a [Vec2], forces: &'a [Vec2], viscosity_outside: f64) -> Self {
        Self { positions, period: Vec2::ZERO, forces, inside: Inside::Rigid, viscosity_outside }
    }
}

//! Shapes of solids in pictures.

use motile::base::Vec2;

/// Quantity shown by the colour of solids.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
#[non_exhaustive]
pub enum SolidColour {
    /// No quantity: all solids are grey.
    #[default]
    Plain,
    /// Displacement of each triangle from its reference position (length).
    Displacement,
    /// Deviator of the Cauchy stress, `sqrt(((s_xx - s_yy)/2)^2 + s_xy^2)` (force per length).
    Stress,
    /// Deviator of the stress that is not elastic: of Maxwell elements and active springs (force per length).
    InternalStress,
}

/// Shape of a solid, with values for colours.
#[derive(Debug, Clone, Default, PartialEq)]
#[non_exhaustive]
pub struct SolidShape {
    /// Closed outlines of the filled area (length), one within another for a hole.
    pub area: Vec<Vec<Vec2>>,
    /// Lines of the surface (length).
    pub edges: Vec<Vec<Vec2>>,
    /// Corners of the triangles (length), for colours.
    pub triangles: Vec<[Vec2; 3]>,
    /// Displacement of each triangle from its reference position (length).
    pub displacement: Vec<f64>,
    /// Deviator of the Cauchy stress in each triangle (force per length); not a number if one is inverted.
    pub stress: Vec<f64>,
    /// Deviator of the stress in each triangle that is not elastic (force per length); empty if there is none.
    pub internal_stress: Vec<f64>,
    /// Ends of the active springs that are on (length).
    pub bonds: Vec<Vec<Vec2>>,
    /// True for a membrane with fluid inside, whose area is not filled.
    pub holds_fluid: bool,
}

impl SolidShape {
    /// Returns the values that a colour shows, one for each triangle.
    pub(crate) fn values(&self, colour: SolidColour) -> &[f64] {
        match colour {
            SolidColour::Plain => &[],
            SolidColour::Displacement => &self.displacement,
            SolidColour::Stress => &self.stress,
            SolidColour::InternalStress => &self.internal_stress,
        }
    }
}

//! Forces on closed rigid walls.

use motile_base::Vec2;

use crate::curve::Curve;

/// Load of the fluid on a closed rigid wall, an obstacle, per unit of depth.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
#[doc(alias("drag", "lift", "torque"))]
pub struct ObstacleLoad {
    /// Centroid of its area (length).
    pub centroid: Vec2,
    /// Force of the fluid on it (force).
    pub force: Vec2,
    /// Torque of the fluid on it about its centroid (force times length), counter-clockwise.
    pub torque: f64,
    /// First moment about the height of its centroid of the forces along x on it (force times length).
    pub shear: f64,
}

impl ObstacleLoad {
    /// Returns the load of forces on the fluid (force), x at the nodes of a closed curve and then y.
    pub(super) fn of(curve: &Curve, forces: &[f64]) -> Self {
        let nodes = &curve.nodes;
        // Area, and its first moments, by Green's theorem.
        let (mut area, mut moment) = (0.0, Vec2::ZERO);
        for (z, slope) in nodes.position.iter().zip(&nodes.tangent) {
            area += 0.5 * (z.re * slope.im - z.im * slope.re);
            moment += 0.5 * Vec2::new(z.re * z.re * slope.im, -z.im * z.im * slope.re);
        }
        let centroid = moment / area;
        let (x, y) = forces.split_at(forces.len() / 2);
        let centre = Vec2::new(curve.centre.re, curve.centre.im);
        let mut load = Self { centroid: centre + centroid, ..Self::default() };
        for ((x, y), z) in x.iter().zip(y).zip(&nodes.position) {
            let (force, arm) = (-Vec2::new(*x, *y), Vec2::new(z.re, z.im) - centroid);
            load.force += force;
            load.torque += arm.perp_dot(force);
            load.shear += arm.y * force.x;
        }
        load
    }
}

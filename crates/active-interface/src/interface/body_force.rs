//! A force on the fluid inside an interface, such as its weight.

use motile_base::Vec2;
use motile_scene::{Domain, FluidView};

use super::{geometry::outward, shape::Shape};
use crate::InterfaceError;

/// Force on the fluid inside a closed interface, uniform over its area (in three dimensions over its volume).
///
/// The fluid inside then obeys `eta lap v - grad p + b = 0`. With the pressure p - b.x in place of p, no force is left
/// inside, and the interface pushes the fluid with (b.x) n, n its outward normal. A constant in b.x changes the
/// pressure inside alone, so that x is measured from the middle of the interface, where no digits are lost.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub(crate) struct BodyForce {
    /// Force per area (per volume in three dimensions), the same whatever the size.
    pub(crate) density: Vec2,
    /// Force in all (force), whose density follows from the present area.
    pub(crate) total: Vec2,
}

impl BodyForce {
    /// Adds the forces (b.x) n of the pieces around the markers to the forces on the fluid (force), on the halves of
    /// rings for a body of revolution.
    pub(super) fn add_forces(&self, shape: &Shape, smooth: bool, forces: &mut [Vec2]) {
        let Shape { markers, geometry, axisymmetric, .. } = shape;
        let (count, origin) = (markers.len(), markers[0]);
        // The length around a marker times the outward normal: of the curve through the markers, or of the polygon,
        // whose normals give its area exactly.
        let piece = |k: usize| {
            if smooth {
                geometry.weights[k] * outward(geometry.tangents[k])
            } else {
                let [before, after] = [(k + count - 1) % count, if k + 1 == count { 0 } else { k + 1 }];
                outward(0.5 * (markers[after] - markers[before]))
            }
        };
        let ring = |k: usize| if *axisymmetric { geometry.rings.circles[k] } else { 1.0 };
        let mean = markers.iter().map(|x| *x - origin).sum::<Vec2>() / count as f64;
        let mut density = self.density;
        if self.total != Vec2::ZERO {
            let size = if *axisymmetric {
                geometry.volume(markers)
            } else {
                (0..count).map(|k| 0.5 * (markers[k] - origin - mean).dot(piece(k))).sum()
            };
            density += self.total / size;
        }
        for (k, force) in forces.iter_mut().enumerate() {
            *force += ring(k) * density.dot(markers[k] - origin - mean) * piece(k);
        }
    }

    /// Refuses a force per area in the plane.
    pub(super) fn check(&self, shape: &Shape, view: &FluidView) -> Result<(), InterfaceError> {
        let Domain { periods, walls, .. } = view.domain;
        let bounded = shape.axisymmetric || walls.is_some() || periods.iter().any(Option::is_some);
        if bounded || self.density == Vec2::ZERO { Ok(()) } else { Err(InterfaceError::pushed_plane()) }
    }

    /// Returns the rate at which the flow of this force deforms a round interface (1/time), as a bound.
    pub(super) fn rate(&self, shape: &Shape, viscosity: f64) -> f64 {
        let radius = shape.geometry.perimeter / std::f64::consts::TAU;
        let size = radius * radius * if shape.axisymmetric { 4.0 * radius } else { 3.0 };
        (self.density.length() + self.total.length() / size) * radius / viscosity
    }
}

#[cfg(test)]
mod tests;

//! The motion of a rigid body: velocity and angular velocity.

use motile_base::Vec2;
use num_complex::Complex64;

use crate::curve::Curve;

/// Motion of a rigid body, `v(x) = velocity + spin x (x - centre)`.
#[derive(Debug, Clone, Copy, PartialEq)]
#[non_exhaustive]
pub struct RigidMotion {
    /// Centroid of the outline as a line (length).
    pub centre: Vec2,
    /// Velocity of the centroid (length per time).
    pub velocity: Vec2,
    /// Angular velocity, counter-clockwise (1/time).
    pub spin: f64,
}

impl RigidMotion {
    /// Creates the rigid motion nearest to velocities at the nodes of a curve, x then y, in the mean over its arc
    /// length.
    pub(crate) fn of(curve: &Curve, values: &[f64]) -> Self {
        let (x, y) = values.split_at(curve.len());
        let nodes = || curve.nodes.tangent.iter().map(|tangent| tangent.norm()).zip(&curve.nodes.position);
        let values = || x.iter().zip(y).map(|(x, y)| Complex64::new(*x, *y));
        let length: f64 = nodes().map(|(weight, _)| weight).sum();
        let centre = nodes().map(|(weight, z)| weight * z).sum::<Complex64>() / length;
        let velocity = nodes().zip(values()).map(|((weight, _), v)| weight * v).sum::<Complex64>() / length;
        let [turned, inertia] = nodes().zip(values()).fold([0.0; 2], |[turned, inertia], ((weight, z), v)| {
            let arm = z - centre;
            [turned + weight * (arm.conj() * v).im, inertia + weight * arm.norm_sqr()]
        });
        let vector = |z: Complex64| Vec2::new(z.re, z.im);
        Self { centre: vector(centre + curve.centre), velocity: vector(velocity), spin: turned / inertia }
    }

    /// Adds a multiple of the motion to velocities at the nodes of its curve, x then y.
    pub(crate) fn add(&self, curve: &Curve, factor: f64, out: &mut [f64]) {
        let (x, y) = out.split_at_mut(curve.len());
        for ((x, y), z) in x.iter_mut().zip(y).zip(&curve.nodes.position) {
            let velocity = self.at(Vec2::new(z.re + curve.centre.re, z.im + curve.centre.im));
            *x += factor * velocity.x;
            *y += factor * velocity.y;
        }
    }

    /// Returns the velocity (length per time) of the body at `place` (length).
    #[must_use]
    pub fn at(&self, place: Vec2) -> Vec2 {
        self.velocity + self.spin * (place - self.centre).perp()
    }
}

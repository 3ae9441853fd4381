//! Points close to droplets of another viscosity.

use stokes_layers::dense::NodeCurve;

use super::Contrast;
use crate::Vec2;

/// A point within the reach of the kernel from a droplet's interface.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Nearby {
    /// The nearest point of the interface (length), in the frame of the point.
    foot: Vec2,
    /// Between which nodes that lies, and how far along.
    nodes: [usize; 2],
    fraction: f64,
    /// From the one to the other (length).
    along: Vec2,
    /// Unit vector away from the interface on the point's side.
    away: Vec2,
    distance: f64,
    /// Viscosity inside less that outside (stress times time).
    contrast: f64,
}

impl Nearby {
    /// Viscosity inside the interface less that outside (stress times time).
    pub(crate) fn contrast(&self) -> f64 {
        self.contrast
    }

    /// The point at the distance `reach` (length) from the same place on the same side.
    pub(crate) fn retreat(&self, reach: f64) -> Vec2 {
        self.foot + reach * self.away
    }

    /// Distance from the interface (length).
    pub(crate) fn distance(&self) -> f64 {
        self.distance
    }

    /// Velocity and its gradient from the velocities `on_nodes` and the flow `at` places that are `reach` (length) and
    /// more away from the interface. Nearer than that the velocity is a parabola along the normal, through a value a
    /// `step` farther away. The gradient, which needs more room, is taken from twice the reach: across the interface by
    /// the same parabola, along it on a straight line to that on the interface.
    pub(crate) fn flow(
        &self,
        point: Vec2,
        [reach, step]: [f64; 2],
        on_nodes: &[Vec2],
        at: impl Fn(Vec2) -> (Vec2, [[f64; 2]; 2]),
    ) -> (Vec2, [[f64; 2]; 2]) {
        if self.distance >= 2.0 * reach {
            return at(point);
        }
        let [start, end] = self.nodes.map(|node| on_nodes[node]);
        let surface = start.lerp(end, self.fraction);
        let (near, beyond) = (at(self.retreat(reach)).0, at(self.retreat(reach + step)).0);
        let (rise, slope) = ((near - surface) / reach, (beyond - near) / step);
        let bend = (slope - rise) / (reach + step);
        let mut gradient = at(self.retreat(2.0 * reach)).1;
        let change = 2.0 * (self.distance - 2.0 * reach) * bend;
        // The interface's own direction, without what is not at right angles to `away`.
        let along = self.along - self.along.dot(self.away) * self.away;
        let length = along.length();
        let tangent = if length > 0.0 { along / length } else { along };
        let left = 1.0 - 0.5 * self.distance / reach;
        let stretching = (end - start) / self.along.length().max(f64::MIN_POSITIVE);
        for (row, (change, stretching)) in gradient.iter_mut().zip([(change.x, stretching.x), (change.y, stretching.y)])
        {
            let turned = left * (stretching - row[0] * tangent.x - row[1] * tangent.y);
            *row = [
                row[0] + change * self.away.x + turned * tangent.x,
                row[1] + change * self.away.y + turned * tangent.y,
            ];
        }
        let velocity = if self.distance >= reach {
            at(point).0
        } else {
            surface + self.distance * (rise + (self.distance - reach) * bend)
        };
        (velocity, gradient)
    }

    /// A value from those at the distances `reach` and `reach + step` (length), on a straight line.
    pub(crate) fn extrapolate(&self, [reach, step]: [f64; 2], near: f64, beyond: f64) -> f64 {
        near + (reach - self.distance) / step * (near - beyond)
    }
}

impl Contrast {
    /// The nearest interface closer to a point than `reach` (length).
    pub(crate) fn nearby(&self, point: Vec2, reach: f64) -> Option<Nearby> {
        let mut least = reach;
        let mut nearest = None;
        for curve in &self.curves {
            let relative = self.matrix.wrap(point - curve.centre);
            if relative.length() < curve.radius + least
                && let Some(foot) = curve.foot(relative, least)
            {
                least = foot.distance;
                nearest = Some((curve, relative, foot));
            }
        }
        let (curve, relative, foot) = nearest?;
        let next = (foot.node + 1) % curve.len();
        let normal = curve.normals[foot.node].lerp(curve.normals[next], foot.fraction).normalize();
        let side = if curve.contains(relative) { -1.0 } else { 1.0 };
        let place = curve.positions[foot.node].lerp(curve.positions[next], foot.fraction);
        Some(Nearby {
            foot: point - relative + place,
            nodes: [curve.first + foot.node, curve.first + next],
            fraction: foot.fraction,
            along: curve.positions[next] - curve.positions[foot.node],
            away: side * normal,
            distance: foot.distance,
            contrast: curve.contrast,
        })
    }

    /// The droplet that a point lies in.
    pub(crate) fn droplet_at(&self, point: Vec2) -> Option<usize> {
        self.curves.iter().position(|curve| {
            let relative = self.matrix.wrap(point - curve.centre);
            relative.length() <= curve.radius && curve.contains(relative)
        })
    }

    /// What the pressure inside each droplet exceeds that of the fluid of one viscosity times the ratio of viscosities
    /// by (force per length).
    ///
    /// With the equivalent forces q in place of the forces F, both per length, that fluid's pressure inside is the mean
    /// of both sides, `at_nodes`, less q_n/2, and outside more by it. The normal stresses balance, with
    /// `n . dv/dn = -tau . dv/ds` in an incompressible flow, so that on the interface
    ///
    /// `p_in = p_out - F_n - 2 (eta_in - eta_out) tau . dv/ds`.
    pub(crate) fn pressure_offsets(
        &self,
        at_nodes: &[f64],
        equivalent: &[Vec2],
        forces: &[Vec2],
        velocities: &[Vec2],
    ) -> Vec<f64> {
        let offset = |curve: &NodeCurve| {
            let count = curve.len();
            let mut sum = 0.0;
            for (k, (normal, weight)) in curve.normals.iter().zip(&curve.weights).enumerate() {
                let at = |shift: usize| curve.first + (k + shift) % count;
                let i = curve.first + k;
                let unit = normal / *weight;
                let tangent = Vec2::new(-unit.y, unit.x);
                // Times the arc length.
                let (q, f) = (equivalent[i].dot(unit), forces[i].dot(unit));
                let stretching = 0.5 * (velocities[at(1)] - velocities[at(count - 1)]).dot(tangent);
                let inside = 1.0 + curve.contrast / self.viscosity;
                let mean = weight * at_nodes[i];
                sum += mean + 0.5 * q - f - 2.0 * curve.contrast * stretching - inside * (mean - 0.5 * q);
            }
            sum / curve.perimeter()
        };
        self.curves.iter().map(offset).collect()
    }
}

#[cfg(test)]
mod tests;

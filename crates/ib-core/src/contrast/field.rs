//! The flow away from the markers of droplets of another viscosity.

use crate::{FlowError, FlowSample, Markers, Vec2};

use super::Contrast;
use super::droplet::Droplet;

/// Points closer to a droplet than so many spacings of its nodes get the double layer relative to the velocity at the
/// nearest node's foot, so that the kernel's peak does not show.
const CLOSE: f64 = 4.0;

/// Flow at a point and the viscosity there.
#[derive(Debug, Clone, Copy)]
pub(crate) struct LocalFlow {
    pub(crate) velocity: Vec2,
    pub(crate) pressure: f64,
    pub(crate) viscosity: f64,
}

impl Contrast {
    /// The flow at a point from `stress`, the one-viscosity velocity times viscosity there:
    /// `eta(x) v = stress - (D/4 pi) INT T v n ds`, with walls' part `index` and mean flow prepared.
    pub(super) fn flow_at(&mut self, point: Vec2, index: usize, stress: Vec2, mean: Vec2) -> LocalFlow {
        let (wall, pressure) = self.layer.wall_flow(index);
        let mut flow = LocalFlow { velocity: stress - mean - wall, pressure: -pressure, viscosity: self.viscosity };
        for k in 0..self.count {
            let droplet = &self.droplets[k];
            let relative = self.layer.images().wrap(point - droplet.centre);
            let reach = CLOSE * droplet.spacing();
            let mut reference = None;
            if relative.norm() < droplet.radius + reach {
                let inside = droplet.contains(relative);
                let foot = droplet.foot(relative);
                if inside {
                    flow.viscosity = droplet.viscosity;
                }
                if foot.distance < reach {
                    reference = Some((self.surface_velocity(droplet, foot.node, foot.fraction), inside));
                }
            }
            let (velocity, pressure) = self.layer.at(&self.droplets[k], point, reference);
            flow.velocity -= velocity;
            flow.pressure -= pressure;
        }
        flow.velocity /= flow.viscosity;
        flow
    }

    /// The velocity between node `k` of a droplet and the next one.
    fn surface_velocity(&self, droplet: &Droplet, k: usize, fraction: f64) -> Vec2 {
        let at = |k: usize| {
            let i = droplet.first + k % droplet.nodes();
            Vec2::new(self.velocities[i], self.velocities[self.nodes + i])
        };
        at(k).lerp(&at(k + 1), fraction)
    }

    /// The point to compute the flow at in place of one that is closer to an interface than `smeared`, within which the grid's
    /// flow is smeared: on the same side, at that distance; with the interface's velocity and the fraction of the way there.
    fn retreat(&self, point: Vec2, smeared: f64) -> Option<(Vec2, Vec2, f64)> {
        let mut nearest = None;
        let mut least = smeared;
        for droplet in &self.droplets[..self.count] {
            let relative = self.layer.images().wrap(point - droplet.centre);
            if relative.norm() < droplet.radius + least {
                let foot = droplet.foot(relative);
                if foot.distance < least {
                    least = foot.distance;
                    nearest = Some((droplet, relative, foot));
                }
            }
        }
        let (droplet, relative, foot) = nearest?;
        let next = (foot.node + 1) % droplet.nodes();
        let normal = droplet.normals[foot.node].lerp(&droplet.normals[next], foot.fraction).normalize();
        let side = if droplet.contains(relative) { -1.0 } else { 1.0 };
        let away = point + (smeared - foot.distance) * side * normal;
        Some((away, self.surface_velocity(droplet, foot.node, foot.fraction), foot.distance / smeared))
    }

    /// Replaces the flow of one viscosity in `out` by that with the contrast.
    ///
    /// `grid` gives the one-viscosity flow at any points. Within `smeared` of an interface the velocity is interpolated
    /// between the interface's and that at this distance on the same side; pressure and gradient are those there.
    pub(crate) fn sample(
        &mut self,
        markers: &Markers,
        smeared: f64,
        points: &[Vec2],
        mut grid: impl FnMut(&[Vec2], &mut [FlowSample]),
        out: &mut [FlowSample],
    ) -> Result<(), FlowError> {
        self.load(markers)?;
        self.velocities.resize(2 * self.nodes, 0.0);
        for droplet in &self.droplets[..self.count] {
            for (k, marker) in droplet.markers.clone().enumerate() {
                let i = droplet.first + k;
                let velocity = markers.velocities[marker];
                (self.velocities[i], self.velocities[self.nodes + i]) = (velocity.x, velocity.y);
            }
        }
        self.layer.place(&self.droplets[..self.count]);
        let mean = self.layer.begin_field(&self.droplets[..self.count], &self.velocities);
        let retreats: Vec<_> = points.iter().map(|&point| self.retreat(point, smeared)).collect();
        // The point itself and four around it, for the gradient of the double layer.
        let step = 0.25 * smeared;
        let steps = [(0.0, 0.0), (-step, 0.0), (step, 0.0), (0.0, -step), (0.0, step)].map(|(x, y)| Vec2::new(x, y));
        let places: Vec<Vec2> = points
            .iter()
            .zip(&retreats)
            .flat_map(|(&point, retreat)| {
                let place = retreat.map_or(point, |(away, ..)| away);
                steps.map(|step| place + step)
            })
            .collect();
        let mut flows = vec![FlowSample::default(); places.len()];
        grid(&places, &mut flows);
        self.layer.begin_walls(places.iter().copied());
        for (index, (out, retreat)) in out.iter_mut().zip(&retreats).enumerate() {
            let five: [LocalFlow; 5] = std::array::from_fn(|k| {
                let i = steps.len() * index + k;
                self.flow_at(places[i], i, self.viscosity * flows[i].velocity, mean)
            });
            let [dx, dy] = [1, 3].map(|k| (five[k + 1].velocity - five[k].velocity) / (2.0 * step));
            let pressure = flows[steps.len() * index].pressure + five[0].pressure;
            *out = FlowSample { velocity: five[0].velocity, pressure, gradient: [[dx.x, dy.x], [dx.y, dy.y]] };
            if let Some((_, surface, fraction)) = retreat {
                out.velocity = surface.lerp(&out.velocity, *fraction);
            }
        }
        Ok(())
    }
}

//! The stresslet of the flow around droplets of another viscosity.

use std::f64::consts::TAU;

use motile::active_interface::observables::InterfaceState;
use motile::active_interface::observables::{Convention, observe};
use motile::base::{ImposedFlow, Vec2};
use motile::scene::{Hydrodynamics, Markers};

use super::{Exact, layers};
use crate::validation::StudyError;

/// Distance over the size of the second.
fn relative([a, b]: [f64; 2], [c, d]: [f64; 2]) -> f64 {
    (a - c).hypot(b - d) / c.hypot(d)
}

impl Exact {
    /// The stresslet (S_xx, S_xy) of a droplet, from exact forces and velocities.
    #[must_use]
    pub fn stresslet(&self, index: usize) -> [f64; 2] {
        let (droplet, velocities) = (&self.droplets[index], &self.velocities[index]);
        let ([a, b], step) = (droplet.axes, TAU / velocities.len() as f64);
        let mut sum = [0.0; 2];
        for (k, v) in velocities.iter().enumerate() {
            let t = step * k as f64;
            let place = droplet.point(t) - Vec2::from(droplet.centre);
            let (force, normal) = (droplet.force(t), Vec2::new(b * t.cos(), a * t.sin()));
            let viscous = 1.0 - droplet.ratio;
            sum[0] += 0.5 * (force.x * place.x - force.y * place.y) + viscous * (v.x * normal.x - v.y * normal.y);
            sum[1] += 0.5 * (force.x * place.y + force.y * place.x) + viscous * (v.x * normal.y + v.y * normal.x);
        }
        sum.map(|sum| step * sum)
    }

    /// The errors of the stresslets relative to them, as observed from forces and velocities of layers with `nodes`
    /// nodes, droplet by droplet.
    ///
    /// # Errors
    /// As [`Exact::errors`].
    pub fn stresslet_errors(&self, nodes: usize) -> Result<Vec<f64>, StudyError> {
        let (mut flow, mut markers) = (layers(self.region, nodes)?, Markers::new());
        self.droplets.iter().for_each(|droplet| droplet.push_exact(4 * nodes, &mut markers));
        flow.velocities(&mut markers)?;
        let errors = markers.groups().iter().enumerate().map(|(index, group)| {
            let range = group.range.clone();
            let [markers, forces, velocities] =
                [markers.positions(), markers.forces(), markers.velocities()].map(|list| &list[range.clone()]);
            let viscosities = [self.droplets[index].ratio, 1.0];
            let (numbers, inside, enclosed) = (&[][..], None, Vec::new());
            let state = InterfaceState {
                markers,
                forces,
                velocities,
                imposed: ImposedFlow::NONE,
                numbers,
                viscosities,
                inside,
                enclosed,
                axisymmetric: false,
                on_grid: false,
            };
            let seen = observe(&state, Convention::FarField)?;
            Ok(relative(seen.stresslet_in_laboratory[0], self.stresslet(index)))
        });
        errors.collect()
    }
}

//! The stresslet of the flow around droplets of another viscosity.

use std::f64::consts::TAU;

use motile::active_interface::observables::InterfaceState;
use motile::active_interface::{Convention, observe};
use motile::ib_core::{Hydrodynamics, Markers, Vec2};

use super::{Exact, sharp};
use crate::validation::StudyError;

/// Errors of the stresslet of one droplet, relative to it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct StressletErrors {
    /// As observed.
    pub observed: f64,
    /// From forces and velocities alone, which is the difference of numbers larger by the ratio of viscosities.
    pub of_moments: f64,
}

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

    /// The errors of the stresslets with grid spacing `h` and markers h/2 apart, droplet by droplet.
    ///
    /// # Errors
    /// As [`Exact::errors`].
    pub fn stresslet_errors(&self, h: f64) -> Result<Vec<StressletErrors>, StudyError> {
        let (mut flow, mut markers) = (sharp(self.region, h)?, Markers::new());
        self.droplets.iter().try_for_each(|droplet| droplet.push_even(0.5 * h, &mut markers))?;
        flow.velocities(&mut markers)?;
        let errors = markers.groups().iter().enumerate().map(|(index, group)| {
            let (droplet, range, exact) = (&self.droplets[index], group.range.clone(), self.stresslet(index));
            let [positions, forces, velocities] =
                [markers.positions(), markers.forces(), markers.velocities()].map(|list| &list[range.clone()]);
            let state = InterfaceState {
                markers: positions,
                forces,
                velocities,
                numbers: &[],
                viscosities: [droplet.ratio, 1.0],
                inside: None,
                filled: None,
                stresslet: flow.stresslet(index)?,
            };
            let stresslet = |state: &InterfaceState<'_>| -> Result<[f64; 2], StudyError> {
                let seen = observe(state, Convention::FarField)?;
                let [[along, across], _] = seen.moments.stresslet();
                // Back from the droplet's axes.
                let (sin, cos) = (2.0 * seen.heading()).sin_cos();
                Ok([cos * along - sin * across, sin * along + cos * across])
            };
            let of_moments = relative(stresslet(&InterfaceState { stresslet: None, ..state })?, exact);
            Ok(StressletErrors { observed: relative(stresslet(&state)?, exact), of_moments })
        });
        errors.collect()
    }
}

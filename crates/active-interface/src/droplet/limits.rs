//! The stable time steps of a droplet.

use std::f64::consts::TAU;

use ib_core::{
    Discretisation,
    body::{StepCause, StepLimit},
};

use super::{ActiveDroplet, Motion};

impl ActiveDroplet {
    /// The stable steps; see [`ib_core::Body::step_limits`].
    pub(crate) fn limits(&self, discretisation: &Discretisation, limits: &mut dyn FnMut(StepLimit)) {
        let viscosity = self.mean_viscosity(discretisation);
        let tension = self.tensions.iter().fold(0.0_f64, |a, &b| a.max(b));
        let stiffness = discretisation.interface_stiffness * tension;
        limits(StepLimit::decay(2.0 * viscosity / stiffness, "the surface tension"));
        if let Motion::Equidistributed { relaxation, .. } = self.motion {
            // That of the next step, and of the last one where the flow itself sets it.
            let rate = self.relaxation.max(relaxation * self.spacing_rate(discretisation));
            limits(StepLimit::decay(2.0 / rate, "the relaxation of the marker spacing"));
        }
        if self.transport.is_some() {
            // Rate of the crowded particles' relaxation, c |gamma'| q / (4 eta), up to q = 1/h or so.
            let coupling = self.concentrations.iter().map(|&c| c * self.tension.slope(c).abs()).fold(0.0_f64, f64::max);
            let unit = finest_response(discretisation) * viscosity / coupling;
            let (remainder, cause) = if self.stabilised {
                (8.0, StepCause::Stabilised { bare: 2.5 * unit })
            } else {
                (2.5, StepCause::Decay)
            };
            let reason = "the coupling of concentration and tension";
            limits(StepLimit { dt: remainder * unit, reason, cause });
            let slip = self.slip.iter().fold(0.0_f64, |a, &b| a.max(b.abs()));
            // Measured: WENO5 under the midpoint rule, with the implicit diffusion of these problems, holds up to about
            // two segments a step.
            let dt = 1.8 * self.shape.geometry.mean_length() / slip;
            limits(StepLimit { dt, reason: "the particles' transport", cause: StepCause::Transport });
        }
    }
}

impl ActiveDroplet {
    /// The unit of the rate at which unequal spacing relaxes ([`Motion::Equidistributed`], 1/time).
    pub(crate) fn spacing_rate(&self, discretisation: &Discretisation) -> f64 {
        let radius = self.shape.geometry.perimeter / TAU;
        if self.transport.is_some() {
            return self.diffusion / (radius * radius);
        }
        let tension = self.tensions.iter().fold(0.0_f64, |a, &b| a.max(b));
        0.2 * tension / (self.mean_viscosity(discretisation) * radius)
    }
}

/// The length below which the flow no longer responds to forces along an interface: the grid spacing, or, where the
/// flow resolves a number of modes, 2/q for the largest wave number q, of which the interface's stiffness is a quarter.
pub(crate) fn finest_response(discretisation: &Discretisation) -> f64 {
    let grid = discretisation.spacing.filter(|_| discretisation.shape_modes.is_none());
    grid.unwrap_or(0.5 / discretisation.interface_stiffness)
}

#[cfg(test)]
mod tests;

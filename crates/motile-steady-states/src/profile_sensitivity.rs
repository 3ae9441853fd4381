//! Sensitivities of shape and concentration: derivatives of the nodes of a steady state by the parameters of its scene.

use motile_base::Vec2;
use nalgebra::DVector;

use crate::response::{Linearised, singular};
use crate::sensitivities::{NO_FOLD, SINGULAR};
use crate::{Parameter, SteadyError, SteadyState};

/// Derivatives of the shape and the concentration of a steady state by one parameter of its scene, at its nodes.
///
/// Nodes move along the normals of the curve that the state was found over, so a node is not a material point.
#[derive(Debug, Clone, PartialEq)]
#[non_exhaustive]
pub struct ProfileSensitivity {
    /// Parameter.
    pub parameter: Parameter,
    /// Derivatives of the positions of the nodes (length over the unit of the parameter).
    pub positions: Vec<Vec2>,
    /// Derivatives of the concentrations at the nodes (particles per length over the unit of the parameter).
    pub concentrations: Vec<f64>,
}

impl SteadyState {
    /// Returns the derivatives of the profile ([`SteadyState::profile`]) by some parameters, by one solve each with the
    /// factors of Newton's method.
    ///
    /// # Errors
    /// Returns an error for a parameter that the scene does not have; the errors of [`SteadyState::sensitivities`].
    pub fn profile_sensitivities(&self, parameters: &[Parameter]) -> Result<Vec<ProfileSensitivity>, SteadyError> {
        for parameter in parameters.iter().filter(|parameter| parameter.get(self.setup()).is_none()) {
            parameter.with(self.setup(), 0.0)?;
        }
        let mut linearised = Linearised::new(self)?;
        if linearised.slowest().abs() < SINGULAR * linearised.system.model.rate_unit() {
            linearised.border()?;
        }
        let nodes = self.profile().nodes();
        let of_parameter = |&parameter: &Parameter| {
            let response = linearised.response(parameter)?;
            if (response.multiplier * parameter.scale(self.setup())).abs() > NO_FOLD {
                return Err(singular());
            }
            let changes = linearised.total(&response, |_, system, point| {
                let profile = system.profile(point);
                let (_, concentrations) = profile.concentrations()?;
                let places = profile.positions.iter().flat_map(|place| place.to_array());
                Ok(DVector::from_iterator(3 * nodes, places.chain(concentrations)))
            })?;
            let (places, concentrations) = changes.as_slice().split_at(2 * nodes);
            let positions = places.chunks_exact(2).map(|place| Vec2::new(place[0], place[1])).collect();
            Ok(ProfileSensitivity { parameter, positions, concentrations: concentrations.to_vec() })
        };
        parameters.iter().map(of_parameter).collect()
    }
}

//! What is seen of a droplet of a scene.

use ib_core::{BodyError, Discretisation, Handle, Hydrodynamics, Observe, SceneError, System, scene::BodyFlow};

use crate::observables::InterfaceState;
use crate::{ActiveDroplet, Convention, Observables, observe};

impl Observe for ActiveDroplet {
    type Observables = Observables;

    /// All observables ([`observe`]) in the far-field convention; for another one see [`InterfaceState::of`].
    fn observables(&self, discretisation: &Discretisation, flow: &BodyFlow<'_>) -> Result<Observables, BodyError> {
        Ok(observe(&InterfaceState::new(self, discretisation, flow), Convention::FarField)?)
    }
}

impl<'a> InterfaceState<'a> {
    /// The state of a droplet with the flow at its markers.
    fn new(droplet: &'a ActiveDroplet, discretisation: &Discretisation, flow: &BodyFlow<'a>) -> Self {
        let outside = discretisation.viscosity;
        Self {
            markers: droplet.markers(),
            forces: flow.forces,
            velocities: flow.velocities,
            numbers: droplet.particle_numbers(),
            inside: droplet.number_inside().zip(droplet.exchange_flux()),
            stresslet: flow.stresslet,
            filled: Some(*flow),
            viscosities: [droplet.viscosity_inside().unwrap_or(outside), outside],
        }
    }

    /// The present state of a droplet of a system, for [`observe`].
    ///
    /// # Errors
    /// A handle of another scene; [`SceneError::NotEvaluated`] where the flow of the present state is not known.
    pub fn of<H: Hydrodynamics>(system: &'a System<H>, droplet: Handle<ActiveDroplet>) -> Result<Self, SceneError> {
        let discretisation = system.fluid_around(droplet)?;
        Ok(Self::new(system.body(droplet)?, &discretisation, &system.flow_at(droplet)?))
    }
}

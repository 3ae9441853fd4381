//! Observables of bodies of any kind: deformations, stresses and forces.

mod channel_forces;
mod deformation;
mod moment_ellipse;
mod stress;
mod wall_stress;

use crate::{Body, Handle, Hydrodynamics, SceneError, System};

pub use channel_forces::ChannelForces;
pub use deformation::Deformation;
pub use moment_ellipse::MomentEllipse;
pub use stress::Stress;
pub use wall_stress::WallStress;

impl<H: Hydrodynamics> System<H> {
    /// Returns the deformation of a body that is a closed curve, and its motion along itself, in the present state.
    ///
    /// # Errors
    /// Returns [`SceneError::Refused`]; the errors of [`System::evaluate`]; a body of fewer than eight markers.
    pub fn deformation(&mut self, handle: impl Into<Handle<dyn Body>>) -> Result<Deformation, SceneError> {
        self.evaluate()?;
        let flow = self.flow_at(handle)?;
        Ok(Deformation::of(flow.positions, flow.velocities)?)
    }
}

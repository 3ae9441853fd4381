//! The bodies of a system, found by their handles or by their types.

use std::any::Any;

use super::{
    Known, System,
    bodies::{Bodies, failure},
};
use crate::{Body, BodyFlow, FluidView, Handle, Hydrodynamics, Observe, SceneError, hydrodynamics::Everything};

impl<H: Hydrodynamics> System<H> {
    /// Returns a body.
    ///
    /// # Errors
    /// Returns [`SceneError::Refused`] for a handle of another scene.
    pub fn body<B: Body>(&self, handle: Handle<B>) -> Result<&B, SceneError> {
        let body: &dyn Any = self.any_body(handle)?;
        body.downcast_ref().ok_or_else(SceneError::foreign_handle)
    }

    /// Returns a body whose type does not matter.
    ///
    /// # Errors
    /// Returns [`SceneError::Refused`] for a handle of another scene.
    pub fn any_body(&self, handle: impl Into<Handle<dyn Body>>) -> Result<&dyn Body, SceneError> {
        Ok(self.bodies.list[self.bodies.index_of(handle.into())?].as_ref())
    }

    pub(crate) fn body_mut<B: Body>(&mut self, handle: Handle<B>) -> Result<&mut B, SceneError> {
        let index = self.bodies.index_of(handle.into())?;
        // Whoever holds the body mutably may change it.
        self.known = Known::Nothing;
        self.clock.first_step = true;
        let body: &mut dyn Any = self.bodies.list[index].as_mut();
        body.downcast_mut().ok_or_else(SceneError::foreign_handle)
    }

    /// Returns the bodies of type B with their handles, in the order in which they were added.
    pub fn bodies<B: Body>(&self) -> impl Iterator<Item = (Handle<B>, &B)> {
        let bodies = self.bodies.list.iter().enumerate();
        bodies.filter_map(|(index, body)| {
            let body: &dyn Any = body.as_ref();
            Some((Handle::new(self.bodies.scene, index), body.downcast_ref()?))
        })
    }

    /// Returns all bodies whatever their types, in the order in which they were added.
    pub fn all_bodies(&self) -> impl ExactSizeIterator<Item = (Handle<dyn Body>, &dyn Body)> {
        self.bodies.list.iter().enumerate().map(|(index, body)| (Handle::new(self.bodies.scene, index), body.as_ref()))
    }

    /// Returns the flow at the markers of a body in the present state.
    ///
    /// # Errors
    /// Returns [`SceneError::Refused`]; [`SceneError::Refused`] where the flow of the present state is not known, as
    /// before the first [`System::evaluate`].
    pub fn flow_at(&self, handle: impl Into<Handle<dyn Body>>) -> Result<BodyFlow<'_>, SceneError> {
        let index = self.bodies.index_of(handle.into())?;
        if self.known != Known::Flow {
            return Err(SceneError::not_evaluated(self.bodies.list[index].name()));
        }
        let Bodies { markers, enclosing, .. } = &self.bodies;
        let FluidView { viscosity, domain, .. } = self.hydrodynamics.fluid_view();
        let range = markers.groups()[index].range.clone();
        Ok(BodyFlow {
            all: Everything { markers, enclosing, viscosity, periods: domain.periods },
            index,
            positions: &markers.positions[range.clone()],
            forces: &markers.forces[range.clone()],
            velocities: &markers.velocities[range],
            imposed: self.imposed(),
        })
    }

    /// Returns the fluid as a body sees it: with the viscosity of that around it, which is not the exterior one where
    /// the body lies inside an interface. As of the last [`System::evaluate`].
    ///
    /// # Errors
    /// Returns [`SceneError::Refused`] for a handle of another scene.
    pub fn fluid_around(&self, handle: impl Into<Handle<dyn Body>>) -> Result<FluidView, SceneError> {
        let outside = self.bodies.viscosity_around[self.bodies.index_of(handle.into())?];
        Ok(self.hydrodynamics.fluid_view().in_fluid(outside).into_owned())
    }

    /// Returns the observables of a body in the present state, whose flow is computed if it is not known yet.
    ///
    /// # Errors
    /// Returns [`SceneError::Refused`]; the errors of [`System::evaluate`] and of [`Observe::observables`].
    pub fn observe<B: Observe>(&mut self, handle: Handle<B>) -> Result<B::Observables, SceneError> {
        let index = self.bodies.index_of(handle.into())?;
        self.evaluate()?;
        let view = self.fluid_around(handle)?;
        let seen = self.body(handle)?.observables(&view, &self.flow_at(handle)?);
        seen.map_err(|source| failure(self.clock.time, self.bodies.list[index].as_ref(), source))
    }
}

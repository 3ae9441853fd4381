//! The active droplet.

mod body;
mod stresslet_error;

use std::{ops::Deref, sync::Arc};

use motile_base::{Vec2, internal::at_least};

use crate::{
    ActiveInterface, Cortex, Exchange, Field, Fields, Flux, InterfaceError, Motion, Noise, Tension,
    curve::{MINIMUM_MARKERS, markers_from_points},
    exchange::Pool,
};

/// A droplet: a closed [`ActiveInterface`] and what is inside. It dereferences to the interface, so you can read
/// everything there.
#[derive(Debug, Clone)]
pub struct ActiveDroplet {
    pub(crate) interface: ActiveInterface,
    /// Particles inside, where the interface exchanges some with the inside.
    pool: Option<Pool>,
}

impl Deref for ActiveDroplet {
    type Target = ActiveInterface;

    fn deref(&self) -> &ActiveInterface {
        &self.interface
    }
}

impl From<ActiveInterface> for ActiveDroplet {
    fn from(interface: ActiveInterface) -> Self {
        Self { interface, pool: None }
    }
}

impl ActiveDroplet {
    /// Creates a droplet from its markers (equally spaced, see [`crate::Curve`]; turned around if clockwise), the
    /// particle numbers of the segments that follow them, the tension law and the particles' diffusion constant along
    /// the interface (length squared per time).
    ///
    /// # Errors
    /// Returns an error for:
    /// * fewer than eight markers, lists of different length, positions that are not finite, coincide, are spaced by
    ///   more than a factor of four unevenly, or whose curve crosses itself or has no area,
    /// * negative or non-finite numbers, a negative diffusion constant.
    pub fn new(
        markers: &[Vec2],
        numbers: Vec<f64>,
        tension: impl Tension + 'static,
        diffusion: f64,
    ) -> Result<Self, InterfaceError> {
        let markers = markers_from_points(markers)?;
        Ok(ActiveInterface::build(markers, 0.0, numbers, Arc::new(tension), Some(diffusion))?.into())
    }

    /// Creates a droplet without particles, of constant tension (force): it relaxes to a circle and is carried along.
    ///
    /// # Errors
    /// Returns the errors of [`ActiveDroplet::new`], and a tension that is negative or not finite.
    pub fn passive(markers: &[Vec2], tension: f64) -> Result<Self, InterfaceError> {
        let tension = Arc::new(crate::ConstantTension::new(tension)?);
        Ok(ActiveInterface::build(markers_from_points(markers)?, 0.0, Vec::new(), tension, None)?.into())
    }

    /// Returns the droplet with another interface.
    fn map(self, change: impl FnOnce(ActiveInterface) -> ActiveInterface) -> Self {
        Self { interface: change(self.interface), ..self }
    }

    /// Sets the name in messages ("droplet" by default), as [`ActiveInterface::with_name`] does.
    #[must_use]
    pub fn with_name(self, name: impl Into<String>) -> Self {
        self.map(|interface| interface.with_name(name))
    }

    /// Sets the tension law, as [`ActiveInterface::set_tension`] does.
    pub fn set_tension(&mut self, law: impl Tension + 'static) {
        self.interface.set_tension(law);
    }

    /// Sets how markers move, as [`ActiveInterface::with_motion`] does.
    #[must_use]
    pub fn with_motion(self, motion: Motion) -> Self {
        self.map(|interface| interface.with_motion(motion))
    }

    /// Sets the scheme for the flux of particles, as [`ActiveInterface::with_flux`] does.
    #[must_use]
    pub fn with_flux(self, flux: Flux) -> Self {
        self.map(|interface| interface.with_flux(flux))
    }

    /// Switches the constraint of the area, as [`ActiveInterface::with_area_constraint`] does.
    #[must_use]
    pub fn with_area_constraint(self, on: bool) -> Self {
        self.map(|interface| interface.with_area_constraint(on))
    }

    /// Bounds the changes of area and number of particles, as [`ActiveInterface::with_bounds`] does.
    ///
    /// # Errors
    /// Returns an error for a bound that is negative or not a number.
    pub fn with_bounds(self, area: f64, particles: f64) -> Result<Self, InterfaceError> {
        Ok(Self { interface: self.interface.with_bounds(area, particles)?, ..self })
    }

    /// Makes the droplet axisymmetric, as [`ActiveInterface::axisymmetric`] does.
    ///
    /// # Errors
    /// Returns the errors of [`ActiveInterface::axisymmetric`].
    pub fn axisymmetric(self) -> Result<Self, InterfaceError> {
        Ok(Self { interface: self.interface.axisymmetric()?, ..self })
    }

    /// Switches the stabiliser, as [`ActiveInterface::with_stabiliser`] does.
    #[must_use]
    pub fn with_stabiliser(self, on: bool) -> Self {
        self.map(|interface| interface.with_stabiliser(on))
    }

    /// Sets the viscosity inside, as [`ActiveInterface::with_viscosity_inside`] does.
    ///
    /// # Errors
    /// Returns an error for a viscosity that is not positive and finite.
    pub fn with_viscosity_inside(self, viscosity: f64) -> Result<Self, InterfaceError> {
        Ok(Self { interface: self.interface.with_viscosity_inside(viscosity)?, ..self })
    }

    /// Adds bending stiffness, as [`ActiveInterface::with_bending`] does.
    ///
    /// # Errors
    /// Returns an error for a modulus that is negative or not finite, a reference curvature that is not finite.
    pub fn with_bending(self, modulus: f64, reference_curvature: f64) -> Result<Self, InterfaceError> {
        Ok(Self { interface: self.interface.with_bending(modulus, reference_curvature)?, ..self })
    }

    /// Adds a cortex of one viscosity, as [`ActiveInterface::with_cortex_viscosity`] does.
    ///
    /// # Errors
    /// Returns an error for a viscosity that is negative or not finite.
    pub fn with_cortex_viscosity(self, viscosity: f64) -> Result<Self, InterfaceError> {
        self.with_cortex(Cortex::new(viscosity))
    }

    /// Adds a cortex, as [`ActiveInterface::with_cortex`] does.
    ///
    /// # Errors
    /// Returns an error for a viscosity that is negative or not finite.
    pub fn with_cortex(self, cortex: Cortex) -> Result<Self, InterfaceError> {
        Ok(Self { interface: self.interface.with_cortex(cortex)?, ..self })
    }

    /// Adds friction with a substrate, as [`ActiveInterface::with_friction`] does.
    ///
    /// # Errors
    /// Returns an error for a coefficient that is negative or not finite.
    pub fn with_friction(self, coefficient: f64) -> Result<Self, InterfaceError> {
        Ok(Self { interface: self.interface.with_friction(coefficient)?, ..self })
    }

    /// Makes a force per area act on the fluid inside, as [`ActiveInterface::with_body_force`] does.
    ///
    /// # Errors
    /// Returns the errors of [`ActiveInterface::with_body_force`].
    pub fn with_body_force(self, force: Vec2) -> Result<Self, InterfaceError> {
        Ok(Self { interface: self.interface.with_body_force(force)?, ..self })
    }

    /// Adds friction with the walls of a channel, as [`ActiveInterface::with_wall_friction`] does.
    ///
    /// # Errors
    /// Returns the errors of [`ActiveInterface::with_wall_friction`].
    pub fn with_wall_friction(self, viscosity: f64) -> Result<Self, InterfaceError> {
        Ok(Self { interface: self.interface.with_wall_friction(viscosity)?, ..self })
    }

    /// Makes a force act on the fluid inside, as [`ActiveInterface::with_force`] does.
    ///
    /// # Errors
    /// Returns the errors of [`ActiveInterface::with_body_force`].
    pub fn with_force(self, force: Vec2) -> Result<Self, InterfaceError> {
        Ok(Self { interface: self.interface.with_force(force)?, ..self })
    }

    /// Lets particles come and go, as [`ActiveInterface::with_open_number`] does.
    #[must_use]
    pub fn with_open_number(self) -> Self {
        self.map(ActiveInterface::with_open_number)
    }

    /// Exchanges particles between the interface and the inside, where `number` particles are well mixed. The sum of
    /// the particles on the interface and inside is conserved; the exchange is implicit and sets no time step.
    ///
    /// # Errors
    /// Returns an error for a droplet without particles on its interface; a number that is negative or not finite.
    pub fn with_well_mixed_interior(mut self, exchange: Exchange, number: f64) -> Result<Self, InterfaceError> {
        let numbers = self.interface.state.numbers.len();
        at_least("particle numbers of a droplet that exchanges particles", numbers, MINIMUM_MARKERS)?;
        self.pool = Some(Pool::new(exchange, number, self.initial_area())?);
        self.interface.account.number = self.total_number();
        Ok(self)
    }

    /// Makes the droplet feel fields, as [`ActiveInterface::with_fields`] does. Fields of binding and unbinding are
    /// added to the rates of the exchange with a well-mixed inside, so call this after
    /// [`ActiveDroplet::with_well_mixed_interior`].
    ///
    /// # Errors
    /// Returns the errors of [`ActiveInterface::with_fields`]; fields of binding or unbinding without a well-mixed
    /// inside.
    pub fn with_fields(self, fields: Fields) -> Result<Self, InterfaceError> {
        if self.pool.is_none() {
            return Ok(Self { interface: self.interface.with_fields(fields)?, ..self });
        }
        Ok(Self { interface: self.interface.with_all_fields(fields)?, ..self })
    }

    /// Adds noise to the particles, as [`ActiveInterface::with_noise`] does. Binding and unbinding with a well-mixed
    /// inside have noise too.
    ///
    /// # Errors
    /// Returns the errors of [`ActiveInterface::with_noise`].
    pub fn with_noise(self, noise: Noise) -> Result<Self, InterfaceError> {
        Ok(Self { interface: self.interface.with_noise(noise)?, ..self })
    }

    /// Returns the rates of binding and unbinding without fields, if the interface feels fields of them.
    fn felt_rates(&self) -> Option<[f64; 2]> {
        let exchange = self.pool.as_ref()?.exchange;
        let felt = self.interface.felt.as_ref()?.feels_exchange();
        felt.then(|| [exchange.binding(), exchange.unbinding()])
    }

    /// Returns the number of particles in the well-mixed interior; `None` without one.
    #[must_use]
    pub fn number_inside(&self) -> Option<f64> {
        self.pool.map(|pool| pool.number)
    }

    /// Returns the particles that bind to the interface less those that unbind (1/time); `None` without a well-mixed
    /// interior.
    #[must_use]
    pub fn exchange_flux(&self) -> Option<f64> {
        let pool = self.pool?;
        let Some([binding, unbinding]) = self.felt_rates() else {
            return Some(pool.flux(self.element_lengths(), self.interface.number()));
        };
        let felt = self.interface.felt.as_ref()?;
        let segments = self.element_lengths().iter().zip(self.particle_numbers()).zip(&felt.middles);
        let fluxes = segments.map(|((length, number), place)| {
            let rate = |base: f64, field: &Option<Field>| {
                (base + field.as_ref().map_or(0.0, |field| field.value(*place, felt.time))).max(0.0)
            };
            let bound = rate(binding, &felt.fields.binding) * length * pool.number / pool.area();
            bound - rate(unbinding, &felt.fields.unbinding) * number
        });
        Some(fluxes.sum())
    }

    /// Returns the particles on the interface and inside.
    fn total_number(&self) -> f64 {
        self.interface.number() + self.pool.map_or(0.0, |pool| pool.number)
    }
}

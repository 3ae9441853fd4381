//! The active droplet.

mod body;
mod stresslet_error;

use std::sync::Arc;

use motile_base::{InputError, Vec2, all_finite, at_least, not_negative, positive, same_length};

use crate::{
    Exchange, Flux, InterfaceError, Motion, Tension,
    concentration::Repair,
    curve::{CrossingFinder, MINIMUM_MARKERS, polygon::raw_area},
    exchange::Pool,
    interface::ActiveInterface,
};

/// A droplet: a closed fluid interface that may carry active particles, which raise its tension (Cowley section 2.1).
///
/// The unknowns are the marker positions and the particle numbers n_k of the segments between them; c_k = n_k / l_k.
/// Force of marker k on the fluid: `F_k = gamma_k t_k - gamma_{k-1} t_{k-1}` (Cowley (2.5), (2.31); t_k along segment
/// k), whose sum over the curve is zero. Particles move with the fluid along the interface and diffuse (Cowley (2.3)).
#[derive(Debug, Clone)]
pub struct ActiveDroplet {
    name: String,
    pub(crate) interface: ActiveInterface,
    inside: Inside,
    account: Account,
    crossing: CrossingFinder,
}

/// Fluid and particles inside a droplet.
#[derive(Debug, Clone)]
struct Inside {
    /// Viscosity (stress times time); `None` for that of the exterior fluid.
    viscosity: Option<f64>,
    /// Particles inside, where the interface exchanges some with the inside.
    pool: Option<Pool>,
    /// Switch of the area constraint, which restores the area after each step.
    keeps_area: bool,
}

/// Account of the quantities that a droplet conserves.
#[derive(Debug, Clone)]
struct Account {
    /// Number of markers, area of the polygon (length squared) and number of particles at the start.
    markers: usize,
    area: f64,
    number: f64,
    /// Bounds on the relative changes of area and number, beyond which a step is an error.
    bounds: [f64; 2],
}

impl Account {
    /// Bounds unless a user gives others. An area that is 5 per cent off makes speeds wrong by per cents. Transport
    /// keeps the number of particles to round-off, some 1e-16 a step.
    const BOUNDS: [f64; 2] = [0.05, 1e-8];
}

impl ActiveDroplet {
    /// A droplet from its markers (equally spaced, see [`crate::Curve`]; turned around if clockwise), the particle
    /// numbers of the segments that follow them, the tension law and the particles' diffusion constant along the
    /// interface (length squared per time).
    ///
    /// # Errors
    /// Fewer than eight markers, lists of different length, positions that are not finite, coincide, are spaced by more
    /// than a factor of four unevenly, or whose curve crosses itself or has no area; negative or non-finite numbers, a
    /// negative diffusion constant.
    pub fn new(
        markers: &[Vec2],
        numbers: Vec<f64>,
        tension: impl Tension + 'static,
        diffusion: f64,
    ) -> Result<Self, InterfaceError> {
        same_length("particle numbers", markers.len(), numbers.len())?;
        all_finite("the particle numbers", &numbers)?;
        for &number in &numbers {
            not_negative("a particle number", number)?;
        }
        not_negative("the diffusion constant", diffusion)?;
        Self::build(markers, numbers, Arc::new(tension), diffusion, Some(Flux::Weno5))
    }

    /// A droplet without particles, of constant tension (force): it relaxes to a circle and is carried along.
    ///
    /// # Errors
    /// Those of [`ActiveDroplet::new`], and a tension that is negative or not finite.
    pub fn passive(markers: &[Vec2], tension: f64) -> Result<Self, InterfaceError> {
        Self::build(markers, Vec::new(), Arc::new(crate::ConstantTension::new(tension)?), 0.0, None)
    }

    fn build(
        markers: &[Vec2],
        numbers: Vec<f64>,
        tension: Arc<dyn Tension>,
        diffusion: f64,
        flux: Option<Flux>,
    ) -> Result<Self, InterfaceError> {
        let markers = crate::curve::markers_from_points(markers)?;
        let (count, area, number) = (markers.len(), raw_area(&markers), numbers.iter().sum());
        Ok(Self {
            name: "droplet".to_owned(),
            interface: ActiveInterface::new(markers, numbers, tension, diffusion, flux),
            inside: Inside { viscosity: None, pool: None, keeps_area: false },
            account: Account { markers: count, area, number, bounds: Account::BOUNDS },
            crossing: CrossingFinder::default(),
        })
    }

    /// Gives the droplet a name for messages ("droplet" otherwise).
    #[must_use]
    pub fn with_name(mut self, name: impl Into<String>) -> Self {
        self.name = name.into();
        self
    }

    /// Moves the markers in another way than [`Motion::default`].
    #[must_use]
    pub fn with_motion(mut self, motion: Motion) -> Self {
        self.interface.law.motion = motion;
        self
    }

    /// Carries the particles by another flux than [`Flux::Weno5`].
    #[must_use]
    pub fn with_flux(mut self, flux: Flux) -> Self {
        self.interface.set_flux(flux);
        self
    }

    /// Restores the initial area after each step, by an equal normal displacement of all markers (off by default: the
    /// motion keeps the area but for the error of the time step).
    #[must_use]
    pub fn with_area_constraint(mut self, on: bool) -> Self {
        self.inside.keeps_area = on;
        self
    }

    /// Bounds the relative changes of the area and of the number of particles since the start, beyond which a step is
    /// an error (5e-2 and 1e-8 by default; infinity for none).
    ///
    /// # Errors
    /// A bound that is negative or not a number.
    pub fn with_bounds(mut self, area: f64, particles: f64) -> Result<Self, InterfaceError> {
        for (name, value) in [("the bound on the area", area), ("the bound on the particles", particles)] {
            if value.is_nan() || value < 0.0 {
                return Err(InputError::Negative { name, value }.into());
            }
        }
        self.account.bounds = [area, particles];
        Ok(self)
    }

    /// Switches the stabiliser (on by default), which makes the fast relaxation of crowded particles implicit: a
    /// diffusivity `h c max(-d gamma/dc, 0) / (4 eta)` is added implicitly and subtracted explicitly.
    #[must_use]
    pub fn with_stabiliser(mut self, on: bool) -> Self {
        self.interface.law.stabilised = on;
        self
    }

    /// Fills the droplet with a fluid of another viscosity (stress times time) than the exterior fluid.
    ///
    /// # Errors
    /// A viscosity that is not positive and finite.
    pub fn with_viscosity_inside(mut self, viscosity: f64) -> Result<Self, InterfaceError> {
        self.inside.viscosity = Some(positive("the viscosity inside", viscosity)?);
        Ok(self)
    }

    /// Exchanges particles between the interface and the inside, where `number` particles are well mixed. The sum of
    /// the particles on the interface and inside is conserved; the exchange is implicit and sets no time step.
    ///
    /// # Errors
    /// A droplet without particles on its interface; a number that is negative or not finite.
    pub fn with_pool(mut self, exchange: Exchange, number: f64) -> Result<Self, InterfaceError> {
        let numbers = self.interface.state.numbers.len();
        at_least("particle numbers of a droplet that exchanges particles", numbers, MINIMUM_MARKERS)?;
        self.inside.pool = Some(Pool::new(exchange, number, self.account.area)?);
        self.account.number = self.total_number();
        Ok(self)
    }

    /// Switches off the check that the particles on the interface are conserved: for exchange with another body, such
    /// as one that fills the droplet, which keeps the sum.
    #[must_use]
    pub fn with_open_number(mut self) -> Self {
        self.account.bounds[1] = f64::INFINITY;
        self
    }

    /// Number of particles in the pool inside; `None` without a pool.
    #[must_use]
    pub fn number_inside(&self) -> Option<f64> {
        self.inside.pool.map(|pool| pool.number)
    }

    /// Particles that bind to the interface less those that unbind (1/time); `None` without a pool.
    #[must_use]
    pub fn exchange_flux(&self) -> Option<f64> {
        self.inside.pool.map(|pool| pool.flux(self.segment_lengths(), self.interface.number()))
    }

    /// Particles on the interface and inside.
    fn total_number(&self) -> f64 {
        self.interface.number() + self.inside.pool.map_or(0.0, |pool| pool.number)
    }

    /// Marker positions (length), counter-clockwise, not wrapped into a periodic box.
    #[must_use]
    pub fn markers(&self) -> &[Vec2] {
        self.interface.markers()
    }

    /// Velocities of the markers (length per time) as of the last [`motile_scene::Body::rate`]: along the normal those
    /// of the fluid.
    #[must_use]
    pub fn marker_motion(&self) -> &[Vec2] {
        &self.interface.derived.motions
    }

    /// Particle numbers of the segments; segment k runs from marker k to the next. Empty for a passive droplet.
    #[must_use]
    pub fn particle_numbers(&self) -> &[f64] {
        &self.interface.state.numbers
    }

    /// Concentrations on the segments (particles per length).
    #[must_use]
    pub fn concentrations(&self) -> &[f64] {
        &self.interface.derived.concentrations
    }

    /// Tensions of the segments (force).
    #[must_use]
    pub fn tensions(&self) -> &[f64] {
        &self.interface.derived.tensions
    }

    /// Lengths of the segments (length).
    #[must_use]
    pub fn segment_lengths(&self) -> &[f64] {
        &self.interface.geometry().lengths
    }

    /// Area of the polygon at the start (length squared).
    #[must_use]
    pub fn initial_area(&self) -> f64 {
        self.account.area
    }

    /// Diffusion constant of the particles (length squared per time).
    #[must_use]
    pub fn diffusion(&self) -> f64 {
        self.interface.law.diffusion
    }

    /// Viscosity of the fluid inside (stress times time), `None` where it is that of the exterior fluid.
    #[must_use]
    pub fn viscosity_inside(&self) -> Option<f64> {
        self.inside.viscosity
    }

    /// Repairs of negative particle numbers since the start.
    #[must_use]
    pub fn repair(&self) -> Repair {
        self.interface.account.kept.repair
    }

    /// Numbers of markers inserted and removed since the start ([`Motion::WithFluid`]).
    #[must_use]
    pub fn redistributed(&self) -> (usize, usize) {
        let kept = self.interface.account.kept;
        (kept.inserted, kept.removed)
    }

    /// Cell Peclet number `ds max|V_t - W| / D` of the last evaluation (no dimension): V_t - W the velocity of the
    /// fluid along the interface relative to the markers, ds the length of the segments. 0 for a passive droplet,
    /// infinite for particles that do not diffuse. Above 0.35 the edge of the concentration is not resolved.
    #[must_use]
    pub fn cell_peclet(&self) -> f64 {
        self.interface.cell_peclet()
    }
}

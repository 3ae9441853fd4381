//! The active droplet.

mod body;
mod filter;
mod geometry;
mod limits;
mod observe;
mod redistribution;
mod shape;
mod spectral;

use std::sync::Arc;

use fourier::PeriodicSeries;
use ib_core::input::{InputError, all_finite, at_least, not_negative, positive, same_length};
use ib_core::{Discretisation, Vec2};

use crate::{
    Exchange, Flux, InterfaceError, Tension,
    concentration::{Repair, Transport, cell_peclet},
    curve::{CrossingFinder, polygon::raw_area},
    exchange::Pool,
};
use filter::ShortWaveFilter;
pub(crate) use limits::finest_response;
use shape::Shape;
use spectral::SpectralCurve;

/// Least number of markers of a droplet.
pub const MINIMUM_MARKERS: usize = 8;

/// Above this cell Peclet number `ds max|V_t - W| / D` (no dimension) the edge of the concentration is not resolved,
/// however fine the grid: speeds may be off by a per cent (study `warnings`).
pub const PECLET_LIMIT: f64 = 0.35;

/// Relative change of the area, and of the number of particles, at which a run ends unless the droplet is told
/// otherwise.
const AREA_BOUND: f64 = 0.05;
const NUMBER_BOUND: f64 = 1e-8;

/// How the markers of an interface move.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Motion {
    /// With the fluid's normal velocity (its mean removed, so that the area stays) and a tangential velocity W of their
    /// own that keeps them equally spaced; the default (docs/method.md, section 4). The mobility correction needs it.
    Equidistributed {
        /// Rate at which unequal spacing relaxes, in units of D/R^2, D the diffusion constant of the particles and 2 pi
        /// R the perimeter; without particles, of a fifth of the tension over mean viscosity and R, so that it sets no
        /// shorter steps than the tension does.
        relaxation: f64,
        /// Whether modes of the markers shorter than the kernel are filtered after each step; without it they grow in
        /// long runs. Only on a grid.
        filter: bool,
    },
    /// With the fluid's full velocity (Cowley (2.8)), markers being inserted where they thin out (1.5 times the spacing
    /// at the start) and removed where they crowd (half of it), without a loss of particles.
    WithFluid,
}

impl Default for Motion {
    fn default() -> Self {
        Self::Equidistributed { relaxation: 50.0, filter: true }
    }
}

/// A droplet: a closed fluid interface that may carry active particles, which raise its tension (Cowley section 2.1).
///
/// The unknowns are the marker positions and the particle numbers n_k of the segments between them; c_k = n_k / l_k.
/// Force of marker k on the fluid: `F_k = gamma_k t_k - gamma_{k-1} t_{k-1}` (Cowley (2.5), (2.31); t_k along segment
/// k), whose sum over the curve is zero. Particles move with the fluid along the interface and diffuse (Cowley (2.3)).
#[derive(Debug, Clone)]
pub struct ActiveDroplet {
    pub(crate) name: String,
    pub(crate) shape: Shape,
    /// Another state's shape: that of the start of a step, of a state that is solved for implicitly.
    pub(crate) other: Shape,
    pub(crate) numbers: Vec<f64>,
    pub(crate) tension: Arc<dyn Tension>,
    pub(crate) motion: Motion,
    pub(crate) diffusion: f64,
    pub(crate) stabilised: bool,
    pub(crate) keeps_area: bool,
    pub(crate) viscosity_inside: Option<f64>,
    pub(crate) target_spacing: f64,
    pub(crate) initial_markers: usize,
    pub(crate) initial_area: f64,
    pub(crate) concentrations: Vec<f64>,
    pub(crate) tensions: Vec<f64>,
    pub(crate) slip: Vec<f64>,
    /// Rate at which unequal spacing relaxes (1/time), of the last evaluation.
    pub(crate) relaxation: f64,
    pub(crate) motions: Vec<Vec2>,
    pub(crate) transport: Option<Transport>,
    /// Particles inside, where they are exchanged.
    pub(crate) pool: Option<Pool>,
    /// Diffusivities at the markers of the stabiliser, and of stabiliser and diffusion together (length^2 per time).
    pub(crate) stabiliser: Vec<f64>,
    pub(crate) diffusivities: Vec<f64>,
    pub(crate) filter: ShortWaveFilter,
    /// Truncation of the motion, where the flow resolves fewer modes than there are markers.
    pub(crate) band: Option<(PeriodicSeries, usize)>,
    /// The smooth curve through the markers, where the flow is spectrally accurate.
    pub(crate) spectral: Option<SpectralCurve>,
    pub(crate) crossing: CrossingFinder,
    pub(crate) repair: Repair,
    pub(crate) redistributed: (usize, usize),
    /// What the last step did of both, which counts only once it stays.
    pub(crate) last_repair: Repair,
    pub(crate) last_redistributed: (usize, usize),
    /// Particles at the start, and the bounds on the relative changes of area and particles.
    pub(crate) initial_number: f64,
    pub(crate) bounds: [f64; 2],
}

impl ActiveDroplet {
    /// A droplet from its markers (equally spaced, see [`crate::Curve`]; turned around if clockwise), the particle
    /// numbers of the segments that follow them, the tension law and the particles' diffusion constant along the
    /// interface (length squared per time).
    ///
    /// # Errors
    /// Fewer than [`MINIMUM_MARKERS`] markers, lists of different length, positions that are not finite, coincide, are
    /// spaced by more than a factor of four unevenly, or whose curve crosses itself or has no area; negative or
    /// non-finite numbers, a negative diffusion constant.
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
        let transport = Transport::new(markers.len().max(MINIMUM_MARKERS), Flux::Weno5);
        Self::build(markers, numbers, Arc::new(tension), diffusion, Some(transport))
    }

    /// A droplet without particles, of constant tension (force): it relaxes and is carried along.
    ///
    /// # Errors
    /// As [`ActiveDroplet::new`], and a tension that is negative or not finite.
    pub fn passive(markers: &[Vec2], tension: f64) -> Result<Self, InterfaceError> {
        Self::build(markers, Vec::new(), Arc::new(crate::ConstantTension::new(tension)?), 0.0, None)
    }

    fn build(
        markers: &[Vec2],
        numbers: Vec<f64>,
        tension: Arc<dyn Tension>,
        diffusion: f64,
        transport: Option<Transport>,
    ) -> Result<Self, InterfaceError> {
        let markers = crate::curve::markers_from_points(markers)?;
        let initial_area = raw_area(&markers);
        let mut droplet = Self {
            name: "droplet".to_owned(),
            motion: Motion::default(),
            diffusion,
            stabilised: true,
            keeps_area: false,
            viscosity_inside: None,
            target_spacing: 0.0,
            initial_markers: markers.len(),
            initial_area,
            shape: Shape::default(),
            other: Shape::default(),
            concentrations: Vec::new(),
            tensions: Vec::new(),
            slip: vec![0.0; markers.len()],
            relaxation: 0.0,
            motions: Vec::new(),
            transport,
            pool: None,
            stabiliser: Vec::new(),
            diffusivities: Vec::new(),
            filter: ShortWaveFilter::default(),
            band: None,
            spectral: None,
            crossing: CrossingFinder::default(),
            repair: Repair::default(),
            redistributed: (0, 0),
            last_repair: Repair::default(),
            last_redistributed: (0, 0),
            initial_number: numbers.iter().sum(),
            bounds: [AREA_BOUND, NUMBER_BOUND],
            tension,
            numbers,
        };
        droplet.shape.markers = markers;
        droplet.update();
        droplet.target_spacing = droplet.shape.geometry.mean_length();
        Ok(droplet)
    }

    /// The same droplet with a name for messages.
    #[must_use]
    pub fn with_name(mut self, name: impl Into<String>) -> Self {
        self.name = name.into();
        self
    }

    /// The same droplet with markers that move in another way.
    #[must_use]
    pub fn with_motion(mut self, motion: Motion) -> Self {
        self.motion = motion;
        self
    }

    /// The same droplet with another flux of its particles.
    #[must_use]
    pub fn with_flux(mut self, flux: Flux) -> Self {
        self.transport = self.transport.map(|transport| Transport::new(transport.len(), flux));
        self
    }

    /// The same droplet with its area restored to the initial one after each step, by an equal normal displacement of
    /// all markers (off by default: the motion keeps the area but for the error of the time step).
    #[must_use]
    pub fn with_area_constraint(mut self, on: bool) -> Self {
        self.keeps_area = on;
        self
    }

    /// The same droplet with other bounds on the relative changes of its area and of its number of particles since the
    /// start, beyond which a step is an error (5e-2 and 1e-8 by default; infinity for none).
    ///
    /// # Errors
    /// A bound that is negative or not a number.
    pub fn with_bounds(mut self, area: f64, particles: f64) -> Result<Self, InterfaceError> {
        for (name, value) in [("the bound on the area", area), ("the bound on the particles", particles)] {
            if value.is_nan() || value < 0.0 {
                return Err(InputError::Negative { name, value }.into());
            }
        }
        self.bounds = [area, particles];
        Ok(self)
    }

    /// The same droplet with or without the stabiliser (on by default), which makes the fast relaxation of crowded
    /// particles implicit: a diffusivity `h c max(-d gamma/dc, 0) / (4 eta)` is added implicitly and subtracted
    /// explicitly.
    #[must_use]
    pub fn with_stabiliser(mut self, on: bool) -> Self {
        self.stabilised = on;
        self
    }

    /// The same droplet filled with a fluid of another viscosity (stress times time) than the exterior fluid.
    ///
    /// # Errors
    /// A viscosity that is not positive and finite.
    pub fn with_viscosity_inside(mut self, viscosity: f64) -> Result<Self, InterfaceError> {
        self.viscosity_inside = Some(positive("the viscosity inside", viscosity)?);
        Ok(self)
    }

    /// The same droplet whose particles are exchanged with its inside, where `number` particles are well mixed. What is
    /// kept is the sum of the particles on the interface and inside; the exchange is implicit and sets no time step.
    ///
    /// # Errors
    /// A droplet without particles on its interface; a number that is negative or not finite.
    pub fn with_pool(mut self, exchange: Exchange, number: f64) -> Result<Self, InterfaceError> {
        at_least("particle numbers of a droplet that exchanges particles", self.numbers.len(), MINIMUM_MARKERS)?;
        self.pool = Some(Pool::new(exchange, number, self.initial_area)?);
        self.initial_number = self.total_number();
        Ok(self)
    }

    /// The number of particles inside; `None` without exchange.
    #[must_use]
    pub fn number_inside(&self) -> Option<f64> {
        self.pool.map(|pool| pool.number)
    }

    /// Particles that bind to the interface less those that unbind (1/time); `None` without exchange.
    #[must_use]
    pub fn exchange_flux(&self) -> Option<f64> {
        let on = self.numbers.iter().sum();
        self.pool.map(|pool| pool.flux(&self.shape.geometry.lengths, on))
    }

    /// Particles on the interface and inside.
    pub(crate) fn total_number(&self) -> f64 {
        self.numbers.iter().sum::<f64>() + self.pool.map_or(0.0, |pool| pool.number)
    }

    /// Marker positions (length), counter-clockwise, not wrapped into a periodic box.
    #[must_use]
    pub fn markers(&self) -> &[Vec2] {
        &self.shape.markers
    }

    /// How the markers move (length per time), as of the last [`ib_core::Body::rate`]: along the normal with the fluid.
    #[must_use]
    pub fn marker_motion(&self) -> &[Vec2] {
        &self.motions
    }

    /// Particle numbers of the segments; segment k runs from marker k to the next. Empty for a passive droplet.
    #[must_use]
    pub fn particle_numbers(&self) -> &[f64] {
        &self.numbers
    }

    /// Concentrations on the segments (particles per length).
    #[must_use]
    pub fn concentrations(&self) -> &[f64] {
        &self.concentrations
    }

    /// Tensions of the segments (force).
    #[must_use]
    pub fn tensions(&self) -> &[f64] {
        &self.tensions
    }

    /// Lengths of the segments (length).
    #[must_use]
    pub fn segment_lengths(&self) -> &[f64] {
        &self.shape.geometry.lengths
    }

    /// Area of the polygon at the start (length squared).
    #[must_use]
    pub fn initial_area(&self) -> f64 {
        self.initial_area
    }

    /// Diffusion constant of the particles (length squared per time).
    #[must_use]
    pub fn diffusion(&self) -> f64 {
        self.diffusion
    }

    /// Viscosity of the fluid inside (stress times time), `None` where it is that of the exterior fluid.
    #[must_use]
    pub fn viscosity_inside(&self) -> Option<f64> {
        self.viscosity_inside
    }

    /// How often since the start particle numbers had to be kept from becoming negative, and what that took.
    #[must_use]
    pub fn repair(&self) -> Repair {
        self.repair
    }

    /// Markers inserted and removed since the start.
    #[must_use]
    pub fn redistributed(&self) -> (usize, usize) {
        self.redistributed
    }

    /// The cell Peclet number `ds max|V_t - W| / D` of the last evaluation; 0 for a passive droplet, infinite for
    /// particles that do not diffuse.
    #[must_use]
    pub fn cell_peclet(&self) -> f64 {
        if self.transport.is_none() {
            return 0.0;
        }
        cell_peclet(&self.slip, &self.shape.geometry.lengths, self.diffusion)
    }

    /// Brings everything that follows from markers and particle numbers up to date.
    pub(crate) fn update(&mut self) {
        self.shape.update(self.spectral.as_mut());
        self.update_tensions();
    }

    /// Brings concentrations and tensions up to date.
    pub(crate) fn update_tensions(&mut self) {
        let lengths = &self.shape.geometry.lengths;
        self.concentrations.resize(lengths.len(), 0.0);
        self.tensions.resize(lengths.len(), 0.0);
        for (k, c) in self.concentrations.iter_mut().enumerate() {
            *c = self.numbers.get(k).map_or(0.0, |n| n / lengths[k]);
        }
        self.tension.values(&self.concentrations, &mut self.tensions);
    }

    /// The truncation and the geometry that `discretisation` asks for, remade only where they have changed.
    ///
    /// # Errors
    /// More markers than a Fourier transform takes.
    pub(crate) fn fit(&mut self, discretisation: &Discretisation) -> Result<(), InputError> {
        let count = self.shape.markers.len();
        let smooth = discretisation.shape_modes.is_some() && matches!(self.motion, Motion::Equidistributed { .. });
        if smooth != self.spectral.as_ref().is_some_and(|spectral| spectral.len() == count) {
            self.spectral = smooth.then(|| SpectralCurve::new(count)).transpose()?;
            self.other.markers.clear();
            self.update();
        }
        let band = discretisation.shape_modes.filter(|&modes| modes < count).map(|modes| (count, modes));
        if band != self.band.as_ref().map(|(series, modes)| (series.len(), *modes)) {
            self.band = match band {
                Some((count, modes)) => Some((PeriodicSeries::new(count)?, modes)),
                None => None,
            };
        }
        Ok(())
    }

    /// Mean of the viscosities on both sides, on which the speed of an interface depends (stress times time).
    pub(crate) fn mean_viscosity(&self, discretisation: &Discretisation) -> f64 {
        self.viscosity_inside.map_or(discretisation.viscosity, |inside| 0.5 * (inside + discretisation.viscosity))
    }
}

#[cfg(test)]
mod tests;

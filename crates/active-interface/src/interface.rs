//! An interface that carries particles: markers, particle numbers, tension, and how all of them change in a flow.
//!
//! A droplet adds what only a closed curve has: particles inside, moments, and a radius to be resolved.

mod bending;
mod body;
pub(crate) mod body_force;
mod build;
mod filter;
pub(crate) mod geometry;
mod limits;
mod redistribution;
mod resistance;
mod shape;
pub(crate) mod spectral;

use std::sync::Arc;

use motile_base::{InputError, Membrane, PeriodicSeries, Vec2, polygon::CrossingFinder};
use motile_scene::{FluidView, StepInfo, points};
use serde::{Deserialize, Serialize};

use crate::{
    Cortex, Tension,
    concentration::{Cells, Repair, Transport},
    curve::MINIMUM_MARKERS,
    field::{Felt, middles_of},
    noise::Fluctuations,
};
use bending::{Bending, Stiffness};
use body_force::BodyForce;
use filter::ShortWaveFilter;
use geometry::{Geometry, equidistribute, motion_rate};
use limits::finest_response;
pub(crate) use limits::grid_spacing;
use redistribution::redistribute;
use resistance::Resistance;
use shape::Shape;
use spectral::SpectralCurve;

/// Motion of the markers of an interface.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields, rename_all = "kebab-case")]
#[non_exhaustive]
pub enum Motion {
    /// Markers move with the fluid's normal velocity (its mean removed, which keeps the area) and with a tangential
    /// velocity W that keeps them equally spaced; the default (docs/explanation/time-stepping.md). The
    /// mobility correction of the immersed boundary method needs equal spacing.
    Equidistributed {
        /// Rate at which unequal spacing relaxes, in units of D/R^2, D the diffusion constant of the particles and 2 pi
        /// R the perimeter; without particles, in units of a fifth of the tension over mean viscosity and R, so that
        /// it sets no shorter time steps than the tension does.
        relaxation: f64,
        /// Filter of the modes of the markers that are shorter than the kernel, applied after each step; without it
        /// they grow in long runs. It acts on a grid only. In a file it is on unless given.
        #[serde(default = "filtered")]
        filter: bool,
    },
    /// Markers move with the fluid's full velocity (Cowley (2.8)). They are inserted where segments exceed 1.5 times
    /// the spacing at the start and removed where segments fall below half of it; no particle is lost. Those of an
    /// interface that is periodic along x stay the same.
    WithFluid,
}

fn filtered() -> bool {
    true
}

impl Default for Motion {
    fn default() -> Self {
        Self::Equidistributed { relaxation: 50.0, filter: true }
    }
}

/// Laws of an interface, fixed over a run.
#[derive(Debug, Clone)]
pub(crate) struct Law {
    /// Tension as a function of the concentration.
    pub(crate) tension: Arc<dyn Tension>,
    /// Diffusion constant D of the particles along the interface (length squared per time).
    pub(crate) diffusion: f64,
    pub(crate) motion: Motion,
    /// Switch of the stabiliser, which treats the fast relaxation of crowded particles implicitly, see
    /// [`ActiveInterface::prepare_step`].
    pub(crate) stabilised: bool,
    /// Viscosity of the fluid inside (stress times time); `None` for the viscosity of the fluid outside.
    pub(crate) viscosity_inside: Option<f64>,
    /// Switch of the area constraint, which restores the area after each step.
    pub(crate) keeps_area: bool,
    /// Elasticity along the interface, if it is a membrane.
    pub(crate) elasticity: Option<Membrane>,
    /// Bending, if the interface resists it.
    pub(crate) bending: Option<Bending>,
    /// Viscosity of the cortex.
    pub(crate) cortex: Cortex,
    /// Friction xi with a substrate (force times time per length squared).
    pub(crate) friction: f64,
    /// Viscosity of the film between the interface and the walls of a channel (stress times time), 0 without friction
    /// with walls.
    pub(crate) wall_film: f64,
    /// Force on the fluid inside, if there is one.
    pub(crate) body_force: Option<BodyForce>,
}

/// Unknowns of an interface: marker positions (with their geometry) and the particle numbers of the segments.
#[derive(Debug, Clone)]
pub(crate) struct State {
    pub(crate) shape: Shape,
    /// Particle number of each segment, segment k from marker k to the next; empty without particles.
    pub(crate) numbers: Vec<f64>,
}

/// Quantities that follow from the state, and from the flow where they are velocities.
#[derive(Debug, Clone, Default)]
pub(crate) struct Derived {
    /// Concentrations n_k / l_k of the segments (particles per length), zero without particles.
    pub(crate) concentrations: Vec<f64>,
    /// Tensions of the segments (force).
    pub(crate) tensions: Vec<f64>,
    /// Velocity V_t - W of the fluid along the interface relative to each marker (length per time).
    pub(crate) slip: Vec<f64>,
    /// Velocities of the markers (length per time).
    pub(crate) motions: Vec<Vec2>,
    /// Rate at which unequal spacing relaxes (1/time).
    pub(crate) relaxation: f64,
}

/// View of the fluid around an interface, and its working arrays.
#[derive(Debug, Clone)]
struct Scheme {
    /// Transport of the particles; `None` without particles.
    transport: Option<Transport>,
    /// Diffusivities at the markers (length squared per time): of the stabiliser alone (empty if it is off), and of
    /// diffusion and stabiliser together.
    stabiliser: Vec<f64>,
    diffusivities: Vec<f64>,
    /// Shape of a second state: the start of a step, or one that an implicit equation is solved for.
    other: Shape,
    filter: ShortWaveFilter,
    /// Truncation of the motion to a number of modes, where the flow resolves fewer modes than there are markers.
    band: Option<(PeriodicSeries, usize)>,
    /// Smooth curve through the markers, where the flow is spectrally accurate.
    spectral: Option<SpectralCurve>,
    /// Stresses of the cortex and of friction, if there are any.
    resistance: Option<Box<Resistance>>,
}

/// Interventions of the scheme in particle numbers and markers.
#[derive(Debug, Clone, Copy, Default)]
pub(crate) struct Interventions {
    pub(crate) repair: Repair,
    pub(crate) inserted: usize,
    pub(crate) removed: usize,
}

/// Record of a run: what it started from, what may change of it, and the interventions so far.
#[derive(Debug, Clone)]
pub(crate) struct Account {
    /// Mean length of the segments at the start (length).
    pub(crate) spacing: f64,
    /// Number of markers, area of the polygon (length squared) and number of particles at the start.
    pub(crate) markers: usize,
    pub(crate) area: f64,
    pub(crate) number: f64,
    /// Length at the start (length), which an interface that does not stretch keeps.
    pub(crate) length: f64,
    /// Bounds on the relative changes of area and number, beyond which a step is an error.
    pub(crate) bounds: [f64; 2],
    /// Interventions of all steps that were kept.
    pub(crate) kept: Interventions,
    /// Interventions of the last step, which may yet be rejected.
    last: Interventions,
}

/// A fluid interface that may carry particles which raise its tension (Cowley section 2.1).
///
/// The unknowns are the marker positions and the particle numbers n_k of the segments between them; c_k = n_k / l_k.
/// Force of marker k on the fluid: `F_k = gamma_k t_k - gamma_{k-1} t_{k-1}` (Cowley (2.5), (2.31); t_k along segment
/// k), whose sum over the curve is zero. Particles move with the fluid along the interface and diffuse (Cowley (2.3)).
/// An interface may resist bending ([`ActiveInterface::with_bending`]).
#[derive(Debug, Clone)]
#[doc(alias("surfactant", "Marangoni", "surface tension", "drop", "active droplet"))]
pub struct ActiveInterface {
    name: String,
    pub(crate) law: Law,
    pub(crate) state: State,
    pub(crate) derived: Derived,
    pub(crate) account: Account,
    scheme: Scheme,
    crossing: CrossingFinder,
    /// Fields in the laboratory, if it feels any.
    pub(crate) felt: Option<Box<Felt>>,
    /// Noise on the particles, if there is any.
    pub(crate) noise: Option<Box<Fluctuations>>,
}

/// Takes the mean motion along a closed curve off the motions of its markers (length per time). Markers then do not
/// tread around a steady shape, which would seem to change to the stabiliser of bending if they did.
fn stop_treading(geometry: &Geometry, motions: &mut [Vec2], slip: &mut [f64]) {
    let along = motions.iter().zip(&geometry.tangents).map(|(motion, tau)| motion.dot(*tau)).sum::<f64>();
    let mean = along / motions.len() as f64;
    for ((motion, slip), tau) in motions.iter_mut().zip(slip).zip(&geometry.tangents) {
        *motion -= mean * *tau;
        *slip += mean;
    }
}

/// Implicit diffusion of particles over an interface of a given shape.
pub(crate) struct Diffusion<'a> {
    pub(crate) transport: &'a mut Transport,
    pub(crate) cells: Cells<'a>,
    /// Diffusivities at the markers (length squared per time).
    pub(crate) diffusivities: &'a [f64],
}

impl ActiveInterface {
    pub(crate) fn geometry(&self) -> &Geometry {
        &self.state.shape.geometry
    }

    /// Returns `true` for an interface with particles.
    pub(crate) fn carries(&self) -> bool {
        self.scheme.transport.is_some()
    }

    /// Returns the number of particles on the interface.
    pub(crate) fn number(&self) -> f64 {
        self.state.numbers.iter().sum()
    }

    /// Brings everything that follows from markers and particle numbers up to date.
    pub(crate) fn update(&mut self) {
        self.state.shape.update(self.scheme.spectral.as_mut());
        self.update_tensions();
    }

    pub(crate) fn update_tensions(&mut self) {
        let sizes = self.state.shape.geometry.cells().sizes;
        let Derived { concentrations, tensions, .. } = &mut self.derived;
        concentrations.resize(sizes.len(), 0.0);
        tensions.resize(sizes.len(), 0.0);
        for (k, c) in concentrations.iter_mut().enumerate() {
            *c = self.state.numbers.get(k).map_or(0.0, |n| n / sizes[k]);
        }
        self.law.tension.values(concentrations, tensions);
        if let Some(felt) = &mut self.felt {
            let Shape { markers, advance, .. } = &self.state.shape;
            felt.middles.clear();
            felt.middles.extend_from_slice(markers);
            match self.scheme.spectral.as_mut().filter(|spectral| spectral.len() == markers.len()) {
                Some(spectral) => spectral.write_middles(markers, *advance, &mut felt.middles),
                None => {
                    let even = matches!(self.law.motion, Motion::Equidistributed { .. });
                    middles_of(&mut felt.middles, *advance, even);
                }
            }
            felt.add_tensions(concentrations, tensions);
        }
        if let Some(resistance) = &mut self.scheme.resistance {
            resistance.add_tensions(tensions);
        }
    }

    /// Returns what fields add to the activity on the segments (force times length); empty without such a field.
    pub(crate) fn felt_activities(&self) -> &[f64] {
        self.felt.as_ref().map_or(&[], |felt| &felt.activities)
    }

    /// Remakes the truncation and the geometry that `view` asks for, where they have changed.
    ///
    /// # Errors
    /// Returns an error for more markers than a Fourier transform takes.
    pub(crate) fn fit(&mut self, view: &FluidView) -> Result<(), InputError> {
        let count = self.markers().len();
        // Markers of the others are inserted and removed.
        let stay = matches!(self.law.motion, Motion::Equidistributed { .. }) || self.state.shape.advance != 0.0;
        let smooth = self.state.shape.axisymmetric || (view.shape_modes.is_some() && stay);
        if smooth != self.scheme.spectral.as_ref().is_some_and(|spectral| spectral.len() == count) {
            self.scheme.spectral = smooth.then(|| SpectralCurve::new(count)).transpose()?;
            self.scheme.other.markers.clear();
            self.update();
            if self.state.shape.advance != 0.0 || self.keeps_smooth_area() {
                // Another measure of the same area.
                self.account.area = self.area();
            }
            self.account.length = self.geometry().total_weight();
        }
        let band = view.shape_modes.filter(|&modes| modes < count);
        if band.map(|modes| (count, modes)) != self.scheme.band.as_ref().map(|(series, modes)| (series.len(), *modes)) {
            self.scheme.band = band.map(|modes| Ok((PeriodicSeries::new(count)?, modes))).transpose()?;
        }
        Ok(())
    }

    /// Writes the forces on the fluid `F_k = gamma_k t_k - gamma_{k-1} t_{k-1}` (force; Cowley (2.5), (2.31)), and the
    /// forces of elasticity and bending if there are any.
    ///
    /// # Errors
    /// Returns the errors of [`ActiveInterface::fit`].
    fn all_forces(&mut self, view: &FluidView, forces: &mut [Vec2]) -> Result<(), InputError> {
        self.fit(view)?;
        let Shape { geometry, axisymmetric, .. } = &self.state.shape;
        if let Some(spectral) = self.scheme.spectral.as_mut().filter(|_| *axisymmetric) {
            let felt = self.felt.as_ref().map_or(&[][..], |felt| &felt.tensions);
            spectral.ring_forces(geometry, &self.derived.tensions, felt, forces);
            if let Some(force) = &self.law.body_force {
                force.add_forces(&self.state.shape, true, forces);
            }
            return Ok(());
        }
        geometry.write_pulls(&self.derived.tensions, forces);
        if let Some(spectral) = self.scheme.spectral.as_mut() {
            spectral.sharpen(forces);
        }
        if let Some(force) = &self.law.body_force {
            force.add_forces(&self.state.shape, self.scheme.spectral.is_some(), forces);
        }
        let Law { elasticity, bending, .. } = &mut self.law;
        let Shape { markers, advance, .. } = &self.state.shape;
        if let Some(elasticity) = elasticity {
            elasticity.move_to(markers, Vec2::new(*advance, 0.0))?;
            elasticity.add_forces(forces)?;
        }
        bending.as_mut().map_or(Ok(()), |bending| bending.add_forces(markers, *advance, forces))
    }

    /// Takes over the finite state of an interface of `count` markers.
    fn take_state(&mut self, count: usize, state: &[f64]) {
        let (positions, numbers) = state.split_at(2 * count);
        self.resize(count);
        if !self.state.shape.is_at(positions) {
            std::mem::swap(&mut self.state.shape, &mut self.scheme.other);
            self.state.shape.move_to(positions, self.scheme.spectral.as_mut());
        }
        self.state.numbers.copy_from_slice(numbers);
        self.update_tensions();
    }

    /// Makes all lists except the lists of the shape fit `count` markers.
    fn resize(&mut self, count: usize) {
        if let Some(transport) = &self.scheme.transport {
            self.state.numbers.resize(count, 0.0);
            if transport.len() != count {
                self.scheme.transport = Some(Transport::new(count, transport.flux()));
            }
        }
        self.scheme.diffusivities.resize(count, self.law.diffusion);
        self.derived.slip.resize(count, 0.0);
    }

    /// Writes the explicit rate of change of positions (length per time) and particle numbers (1/time) in a flow with
    /// these velocities at the markers (length per time). A body's entries beyond the entries of the interface become
    /// zero.
    pub(crate) fn write_rate(&mut self, velocities: &[Vec2], rate: &mut [f64]) {
        let State { shape: Shape { markers, geometry, .. }, numbers } = &self.state;
        let count = markers.len();
        let Derived { motions, slip, relaxation, tensions, .. } = &mut self.derived;
        motions.resize(count, Vec2::ZERO);
        slip.resize(count, 0.0);
        match self.law.motion {
            Motion::Equidistributed { relaxation: factor, .. } => {
                if self.scheme.transport.is_none() && tensions.iter().all(|&tension| tension == 0.0) {
                    *relaxation = factor * motion_rate(geometry, velocities);
                }
                match self.scheme.spectral.as_mut() {
                    Some(curve) => {
                        // Where no mode is truncated, a translation would alias.
                        let mean = || velocities.iter().sum::<Vec2>() / count as f64;
                        let carried = if self.scheme.band.is_none() { mean() } else { Vec2::ZERO };
                        curve.equidistribute(geometry, velocities, carried, *relaxation, motions, slip);
                    }
                    None => equidistribute(geometry, velocities, *relaxation, motions, slip),
                }
                let stays = self.law.bending.is_some() && self.scheme.transport.is_none();
                if stays && self.state.shape.advance == 0.0 {
                    stop_treading(geometry, motions, slip);
                }
            }
            Motion::WithFluid => {
                motions.copy_from_slice(velocities);
                slip.fill(0.0);
            }
        }
        if let Some((series, modes)) = &mut self.scheme.band {
            // The series is as long as the list since `fit`, so that the call cannot fail.
            let _ = series.truncate_vectors(motions, *modes);
        }
        let (positions, rates) = rate.split_at_mut(2 * count);
        points::write(motions, positions);
        if let Some(bending) = &mut self.law.bending {
            // The implicit part adds this again.
            bending.stabiliser.release(markers, self.state.shape.advance, positions);
        }
        rates.fill(0.0);
        if let Some(transport) = self.scheme.transport.as_mut() {
            let rates = &mut rates[..count];
            transport.add_advection(numbers, geometry.cells(), slip, rates);
            // The implicit part has the stabiliser's diffusion added: take it off here.
            if let Some(noise) = &self.noise {
                noise.add(rates);
            }
            if self.scheme.stabiliser.len() == count {
                transport.add_diffusion(geometry.cells(), &self.scheme.stabiliser, numbers, -1.0, rates);
            }
        }
    }

    /// Prepares the implicit part of a step; `viscosity` is the mean of those on both sides (stress times time).
    ///
    /// The stabiliser adds the diffusivity `h c max(-d gamma/dc, 0) / (4 eta)` to the implicit part and subtracts it
    /// from the explicit one. Crowded particles relax at the rate `c |d gamma/dc| q / (4 eta)` at the wave number q,
    /// and that diffusivity has the same rate at q = 1/h.
    ///
    /// # Errors
    /// Returns the errors of [`ActiveInterface::fit`].
    fn prepare_step(&mut self, view: &FluidView, viscosity: f64, step: StepInfo) -> Result<(), InputError> {
        let StepInfo { dt, stabilised } = step;
        if let Motion::Equidistributed { relaxation, .. } = self.law.motion {
            self.derived.relaxation = relaxation * self.spacing_rate(viscosity);
        }
        let count = self.markers().len();
        self.fit(view)?;
        if let Some(bending) = &mut self.law.bending {
            let stiffness = Stiffness {
                perimeter: self.state.shape.geometry.perimeter,
                viscosity,
                largest: view.interface_stiffness,
                dt,
                modes: view.shape_modes.unwrap_or(count),
            };
            bending.prepare_step((self.law.stabilised && stabilised).then_some(stiffness));
        }
        let Scheme { transport, stabiliser, diffusivities, .. } = &mut self.scheme;
        diffusivities.resize(count, 0.0);
        diffusivities.fill(self.law.diffusion);
        stabiliser.clear();
        // In a flow that does not respond to forces, there is nothing to stabilise.
        let responds = view.interface_stiffness > 0.0;
        if transport.is_none() || !(self.law.stabilised && stabilised && responds) {
            return Ok(());
        }
        stabiliser.resize(count, 0.0);
        let scale = 0.25 * finest_response(view) / viscosity;
        let concentrations = &self.derived.concentrations;
        if let Some(felt) = self.felt.as_ref().filter(|felt| felt.activities.len() == count) {
            let stiffness = |k: usize| {
                let c = concentrations[k];
                scale * c * (felt.activities[k] - self.law.tension.slope(c)).max(0.0)
            };
            for (k, (face, all)) in stabiliser.iter_mut().zip(diffusivities).enumerate() {
                *face = 0.5 * (stiffness(if k == 0 { count - 1 } else { k - 1 }) + stiffness(k));
                *all += *face;
            }
            return Ok(());
        }
        let stiffness = |c: f64| scale * c * (-self.law.tension.slope(c)).max(0.0);
        let mut before = stiffness(concentrations[count - 1]);
        for ((face, all), &c) in stabiliser.iter_mut().zip(diffusivities).zip(concentrations) {
            let here = stiffness(c);
            *face = 0.5 * (before + here);
            *all += *face;
            before = here;
        }
        Ok(())
    }

    /// Returns the implicit diffusion over the interface with its markers at `positions`; `None` without particles.
    pub(crate) fn diffusion_at(&mut self, positions: &[f64]) -> Option<Diffusion<'_>> {
        let Scheme { transport, diffusivities, other, spectral, .. } = &mut self.scheme;
        let transport = transport.as_mut()?;
        let present = &self.state.shape;
        let geometry = if present.is_at(positions) {
            &present.geometry
        } else {
            other.move_to(positions, spectral.as_mut());
            &other.geometry
        };
        Some(Diffusion { transport, cells: geometry.cells(), diffusivities })
    }

    /// Ends a step of length `dt` (time) at the mean viscosity of both sides (stress times time). It filters the
    /// markers if there is a grid that does not see their short waves, or inserts and removes some.
    fn move_markers(&mut self, view: &FluidView, viscosity: f64, dt: f64) {
        let State { shape: Shape { markers, geometry, advance, .. }, numbers } = &mut self.state;
        match (self.law.motion, grid_spacing(view)) {
            (Motion::Equidistributed { filter: true, .. }, Some(spacing)) => {
                let rate = 0.5 * dt / (viscosity * spacing);
                let resisting = self.scheme.resistance.as_ref();
                let tensions = resisting.map_or(&self.derived.tensions, |resisting| &resisting.tensions);
                let before = |k: usize| tensions[if k == 0 { tensions.len() - 1 } else { k - 1 }];
                self.scheme.filter.apply(markers, geometry, spacing, |k| 0.5 * rate * (tensions[k] + before(k)));
                self.update();
            }
            (Motion::Equidistributed { .. }, _) => {}
            (Motion::WithFluid, _) if *advance != 0.0 => {}
            (Motion::WithFluid, _) => {
                let (inserted, removed) = redistribute(markers, numbers, self.account.spacing, MINIMUM_MARKERS);
                self.account.last = Interventions { inserted, removed, ..self.account.last };
                if inserted + removed > 0 {
                    self.resize(self.markers().len());
                    self.update();
                }
            }
        }
    }

    /// Moves all markers outwards along their normals by `distance` (length).
    fn inflate(&mut self, distance: f64) {
        let Shape { markers, geometry, .. } = &mut self.state.shape;
        for (marker, tau) in markers.iter_mut().zip(&geometry.tangents) {
            *marker += distance * geometry::outward(*tau);
        }
        self.update();
    }

    /// Keeps particle numbers from being negative.
    ///
    /// # Errors
    /// Returns an error for numbers that are not finite or whose sum is negative.
    fn repair_numbers(&mut self) -> Result<(), crate::InterfaceError> {
        if let Some(transport) = &mut self.scheme.transport {
            self.account.last.repair = transport.repair(&mut self.state.numbers)?;
            if self.account.last.repair.segments > 0 {
                self.update_tensions();
            }
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests;

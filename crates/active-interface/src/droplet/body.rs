//! The droplet as a body of a scene.

use std::f64::consts::{PI, TAU};

use ib_core::{
    Body, BodyError, Discretisation, MarkerKind, Vec2, Warning,
    body::{StepInfo, StepLimit, write_points},
    checkpoint::SavedState,
    input::at_least,
};

use super::geometry::{Geometry, equidistribute, motion_rate, outward};
use super::redistribution::redistribute;
use super::shape::Shape;
use super::spectral::SpectralCurve;
use super::{MINIMUM_MARKERS, PECLET_LIMIT, finest_response};
use crate::{
    ActiveDroplet, InterfaceError, Motion,
    concentration::{Repair, Transport, repair_positivity},
    curve::polygon::raw_area,
};

/// Concentrations, in units of the mean one, whose tensions tell a law.
const LAW_SAMPLES: [f64; 10] = [0.0, 0.01, 0.1, 0.5, 1.0, 1.5, 2.0, 3.0, 10.0, 30.0];
/// Least radius of a droplet on a grid, in grid spacings: the speed is then about a per cent off.
const LEAST_RADIUS: f64 = 5.0;
/// Part of all particles in one segment from which on they have collapsed.
const COLLAPSED: f64 = 0.15;

impl From<InterfaceError> for BodyError {
    fn from(error: InterfaceError) -> Self {
        Self::Other(Box::new(error))
    }
}

impl Body for ActiveDroplet {
    fn name(&self) -> &str {
        &self.name
    }

    fn kind(&self) -> MarkerKind {
        let viscosity_inside = self.viscosity_inside;
        match self.motion {
            Motion::Equidistributed { .. } => MarkerKind::Interface { viscosity_inside },
            Motion::WithFluid => MarkerKind::UnevenInterface { viscosity_inside },
        }
    }

    fn marker_count(&self) -> usize {
        self.shape.markers.len()
    }

    fn write_markers(&self, positions: &mut [Vec2]) {
        positions.copy_from_slice(&self.shape.markers);
    }

    fn write_forces(&mut self, discretisation: &Discretisation, forces: &mut [Vec2]) -> Result<(), BodyError> {
        self.fit(discretisation)?;
        let count = self.shape.markers.len();
        let mut before = self.tensions[count - 1] * self.shape.geometry.directions[count - 1];
        for (k, force) in forces.iter_mut().enumerate() {
            let here = self.tensions[k] * self.shape.geometry.directions[k];
            *force = here - before;
            before = here;
        }
        if let Some(spectral) = self.spectral.as_mut() {
            spectral.sharpen(forces);
        }
        Ok(())
    }

    fn state_len(&self) -> usize {
        2 * self.shape.markers.len() + self.numbers.len() + usize::from(self.pool.is_some())
    }

    fn write_state(&self, state: &mut [f64]) {
        let (positions, numbers) = state.split_at_mut(2 * self.shape.markers.len());
        write_points(&self.shape.markers, positions);
        let (on, inside) = numbers.split_at_mut(self.numbers.len());
        on.copy_from_slice(&self.numbers);
        if let (Some(inside), Some(pool)) = (inside.first_mut(), &self.pool) {
            *inside = pool.number;
        }
    }

    fn read_state(&mut self, state: &[f64]) -> Result<(), BodyError> {
        // The count differs from the present one only where a step with insertion is rejected.
        // One more for the particles inside does not change these quotients.
        let count = if self.transport.is_some() { state.len() / 3 } else { state.len() / 2 };
        if let Some(index) = state.iter().position(|value| !value.is_finite()) {
            let what = if index < 2 * count { "marker coordinate" } else { "particle number" };
            return Err(BodyError::NonFinite { what, index, value: state[index] });
        }
        let (positions, numbers) = state.split_at(2 * count);
        self.resize(count);
        if !self.shape.is_at(positions) {
            std::mem::swap(&mut self.shape, &mut self.other);
            self.shape.move_to(positions, self.spectral.as_mut());
        }
        let (on, inside) = numbers.split_at(self.numbers.len());
        self.numbers.copy_from_slice(on);
        if let (Some(pool), Some(&inside)) = (self.pool.as_mut(), inside.first()) {
            pool.number = inside;
        }
        self.update_tensions();
        Ok(())
    }

    fn rate(&mut self, velocities: &[Vec2], rate: &mut [f64]) {
        let count = self.shape.markers.len();
        self.motions.resize(count, Vec2::ZERO);
        self.slip.resize(count, 0.0);
        match self.motion {
            Motion::Equidistributed { relaxation, .. } => {
                if self.transport.is_none() && self.tensions.iter().all(|&tension| tension == 0.0) {
                    self.relaxation = relaxation * motion_rate(&self.shape.geometry, velocities);
                }
                let (relaxation, motions, slip) = (self.relaxation, &mut self.motions, &mut self.slip);
                match self.spectral.as_mut() {
                    Some(curve) => curve.equidistribute(&self.shape.geometry, velocities, relaxation, motions, slip),
                    None => equidistribute(&self.shape.geometry, velocities, relaxation, motions, slip),
                }
            }
            Motion::WithFluid => {
                self.motions.copy_from_slice(velocities);
                self.slip.fill(0.0);
            }
        }
        if let Some((series, modes)) = &mut self.band {
            // As long as the droplet since `fit`.
            let _ = series.truncate_vectors(&mut self.motions, *modes);
        }
        let (positions, numbers) = rate.split_at_mut(2 * count);
        write_points(&self.motions, positions);
        numbers.fill(0.0);
        if let Some(transport) = self.transport.as_mut() {
            let lengths = &self.shape.geometry.lengths;
            let numbers = &mut numbers[..count];
            transport.add_advection(&self.numbers, lengths, &self.slip, numbers);
            // What the stabiliser adds implicitly is subtracted here.
            if self.stabiliser.len() == count {
                transport.add_diffusion(lengths, &self.stabiliser, &self.numbers, -1.0, numbers);
            }
        }
    }

    fn begin_step(&mut self, discretisation: &Discretisation, step: StepInfo) -> Result<(), BodyError> {
        if let Motion::Equidistributed { relaxation, .. } = self.motion {
            self.relaxation = relaxation * self.spacing_rate(discretisation);
        }
        let count = self.shape.markers.len();
        self.fit(discretisation)?;
        self.diffusivities.resize(count, 0.0);
        self.diffusivities.fill(self.diffusion);
        self.stabiliser.clear();
        if self.transport.is_none() || !(self.stabilised && step.stabilised) {
            return Ok(());
        }
        self.stabiliser.resize(count, 0.0);
        let scale = 0.25 * finest_response(discretisation) / self.mean_viscosity(discretisation);
        let stiffness = |c: f64| scale * c * (-self.tension.slope(c)).max(0.0);
        let mut before = stiffness(self.concentrations[count - 1]);
        for ((face, all), &c) in self.stabiliser.iter_mut().zip(&mut self.diffusivities).zip(&self.concentrations) {
            let here = stiffness(c);
            *face = 0.5 * (before + here);
            *all += *face;
            before = here;
        }
        Ok(())
    }

    fn add_implicit(&mut self, state: &[f64], factor: f64, out: &mut [f64]) {
        let (positions, numbers) = state.split_at(2 * self.shape.markers.len());
        let out = &mut out[positions.len()..];
        if let Some(transport) = self.transport.as_mut() {
            let geometry = geometry_at(&self.shape, &mut self.other, self.spectral.as_mut(), positions);
            let (numbers, inside) = numbers.split_at(self.numbers.len());
            let (out, out_inside) = out.split_at_mut(numbers.len());
            transport.add_diffusion(&geometry.lengths, &self.diffusivities, numbers, factor, out);
            if let (Some(pool), [inside], [out_inside]) = (&self.pool, inside, out_inside) {
                *out_inside += pool.add(factor, &geometry.lengths, numbers, *inside, out);
            }
        }
    }

    fn solve_implicit(&mut self, factor: f64, state: &mut [f64]) {
        let (positions, numbers) = state.split_at_mut(2 * self.shape.markers.len());
        if let Some(transport) = self.transport.as_mut() {
            let geometry = geometry_at(&self.shape, &mut self.other, self.spectral.as_mut(), positions);
            let (numbers, inside) = numbers.split_at_mut(self.numbers.len());
            if let (Some(pool), [inside]) = (&self.pool, inside) {
                pool.before(factor, numbers);
                let factor_of_diffusion = pool.diffusion_factor(factor);
                transport.solve_diffusion(&geometry.lengths, &self.diffusivities, factor_of_diffusion, numbers);
                pool.after(factor, &geometry.lengths, numbers, inside);
            } else {
                transport.solve_diffusion(&geometry.lengths, &self.diffusivities, factor, numbers);
            }
        }
    }

    fn end_step(&mut self, discretisation: &Discretisation, dt: f64) -> Result<(), BodyError> {
        match self.motion {
            Motion::Equidistributed { filter: true, .. } => {
                if let Some(spacing) = discretisation.spacing {
                    let rate = 0.5 * dt / (self.mean_viscosity(discretisation) * spacing);
                    let (tensions, count) = (&self.tensions, self.tensions.len());
                    let strength =
                        |k: usize| 0.5 * rate * (tensions[k] + tensions[if k == 0 { count - 1 } else { k - 1 }]);
                    self.filter.apply(&mut self.shape.markers, &self.shape.geometry, spacing, strength);
                    self.update();
                }
            }
            Motion::Equidistributed { .. } => {}
            Motion::WithFluid => {
                let (inserted, removed) =
                    redistribute(&mut self.shape.markers, &mut self.numbers, self.target_spacing, MINIMUM_MARKERS);
                self.last_redistributed = (inserted, removed);
                if inserted + removed > 0 {
                    self.resize(self.shape.markers.len());
                    self.update();
                }
            }
        }
        if self.keeps_area {
            self.restore_area();
        }
        if self.transport.is_some() {
            self.last_repair = repair_positivity(&mut self.numbers)?;
            if self.last_repair.segments > 0 {
                self.update_tensions();
            }
        }
        if let Some((first, second)) = self.crossing.first_crossing(&self.shape.markers)? {
            let place = self.shape.markers[first];
            return Err(BodyError::SelfCrossing { x: place.x, y: place.y, first, second });
        }
        self.check_bounds()
    }

    fn keep_step(&mut self) {
        let (inserted, removed) = std::mem::take(&mut self.last_redistributed);
        self.redistributed.0 += inserted;
        self.redistributed.1 += removed;
        self.repair.accumulate(std::mem::take(&mut self.last_repair));
    }

    fn step_limits(&self, discretisation: &Discretisation, limits: &mut dyn FnMut(StepLimit)) {
        self.limits(discretisation, limits);
    }

    /// The radius of a circle of the same area for positions, the mean for particle numbers.
    fn write_scales(&self, scales: &mut [f64]) {
        let (positions, numbers) = scales.split_at_mut(2 * self.shape.markers.len());
        positions.fill((self.initial_area / PI).sqrt());
        let on = self.numbers.len();
        let positive = |number: f64| if number > 0.0 { number } else { 1.0 };
        let (numbers, inside) = numbers.split_at_mut(on);
        numbers.fill(positive(self.numbers.iter().sum::<f64>() / on.max(1) as f64));
        // Errors inside count as those of as many segments do together.
        inside.fill(positive(self.total_number()));
    }

    /// Viscosity, tension law and diffusion, and the number of markers at the start.
    fn properties(&self) -> Vec<(String, f64)> {
        let mut properties = Vec::new();
        let mut push = |name: &str, value: f64| properties.push((name.to_owned(), value));
        if let Some(viscosity) = self.viscosity_inside {
            push("the viscosity inside", viscosity);
        }
        if self.transport.is_some() {
            push("the diffusion constant", self.diffusion);
        }
        if let Some(pool) = &self.pool {
            push("the rate of binding", pool.exchange.binding());
            push("the rate of unbinding", pool.exchange.unbinding());
        }
        push("the number of markers at the start", self.initial_markers as f64);
        let mean = self.initial_number / (2.0 * (PI * self.initial_area).sqrt());
        for sample in LAW_SAMPLES {
            let name = format!("the tension at {sample} times the mean concentration at the start");
            push(&name, self.tension.value(sample * if mean > 0.0 { mean } else { 1.0 }));
        }
        properties
    }

    fn warnings(&self, discretisation: &Discretisation) -> Vec<Warning> {
        let body = self.name.clone();
        let warning = |cause, excess, message| Warning { body: body.clone(), cause, excess, message };
        let mut warnings = Vec::new();
        if let Some(message) = self.tension.warning() {
            warnings.push(warning("tension without a plateau", f64::INFINITY, message));
        }
        let peclet = self.cell_peclet();
        if peclet > PECLET_LIMIT {
            let spacing = self.shape.geometry.mean_length() * PECLET_LIMIT / peclet;
            let remedy = if spacing > 0.0 {
                format!("use markers (cells) less than {spacing:.2e} apart")
            } else {
                "give the particles a diffusion constant".to_owned()
            };
            let message = format!("the cell Peclet number is {peclet:.2}, above {PECLET_LIMIT}: {remedy}");
            warnings.push(warning("edge of the concentration not resolved", peclet / PECLET_LIMIT, message));
        }
        let radius = self.shape.geometry.perimeter / TAU;
        // Layers do not see the grid.
        let grid = discretisation.spacing.filter(|_| discretisation.shape_modes.is_none());
        if let Some(least) = grid.map(|h| LEAST_RADIUS * h).filter(|least| radius < *least) {
            let message = format!("its radius is {radius:.2e}, below {least:.2e}: use a finer grid");
            warnings.push(warning("droplet not resolved", least / radius, message));
        }
        warnings
    }

    fn save(&self) -> SavedState {
        let Self { target_spacing, initial_area, initial_number, repair, redistributed, .. } = self;
        let mut reals = vec![0.0; self.state_len()];
        self.write_state(&mut reals);
        reals.extend_from_slice(&self.slip);
        reals.extend([*target_spacing, *initial_area, *initial_number, repair.moved, self.relaxation]);
        let counts = [self.shape.markers.len(), repair.segments, repair.furthest, redistributed.0, redistributed.1];
        SavedState { reals, counts: counts.map(|count| count as u64).to_vec() }
    }

    fn load(&mut self, discretisation: &Discretisation, saved: &SavedState) -> Result<(), BodyError> {
        let [count, segments, furthest, inserted, removed] = saved.counts_of()?;
        let per_marker = if self.transport.is_some() { 4 } else { 3 };
        let count = usize::try_from(count).unwrap_or(usize::MAX).min(saved.reals.len());
        at_least("markers of a saved droplet", count, MINIMUM_MARKERS)?;
        let inside = usize::from(self.pool.is_some());
        let (state, rest) =
            saved.reals_of(per_marker * count + 5 + inside)?.split_at((per_marker - 1) * count + inside);
        let (slip, numbers) = rest.split_at(count);
        self.resize(count);
        self.read_state(state)?;
        self.fit(discretisation)?;
        self.slip.copy_from_slice(slip);
        (self.target_spacing, self.initial_area, self.initial_number) = (numbers[0], numbers[1], numbers[2]);
        self.relaxation = numbers[4];
        self.repair = Repair { segments: segments as usize, moved: numbers[3], furthest: furthest as usize };
        self.redistributed = (inserted as usize, removed as usize);
        Ok(())
    }
}

/// The geometry at the marker positions of a state: that of the present shape where it is there, that of the other one
/// where it is not.
fn geometry_at<'a>(
    present: &'a Shape,
    other: &'a mut Shape,
    spectral: Option<&mut SpectralCurve>,
    positions: &[f64],
) -> &'a Geometry {
    if present.is_at(positions) {
        return &present.geometry;
    }
    other.move_to(positions, spectral);
    &other.geometry
}

impl ActiveDroplet {
    /// Area and particles are what they were, and no tension law without a plateau has gathered the particles in a
    /// point.
    fn check_bounds(&self) -> Result<(), BodyError> {
        let total = self.total_number();
        let changes = [
            ("the area", raw_area(&self.shape.markers) / self.initial_area - 1.0),
            ("the number of particles", if total > 0.0 { total / self.initial_number - 1.0 } else { 0.0 }),
        ];
        for ((what, change), bound) in changes.into_iter().zip(self.bounds) {
            if change.is_nan() || change.abs() > bound {
                return Err(BodyError::NotConserved { what, change, bound });
            }
        }
        if total > 0.0 && self.tension.warning().is_some() {
            let most = self.numbers.iter().fold(0.0_f64, |a, &b| a.max(b));
            if most > COLLAPSED * total {
                return Err(InterfaceError::Collapse { part: most / total }.into());
            }
        }
        Ok(())
    }

    /// Makes all lists but those of the shape fit `count` markers.
    fn resize(&mut self, count: usize) {
        if let Some(transport) = &self.transport {
            self.numbers.resize(count, 0.0);
            if transport.len() != count {
                self.transport = Some(Transport::new(count, transport.flux()));
            }
        }
        self.diffusivities.resize(count, self.diffusion);
        self.slip.resize(count, 0.0);
    }

    /// Moves all markers along their normals by the same distance so that the area is the initial one (twice, the
    /// second time for the quadratic part).
    fn restore_area(&mut self) {
        for _ in 0..2 {
            let missing = self.initial_area - raw_area(&self.shape.markers);
            let total: f64 = self.shape.geometry.weights.iter().sum();
            for (marker, tau) in self.shape.markers.iter_mut().zip(&self.shape.geometry.tangents) {
                *marker += missing / total * outward(*tau);
            }
            self.update();
        }
    }
}

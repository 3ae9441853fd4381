//! The interface as a body of a scene.

use std::f64::consts::{PI, TAU};

use motile_base::{Vec2, internal::at_least};
use motile_scene::{
    Body, BodyError, FluidView, MarkerKind, StepInfo, StepLimit, Viscous, Warning, checkpoint::SavedState, points,
};

use super::{
    ActiveInterface, Interventions, MINIMUM_MARKERS, Motion, Shape, geometry::Geometry, geometry::outward, grid_spacing,
};
use crate::{Cortex, InterfaceError, concentration::Repair, curve::polygon::raw_area, field::Felt};

/// Numbers that an interface saves besides its state.
const NUMBERS: usize = 6;
/// Largest displacement by which an interface that does not stretch regains its length, over the length.
const LARGEST_REGAIN: f64 = 1e-3;

/// Error of a random number of particles over the error of their mean: at the tolerance 1e-4 of adaptive steps, a
/// segment's number is followed to a hundredth of its fluctuations.
const RANDOM_ERROR: f64 = 100.0;
/// Multiples of the mean concentration at which the tension is compared to distinguish laws.
const LAW_SAMPLES: [f64; 10] = [0.0, 0.01, 0.1, 0.5, 1.0, 1.5, 2.0, 3.0, 10.0, 30.0];
/// Fraction of all particles in one segment above which they have collapsed: more than the eighth that each segment of
/// the coarsest interface has when all are equal.
const COLLAPSED: f64 = 0.15;

/// Stretch of an elastic interface below which a step is an error.
const LEAST_STRETCH: f64 = 0.1;

impl From<InterfaceError> for BodyError {
    fn from(error: InterfaceError) -> Self {
        Self::Other(Box::new(error))
    }
}

impl Body for ActiveInterface {
    fn name(&self) -> &str {
        &self.name
    }

    fn kind(&self) -> MarkerKind {
        let viscosity_inside = self.law.viscosity_inside;
        match self.law.motion {
            _ if self.advance() != 0.0 => MarkerKind::OpenInterface { viscosity_inside, advance: self.advance() },
            Motion::Equidistributed { .. } => MarkerKind::Interface { viscosity_inside },
            Motion::WithFluid => MarkerKind::UnevenInterface { viscosity_inside },
        }
    }

    fn marker_count(&self) -> usize {
        self.markers().len()
    }

    fn write_markers(&self, positions: &mut [Vec2]) {
        positions.copy_from_slice(self.markers());
    }

    fn write_forces(&mut self, view: &FluidView, forces: &mut [Vec2]) -> Result<(), BodyError> {
        let uneven = self.law.motion == Motion::WithFluid || self.state.shape.axisymmetric;
        if self.law.bending.is_some() && uneven {
            return Err(InterfaceError::uneven_bending().into());
        }
        if let Some(force) = &self.law.body_force {
            force.check(&self.state.shape, view)?;
        }
        if let Some(place) = self.derived.tensions.iter().position(|tension| !tension.is_finite()) {
            let (tension, c) = (self.derived.tensions[place], self.derived.concentrations[place]);
            if let Some(felt) = self.felt.as_ref().filter(|_| self.law.tension.value(c).is_finite()) {
                return Err(InterfaceError::field_not_finite(felt.middles[place]).into());
            }
            return Err(InterfaceError::tension_not_finite(tension, c).into());
        }
        if self.scheme.resistance.is_some() {
            self.check_resistance(view)?;
        }
        self.all_forces(view, forces)?;
        Ok(self.update_resistance(view, self.mean_viscosity(view))?)
    }

    /// Returns two coordinates per marker, and a particle number per segment if there are particles.
    fn state_len(&self) -> usize {
        2 * self.markers().len() + self.state.numbers.len()
    }

    fn write_state(&self, state: &mut [f64]) {
        let (positions, numbers) = state.split_at_mut(2 * self.markers().len());
        points::write(self.markers(), positions);
        numbers.copy_from_slice(&self.state.numbers);
    }

    fn read_state(&mut self, state: &[f64]) -> Result<(), BodyError> {
        // The count differs from the present one only where a step with insertion is rejected.
        let count = state.len() / self.per_marker();
        if let Some(index) = state.iter().position(|value| !value.is_finite()) {
            let what = if index < 2 * count { "marker coordinate" } else { "particle number" };
            return Err(BodyError::NonFinite { what, index, value: state[index] });
        }
        self.take_state(count, state);
        Ok(())
    }

    fn rate(&mut self, velocities: &[Vec2], rate: &mut [f64]) {
        self.write_rate(velocities, rate);
    }

    /// There is none where markers are inserted and removed, which is done in their order, and none of an interface
    /// that is periodic along x, whose inside would change its side.
    fn mirror(&self, markers: &[usize], state: &[f64], image: &mut [f64]) -> bool {
        let (positions, numbers) = state.split_at(2 * markers.len());
        let (positions_of_image, numbers_of_image) = image.split_at_mut(positions.len());
        points::mirror(markers, positions, positions_of_image);
        // Segment k goes from marker k to the next, its image the other way around.
        for (number, first) in numbers.iter().zip(markers.iter().cycle().skip(1)) {
            numbers_of_image[*first] = *number;
        }
        // Noise and fields that differ from their mirror image have none either.
        let size = self.radius_at_start();
        let symmetric = |felt: &Felt| felt.fields.named().all(|(_, field)| field.is_symmetric(size));
        let alike = self.noise.is_none() && self.felt.as_ref().is_none_or(|felt| symmetric(felt));
        alike && matches!(self.law.motion, Motion::Equidistributed { .. }) && self.advance() == 0.0
    }

    fn depends_on_time(&self) -> bool {
        self.noise.is_some() || self.felt.as_ref().is_some_and(|felt| felt.fields.depends_on_time())
    }

    fn set_time(&mut self, time: f64) {
        if let Some(noise) = &mut self.noise {
            noise.time = time;
        }
        if let Some(felt) = self.felt.as_mut().filter(|felt| felt.time != time) {
            felt.time = time;
            if felt.fields.depends_on_time() {
                self.update_tensions();
            }
        }
    }

    fn translate(&self, by: Vec2, state: &mut [f64]) -> bool {
        points::translate(by, &mut state[..2 * self.marker_count()]);
        true
    }

    fn begin_step(&mut self, view: &FluidView, step: StepInfo) -> Result<(), BodyError> {
        self.prepare_step(view, self.mean_viscosity(view), step)?;
        if let Some(noise) = &mut self.noise {
            let (cells, c) = (self.state.shape.geometry.cells(), &self.derived.concentrations);
            noise.draw(step.dt, c, cells, self.law.diffusion);
        }
        Ok(())
    }

    fn add_implicit(&mut self, state: &[f64], factor: f64, out: &mut [f64]) {
        let (positions, numbers) = state.split_at(2 * self.marker_count());
        self.add_bending(positions, factor, out);
        let out = &mut out[positions.len()..];
        if let Some(diffusion) = self.diffusion_at(positions) {
            diffusion.transport.add_diffusion(diffusion.cells, diffusion.diffusivities, numbers, factor, out);
        }
    }

    fn solve_implicit(&mut self, factor: f64, state: &mut [f64]) {
        let (positions, numbers) = state.split_at_mut(2 * self.marker_count());
        self.solve_bending(positions, factor);
        if let Some(diffusion) = self.diffusion_at(positions) {
            diffusion.transport.solve_diffusion(diffusion.cells, diffusion.diffusivities, factor, numbers);
        }
    }

    fn end_step(&mut self, view: &FluidView, dt: f64) -> Result<(), BodyError> {
        self.finish_step(view, dt, 0.0)
    }

    fn keep_step(&mut self) {
        let Interventions { repair, inserted, removed } = std::mem::take(&mut self.account.last);
        self.account.kept.inserted += inserted;
        self.account.kept.removed += removed;
        self.account.kept.repair.accumulate(repair);
    }

    fn step_limits(&self, view: &FluidView, limits: &mut dyn FnMut(StepLimit)) {
        self.add_step_limits(view, self.mean_viscosity(view), limits);
    }

    /// For positions the radius of a circle of the same area, or the inverse of the wave number of a period; for
    /// particle numbers their mean.
    fn write_scales(&self, scales: &mut [f64]) {
        let (positions, numbers) = scales.split_at_mut(2 * self.marker_count());
        let open = self.advance().abs() / TAU;
        positions.fill(if open > 0.0 { open } else { self.radius_at_start() });
        let mean = self.number() / numbers.len().max(1) as f64;
        let random = self.noise.as_ref().map_or(0.0, |all| all.noise.deviation(mean));
        numbers.fill(if mean > 0.0 { mean + RANDOM_ERROR * random } else { 1.0 });
    }

    /// Returns the viscosity, tension law, diffusion and bending, and the number of markers at the start.
    fn properties(&self) -> Vec<(String, f64)> {
        let mut properties = Vec::new();
        let mut push = |name: &str, value: f64| properties.push((name.to_owned(), value));
        if let Some(viscosity) = self.law.viscosity_inside {
            push("the viscosity inside", viscosity);
        }
        if self.carries() {
            push("the diffusion constant", self.diffusion());
        }
        if let Some(elasticity) = &self.law.elasticity {
            let [stretching, bending] = elasticity.moduli();
            push("the stretching modulus", stretching);
            push("the bending modulus", bending);
        }
        if let Some(bending) = &self.law.bending {
            push("the bending modulus", bending.modulus);
            push("the reference curvature", bending.reference);
        }
        let Cortex { viscosity, per_concentration, shear_viscosity, inextensible } = self.law.cortex;
        for (name, value) in [
            ("the viscosity of the cortex", viscosity),
            ("the viscosity of the cortex per concentration", per_concentration),
            ("the shear viscosity of the cortex", shear_viscosity),
            ("the friction with the substrate", self.law.friction),
            ("the viscosity of the film at walls", self.law.wall_film),
            ("the constraint on stretching", f64::from(inextensible)),
        ] {
            if value != 0.0 {
                push(name, value);
            }
        }
        if let Some(force) = &self.law.body_force {
            push("the body force along x", force.density.x);
            push("the body force along y", force.density.y);
            push("the force on the inside along x", force.total.x);
            push("the force on the inside along y", force.total.y);
        }
        push("the number of markers at the start", self.account.markers as f64);
        let period = self.advance().abs();
        if period > 0.0 {
            push("the period", period);
        }
        let mean = self.mean_concentration();
        if let Some(felt) = &self.felt {
            let size = self.radius_at_start().max(self.advance().abs() / TAU);
            let unit = if felt.fields.highest_frequency() > 0.0 { 1.0 / felt.fields.highest_frequency() } else { 1.0 };
            for (name, field) in felt.fields.named() {
                for (number, value) in field.samples(size, unit).enumerate() {
                    push(&format!("the field of the {name} at the sample {number}"), value);
                }
            }
            push("the highest frequency of the fields", felt.fields.highest_frequency());
        }
        if let Some(noise) = &self.noise {
            noise.noise.properties().into_iter().for_each(|(name, value)| push(name, value));
        }
        for sample in LAW_SAMPLES {
            let name = format!("the tension at {sample} times the mean concentration at the start");
            push(&name, self.law.tension.value(sample * if mean > 0.0 { mean } else { 1.0 }));
        }
        properties
    }

    fn as_viscous(&mut self) -> Option<&mut dyn Viscous> {
        if self.scheme.resistance.is_some() { Some(self) } else { None }
    }

    fn warnings(&self, view: &FluidView) -> Vec<Warning> {
        self.doubts(view).map(|doubt| self.warning(doubt)).collect()
    }

    fn save(&self) -> SavedState {
        let Interventions { repair, inserted, removed } = self.account.kept;
        let mut reals = vec![0.0; self.state_len()];
        self.write_state(&mut reals);
        reals.extend_from_slice(&self.derived.slip);
        let account = &self.account;
        reals.extend([account.spacing, account.area, account.number, repair.moved, self.derived.relaxation]);
        reals.push(account.length);
        reals.extend_from_slice(self.stresses());
        let counts = [self.marker_count(), repair.segments, repair.furthest, inserted, removed];
        SavedState { reals, counts: counts.map(|count| count as u64).to_vec() }
    }

    fn load(&mut self, view: &FluidView, saved: &SavedState) -> Result<(), BodyError> {
        let [count, segments, furthest, inserted, removed] = saved.counts_of()?;
        let per_marker = self.per_marker() + 1;
        let count = usize::try_from(count).unwrap_or(usize::MAX).min(saved.reals.len());
        at_least("markers of a saved interface", count, MINIMUM_MARKERS)?;
        // Stresses come last: another interface may have had others, or none.
        let own = per_marker * count + NUMBERS;
        let others = [0, count, 2 * count, 3 * count, 2 * (count / 2 + 1)].map(|stresses| own + stresses);
        let found = if others.contains(&saved.reals.len()) { saved.reals.len() } else { own };
        let (state, rest) = saved.reals_of(found)?.split_at((per_marker - 1) * count);
        let (slip, numbers) = rest.split_at(count);
        self.read_state(state)?;
        self.fit(view)?;
        if self.scheme.resistance.is_some() {
            self.fit_resistance()?;
            self.set_stresses(&numbers[NUMBERS..]);
        }
        self.derived.slip.copy_from_slice(slip);
        self.derived.relaxation = numbers[4];
        let account = &mut self.account;
        (account.spacing, account.area, account.number) = (numbers[0], numbers[1], numbers[2]);
        account.length = numbers[5];
        let repair = Repair { segments: segments as usize, moved: numbers[3], furthest: furthest as usize };
        account.kept = Interventions { repair, inserted: inserted as usize, removed: removed as usize };
        Ok(())
    }
}

impl ActiveInterface {
    /// Adds `factor` times the implicit decay by bending to the positions `out`.
    fn add_bending(&mut self, positions: &[f64], factor: f64, out: &mut [f64]) {
        let advance = self.advance();
        if let Some(bending) = &mut self.law.bending {
            bending.stabiliser.add(positions, advance, factor, &mut out[..positions.len()]);
        }
    }

    /// Solves for positions whose short waves decay by bending over the time `factor`.
    pub(crate) fn solve_bending(&mut self, positions: &mut [f64], factor: f64) {
        let advance = self.advance();
        if let Some(bending) = &mut self.law.bending {
            bending.stabiliser.solve(positions, advance, factor);
        }
    }

    /// Returns the entries of the state for a marker.
    pub(crate) fn per_marker(&self) -> usize {
        if self.carries() { 3 } else { 2 }
    }

    /// Refuses a cortex and friction where they have no meaning.
    fn check_resistance(&self, view: &FluidView) -> Result<(), InterfaceError> {
        if self.state.shape.axisymmetric && self.has_friction() {
            return Err(InterfaceError::resisting_revolution());
        }
        if self.law.wall_film > 0.0 && view.domain.walls.is_none() {
            return Err(InterfaceError::no_walls_to_rub());
        }
        if let Some((field, time)) =
            self.felt.as_ref().and_then(|felt| Some((felt.fields.friction.as_ref()?, felt.time)))
        {
            let friction = |place: &Vec2| (self.law.friction + field.value(*place, time), *place);
            let bad = self.markers().iter().map(friction).find(|(value, _)| !(*value >= 0.0 && value.is_finite()));
            if let Some((value, place)) = bad {
                return Err(InterfaceError::negative_friction(value, place));
            }
        }
        if self.law.cortex.inextensible && grid_spacing(view).is_some() {
            return Err(InterfaceError::unresolved_membrane());
        }
        // Without the mobility correction markers move too easily by as much as the kernel is wide.
        let corrected = view.second_order && self.law.motion != Motion::WithFluid;
        if !self.law.cortex.is_none() && grid_spacing(view).is_some() && !corrected {
            return Err(InterfaceError::cortex_on_plain_grid());
        }
        Ok(())
    }

    /// Returns the mean of the viscosities on both sides, on which the speed of an interface depends (stress times
    /// time).
    fn mean_viscosity(&self, view: &FluidView) -> f64 {
        self.law.viscosity_inside.map_or(view.viscosity, |inside| 0.5 * (inside + view.viscosity))
    }

    /// Returns a doubt, as cause, excess and message, as a warning of this body.
    pub(crate) fn warning(&self, (cause, excess, message): (&'static str, f64, String)) -> Warning {
        Warning { body: self.name.clone(), cause: cause.into(), excess, message }
    }

    /// Ends a step of length `dt` (time): markers, area, particle numbers, checks. `elsewhere` particles belong to the
    /// interface that are not on it.
    pub(crate) fn finish_step(&mut self, view: &FluidView, dt: f64, elsewhere: f64) -> Result<(), BodyError> {
        self.move_markers(view, self.mean_viscosity(view), dt);
        if self.law.cortex.inextensible {
            self.restore_length();
        }
        if self.law.keeps_area {
            self.restore_area();
        }
        self.repair_numbers()?;
        if let Some((first, second)) = self.crossing.first_crossing_over(&self.state.shape.markers, self.advance())? {
            let place = self.markers()[first];
            return Err(BodyError::SelfCrossing { x: place.x, y: place.y, first, second });
        }
        self.check_bounds(elsewhere)?;
        self.check_stretch()
    }

    /// Returns the present area (length squared), as [`ActiveInterface::initial_area`]: of the polygon if it is closed,
    /// unless the area of the smooth curve is held, else of the curve through the markers. For a body of revolution, it
    /// is the volume (length cubed).
    pub(crate) fn area(&self) -> f64 {
        if self.state.shape.axisymmetric {
            return self.geometry().volume(self.markers());
        }
        let Geometry { tangents, weights, .. } = self.geometry();
        if self.advance() == 0.0 {
            return if self.keeps_smooth_area() { self.smooth_area() } else { raw_area(self.markers()) };
        }
        let columns = self.markers().iter().zip(tangents).zip(weights);
        -columns.map(|((marker, tangent), weight)| marker.y * tangent.x * weight).sum::<f64>()
    }

    /// Returns the area inside a closed curve through the markers (length squared): of the smooth curve if there is
    /// one, else of the polygon.
    pub(crate) fn smooth_area(&self) -> f64 {
        if self.scheme.spectral.is_none() {
            return raw_area(self.markers());
        }
        let Geometry { tangents, weights, .. } = self.geometry();
        let first = self.markers()[0];
        let sectors = self.markers().iter().zip(tangents).zip(weights);
        0.5 * sectors.map(|((x, tau), weight)| weight * (*x - first).dot(outward(*tau))).sum::<f64>()
    }

    /// Returns true for a closed smooth curve whose area is restored after each step. It is the area of the polygon
    /// through as many markers changes with the shape.
    pub(super) fn keeps_smooth_area(&self) -> bool {
        self.law.keeps_area && self.scheme.spectral.is_some() && self.advance() == 0.0
    }

    /// Checks that area and particles are conserved, and that no tension law without a plateau has gathered the
    /// particles in a point.
    fn check_bounds(&self, elsewhere: f64) -> Result<(), BodyError> {
        let total = self.number() + elsewhere;
        let area = self.area();
        let change = match self.advance() {
            0.0 => area / self.account.area - 1.0,
            period => (area - self.account.area) / (period * period),
        };
        let changes = [
            (if self.state.shape.axisymmetric { "the volume" } else { "the area" }, change),
            ("the number of particles", if total > 0.0 { total / self.account.number - 1.0 } else { 0.0 }),
        ];
        for ((what, change), bound) in changes.into_iter().zip(self.account.bounds) {
            if change.is_nan() || change.abs() > bound {
                return Err(BodyError::NotConserved { what, change, bound });
            }
        }
        if total > 0.0 {
            let most = self.particle_numbers().iter().fold(0.0_f64, |a, &b| a.max(b));
            if most > COLLAPSED * total && self.collapse().is_some() {
                return Err(InterfaceError::Collapse { part: most / total }.into());
            }
        }
        Ok(())
    }

    /// Refuses an elastic interface that is compressed to nearly nothing: stable steps fall with the fourth power of
    /// the stretch, so that a run would stand still without an end.
    fn check_stretch(&mut self) -> Result<(), BodyError> {
        let advance = Vec2::new(self.advance(), 0.0);
        let (Some(elasticity), markers) = (&mut self.law.elasticity, &self.state.shape.markers) else {
            return Ok(());
        };
        elasticity.move_to(markers, advance)?;
        let stretches = elasticity.strains().map(|[stretch, _]| stretch).zip(markers);
        let least =
            stretches.fold(
                (f64::INFINITY, Vec2::ZERO),
                |least, (stretch, place)| {
                    if stretch < least.0 { (stretch, *place) } else { least }
                },
            );
        let (stretch, place) = least;
        if stretch < LEAST_STRETCH {
            return Err(InterfaceError::crushed(stretch, LEAST_STRETCH, place).into());
        }
        Ok(())
    }

    /// Returns the radius of the circle or sphere of the size at the start (length).
    pub(super) fn radius_at_start(&self) -> f64 {
        let size = self.account.area / PI;
        if self.state.shape.axisymmetric { (0.75 * size).cbrt() } else { size.sqrt() }
    }

    /// Moves the markers along their normals in proportion to the curvature minus its mean, so that the length is the
    /// initial one and the area stays. The constraint on velocities leaves errors of the time step.
    fn restore_length(&mut self) {
        let closed = self.advance() == 0.0;
        let Shape { geometry, markers, .. } = &mut self.state.shape;
        if closed && geometry.is_round() {
            return;
        }
        let (count, length) = (markers.len(), geometry.total_weight());
        let missing = self.account.length - length;
        let mean = if closed { TAU / length } else { 0.0 };
        let deviation = |k: usize| geometry.curvature_from(mean, k);
        let square: f64 = (0..count).map(|k| deviation(k).powi(2) * geometry.weights[k]).sum();
        let step = missing / square;
        let largest = (0..count).map(|k| deviation(k).abs()).fold(0.0, f64::max) * step.abs();
        if largest.is_nan() || largest > LARGEST_REGAIN * length {
            return;
        }
        for (k, marker) in markers.iter_mut().enumerate() {
            *marker += deviation(k) * step * outward(geometry.tangents[k]);
        }
        self.update();
    }

    /// Moves all markers along their normals by one distance so that the area is the initial one (twice, the second
    /// time for the quadratic part), or scales a body of revolution to its volume. This adds no waves that the flow
    /// does not see, and keeps equal spacing.
    fn restore_area(&mut self) {
        if self.state.shape.axisymmetric {
            let factor = (self.account.area / self.area()).cbrt();
            let markers = &mut self.state.shape.markers;
            let middle = 0.5 * (markers[0] + markers[markers.len() / 2]);
            markers.iter_mut().for_each(|marker| *marker = middle + factor * (*marker - middle));
            return self.update();
        }
        for _ in 0..2 {
            let missing = self.account.area - self.area();
            let total = self.geometry().total_weight();
            self.inflate(missing / total);
        }
    }
}

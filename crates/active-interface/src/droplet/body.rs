//! The droplet as a body of a scene.

use std::f64::consts::{PI, TAU};

use motile_base::{Vec2, at_least, told_apart};
use motile_scene::{
    Body, BodyError, BodyFlow, FluidView, MarkerKind, Observe, StepInfo, StepLimit, Warning, checkpoint::SavedState,
    points,
};

use super::{Account, Inside, MINIMUM_MARKERS, stresslet_error::StressletError};
use crate::{
    ActiveDroplet, InterfaceError, Motion,
    concentration::Repair,
    curve::polygon::raw_area,
    interface::{Interventions, grid_spacing},
    observables::{Convention, InterfaceState, Observables, observe},
};

/// Multiples of the mean concentration at which the tension is compared to tell one law from another.
const LAW_SAMPLES: [f64; 10] = [0.0, 0.01, 0.1, 0.5, 1.0, 1.5, 2.0, 3.0, 10.0, 30.0];
/// Least radius of a droplet on a grid, in grid spacings: the speed is then about a per cent off.
const LEAST_RADIUS: f64 = 5.0;
/// Part of all particles in one segment above which they have collapsed: more than the eighth that each segment of the
/// coarsest interface has when all are equal.
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
        let viscosity_inside = self.inside.viscosity;
        match self.interface.law.motion {
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
        Ok(self.interface.write_forces(view, forces)?)
    }

    fn state_len(&self) -> usize {
        self.interface.state_len() + usize::from(self.inside.pool.is_some())
    }

    fn write_state(&self, state: &mut [f64]) {
        let (interface, inside) = state.split_at_mut(self.interface.state_len());
        self.interface.write_state(interface);
        if let (Some(inside), Some(pool)) = (inside.first_mut(), &self.inside.pool) {
            *inside = pool.number;
        }
    }

    fn read_state(&mut self, state: &[f64]) -> Result<(), BodyError> {
        // The count differs from the present one only where a step with insertion is rejected. The entry for the
        // particles inside does not change the quotient.
        let per_marker = if self.interface.carries() { 3 } else { 2 };
        let count = state.len() / per_marker;
        if let Some(index) = state.iter().position(|value| !value.is_finite()) {
            let what = if index < 2 * count { "marker coordinate" } else { "particle number" };
            return Err(BodyError::NonFinite { what, index, value: state[index] });
        }
        let (interface, inside) = state.split_at(per_marker * count);
        self.interface.read_state(count, interface);
        if let (Some(pool), Some(&inside)) = (self.inside.pool.as_mut(), inside.first()) {
            pool.number = inside;
        }
        Ok(())
    }

    fn rate(&mut self, velocities: &[Vec2], rate: &mut [f64]) {
        self.interface.write_rate(velocities, rate);
    }

    /// There is none where markers are inserted and removed, which is done in their order.
    fn mirror(&self, markers: &[usize], state: &[f64], image: &mut [f64]) -> bool {
        let (positions, rest) = state.split_at(2 * markers.len());
        let (positions_of_image, rest_of_image) = image.split_at_mut(positions.len());
        points::mirror(markers, positions, positions_of_image);
        let (numbers, inside) = rest.split_at(self.particle_numbers().len());
        // Segment k goes from marker k to the next, its image the other way around.
        for (number, first) in numbers.iter().zip(markers.iter().cycle().skip(1)) {
            rest_of_image[*first] = *number;
        }
        rest_of_image[numbers.len()..].copy_from_slice(inside);
        matches!(self.interface.law.motion, Motion::Equidistributed { .. })
    }

    fn begin_step(&mut self, view: &FluidView, step: StepInfo) -> Result<(), BodyError> {
        let viscosity = self.mean_viscosity(view);
        Ok(self.interface.begin_step(view, viscosity, step.stabilised)?)
    }

    fn add_implicit(&mut self, state: &[f64], factor: f64, out: &mut [f64]) {
        let (positions, numbers) = state.split_at(2 * self.marker_count());
        let out = &mut out[positions.len()..];
        if let Some(diffusion) = self.interface.diffusion_at(positions) {
            let (numbers, inside) = numbers.split_at(diffusion.lengths.len());
            let (out, out_inside) = out.split_at_mut(numbers.len());
            diffusion.transport.add_diffusion(diffusion.lengths, diffusion.diffusivities, numbers, factor, out);
            if let (Some(pool), [inside], [out_inside]) = (&self.inside.pool, inside, out_inside) {
                *out_inside += pool.add(factor, diffusion.lengths, numbers, *inside, out);
            }
        }
    }

    fn solve_implicit(&mut self, factor: f64, state: &mut [f64]) {
        let (positions, numbers) = state.split_at_mut(2 * self.marker_count());
        if let Some(diffusion) = self.interface.diffusion_at(positions) {
            let (numbers, inside) = numbers.split_at_mut(diffusion.lengths.len());
            let (lengths, diffusivities) = (diffusion.lengths, diffusion.diffusivities);
            let mut diffuse = |factor: f64, numbers: &mut [f64]| {
                diffusion.transport.solve_diffusion(lengths, diffusivities, factor, numbers);
            };
            match (&self.inside.pool, inside) {
                (Some(pool), [inside]) => pool.solve(factor, lengths, numbers, inside, diffuse),
                _ => diffuse(factor, numbers),
            }
        }
    }

    fn end_step(&mut self, view: &FluidView, dt: f64) -> Result<(), BodyError> {
        let viscosity = self.mean_viscosity(view);
        self.interface.move_markers(view, viscosity, dt);
        if self.inside.keeps_area {
            self.restore_area();
        }
        self.interface.repair()?;
        if let Some((first, second)) = self.crossing.first_crossing(self.interface.markers())? {
            let place = self.markers()[first];
            return Err(BodyError::SelfCrossing { x: place.x, y: place.y, first, second });
        }
        self.check_bounds()
    }

    fn keep_step(&mut self) {
        self.interface.keep_step();
    }

    fn step_limits(&self, view: &FluidView, limits: &mut dyn FnMut(StepLimit)) {
        self.interface.step_limits(view, self.mean_viscosity(view), limits);
    }

    /// The radius of a circle of the same area for positions; for particle numbers their mean, and for the number
    /// inside that of all particles, so that an error inside counts as the same error of all segments together does.
    fn write_scales(&self, scales: &mut [f64]) {
        let (positions, numbers) = scales.split_at_mut(2 * self.marker_count());
        positions.fill((self.account.area / PI).sqrt());
        let on = self.particle_numbers().len();
        let positive = |number: f64| if number > 0.0 { number } else { 1.0 };
        let (numbers, inside) = numbers.split_at_mut(on);
        numbers.fill(positive(self.interface.number() / on.max(1) as f64));
        inside.fill(positive(self.total_number()));
    }

    /// Viscosity, tension law and diffusion, and the number of markers at the start.
    fn properties(&self) -> Vec<(String, f64)> {
        let Account { markers, area, number, .. } = self.account;
        let mut properties = Vec::new();
        let mut push = |name: &str, value: f64| properties.push((name.to_owned(), value));
        if let Some(viscosity) = self.inside.viscosity {
            push("the viscosity inside", viscosity);
        }
        if self.interface.carries() {
            push("the diffusion constant", self.diffusion());
        }
        if let Some(pool) = &self.inside.pool {
            push("the rate of binding", pool.exchange.binding());
            push("the rate of unbinding", pool.exchange.unbinding());
        }
        push("the number of markers at the start", markers as f64);
        let mean = number / (2.0 * (PI * area).sqrt());
        for sample in LAW_SAMPLES {
            let name = format!("the tension at {sample} times the mean concentration at the start");
            push(&name, self.interface.law.tension.value(sample * if mean > 0.0 { mean } else { 1.0 }));
        }
        properties
    }

    fn warnings(&self, view: &FluidView) -> Vec<Warning> {
        let radius = self.interface.geometry().perimeter / TAU;
        let least = grid_spacing(view).map(|h| LEAST_RADIUS * h).filter(|least| radius < *least);
        let coarse = least.map(|least| {
            let [text, least_text] = told_apart([radius, least]);
            let message = format!(
                "its radius is {text} (length), below {least_text}, {LEAST_RADIUS} grid spacings: its speed may be off \
                 by a per cent and more; use a spacing of {:.2e} or less",
                radius / LEAST_RADIUS
            );
            ("droplet not resolved", least / radius, message)
        });
        let stresslet = self.stresslet_error(view).filter(|found| found.excess > 1.0).map(|found| {
            let StressletError { magnitude, error, excess } = found;
            let message = format!(
                "its stresslet, {magnitude:.2e}, may err by {error:.1e} (force times length): use a finer grid, or \
                 boundary integrals"
            );
            ("stresslet not resolved", excess, message)
        });
        let warning = |(cause, excess, message): (&'static str, f64, String)| {
            let (body, cause) = (self.name.clone(), cause.into());
            Warning { body, cause, excess, message }
        };
        self.interface.warnings(view).chain(coarse).chain(stresslet).map(warning).collect()
    }

    fn save(&self) -> SavedState {
        let account = &self.interface.account;
        let Interventions { repair, inserted, removed } = account.kept;
        let mut reals = vec![0.0; self.state_len()];
        self.write_state(&mut reals);
        let derived = &self.interface.derived;
        reals.extend_from_slice(&derived.slip);
        let Account { area, number, .. } = self.account;
        reals.extend([account.spacing, area, number, repair.moved, derived.relaxation]);
        let counts = [self.marker_count(), repair.segments, repair.furthest, inserted, removed];
        SavedState { reals, counts: counts.map(|count| count as u64).to_vec() }
    }

    fn load(&mut self, view: &FluidView, saved: &SavedState) -> Result<(), BodyError> {
        let [count, segments, furthest, inserted, removed] = saved.counts_of()?;
        let per_marker = if self.interface.carries() { 4 } else { 3 };
        let count = usize::try_from(count).unwrap_or(usize::MAX).min(saved.reals.len());
        at_least("markers of a saved droplet", count, MINIMUM_MARKERS)?;
        let inside = usize::from(self.inside.pool.is_some());
        let (state, rest) =
            saved.reals_of(per_marker * count + 5 + inside)?.split_at((per_marker - 1) * count + inside);
        let (slip, numbers) = rest.split_at(count);
        self.read_state(state)?;
        self.interface.fit(view)?;
        self.interface.derived.slip.copy_from_slice(slip);
        self.interface.derived.relaxation = numbers[4];
        (self.account.area, self.account.number) = (numbers[1], numbers[2]);
        let repair = Repair { segments: segments as usize, moved: numbers[3], furthest: furthest as usize };
        let account = &mut self.interface.account;
        account.spacing = numbers[0];
        account.kept = Interventions { repair, inserted: inserted as usize, removed: removed as usize };
        Ok(())
    }
}

impl ActiveDroplet {
    /// Mean of the viscosities on both sides, on which the speed of an interface depends (stress times time).
    fn mean_viscosity(&self, view: &FluidView) -> f64 {
        let Inside { viscosity, .. } = self.inside;
        viscosity.map_or(view.viscosity, |inside| 0.5 * (inside + view.viscosity))
    }

    /// Checks that area and particles are conserved, and that no tension law without a plateau has gathered the
    /// particles in a point.
    fn check_bounds(&self) -> Result<(), BodyError> {
        let total = self.total_number();
        let changes = [
            ("the area", raw_area(self.markers()) / self.account.area - 1.0),
            ("the number of particles", if total > 0.0 { total / self.account.number - 1.0 } else { 0.0 }),
        ];
        for ((what, change), bound) in changes.into_iter().zip(self.account.bounds) {
            if change.is_nan() || change.abs() > bound {
                return Err(BodyError::NotConserved { what, change, bound });
            }
        }
        if total > 0.0 && self.interface.law.tension.warning().is_some() {
            let most = self.particle_numbers().iter().fold(0.0_f64, |a, &b| a.max(b));
            if most > COLLAPSED * total {
                return Err(InterfaceError::Collapse { part: most / total }.into());
            }
        }
        Ok(())
    }

    /// Moves all markers along their normals by one distance so that the area is the initial one (twice, the second
    /// time for the quadratic part).
    fn restore_area(&mut self) {
        for _ in 0..2 {
            let missing = self.account.area - raw_area(self.markers());
            let total: f64 = self.interface.geometry().weights.iter().sum();
            self.interface.inflate(missing / total);
        }
    }
}

impl Observe for ActiveDroplet {
    type Observables = Observables;

    /// All observables ([`observe`]) in the far-field convention; for another one see [`InterfaceState::of`].
    fn observables(&self, view: &FluidView, flow: &BodyFlow<'_>) -> Result<Observables, BodyError> {
        Ok(observe(&InterfaceState::new(self, view, flow), Convention::FarField)?)
    }
}

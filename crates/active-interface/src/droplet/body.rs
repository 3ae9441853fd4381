//! The droplet as a body of a scene: its interface, and the particles inside.

use std::f64::consts::TAU;

use motile_base::{Vec2, internal::told_apart};
use motile_scene::{
    Body, BodyError, BodyFlow, FluidView, MarkerKind, Observe, StepInfo, StepLimit, Viscous, Warning,
    checkpoint::SavedState,
};

use super::stresslet_error::StressletError;
use crate::{
    ActiveDroplet, ActiveInterface,
    interface::{Diffusion, grid_spacing},
    observables::{Convention, InterfaceState, Observables, observe},
};

/// Minimum radius of a droplet on a grid, in grid spacings: the speed is then off by about 1 %.
const LEAST_RADIUS: f64 = 5.0;

impl Body for ActiveDroplet {
    fn name(&self) -> &str {
        self.interface.name()
    }

    fn kind(&self) -> MarkerKind {
        self.interface.kind()
    }

    fn marker_count(&self) -> usize {
        self.interface.marker_count()
    }

    fn write_markers(&self, positions: &mut [Vec2]) {
        self.interface.write_markers(positions);
    }

    fn write_forces(&mut self, view: &FluidView, forces: &mut [Vec2]) -> Result<(), BodyError> {
        if let (Some(base), Some(felt)) = (self.felt_rates(), &self.interface.felt) {
            felt.check_rates(base)?;
        }
        self.interface.write_forces(view, forces)
    }

    fn state_len(&self) -> usize {
        self.interface.state_len() + usize::from(self.pool.is_some())
    }

    fn write_state(&self, state: &mut [f64]) {
        let (interface, inside) = state.split_at_mut(self.interface.state_len());
        self.interface.write_state(interface);
        if let (Some(inside), Some(pool)) = (inside.first_mut(), &self.pool) {
            *inside = pool.number;
        }
    }

    fn read_state(&mut self, state: &[f64]) -> Result<(), BodyError> {
        // Markers may have been inserted or removed.
        let (interface, inside) = state.split_at(state.len() - usize::from(self.pool.is_some()));
        self.interface.read_state(interface)?;
        if let (Some(pool), Some(&value)) = (self.pool.as_mut(), inside.first()) {
            if !value.is_finite() {
                return Err(BodyError::NonFinite { what: "particle number", index: interface.len(), value });
            }
            pool.number = value;
        }
        Ok(())
    }

    fn rate(&mut self, velocities: &[Vec2], rate: &mut [f64]) {
        self.interface.rate(velocities, rate);
        if let (Some(noise), Some(inside)) =
            (&self.interface.noise, rate[self.interface.state_len()..].first_mut().filter(|_| self.pool.is_some()))
        {
            *inside += noise.inside;
        }
    }

    fn depends_on_time(&self) -> bool {
        self.interface.depends_on_time()
    }

    fn set_time(&mut self, time: f64) {
        self.interface.set_time(time);
    }

    fn mirror(&self, markers: &[usize], state: &[f64], image: &mut [f64]) -> bool {
        let (interface, inside) = state.split_at(self.interface.state_len());
        let (interface_of_image, inside_of_image) = image.split_at_mut(interface.len());
        inside_of_image.copy_from_slice(inside);
        self.interface.mirror(markers, interface, interface_of_image)
    }

    fn translate(&self, by: Vec2, state: &mut [f64]) -> bool {
        self.interface.translate(by, state)
    }

    fn begin_step(&mut self, view: &FluidView, step: StepInfo) -> Result<(), BodyError> {
        self.interface.begin_step(view, step)?;
        self.draw_exchange(step.dt);
        Ok(())
    }

    fn add_implicit(&mut self, state: &[f64], factor: f64, out: &mut [f64]) {
        let (state, inside) = state.split_at(self.interface.state_len());
        let (out, out_inside) = out.split_at_mut(state.len());
        self.interface.add_implicit(state, factor, out);
        let (positions, numbers) = state.split_at(2 * self.interface.marker_count());
        if let Some(base) = self.felt_rates() {
            let (Some(pool), [inside], [out_inside]) = (&self.pool, inside, out_inside) else { return };
            let Some(mut felt) = self.interface.felt.take() else { return };
            if let Some(Diffusion { cells, .. }) = self.interface.diffusion_at(positions) {
                let (rates, _) = felt.rates(positions, base);
                let out = &mut out[positions.len()..];
                *out_inside += pool.add_at(rates, factor, cells.sizes, numbers, *inside, out);
            }
            self.interface.felt = Some(felt);
            return;
        }
        if let (Some(pool), [inside], [out_inside]) = (&self.pool, inside, out_inside)
            && let Some(diffusion) = self.interface.diffusion_at(positions)
        {
            *out_inside += pool.add(factor, diffusion.cells.sizes, numbers, *inside, &mut out[positions.len()..]);
        }
    }

    fn solve_implicit(&mut self, factor: f64, state: &mut [f64]) {
        let (state, inside) = state.split_at_mut(self.interface.state_len());
        let (Some(pool), [inside]) = (&self.pool, inside) else {
            return self.interface.solve_implicit(factor, state);
        };
        let (positions, numbers) = state.split_at_mut(2 * self.interface.marker_count());
        self.interface.solve_bending(positions, factor);
        if let Some(base) = self.felt_rates() {
            let (Some(pool), Some(mut felt)) = (&self.pool, self.interface.felt.take()) else { return };
            if let Some(Diffusion { transport, cells, diffusivities }) = self.interface.diffusion_at(positions) {
                let rates = felt.rates(positions, base);
                pool.solve_at(rates, factor, cells.sizes, numbers, inside, |losses, numbers| {
                    transport.solve_loss(cells, diffusivities, factor, losses, numbers);
                });
            }
            self.interface.felt = Some(felt);
            return;
        }
        if let Some(diffusion) = self.interface.diffusion_at(positions) {
            let (cells, diffusivities) = (diffusion.cells, diffusion.diffusivities);
            pool.solve(factor, cells.sizes, numbers, inside, |factor, numbers| {
                diffusion.transport.solve_diffusion(cells, diffusivities, factor, numbers);
            });
        }
    }

    fn end_step(&mut self, view: &FluidView, dt: f64) -> Result<(), BodyError> {
        let inside = self.pool.map_or(0.0, |pool| pool.number);
        self.interface.finish_step(view, dt, inside)
    }

    fn keep_step(&mut self) {
        self.interface.keep_step();
    }

    fn step_limits(&self, view: &FluidView, limits: &mut dyn FnMut(StepLimit)) {
        self.interface.step_limits(view, limits);
    }

    /// For the number inside, the error of the number of all particles, so that an error inside counts as the same
    /// error of all segments together does.
    fn write_scales(&self, scales: &mut [f64]) {
        let (interface, inside) = scales.split_at_mut(self.interface.state_len());
        self.interface.write_scales(interface);
        let total = self.total_number();
        inside.fill(if total > 0.0 { total } else { 1.0 });
    }

    fn properties(&self) -> Vec<(String, f64)> {
        let mut properties = self.interface.properties();
        if let Some(pool) = &self.pool {
            properties.push(("the rate of binding".to_owned(), pool.exchange.binding()));
            properties.push(("the rate of unbinding".to_owned(), pool.exchange.unbinding()));
        }
        properties
    }

    fn as_viscous(&mut self) -> Option<&mut dyn Viscous> {
        self.interface.as_viscous()
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
            let remedy = match (view.spacing, view.shape_modes) {
                (Some(_), None) => "a finer grid, or boundary integrals",
                (Some(_), Some(_)) => "a smaller grid spacing, or more nodes and elements",
                _ => "more nodes and elements",
            };
            let message =
                format!("its stresslet, {magnitude:.2e}, may be off by {error:.1e} (force times length). Use {remedy}");
            ("stresslet not resolved", excess, message)
        });
        let own = coarse.into_iter().chain(stresslet).map(|doubt| self.interface.warning(doubt));
        Body::warnings(&self.interface, view).into_iter().chain(own).collect()
    }

    /// Returns the saved state of the interface, the number inside after its state.
    fn save(&self) -> SavedState {
        let mut saved = self.interface.save();
        if let Some(pool) = &self.pool {
            saved.reals.insert(self.interface.state_len(), pool.number);
        }
        saved
    }

    fn load(&mut self, view: &FluidView, saved: &SavedState) -> Result<(), BodyError> {
        let Some(pool) = self.pool.as_mut() else { return self.interface.load(view, saved) };
        let count = saved.counts.first().map_or(0, |&count| usize::try_from(count).unwrap_or(usize::MAX));
        let place = count.saturating_mul(self.interface.per_marker());
        let mut saved = saved.clone();
        if place < saved.reals.len() {
            let value = saved.reals.remove(place);
            if !value.is_finite() {
                return Err(BodyError::NonFinite { what: "particle number", index: place, value });
            }
            pool.number = value;
        }
        self.interface.load(view, &saved)
    }
}

impl ActiveDroplet {
    /// Draws the noise of binding and unbinding over a step of `dt` (time).
    fn draw_exchange(&mut self, dt: f64) {
        let base = self.felt_rates();
        let (Some(pool), ActiveInterface { noise: Some(noise), state, felt, .. }) = (&self.pool, &mut self.interface)
        else {
            return;
        };
        let lengths = state.shape.geometry.cells().sizes;
        let time = noise.time;
        let exchange = pool.exchange;
        let bound = pool.number.max(0.0) / pool.area();
        let sizes = lengths.iter().zip(&state.numbers).enumerate().map(|(k, (length, number))| {
            let mut rates = [exchange.binding(), exchange.unbinding()];
            if let (Some(_), Some(felt)) = (base, &felt) {
                for (rate, field) in rates.iter_mut().zip([&felt.fields.binding, &felt.fields.unbinding]) {
                    let field = field.as_ref().map_or(0.0, |field| field.value(felt.middles[k], time));
                    *rate = (*rate + field).max(0.0);
                }
            }
            rates[0] * length * bound + rates[1] * number.max(0.0)
        });
        noise.draw_exchange(dt, sizes);
    }
}

impl Observe for ActiveDroplet {
    type Observables = Observables;

    /// Returns all observables ([`observe`]) in the far-field convention; for another one see [`InterfaceState::of`].
    fn observables(&self, view: &FluidView, flow: &BodyFlow<'_>) -> Result<Observables, BodyError> {
        Ok(observe(&InterfaceState::new(self, view, flow), Convention::FarField)?)
    }
}

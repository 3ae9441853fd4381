//! The state of all bodies and its rate of change.

use motile_base::Vec2;

use super::{
    System,
    bodies::{failure, part},
    parts::{Parts, states},
};
use crate::{Body, Handle, Hydrodynamics, SceneError, integrator::Dynamics};

impl<H: Hydrodynamics> Dynamics for System<H> {
    fn state_len(&self) -> usize {
        self.bodies.list.iter().map(|body| body.state_len()).sum::<usize>() + self.clock_len()
    }

    fn write_state(&self, state: &mut Vec<f64>) {
        state.resize(self.state_len(), 0.0);
        let mut rest = state.as_mut_slice();
        self.bodies.list.iter().for_each(|body| body.write_state(part(&mut rest, body.as_ref())));
        self.write_clock(rest);
    }

    fn read_state(&mut self, state: &[f64]) -> Result<(), SceneError> {
        self.forget_flow();
        let (bodies, clock) = state.split_at(state.len().saturating_sub(self.clock_len()));
        self.bodies.read_state(self.clock.time, bodies, &states)?;
        self.read_clock(clock)
    }

    fn rate(&mut self, state: &[f64], rate: &mut [f64]) -> Result<(), SceneError> {
        self.read_state(state)?;
        self.compute_flow()?;
        self.write_rates(rate);
        Ok(())
    }

    fn present_rate(&mut self, rate: &mut [f64]) -> Result<(), SceneError> {
        self.evaluate()?;
        self.write_rates(rate);
        Ok(())
    }

    fn add_implicit(&mut self, state: &[f64], factor: f64, out: &mut [f64]) {
        let parts = Parts::of(&mut self.bodies.list, state.len(), out);
        parts.each(&states, &|_, body, range, out| {
            body.add_implicit(state.get(range).unwrap_or_default(), factor, out);
            Ok(())
        });
    }

    fn solve_implicit(&mut self, factor: f64, state: &mut [f64]) {
        let parts = Parts::of(&mut self.bodies.list, state.len(), state);
        parts.each(&states, &|_, body, _, state| {
            body.solve_implicit(factor, state);
            Ok(())
        });
    }

    fn write_scales(&self, mut scales: &mut [f64]) {
        for (index, body) in self.bodies.list.iter().enumerate() {
            let scales = part(&mut scales, body.as_ref());
            body.write_scales(scales);
            if scales.contains(&0.0) {
                let size = self.extent(index);
                scales.iter_mut().filter(|scale| **scale == 0.0).for_each(|scale| *scale = size);
            }
        }
        if let [time, strain] = scales {
            // The time in which the imposed flow deforms things, so that it is no longer in other units.
            let rate = self.imposed().rate();
            (*time, *strain) = (if rate > 0.0 { rate.recip() } else { 1.0 }, 1.0);
        }
    }

    fn fastest_decay(&self) -> f64 {
        let mut fastest = 0.0_f64;
        self.each_limit(&mut |limit, _| fastest = fastest.max(limit.decay_rate()));
        fastest
    }
}

impl<H: Hydrodynamics> System<H> {
    /// Returns the size of a body by its markers, or where they are at one place, of what is around it (length).
    fn extent(&self, body: usize) -> f64 {
        let markers = &self.bodies.markers;
        let own = markers.groups().get(body).and_then(|group| markers.positions().get(group.range.clone()));
        let domain = self.hydrodynamics.fluid_view().domain;
        let across = domain.walls.map(|[below, above]| above - below);
        let widths = domain.periods.iter().copied().chain([across]).flatten();
        let sizes =
            [spread(own.unwrap_or_default()), widths.fold(f64::INFINITY, f64::min), spread(markers.positions())];
        // Only a single point in unbounded fluid has nothing to be compared with.
        sizes.into_iter().find(|size| *size > 0.0 && size.is_finite()).unwrap_or(1.0)
    }

    /// Gives the bodies a state whose parts have the lengths `lengths` (one per body).
    pub(crate) fn restore(&mut self, lengths: &[usize], state: &[f64]) -> Result<(), SceneError> {
        self.forget_flow();
        let (bodies, clock) = state.split_at(lengths.iter().sum::<usize>().min(state.len()));
        self.bodies.read_state(self.clock.time, bodies, &|index, _| lengths[index])?;
        self.read_clock(clock)
    }

    /// Moves bodies by `by` (length), and computes the flow there.
    pub(crate) fn translate(&mut self, bodies: &[Handle<dyn Body>], by: Vec2) -> Result<(), SceneError> {
        self.forget_flow();
        self.forget_motion();
        for &handle in bodies {
            let (index, time) = (self.bodies.index_of(handle)?, self.time());
            let body = self.bodies.list[index].as_mut();
            let mut state = vec![0.0; body.state_len()];
            body.write_state(&mut state);
            if !body.translate(by, &mut state) {
                return Err(SceneError::immovable(body.name()));
            }
            body.read_state(&state).map_err(|source| failure(time, body, source))?;
        }
        self.evaluate()?;
        Ok(())
    }

    /// Writes the explicit rates of all bodies and of the clock.
    fn write_rates(&mut self, rate: &mut [f64]) {
        let (bodies, clock) = rate.split_at_mut(rate.len() - self.clock_len());
        self.bodies.write_rates(bodies);
        self.write_clock_rate(clock);
    }

    pub(crate) fn write_lengths(&self, lengths: &mut Vec<usize>) {
        lengths.clear();
        lengths.extend(self.bodies.list.iter().map(|body| body.state_len()));
    }

    /// Returns the rate of change at the present state, the implicit part with it; `state` is that state or one that
    /// differs from it by what the end of a step did.
    pub(crate) fn whole_rate(&mut self, state: &[f64], rate: &mut [f64]) -> Result<(), SceneError> {
        self.present_rate(rate)?;
        self.add_implicit(state, 1.0, rate);
        Ok(())
    }

    /// Returns the largest over the bodies of the root mean square of `errors / scales`; both have the length of the
    /// state.
    pub(crate) fn error_norm(&self, errors: &[f64], scales: &[f64]) -> f64 {
        let (mut start, mut largest) = (0, 0.0_f64);
        for body in &self.bodies.list {
            let end = start + body.state_len();
            let sum: f64 = errors[start..end].iter().zip(&scales[start..end]).map(|(e, s)| (e / s).powi(2)).sum();
            let norm = (sum / (end - start).max(1) as f64).sqrt();
            // Not a number counts as too large.
            largest = if norm.is_nan() { f64::INFINITY } else { largest.max(norm) };
            start = end;
        }
        largest
    }
}

/// Returns the root mean square distance of points from their mean (length); zero without points.
fn spread(points: &[Vec2]) -> f64 {
    let count = points.len().max(1) as f64;
    let mean = points.iter().sum::<Vec2>() / count;
    (points.iter().map(|point| (*point - mean).length_squared()).sum::<f64>() / count).sqrt()
}

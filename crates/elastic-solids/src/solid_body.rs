//! The solid as a body of a scene.

use std::f64::consts::PI;

use ib_core::{Body, BodyError, MarkerKind, Medium, StepLimit, Vec2};

use crate::{ElasticForces, Solid, SolidError};

impl From<SolidError> for BodyError {
    fn from(error: SolidError) -> Self {
        Self::Other(Box::new(error))
    }
}

/// Part of the bulk modulus that stiffens a mesh which is coarser than the grid. The velocity of the fluid has no divergence, so that the
/// bulk modulus only acts through the difference between the fluid's motion and that of its samples at the points (measured: 0.105 at two
/// grid spacings).
const BULK_SHARE: f64 = 0.11;

impl<F: ElasticForces> Body for Solid<F> {
    fn name(&self) -> &str {
        &self.name
    }

    fn kind(&self) -> MarkerKind {
        MarkerKind::Points
    }

    fn marker_count(&self) -> usize {
        self.free.len()
    }

    fn write_markers(&self, positions: &mut [Vec2]) {
        for (marker, &point) in positions.iter_mut().zip(&self.free) {
            *marker = self.positions[point];
        }
    }

    fn write_forces(&mut self, _medium: &Medium, forces: &mut [Vec2]) -> Result<(), BodyError> {
        self.compute_forces()?;
        for (force, &point) in forces.iter_mut().zip(&self.free) {
            *force = self.forces[point];
        }
        Ok(())
    }

    fn state_len(&self) -> usize {
        2 * self.free.len()
    }

    fn write_state(&self, state: &mut [f64]) {
        for (pair, &point) in state.chunks_exact_mut(2).zip(&self.free) {
            pair.copy_from_slice(self.positions[point].as_slice());
        }
    }

    fn read_state(&mut self, state: &[f64]) -> Result<(), BodyError> {
        if let Some(index) = state.iter().position(|value| !value.is_finite()) {
            return Err(BodyError::NonFinite { what: "point coordinate", index, value: state[index] });
        }
        for (pair, &point) in state.chunks_exact(2).zip(&self.free) {
            self.positions[point] = Vec2::new(pair[0], pair[1]);
        }
        Ok(())
    }

    fn rate(&mut self, velocities: &[Vec2], rate: &mut [f64]) {
        for (pair, velocity) in rate.chunks_exact_mut(2).zip(velocities) {
            pair.copy_from_slice(velocity.as_slice());
        }
    }

    fn end_step(&mut self, _medium: &Medium, _dt: f64) -> Result<(), BodyError> {
        if self.may_invert { Ok(()) } else { Ok(self.check_inversion()?) }
    }

    /// Elastic forces: `2 eta/mu` for the midpoint rule, independent of the spacings of grid and mesh, where the mesh is as fine as the grid;
    /// on coarser ones 0.11 kappa where that is more than mu. Tethers: twice the viscosity over the stiffness per area or length that
    /// they cover, for the slowest flow that the domain admits.
    fn step_limits(&self, medium: &Medium) -> Vec<StepLimit> {
        let moduli = self.law.stiffest();
        let coarse = medium.spacing.is_some_and(|spacing| self.spacing > 1.05 * spacing);
        let stiffness = if coarse { moduli.shear().max(BULK_SHARE * moduli.bulk()) } else { moduli.shear() };
        let mut limits = vec![StepLimit { dt: 2.0 * medium.viscosity / stiffness, reason: "the elastic moduli" }];
        if !self.tethers.is_empty() {
            let dt = 2.0 * medium.viscosity / self.tether_stiffness(medium);
            limits.push(StepLimit { dt, reason: "the tethers" });
        }
        limits
    }
}

impl<F: ElasticForces> Solid<F> {
    /// Viscosity times the fastest rate at which tethers relax (force per length), estimated from above: all of them move together in the
    /// largest flow of the domain, of wavenumber q. A sheet of them with the total stiffness k per length of the domain relaxes at
    /// `k/(2 eta q)`, a layer of thickness t that fills it at `k/(eta q^2 t)`; in between at about `k/(eta q (2 + q t))`.
    fn tether_stiffness(&self, medium: &Medium) -> f64 {
        let anchors = || self.tethers.iter().map(|tether| tether.anchor);
        let first = self.tethers[0].anchor;
        let (low, high) = anchors().fold((first, first), |(a, b), p| (a.inf(&p), b.sup(&p)));
        let size = (high - low) + Vec2::repeat(self.spacing);
        let (length, thickness) = (size.x.max(size.y), size.x.min(size.y));
        let domain = &medium.domain;
        let extent = domain.periods.iter().flatten().copied().fold(0.0, f64::max);
        // Without an end the flow about a group reaches some ten times as far as the group.
        let reach = if extent > 0.0 { extent } else { 10.0 * length };
        let wavenumber = domain.walls.map_or(2.0 * PI / reach, |[bottom, top]| PI / (top - bottom));
        let total: f64 = self.tethers.iter().map(|tether| tether.stiffness).sum();
        total / length / (wavenumber * (2.0 + wavenumber * thickness))
    }
}

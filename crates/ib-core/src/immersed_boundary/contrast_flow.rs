//! Interfaces to other viscosities on the grid.

use stokes_grid::{StaggeredField, StokesSolver};
use stokes_layers::{Forcing, Geometry};

use super::{ImmersedBoundary, sampling};
use crate::contrast::{Contrast, EquivalentForces, Nearby, Outcome};
use crate::gap::wall_gap;
use crate::mobility::Setting;
use crate::{
    FlowError, FlowSample, Kernel, Markers, Transfer, Vec2,
    checkpoint::SavedState,
    hydrodynamics::{MarkerGroup, SolveReport},
};

/// What interfaces to other viscosities need beside the grid.
#[derive(Debug, Clone)]
pub(super) struct ContrastFlow<K> {
    contrast: Contrast,
    equivalent: EquivalentForces,
    /// For the droplets' nodes alone.
    transfer: Transfer<K>,
    /// The flow without forces (imposed fluxes, walls that move) and its mean pressure gradient; none where it
    /// vanishes.
    imposed: Imposed,
    /// At the droplets' nodes.
    nodes: Nodes,
    /// Forces of all markers but the droplets'; then velocities of all markers.
    all: Vec<Vec2>,
    /// The flow of these forces and what is imposed.
    other: StaggeredField,
    other_density: StaggeredField,
}

/// A flow and its mean pressure gradient (force per volume).
type Imposed = Option<(StaggeredField, [f64; 2])>;

/// Vectors at the droplets' nodes.
#[derive(Debug, Clone, Default)]
struct Nodes {
    positions: Vec<Vec2>,
    forces: Vec<Vec2>,
    /// The part of the forces that carries the droplets' net forces and torques.
    rigid: Vec<Vec2>,
    /// Velocities of one viscosity: of the droplets' own forces, of the rigid part of them, and of all other forces.
    own: Vec<Vec2>,
    pulled: Vec<Vec2>,
    other: Vec<Vec2>,
    /// Velocities.
    velocities: Vec<Vec2>,
    /// The part of them that is not the others'.
    target: Vec<Vec2>,
}

impl<K: Kernel> ContrastFlow<K> {
    /// The last solutions, from which the next ones start.
    pub(super) fn save(&self) -> SavedState {
        let mut saved = self.contrast.save();
        saved.counts.push(self.equivalent.guess().len() as u64);
        saved.reals.extend_from_slice(self.equivalent.guess());
        saved
    }

    /// Takes back what [`ContrastFlow::save`] wrote.
    pub(super) fn restore(&mut self, mut saved: SavedState) {
        let last = saved.counts.pop().and_then(|count| usize::try_from(count).ok());
        let Some(start) = last.and_then(|count| saved.reals.len().checked_sub(count)) else { return };
        self.equivalent.start_from(&saved.reals[start..]);
        saved.reals.truncate(start);
        self.contrast.restore(&saved);
    }

    /// The stresslet of the flow around a droplet; `None` for markers that are no droplet of a larger viscosity: for a
    /// smaller one forces and velocities give it without a loss.
    pub(super) fn stresslet(&self, group: usize) -> Result<Option<[[f64; 2]; 2]>, FlowError> {
        let Some(index) = self.contrast.droplets().iter().position(|droplet| droplet.group == group) else {
            return Ok(None);
        };
        if self.contrast.curves()[index].contrast <= 0.0 {
            return Ok(None);
        }
        let Nodes { forces, other, velocities, .. } = &self.nodes;
        self.contrast.stresslet(index, forces, other, velocities).map(Some)
    }

    /// Takes over the droplets.
    fn load(&mut self, markers: &Markers) -> Result<(), FlowError> {
        self.contrast.load(markers)?;
        let Nodes { positions, forces, rigid, own, pulled, other, velocities, target } = &mut self.nodes;
        for array in [&mut *positions, &mut *forces, &mut *velocities] {
            array.clear();
        }
        for droplet in self.contrast.droplets() {
            positions.extend_from_slice(&markers.positions[droplet.markers.clone()]);
            forces.extend_from_slice(&markers.forces[droplet.markers.clone()]);
            velocities.extend_from_slice(&markers.velocities[droplet.markers.clone()]);
        }
        for array in [own, rigid, pulled, other, target] {
            array.resize(positions.len(), Vec2::ZERO);
        }
        self.transfer.locate(positions);
        Ok(())
    }
}

impl<S: StokesSolver, K: Kernel> ImmersedBoundary<S, K> {
    /// Makes what interfaces to other viscosities need, once, and lends it.
    pub(super) fn take_contrast(&mut self) -> Result<ContrastFlow<K>, FlowError> {
        if let Some(flow) = self.contrast.take() {
            return Ok(flow);
        }
        let grid = *self.solver.grid();
        let [lx, ly] = grid.lengths();
        let density = StaggeredField::zeros(grid);
        let mut velocity = StaggeredField::zeros(grid);
        let at_rest = self.solver.solve(&density, &mut velocity)?;
        let moves = velocity.x().iter().chain(velocity.y()).any(|value| *value != 0.0);
        let imposed = moves.then(|| (velocity.clone(), at_rest.mean_pressure_gradient));
        let zero_flux = matches!(self.solver.drive(), stokes_grid::Drive::ZeroFlux | stokes_grid::Drive::Flux(_));
        let forcing = if zero_flux { Forcing::Flux(0.0) } else { Forcing::Gradient(0.0) };
        let (geometry, middle) = match self.walls() {
            None => (Geometry::Box { lengths: [lx, ly] }, 0.0),
            Some([bottom, top]) => {
                (Geometry::Channel { length: lx, width: top - bottom, forcing }, 0.5 * (top + bottom))
            }
        };
        Ok(ContrastFlow {
            contrast: Contrast::new(geometry, middle, self.solver.viscosity(), 0.1 * grid.spacing())?,
            equivalent: EquivalentForces::default(),
            transfer: Transfer::new(grid, self.transfer.kernel().clone()),
            imposed,
            nodes: Nodes::default(),
            all: Vec::new(),
            other: velocity,
            other_density: density,
        })
    }

    /// The flow with interfaces to other viscosities: one solve on the grid for their forces, one more where these have
    /// net forces or torques, one for all other forces if there are any, and the double layer; where there are other
    /// markers, the flow of the equivalent forces for these.
    pub(super) fn contrast_velocities(&mut self, markers: &mut Markers) -> Result<SolveReport, FlowError> {
        let mut flow = self.take_contrast()?;
        let outcome = self.contrast_with(&mut flow, markers);
        self.contrast = Some(flow);
        outcome
    }

    fn contrast_with(&mut self, flow: &mut ContrastFlow<K>, markers: &mut Markers) -> Result<SolveReport, FlowError> {
        flow.load(markers)?;
        self.check_films(flow, markers)?;
        self.work.evaluations += 1;
        let mut gradient = self.solve_others(flow, markers, false)?;
        let prepared = flow.contrast.prepare()?;
        self.solve_rigid_part(flow)?;
        let own = self.solve_own(flow)?;
        gradient.iter_mut().zip(own).for_each(|(total, own)| *total += own);
        let Nodes { own, pulled, other, velocities, .. } = &mut flow.nodes;
        let effort = flow.contrast.solve([own, pulled, other], velocities)?;
        gradient[0] += effort.pressure_gradient;
        let (mut iterations, mut residual) = (prepared + effort.iterations, effort.residual);
        if !flow.contrast.others().is_empty() {
            if self.has_points_inside(markers) {
                self.solve_others(flow, markers, true)?;
            }
            let found = self.find_equivalent(flow)?;
            (iterations, residual) = (iterations + found.iterations, residual.max(found.residual));
            self.solve_droplets(&flow.transfer, &flow.imposed, flow.equivalent.forces())?;
            self.add_to_others(flow, markers)?;
        }
        for (droplet, curve) in flow.contrast.droplets().iter().zip(flow.contrast.curves()) {
            let velocities = &flow.nodes.velocities[curve.first..][..curve.len()];
            markers.velocities[droplet.markers.clone()].copy_from_slice(velocities);
        }
        self.work.iterations += iterations;
        self.work.most_iterations = self.work.most_iterations.max(iterations);
        self.velocity.combine(1.0, 1.0, &flow.other);
        self.density.combine(1.0, 1.0, &flow.other_density);
        Ok(SolveReport { iterations, residual, mean_pressure_gradient: gradient })
    }

    /// Whether there are points inside a droplet of another viscosity.
    fn has_points_inside(&self, markers: &Markers) -> bool {
        markers.groups().iter().any(|group| is_inside(group, self.solver.viscosity()))
    }

    /// Refuses films at walls that are thinner than half the distance of a droplet's markers.
    fn check_films(&self, flow: &ContrastFlow<K>, markers: &Markers) -> Result<(), FlowError> {
        let Some(walls) = self.walls() else { return Ok(()) };
        for (droplet, curve) in flow.contrast.droplets().iter().zip(flow.contrast.curves()) {
            let gap = wall_gap(&markers.positions[droplet.markers.clone()], walls);
            let least = 0.5 * curve.perimeter() / curve.len() as f64;
            if gap < least {
                return Err(FlowError::Film { body: droplet.group, gap, least });
            }
        }
        Ok(())
    }

    /// The flow of all forces but the droplets' and of what is imposed: at the droplets' nodes, at the other markers
    /// (with the mobility correction) and on the grid; its mean pressure gradient. Forces on points inside a droplet of
    /// another viscosity are, once scaled, those that move its fluid in one of the exterior viscosity as they do; as
    /// they are they move interfaces.
    fn solve_others(
        &mut self,
        flow: &mut ContrastFlow<K>,
        markers: &mut Markers,
        scaled: bool,
    ) -> Result<[f64; 2], FlowError> {
        flow.all.clear();
        flow.all.extend_from_slice(&markers.forces);
        let viscosity = self.solver.viscosity();
        for group in markers.groups().iter().filter(|group| scaled && is_inside(group, viscosity)) {
            let factor = viscosity / group.viscosities(viscosity)[1];
            flow.all[group.range.clone()].iter_mut().for_each(|force| *force *= factor);
        }
        for droplet in flow.contrast.droplets() {
            flow.all[droplet.markers.clone()].fill(Vec2::ZERO);
        }
        if !flow.contrast.others().is_empty() {
            self.transfer.locate(&markers.positions);
        }
        let (mut gradient, mut moves) = ([0.0; 2], true);
        if flow.all.iter().any(|force| *force != Vec2::ZERO) {
            let report = self.solve_located(&flow.all)?;
            gradient = report.mean_pressure_gradient;
            flow.other.copy_from(&self.velocity);
            flow.other_density.copy_from(&self.density);
        } else if let Some((imposed, fixed)) = &flow.imposed {
            gradient = *fixed;
            flow.other.copy_from(imposed);
            flow.other_density.fill(0.0);
        } else {
            moves = false;
            flow.other.fill(0.0);
            flow.other_density.fill(0.0);
        }
        if !moves {
            flow.nodes.other.fill(Vec2::ZERO);
            markers.velocities.fill(Vec2::ZERO);
            return Ok(gradient);
        }
        flow.transfer.interpolate(&flow.other, &mut flow.nodes.other)?;
        if !flow.contrast.others().is_empty() {
            self.transfer.interpolate(&flow.other, &mut markers.velocities)?;
            for index in 0..markers.groups().len() {
                let start = markers.groups()[index].range.start;
                if flow.contrast.others().binary_search(&start).is_ok() {
                    self.correct(index, markers)?;
                }
            }
        }
        Ok(gradient)
    }

    /// Velocities at the nodes of the forces that carry the droplets' net forces and torques.
    fn solve_rigid_part(&mut self, flow: &mut ContrastFlow<K>) -> Result<(), FlowError> {
        let Nodes { positions, forces, rigid, pulled, .. } = &mut flow.nodes;
        if flow.contrast.rigid_part(forces, rigid) {
            self.respond((&flow.contrast, &flow.transfer, &flow.imposed), [positions, rigid], pulled)?;
        } else {
            pulled.fill(Vec2::ZERO);
        }
        Ok(())
    }

    /// Velocities at the nodes of the droplets' own forces, and the mean pressure gradient.
    fn solve_own(&mut self, flow: &mut ContrastFlow<K>) -> Result<[f64; 2], FlowError> {
        let Nodes { positions, forces, own, .. } = &mut flow.nodes;
        self.respond((&flow.contrast, &flow.transfer, &flow.imposed), [positions, forces], own)
    }

    /// Velocities of one viscosity, without what is imposed, of forces at the droplets' nodes.
    fn respond(
        &mut self,
        (contrast, transfer, imposed): (&Contrast, &Transfer<K>, &Imposed),
        [positions, forces]: [&[Vec2]; 2],
        velocities: &mut [Vec2],
    ) -> Result<[f64; 2], FlowError> {
        let gradient = self.solve_droplets(transfer, imposed, forces)?;
        transfer.interpolate(&self.velocity, velocities)?;
        self.correct_droplets(contrast, positions, forces, velocities)?;
        Ok(gradient)
    }

    /// The flow on the grid of `forces` at the droplets' nodes alone, and its mean pressure gradient.
    fn solve_droplets(
        &mut self,
        transfer: &Transfer<K>,
        imposed: &Imposed,
        forces: &[Vec2],
    ) -> Result<[f64; 2], FlowError> {
        self.density.fill(0.0);
        transfer.spread(forces, &mut self.density)?;
        let mut gradient = self.solve_density(forces.len())?.mean_pressure_gradient;
        if let Some((imposed, fixed)) = imposed {
            self.velocity.combine(1.0, -1.0, imposed);
            gradient.iter_mut().zip(fixed).for_each(|(gradient, fixed)| *gradient -= fixed);
        }
        Ok(gradient)
    }

    /// Adds the mobility correction of droplets to velocities at their nodes.
    fn correct_droplets(
        &mut self,
        contrast: &Contrast,
        positions: &[Vec2],
        forces: &[Vec2],
        velocities: &mut [Vec2],
    ) -> Result<(), FlowError> {
        let setting = self.setting();
        let Some(correction) = self.correction.as_mut() else { return Ok(()) };
        for (droplet, curve) in contrast.droplets().iter().zip(contrast.curves()) {
            if !droplet.even {
                continue;
            }
            let nodes = curve.first..curve.first + curve.len();
            let (positions, forces) = (&positions[nodes.clone()], &forces[nodes.clone()]);
            correction.apply(&setting, positions, forces, &mut velocities[nodes])?;
            self.work.corrections += 1;
        }
        Ok(())
    }

    /// Finds the forces that take the place of the other viscosities: the droplets' own, reduced by the exterior
    /// viscosity over the largest mean of both, and those of the flow that remains. Net forces and torques are those of
    /// the droplets' own.
    fn find_equivalent(&mut self, flow: &mut ContrastFlow<K>) -> Result<Outcome, FlowError> {
        let viscosity = self.solver.viscosity();
        let Nodes { positions, forces, rigid, own, other, velocities, target, .. } = &mut flow.nodes;
        let means = flow.contrast.curves().iter().map(|curve| curve.outside + 0.5 * curve.contrast);
        let share = viscosity / means.fold(0.5 * viscosity, f64::max);
        for i in 0..target.len() {
            rigid[i] = (1.0 - share) * forces[i];
            target[i] = viscosity * (velocities[i] - other[i] - share * own[i]);
        }
        let (contrast, transfer, imposed) = (&flow.contrast, &flow.transfer, &flow.imposed);
        let spacing = self.grid().spacing();
        let outcome = flow.equivalent.solve(contrast.curves(), spacing, target, |forces, out| {
            self.respond((contrast, transfer, imposed), [positions, forces], out)?;
            out.iter_mut().for_each(|velocity| *velocity *= viscosity);
            Ok(())
        })?;
        let equivalent = flow.equivalent.forces_mut();
        equivalent.iter_mut().zip(&*rigid).for_each(|(equivalent, reduced)| *equivalent -= *reduced);
        contrast.rigid_part(equivalent, rigid);
        for ((equivalent, force), rigid) in equivalent.iter_mut().zip(forces).zip(rigid) {
            *equivalent += *force - *rigid;
        }
        for ((target, velocity), other) in target.iter_mut().zip(velocities).zip(other) {
            *target = *velocity - *other;
        }
        Ok(outcome)
    }

    /// As [`crate::Hydrodynamics::sample`] where viscosities differ. Closer to an interface than the kernel reaches the
    /// velocity is a parabola between the interface's and the flow at that distance on the same side; pressure and
    /// gradient are those there.
    pub(super) fn contrast_sample(
        &mut self,
        markers: &Markers,
        points: &[Vec2],
        out: &mut [FlowSample],
    ) -> Result<(), FlowError> {
        let mut flow = self.take_contrast()?;
        let outcome = self.sample_with(&mut flow, markers, points, out);
        self.contrast = Some(flow);
        outcome
    }

    fn sample_with(
        &mut self,
        flow: &mut ContrastFlow<K>,
        markers: &Markers,
        points: &[Vec2],
        out: &mut [FlowSample],
    ) -> Result<(), FlowError> {
        flow.load(markers)?;
        let mut scratch = markers.clone();
        self.solve_others(flow, &mut scratch, true)?;
        flow.contrast.prepare()?;
        self.solve_own(flow)?;
        self.find_equivalent(flow)?;
        self.solve_droplets(&flow.transfer, &flow.imposed, flow.equivalent.forces())?;
        self.velocity.combine(1.0, 1.0, &flow.other);
        self.density.combine(1.0, 1.0, &flow.other_density);
        let pressure = self.pressure_field()?;
        let (contrast, nodes) = (&flow.contrast, &flow.nodes);
        let at_nodes: Vec<f64> = nodes.positions.iter().map(|&node| sampling::pressure(&pressure, node)).collect();
        let offsets = contrast.pressure_offsets(&at_nodes, flow.equivalent.forces(), &nodes.forces, &nodes.velocities);
        let viscosity = self.solver.viscosity();
        let reach = self.reach();
        for (point, out) in points.iter().zip(out) {
            let inside = contrast.droplet_at(*point);
            let velocity = |point| sampling::smooth_velocity(&self.velocity, point);
            let near = self.close_to(contrast, *point);
            (out.velocity, out.gradient) = match &near {
                Some(near) => near.flow(*point, reach, &nodes.velocities, velocity),
                None => velocity(*point),
            };
            let smeared = near.filter(|near| near.distance() < 2.0 * reach[0]);
            out.pressure = match smeared.map(|near| (near, [2.0, 3.0].map(|times| near.retreat(times * reach[0])))) {
                // On the same side of all interfaces.
                Some((near, [first, second]))
                    if self.between_walls(&second)
                        && contrast.droplet_at(first) == inside
                        && contrast.droplet_at(second) == inside =>
                {
                    let [first, second] = [first, second].map(|place| sampling::pressure(&pressure, place));
                    near.extrapolate([2.0 * reach[0], reach[0]], first, second)
                }
                _ => sampling::pressure(&pressure, *point),
            };
            if let Some(index) = inside {
                let curve = &contrast.curves()[index];
                out.pressure = out.pressure * (curve.outside + curve.contrast) / viscosity + offsets[index];
            }
        }
        Ok(())
    }

    /// Distance from an interface (length) beyond which what spreading smears of the flow can be neglected, three times
    /// its width, and a step beyond that.
    fn reach(&self) -> [f64; 2] {
        let h = self.grid().spacing();
        [3.0 * self.variance.sqrt() * h, h]
    }

    fn between_walls(&self, point: &Vec2) -> bool {
        self.walls().is_none_or(|[bottom, top]| point.y > bottom && point.y < top)
    }

    /// The interface within four times whose reach a point lies, unless a wall is in the way of its neighbourhood.
    fn close_to(&self, contrast: &Contrast, point: Vec2) -> Option<Nearby> {
        let [reach, step] = self.reach();
        contrast
            .nearby(point, 4.0 * reach)
            .filter(|near| self.between_walls(&near.retreat((2.0 * reach).max(reach + step))))
    }

    /// Adds the flow of the equivalent forces, which is on the grid, at the markers that are not on droplets.
    fn add_to_others(&self, flow: &mut ContrastFlow<K>, markers: &mut Markers) -> Result<(), FlowError> {
        self.transfer.interpolate(&self.velocity, &mut flow.all)?;
        let reach = self.reach();
        let velocity = |point| sampling::smooth_velocity(&self.velocity, point);
        for &marker in flow.contrast.others() {
            let point = markers.positions[marker];
            let far = flow.all[marker];
            markers.velocities[marker] += match self.close_to(&flow.contrast, point) {
                Some(near) => {
                    // So that velocities are continuous where viscosities become equal.
                    let share = (near.contrast().abs() / self.solver.viscosity()).min(1.0);
                    far.lerp(near.flow(point, reach, &flow.nodes.target, velocity).0, share)
                }
                None => far,
            };
        }
        Ok(())
    }

    pub(super) fn setting(&self) -> Setting {
        Setting {
            spacing: self.grid().spacing(),
            origin: self.grid().origin(),
            viscosity: self.solver.viscosity(),
            walls: self.walls(),
            variance: self.variance,
        }
    }
}

/// Whether a group are points in fluid of another viscosity than the exterior one.
fn is_inside(group: &MarkerGroup, viscosity: f64) -> bool {
    !group.kind.is_interface() && group.viscosities(viscosity)[1] != viscosity
}

//! Interfaces and surfaces of solids as layers, the inner points of solids on a grid.

mod contrast;
mod curves;

use motile_base::{Drive, Region, SolveReport, internal::all_points_finite, positive, same_length};
use stokes_boundary_integrals::internal::gmres::Outcome;
use stokes_boundary_integrals::{InterfaceFlow, Settings, SingleLayer, Solution, Symmetry};
use stokes_grid::{CentreField, Grid, StaggeredField, StokesSolver, level_at_walls, sample_flow, sample_pressure};

use crate::{
    error::{of_grid, of_layers},
    interface_groups::InterfaceGroups,
};
use contrast::LayerContrast;
use curves::LayerCurves;
use ib_core::{
    Kernel, Role, Transfer,
    internal::{WALL_TOLERANCE, grid_domain},
};
use motile_base::{FlowSample, Vec2};
use motile_scene::{
    FlowError, FlowWork, FluidView, Hydrodynamics, MarkerGroup, MarkerKind, Markers, checkpoint::SavedState,
};

/// Velocities of markers where interfaces and the surfaces of solids are layers ([`SingleLayer`]), exact among each
/// other at any distance, and the inner points of solids are coupled to them and to one another through a grid.
///
/// With L the layers' single layer, G the grid's solution, and S and J = S^T spreading and interpolation of layers (l)
/// and of inner points (v),
///
/// ```text
/// V_l = L F_l + J_l G S_v F_v
/// V_v = J_v G (S_v F_v + S_l F_l)
/// ```
///
/// The two mixed parts are transposes of each other, so that the whole is as symmetric as L. It is the mobility of the
/// immersed boundary method and what regularisation takes from the layers, L - J_l G S_l, which is not negative: the
/// whole takes energy in any state. Layers are spread and interpolated at nodes no more than a grid spacing apart,
/// their Fourier series in between, so that the grid has the layers' long waves. The velocity of a surface belongs to a
/// flow without divergence through all of it, so that solids keep their volume, and nothing next to them has to be
/// corrected. Two solutions on the grid an evaluation.
///
/// If there is neither a solid nor a force on a point, interfaces alone move the fluid. Then the grid has no part in
/// it, and all is as in boundary integrals ([`InterfaceFlow`]), at points too.
///
/// Groups of interfaces are layers, and of other groups the markers on their surfaces
/// ([`motile_scene::MarkerGroup::surfaces`]). The inner points of a solid should be two or more grid spacings apart:
/// the grid hardly resolves what lies closer to a surface.
#[derive(Debug, Clone)]
#[doc(alias("immersed boundary", "boundary integral"))]
pub struct ImmersedLayers<S, K> {
    solver: S,
    layer: SingleLayer,
    curves: LayerCurves,
    interfaces: InterfaceGroups,
    contrast: LayerContrast,
    /// It serves inner points and grid nodes of layers.
    inner: Transfer<K>,
    nodes: Transfer<K>,
    density: StaggeredField,
    velocity: StaggeredField,
    /// Of the inner points.
    positions: Vec<Vec2>,
    values: Vec<Vec2>,
    /// Of all markers, where points lie in fluid of another viscosity.
    scaled: Vec<Vec2>,
    work: FlowWork,
}

impl<S: StokesSolver, K: Kernel + Clone> ImmersedLayers<S, K> {
    /// Creates the method on the grid of `solver`, with that number of nodes of an interface and layers that are right
    /// to the tolerance (without dimension).
    ///
    /// # Errors
    /// Returns an error for fewer than 16 or more than 4096 nodes, a tolerance outside of 1e-15 to 1e-3, a channel
    /// whose middle is not at y = 0.
    pub fn new(solver: S, kernel: K, nodes: usize, tolerance: f64) -> Result<Self, FlowError> {
        if solver.friction() != 0.0 {
            return Err(FlowError::unsupported(
                "friction of the fluid with layers, whose Green's functions have none",
                "Use the immersed boundary method, or a solver without friction",
            ));
        }
        let grid = *solver.grid();
        let [length, width] = grid.lengths();
        let region = if grid.has_walls() {
            if (grid.origin()[1] + 0.5 * width).abs() > 1e-9 * width {
                return Err(FlowError::unsupported(
                    "a channel of layers whose middle is not at y = 0",
                    "Leave the origin of the grid at its default",
                ));
            }
            // Where the grid has a part, the flow that is driven comes from there.
            Region::Channel { length, width, drive: solver.drive() }.with_slip(solver.walls().slip())
        } else {
            Region::Box { lengths: [length, width] }
        };
        let settings = Settings { nodes, tolerance, ..Settings::default() };
        Ok(Self {
            layer: SingleLayer::new(region, tolerance, Symmetry::ToRoundOff).map_err(of_layers)?,
            interfaces: InterfaceGroups::new(
                InterfaceFlow::new(region, solver.viscosity(), settings).map_err(of_layers)?,
            ),
            contrast: LayerContrast::new(nodes, tolerance)?,
            curves: LayerCurves::new(length, grid.spacing(), nodes),
            inner: Transfer::new(grid, kernel.clone()),
            nodes: Transfer::new(grid, kernel),
            density: StaggeredField::zeros(grid),
            velocity: StaggeredField::zeros(grid),
            positions: Vec::new(),
            values: Vec::new(),
            scaled: Vec::new(),
            work: FlowWork::default(),
            solver,
        })
    }

    /// Sets the perimeter (length) of the smallest interface, which [`Hydrodynamics::fluid_view`] assumes before the
    /// first evaluation; 2 pi by default. The first bound on a time step rests on it.
    ///
    /// # Errors
    /// Returns [`FlowError`] if the perimeter is not positive and finite.
    pub fn with_reference_perimeter(mut self, perimeter: f64) -> Result<Self, FlowError> {
        positive("the reference perimeter", perimeter)?;
        self.interfaces.set_reference_perimeter(perimeter);
        Ok(self)
    }

    /// Returns the grid.
    #[must_use]
    pub fn grid(&self) -> &Grid {
        self.solver.grid()
    }

    fn solve(&mut self) -> Result<SolveReport, FlowError> {
        let before = self.solver.work();
        let report = self.solver.solve(&self.density, &mut self.velocity).map_err(of_grid)?;
        let after = self.solver.work();
        let transforms = |work: stokes_grid::Work| work.forward_transforms + work.inverse_transforms;
        self.work.stokes_solves += after.solves - before.solves;
        self.work.transforms += transforms(after) - transforms(before);
        Ok(report)
    }

    /// Returns the flow on the grid of the forces on inner points alone, and what drives it.
    fn solve_inner(&mut self, forces: &[Vec2]) -> Result<SolveReport, FlowError> {
        if self.curves.inner.is_empty() && matches!(self.solver.drive(), Drive::ZeroGradient | Drive::ZeroFlux) {
            self.density.fill(0.0);
            self.velocity.fill(0.0);
            return Ok(SolveReport::default());
        }
        self.values.clear();
        self.values.extend(self.curves.inner.iter().map(|marker| forces[*marker]));
        self.density.fill(0.0);
        self.inner.spread(&self.values, &mut self.density).map_err(of_grid)?;
        self.work.markers_spread += self.values.len();
        self.solve()
    }

    /// Returns the flow on the grid of all forces, after [`ImmersedLayers::solve_inner`].
    fn solve_all(&mut self) -> Result<SolveReport, FlowError> {
        let forces = &self.curves.grid[1];
        self.nodes.spread(forces, &mut self.density).map_err(of_grid)?;
        self.work.markers_spread += forces.len();
        self.solve()
    }

    /// Refuses inner points too far beyond a wall, and points of the grid part that are too close to a wall with slip;
    /// layers see to their own.
    fn check_walls(&self, markers: &Markers) -> Result<(), FlowError> {
        let grid = self.grid();
        let slips = self.solver.walls().slip().map(|slip| slip > 0.0);
        if slips != [false; 2] {
            // Beyond the walls the kernel continues a flow without slip.
            let kernel = self.inner.kernel();
            let support = [Role::Normal, Role::Tangential].map(|role| kernel.support(role));
            let reach = 0.5 * grid.spacing() * support[0].max(support[1]) as f64;
            let [bottom, top] = [grid.origin()[1], grid.origin()[1] + grid.lengths()[1]];
            let inner = self.curves.inner.iter().map(|marker| markers.positions()[*marker].y);
            let mut heights = inner.chain(self.curves.grid[0].iter().map(|place| place.y));
            if heights.any(|y| slips[0] && y - bottom < reach || slips[1] && top - y < reach) {
                return Err(FlowError::unsupported(
                    "a point next to a wall with slip, closer than the delta function of the grid reaches",
                    "Use a finer grid or a wider channel, or for droplets alone boundary integrals",
                ));
            }
        }
        let (bottom, allowed) = (grid.origin()[1], WALL_TOLERANCE * grid.spacing());
        let top = bottom + grid.lengths()[1];
        for &marker in self.curves.inner.iter().filter(|_| grid.has_walls()) {
            let Vec2 { x, y } = markers.positions()[marker];
            let depth = (bottom - y).max(y - top);
            if depth > allowed {
                let body = markers.groups().iter().position(|group| group.range.contains(&marker)).unwrap_or(0);
                let marker = marker - markers.groups()[body].range.start;
                return Err(FlowError::BeyondWall { body, marker, x, y, depth, allowed });
            }
        }
        Ok(())
    }

    /// Takes over positions and forces.
    fn load(&mut self, markers: &Markers) -> Result<(), FlowError> {
        self.curves.load(markers)?;
        self.check_walls(markers)?;
        self.nodes.locate(&self.curves.grid[0]);
        self.positions.clear();
        self.positions.extend(self.curves.inner.iter().map(|marker| markers.positions()[*marker]));
        self.inner.locate(&self.positions);
        self.layer.load(self.curves.layers()).map_err(of_layers)?;
        Ok(())
    }

    /// Velocities at the nodes of layers: viscosity times the velocities of layers, and the velocities of inner points
    /// on the grid.
    fn solve_layers(&mut self, forces: &[Vec2]) -> Result<(), FlowError> {
        let curves = &mut self.curves;
        self.layer.apply(&curves.forces, &mut curves.velocities).map_err(of_layers)?;
        self.solve_inner(forces)?;
        let curves = &mut self.curves;
        self.nodes.interpolate(&self.velocity, &mut curves.grid[2]).map_err(of_grid)?;
        curves.add_grid(self.solver.viscosity())
    }

    /// Returns true if forces are on interfaces alone and there are no solids.
    fn is_of_interfaces(markers: &Markers) -> bool {
        let at_rest =
            |group: &MarkerGroup| markers.forces()[group.range.clone()].iter().all(|force| *force == Vec2::ZERO);
        let mut groups = markers.groups().iter();
        groups.all(|group| group.kind.is_curve() || group.layers().next().is_none() && at_rest(group))
    }

    /// Returns true if all fluid has one viscosity.
    fn is_uniform(&self, markers: &Markers) -> bool {
        let viscosity = self.solver.viscosity();
        let same = |group: &MarkerGroup| group.viscosities(viscosity).iter().all(|value| *value == viscosity);
        let uniform = |group: &MarkerGroup| group.kind != MarkerKind::Rigid && same(group);
        markers.groups().iter().all(uniform)
    }

    /// Returns the flow of layers and inner points at the nodes of layers, if viscosities differ with the forces on
    /// layers that take their place.
    fn solve_nodes(&mut self, markers: &Markers) -> Result<Outcome, FlowError> {
        self.load(markers)?;
        self.solve_layers(markers.forces())?;
        if self.is_uniform(markers) {
            return Ok(Outcome::default());
        }
        let (viscosity, entries) = (self.solver.viscosity(), self.curves.interface_entries());
        self.interfaces.load(markers)?;
        let flow = &mut self.interfaces.flow;
        let Solution { iterations, residual, .. } = self.contrast.solve(flow, &self.curves.velocities[..entries])?;
        let points = || markers.groups().iter().filter(|group| !group.kind.is_curve());
        if points().any(|group| group.viscosity_outside.is_some_and(|outside| outside != viscosity)) {
            let mut scaled = std::mem::take(&mut self.scaled);
            scaled.clear();
            scaled.extend_from_slice(markers.forces());
            for group in points() {
                let factor = viscosity / group.viscosity_outside.unwrap_or(viscosity);
                scaled[group.range.clone()].iter_mut().for_each(|force| *force *= factor);
            }
            self.curves.load_forces(&scaled)?;
            self.solve_layers(&scaled)?;
            self.scaled = scaled;
        }
        let LayerCurves { forces, velocities, .. } = &mut self.curves;
        let found = self.contrast.add_forces(&self.interfaces.flow, &mut self.layer, forces, velocities)?;
        self.curves.refine_forces()?;
        let iterations = iterations + found.iterations;
        self.work.iterations += iterations;
        self.work.most_iterations = self.work.most_iterations.max(iterations);
        Ok(Outcome { iterations, residual: residual.max(found.residual) })
    }

    /// Takes the pressure (force per length) from the interfaces' own layers and, on the grid, from all other forces.
    fn sample_pressure(&mut self, markers: &Markers, points: &[Vec2], out: &mut [FlowSample]) -> Result<(), FlowError> {
        let mut others = markers.forces().to_vec();
        for group in markers.groups().iter().filter(|group| group.kind.is_curve()) {
            others[group.range.clone()].fill(Vec2::ZERO);
        }
        self.curves.load_forces(&others)?;
        self.solve_inner(&others)?;
        self.solve_all()?;
        let pressure = self.pressure()?;
        let mut own = vec![FlowSample::default(); points.len()];
        self.interfaces.flow.sample(points, &mut own).map_err(of_layers)?;
        for ((out, own), point) in out.iter_mut().zip(own).zip(points) {
            out.pressure = own.pressure + sample_pressure(&pressure, *point);
        }
        Ok(())
    }

    fn pressure(&mut self) -> Result<CentreField, FlowError> {
        let mut pressure = CentreField::zeros(*self.grid());
        self.solver.pressure(&self.density, &self.velocity, &mut pressure).map_err(of_grid)?;
        level_at_walls(&mut pressure);
        Ok(pressure)
    }
}

impl<S: StokesSolver, K: Kernel + Clone> Hydrodynamics for ImmersedLayers<S, K> {
    fn fluid_view(&self) -> FluidView {
        let grid = self.grid();
        FluidView {
            domain: grid_domain(grid),
            viscosity: self.solver.viscosity(),
            spacing: Some(grid.spacing()),
            second_order: true,
            shape_modes: Some(self.interfaces.flow.settings().nodes),
            nodes: Some(self.interfaces.flow.settings().nodes),
            interface_stiffness: self.interfaces.stiffness(),
        }
    }

    fn drive(&self) -> Option<Drive> {
        self.grid().has_walls().then(|| self.solver.drive())
    }

    fn wall_slip(&self) -> Option<[f64; 2]> {
        let walls = self.solver.walls();
        (self.grid().has_walls() && walls.is_at_rest()).then(|| walls.slip())
    }

    fn velocities(&mut self, markers: &mut Markers) -> Result<SolveReport, FlowError> {
        if Self::is_of_interfaces(markers) {
            return self.interfaces.velocities(markers, &mut self.work);
        }
        let Outcome { iterations, residual } = self.solve_nodes(markers)?;
        self.work.evaluations += 1;
        self.interfaces.set_lengths(self.curves.interface_lengths());
        self.interfaces.tell_dipoles(markers)?;
        let viscosity = self.solver.viscosity();
        self.curves.write(1.0 / viscosity, markers.velocities_mut())?;
        let report = self.solve_all()?;
        self.inner.interpolate(&self.velocity, &mut self.values).map_err(of_grid)?;
        for (&marker, velocity) in self.curves.inner.iter().zip(&self.values) {
            markers.velocities_mut()[marker] = *velocity;
        }
        Ok(SolveReport { iterations, residual, ..report })
    }

    /// Interpolates bilinearly between grid points; if viscosities differ, the interfaces' pressure comes from their
    /// layers. The flow of interfaces alone is exact anywhere.
    fn sample(&mut self, markers: &Markers, points: &[Vec2], out: &mut [FlowSample]) -> Result<(), FlowError> {
        same_length("the samples", points.len(), out.len())?;
        if Self::is_of_interfaces(markers) {
            return self.interfaces.sample(markers, points, out);
        }
        all_points_finite("the points to sample", points)?;
        self.solve_nodes(markers)?;
        self.solve_all()?;
        let pressure = self.pressure()?;
        sample_flow(&self.velocity, &pressure, self.solver.walls(), points, out).map_err(of_grid)?;
        if self.is_uniform(markers) { Ok(()) } else { self.sample_pressure(markers, points, out) }
    }

    fn work(&self) -> FlowWork {
        self.work
    }

    fn save(&self) -> SavedState {
        let [contrast, interfaces] = [self.contrast.save(), self.interfaces.save()];
        let (reals, counts) = ([contrast.reals, interfaces.reals], [contrast.counts, interfaces.counts]);
        SavedState { reals: reals.concat(), counts: counts.concat() }
    }

    fn load(&mut self, saved: &SavedState) {
        let Some(reals) = self.contrast.restore(saved) else { return };
        self.interfaces.restore(reals, &saved.counts[LayerContrast::LISTS..]);
    }
}

#[cfg(test)]
mod tests;

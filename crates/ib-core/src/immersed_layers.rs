//! Interfaces and surfaces of solids as layers, the inner points of solids on a grid.

mod contrast;
mod curves;

use input_checks::{all_points_finite, same_length, within};
use stokes_grid::{CentreField, Drive, Grid, SolveReport, StaggeredField, StokesSolver};
use stokes_layers::gmres::Outcome;
use stokes_layers::{Forcing, Geometry, Reciprocity, SingleLayer, Solution};

use crate::immersed_boundary::{WALL_TOLERANCE, sampling};
use crate::{
    Discretisation, Domain, FlowError, FlowSample, Hydrodynamics, Kernel, MarkerKind, Markers, Transfer, Vec2,
    checkpoint::SavedState,
    hydrodynamics::{FlowWork, MarkerGroup},
};
use contrast::LayerContrast;
use curves::LayerCurves;

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
/// their Fourier series in between, so that the grid has the layers' long waves. The velocity of a surface is that of a
/// flow without divergence through all of it, so that solids keep their volume, and nothing has to be corrected or set
/// back beside them. Two solutions on the grid an evaluation.
///
/// Groups of interfaces are layers, and of other groups the markers on their surfaces
/// ([`crate::hydrodynamics::MarkerGroup::surfaces`]). The inner points of a solid should be two or more grid spacings
/// apart: what lies closer to a surface is hardly seen by the grid beside it.
#[derive(Debug, Clone)]
pub struct ImmersedLayers<S, K> {
    solver: S,
    layer: SingleLayer,
    /// Of an interface.
    modes: usize,
    curves: LayerCurves,
    contrast: LayerContrast,
    /// For inner points and for grid nodes of layers.
    inner: Transfer<K>,
    nodes: Transfer<K>,
    density: StaggeredField,
    velocity: StaggeredField,
    /// Of the inner points.
    positions: Vec<Vec2>,
    values: Vec<Vec2>,
    /// Of all markers, where points lie in fluid of another viscosity.
    scaled: Vec<Vec2>,
    stiffness: f64,
    work: FlowWork,
}

impl<S: StokesSolver, K: Kernel + Clone> ImmersedLayers<S, K> {
    /// The method on the grid of `solver`, with that number of nodes of an interface and layers that are right to the
    /// tolerance (without dimension).
    ///
    /// # Errors
    /// Fewer than 16 or more than 4096 nodes, a tolerance outside of 1e-15 to 1e-3, a channel whose middle is not at
    /// y = 0.
    pub fn new(solver: S, kernel: K, nodes: usize, tolerance: f64) -> Result<Self, FlowError> {
        within("the number of nodes", nodes as f64, 16.0, 4096.0)?;
        let grid = *solver.grid();
        let [length, width] = grid.lengths();
        let geometry = if grid.has_walls() {
            if (grid.origin()[1] + 0.5 * width).abs() > 1e-9 * width {
                return Err(FlowError::Unsupported {
                    what: "a channel of layers whose middle is not at y = 0",
                    remedy: "leave the origin of the grid as it is made",
                });
            }
            // What drives the flow comes from the grid.
            let forcing = match solver.drive() {
                Drive::ZeroGradient | Drive::Gradient(_) => Forcing::Gradient(0.0),
                Drive::ZeroFlux | Drive::Flux(_) => Forcing::Flux(0.0),
            };
            Geometry::Channel { length, width, forcing }
        } else {
            Geometry::Box { lengths: [length, width] }
        };
        Ok(Self {
            layer: SingleLayer::new(geometry, tolerance, Reciprocity::Exact)?,
            modes: nodes,
            contrast: LayerContrast::new(geometry, solver.viscosity(), nodes, tolerance)?,
            curves: LayerCurves::new(length, grid.spacing(), nodes),
            inner: Transfer::new(grid, kernel.clone()),
            nodes: Transfer::new(grid, kernel),
            density: StaggeredField::zeros(grid),
            velocity: StaggeredField::zeros(grid),
            positions: Vec::new(),
            values: Vec::new(),
            scaled: Vec::new(),
            stiffness: stiffness(nodes, std::f64::consts::TAU),
            work: FlowWork::default(),
            solver,
        })
    }

    /// The grid.
    #[must_use]
    pub fn grid(&self) -> &Grid {
        self.solver.grid()
    }

    fn solve(&mut self) -> Result<SolveReport, FlowError> {
        let before = self.solver.work();
        let report = self.solver.solve(&self.density, &mut self.velocity)?;
        let after = self.solver.work();
        let transforms = |work: stokes_grid::Work| work.forward_transforms + work.inverse_transforms;
        self.work.stokes_solves += after.solves - before.solves;
        self.work.transforms += transforms(after) - transforms(before);
        Ok(report)
    }

    /// The flow on the grid of the forces on inner points alone, and what drives it.
    fn solve_inner(&mut self, forces: &[Vec2]) -> Result<SolveReport, FlowError> {
        if self.curves.inner.is_empty() && matches!(self.solver.drive(), Drive::ZeroGradient | Drive::ZeroFlux) {
            self.density.fill(0.0);
            self.velocity.fill(0.0);
            return Ok(SolveReport::default());
        }
        self.values.clear();
        self.values.extend(self.curves.inner.iter().map(|marker| forces[*marker]));
        self.density.fill(0.0);
        self.inner.spread(&self.values, &mut self.density)?;
        self.work.markers_spread += self.values.len();
        self.solve()
    }

    /// The flow on the grid of all forces, after [`ImmersedLayers::solve_inner`].
    fn solve_all(&mut self) -> Result<SolveReport, FlowError> {
        let forces = &self.curves.grid[1];
        self.nodes.spread(forces, &mut self.density)?;
        self.work.markers_spread += forces.len();
        self.solve()
    }

    /// Refuses inner points too far beyond a wall; layers see to their own.
    fn check_walls(&self, markers: &Markers) -> Result<(), FlowError> {
        let grid = self.grid();
        let (bottom, allowed) = (grid.origin()[1], WALL_TOLERANCE * grid.spacing());
        let top = bottom + grid.lengths()[1];
        for &marker in self.curves.inner.iter().filter(|_| grid.has_walls()) {
            let Vec2 { x, y } = markers.positions[marker];
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
        self.positions.extend(self.curves.inner.iter().map(|marker| markers.positions[*marker]));
        self.inner.locate(&self.positions);
        self.layer.load(self.curves.layers())?;
        Ok(())
    }

    /// Velocities at the nodes of layers: viscosity times those of layers, and those of inner points on the grid.
    fn solve_layers(&mut self, forces: &[Vec2]) -> Result<(), FlowError> {
        let curves = &mut self.curves;
        self.layer.apply(&curves.forces, &mut curves.velocities)?;
        self.solve_inner(forces)?;
        let curves = &mut self.curves;
        self.nodes.interpolate(&self.velocity, &mut curves.grid[2])?;
        curves.add_grid(self.solver.viscosity())
    }

    /// Whether all fluid has one viscosity.
    fn is_uniform(&self, markers: &Markers) -> bool {
        let viscosity = self.solver.viscosity();
        let same = |group: &MarkerGroup| group.viscosities(viscosity).iter().all(|value| *value == viscosity);
        let uniform = |group: &MarkerGroup| group.kind != MarkerKind::Rigid && same(group);
        markers.groups().iter().all(uniform)
    }

    /// The flow of layers and inner points at the nodes of layers, where viscosities differ with the forces on layers
    /// that take their place.
    fn solve_nodes(&mut self, markers: &Markers) -> Result<Outcome, FlowError> {
        self.load(markers)?;
        self.solve_layers(&markers.forces)?;
        if self.is_uniform(markers) {
            return Ok(Outcome::default());
        }
        let (viscosity, entries) = (self.solver.viscosity(), self.curves.interface_entries());
        self.contrast.load(markers)?;
        let Solution { iterations, residual, .. } = self.contrast.solve(&self.curves.velocities[..entries])?;
        let points = || markers.groups().iter().filter(|group| !group.kind.is_interface());
        if points().any(|group| group.viscosity_outside.is_some_and(|outside| outside != viscosity)) {
            let mut scaled = std::mem::take(&mut self.scaled);
            scaled.clone_from(&markers.forces);
            for group in points() {
                let factor = viscosity / group.viscosity_outside.unwrap_or(viscosity);
                scaled[group.range.clone()].iter_mut().for_each(|force| *force *= factor);
            }
            self.curves.load_forces(&scaled)?;
            self.solve_layers(&scaled)?;
            self.scaled = scaled;
        }
        let LayerCurves { forces, velocities, .. } = &mut self.curves;
        let found = self.contrast.add_forces(&mut self.layer, entries, forces, velocities)?;
        self.curves.refine_forces()?;
        let iterations = iterations + found.iterations;
        self.work.iterations += iterations;
        self.work.most_iterations = self.work.most_iterations.max(iterations);
        Ok(Outcome { iterations, residual: residual.max(found.residual) })
    }

    /// Takes the pressure (force per length) from the interfaces' own layers and, on the grid, from all other forces.
    fn sample_pressure(&mut self, markers: &Markers, points: &[Vec2], out: &mut [FlowSample]) -> Result<(), FlowError> {
        let mut others = markers.forces.clone();
        for group in markers.groups().iter().filter(|group| group.kind.is_interface()) {
            others[group.range.clone()].fill(Vec2::ZERO);
        }
        self.curves.load_forces(&others)?;
        self.solve_inner(&others)?;
        self.solve_all()?;
        let pressure = self.pressure()?;
        let mut own = vec![FlowSample::default(); points.len()];
        self.contrast.sample(points, &mut own)?;
        for ((out, own), point) in out.iter_mut().zip(own).zip(points) {
            out.pressure = own.pressure + sampling::pressure(&pressure, *point);
        }
        Ok(())
    }

    fn pressure(&mut self) -> Result<CentreField, FlowError> {
        let mut pressure = CentreField::zeros(*self.grid());
        self.solver.pressure(&self.density, &self.velocity, &mut pressure)?;
        Ok(pressure)
    }
}

impl<S: StokesSolver, K: Kernel + Clone> Hydrodynamics for ImmersedLayers<S, K> {
    fn discretisation(&self) -> Discretisation {
        let grid = self.grid();
        let ([lx, ly], [_, bottom]) = (grid.lengths(), grid.origin());
        let walls = grid.has_walls().then_some([bottom, bottom + ly]);
        Discretisation {
            domain: Domain { origin: grid.origin(), periods: [Some(lx), walls.is_none().then_some(ly)], walls },
            viscosity: self.solver.viscosity(),
            spacing: Some(grid.spacing()),
            shape_modes: Some(self.modes),
            interface_stiffness: self.stiffness,
        }
    }

    fn drive(&self) -> Option<Drive> {
        self.grid().has_walls().then(|| self.solver.drive())
    }

    fn velocities(&mut self, markers: &mut Markers) -> Result<SolveReport, FlowError> {
        let Outcome { iterations, residual } = self.solve_nodes(markers)?;
        self.work.evaluations += 1;
        let viscosity = self.solver.viscosity();
        let interfaces = markers.groups().iter().filter(|group| group.kind.is_interface());
        let rates = interfaces.zip(self.curves.interface_lengths()).map(|(group, length)| {
            let [inside, outside] = group.viscosities(viscosity);
            stiffness(self.modes, length) * 2.0 * outside / (outside + inside)
        });
        if let Some(fastest) = rates.reduce(f64::max) {
            self.stiffness = fastest;
        }
        self.curves.write(1.0 / viscosity, &mut markers.velocities)?;
        let report = self.solve_all()?;
        self.inner.interpolate(&self.velocity, &mut self.values)?;
        for (&marker, velocity) in self.curves.inner.iter().zip(&self.values) {
            markers.velocities[marker] = *velocity;
        }
        Ok(SolveReport { iterations, residual, ..report })
    }

    /// Interpolates bilinearly between grid points; where viscosities differ the interfaces' pressure is that of their
    /// layers.
    fn sample(&mut self, markers: &Markers, points: &[Vec2], out: &mut [FlowSample]) -> Result<(), FlowError> {
        same_length("the samples", points.len(), out.len())?;
        all_points_finite("the points to sample", points)?;
        self.solve_nodes(markers)?;
        self.solve_all()?;
        let pressure = self.pressure()?;
        sampling::sample(&self.velocity, &pressure, points, out);
        if self.is_uniform(markers) { Ok(()) } else { self.sample_pressure(markers, points, out) }
    }

    fn work(&self) -> FlowWork {
        self.work
    }

    fn save(&self) -> SavedState {
        let mut saved = self.contrast.save();
        saved.reals.push(self.stiffness);
        saved
    }

    fn load(&mut self, saved: &SavedState) {
        if let [rest @ .., stiffness] = saved.reals.as_slice() {
            self.stiffness = *stiffness;
            self.contrast.restore(rest, &saved.counts);
        }
    }
}

/// A quarter of the largest wave number of a curve.
fn stiffness(nodes: usize, perimeter: f64) -> f64 {
    0.25 * (nodes / 2) as f64 * std::f64::consts::TAU / perimeter
}

#[cfg(test)]
mod tests;

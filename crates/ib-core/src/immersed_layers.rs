//! Interfaces and surfaces of solids as layers, the inner points of solids on a grid.

mod curves;

use input_checks::{all_points_finite, same_length, within};
use stokes_grid::{CentreField, Drive, Grid, SolveReport, StaggeredField, StokesSolver};
use stokes_layers::{Forcing, Geometry, Reciprocity, SingleLayer};

use crate::immersed_boundary::{WALL_TOLERANCE, sampling};
use crate::{
    Discretisation, Domain, FlowError, FlowSample, Hydrodynamics, Kernel, Markers, Transfer, Vec2,
    checkpoint::SavedState, hydrodynamics::FlowWork,
};
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
    /// For inner points and for grid nodes of layers.
    inner: Transfer<K>,
    nodes: Transfer<K>,
    density: StaggeredField,
    velocity: StaggeredField,
    /// Of the inner points.
    positions: Vec<Vec2>,
    values: Vec<Vec2>,
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
            curves: LayerCurves::new(length, grid.spacing(), nodes),
            inner: Transfer::new(grid, kernel.clone()),
            nodes: Transfer::new(grid, kernel),
            density: StaggeredField::zeros(grid),
            velocity: StaggeredField::zeros(grid),
            positions: Vec::new(),
            values: Vec::new(),
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

    /// The flow on the grid of the forces on inner points alone.
    fn solve_inner(&mut self, markers: &Markers) -> Result<SolveReport, FlowError> {
        self.positions.clear();
        self.values.clear();
        for &marker in &self.curves.inner {
            self.positions.push(markers.positions[marker]);
            self.values.push(markers.forces[marker]);
        }
        self.inner.locate(&self.positions);
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
        let viscosity = self.solver.viscosity();
        self.curves.load(markers)?;
        if markers.groups().iter().any(|group| group.viscosities(viscosity).iter().any(|value| *value != viscosity)) {
            return Err(FlowError::Unsupported {
                what: "fluid of another viscosity beside solids whose surfaces are layers",
                remedy: "leave the layers out",
            });
        }
        self.check_walls(markers)?;
        self.nodes.locate(&self.curves.grid[0]);
        Ok(())
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
            mobility_deficit: None,
        }
    }

    fn drive(&self) -> Option<Drive> {
        self.grid().has_walls().then(|| self.solver.drive())
    }

    fn velocities(&mut self, markers: &mut Markers) -> Result<SolveReport, FlowError> {
        self.load(markers)?;
        self.work.evaluations += 1;
        if let Some(shortest) = self.curves.shortest_interface() {
            self.stiffness = stiffness(self.modes, shortest);
        }
        let curves = &mut self.curves;
        self.layer.load(curves.layers())?;
        self.layer.apply(&curves.forces, &mut curves.velocities)?;
        self.solve_inner(markers)?;
        let curves = &mut self.curves;
        self.nodes.interpolate(&self.velocity, &mut curves.grid[2])?;
        curves.write(1.0 / self.solver.viscosity(), &mut markers.velocities)?;
        let report = self.solve_all()?;
        self.inner.interpolate(&self.velocity, &mut self.values)?;
        for (&marker, velocity) in self.curves.inner.iter().zip(&self.values) {
            markers.velocities[marker] = *velocity;
        }
        Ok(report)
    }

    /// Interpolates bilinearly between grid points.
    fn sample(&mut self, markers: &Markers, points: &[Vec2], out: &mut [FlowSample]) -> Result<(), FlowError> {
        same_length("the samples", points.len(), out.len())?;
        all_points_finite("the points to sample", points)?;
        self.load(markers)?;
        self.solve_inner(markers)?;
        self.solve_all()?;
        let mut pressure = CentreField::zeros(*self.grid());
        self.solver.pressure(&self.density, &self.velocity, &mut pressure)?;
        sampling::sample(&self.velocity, &pressure, points, out);
        Ok(())
    }

    fn work(&self) -> FlowWork {
        self.work
    }

    fn save(&self) -> SavedState {
        SavedState { reals: vec![self.stiffness], counts: Vec::new() }
    }

    fn load(&mut self, saved: &SavedState) {
        if let &[stiffness] = saved.reals.as_slice() {
            self.stiffness = stiffness;
        }
    }
}

/// A quarter of the largest wave number of a curve.
fn stiffness(nodes: usize, perimeter: f64) -> f64 {
    0.25 * (nodes / 2) as f64 * std::f64::consts::TAU / perimeter
}

#[cfg(test)]
mod tests;

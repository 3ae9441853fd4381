//! Interfaces between different viscosities by a viscosity that is smeared over the kernel, Cowley's way.

use motile_base::Drive;
use stokes_grid::{
    CentreField, Grid, NodeField, RealFft2, StaggeredField, StokesError, StokesSolver, Symbol, TwoPhaseStokes,
};

use super::{flow_error, load_memory, other_viscosities};
use crate::{ImmersedBoundary, Kernel, Transfer};
use motile_base::{FlowSample, SolveReport, Vec2};
use motile_scene::{FlowError, FlowWork, FluidView, Hydrodynamics, Markers, Warning, checkpoint::SavedState};

/// Error of the speed of a swimmer at a tenth of its radius, in %: -0.5, 1.2 and 3.1 at activities of -2, -3 and -4 in
/// a 6 x 6 box.
const UNCORRECTED_ERROR: f64 = 3.1;

/// The immersed boundary method with the viscosity as a smooth field on the grid (Cowley section 2.2.4): the outward
/// normals of the interfaces, spread like forces, are minus the gradient of an indicator that is one inside,
///
/// `lap H = -div(sum n ds delta_h)` (2.42), (2.43), `eta = eta_ext + (eta_in - eta_ext) H` (2.44),
///
/// and a solver for viscosity that varies does the rest. Nodes take the arithmetic mean of the four centres around
/// them.
///
/// It is of first order in h, and the errors grow with the ratio of viscosities. At h = R/20, a droplet a hundred times
/// as viscous as the exterior fluid is 25 to 40 % too fast. Boundary integrals
/// (`motile_boundary_integrals::ImmersedLayers`) do better at a fraction of the cost. Use this method to reproduce
/// Cowley. There is no mobility correction. If all viscosities are equal, this is [`ImmersedBoundary::uncorrected`].
#[derive(Debug, Clone)]
#[doc(alias("viscosity ratio", "viscosity contrast", "variable viscosity"))]
pub struct SmearedContrast<S, K> {
    flow: ImmersedBoundary<TwoPhaseStokes<S>, K>,
    transfer: Transfer<K>,
    normals: StaggeredField,
    indicator: Indicator,
    spread: Vec<Vec2>,
    positions: Vec<Vec2>,
    centres: CentreField,
    nodes: NodeField,
    /// True if the fields hold viscosities that differ from the exterior one.
    varies: bool,
}

/// The Poisson problem of the indicator.
#[derive(Debug, Clone)]
struct Indicator {
    transform: RealFft2,
    symbol: Symbol,
    /// Rows of the transform: twice the rows of a channel, whose solution is continued as an odd function.
    rows: usize,
}

impl Indicator {
    fn new(grid: &Grid) -> Result<Self, StokesError> {
        let (nx, h) = (grid.nx(), grid.spacing());
        let rows = if grid.has_walls() { 2 * grid.ny() } else { grid.ny() };
        let difference = |m: usize, n: usize| (2.0 * (std::f64::consts::PI * m as f64 / n as f64).sin()).powi(2);
        let symbol = Symbol::new(nx, rows, |m, n| {
            let laplacian = -(difference(m, nx) + difference(n, rows)) / (h * h);
            if m == 0 && n == 0 { 0.0 } else { 1.0 / laplacian }
        })?;
        Ok(Self { transform: RealFft2::new(nx, rows)?, symbol, rows })
    }

    /// `lap out = -div(field)`, of mean zero in a box and zero on the walls of a channel.
    fn solve(&mut self, field: &StaggeredField, out: &mut [f64]) {
        let grid = *field.grid();
        let (nx, ny, h) = (grid.nx(), grid.ny(), grid.spacing());
        let (x, y) = (field.x(), field.y());
        let folded = self.rows > ny;
        // Made of one size, so that the call cannot fail.
        let _ = self.transform.filter(
            &self.symbol,
            |j, row| {
                let (j, sign) = if j < ny { (j, -1.0) } else { (2 * ny - 1 - j, 1.0) };
                let above = if j + 1 == ny && !folded { 0 } else { j + 1 };
                for (i, value) in row.iter_mut().enumerate() {
                    let right = if i + 1 == nx { 0 } else { i + 1 };
                    let divergence = x[j * nx + right] - x[j * nx + i] + y[above * nx + i] - y[j * nx + i];
                    *value = sign * divergence / h;
                }
            },
            |j, row| {
                if j < ny {
                    out[j * nx..(j + 1) * nx].copy_from_slice(row);
                }
            },
        );
    }
}

impl<S: StokesSolver, K: Kernel> SmearedContrast<S, K> {
    /// Creates the method around a solver of one viscosity, the exterior one, with a relative tolerance of 1e-6.
    ///
    /// # Errors
    /// Returns the errors of the solver.
    pub fn new(solver: S, kernel: K) -> Result<Self, StokesError> {
        Self::with_tolerance(solver, kernel, 1e-6)
    }

    /// Creates the flow with another tolerance; see [`TwoPhaseStokes::tolerance`].
    ///
    /// # Errors
    /// Returns an error for a tolerance that is not positive and finite; the errors of the solver.
    pub fn with_tolerance(solver: S, kernel: K, tolerance: f64) -> Result<Self, StokesError> {
        let grid = *solver.grid();
        let solver = TwoPhaseStokes::new(solver)?.with_tolerance(tolerance)?;
        let (centres, nodes) = solver.viscosity_fields();
        let (centres, nodes) = (centres.clone(), nodes.clone());
        Ok(Self {
            transfer: Transfer::new(grid, kernel.clone()),
            flow: ImmersedBoundary::with_varying_viscosity(solver, kernel),
            normals: StaggeredField::zeros(grid),
            indicator: Indicator::new(&grid)?,
            spread: Vec::new(),
            positions: Vec::new(),
            centres,
            nodes,
            varies: false,
        })
    }

    /// Returns the immersed boundary method with its fields.
    #[must_use]
    pub fn flow(&self) -> &ImmersedBoundary<TwoPhaseStokes<S>, K> {
        &self.flow
    }

    /// Returns the viscosity (stress times time) at the centres and at the nodes, of the last evaluation.
    #[must_use]
    pub fn viscosity_fields(&self) -> (&CentreField, &NodeField) {
        (&self.centres, &self.nodes)
    }

    /// Brings the viscosity up to date with the markers.
    fn set_viscosity(&mut self, markers: &Markers) -> Result<(), FlowError> {
        let exterior = self.flow.solver().viscosity();
        self.spread.clear();
        self.positions.clear();
        let (mut least, mut most, mut mean) = (exterior, exterior, exterior);
        let grid = *self.centres.grid();
        let [lx, ly] = grid.lengths();
        for group in markers.groups() {
            let Some([inside, outside]) = other_viscosities(group, exterior)? else { continue };
            let positions = &markers.positions()[group.range.clone()];
            let count = positions.len();
            for k in 0..count {
                let d = 0.5 * (positions[(k + 1) % count] - positions[(k + count - 1) % count]);
                let normal = Vec2::new(d.y, -d.x);
                mean += (inside - outside) * 0.5 * (positions[k] - positions[0]).dot(normal) / (lx * ly);
                self.spread.push((inside - outside) * normal);
                self.positions.push(positions[k]);
            }
            (least, most) = (least.min(inside), most.max(inside));
        }
        if self.spread.is_empty() && !self.varies {
            return Ok(());
        }
        self.varies = !self.spread.is_empty();
        self.normals.fill(0.0);
        self.transfer.locate(&self.positions);
        self.transfer.spread(&self.spread, &mut self.normals).map_err(flow_error)?;
        let (nx, ny) = (grid.nx(), grid.ny());
        let centres = self.centres.values_mut();
        self.indicator.solve(&self.normals, centres);
        let shift = if grid.has_walls() { exterior } else { mean };
        centres.iter_mut().for_each(|value| *value = (*value + shift).clamp(least, most));
        for (k, node) in self.nodes.values_mut().iter_mut().enumerate() {
            let (i, j) = (k % nx, k / nx);
            let left = if i == 0 { nx - 1 } else { i - 1 };
            let (below, here) = if grid.has_walls() {
                (j.saturating_sub(1), j.min(ny - 1))
            } else {
                (if j == 0 { ny - 1 } else { j - 1 }, j)
            };
            let sum = centres[below * nx + left]
                + centres[below * nx + i]
                + centres[here * nx + left]
                + centres[here * nx + i];
            *node = 0.25 * sum;
        }
        self.flow.solver_mut().set_viscosity_fields(&self.centres, &self.nodes).map_err(flow_error)?;
        Ok(())
    }
}

impl<S: StokesSolver, K: Kernel> Hydrodynamics for SmearedContrast<S, K> {
    fn fluid_view(&self) -> FluidView {
        self.flow.fluid_view()
    }

    fn drive(&self) -> Option<Drive> {
        self.flow.drive()
    }

    fn wall_slip(&self) -> Option<[f64; 2]> {
        self.flow.wall_slip()
    }

    fn friction(&self) -> f64 {
        Hydrodynamics::friction(&self.flow)
    }

    fn velocities(&mut self, markers: &mut Markers) -> Result<SolveReport, FlowError> {
        self.flow.check(markers)?;
        self.set_viscosity(markers)?;
        self.flow.velocities(markers)
    }

    fn sample(&mut self, markers: &Markers, points: &[Vec2], out: &mut [FlowSample]) -> Result<(), FlowError> {
        self.flow.check(markers)?;
        self.set_viscosity(markers)?;
        self.flow.sample(markers, points, out)
    }

    fn work(&self) -> FlowWork {
        self.flow.work()
    }

    fn warnings(&self) -> Vec<Warning> {
        let message = format!(
            "velocities are not corrected and of first order in the spacing {}: with one of a tenth of the radius the \
             speed of a swimmer is up to 3 per cent off; use the methods integral or layers, or corrected = true with \
             one viscosity and no solids",
            self.flow.grid().spacing()
        );
        let (body, cause) = ("flow".to_owned(), "interfaces smeared over the grid".into());
        vec![Warning { body, cause, excess: UNCORRECTED_ERROR, message }]
    }

    fn save(&self) -> SavedState {
        let mut saved = SavedState::default();
        for solution in self.flow.solver().solutions() {
            saved.reals.extend_from_slice(solution.x());
            saved.reals.extend_from_slice(solution.y());
            saved.counts.push(solution.x().len() as u64);
        }
        saved.reals.extend_from_slice(self.flow.solver().memory());
        saved
    }

    fn load(&mut self, saved: &SavedState) {
        let grid = *self.centres.grid();
        let mut values = saved.reals.as_slice();
        let mut solutions = Vec::new();
        for _ in 0..saved.counts.len().min(2) {
            let mut solution = StaggeredField::zeros(grid);
            let (x, y) = solution.components_mut();
            if values.len() < x.len() + y.len() {
                return;
            }
            for list in [x, y] {
                let (own, rest) = values.split_at(list.len());
                list.copy_from_slice(own);
                values = rest;
            }
            solutions.push(solution);
        }
        // All are on the solver's grid.
        let taken = self.flow.solver_mut().set_solutions(&solutions);
        debug_assert!(taken.is_ok());
        load_memory(self.flow.solver_mut(), values);
    }

    fn rewind(&mut self) {
        self.flow.rewind();
    }
}

#[cfg(test)]
mod tests;

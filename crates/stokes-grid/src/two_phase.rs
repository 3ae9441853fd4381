//! Stokes flow with a viscosity that varies in space, by conjugate gradients.

mod viscous_force;

use motile_base::{Drive, SolveReport, positive};

use crate::{CentreField, NodeField, StaggeredField, StokesError, StokesSolver, WallMotion, Work};
use viscous_force::ViscousForce;

/// Relative residual at first: far below the error of second order on any grid that is used.
const TOLERANCE: f64 = 1e-6;
/// Iterations after which a solution fails at first: conjugate gradients take `sqrt(ratio)/2 ln(2/tolerance)`, so that
/// as many are enough for a ratio of viscosities of 7e4.
const MOST_ITERATIONS: usize = 2000;
/// Starts of the conjugate gradients in one solve: a second one ends the drift by round-off, a third one the drift of
/// the second.
const MOST_STARTS: usize = 3;
/// Ratio of the true residual to the goal, squared, that is taken for round-off: 10 % of the residual.
const DRIFT: f64 = 1.21;

/// Stokes flow with a viscosity eta(x, y) that varies in space,
///
/// `div(2 eta D(v)) - grad p + f = 0`, `div v = 0`,
///
/// on the grid and with the walls and the drive of a solver S of one viscosity (Cowley section 2.2.4).
///
/// The method is conjugate gradients among the velocities without divergence, preconditioned by S: each iteration costs
/// one solve of S and one viscous force. The number of iterations grows like the square root of the ratio of the
/// largest to the smallest viscosity and depends neither on the grid nor on the viscosity of S. For a uniform viscosity
/// one is enough, and none if it is the viscosity of S. Normal stresses use the viscosity at the centres, and shear
/// stresses the viscosity at the nodes.
///
/// **Start.** Each solution starts from the linear extrapolation of the two before, which halves the iterations where
/// the viscosity and the forces move slowly.
///
/// **Accuracy.** Iterations end when the residual r, in the norm `sqrt(r . S r)`, is below
/// [`TwoPhaseStokes::tolerance`] times the norm of the forces. [`SolveReport::residual`] is the true residual,
/// recomputed from the solution.
///
/// [`StokesSolver::viscosity`] is the viscosity of S, by convention the viscosity of the exterior fluid.
///
/// ```
/// use stokes_grid::{Grid, PeriodicStokes, StaggeredField, StokesSolver, TwoPhaseStokes};
///
/// let grid = Grid::periodic(48, 48, 1.0 / 48.0)?;
/// let mut flow = TwoPhaseStokes::new(PeriodicStokes::new(grid, 1.0)?)?;
/// // A layer a hundred times as viscous as the rest.
/// flow.set_viscosity(|_, y| if y > 0.0 { 100.0 } else { 1.0 })?;
/// let mut force = StaggeredField::zeros(grid);
/// force.components_mut().0[12 * 48 + 7] = 1.0;
/// let mut velocity = StaggeredField::zeros(grid);
/// let report = flow.solve(&force, &mut velocity)?;
/// println!("{} iterations", report.iterations);
/// assert!(report.residual < 1e-6 && report.iterations < 80);
/// # Ok::<(), stokes_grid::StokesError>(())
/// ```
#[derive(Debug, Clone)]
#[doc(alias("viscosity ratio", "viscosity contrast", "two-phase flow", "variable viscosity"))]
pub struct TwoPhaseStokes<S> {
    solver: S,
    force: ViscousForce,
    /// True if the viscosity equals the viscosity of the solver everywhere.
    uniform: bool,
    tolerance: f64,
    most: usize,
    /// Flow without forces, and its mean pressure gradient.
    imposed: StaggeredField,
    gradient: [f64; 2],
    /// Solutions of the last two solves, the latest first, and the number of those that are known.
    previous: [StaggeredField; 2],
    known: usize,
    residual: StaggeredField,
    preconditioned: StaggeredField,
    direction: StaggeredField,
    image: StaggeredField,
    solution: StaggeredField,
    /// Pressure of the flow without forces.
    imposed_pressure: CentreField,
    history: Vec<f64>,
    work: Work,
}

impl<S: StokesSolver> TwoPhaseStokes<S> {
    /// Creates a solver with the viscosity of `solver` everywhere at first, a tolerance of 1e-6 and at most 2000
    /// iterations.
    ///
    /// # Errors
    /// Returns the errors of `solver`.
    pub fn new(mut solver: S) -> Result<Self, StokesError> {
        let grid = *solver.grid();
        let (eta, friction) = (solver.viscosity(), solver.friction());
        let field = || StaggeredField::zeros(grid);
        let (mut centres, mut nodes) = (CentreField::zeros(grid), NodeField::zeros(grid));
        centres.values_mut().fill(eta);
        nodes.values_mut().fill(eta);
        let mut imposed = field();
        let gradient = solver.solve(&field(), &mut imposed)?.mean_pressure_gradient;
        solver.set_memory(&[])?;
        Ok(Self {
            solver,
            force: ViscousForce::new(centres, nodes, friction),
            uniform: true,
            tolerance: TOLERANCE,
            most: MOST_ITERATIONS,
            imposed,
            gradient,
            previous: [field(), field()],
            known: 0,
            residual: field(),
            preconditioned: field(),
            direction: field(),
            image: field(),
            solution: field(),
            imposed_pressure: CentreField::zeros(grid),
            history: Vec::with_capacity(MOST_ITERATIONS + 1),
            work: Work::default(),
        })
    }

    /// Sets the tolerance of the relative residual.
    ///
    /// # Errors
    /// Returns an error for a tolerance that is not positive and finite.
    pub fn with_tolerance(mut self, tolerance: f64) -> Result<Self, StokesError> {
        self.tolerance = positive("the tolerance", tolerance)?;
        Ok(self)
    }

    /// Sets the largest number of iterations.
    #[must_use]
    pub fn with_most_iterations(mut self, most: usize) -> Self {
        self.most = most;
        self.history.reserve(most + 1);
        self
    }

    /// Returns the last solutions, the latest first, from which the next iteration starts: none at first, two after two
    /// solves.
    pub fn solutions(&self) -> impl Iterator<Item = &StaggeredField> {
        self.previous.iter().take(self.known)
    }

    /// Takes over the last solutions, the latest first, as [`TwoPhaseStokes::solutions`] lists them. More than two are
    /// ignored.
    ///
    /// # Errors
    /// Returns an error for fields on another grid.
    pub fn set_solutions<'a>(
        &mut self,
        solutions: impl IntoIterator<Item = &'a StaggeredField>,
    ) -> Result<(), StokesError> {
        self.known = 0;
        for (own, solution) in self.previous.iter_mut().zip(solutions) {
            self.solver.grid().check([("a solution", solution.grid())])?;
            own.copy_from(solution);
            self.known += 1;
        }
        Ok(())
    }

    /// Returns the tolerance of the relative residual.
    #[must_use]
    pub fn tolerance(&self) -> f64 {
        self.tolerance
    }

    /// Returns the solver of one viscosity.
    #[must_use]
    pub fn solver(&self) -> &S {
        &self.solver
    }

    /// Returns the viscosity (stress times time) at the centres and at the nodes.
    #[must_use]
    pub fn viscosity_fields(&self) -> (&CentreField, &NodeField) {
        self.force.viscosity()
    }

    /// Returns the relative residuals of the last solve, at its start and after each iteration.
    #[must_use]
    pub fn history(&self) -> &[f64] {
        &self.history
    }

    /// Sets the viscosity (stress times time) to a function of x and y (length).
    ///
    /// # Errors
    /// Returns the errors of [`TwoPhaseStokes::set_viscosity_fields`].
    pub fn set_viscosity(&mut self, viscosity: impl Fn(f64, f64) -> f64) -> Result<(), StokesError> {
        let grid = *self.solver.grid();
        let (nx, h, [x0, y0]) = (grid.nx(), grid.spacing(), grid.origin());
        let at =
            |shift: f64, k: usize| viscosity(x0 + ((k % nx) as f64 + shift) * h, y0 + ((k / nx) as f64 + shift) * h);
        let (mut centres, mut nodes) = (CentreField::zeros(grid), NodeField::zeros(grid));
        centres.values_mut().iter_mut().enumerate().for_each(|(k, value)| *value = at(0.5, k));
        nodes.values_mut().iter_mut().enumerate().for_each(|(k, value)| *value = at(0.0, k));
        self.set_viscosity_fields(&centres, &nodes)
    }

    /// Sets the viscosity (stress times time) at the centres and at the nodes.
    ///
    /// # Errors
    /// Returns an error for:
    /// * fields of another grid, a value that is not positive and finite, or viscosities that differ from the viscosity
    ///   of a solver with lagged walls ([`StokesError::Refused`]),
    /// * the viscosity is then left as it was.
    pub fn set_viscosity_fields(&mut self, centres: &CentreField, nodes: &NodeField) -> Result<(), StokesError> {
        let fields = [("the viscosity at the centres", centres.grid()), ("the viscosity at the nodes", nodes.grid())];
        self.solver.grid().check(fields)?;
        for &value in centres.values().iter().chain(nodes.values()) {
            positive("viscosity", value)?;
        }
        let viscosity = self.solver.viscosity();
        let uniform = centres.values().iter().chain(nodes.values()).all(|value| *value == viscosity);
        if !uniform && self.solver.has_memory() {
            return Err(StokesError::lagged_walls());
        }
        self.uniform = uniform;
        let (at_centres, at_nodes) = self.force.viscosity_mut();
        at_centres.copy_from_slice(centres.values());
        at_nodes.copy_from_slice(nodes.values());
        Ok(())
    }

    /// Drops the last solutions, so that the next one starts from the flow without forces.
    pub fn forget(&mut self) {
        self.known = 0;
    }

    /// Computes `self.preconditioned` from `self.residual`; returns the product of both and the mean pressure gradient.
    fn precondition(&mut self) -> Result<(f64, [f64; 2]), StokesError> {
        let report = self.solver.solve(&self.residual, &mut self.preconditioned)?;
        self.preconditioned.combine(1.0, -1.0, &self.imposed);
        Ok((dot(&self.residual, &self.preconditioned), report.mean_pressure_gradient))
    }

    /// Computes `self.residual` of `self.solution`.
    fn fill_residual(&mut self, force: &StaggeredField) {
        let Self { force: viscous, solution, solver, residual, gradient, .. } = self;
        viscous.add(solution, solver.walls(), 1.0, Some(force), residual);
        if solver.grid().has_walls() {
            residual.components_mut().0.iter_mut().for_each(|value| *value -= gradient[0]);
        }
    }

    /// Runs conjugate gradients from `self.solution`, whose squared residual is `square`, until this is below `goal`;
    /// returns the iterations done.
    fn iterate(&mut self, mut square: f64, goal: f64, scale: f64, mut left: usize) -> Result<usize, StokesError> {
        let mut done = 0;
        let at_rest = self.solver.walls().at_rest();
        self.direction.copy_from(&self.preconditioned);
        while square > goal && left > 0 {
            self.force.add(&self.direction, &at_rest, -1.0, None, &mut self.image);
            let curvature = dot(&self.direction, &self.image);
            if !(curvature.is_finite() && curvature > 0.0) {
                break;
            }
            let step = square / curvature;
            self.solution.combine(1.0, step, &self.direction);
            self.residual.combine(1.0, -step, &self.image);
            let (next, _) = self.precondition()?;
            self.direction.combine(next / square, 1.0, &self.preconditioned);
            square = next;
            self.history.push((square.max(0.0) / scale).sqrt());
            done += 1;
            left -= 1;
        }
        Ok(done)
    }
}

impl<S: StokesSolver> StokesSolver for TwoPhaseStokes<S> {
    fn grid(&self) -> &crate::Grid {
        self.solver.grid()
    }

    fn viscosity(&self) -> f64 {
        self.solver.viscosity()
    }

    fn friction(&self) -> f64 {
        self.solver.friction()
    }

    fn walls(&self) -> &WallMotion {
        self.solver.walls()
    }

    fn drive(&self) -> Drive {
        self.solver.drive()
    }

    fn solve(&mut self, force: &StaggeredField, velocity: &mut StaggeredField) -> Result<SolveReport, StokesError> {
        self.solver.grid().check([("the force", force.grid()), ("the velocity", velocity.grid())])?;
        self.history.clear();
        if self.uniform {
            self.known = 0;
            self.work.solves += 1;
            return self.solver.solve(force, velocity);
        }
        self.solution.copy_from(&self.imposed);
        self.fill_residual(force);
        let (scale, mut gradient) = self.precondition()?;
        let mut square = scale;
        let mut iterations = 0;
        let mut residual = 0.0;
        if scale > 0.0 {
            if self.known > 0 {
                self.solution.copy_from(&self.previous[0]);
                if self.known > 1 {
                    self.solution.combine(2.0, -1.0, &self.previous[1]);
                }
                self.fill_residual(force);
                (square, gradient) = self.precondition()?;
            }
            let goal = self.tolerance * self.tolerance * scale;
            self.history.push((square.max(0.0) / scale).sqrt());
            // Round-off lets the recurrence drift from the true residual; the iteration then starts again from the
            // solution that it has reached.
            for _ in 0..MOST_STARTS {
                iterations += self.iterate(square, goal, scale, self.most - iterations)?;
                self.fill_residual(force);
                (square, gradient) = self.precondition()?;
                if square <= DRIFT * goal || iterations >= self.most {
                    break;
                }
            }
            residual = (square.max(0.0) / scale).sqrt();
            self.work.iterations += iterations;
            if square.is_nan() || square > DRIFT * goal {
                self.known = 0;
                let (tolerance, history) = (self.tolerance, self.history.clone());
                return Err(StokesError::NoConvergence { iterations, residual, tolerance, history });
            }
        }
        self.work.solves += 1;
        self.previous.swap(0, 1);
        self.previous[0].copy_from(&self.solution);
        self.known = (self.known + 1).min(2);
        velocity.copy_from(&self.solution);
        Ok(SolveReport { iterations, residual, mean_pressure_gradient: gradient })
    }

    /// Computes the pressure of the solver of one viscosity for the force that is left by the viscous stress. With one
    /// viscosity it is the solution of the solver, whose memory, if it has any, must not advance.
    fn pressure(
        &mut self,
        force: &StaggeredField,
        velocity: &StaggeredField,
        pressure: &mut CentreField,
    ) -> Result<(), StokesError> {
        let fields =
            [("the force", force.grid()), ("the velocity", velocity.grid()), ("the pressure", pressure.grid())];
        self.solver.grid().check(fields)?;
        if self.uniform && self.solver.has_memory() {
            return self.solver.pressure(force, velocity, pressure);
        }
        self.solution.copy_from(velocity);
        self.fill_residual(force);
        let Self { solver, residual, direction, image, imposed, imposed_pressure: own, .. } = self;
        solver.solve(residual, direction)?;
        solver.pressure(residual, direction, pressure)?;
        // The flow of the solver without forces, of moving walls say, has a pressure as well.
        image.fill(0.0);
        solver.pressure(image, imposed, own)?;
        for (pressure, own) in pressure.values_mut().iter_mut().zip(own.values()) {
            *pressure -= own;
        }
        Ok(())
    }

    fn work(&self) -> Work {
        let inner = self.solver.work();
        Work { solves: self.work.solves, iterations: self.work.iterations, ..inner }
    }

    fn has_memory(&self) -> bool {
        self.solver.has_memory()
    }

    fn memory(&self) -> &[f64] {
        self.solver.memory()
    }

    fn set_memory(&mut self, memory: &[f64]) -> Result<(), StokesError> {
        self.solver.set_memory(memory)
    }

    fn rewind(&mut self) {
        self.solver.rewind();
    }
}

/// Returns the scalar product of two fields.
fn dot(a: &StaggeredField, b: &StaggeredField) -> f64 {
    motile_base::internal::dot(a.x(), b.x()) + motile_base::internal::dot(a.y(), b.y())
}

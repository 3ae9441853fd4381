//! What every Stokes solver does.

use serde::{Deserialize, Serialize};

use crate::{CentreField, Drive, Grid, StaggeredField, StokesError, WallMotion};

/// What one solve needed and found.
#[derive(Debug, Clone, Copy, PartialEq, Default, Serialize, Deserialize)]
pub struct SolveReport {
    /// Iterations (0 for a direct solver).
    pub iterations: usize,
    /// Relative residual (0 for a direct solver, which is exact to round-off).
    pub residual: f64,
    /// Mean pressure gradient (force per volume): the part of grad p that is uniform. Periodic box: the mean force.
    pub mean_pressure_gradient: [f64; 2],
}

/// Work done since a solver was made.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct Work {
    /// Calls of [`StokesSolver::solve`].
    pub solves: usize,
    /// Real transforms from space to wave numbers, each of a whole scalar field.
    pub forward_transforms: usize,
    /// Real transforms from wave numbers to space, each of a whole scalar field.
    pub inverse_transforms: usize,
    /// Iterations of iterative solvers.
    pub iterations: usize,
}

/// A solver of the incompressible Stokes equations with a force density f (force per volume):
///
/// `eta lap(v) - grad p + f = 0`, `div v = 0`.
///
/// A solver is a plan: it is made once for a grid, owns its scratch, and allocates nothing per call.
pub trait StokesSolver: std::fmt::Debug + Send {
    /// The grid of the fields it takes and gives.
    fn grid(&self) -> &Grid;

    /// Dynamic viscosity eta (stress times time).
    fn viscosity(&self) -> f64;

    /// How the walls of a channel move; at rest in a periodic box.
    fn walls(&self) -> &WallMotion {
        static AT_REST: WallMotion = WallMotion::AT_REST;
        &AT_REST
    }

    /// What is held fixed along a channel; no mean pressure gradient is imposed on a periodic box.
    fn drive(&self) -> Drive {
        Drive::default()
    }

    /// The velocity for a force density; it is discretely divergence free.
    ///
    /// # Errors
    /// Fields of another grid, a force that is not finite (the velocity is then left as it was), a result beyond the
    /// range of double precision; for iterative solvers, no convergence.
    fn solve(&mut self, force: &StaggeredField, velocity: &mut StaggeredField) -> Result<SolveReport, StokesError>;

    /// The periodic part of the pressure (force per length in 2D), mean zero, that belongs to a force density and the
    /// velocity that [`StokesSolver::solve`] gave for it. The uniform part of its gradient is
    /// [`SolveReport::mean_pressure_gradient`].
    ///
    /// # Errors
    /// Fields of another grid, a force or velocity that is not finite, a result beyond the range of double precision.
    fn pressure(
        &mut self,
        force: &StaggeredField,
        velocity: &StaggeredField,
        pressure: &mut CentreField,
    ) -> Result<(), StokesError>;

    /// Work done since the solver was made.
    fn work(&self) -> Work;
}

impl<S: StokesSolver + ?Sized> StokesSolver for Box<S> {
    fn grid(&self) -> &Grid {
        (**self).grid()
    }

    fn viscosity(&self) -> f64 {
        (**self).viscosity()
    }

    fn walls(&self) -> &WallMotion {
        (**self).walls()
    }

    fn drive(&self) -> Drive {
        (**self).drive()
    }

    fn solve(&mut self, force: &StaggeredField, velocity: &mut StaggeredField) -> Result<SolveReport, StokesError> {
        (**self).solve(force, velocity)
    }

    fn pressure(
        &mut self,
        force: &StaggeredField,
        velocity: &StaggeredField,
        pressure: &mut CentreField,
    ) -> Result<(), StokesError> {
        (**self).pressure(force, velocity, pressure)
    }

    fn work(&self) -> Work {
        (**self).work()
    }
}

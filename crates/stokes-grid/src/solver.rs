//! The trait of Stokes solvers, and the count of their work.

use motile_base::{Drive, SolveReport, same_length};

use crate::{CentreField, Grid, StaggeredField, StokesError, WallMotion};

/// Work done since a solver was made.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
#[non_exhaustive]
pub struct Work {
    /// Calls of [`StokesSolver::solve`].
    pub solves: usize,
    /// Real transforms from space to wave numbers, each of a whole scalar field.
    pub forward_transforms: usize,
    /// Real transforms from wave numbers to space, each of a whole scalar field.
    pub inverse_transforms: usize,
    /// Real sine and cosine transforms across a channel, each of a whole scalar field.
    ///
    /// [`crate::ProjectionStokes`] uses them in channels. There, a transform in two dimensions as Cowley counts it is
    /// one of [`Work::forward_transforms`] or [`Work::inverse_transforms`], along x alone, and one of these.
    pub sine_cosine_transforms: usize,
    /// Iterations; 0 for direct solvers.
    pub iterations: usize,
}

/// A solver of the incompressible Stokes equations with a force density f (force per volume):
///
/// `eta lap(v) - alpha v - grad p + f = 0`, `div v = 0`,
///
/// with a friction alpha that is zero unless a solver has one ([`StokesSolver::friction`]).
///
/// A solver is made once for a grid, owns its working memory, and allocates nothing per call.
#[doc(alias("Stokes equations", "Stokes flow", "creeping flow", "low Reynolds number"))]
pub trait StokesSolver: std::fmt::Debug + Send {
    /// Returns the grid of the forces and velocities.
    fn grid(&self) -> &Grid;

    /// Returns the dynamic viscosity eta (stress times time).
    fn viscosity(&self) -> f64;

    /// Returns the friction alpha of the fluid with its substrate (stress times time per area), 0 by default.
    fn friction(&self) -> f64 {
        0.0
    }

    /// Returns the velocities of the walls of a channel; at rest in a periodic box.
    fn walls(&self) -> &WallMotion {
        static AT_REST: WallMotion = WallMotion::AT_REST;
        &AT_REST
    }

    /// Returns the prescribed mean pressure gradient or flux of a channel; no mean pressure gradient in a periodic box.
    fn drive(&self) -> Drive {
        Drive::default()
    }

    /// Computes the velocity (length per time) for a force density (force per volume); its discrete divergence is zero.
    ///
    /// # Errors
    /// Returns an error for fields of another grid, a force that is not finite (the velocity is then left as it was), a
    /// result beyond the range of double precision; for iterative solvers, no convergence.
    fn solve(&mut self, force: &StaggeredField, velocity: &mut StaggeredField) -> Result<SolveReport, StokesError>;

    /// Computes the periodic part of the pressure (force per length in 2D), with mean zero, from a force density and
    /// the velocity that [`StokesSolver::solve`] has computed for it. The uniform part of the pressure gradient is
    /// [`SolveReport::mean_pressure_gradient`].
    ///
    /// # Errors
    /// Returns an error for fields of another grid, a force or velocity that is not finite, a result beyond the range
    /// of double precision.
    fn pressure(
        &mut self,
        force: &StaggeredField,
        velocity: &StaggeredField,
        pressure: &mut CentreField,
    ) -> Result<(), StokesError>;

    /// Returns the work done since the solver was made.
    fn work(&self) -> Work;

    /// Returns true if a solution depends on the solutions before it, as with [`crate::WallTreatment::Lagged`]; by
    /// default false.
    fn has_memory(&self) -> bool {
        false
    }

    /// Returns the numbers by which the next solution depends on those before it. They are empty for a solver without
    /// memory, and before the first solution.
    ///
    /// To resume a run bitwise, save them and pass them to [`StokesSolver::set_memory`].
    fn memory(&self) -> &[f64] {
        &[]
    }

    /// Restores the memory, as [`StokesSolver::memory`] returned it. An empty memory makes the solver forget.
    ///
    /// # Errors
    /// Returns [`StokesError::Input`] if the memory is of another solver or not finite; nothing is changed then.
    fn set_memory(&mut self, memory: &[f64]) -> Result<(), StokesError> {
        Ok(same_length("the memory of a solver without any", 0, memory.len())?)
    }

    /// Takes the last solution back, so that the next one, for the same force, repeats it; does nothing without memory.
    ///
    /// Use this to compute the same flow again, for example to sample it, without a step forward in time.
    fn rewind(&mut self) {}
}

impl<S: StokesSolver + ?Sized> StokesSolver for Box<S> {
    motile_base::forwarded! {
        by &self:
        fn grid() -> &Grid;
        fn viscosity() -> f64;
        fn friction() -> f64;
        fn walls() -> &WallMotion;
        fn drive() -> Drive;
        fn work() -> Work;
        fn has_memory() -> bool;
        fn memory() -> &[f64];
        by &mut self:
        fn solve(force: &StaggeredField, velocity: &mut StaggeredField) -> Result<SolveReport, StokesError>;
        fn pressure(force: &StaggeredField, velocity: &StaggeredField, pressure: &mut CentreField)
            -> Result<(), StokesError>;
        fn set_memory(memory: &[f64]) -> Result<(), StokesError>;
        fn rewind();
    }
}

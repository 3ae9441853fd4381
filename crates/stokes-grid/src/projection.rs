//! The thesis' projection method.

mod channel;
mod periodic;

use input_checks::positive;

use crate::error::checks::{check_grids, not_finite};
use crate::field::sum;
use crate::{CentreField, Drive, Grid, SolveReport, StaggeredField, StokesError, StokesSolver, WallMotion, Work};
use channel::ChannelProjection;
use periodic::PeriodicProjection;

/// Stokes flow with one viscosity by projection, thesis (2.21)-(2.30), in a periodic box or in a channel:
///
/// `eta lap v* = -f` (2.22), `lap phi = div v*` (2.23), `v = v* - grad phi` (2.29), `p = -eta lap phi`.
///
/// (The thesis' (2.30) lacks the minus sign, without which the momentum balance does not hold.) The solution is that of
/// the whole discrete system, the same as that of [`crate::PeriodicStokes`] and [`crate::ChannelStokes`], which need
/// less work: this is the reference, and the way the thesis went.
///
/// **Periodic box.** Three forward and three inverse transforms. The velocity has mean zero, a mean force is balanced
/// by a uniform pressure gradient, which the report has.
///
/// **Channel.** The transform in x is real; across, v* goes by sines on the nodes (DST-I), u* by sines in the cells
/// (DST-II, III), phi by cosines (DCT-II, III), each of which diagonalises its Laplacian. In place of the thesis'
/// lagged wall value, the tangential value of v* on the two walls that makes v no-slip comes from a 2 x 2 system per
/// wave number, so that one pass is exact. Forces along y in the first and last row lie on the walls and are ignored.
/// [`Drive`] and [`WallMotion`] are as in [`crate::ChannelStokes`].
///
/// **Sizes.** Every size is correct; in both directions numbers of cells with no prime factors but 2, 3, 5, 7 and 11
/// are fast, and `nx` should be even.
#[derive(Debug, Clone)]
pub struct ProjectionStokes {
    grid: Grid,
    viscosity: f64,
    region: Region,
    work: Work,
}

#[derive(Debug, Clone)]
enum Region {
    Periodic(Box<PeriodicProjection>),
    Channel(Box<ChannelProjection>),
}

impl ProjectionStokes {
    /// A solver for a grid, periodic or a channel, and a viscosity eta (stress times time). A channel has walls at rest
    /// and no mean pressure gradient.
    ///
    /// # Errors
    /// A viscosity that is not positive and finite.
    pub fn new(grid: Grid, viscosity: f64) -> Result<Self, StokesError> {
        positive("viscosity", viscosity)?;
        let region = if grid.has_walls() {
            Region::Channel(Box::new(ChannelProjection::new(grid, viscosity)?))
        } else {
            Region::Periodic(Box::new(PeriodicProjection::new(grid, viscosity)?))
        };
        Ok(Self { grid, viscosity, region, work: Work::default() })
    }

    /// Chooses what drives the flow along a channel in the solutions to come.
    ///
    /// # Errors
    /// A periodic box, or a value that is not finite.
    pub fn set_drive(&mut self, drive: Drive) -> Result<(), StokesError> {
        self.channel()?.conditions.set_drive(drive)
    }

    /// Moves the walls of a channel in the solutions to come.
    ///
    /// # Errors
    /// A periodic box, or walls of a channel with another number of cells.
    pub fn set_walls(&mut self, walls: WallMotion) -> Result<(), StokesError> {
        self.channel()?.set_walls(walls)
    }

    fn channel(&mut self) -> Result<&mut ChannelProjection, StokesError> {
        match &mut self.region {
            Region::Channel(channel) => Ok(channel),
            Region::Periodic(_) => Err(StokesError::WrongBoundary { needed: "a channel", remedy: "Grid::channel" }),
        }
    }

    fn check(&self, force: &StaggeredField, velocity: &Grid) -> Result<(), StokesError> {
        check_grids(&self.grid, &[("the force", force.grid()), ("the velocity", velocity)])?;
        let inner = if self.grid.has_walls() {
            self.grid.nx()..self.grid.nx() * self.grid.ny()
        } else {
            0..self.grid.nx() * self.grid.ny()
        };
        // The sum of values that are not all finite is not finite.
        if (sum(force.x()) + sum(&force.y()[inner.clone()])).is_finite() {
            Ok(())
        } else {
            Err(not_finite("the sum of the force", &[("the force", force.x()), ("the force", &force.y()[inner])]))
        }
    }
}

impl StokesSolver for ProjectionStokes {
    fn grid(&self) -> &Grid {
        &self.grid
    }

    fn viscosity(&self) -> f64 {
        self.viscosity
    }

    fn walls(&self) -> &WallMotion {
        static AT_REST: WallMotion = WallMotion::AT_REST;
        match &self.region {
            Region::Channel(channel) => &channel.conditions.walls,
            Region::Periodic(_) => &AT_REST,
        }
    }

    fn drive(&self) -> Drive {
        match &self.region {
            Region::Channel(channel) => channel.conditions.drive,
            Region::Periodic(_) => Drive::default(),
        }
    }

    fn solve(&mut self, force: &StaggeredField, velocity: &mut StaggeredField) -> Result<SolveReport, StokesError> {
        self.check(force, velocity.grid())?;
        self.work.solves += 1;
        let mean_pressure_gradient = match &mut self.region {
            Region::Periodic(periodic) => periodic.solve(force, velocity, &mut self.work),
            Region::Channel(channel) => channel.solve(force, velocity, &mut self.work)?,
        };
        if !(velocity.x()[0].is_finite() && velocity.y()[self.grid.nx()].is_finite()) {
            return Err(StokesError::Overflow { name: "the velocity" });
        }
        Ok(SolveReport { mean_pressure_gradient, ..SolveReport::default() })
    }

    /// From the potential, `p = -eta lap phi`; the velocity is not needed, v* is computed again.
    fn pressure(
        &mut self,
        force: &StaggeredField,
        velocity: &StaggeredField,
        pressure: &mut CentreField,
    ) -> Result<(), StokesError> {
        self.check(force, velocity.grid())?;
        check_grids(&self.grid, &[("the pressure", pressure.grid())])?;
        match &mut self.region {
            Region::Periodic(periodic) => periodic.pressure(force, pressure, &mut self.work),
            Region::Channel(channel) => channel.pressure(force, pressure, &mut self.work)?,
        }
        Ok(())
    }

    fn work(&self) -> Work {
        self.work
    }
}

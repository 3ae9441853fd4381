//! Cowley's projection method.

mod across;
mod channel;
mod lagged;
mod periodic;
mod wall_response;

use motile_base::{Drive, SolveReport, finite, internal::sum, positive, same_length};

use crate::{CentreField, Grid, StaggeredField, StokesError, StokesSolver, Wall, WallMotion, Work};
use channel::ChannelProjection;
use periodic::PeriodicProjection;

/// Computes Stokes flow with one viscosity by projection, in a periodic box or in a channel.
///
/// This is the method of Cowley's thesis, (2.21)-(2.30) and section 3.1. Three scalar problems replace the coupled
/// equations:
///
/// | step | equation | periodic box | channel |
/// |---|---|---|---|
/// | intermediate velocity v* | `eta lap v* = -f` (2.22) | Fourier transforms | DST-II, DST-III for x; DST-I for y |
/// | potential phi | `lap phi = div v*` (2.23) | Fourier transforms | DCT-II, DCT-III |
/// | velocity | `v = v* - grad phi` (2.29) | differences | differences |
/// | pressure | `p = -eta lap phi` (2.30) | differences | DCT-III |
///
/// In a channel, Fourier transforms along x go with the sine and cosine transforms across (appendix 3.A). The thesis
/// prints (2.30) without the minus sign, which the momentum balance needs.
///
/// # When to use which solver
///
/// Use [`crate::PeriodicStokes`] or [`crate::ChannelStokes`] to compute: with exact walls, the projection solves the
/// same discrete equations, so both give the same velocity and pressure to round-off. The streamfunction needs a third
/// of the transforms in a box, and none across a channel. Use this solver to reproduce the thesis, to compare speeds
/// with its method, and to check the other solvers by a method that shares nothing with them.
///
/// Errors and costs, measured side by side. Errors are the largest ones of the x velocity against exact smooth flows
/// (`a_box_is_solved_to_second_order` and the tests around it). Costs in a box are in pairs of a forward and an inverse
/// real transform of the field. In a channel, they are in pairs of transforms along x alone (`cargo bench --bench
/// solvers`).
///
/// | region, cells | solver | error | transforms forward, inverse, across | cost |
/// |---|---|---|---|---|
/// | box, 128 x 128 | streamfunction | 1.24e-3 | 1, 1, 0 | 1.1 |
/// | box, 128 x 128 | projection | 1.24e-3 | 3, 3, 0 | 3.1 |
/// | box, 1024 x 1024 | streamfunction | second order | 1, 1, 0 | 0.8 |
/// | box, 1024 x 1024 | projection | second order | 3, 3, 0 | 2.2 |
/// | channel, 160 x 160 (cost: 240 x 100) | streamfunction | 1.83e-4 | 1, 1, 0 | 2.0 |
/// | channel, 160 x 160 (cost: 240 x 100) | projection, exact walls | 1.83e-4 | 2, 2, 6 | 12.6 |
/// | channel, 24 x 8, 100 steps | projection, lagged walls | 3.3e-5 of lag | 2, 2, 6 | 12.6 |
///
/// A lag of the walls adds an error that is proportional to the time step. It is 3.3e-5, 1.7e-5 and 8.4e-6 of the
/// largest velocity in 100, 200 and 400 steps over a force that changes within the time 1.
///
/// # Walls of a channel
///
/// [`WallTreatment`] says how the walls are kept free of slip. Walls may slide, uniformly or as functions of x
/// ([`WallMotion`]). Forces along y in the first and last row lie on the walls, which take up any force; they are
/// ignored. [`Drive`] prescribes the mean pressure gradient or the flux along the channel.
///
/// **Lagged walls remember.** With [`WallTreatment::Lagged`] a solution depends on the one before, so the order of
/// solutions matters. The first solution is exact, because there is none before it. A clone remembers what the original
/// does. With several solutions per time step, such as the stages of an integrator, each lags behind the stage before
/// it. To resume a run bitwise, save [`StokesSolver::memory`]. To compute the same flow again without a step forward,
/// call [`StokesSolver::rewind`]. What is computed on request ([`StokesSolver::pressure`],
/// [`ProjectionStokes::potential`], [`ProjectionStokes::intermediate_velocity`]) uses the wall values of the last
/// solution and changes nothing.
///
/// # Periodic box
///
/// The velocity has exactly the mean that [`ProjectionStokes::set_mean_velocity`] prescribes, zero by default. A
/// uniform pressure gradient balances a mean force. With the feature `rayon`, boxes of 800,000 cells or more use the
/// threads of the current pool, and the number of threads does not change the result in any bit.
///
/// # Sizes
///
/// Any numbers of cells work. Numbers without prime factors other than 2, 3, 5, 7 and 11 are fast, in both directions.
///
/// # Example
///
/// Both solvers compute Couette flow between a wall at rest and a wall that slides with the velocity 2. They differ by
/// round-off.
///
/// ```
/// use stokes_grid::{ChannelStokes, Grid, ProjectionStokes, StaggeredField, StokesSolver, WallMotion};
///
/// let grid = Grid::channel(16, 10, 0.1)?;
/// let (mut projection, mut streamfunction) = (ProjectionStokes::new(grid, 3.0)?, ChannelStokes::new(grid, 3.0)?);
/// projection.set_walls(WallMotion::uniform(&grid, 0.0, 2.0)?)?;
/// streamfunction.set_walls(WallMotion::uniform(&grid, 0.0, 2.0)?)?;
/// let mut force = StaggeredField::zeros(grid);
/// force.components_mut().1[5 * 16 + 3] = 400.0;
///
/// let (mut velocity, mut expected) = (StaggeredField::zeros(grid), StaggeredField::zeros(grid));
/// projection.solve(&force, &mut velocity)?;
/// streamfunction.solve(&force, &mut expected)?;
/// println!("velocity at the force: {:.4}", velocity.y()[5 * 16 + 3]);
/// assert_eq!(format!("{:.4}", velocity.y()[5 * 16 + 3]), "0.2768");
/// assert!(velocity.x().iter().zip(expected.x()).all(|(u, v)| (u - v).abs() < 1e-13));
///
/// let work = projection.work();
/// assert_eq!((work.forward_transforms, work.inverse_transforms, work.sine_cosine_transforms), (2, 2, 6));
/// # Ok::<(), stokes_grid::StokesError>(())
/// ```
#[derive(Debug, Clone)]
#[doc(alias("projection method", "pressure projection", "Poisson solver"))]
pub struct ProjectionStokes {
    grid: Grid,
    viscosity: f64,
    method: Method,
    work: Work,
}

/// The way in which the projection method keeps fluid from slipping along the walls of a channel.
///
/// The intermediate velocity must have the tangential velocity `grad phi` on the walls (Cowley (3.1)), but the
/// potential phi is computed from it.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Default)]
#[non_exhaustive]
pub enum WallTreatment {
    /// Solves for the wall values together with the potential, two unknowns per wave number, so that the velocity
    /// satisfies the no-slip condition to round-off. Solutions do not depend on each other.
    #[default]
    Exact,
    /// Takes the wall values from the potential of the solution before, as in Cowley (3.1)-(3.4). Fluid slips along the
    /// walls by the change of the potential since then, so the error is of first order in the time step.
    ///
    /// After a jump of the force, each solution halves the slip of short waves. Waves much longer than the channel is
    /// wide take longer: with the wave number k and the width H, the slip decays over about 12/(k H)² solutions.
    Lagged,
}

#[derive(Debug, Clone)]
enum Method {
    Periodic(Box<PeriodicProjection>),
    Channel(Box<ChannelProjection>),
}

impl ProjectionStokes {
    /// Plans the solver for a grid, periodic or a channel, and a viscosity eta (stress times time).
    ///
    /// A channel starts with walls at rest, the exact wall treatment, and no mean pressure gradient; a box starts with
    /// the mean velocity zero.
    ///
    /// # Errors
    /// Returns [`StokesError::Input`] if the viscosity is not positive and finite.
    pub fn new(grid: Grid, viscosity: f64) -> Result<Self, StokesError> {
        positive("viscosity", viscosity)?;
        let method = if grid.has_walls() {
            Method::Channel(Box::new(ChannelProjection::new(grid, viscosity)?))
        } else {
            Method::Periodic(Box::new(PeriodicProjection::new(grid, viscosity)?))
        };
        Ok(Self { grid, viscosity, method, work: Work::default() })
    }

    /// Prescribes the mean pressure gradient or the flux of the solutions to come.
    ///
    /// # Errors
    /// Returns [`StokesError`] in a periodic box, and if a value is not finite.
    pub fn set_drive(&mut self, drive: Drive) -> Result<(), StokesError> {
        drive.check()?;
        self.channel_mut()?.drive = drive;
        Ok(())
    }

    /// Prescribes the velocities of the walls in the solutions to come.
    ///
    /// # Errors
    /// Returns [`StokesError`] in a periodic box, and if the walls belong to a channel with another number of cells.
    pub fn set_walls(&mut self, walls: WallMotion) -> Result<(), StokesError> {
        self.channel_mut()?.set_walls(walls)
    }

    /// Chooses the wall treatment of the solutions to come, and forgets the solutions before.
    ///
    /// # Errors
    /// Returns [`StokesError::Refused`] in a periodic box, which has no walls.
    pub fn set_wall_treatment(&mut self, treatment: WallTreatment) -> Result<(), StokesError> {
        let channel = self.channel_mut()?;
        channel.treatment = treatment;
        Ok(channel.lagged.set_memory(&[])?)
    }

    /// Returns the wall treatment; [`WallTreatment::Exact`] in a periodic box.
    #[must_use]
    pub fn wall_treatment(&self) -> WallTreatment {
        self.channel().map_or(WallTreatment::Exact, |channel| channel.treatment)
    }

    /// Prescribes the mean velocity (length per time) in a periodic box of the solutions to come, a uniform flow that
    /// is added to them.
    ///
    /// # Errors
    /// Returns [`StokesError`] in a channel, where [`ProjectionStokes::set_drive`] does this, and if a component is not
    /// finite.
    pub fn set_mean_velocity(&mut self, mean: [f64; 2]) -> Result<(), StokesError> {
        let mean = [finite("mean velocity", mean[0])?, finite("mean velocity", mean[1])?];
        match &mut self.method {
            Method::Periodic(periodic) => periodic.mean_velocity = mean,
            Method::Channel(_) => {
                return Err(StokesError::needs_box());
            }
        }
        Ok(())
    }

    /// Returns the prescribed mean velocity (length per time); zero in a channel.
    #[must_use]
    pub fn mean_velocity(&self) -> [f64; 2] {
        match &self.method {
            Method::Periodic(periodic) => periodic.mean_velocity,
            Method::Channel(_) => [0.0; 2],
        }
    }

    /// Computes the intermediate velocity v* (length per time) for a force, Cowley (2.22).
    ///
    /// It is not free of divergence, and on the walls of a channel it has the value of [`WallTreatment`].
    ///
    /// # Errors
    /// Returns [`StokesError`] as [`StokesSolver::solve`] does.
    pub fn intermediate_velocity(
        &mut self,
        force: &StaggeredField,
        out: &mut StaggeredField,
    ) -> Result<(), StokesError> {
        self.check(force, [("the intermediate velocity", out.grid())])?;
        match &mut self.method {
            Method::Periodic(periodic) => periodic.intermediate_velocity(force, out, &mut self.work),
            Method::Channel(channel) => channel.intermediate_velocity(force, out, &mut self.work),
        }
    }

    /// Computes the potential phi (area per time) of the intermediate velocity for a force, Cowley (2.23), with mean
    /// zero.
    ///
    /// # Errors
    /// Returns [`StokesError`] as [`StokesSolver::solve`] does.
    pub fn potential(&mut self, force: &StaggeredField, out: &mut CentreField) -> Result<(), StokesError> {
        self.check(force, [("the potential", out.grid())])?;
        match &mut self.method {
            Method::Periodic(periodic) => periodic.potential(force, out, &mut self.work)?,
            Method::Channel(channel) => channel.potential(force, out, &mut self.work),
        }
        check_overflow("the potential", out.values()[0])
    }

    /// Writes the velocity of the fluid relative to a wall (length per time) at the columns of nodes, in the last
    /// solution; `out` has `nx` values.
    ///
    /// It is zero for [`WallTreatment::Exact`], and after [`StokesSolver::rewind`] until the next solution. For
    /// [`WallTreatment::Lagged`] it measures the error.
    ///
    /// # Errors
    /// Returns [`StokesError`] in a periodic box, and if `out` has the wrong length.
    pub fn wall_slip(&mut self, wall: Wall, out: &mut [f64]) -> Result<(), StokesError> {
        let channel = self.channel_mut()?;
        same_length("the wall slip", channel.grid().nx(), out.len())?;
        channel.slip(wall, out);
        Ok(())
    }

    fn channel(&self) -> Option<&ChannelProjection> {
        match &self.method {
            Method::Channel(channel) => Some(channel),
            Method::Periodic(_) => None,
        }
    }

    fn channel_mut(&mut self) -> Result<&mut ChannelProjection, StokesError> {
        match &mut self.method {
            Method::Channel(channel) => Ok(channel),
            Method::Periodic(_) => Err(StokesError::needs_channel()),
        }
    }

    /// Refuses fields of another grid and forces that are not finite.
    fn check<const N: usize>(
        &self,
        force: &StaggeredField,
        fields: [(&'static str, &Grid); N],
    ) -> Result<(), StokesError> {
        self.grid.check([("the force", force.grid())])?;
        self.grid.check(fields)?;
        let y = self.forces_along_y(force);
        // A sum of numbers that are not all finite is not finite.
        if (sum(force.x()) + sum(y)).is_finite() {
            Ok(())
        } else {
            Err(StokesError::not_finite("the sum of the force", &[("the force", force.x()), ("the force", y)]))
        }
    }

    /// Returns the forces along y except for those on walls, which are ignored.
    fn forces_along_y<'a>(&self, force: &'a StaggeredField) -> &'a [f64] {
        let nx = self.grid.nx();
        if self.grid.has_walls() { &force.y()[nx..nx * self.grid.ny()] } else { force.y() }
    }
}

/// Refuses a result that is not finite.
fn check_overflow(name: &'static str, value: f64) -> Result<(), StokesError> {
    if value.is_finite() { Ok(()) } else { Err(StokesError::overflow(name)) }
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
        self.channel().map_or(&AT_REST, |channel| &channel.walls)
    }

    fn drive(&self) -> Drive {
        self.channel().map_or(Drive::default(), |channel| channel.drive)
    }

    fn solve(&mut self, force: &StaggeredField, velocity: &mut StaggeredField) -> Result<SolveReport, StokesError> {
        self.check(force, [("the velocity", velocity.grid())])?;
        let mean_pressure_gradient = match &mut self.method {
            Method::Periodic(periodic) => periodic.solve(force, velocity, &mut self.work)?,
            Method::Channel(channel) => channel.solve(force, velocity, &mut self.work)?,
        };
        self.work.solves += 1;
        Ok(SolveReport { mean_pressure_gradient, ..SolveReport::default() })
    }

    /// Computes `-eta lap phi` from the force; the velocity is not needed. With lagged walls, it uses the wall
    /// values of the last solution.
    fn pressure(
        &mut self,
        force: &StaggeredField,
        velocity: &StaggeredField,
        pressure: &mut CentreField,
    ) -> Result<(), StokesError> {
        self.check(force, [("the velocity", velocity.grid()), ("the pressure", pressure.grid())])?;
        match &mut self.method {
            Method::Periodic(periodic) => periodic.pressure(force, pressure, &mut self.work)?,
            Method::Channel(channel) => channel.pressure(force, pressure, &mut self.work),
        }
        check_overflow("the pressure", pressure.values()[0])
    }

    fn work(&self) -> Work {
        self.work
    }

    fn has_memory(&self) -> bool {
        self.wall_treatment() == WallTreatment::Lagged
    }

    fn memory(&self) -> &[f64] {
        self.channel().map_or(&[], |channel| channel.lagged.memory())
    }

    fn set_memory(&mut self, memory: &[f64]) -> Result<(), StokesError> {
        match &mut self.method {
            Method::Channel(channel) if channel.treatment == WallTreatment::Lagged => {
                Ok(channel.lagged.set_memory(memory)?)
            }
            _ => Ok(same_length("the memory of a solver without any", 0, memory.len())?),
        }
    }

    fn rewind(&mut self) {
        if let Method::Channel(channel) = &mut self.method {
            channel.lagged.rewind();
        }
    }
}

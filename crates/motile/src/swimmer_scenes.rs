//! Scenes of one droplet, by the method that was asked for or of a type known at compile time.

use std::f64::consts::TAU;

use active_interface::{ActiveDroplet, Curve};
use boundary_integral::{BoundaryIntegral, Region, Settings, forcing};
use ib_core::{AnyKernel, Handle, Hydrodynamics, ImmersedBoundary, Scene, SmearedContrast, Vec2};
use stokes_grid::{ChannelStokes, Drive, Grid, PeriodicStokes, StokesSolver};

use crate::{ContrastMethod, Method, SetupError, Swimmer};

/// Hydrodynamics by whatever method a scene was made with.
pub type AnyFlow = Box<dyn Hydrodynamics>;

/// The hydrodynamics of a droplet in a periodic box, on a grid.
pub type PeriodicBox = ImmersedBoundary<PeriodicStokes, AnyKernel>;

/// The hydrodynamics of a droplet in a channel with rigid walls, on a grid.
pub type RigidChannel = ImmersedBoundary<ChannelStokes, AnyKernel>;

/// The hydrodynamics of a droplet in a periodic box, without a grid.
pub type IntegralBox = BoundaryIntegral;

/// The hydrodynamics of a droplet in a channel with rigid walls, without a grid.
pub type IntegralChannel = BoundaryIntegral;

/// The hydrodynamics of a droplet in unbounded fluid, without a grid.
pub type IntegralPlane = BoundaryIntegral;

/// A scene and the droplet in it, or why there is none.
pub type Built<H> = Result<(Scene<H>, Handle<ActiveDroplet>), SetupError>;

/// A droplet that would start closer to a wall than this part of its radius starts squeezed, without a grid.
const LEAST_ROOM: f64 = 0.05;

impl Swimmer {
    /// The scene and the droplet in a periodic box, by [`Swimmer::method`].
    ///
    /// # Errors
    /// Parameters out of their range; on a grid, a box that does not hold a whole number of cells.
    pub fn build(&self) -> Built<AnyFlow> {
        let mut scene = self.empty_box()?;
        let droplet = scene.add(self.droplet_for_method()?);
        Ok((scene, droplet))
    }

    /// The scene of [`Swimmer::build`] without a droplet, for several of them ([`Swimmer::droplet_for_method`]).
    ///
    /// # Errors
    /// As [`Swimmer::build`].
    pub fn empty_box(&self) -> Result<Scene<AnyFlow>, SetupError> {
        let flow = match self.method {
            Method::BoundaryIntegral => Box::new(self.integral_box()?),
            Method::ImmersedBoundary => self.any_grid(self.box_solver()?)?,
        };
        Ok(Scene::new(flow).with_step_size(self.step))
    }

    /// The droplet of [`Swimmer::build`] alone.
    ///
    /// # Errors
    /// Parameters out of their range.
    pub fn droplet_for_method(&self) -> Result<ActiveDroplet, SetupError> {
        match self.method {
            Method::BoundaryIntegral => self.droplet_with(&self.circle_of_cells()?),
            Method::ImmersedBoundary => self.droplet(),
        }
    }

    /// The scene and the droplet in a channel with rigid no-slip walls at y = +-`lengths[1]`/2, periodic in x with the
    /// period `lengths[0]` (thesis section 3.1), by [`Swimmer::method`].
    ///
    /// # Errors
    /// As [`Swimmer::build`]; a droplet beyond a wall.
    pub fn build_in_channel(&self, drive: Drive) -> Built<AnyFlow> {
        match self.method {
            Method::BoundaryIntegral => {
                self.with_droplet(&self.curve_between_walls()?, Box::new(self.integral_channel(drive)?))
            }
            Method::ImmersedBoundary => {
                self.with_droplet(&self.circle_on_grid()?, self.any_grid(self.channel_solver(drive)?)?)
            }
        }
    }

    /// The scene and the droplet in a periodic box, on a grid, with a sharp contrast.
    ///
    /// # Errors
    /// Parameters out of their range, a box that does not hold a whole number of cells.
    pub fn build_on_grid(&self) -> Built<PeriodicBox> {
        self.with_droplet(&self.circle_on_grid()?, self.couple(self.box_solver()?))
    }

    /// The scene of [`Swimmer::build_on_grid`] without a droplet, for droplets made otherwise.
    ///
    /// # Errors
    /// Parameters out of their range, a box that does not hold a whole number of cells.
    pub fn scene(&self) -> Result<Scene<PeriodicBox>, SetupError> {
        Ok(Scene::new(self.couple(self.box_solver()?)).with_step_size(self.step))
    }

    /// The scene and the droplet in a channel as in [`Swimmer::build_in_channel`], on a grid, with a sharp contrast. A
    /// channel as wide as the droplet (two radii) is the narrowest.
    ///
    /// # Errors
    /// Parameters out of their range, lengths that do not hold a whole number of cells, a droplet beyond a wall.
    pub fn build_on_grid_in_channel(&self, drive: Drive) -> Built<RigidChannel> {
        self.with_droplet(&self.circle_on_grid()?, self.couple(self.channel_solver(drive)?))
    }

    /// The scene and the droplet in a periodic box, without a grid: spectrally accurate, for scenes of interfaces only.
    /// Grid and marker spacing and kernel do not matter.
    ///
    /// # Errors
    /// Parameters out of their range.
    pub fn build_without_grid(&self) -> Built<IntegralBox> {
        self.with_droplet(&self.circle_of_cells()?, self.integral_box()?)
    }

    /// As [`Swimmer::build_without_grid`], in unbounded fluid.
    ///
    /// # Errors
    /// Parameters out of their range.
    pub fn build_unbounded(&self) -> Built<IntegralPlane> {
        self.with_droplet(&self.circle_of_cells()?, self.integrals(Region::Plane)?)
    }

    /// As [`Swimmer::build_without_grid`], in a channel with rigid walls. A droplet that would start closer to a wall
    /// than a twentieth of its radius is squeezed to an ellipse of the same area.
    ///
    /// # Errors
    /// Parameters out of their range, a droplet beyond a wall.
    pub fn build_without_grid_in_channel(&self, drive: Drive) -> Built<IntegralChannel> {
        self.with_droplet(&self.curve_between_walls()?, self.integral_channel(drive)?)
    }

    fn with_droplet<H: Hydrodynamics>(&self, markers: &[Vec2], flow: H) -> Built<H> {
        let droplet = self.droplet_with(markers)?;
        let mut scene = Scene::new(flow).with_step_size(self.step);
        let droplet = scene.add(droplet);
        Ok((scene, droplet))
    }

    fn box_fits(&self) -> Result<[f64; 2], SetupError> {
        let [lx, ly] = self.lengths;
        // A radius that is no length is refused by the droplet, which names it.
        if self.radius.is_finite() && self.lengths.iter().any(|&l| l <= 2.0 * self.radius) {
            let problem = "is too small for the droplet: give it more than two radii each way";
            return Err(SetupError::Box { lx, ly, spacing: self.spacing, problem });
        }
        Ok([lx, ly])
    }

    fn channel_fits(&self) -> Result<[f64; 2], SetupError> {
        let [lx, ly] = self.lengths;
        let too_high = self.offset[1].abs() + self.radius > 0.5 * ly * (1.0 + 1e-12);
        if self.radius.is_finite() && (too_high || lx <= 2.0 * self.radius) {
            let problem = "does not hold the droplet: move it to the centre line or make the channel wider or longer";
            return Err(SetupError::Box { lx, ly, spacing: self.spacing, problem });
        }
        Ok([lx, ly])
    }

    fn box_solver(&self) -> Result<PeriodicStokes, SetupError> {
        let [lx, ly] = self.box_fits()?;
        let grid = Grid::periodic(self.cells(lx)?, self.cells(ly)?, self.spacing)?;
        Ok(PeriodicStokes::new(grid, self.viscosity)?)
    }

    fn channel_solver(&self, drive: Drive) -> Result<ChannelStokes, SetupError> {
        let [lx, ly] = self.channel_fits()?;
        let grid = Grid::channel(self.cells(lx)?, self.cells(ly)?, self.spacing)?;
        let mut solver = ChannelStokes::new(grid, self.viscosity)?;
        solver.set_drive(drive)?;
        Ok(solver)
    }

    fn integral_box(&self) -> Result<IntegralBox, SetupError> {
        let [lx, ly] = self.box_fits()?;
        self.integrals(Region::Box { lengths: [lx, ly] })
    }

    fn integral_channel(&self, drive: Drive) -> Result<IntegralChannel, SetupError> {
        let [lx, ly] = self.channel_fits()?;
        self.integrals(Region::Channel { length: lx, width: ly, forcing: forcing(drive) })
    }

    fn integrals(&self, region: Region) -> Result<BoundaryIntegral, SetupError> {
        // Refuses a radius that is none by its own name.
        self.circle()?;
        let settings = Settings { nodes: self.nodes, ..Settings::default() };
        Ok(BoundaryIntegral::new(region, self.viscosity, settings)?.with_reference_perimeter(TAU * self.radius)?)
    }

    /// The markers of a circle, as many as there are cells of the concentration.
    fn circle_of_cells(&self) -> Result<Vec<Vec2>, SetupError> {
        Ok(self.circle()?.markers(self.concentration_cells.max(self.nodes))?)
    }

    fn curve_between_walls(&self) -> Result<Vec<Vec2>, SetupError> {
        let [_, width] = self.channel_fits()?;
        let room = 0.5 * width - self.offset[1].abs() - LEAST_ROOM * self.radius;
        let curve = if room >= self.radius {
            self.circle()?
        } else {
            let along = self.radius * self.radius / room;
            Curve::ellipse(along, room)?.translated(Vec2::new(self.offset[0], self.offset[1]))
        };
        Ok(curve.markers(self.concentration_cells.max(self.nodes))?)
    }

    fn couple<S: StokesSolver>(&self, solver: S) -> ImmersedBoundary<S, AnyKernel> {
        if self.corrected {
            ImmersedBoundary::new(solver, self.kernel)
        } else {
            ImmersedBoundary::uncorrected(solver, self.kernel)
        }
    }

    pub(crate) fn any_grid<S: StokesSolver + 'static>(&self, solver: S) -> Result<AnyFlow, SetupError> {
        let differs = self.viscosity_inside.is_some_and(|inside| inside != self.viscosity);
        Ok(if differs && self.contrast == ContrastMethod::Arithmetic {
            Box::new(SmearedContrast::new(solver, self.kernel)?)
        } else {
            Box::new(self.couple(solver))
        })
    }
}

//! Direct solver for a doubly periodic box, by its streamfunction.

#[cfg(feature = "rayon")]
pub(crate) mod parallel;

use motile_base::{SolveReport, finite, internal::sum, not_negative, positive};

use crate::{CentreField, Grid, RealFft2, StaggeredField, StokesError, StokesSolver, Symbol, Work, stencil};

/// Stokes flow in a doubly periodic box with one viscosity, by its streamfunction psi:
///
/// `eta (d2x + d2y)^2 psi = curl f`, `u = d psi/dy`, `v = -d psi/dx`,
///
/// with the differences of the staggered grid, so that the discrete divergence vanishes to round-off. The discrete
/// solution equals Cowley's projection (2.21)-(2.30), [`crate::ProjectionStokes`], by one forward and one inverse
/// transform of a real field in place of three and three.
///
/// **Mean force and mean velocity.** The velocity has exactly the mean that [`PeriodicStokes::set_mean_velocity`]
/// prescribes, zero by default. A uniform force moves nothing: it is balanced by a uniform pressure gradient,
/// [`SolveReport::mean_pressure_gradient`].
///
/// **Friction.** [`PeriodicStokes::set_friction`] adds the friction of a thin layer of fluid with its substrate.
///
/// **Sizes.** Any numbers of cells work; those without prime factors other than 2, 3, 5, 7 and 11, and even `nx`, are
/// fast.
#[derive(Debug, Clone)]
#[doc(alias("streamfunction", "periodic box", "FFT"))]
pub struct PeriodicStokes {
    grid: Grid,
    viscosity: f64,
    friction: f64,
    mean_velocity: [f64; 2],
    transform: RealFft2,
    biharmonic: Symbol,
    poisson: Option<Symbol>,
    first: Vec<f64>,
    previous: Vec<f64>,
    #[cfg(feature = "rayon")]
    parallel: Option<parallel::ParallelTransform>,
    work: Work,
}

impl PeriodicStokes {
    /// Creates a solver for a periodic grid and a viscosity eta (stress times time).
    ///
    /// # Errors
    /// Returns an error for a grid with walls, or a viscosity that is not positive and finite.
    pub fn new(grid: Grid, viscosity: f64) -> Result<Self, StokesError> {
        positive("viscosity", viscosity)?;
        if grid.has_walls() {
            return Err(StokesError::needs_box());
        }
        let (nx, ny, h) = (grid.nx(), grid.ny(), grid.spacing());
        // With h curl f on the right and psi / h on the left both stencils are bare differences.
        let biharmonic = Symbol::inverse_biharmonic(nx, ny, h * h / viscosity, 0.0);
        Ok(Self {
            grid,
            viscosity,
            friction: 0.0,
            mean_velocity: [0.0; 2],
            transform: RealFft2::new(nx, ny)?,
            biharmonic,
            poisson: None,
            first: vec![0.0; nx],
            previous: vec![0.0; nx],
            #[cfg(feature = "rayon")]
            parallel: None,
            work: Work::default(),
        })
    }

    /// Sets the friction alpha (stress times time per area) of the solutions to come, which solve the Brinkman equation
    /// `eta lap(v) - alpha v - grad p + f = 0`.
    ///
    /// Use `12 eta / H^2` for the flow averaged over a gap of height H between two plates (a Hele-Shaw cell). Friction
    /// screens the flow beyond the length `sqrt(eta / alpha)`. It costs nothing: a solve takes the same two transforms.
    ///
    /// # Errors
    /// Returns an error if the friction is negative or not finite.
    pub fn set_friction(&mut self, friction: f64) -> Result<(), StokesError> {
        self.friction = not_negative("friction", friction)?;
        let (nx, ny, h) = (self.grid.nx(), self.grid.ny(), self.grid.spacing());
        let screening = h * h * friction / self.viscosity;
        self.biharmonic = Symbol::inverse_biharmonic(nx, ny, h * h / self.viscosity, screening);
        Ok(())
    }

    /// Prescribes the mean velocity (length per time) of the solutions to come, a uniform flow that is added to them.
    ///
    /// # Errors
    /// Returns an error for a component that is not finite.
    pub fn set_mean_velocity(&mut self, mean: [f64; 2]) -> Result<(), StokesError> {
        self.mean_velocity = [finite("mean velocity", mean[0])?, finite("mean velocity", mean[1])?];
        Ok(())
    }

    /// Solves by one forward and one inverse transform on one thread; returns the sums of the components of the force.
    fn solve_serial(&mut self, force: &StaggeredField, velocity: &mut StaggeredField) -> Result<[f64; 2], StokesError> {
        let (nx, ny) = (self.grid.nx(), self.grid.ny());
        let (fx, fy) = (force.x(), force.y());
        let mut total = [0.0; 2];
        self.transform.forward_rows(|j, row| {
            stencil::curl(force, j, 1.0, row);
            total[0] += sum(&fx[j * nx..][..nx]);
            total[1] += sum(&fy[j * nx..][..nx]);
        });
        check_total(total, force)?;
        self.transform.filter_columns(&self.biharmonic);

        let [mean_u, mean_v] = self.mean_velocity;
        let (u, v) = velocity.components_mut();
        let (first, previous) = (&mut self.first, &mut self.previous);
        let mut finite = true;
        self.transform.inverse_rows(|j, psi| {
            // An overflow anywhere in the transforms reaches every value of every row.
            finite &= j > 0 || psi[0].is_finite();
            if !finite {
                return;
            }
            stencil::across(&mut v[j * nx..][..nx], psi, mean_v);
            if j == 0 {
                first.copy_from_slice(psi);
            } else {
                stencil::along(&mut u[(j - 1) * nx..][..nx], previous, psi, mean_u);
            }
            previous.copy_from_slice(psi);
        });
        if !finite {
            return Err(StokesError::overflow("the velocity"));
        }
        stencil::along(&mut u[(ny - 1) * nx..], previous, first, mean_u);
        Ok(total)
    }

    /// Solves on the threads of the current pool; returns the sums of the components of the force.
    #[cfg(feature = "rayon")]
    fn solve_parallel(
        &mut self,
        force: &StaggeredField,
        velocity: &mut StaggeredField,
    ) -> Result<[f64; 2], StokesError> {
        let (nx, ny) = (self.grid.nx(), self.grid.ny());
        let parallel = match &mut self.parallel {
            Some(parallel) => parallel,
            none => none.insert(parallel::ParallelTransform::new(nx, ny)?),
        };
        let total = parallel.forward(force, |j, row| stencil::curl(force, j, 1.0, row));
        check_total(total, force)?;
        parallel.filter_columns(&self.biharmonic);
        if parallel.velocity(self.mean_velocity, velocity) {
            Ok(total)
        } else {
            Err(StokesError::overflow("the velocity"))
        }
    }

    /// Returns the prescribed mean velocity (length per time).
    #[must_use]
    pub fn mean_velocity(&self) -> [f64; 2] {
        self.mean_velocity
    }
}

impl StokesSolver for PeriodicStokes {
    fn grid(&self) -> &Grid {
        &self.grid
    }

    fn viscosity(&self) -> f64 {
        self.viscosity
    }

    fn friction(&self) -> f64 {
        self.friction
    }

    fn solve(&mut self, force: &StaggeredField, velocity: &mut StaggeredField) -> Result<SolveReport, StokesError> {
        self.grid.check([("the force", force.grid()), ("the velocity", velocity.grid())])?;
        #[cfg(feature = "rayon")]
        let total = if parallel::pays(self.grid.nx() * self.grid.ny()) {
            self.solve_parallel(force, velocity)
        } else {
            self.solve_serial(force, velocity)
        }?;
        #[cfg(not(feature = "rayon"))]
        let total = self.solve_serial(force, velocity)?;

        self.work.solves += 1;
        self.work.forward_transforms += 1;
        self.work.inverse_transforms += 1;
        let cells = (self.grid.nx() * self.grid.ny()) as f64;
        let [u, v] = self.mean_velocity;
        let mean_pressure_gradient = [total[0] / cells - self.friction * u, total[1] / cells - self.friction * v];
        Ok(SolveReport { mean_pressure_gradient, ..SolveReport::default() })
    }

    /// Solves the Poisson problem `lap p = div f`; the velocity is not needed.
    fn pressure(
        &mut self,
        force: &StaggeredField,
        velocity: &StaggeredField,
        pressure: &mut CentreField,
    ) -> Result<(), StokesError> {
        let fields =
            [("the force", force.grid()), ("the velocity", velocity.grid()), ("the pressure", pressure.grid())];
        self.grid.check(fields)?;
        let (nx, ny, h) = (self.grid.nx(), self.grid.ny(), self.grid.spacing());
        let poisson = self.poisson.get_or_insert_with(|| Symbol::inverse_laplacian(nx, ny, -h));
        let out = pressure.values_mut();
        // Symbol and transform have the size of the grid, so that the call cannot fail.
        let _ = self.transform.filter(
            poisson,
            |j, row| stencil::divergence(force, j, row),
            |j, row| out[j * nx..][..nx].copy_from_slice(row),
        );
        if !out[0].is_finite() {
            return Err(StokesError::not_finite("the pressure", &[("the force", force.x()), ("the force", force.y())]));
        }
        self.work.forward_transforms += 1;
        self.work.inverse_transforms += 1;
        Ok(())
    }

    fn work(&self) -> Work {
        self.work
    }
}

/// Refuses sums that are not finite, as they are wherever the force is not.
fn check_total(total: [f64; 2], force: &StaggeredField) -> Result<(), StokesError> {
    if total.into_iter().all(f64::is_finite) {
        Ok(())
    } else {
        Err(StokesError::not_finite("the sum of the force", &[("the force", force.x()), ("the force", force.y())]))
    }
}

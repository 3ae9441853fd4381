//! Direct solver for a channel, by its streamfunction.

mod mean_flow;
mod modes;

use motile_base::{Drive, SolveReport, internal::sum, not_negative, positive};
use num_complex::Complex64;

use crate::{
    CentreField, Grid, StaggeredField, StokesError, StokesSolver, Wall, WallMotion, Work, stencil,
    transform::RowTransform,
};
pub(crate) use mean_flow::MeanFlow;
use modes::ChannelModes;

/// Stokes flow with one viscosity in a channel, periodic in x with no-slip walls in y, by its streamfunction psi:
///
/// `eta (d2x + d2y)^2 psi = curl f`, `u = d psi/dy`, `v = -d psi/dx`,
///
/// with the differences of the staggered grid and the ghost velocity `u[-1] = 2 U - u[0]` behind a wall of velocity U,
/// which is the same as `psi[-1] = psi[1] - 2 h U`. The solution satisfies the whole discrete system of momentum and
/// continuity to round-off; nothing is iterated.
///
/// For each wave number of x there are two tridiagonal systems for the Dirichlet problems `lap w = curl f / eta`,
/// `lap psi = w` and a 2 x 2 system for the two wall values of w (minus the vorticity there) that make the walls
/// no-slip. Nothing is transformed in y: there is one forward and one inverse transform in x, each fused with half of
/// the sweeps.
///
/// **Forces on the walls.** The y components in the first and last row lie on the walls, which take up any force; they
/// are ignored.
///
/// **Mean flow.** [`Drive`] prescribes the mean pressure gradient or the flux; [`SolveReport`] has the mean pressure
/// gradient, [`crate::flux`] the flux. The y velocity has no mean on any row.
///
/// **Slip.** Fluid slips along walls with slip lengths ([`WallMotion::with_slip`]), at no cost.
///
/// **Friction.** [`ChannelStokes::set_friction`] adds the friction of a thin layer of fluid with its substrate.
///
/// **Sizes.** Any numbers of cells work. Only `nx` is transformed: even values without prime factors other than 2, 3,
/// 5, 7 and 11 are fast.
#[derive(Debug, Clone)]
#[doc(alias("no-slip", "no-slip walls", "channel flow", "Poiseuille"))]
pub struct ChannelStokes {
    grid: Grid,
    viscosity: f64,
    friction: f64,
    drive: Drive,
    walls: WallMotion,
    /// Fourier coefficients of the velocities of the bottom and the top wall.
    wall_spectra: [Vec<Complex64>; 2],
    modes: ChannelModes,
    mean: MeanFlow,
    rows: RowTransform,
    spectrum: Vec<Complex64>,
    below: Vec<f64>,
    mean_u: Vec<f64>,
    work: Work,
}

impl ChannelStokes {
    /// Creates a solver for a channel and a viscosity eta (stress times time), with walls at rest and no mean pressure
    /// gradient.
    ///
    /// # Errors
    /// Returns an error for a periodic grid, or a viscosity that is not positive and finite.
    pub fn new(grid: Grid, viscosity: f64) -> Result<Self, StokesError> {
        positive("viscosity", viscosity)?;
        if !grid.has_walls() {
            return Err(StokesError::needs_channel());
        }
        let (nx, ny) = (grid.nx(), grid.ny());
        let rows = RowTransform::new(nx)?;
        let width = rows.width();
        Ok(Self {
            grid,
            viscosity,
            friction: 0.0,
            drive: Drive::default(),
            walls: WallMotion::AT_REST,
            wall_spectra: [vec![Complex64::ZERO; width], vec![Complex64::ZERO; width]],
            modes: ChannelModes::new(nx, ny, 0.0, [0.0; 2]),
            mean: MeanFlow::new(&grid, viscosity, 0.0, [1.0; 2]),
            rows,
            spectrum: vec![Complex64::ZERO; width * (ny - 1)],
            below: vec![0.0; nx],
            mean_u: vec![0.0; ny],
            work: Work::default(),
        })
    }

    /// Sets the friction alpha (stress times time per area) of the solutions to come, which solve the Brinkman equation
    /// `eta lap(v) - alpha v - grad p + f = 0`.
    ///
    /// Use `12 eta / H^2` for the flow averaged over a gap of height H between two plates (a Hele-Shaw cell). Friction
    /// screens the flow beyond the length `sqrt(eta / alpha)`. It costs nothing in narrow channels, and at most half as
    /// much again in wide ones.
    ///
    /// # Errors
    /// Returns an error if the friction is negative or not finite.
    pub fn set_friction(&mut self, friction: f64) -> Result<(), StokesError> {
        self.friction = not_negative("friction", friction)?;
        self.tabulate();
        Ok(())
    }

    /// Computes the tables of the present friction and slip.
    fn tabulate(&mut self) {
        let h = self.grid.spacing();
        let screening = h.powi(2) * self.friction / self.viscosity;
        let slip = self.walls.slip().map(|slip| slip / h);
        let stick = [Wall::Bottom, Wall::Top].map(|wall| self.walls.stick(wall, h));
        self.modes = ChannelModes::new(self.grid.nx(), self.grid.ny(), screening, slip);
        self.mean = MeanFlow::new(&self.grid, self.viscosity, self.friction, stick);
    }

    /// Prescribes the mean pressure gradient or the flux of the solutions to come.
    ///
    /// # Errors
    /// Returns an error for a value that is not finite.
    pub fn set_drive(&mut self, drive: Drive) -> Result<(), StokesError> {
        drive.check()?;
        self.drive = drive;
        Ok(())
    }

    /// Prescribes the velocities of the walls in the solutions to come, and slip along them.
    ///
    /// # Errors
    /// Returns an error for walls of a channel with another number of cells.
    pub fn set_walls(&mut self, walls: WallMotion) -> Result<(), StokesError> {
        walls.check(&self.grid)?;
        for (wall, spectrum) in [Wall::Bottom, Wall::Top].into_iter().zip(&mut self.wall_spectra) {
            walls.spectrum(wall, &mut self.rows, spectrum);
        }
        let slip = self.walls.slip();
        self.walls = walls;
        if self.walls.slip() != slip {
            self.tabulate();
        }
        Ok(())
    }
}

impl StokesSolver for ChannelStokes {
    fn grid(&self) -> &Grid {
        &self.grid
    }

    fn viscosity(&self) -> f64 {
        self.viscosity
    }

    fn friction(&self) -> f64 {
        self.friction
    }

    fn walls(&self) -> &WallMotion {
        &self.walls
    }

    fn drive(&self) -> Drive {
        self.drive
    }

    fn solve(&mut self, force: &StaggeredField, velocity: &mut StaggeredField) -> Result<SolveReport, StokesError> {
        self.grid.check([("the force", force.grid()), ("the velocity", velocity.grid())])?;
        let (nx, ny, h) = (self.grid.nx(), self.grid.ny(), self.grid.spacing());
        let width = self.rows.width();
        let (fx, fy) = (force.x(), force.y());

        // On the way up: the curl, its transform, and the elimination of the first Dirichlet problem. With h curl f on
        // the right and psi / h on the left the stencils are bare differences; the transform's 1 / nx goes in here too.
        let scale = h * h / (self.viscosity * nx as f64);
        self.mean_u[0] = sum(&fx[..nx]) / nx as f64;
        for j in 1..ny {
            let (below, rest) = self.spectrum.split_at_mut((j - 1) * width);
            let row = &mut rest[..width];
            self.rows.forward(|out| stencil::curl(force, j, scale, out), row);
            // The mean of the curl is how the mean of fx differs from the row below.
            self.mean_u[j] = self.mean_u[j - 1] - row[0].re / (scale * nx as f64);
            self.modes.eliminate(j, &below[below.len().saturating_sub(width)..], row);
        }
        let [bottom, top] = &self.wall_spectra;
        self.modes.descend(&mut self.spectrum, bottom, top);
        let walls = [Wall::Bottom, Wall::Top].map(|wall| self.walls.mean(wall));
        let gradient = self.mean.solve(self.drive, walls, &mut self.mean_u);

        // On the way up again: the second Dirichlet problem, the transform back and the differences.
        let (u, v) = velocity.components_mut();
        self.below.fill(0.0);
        for (j, row) in (1..ny).zip(self.spectrum.chunks_exact_mut(width)) {
            self.modes.ascend(j, row);
            let psi = self.rows.inverse(row);
            // A number that is not finite in the force, or an overflow, reaches every value of this row.
            if j == 1 && !(psi[0] + self.mean_u[0]).is_finite() {
                return Err(StokesError::not_finite(
                    "the velocity",
                    &[("the force", fx), ("the force", &fy[nx..ny * nx])],
                ));
            }
            stencil::across(&mut v[j * nx..][..nx], psi, 0.0);
            let mean = self.mean_u[j - 1];
            for ((u, psi), below) in u[(j - 1) * nx..][..nx].iter_mut().zip(psi).zip(&mut self.below) {
                *u = mean + (psi - *below);
                *below = *psi;
            }
        }
        v[..nx].fill(0.0);
        v[ny * nx..].fill(0.0);
        let mean = self.mean_u[ny - 1];
        for (u, below) in u[(ny - 1) * nx..].iter_mut().zip(&self.below) {
            *u = mean - below;
        }

        self.work.solves += 1;
        self.work.forward_transforms += 1;
        self.work.inverse_transforms += 1;
        Ok(SolveReport { mean_pressure_gradient: [gradient, 0.0], ..SolveReport::default() })
    }

    /// Integrates the momentum balance along x, `dp/dx = eta lap u + fx`, by one forward and one inverse transform,
    /// without a Poisson problem.
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
        let (fx, fy, u) = (force.x(), force.y(), velocity.x());

        // The pressure averaged over x balances the mean force along y.
        let mut means = 0.0;
        let mut mean = 0.0;
        for j in 1..ny {
            mean += h * sum(&fy[j * nx..][..nx]) / nx as f64;
            means += mean;
        }
        mean = -means / ny as f64;

        let row = &mut self.spectrum[..self.rows.width()];
        let walls = &self.walls;
        let (stress, friction) = (self.viscosity / (h * h), self.friction);
        let [at_bottom, at_top] = [Wall::Bottom, Wall::Top].map(|wall| 2.0 * walls.stick(wall, h));
        for j in 0..ny {
            if j > 0 {
                mean += h * sum(&fy[j * nx..][..nx]) / nx as f64;
            }
            let middle = &u[j * nx..][..nx];
            let fx = &fx[j * nx..][..nx];
            let fill = |out: &mut [f64]| {
                for (i, out) in out.iter_mut().enumerate() {
                    let ghost = |wall, factor: f64| factor * walls.at(wall, i) + (1.0 - factor) * middle[i];
                    let below = if j > 0 { u[(j - 1) * nx + i] } else { ghost(Wall::Bottom, at_bottom) };
                    let above = if j + 1 < ny { u[(j + 1) * nx + i] } else { ghost(Wall::Top, at_top) };
                    let (left, right) = (stencil::left(i, nx), stencil::right(i, nx));
                    let laplacian = (middle[left] - middle[i])
                        + (middle[right] - middle[i])
                        + (below - middle[i])
                        + (above - middle[i]);
                    *out = stress * laplacian - friction * middle[i] + fx[i];
                }
            };
            self.rows.forward(fill, row);
            // Division by the symbol (1 - exp(-I theta)) / h of the difference, theta = 2 pi m / nx.
            for (m, value) in row.iter_mut().enumerate().skip(1) {
                let half_angle = std::f64::consts::PI * m as f64 / nx as f64;
                *value *= Complex64::new(0.5, -0.5 / half_angle.tan()) * (h / nx as f64);
            }
            row[0] = Complex64::new(mean, 0.0);
            let p = &mut pressure.values_mut()[j * nx..][..nx];
            p.copy_from_slice(self.rows.inverse(row));
            if !p[0].is_finite() {
                let given = [("the force", fx), ("the force", &fy[nx..ny * nx]), ("the velocity", u)];
                return Err(StokesError::not_finite("the pressure", &given));
            }
        }
        self.work.forward_transforms += 1;
        self.work.inverse_transforms += 1;
        Ok(())
    }

    fn work(&self) -> Work {
        self.work
    }
}

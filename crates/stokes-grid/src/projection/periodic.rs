//! The projection method in a periodic box.

use motile_base::internal::sum;

#[cfg(feature = "rayon")]
use crate::periodic::parallel;
use crate::{CentreField, Grid, RealFft2, StaggeredField, StokesError, Symbol, Work, kinematics, stencil};

/// The three scalar problems of the projection method in a doubly periodic box.
#[derive(Debug, Clone)]
pub(crate) struct PeriodicProjection {
    grid: Grid,
    viscosity: f64,
    pub(crate) mean_velocity: [f64; 2],
    transform: Transform,
    /// From a component of the force to the same component of the intermediate velocity, Cowley (2.26).
    diffusion: Symbol,
    /// From h times the divergence of the intermediate velocity to phi / h, Cowley (2.27).
    poisson: Symbol,
    intermediate: StaggeredField,
    /// phi / h.
    potential: CentreField,
}

impl PeriodicProjection {
    pub(crate) fn new(grid: Grid, viscosity: f64) -> Result<Self, StokesError> {
        let (nx, ny, h) = (grid.nx(), grid.ny(), grid.spacing());
        Ok(Self {
            grid,
            viscosity,
            mean_velocity: [0.0; 2],
            transform: Transform::new(nx, ny)?,
            diffusion: Symbol::inverse_laplacian(nx, ny, h * h / viscosity),
            poisson: Symbol::inverse_laplacian(nx, ny, -1.0),
            intermediate: StaggeredField::zeros(grid),
            potential: CentreField::zeros(grid),
        })
    }

    /// Computes the velocity; returns the mean pressure gradient.
    pub(crate) fn solve(
        &mut self,
        force: &StaggeredField,
        velocity: &mut StaggeredField,
        work: &mut Work,
    ) -> Result<[f64; 2], StokesError> {
        self.diffuse(force, work)?;
        self.project(work)?;
        self.correct(velocity);
        let cells = (self.grid.nx() * self.grid.ny()) as f64;
        Ok([force.x(), force.y()].map(|component| sum(component) / cells))
    }

    /// Computes the intermediate velocity, Cowley (2.22), with mean zero.
    fn diffuse(&mut self, force: &StaggeredField, work: &mut Work) -> Result<(), StokesError> {
        let nx = self.grid.nx();
        let (u, v) = self.intermediate.components_mut();
        for (from, to) in [(force.x(), u), (force.y(), v)] {
            self.transform.filter(&self.diffusion, |j, row| row.copy_from_slice(&from[j * nx..][..nx]), to)?;
            count_pair(work);
        }
        // An overflow anywhere reaches every value.
        let sum = self.intermediate.x()[0] + self.intermediate.y()[0];
        if sum.is_finite() { Ok(()) } else { Err(StokesError::overflow("the velocity")) }
    }

    /// Computes the potential of the intermediate velocity, Cowley (2.23).
    fn project(&mut self, work: &mut Work) -> Result<(), StokesError> {
        let (intermediate, potential) = (&self.intermediate, self.potential.values_mut());
        self.transform.filter(&self.poisson, |j, row| stencil::divergence(intermediate, j, row), potential)?;
        count_pair(work);
        let finite = self.potential.values()[0].is_finite();
        if finite { Ok(()) } else { Err(StokesError::overflow("the velocity")) }
    }

    /// Writes the intermediate velocity minus the gradient of the potential, Cowley (2.29).
    fn correct(&self, velocity: &mut StaggeredField) {
        let (nx, ny) = (self.grid.nx(), self.grid.ny());
        let [mean_u, mean_v] = self.mean_velocity;
        let (from_u, from_v) = (self.intermediate.x(), self.intermediate.y());
        let row = |j: usize| &self.potential.values()[j * nx..][..nx];
        let (u, v) = velocity.components_mut();
        for (j, (u, v)) in u.chunks_exact_mut(nx).zip(v.chunks_exact_mut(nx)).enumerate() {
            let (here, below) = (row(j), row(if j == 0 { ny - 1 } else { j - 1 }));
            subtract_slope(u, &from_u[j * nx..][..nx], here, mean_u);
            for ((v, from), (here, below)) in v.iter_mut().zip(&from_v[j * nx..][..nx]).zip(here.iter().zip(below)) {
                *v = mean_v + (from - (here - below));
            }
        }
    }

    pub(crate) fn intermediate_velocity(
        &mut self,
        force: &StaggeredField,
        out: &mut StaggeredField,
        work: &mut Work,
    ) -> Result<(), StokesError> {
        self.diffuse(force, work)?;
        let (u, v) = out.components_mut();
        let [mean_u, mean_v] = self.mean_velocity;
        u.iter_mut().zip(self.intermediate.x()).for_each(|(u, from)| *u = mean_u + from);
        v.iter_mut().zip(self.intermediate.y()).for_each(|(v, from)| *v = mean_v + from);
        Ok(())
    }

    pub(crate) fn potential(
        &mut self,
        force: &StaggeredField,
        out: &mut CentreField,
        work: &mut Work,
    ) -> Result<(), StokesError> {
        self.diffuse(force, work)?;
        self.project(work)?;
        let h = self.grid.spacing();
        out.values_mut().iter_mut().zip(self.potential.values()).for_each(|(to, from)| *to = h * from);
        Ok(())
    }

    /// Writes the pressure, minus the viscosity times the Laplacian of the potential, Cowley (2.30) with its sign.
    pub(crate) fn pressure(
        &mut self,
        force: &StaggeredField,
        out: &mut CentreField,
        work: &mut Work,
    ) -> Result<(), StokesError> {
        self.diffuse(force, work)?;
        kinematics::divergence_unchecked(&self.intermediate, out);
        out.values_mut().iter_mut().for_each(|p| *p *= -self.viscosity);
        Ok(())
    }
}

fn count_pair(work: &mut Work) {
    work.forward_transforms += 1;
    work.inverse_transforms += 1;
}

/// Writes `mean + from - (phi - phi to the left)`.
fn subtract_slope(out: &mut [f64], from: &[f64], phi: &[f64], mean: f64) {
    let last = phi.len() - 1;
    out[0] = mean + (from[0] - (phi[0] - phi[last]));
    for ((out, from), phi) in out[1..].iter_mut().zip(&from[1..]).zip(phi.windows(2)) {
        *out = mean + (from - (phi[1] - phi[0]));
    }
}

/// A pair of transforms, on several threads where these pay.
#[derive(Debug, Clone)]
struct Transform {
    serial: RealFft2,
    #[cfg(feature = "rayon")]
    parallel: Option<parallel::ParallelTransform>,
}

impl Transform {
    fn new(nx: usize, ny: usize) -> Result<Self, StokesError> {
        Ok(Self {
            serial: RealFft2::new(nx, ny)?,
            #[cfg(feature = "rayon")]
            parallel: None,
        })
    }

    /// Writes the rows of what a symbol makes of the rows that `input` writes.
    fn filter(
        &mut self,
        symbol: &Symbol,
        input: impl Fn(usize, &mut [f64]) + Sync,
        out: &mut [f64],
    ) -> Result<(), StokesError> {
        let [nx, ny] = self.serial.size();
        #[cfg(feature = "rayon")]
        if parallel::pays(nx * ny) {
            let transform = match &mut self.parallel {
                Some(parallel) => parallel,
                none => none.insert(parallel::ParallelTransform::new(nx, ny)?),
            };
            transform.filter(symbol, input, out);
            return Ok(());
        }
        debug_assert_eq!(out.len(), nx * ny);
        self.serial.filter(symbol, input, |j, row| out[j * nx..][..nx].copy_from_slice(row))
    }
}

#[cfg(all(test, feature = "rayon"))]
mod tests;

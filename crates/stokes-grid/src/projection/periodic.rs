//! Projection in a periodic box.

use crate::field::sum;
use crate::{CentreField, Grid, RealFft2, StaggeredField, StokesError, Symbol, Work, kinematics, stencil};

/// The three scalar problems of the projection method in a doubly periodic box.
#[derive(Debug, Clone)]
pub(crate) struct PeriodicProjection {
    grid: Grid,
    viscosity: f64,
    transform: RealFft2,
    /// From fx to u* and from fy to v*.
    diffusion: Symbol,
    /// From h div v* to phi / h.
    poisson: Symbol,
    starred: StaggeredField,
    below: Vec<f64>,
}

impl PeriodicProjection {
    pub(crate) fn new(grid: Grid, viscosity: f64) -> Result<Self, StokesError> {
        let (nx, ny, h) = (grid.nx(), grid.ny(), grid.spacing());
        Ok(Self {
            grid,
            viscosity,
            transform: RealFft2::new(nx, ny)?,
            diffusion: Symbol::inverse_laplacian(nx, ny, h * h / viscosity),
            poisson: Symbol::inverse_laplacian(nx, ny, -1.0),
            starred: StaggeredField::zeros(grid),
            below: vec![0.0; nx],
        })
    }

    /// v*, thesis (2.22).
    fn diffuse(&mut self, force: &StaggeredField, work: &mut Work) {
        let nx = self.grid.nx();
        let (u, v) = self.starred.components_mut();
        for (from, to) in [(force.x(), u), (force.y(), v)] {
            self.transform.filter(
                &self.diffusion,
                |j, row| row.copy_from_slice(&from[j * nx..][..nx]),
                |j, row| to[j * nx..][..nx].copy_from_slice(row),
            );
            work.forward_transforms += 1;
            work.inverse_transforms += 1;
        }
    }

    /// The velocity; gives the mean pressure gradient.
    pub(crate) fn solve(&mut self, force: &StaggeredField, velocity: &mut StaggeredField, work: &mut Work) -> [f64; 2] {
        self.diffuse(force, work);
        let (nx, ny) = (self.grid.nx(), self.grid.ny());
        let starred = &self.starred;
        let (u, v) = (starred.x(), starred.y());
        let (out_u, out_v) = velocity.components_mut();
        // Rows of v* - grad phi; the first row of v needs the last row of phi.
        let below = &mut self.below;
        self.transform.filter(
            &self.poisson,
            |j, row| stencil::divergence(starred, j, row),
            |j, phi| {
                for (i, here) in phi.iter().enumerate() {
                    let left = stencil::left(i, nx);
                    let k = j * nx + i;
                    out_u[k] = u[k] - (here - phi[left]);
                    out_v[k] = v[k] - if j == 0 { *here } else { here - below[i] };
                }
                below.copy_from_slice(phi);
            },
        );
        for (v, phi) in out_v.iter_mut().zip(below) {
            *v += *phi;
        }
        work.forward_transforms += 1;
        work.inverse_transforms += 1;
        let cells = (nx * ny) as f64;
        [sum(force.x()) / cells, sum(force.y()) / cells]
    }

    /// `p = -eta lap phi = -eta div v*`.
    pub(crate) fn pressure(&mut self, force: &StaggeredField, pressure: &mut CentreField, work: &mut Work) {
        self.diffuse(force, work);
        kinematics::divergence_unchecked(&self.starred, pressure);
        for p in pressure.values_mut() {
            *p *= -self.viscosity;
        }
    }
}

//! Strain rates, vorticity, streamfunction, flux and wall stress of a velocity field.
//!
//! Each function checks that its fields share a grid and then writes `out`; nothing is allocated.

use motile_base::{internal::sum, same_length};

use crate::{CentreField, NodeField, StaggeredField, StokesError, Wall, WallMotion, stencil};

/// Writes the divergence `du/dx + dv/dy` (1/time) at the centres: round-off for the solvers of this crate.
///
/// # Errors
/// Returns an error for fields of different grids.
pub fn divergence(velocity: &StaggeredField, out: &mut CentreField) -> Result<(), StokesError> {
    let grid = *velocity.grid();
    grid.check([("the divergence", out.grid())])?;
    divergence_unchecked(velocity, out);
    Ok(())
}

/// [`divergence`] of fields known to share a grid.
pub(crate) fn divergence_unchecked(velocity: &StaggeredField, out: &mut CentreField) {
    let grid = *velocity.grid();
    for (j, out) in out.values_mut().chunks_exact_mut(grid.nx()).enumerate() {
        stencil::divergence(velocity, j, out);
        out.iter_mut().for_each(|value| *value /= grid.spacing());
    }
}

/// Writes the normal strain rates `D_xx = du/dx` and `D_yy = dv/dy` (1/time) at the centres.
///
/// # Errors
/// Returns an error for fields of different grids.
pub fn normal_strain_rates(
    velocity: &StaggeredField,
    xx: &mut CentreField,
    yy: &mut CentreField,
) -> Result<(), StokesError> {
    let grid = *velocity.grid();
    grid.check([("the strain rate", xx.grid()), ("the strain rate", yy.grid())])?;
    let (nx, h) = (grid.nx(), grid.spacing());
    for (j, (xx, yy)) in xx.values_mut().chunks_exact_mut(nx).zip(yy.values_mut().chunks_exact_mut(nx)).enumerate() {
        stencil::normal_steps(velocity, j, |i, u_step, v_step| (xx[i], yy[i]) = (u_step / h, v_step / h));
    }
    Ok(())
}

/// Writes the shear strain rate `D_xy = (du/dy + dv/dx) / 2` (1/time) at the nodes. On a wall it has the value that
/// balances momentum ([`wall_shear_stress`]); `walls` are the walls of the solver, at rest in a periodic box.
///
/// # Errors
/// Returns an error for fields of different grids, or walls that do not belong to them.
pub fn shear_strain_rate(
    velocity: &StaggeredField,
    walls: &WallMotion,
    out: &mut NodeField,
) -> Result<(), StokesError> {
    cross_differences(velocity, walls, out, |u_slope, v_slope| 0.5 * (u_slope + v_slope))
}

/// Writes the vorticity `dv/dx - du/dy` (1/time) at the nodes, which is minus the Laplacian of the streamfunction;
/// `walls` are the walls of the solver, at rest in a periodic box.
///
/// # Errors
/// Returns an error for fields of different grids, or walls that do not belong to them.
pub fn vorticity(velocity: &StaggeredField, walls: &WallMotion, out: &mut NodeField) -> Result<(), StokesError> {
    cross_differences(velocity, walls, out, |u_slope, v_slope| v_slope - u_slope)
}

/// Writes `combine(du/dy, dv/dx)` at the nodes.
fn cross_differences(
    velocity: &StaggeredField,
    walls: &WallMotion,
    out: &mut NodeField,
    combine: impl Fn(f64, f64) -> f64,
) -> Result<(), StokesError> {
    let grid = *velocity.grid();
    grid.check([("the field at the nodes", out.grid())])?;
    walls.check(&grid)?;
    let h = grid.spacing();
    for (j, out) in out.values_mut().chunks_exact_mut(grid.nx()).enumerate() {
        stencil::shear_steps(velocity, walls, j, |i, u_step, v_step| out[i] = combine(u_step / h, v_step / h));
    }
    Ok(())
}

/// Writes the streamfunction psi (area per time) at the nodes, `u = d psi/dy`, `v = -d psi/dx`, of a velocity without
/// divergence, by summation; accurate to a few units of round-off times the number of cells in a row.
///
/// In a channel, psi is zero on the bottom wall and the flux on the top one. In a periodic box the mean velocity, which
/// has no periodic streamfunction, is left out, and psi has mean zero.
///
/// # Errors
/// Returns an error for fields of different grids.
pub fn streamfunction(velocity: &StaggeredField, out: &mut NodeField) -> Result<(), StokesError> {
    let grid = *velocity.grid();
    grid.check([("the streamfunction", out.grid())])?;
    let (nx, ny, h) = (grid.nx(), grid.ny(), grid.spacing());
    let psi = out.values_mut();
    if grid.has_walls() {
        psi[..nx].fill(0.0);
        for (k, u) in velocity.x().iter().enumerate() {
            psi[k + nx] = psi[k] + h * u;
        }
        return Ok(());
    }
    let cells = (nx * ny) as f64;
    let (mean_u, mean_v) = (sum(velocity.x()) / cells, sum(velocity.y()) / cells);
    psi[0] = 0.0;
    for j in 0..ny {
        if j > 0 {
            psi[j * nx] = psi[(j - 1) * nx] + h * (velocity.x()[(j - 1) * nx] - mean_u);
        }
        for k in j * nx + 1..(j + 1) * nx {
            psi[k] = psi[k - 1] - h * (velocity.y()[k - 1] - mean_v);
        }
    }
    let mean = sum(psi) / cells;
    for psi in psi {
        *psi -= mean;
    }
    Ok(())
}

/// Returns the flux along x (area per time): the integral of u over y, averaged over x.
#[must_use]
pub fn flux(velocity: &StaggeredField) -> f64 {
    sum(velocity.x()) * velocity.grid().spacing() / velocity.grid().nx() as f64
}

/// Writes the shear stress `eta du/dy` at a wall (force per length in 2D) at the columns of nodes; `out` has `nx`
/// values.
///
/// It is `2 eta (u - U) / h` with the velocity u half a cell from the wall, of second order, which balances momentum
/// with the forces in the fluid exactly: the force per length of the wall on the fluid is this at the top, minus this
/// at the bottom.
///
/// # Errors
/// Returns an error for a periodic grid, walls of another grid, or an `out` of the wrong length.
pub fn wall_shear_stress(
    velocity: &StaggeredField,
    viscosity: f64,
    walls: &WallMotion,
    wall: Wall,
    out: &mut [f64],
) -> Result<(), StokesError> {
    let grid = *velocity.grid();
    if !grid.has_walls() {
        return Err(StokesError::needs_channel());
    }
    walls.check(&grid)?;
    let (nx, h) = (grid.nx(), grid.spacing());
    same_length("the wall shear stress", nx, out.len())?;
    let (row, sign) = match wall {
        Wall::Bottom => (0, 1.0),
        Wall::Top => (grid.ny() - 1, -1.0),
    };
    let stick = walls.stick(wall, h);
    for (i, (out, u)) in out.iter_mut().zip(&velocity.x()[row * nx..]).enumerate() {
        *out = sign * 2.0 * viscosity * (u - walls.at(wall, i)) / h * stick;
    }
    Ok(())
}

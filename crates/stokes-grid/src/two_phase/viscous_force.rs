//! Viscous force density of a fluid whose viscosity varies in space.

use crate::stencil::{self, left, right};
use crate::{CentreField, NodeField, StaggeredField, WallMotion};

/// Operator `div(2 eta D) - alpha v` (force per volume) of a velocity v without divergence, D its strain rate and alpha
/// a uniform friction: normal stresses at the centres, shear stresses at the nodes, each with the viscosity there. It
/// is symmetric and negative, and `eta lap - alpha` where eta is uniform.
#[derive(Debug, Clone)]
pub(crate) struct ViscousForce {
    centres: CentreField,
    nodes: NodeField,
    xx: CentreField,
    yy: CentreField,
    xy: NodeField,
    friction: f64,
}

impl ViscousForce {
    pub(crate) fn new(centres: CentreField, nodes: NodeField, friction: f64) -> Self {
        let grid = *centres.grid();
        let (xx, yy, xy) = (CentreField::zeros(grid), CentreField::zeros(grid), NodeField::zeros(grid));
        Self { centres, nodes, xx, yy, xy, friction }
    }

    pub(crate) fn viscosity(&self) -> (&CentreField, &NodeField) {
        (&self.centres, &self.nodes)
    }

    pub(crate) fn viscosity_mut(&mut self) -> (&mut [f64], &mut [f64]) {
        (self.centres.values_mut(), self.nodes.values_mut())
    }

    /// Writes `out = base + factor * (div(2 eta D(velocity)) - alpha velocity)` for the wall velocities `walls`; zero
    /// on the rows that lie on walls.
    pub(crate) fn add(
        &mut self,
        velocity: &StaggeredField,
        walls: &WallMotion,
        factor: f64,
        base: Option<&StaggeredField>,
        out: &mut StaggeredField,
    ) {
        let grid = *self.centres.grid();
        let (nx, ny, h) = (grid.nx(), grid.ny(), grid.spacing());
        let channel = grid.has_walls();
        let scale = factor / (h * h);
        for j in 0..ny {
            let row = j * nx..(j + 1) * nx;
            let eta = &self.centres.values()[row.clone()];
            let (xx, yy) = (&mut self.xx.values_mut()[row.clone()], &mut self.yy.values_mut()[row]);
            stencil::normal_steps(velocity, j, |i, u_step, v_step| {
                xx[i] = 2.0 * scale * eta[i] * u_step;
                yy[i] = 2.0 * scale * eta[i] * v_step;
            });
        }
        for j in 0..grid.node_rows() {
            let row = j * nx..(j + 1) * nx;
            let eta = &self.nodes.values()[row.clone()];
            let xy = &mut self.xy.values_mut()[row];
            stencil::shear_steps(velocity, walls, j, |i, u_step, v_step| xy[i] = scale * eta[i] * (u_step + v_step));
        }
        let (fx, fy) = out.components_mut();
        let (xx, yy, xy) = (self.xx.values(), self.yy.values(), self.xy.values());
        for j in 0..ny {
            let above = if j + 1 == ny && !channel { 0 } else { j + 1 };
            for i in 0..nx {
                let k = j * nx + i;
                let force = xx[k] - xx[j * nx + left(i, nx)] + xy[above * nx + i] - xy[k];
                fx[k] = force + base.map_or(0.0, |base| base.x()[k]);
            }
        }
        for j in 0..grid.node_rows() {
            let wall = channel && (j == 0 || j == ny);
            for i in 0..nx {
                let k = j * nx + i;
                fy[k] = if wall {
                    0.0
                } else {
                    let below = if j > 0 { j - 1 } else { ny - 1 };
                    let force = xy[j * nx + right(i, nx)] - xy[k] + yy[k] - yy[below * nx + i];
                    force + base.map_or(0.0, |base| base.y()[k])
                };
            }
        }
        // On walls there is no velocity along y.
        if self.friction > 0.0 {
            out.combine(1.0, -factor * self.friction, velocity);
        }
    }
}

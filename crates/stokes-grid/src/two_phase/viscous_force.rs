//! The viscous force of a fluid whose viscosity varies.

use crate::stencil::{left, right};
use crate::{CentreField, Grid, NodeField, StaggeredField, Wall, WallMotion};

/// `div(2 eta D)` of a velocity without divergence, D its strain rate: normal stresses at the centres, shear stresses
/// at the nodes, each with the viscosity there. Minus this operator is symmetric and positive, and `eta lap` where eta
/// is uniform.
#[derive(Debug, Clone)]
pub(crate) struct ViscousForce {
    centres: CentreField,
    nodes: NodeField,
    xx: CentreField,
    yy: CentreField,
    xy: NodeField,
}

impl ViscousForce {
    pub(crate) fn new(centres: CentreField, nodes: NodeField) -> Self {
        let grid = *centres.grid();
        let (xx, yy, xy) = (CentreField::zeros(grid), CentreField::zeros(grid), NodeField::zeros(grid));
        Self { centres, nodes, xx, yy, xy }
    }

    pub(crate) fn viscosity(&self) -> (&CentreField, &NodeField) {
        (&self.centres, &self.nodes)
    }

    pub(crate) fn viscosity_mut(&mut self) -> (&mut [f64], &mut [f64]) {
        (self.centres.values_mut(), self.nodes.values_mut())
    }

    fn grid(&self) -> &Grid {
        self.centres.grid()
    }

    /// `out = base + factor * div(2 eta D(velocity))`, zero on the rows that lie on walls, which move as `walls`.
    pub(crate) fn add(
        &mut self,
        velocity: &StaggeredField,
        walls: &WallMotion,
        factor: f64,
        base: Option<&StaggeredField>,
        out: &mut StaggeredField,
    ) {
        let grid = *self.grid();
        let (nx, ny, h) = (grid.nx(), grid.ny(), grid.spacing());
        let channel = grid.has_walls();
        let (u, v) = (velocity.x(), velocity.y());
        let scale = factor / (h * h);
        for j in 0..ny {
            let row = j * nx..(j + 1) * nx;
            let u = &u[row.clone()];
            let above = if j + 1 == ny && !channel { 0 } else { (j + 1) * nx };
            let (v, v_above) = (&v[row.clone()], &v[above..above + nx]);
            let eta = &self.centres.values()[row.clone()];
            let (xx, yy) = (&mut self.xx.values_mut()[row.clone()], &mut self.yy.values_mut()[row]);
            for i in 0..nx {
                xx[i] = 2.0 * scale * eta[i] * (u[right(i, nx)] - u[i]);
                yy[i] = 2.0 * scale * eta[i] * (v_above[i] - v[i]);
            }
        }
        for j in 0..grid.node_rows() {
            let row = j * nx..(j + 1) * nx;
            let v = &v[row.clone()];
            let eta = &self.nodes.values()[row.clone()];
            let xy = &mut self.xy.values_mut()[row];
            for i in 0..nx {
                let slope = if channel && j == 0 {
                    2.0 * (u[i] - walls.at(Wall::Bottom, i))
                } else if channel && j == ny {
                    2.0 * (walls.at(Wall::Top, i) - u[(ny - 1) * nx + i])
                } else {
                    u[j * nx + i] - u[if j > 0 { j - 1 } else { ny - 1 } * nx + i]
                };
                xy[i] = scale * eta[i] * (slope + v[i] - v[left(i, nx)]);
            }
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
    }
}

//! What the walls of a channel add to the double layer.

use num_complex::Complex64;

use super::droplet::Droplet;
use super::wall_points::WallPoints;
use super::walls::WallModes;

/// Relative size of the modes that are left out.
const TOLERANCE: f64 = 1e-7;

/// The no-slip walls of a channel and the nodes between them.
#[derive(Debug)]
pub(crate) struct RigidWalls {
    modes: WallModes,
    half: f64,
    middle: f64,
    nodes: WallPoints,
    gap: f64,
    least_gap: f64,
    /// x of the nodes relative to their droplets' centres.
    local: Vec<f64>,
}

impl RigidWalls {
    /// Walls at the heights `bottom` and `top` of a channel of length `period`; `zero_flux` where the flux is held
    /// fixed. Nodes closer to a wall than `least_gap` (length) count as that far away.
    pub(crate) fn new(period: f64, [bottom, top]: [f64; 2], zero_flux: bool, least_gap: f64) -> Self {
        let half = 0.5 * (top - bottom);
        Self {
            modes: WallModes::new(period, half, zero_flux, TOLERANCE),
            half,
            middle: 0.5 * (top + bottom),
            nodes: WallPoints::default(),
            gap: half,
            least_gap,
            local: Vec::new(),
        }
    }

    pub(crate) fn load(&mut self, droplets: &[Droplet]) {
        self.nodes.clear();
        self.local.clear();
        let reach = self.half - self.least_gap;
        for droplet in droplets {
            for x in &droplet.positions {
                let at = x + droplet.centre;
                self.nodes.push(&self.modes, at.x, (at.y - self.middle).clamp(-reach, reach));
                self.local.push(x.x);
            }
        }
        self.gap = self.nodes.gap();
    }

    /// Adds the flow of dipoles (v_x n_x, v_x n_y + v_y n_x, v_y n_y) times weight and contrast/(4 pi) at the nodes.
    pub(crate) fn add_dipoles(&mut self, dipoles: &[[f64; 3]], ux: &mut [f64], uy: &mut [f64]) {
        self.modes.begin(self.gap, self.gap);
        self.modes.add_dipoles(&self.nodes, self.gap, |j| dipoles[j], |j| self.local[j]);
        self.modes.solve();
        self.modes.velocities(&self.nodes, self.gap, |i, u, v| {
            ux[i] += u;
            uy[i] += v;
        });
    }

    /// Adds the tractions at the nodes of the flow of forces there: the transpose of [`RigidWalls::add_dipoles`], by
    /// the symmetry of the Green's function.
    pub(crate) fn add_tractions(
        &mut self,
        droplets: &[Droplet],
        qx: &[f64],
        qy: &[f64],
        ux: &mut [f64],
        uy: &mut [f64],
    ) {
        self.modes.begin(self.gap, self.gap);
        self.modes.add_forces(&self.nodes, self.gap, |j| Complex64::new(qx[j], qy[j]));
        self.modes.solve();
        let slope = -2.0 * self.modes.mean[2];
        for droplet in droplets {
            let scale = droplet.contrast / (4.0 * std::f64::consts::PI);
            for (k, normal) in droplet.normals.iter().enumerate() {
                let i = droplet.first + k;
                let flow = self.modes.flow(&self.nodes, i);
                let [[xx, xy], [yx, yy]] = flow.gradient;
                let pressure = flow.pressure + slope * self.local[i];
                let mixed = xy + yx;
                ux[i] += scale * ((2.0 * xx - pressure) * normal.x + mixed * normal.y);
                uy[i] += scale * (mixed * normal.x + (2.0 * yy - pressure) * normal.y);
            }
        }
    }

    /// Mean pressure gradient of the flow of dipoles at the nodes.
    pub(crate) fn pressure_gradient(&mut self, dipoles: &[[f64; 3]]) -> f64 {
        self.modes.begin(self.gap, self.gap);
        self.modes.add_dipoles(&self.nodes, self.gap, |j| dipoles[j], |j| self.local[j]);
        -2.0 * self.modes.mean[2]
    }
}

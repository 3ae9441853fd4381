//! What the walls of a channel add to the double layer.

use num_complex::Complex64;

use super::{FOUR_PI, NodeCurve};
use crate::greens::walls::{WallModes, WallPoints};

/// Relative size of the modes that are left out.
const ACCURACY: f64 = 2e-8;

/// The no-slip walls of a channel and the nodes between them.
#[derive(Debug, Clone)]
pub(crate) struct DenseWalls {
    modes: WallModes,
    half: f64,
    middle: f64,
    nodes: WallPoints,
    gap: f64,
    least_gap: f64,
    /// x of the nodes relative to their curves' centres.
    local: Vec<f64>,
}

impl DenseWalls {
    /// `zero_flux` where the flux is held fixed. Nodes closer to a wall than `least_gap` (length) count as that far
    /// away.
    pub(crate) fn new(length: f64, width: f64, middle: f64, zero_flux: bool, least_gap: f64) -> Self {
        let half = 0.5 * width;
        let modes = WallModes::new(length, half, zero_flux);
        Self { modes, half, middle, nodes: WallPoints::default(), gap: half, least_gap, local: Vec::new() }
    }

    pub(crate) fn load(&mut self, curves: &[NodeCurve]) {
        self.nodes.clear();
        self.local.clear();
        let reach = self.half - self.least_gap;
        for curve in curves {
            for x in &curve.positions {
                let at = x + curve.centre;
                self.nodes.push(&self.modes, at.x, (at.y - self.middle).clamp(-reach, reach));
                self.local.push(x.x);
            }
        }
        self.gap = self.nodes.gap();
    }

    /// Adds the flow of dipoles (v_x n_x, v_x n_y + v_y n_x, v_y n_y) times weight and contrast/(4 pi) at the nodes.
    pub(crate) fn add_dipoles(&mut self, dipoles: &[[f64; 3]], ux: &mut [f64], uy: &mut [f64]) {
        self.modes.begin(self.gap, self.gap, ACCURACY);
        self.modes.add_dipoles(&self.nodes, self.gap, |j| dipoles[j], |j| self.local[j]);
        self.modes.solve();
        self.modes.velocities(&self.nodes, self.gap, |i, u, v| {
            ux[i] += u;
            uy[i] += v;
        });
    }

    /// Adds the tractions at the nodes of the flow of forces there: the transpose of [`DenseWalls::add_dipoles`], by
    /// the symmetry of the Green's function.
    pub(crate) fn add_tractions(
        &mut self,
        curves: &[NodeCurve],
        qx: &[f64],
        qy: &[f64],
        ux: &mut [f64],
        uy: &mut [f64],
    ) {
        self.modes.begin(self.gap, self.gap, ACCURACY);
        self.modes.add_forces(&self.nodes, self.gap, |j| Complex64::new(qx[j], qy[j]));
        self.modes.solve();
        let slope = -2.0 * self.modes.mean[2];
        let scale = 1.0 / FOUR_PI;
        for curve in curves {
            for (k, normal) in curve.normals.iter().enumerate() {
                let i = curve.first + k;
                let flow = self.modes.flow(&self.nodes, i);
                // The rate of strain is traceless and symmetric.
                let (xx, mixed) = (flow.strain.re, 2.0 * flow.strain.im);
                let pressure = flow.pressure + slope * self.local[i];
                ux[i] += scale * ((2.0 * xx - pressure) * normal.x + mixed * normal.y);
                uy[i] += scale * (mixed * normal.x - (2.0 * xx + pressure) * normal.y);
            }
        }
    }

    /// Mean pressure gradient of the flow of dipoles at the nodes.
    pub(crate) fn pressure_gradient(&mut self, dipoles: &[[f64; 3]]) -> f64 {
        self.modes.begin(self.gap, self.gap, ACCURACY);
        self.modes.add_dipoles(&self.nodes, self.gap, |j| dipoles[j], |j| self.local[j]);
        -2.0 * self.modes.mean[2]
    }
}

//! What the walls of a channel add to layers, and the flow that its forcing drives.

use std::{f64::consts::TAU, ops::Range};

use num_complex::Complex64;

use crate::{
    Forcing, LayerError,
    close::reach,
    curve::{Curve, REFINEMENT},
    greens::{
        Flow, Vectors,
        walls::{WallModes, WallPoints},
    },
};

use super::{Density, Plan};

/// Beyond a wall by less than this fraction of the width is taken for touching it.
const ROUND_OFF: f64 = 1e-12;
/// Sources closer to a wall than this many spacings count as that far away.
const LEAST_GAP: f64 = 0.02;

/// The walls of a channel with the nodes of the curves between them.
#[derive(Debug, Clone)]
pub(crate) struct Walls {
    length: f64,
    half: f64,
    pub(crate) forcing: Forcing,
    tolerance: f64,
    modes: WallModes,
    nodes: WallPoints,
    fine: WallPoints,
    /// Curve and number of each node.
    owners: Vec<[usize; 2]>,
    /// Whether the walls see the fine nodes: those of the nodes would be too coarse for their gap.
    refined: bool,
    gap: f64,
    points: WallPoints,
}

impl Walls {
    pub(crate) fn new(length: f64, width: f64, forcing: Forcing, tolerance: f64) -> Self {
        let half = 0.5 * width;
        Self {
            length,
            half,
            forcing,
            tolerance,
            modes: WallModes::new(length, half, matches!(forcing, Forcing::Flux(_))),
            nodes: WallPoints::default(),
            fine: WallPoints::default(),
            owners: Vec::new(),
            refined: false,
            gap: 0.0,
            points: WallPoints::default(),
        }
    }

    /// Whether velocities are needed at the fine nodes.
    pub(crate) fn is_refined(&self) -> bool {
        self.refined
    }

    /// Takes over the present shapes.
    pub(crate) fn load(&mut self, curves: &mut [Curve], plans: &mut [Plan]) -> Result<(), LayerError> {
        self.nodes.clear();
        self.owners.clear();
        let mut spacing = 0.0f64;
        for (number, curve) in curves.iter().enumerate() {
            spacing = spacing.max(curve.spacing());
            for (node, z) in curve.nodes.position.iter().enumerate() {
                let z = z + curve.centre;
                let depth = z.im.abs() - self.half;
                let allowed = ROUND_OFF * self.half;
                if depth > allowed {
                    return Err(LayerError::BeyondWall { curve: number, node, x: z.re, y: z.im, depth, allowed });
                }
                self.owners.push([number, node]);
                self.nodes.push(&self.modes, z.re, z.im.clamp(-self.half, self.half));
            }
        }
        self.gap = self.nodes.gap();
        // The wall's image of a node is two gaps away from the node.
        self.refined = 2.0 * self.gap < reach(self.tolerance) * spacing;
        if self.refined {
            curves.iter_mut().for_each(|curve| curve.refine(&mut plans[curve.plan].transforms));
            self.load_fine(curves);
            self.gap = self.gap.min(self.fine.gap()).max(LEAST_GAP * spacing);
        }
        Ok(())
    }

    fn load_fine(&mut self, curves: &[Curve]) {
        self.fine.clear();
        for curve in curves {
            for z in &curve.fine.position {
                let z = z + curve.centre;
                self.fine.push(&self.modes, z.re, z.im);
            }
        }
    }

    /// Adds the forces at the nodes or fine nodes of some curves to the modes.
    fn put_forces(&mut self, curves: &[Curve], from: Range<usize>, fine: bool, target_gap: f64) {
        let owners = &self.owners;
        let force = |j: usize| {
            let [curve, i] = owner(owners, j, fine);
            if from.contains(&curve) { curves[curve].samples(fine).force[i] } else { Complex64::default() }
        };
        let points = if fine { &self.fine } else { &self.nodes };
        self.modes.add_forces(points, target_gap, force);
    }

    /// Adds the dipoles at the nodes or, where there are velocities of those, at the fine nodes to the modes, times
    /// `sign`.
    fn put_dipoles(
        &mut self,
        curves: &[Curve],
        density: Density<'_>,
        fine: Option<&[Complex64]>,
        target_gap: f64,
        sign: f64,
    ) {
        let points = if fine.is_some() { &self.fine } else { &self.nodes };
        let owners = &self.owners;
        let dipole = |j: usize| {
            let [curve, i] = owner(owners, j, fine.is_some());
            let contrast = density.contrast(curve);
            if contrast == 0.0 {
                return [0.0; 3];
            }
            let v = fine.map_or_else(
                || {
                    let (x, y) = density.of(curve);
                    Complex64::new(x[i], y[i])
                },
                |values| values[j],
            );
            let samples = curves[curve].samples(fine.is_some());
            let weight = sign * TAU / samples.position.len() as f64;
            let t = samples.tangent[i] * (contrast * weight);
            [v.re * t.im, v.im * t.im - v.re * t.re, -v.im * t.re]
        };
        let x = |j: usize| {
            let [curve, i] = owner(owners, j, fine.is_some());
            curves[curve].samples(fine.is_some()).position[i].re
        };
        self.modes.add_dipoles(points, target_gap, dipole, x);
    }

    /// Adds what the modes give at the nodes.
    fn add_modes(&mut self, out: &mut [Vectors]) {
        self.modes.solve();
        self.modes.velocities(&self.nodes, self.gap, |i, u, v| {
            let [curve, i] = self.owners[i];
            out[curve].x[i] += u;
            out[curve].y[i] += v;
        });
    }

    /// Adds what the walls add to the single layer of some curves.
    pub(crate) fn add_forces(&mut self, curves: &[Curve], from: Range<usize>, out: &mut [Vectors]) {
        if !curves.is_empty() {
            self.modes.begin(self.gap, self.gap, self.tolerance);
            self.put_forces(curves, from, self.refined, self.gap);
            self.add_modes(out);
        }
    }

    /// Adds what the walls add to the double layer; `fine` are the velocities at the fine nodes if those are needed.
    pub(crate) fn add_dipoles(
        &mut self,
        curves: &[Curve],
        density: Density<'_>,
        fine: &[Complex64],
        accuracy: f64,
        out: &mut [Vectors],
    ) {
        self.modes.begin(self.gap, self.gap, accuracy);
        self.put_dipoles(curves, density, self.refined.then_some(fine), self.gap, 1.0);
        self.add_modes(out);
    }

    /// Velocity at height y of the flow that the forcing drives.
    pub(crate) fn forced_flow(&self, y: f64, viscosity: f64) -> f64 {
        let h = self.half;
        let parabola = h * h - y * y;
        match self.forcing {
            Forcing::Gradient(gradient) => -gradient / (2.0 * viscosity) * parabola,
            Forcing::Flux(flux) => 0.75 * flux / (h * h * h) * parabola,
        }
    }

    /// Mean pressure gradient along x (force per volume).
    pub(crate) fn pressure_gradient(&self, curves: &[Curve], density: Density<'_>, viscosity: f64) -> f64 {
        let h = self.half;
        let flux = match self.forcing {
            Forcing::Gradient(gradient) => return gradient,
            Forcing::Flux(flux) => flux,
        };
        let sum = self.force_moment(curves) - self.dipole_moment(curves, density);
        1.5 / (h * h * h) * (sum / (2.0 * self.length) - viscosity * flux)
    }

    /// The sum of (h^2 - y^2) F_x: 2 l eta times the flux of the forces without a mean pressure gradient.
    pub(crate) fn force_moment(&self, curves: &[Curve]) -> f64 {
        let parabola = |y: f64| self.half * self.half - y * y;
        let nodes = |curve: &Curve| -> f64 {
            let terms = curve.nodes.position.iter().zip(&curve.nodes.force);
            terms.map(|(z, force)| parabola(z.im + curve.centre.im) * force.re).sum()
        };
        curves.iter().map(nodes).sum()
    }

    /// The same of the double layer.
    pub(crate) fn dipole_moment(&self, curves: &[Curve], density: Density<'_>) -> f64 {
        let mut sum = 0.0;
        for (index, (curve, contrast)) in curves.iter().zip(density.contrasts).enumerate() {
            let (vx, vy) = density.of(index);
            let contrast = contrast * curve.weight();
            for (i, (z, t)) in curve.nodes.position.iter().zip(&curve.nodes.tangent).enumerate() {
                let y = z.im + curve.centre.im;
                let (nx, ny) = (t.im * contrast, -t.re * contrast);
                let shear = vx[i] * ny + vy[i] * nx;
                let flux = vx[i] * nx + vy[i] * ny;
                sum -= 2.0 * (y * shear - z.re * flux);
            }
        }
        sum
    }

    /// Prepares for [`Walls::add_flow`] at these points, with velocities at the fine nodes.
    pub(crate) fn prepare_points(
        &mut self,
        curves: &[Curve],
        density: Density<'_>,
        fine: &[Complex64],
        points: impl Iterator<Item = Complex64>,
    ) {
        self.points.clear();
        for z in points {
            self.points.push(&self.modes, z.re, z.im.clamp(-self.half, self.half));
        }
        self.load_fine(curves);
        if curves.is_empty() {
            self.modes.begin(self.half, self.half, self.tolerance);
        } else {
            let spacing = curves.iter().map(Curve::spacing).fold(0.0, f64::max);
            let source_gap = self.fine.gap().max(LEAST_GAP * spacing);
            let target_gap = self.points.gap().min(self.half);
            self.modes.begin(source_gap, target_gap, self.tolerance);
            self.put_forces(curves, 0..curves.len(), true, target_gap);
            if !density.vanishes() {
                self.put_dipoles(curves, density, Some(fine), target_gap, -1.0);
            }
        }
        self.modes.solve();
    }

    /// Adds the flow at the point of that number.
    pub(crate) fn add_flow(&self, index: usize, flow: &mut Flow) {
        *flow += self.modes.flow(&self.points, index);
    }
}

/// Curve and number of a node or fine node from those of the nodes.
fn owner(owners: &[[usize; 2]], j: usize, fine: bool) -> [usize; 2] {
    if fine {
        let [curve, node] = owners[j / REFINEMENT];
        [curve, REFINEMENT * node + j % REFINEMENT]
    } else {
        owners[j]
    }
}

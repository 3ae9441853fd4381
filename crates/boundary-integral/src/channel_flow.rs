//! A channel: rows of images in closed form, walls by modes.

use std::f64::consts::{PI, TAU};

use ib_core::FlowError;
use num_complex::Complex64;
use stokes_grid::Drive;

use crate::{
    domain::Channel,
    far::{Division, Far, Smooth, too_close},
    field::{FieldKernel, Flow},
    images::Images,
    interface::{Interface, REFINEMENT, Transforms},
    layers::Pair,
    near::reach,
    pair_kernel::{Row, RowPair},
    planes::Vectors,
    series::{ImageKernel, SeriesFinder},
    stress::Dipoles,
    surroundings::{NodeVelocities, Surroundings},
    transform::{copy_band, largest_wave},
    wall_points::WallPoints,
    walls::WallModes,
};

/// Beyond a wall by less than this fraction of the width is taken for touching it.
const ROUND_OFF: f64 = 1e-12;

/// The images and walls of a channel.
#[derive(Debug)]
pub(crate) struct ChannelFlow {
    period: f64,
    half: f64,
    drive: Drive,
    tolerance: f64,
    modes: WallModes,
    nodes: WallPoints,
    fine: WallPoints,
    /// Whether the walls see the fine nodes: those of the nodes would be too coarse for their gap.
    refined: bool,
    gap: f64,
    velocities: Vec<Complex64>,
    spectrum: Vec<Complex64>,
    points: WallPoints,
}

impl ChannelFlow {
    pub(crate) fn new(domain: &Channel, tolerance: f64) -> Self {
        let (period, half) = (domain.period(), 0.5 * domain.width());
        let zero_flux = matches!(domain.drive(), Drive::ZeroFlux | Drive::Flux(_));
        Self {
            period,
            half,
            drive: domain.drive(),
            tolerance,
            modes: WallModes::new(period, half, zero_flux),
            nodes: WallPoints::default(),
            fine: WallPoints::default(),
            refined: false,
            gap: 0.0,
            velocities: Vec::new(),
            spectrum: Vec::new(),
            points: WallPoints::default(),
        }
    }

    fn fill_fine(&mut self, interfaces: &[Interface]) {
        self.fine.clear();
        for interface in interfaces {
            for z in &interface.fine.position {
                let z = z + interface.centre;
                self.fine.push(&self.modes, z.re, z.im);
            }
        }
    }

    /// Adds forces to the modes from the nodes or fine nodes.
    fn forces(&mut self, interfaces: &[Interface], target_gap: f64, fine: bool) {
        let points = if fine { &self.fine } else { &self.nodes };
        let first = &interfaces[0];
        let nodes = first.nodes() * if fine { REFINEMENT } else { 1 };
        self.modes.add_forces(points, target_gap, |j| {
            let interface = &interfaces[j / nodes];
            if fine { interface.fine.force[j % nodes] } else { interface.force[j % nodes] }
        });
    }

    /// Adds dipoles to the modes from the fine nodes, times `sign`.
    fn fine_dipoles(
        &mut self,
        interfaces: &[Interface],
        velocities: NodeVelocities<'_>,
        transforms: &mut Transforms,
        target_gap: f64,
        sign: f64,
    ) {
        let nodes = interfaces[0].nodes();
        let len = REFINEMENT * nodes;
        self.velocities.resize(len * interfaces.len(), Complex64::default());
        self.spectrum.resize(nodes, Complex64::default());
        for (index, fine) in self.velocities.chunks_exact_mut(len).enumerate() {
            let (vx, vy) = velocities.of(index, nodes);
            for ((value, x), y) in self.spectrum.iter_mut().zip(vx).zip(vy) {
                *value = Complex64::new(*x, *y);
            }
            transforms.nodes.forward(&mut self.spectrum);
            copy_band(&self.spectrum, fine, largest_wave(nodes));
            transforms.fine.inverse(fine);
        }
        let values = &self.velocities;
        let weight = sign * TAU / len as f64;
        let dipoles = |j: usize| {
            let contrast = velocities.contrasts[j / len] * weight;
            let (v, t) = (values[j], interfaces[j / len].fine.tangent[j % len] * contrast);
            [v.re * t.im, v.im * t.im - v.re * t.re, -v.im * t.re]
        };
        self.modes.add_dipoles(&self.fine, target_gap, dipoles, |j| interfaces[j / len].fine.position[j % len].re);
    }

    fn spread(&self, out: &mut [Vectors]) {
        let nodes = out[0].x.len();
        self.modes.velocities(&self.nodes, self.gap, |i, u, v| {
            let out = &mut out[i / nodes];
            out.x[i % nodes] += u;
            out.y[i % nodes] += v;
        });
    }
}

impl Surroundings for ChannelFlow {
    fn images(&self) -> Images {
        Images { periods: [Some(self.period), None] }
    }

    fn wave(&self) -> Option<(f64, bool)> {
        Some((TAU / self.period, false))
    }

    fn divide(&self, target: &Interface, source: &Interface, own: bool, out: &mut Division) {
        let distance = self.images().wrap(target.centre - source.centre);
        out.clear(distance);
        if own || too_close(target.radius + source.radius, distance) {
            let row = Row::new(TAU / self.period, [-distance.re, -distance.im], false);
            out.pairs.push((Pair::Row(RowPair { row }), own));
        } else {
            out.smooth = Smooth::Images;
            out.nearest = distance.norm();
        }
    }

    fn far(&self, tolerance: f64) -> Far {
        let row = Row::new(TAU / self.period, [0.0; 2], false);
        let finder = SeriesFinder::new(ImageKernel::Row(RowPair { row }), self.images(), self.wave());
        Far::new(Some(finder), f64::INFINITY, None, tolerance)
    }

    fn prepare(&mut self, interfaces: &mut [Interface], transforms: &mut Transforms) -> Result<(), FlowError> {
        self.nodes.clear();
        let mut spacing = 0.0f64;
        for (body, interface) in interfaces.iter().enumerate() {
            spacing = spacing.max(interface.spacing());
            for (marker, z) in interface.position.iter().enumerate() {
                let z = z + interface.centre;
                let depth = z.im.abs() - self.half;
                let allowed = ROUND_OFF * self.half;
                if depth > allowed {
                    return Err(FlowError::BeyondWall { body, marker, x: z.re, y: z.im, depth, allowed });
                }
                self.nodes.push(&self.modes, z.re, z.im.clamp(-self.half, self.half));
            }
        }
        self.gap = self.nodes.gap();
        // The wall's image of a node is two gaps away from the node.
        self.refined = 2.0 * self.gap < reach(self.tolerance) * spacing;
        if self.refined {
            interfaces.iter_mut().for_each(|interface| interface.refine(transforms));
            self.fill_fine(interfaces);
            self.gap = self.gap.min(self.fine.gap()).max(0.02 * spacing);
        }
        Ok(())
    }

    fn add_forces(&mut self, interfaces: &[Interface], out: &mut [Vectors]) {
        if interfaces.is_empty() {
            return;
        }
        self.modes.begin(self.gap, self.gap, self.tolerance);
        self.forces(interfaces, self.gap, self.refined);
        self.modes.solve();
        self.spread(out);
    }

    fn add_dipoles(
        &mut self,
        interfaces: &[Interface],
        dipoles: &[Dipoles],
        velocities: NodeVelocities<'_>,
        accuracy: f64,
        transforms: &mut Transforms,
        out: &mut [Vectors],
    ) {
        self.modes.begin(self.gap, self.gap, accuracy);
        if self.refined {
            self.fine_dipoles(interfaces, velocities, transforms, self.gap, 1.0);
        } else {
            let nodes = interfaces[0].nodes();
            let at = |j: usize| {
                let d = &dipoles[j / nodes];
                [d.xx[j % nodes], d.s[j % nodes], d.yy[j % nodes]]
            };
            self.modes.add_dipoles(&self.nodes, self.gap, at, |j| interfaces[j / nodes].position[j % nodes].re);
        }
        self.modes.solve();
        self.spread(out);
    }

    fn imposed(&self, y: f64, viscosity: f64) -> f64 {
        let h = self.half;
        let parabola = h * h - y * y;
        match self.drive {
            Drive::ZeroGradient | Drive::ZeroFlux => 0.0,
            Drive::Gradient(gradient) => -gradient / (2.0 * viscosity) * parabola,
            Drive::Flux(flux) => 0.75 * flux / (h * h * h) * parabola,
        }
    }

    fn pressure_gradient(&self, interfaces: &[Interface], velocities: NodeVelocities<'_>, viscosity: f64) -> f64 {
        let h = self.half;
        let imposed = match self.drive {
            Drive::ZeroGradient => return 0.0,
            Drive::Gradient(gradient) => return gradient,
            Drive::ZeroFlux => 0.0,
            Drive::Flux(flux) => -1.5 * viscosity * flux / (h * h * h),
        };
        let mut sum = 0.0;
        for (index, interface) in interfaces.iter().enumerate() {
            let (vx, vy) = velocities.of(index, interface.nodes());
            let contrast = velocities.contrasts[index] * interface.weight();
            for (i, (z, t)) in interface.position.iter().zip(&interface.tangent).enumerate() {
                let y = z.im + interface.centre.im;
                let (nx, ny) = (t.im * contrast, -t.re * contrast);
                let shear = vx[i] * ny + vy[i] * nx;
                let flux = vx[i] * nx + vy[i] * ny;
                sum += (h * h - y * y) * interface.force[i].re + 2.0 * (y * shear - z.re * flux);
            }
        }
        imposed + 1.5 * TAU / self.period / (h * h * h) / (4.0 * PI) * sum
    }

    fn field(&self) -> FieldKernel {
        FieldKernel::Row { k: TAU / self.period }
    }

    fn begin_field(
        &mut self,
        interfaces: &[Interface],
        velocities: NodeVelocities<'_>,
        transforms: &mut Transforms,
        points: &[Complex64],
    ) {
        self.points.clear();
        for z in points {
            self.points.push(&self.modes, z.re, z.im.clamp(-self.half, self.half));
        }
        self.fill_fine(interfaces);
        if interfaces.is_empty() {
            self.modes.begin(self.half, self.half, self.tolerance);
        } else {
            let source_gap = self.fine.gap().max(0.02 * interfaces[0].spacing());
            let target_gap = self.points.gap().min(self.half);
            self.modes.begin(source_gap, target_gap, self.tolerance);
            self.forces(interfaces, target_gap, true);
            if velocities.contrasts.iter().any(|contrast| *contrast != 0.0) {
                self.fine_dipoles(interfaces, velocities, transforms, target_gap, -1.0);
            }
        }
        self.modes.solve();
    }

    fn add_field(&self, index: usize, flow: &mut Flow) {
        let wall = self.modes.flow(&self.points, index);
        let [[ux, uy], [vx, vy]] = wall.gradient;
        flow.velocity += Complex64::new(wall.velocity[0], wall.velocity[1]);
        flow.spin += 0.5 * Complex64::new(ux + vy, vx - uy);
        flow.strain += 0.5 * Complex64::new(ux - vy, vx + uy);
        flow.pressure += wall.pressure;
    }
}

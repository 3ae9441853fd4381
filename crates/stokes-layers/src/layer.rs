//! Single and double layers on closed curves, at their nodes and at points anywhere.
//!
//! A layer is the sum of four contributions: of the nodes of curves that are close to each other, summed directly; of
//! all other curves and images, by multipoles; of what the region adds (walls, a mean flow); and of a correction at
//! nodes and points that are so close to a curve that its nodes do not resolve the Green's function.

mod dipoles;
mod direct;
mod points;
mod sums;
mod walls;

use std::f64::consts::{PI, TAU};

use num_complex::Complex64;

use crate::{
    Geometry, LayerError, Vec2,
    close::{CloseCorrection, CloseWeights},
    curve::{Curve, REFINEMENT, Transforms},
    greens::{GreensFunction, Vectors},
    multipole::Multipoles,
};
pub(crate) use dipoles::Dipoles;
use direct::DirectSums;
pub(crate) use direct::{DirectPair, Pair};
use walls::Walls;

/// Velocities at the nodes, x then y, curve after curve, and what each curve's are multiplied by in a double layer (the
/// viscosity inside less that outside).
#[derive(Debug, Clone, Copy)]
pub(crate) struct Density<'a> {
    pub(crate) values: &'a [f64],
    pub(crate) contrasts: &'a [f64],
}

impl<'a> Density<'a> {
    /// Nodes of each curve.
    pub(crate) fn nodes(&self) -> usize {
        self.values.len() / (2 * self.contrasts.len()).max(1)
    }

    /// The components at the nodes of one curve.
    pub(crate) fn of(&self, curve: usize) -> (&'a [f64], &'a [f64]) {
        let nodes = self.nodes();
        self.values[2 * nodes * curve..2 * nodes * (curve + 1)].split_at(nodes)
    }

    fn vanishes(&self) -> bool {
        self.contrasts.iter().all(|contrast| *contrast == 0.0)
    }
}

/// Layers on closed curves in a region. Flows are 4 pi times velocity times viscosity.
#[derive(Debug, Clone)]
pub(crate) struct Layers {
    geometry: Geometry,
    greens: GreensFunction,
    pub(crate) transforms: Transforms,
    pub(crate) curves: Vec<Curve>,
    direct: DirectSums,
    multipoles: Multipoles,
    walls: Option<Walls>,
    close: CloseCorrection,
    /// The flow at the nodes.
    out: Vec<Vectors>,
    nodes: usize,
    /// Velocities at the fine nodes, curve after curve.
    fine: Vec<Complex64>,
    points: points::PointSums,
}

impl Layers {
    pub(crate) fn new(geometry: Geometry, nodes: usize, tolerance: f64) -> Self {
        let walls = if let Geometry::Channel { length, width, forcing } = geometry {
            Some(Walls::new(length, width, forcing, tolerance))
        } else {
            None
        };
        Self {
            geometry,
            greens: GreensFunction::new(&geometry, tolerance),
            transforms: Transforms::new(nodes),
            curves: Vec::new(),
            direct: DirectSums::new(nodes),
            multipoles: Multipoles::new(geometry, tolerance),
            walls,
            close: CloseCorrection::new(nodes, tolerance),
            out: Vec::new(),
            nodes,
            fine: Vec::new(),
            points: points::PointSums::new(CloseWeights::new(nodes), tolerance),
        }
    }

    /// Takes over curves, each given by positions and forces.
    ///
    /// # Errors
    /// Numbers that are not finite, too few or too many points, a clockwise curve, a node beyond a wall.
    pub(crate) fn load<'a>(&mut self, curves: impl Iterator<Item = [&'a [Vec2]; 2]>) -> Result<(), LayerError> {
        let mut count = 0;
        for (index, given) in curves.enumerate() {
            if index == self.curves.len() {
                self.curves.push(Curve::new(self.nodes));
                self.out.push(Vectors::default());
            }
            self.curves[index].load(&mut self.transforms, given, index)?;
            count += 1;
        }
        self.curves.truncate(count);
        self.out.truncate(count);
        match &mut self.walls {
            Some(walls) => walls.load(&mut self.curves, &mut self.transforms),
            None => Ok(()),
        }
    }

    /// The flow of the last layer at the nodes.
    pub(crate) fn flow(&self) -> &[Vectors] {
        &self.out
    }

    /// Computes the single layer of the forces at the nodes. With `double`, prepares for [`Layers::double_layer`].
    pub(crate) fn single_layer(&mut self, double: bool) {
        let Self { direct, multipoles, walls, close, curves, transforms, out, .. } = self;
        let wave = if let Geometry::Channel { length, .. } = self.geometry { Some(TAU / length) } else { None };
        direct.load(curves, wave);
        multipoles.divide(curves, &mut direct.pairs);
        close.find(curves, transforms, &self.geometry.images());
        out.iter_mut().for_each(|out| out.clear(self.nodes));

        direct.add_forces(out);
        multipoles.add_forces(curves, out);
        if let Some(walls) = walls {
            walls.add_forces(curves, out);
        }
        close.add_forces(curves, transforms, double, out);
        if double {
            direct.prepare_stress();
        }
    }

    /// Computes the double layer at the nodes: walls and multipoles to an accuracy relative to the velocities.
    pub(crate) fn double_layer(&mut self, density: Density<'_>, accuracy: f64) {
        if self.walls.as_ref().is_some_and(Walls::is_refined) {
            self.refine(density);
        }
        let mean = self.mean_flow(density);
        let Self { direct, multipoles, walls, close, curves, fine, out, .. } = self;
        for (index, (arrays, curve)) in direct.curves.iter_mut().zip(&*curves).enumerate() {
            let weight = density.contrasts[index] * curve.weight();
            arrays.dipoles.fill(density.of(index), &curve.nodes.tangent, weight);
        }
        out.iter_mut().for_each(|out| out.clear(self.nodes));

        direct.add_dipoles(curves, out);
        multipoles.add_dipoles(curves, direct.curves.iter().map(|arrays| &arrays.dipoles), accuracy, out);
        if let Some(walls) = walls {
            walls.add_dipoles(curves, density, fine, accuracy, out);
        }
        if let Some(mean) = mean {
            for out in &mut *out {
                out.x.iter_mut().for_each(|u| *u -= mean.re);
                out.y.iter_mut().for_each(|v| *v -= mean.im);
            }
        }
        close.add_dipoles(density, out);
    }

    /// Velocity at height y of the flow that the forcing of a channel drives.
    pub(crate) fn forced_flow(&self, y: f64, viscosity: f64) -> f64 {
        self.walls.as_ref().map_or(0.0, |walls| walls.forced_flow(y, viscosity))
    }

    /// Mean pressure gradient along x (force per volume).
    pub(crate) fn pressure_gradient(&self, density: Density<'_>, viscosity: f64) -> f64 {
        self.walls.as_ref().map_or(0.0, |walls| walls.pressure_gradient(&self.curves, density, viscosity))
    }

    /// Interpolates velocities to the fine nodes.
    fn refine(&mut self, density: Density<'_>) {
        let (len, nodes) = (REFINEMENT * self.nodes, self.nodes);
        self.fine.resize(len * self.curves.len(), Complex64::default());
        for (fine, values) in self.fine.chunks_exact_mut(len).zip(density.values.chunks_exact(2 * nodes)) {
            self.transforms.at_fine(values, fine);
        }
    }

    /// 4 pi/area times the sum of X v.n in a box, whose mean velocity is zero.
    fn mean_flow(&self, density: Density<'_>) -> Option<Complex64> {
        let Geometry::Box { lengths: [lx, ly] } = self.geometry else { return None };
        let mut sum = Complex64::default();
        for (index, (curve, contrast)) in self.curves.iter().zip(density.contrasts).enumerate() {
            let (vx, vy) = density.of(index);
            for (i, (z, t)) in curve.nodes.position.iter().zip(&curve.nodes.tangent).enumerate() {
                sum += z * ((vx[i] * t.im - vy[i] * t.re) * contrast * curve.weight());
            }
        }
        Some(sum * (4.0 * PI / (lx * ly)))
    }
}
